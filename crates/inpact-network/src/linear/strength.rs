//! Levels of strength: conductances of like size belong to one level, so that within a level no small number is added to a far larger one.

use super::core::Element;
use inpact_evaluation::numbers::exponent_of;
use std::collections::BTreeSet;

/// Within a level the largest conductance is less than 2^WIDTH times the smallest.
///
/// Plain assembly loses as many digits as the strengths of a level differ, which refinement recovers with one more solve;
/// more levels mean unknowns that are coupled to more others. The measured optimum is flat between 6 and 14.
const WIDTH: i32 = 10;

/// The levels of strength of a network, the strongest first.
#[derive(Clone, Debug)]
pub(crate) struct Levels {
    /// The largest exponent of each level.
    greatest: Vec<i32>,
}

impl Levels {
    /// The levels of some elements: split at the widest gap between strengths until each is narrow enough.
    pub(crate) fn of<'a>(elements: impl Iterator<Item = &'a Element>) -> Self {
        let exponents: BTreeSet<i32> = elements.map(exponent).collect();
        let ascending: Vec<i32> = exponents.into_iter().collect();
        let mut greatest = Vec::new();
        cut(&ascending, &mut greatest);
        greatest.reverse();
        Self { greatest }
    }

    /// The number of levels.
    pub(crate) fn count(&self) -> usize {
        self.greatest.len()
    }

    /// The level of an element.
    pub(crate) fn of_element(&self, element: &Element) -> u16 {
        let exponent = exponent(element);
        let level = self.greatest.partition_point(|&greatest| greatest >= exponent) - 1;
        // At most one level for each of the 2,098 exponents of f64.
        u16::try_from(level).unwrap_or(u16::MAX)
    }

    /// An even exponent near that of the conductances of each level, within what an f64 can be multiplied by.
    pub(crate) fn scales(&self) -> Vec<i32> {
        self.greatest.iter().map(|greatest| (greatest & !1).clamp(-1000, 1000)).collect()
    }
}

fn exponent(element: &Element) -> i32 {
    exponent_of(element.conductance.to_f64())
}

/// Splits ascending exponents into levels and returns the greatest exponent of each, ascending.
fn cut(ascending: &[i32], greatest: &mut Vec<i32>) {
    let (Some(first), Some(last)) = (ascending.first(), ascending.last()) else { return };
    if last - first < WIDTH {
        greatest.push(*last);
        return;
    }
    // Of equal gaps the one closest to the middle.
    let middle = f64::from(first + last) / 2.0;
    let gap = |place: &usize| ascending[*place] - ascending[place - 1];
    let off = |place: &usize| (f64::from(ascending[*place] + ascending[place - 1]) / 2.0 - middle).abs();
    let best = (1..ascending.len()).max_by(|a, b| gap(a).cmp(&gap(b)).then(off(b).total_cmp(&off(a))));
    let place = best.unwrap_or(1);
    cut(&ascending[..place], greatest);
    cut(&ascending[place..], greatest);
}
