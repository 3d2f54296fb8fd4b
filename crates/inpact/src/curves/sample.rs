//! Abscissae at which a curve is sampled, and the number of values kept.
//!
//! On linear axes a curve is straight between the abscissae of its rows, so that these would suffice; logarithmic axes and pointing at a curve need more.

use super::request::Detail;
use super::rows::Rows;
use super::{Knot, Sample, range};
use std::ops::Range;

/// Values of one branch that are kept: about two for each pixel of a wide picture.
const MAX_SAMPLES: usize = 1600;

/// The maximum number of marked rows of one branch; more would merge into a band.
const MAX_KNOTS: usize = 300;

/// The maximum number of abscissae taken from the groups around a curve.
const MAX_OF_ALL_ROWS: usize = 4000;

/// The maximum number of groups of rows whose end is sampled on both sides, as the value may drop there.
const MAX_ENDS: usize = 64;

/// The rows of one side of contact, with the data needed by all its curves.
#[derive(Debug)]
pub(super) struct Side<'a> {
    pub(super) rows: Option<&'a Rows<'a>>,
    groups: Vec<Range<usize>>,
    /// The variables after the abscissa on which the values depend.
    depends: Vec<bool>,
    /// The distinct abscissae of all rows, ascending; thinned if there are too many.
    all: Vec<f64>,
}

impl<'a> Side<'a> {
    pub(super) fn of(rows: Option<&'a Rows<'a>>) -> Self {
        let Some(of) = rows.filter(|rows| 1 < rows.width()) else {
            return Self { rows: None, groups: Vec::new(), depends: Vec::new(), all: Vec::new() };
        };
        let groups = of.groups();
        let mut all: Vec<f64> = Vec::new();
        if 1 < groups.len() {
            all = (0..of.count()).map(|row| of.row(row)[1]).filter(|x| x.is_finite()).collect();
            sort_and_dedup(&mut all);
            all = spread(&all, MAX_OF_ALL_ROWS);
        }
        Self { rows, groups, depends: of.depends(), all }
    }

    /// The rows that lie on the curve at these values of the other variables.
    pub(super) fn group(&self, variables: &[f64]) -> Option<Range<usize>> {
        let rows = self.rows?;
        // A table has fewer columns than the law has variables where the other table has more.
        let is_meant = |group: &&Range<usize>| {
            let outer = rows.row(group.start).get(2..).unwrap_or(&[]);
            let mut cells = outer.iter().zip(variables).zip(&self.depends);
            cells.all(|((of_row, variable), depends)| !depends || of_row == variable)
        };
        self.groups.iter().find(is_meant).cloned()
    }

    pub(super) fn groups(&self) -> &[Range<usize>] {
        &self.groups
    }

    /// The rows of a group as markers, and their number.
    pub(super) fn knots(&self, group: Option<Range<usize>>) -> (Vec<Knot>, usize) {
        let (Some(rows), Some(group)) = (self.rows, group) else { return (Vec::new(), 0) };
        let count = group.len();
        if MAX_KNOTS < count {
            return (Vec::new(), count);
        }
        let knot = |row: usize| Knot { x: rows.row(row)[1], y: rows.row(row)[0], row };
        (group.map(knot).filter(|knot| knot.x.is_finite() && knot.y.is_finite()).collect(), count)
    }

    /// The abscissae at which the curve at these values of the other variables is evaluated, ascending, each once.
    pub(super) fn abscissae(&self, variables: &[f64], ends: (f64, f64), jumps: &[f64], detail: Detail) -> Vec<f64> {
        let mut abscissae = vec![ends.0, ends.1, 0.0];
        for jump in jumps {
            abscissae.extend([*jump, jump.next_up(), jump.next_down()]);
        }
        if let Some(rows) = self.rows {
            let last = |group: &Range<usize>| rows.row(group.end - 1)[1];
            if let Some(group) = self.group(variables) {
                abscissae.push(last(&group).next_up());
                abscissae.extend(group.map(|row| rows.row(row)[1]));
            } else {
                abscissae.extend(self.groups.iter().take(MAX_ENDS).map(|group| last(group).next_up()));
                abscissae.extend(&self.all);
            }
        }
        abscissae.retain(|x| x.is_finite() && ends.0 <= *x && *x <= ends.1);
        sort_and_dedup(&mut abscissae);
        detail.refine(&mut abscissae);
        abscissae
    }
}

impl Detail {
    /// Adds abscissae between the required ones.
    fn refine(self, abscissae: &mut Vec<f64>) {
        let wanted = match self {
            Self::Rows => return,
            Self::Even(wanted) | Self::Geometric(wanted) => wanted,
        };
        let segments = abscissae.len().saturating_sub(1).max(1);
        let pieces = wanted.div_ceil(segments);
        if pieces < 2 {
            return;
        }
        let mut more = Vec::new();
        for pair in abscissae.windows(2) {
            let (x0, x1) = (pair[0], pair[1]);
            let is_geometric = matches!(self, Self::Geometric(_)) && 0.0 < x1;
            // A curve that begins at zero has no logarithm there.
            let first = if 0.0 < x0 { x0 } else { x1 * 1e-6 };
            for piece in 1..pieces {
                let part = piece as f64 / pieces as f64;
                more.push(if is_geometric { first * (x1 / first).powf(part) } else { x0 + part * (x1 - x0) });
            }
        }
        more.retain(|x| x.is_finite() && abscissae[0] < *x && *x < abscissae[abscissae.len() - 1]);
        abscissae.extend(more);
        sort_and_dedup(abscissae);
    }
}

/// Ascending and distinct. Zero is +0.
pub(super) fn sort_and_dedup(values: &mut Vec<f64>) {
    for value in values.iter_mut() {
        *value += 0.0;
    }
    values.sort_unstable_by(f64::total_cmp);
    values.dedup();
}

/// An evenly spaced sample of at most this number of values, including the first and the last.
pub(super) fn spread<T: Clone>(values: &[T], most: usize) -> Vec<T> {
    if values.len() <= most || most < 2 {
        return values.to_vec();
    }
    (0..most).map(|index| values[index * (values.len() - 1) / (most - 1)].clone()).collect()
}

/// Drops samples below the resolution: of each interval the first, the last, the smallest and the largest are kept.
pub(super) fn thinned(samples: Vec<Sample>) -> Vec<Sample> {
    if samples.len() <= MAX_SAMPLES {
        return samples;
    }
    let stretch = samples.len().div_ceil(MAX_SAMPLES / 4);
    let mut kept = Vec::new();
    for part in samples.chunks(stretch) {
        let by_value = |a: &usize, b: &usize| part[*a].y.total_cmp(&part[*b].y);
        let least = (0..part.len()).min_by(by_value).unwrap_or(0);
        let greatest = (0..part.len()).max_by(by_value).unwrap_or(0);
        let mut indices = vec![0, least, greatest, part.len() - 1];
        indices.sort_unstable();
        indices.dedup();
        kept.extend(indices.into_iter().map(|index| part[index]));
    }
    kept
}

/// The indices of at most this number of the abscissae shared by some curves.
///
/// Of each interval the first is kept, and the one where a curve deviates most from the straight line through the interval's ends,
/// relative to the curve's own range, so that a spike of a small curve remains visible beside large ones. The last is kept as well.
pub(super) fn thinned_together(abscissae: &[f64], curves: &[Vec<Option<f64>>], most: usize) -> Vec<usize> {
    let count = abscissae.len();
    if count <= most {
        return (0..count).collect();
    }
    let ranges: Vec<f64> = curves.iter().map(|curve| spread_of(curve)).collect();
    let stretch = (count - 1).div_ceil((most - 1) / 2);
    let mut kept = Vec::new();
    for first in (0..count - 1).step_by(stretch) {
        let last = (first + stretch).min(count - 1);
        let bend = |index: &usize| {
            let places = [first, *index, last].map(|place| abscissae[place]);
            let departures = curves.iter().zip(&ranges).map(|(curve, range)| {
                departure(places, [curve[first], curve[*index], curve[last]]).unwrap_or(0.0) / range
            });
            departures.fold(0.0, f64::max)
        };
        kept.push(first);
        kept.extend((first + 1..last).max_by(|a, b| bend(a).total_cmp(&bend(b))));
    }
    kept.push(count - 1);
    kept
}

/// The distance of the second of three points from the straight line through the two others.
fn departure([x0, x, x1]: [f64; 3], [y0, y, y1]: [Option<f64>; 3]) -> Option<f64> {
    let (y0, y, y1) = (y0?, y?, y1?);
    let found = (y - (y0 + (x - x0) / (x1 - x0) * (y1 - y0))).abs();
    (!found.is_nan()).then_some(found)
}

/// The difference of the largest and the smallest finite value; 1 where there is none.
fn spread_of(curve: &[Option<f64>]) -> f64 {
    match range(curve.iter().flatten().copied().filter(|y| y.is_finite())) {
        Some((low, high)) if low < high => high - low,
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::super::Reach;
    use super::*;

    #[test]
    fn a_spike_among_a_million_samples_stays() {
        let sample = |index: i32| Sample {
            x: f64::from(index),
            y: if index == 654_321 { 7.0 } else { 1.0 },
            reach: Reach::Within,
        };
        let kept = thinned((0..1_000_000).map(sample).collect());
        assert!(kept.len() <= MAX_SAMPLES);
        assert!(kept.iter().any(|sample| sample.y == 7.0));
        assert!(kept.windows(2).all(|pair| pair[0].x < pair[1].x));
        assert_eq!(kept.last().map(|sample| sample.x), Some(999_999.0));
    }

    #[test]
    fn a_spike_of_one_small_curve_stays_among_large_ones() {
        let abscissae: Vec<f64> = (0..10_000).map(f64::from).collect();
        let wave = abscissae.iter().map(|x| Some(1e9 * (x % 97.0))).collect();
        let spike = abscissae.iter().map(|x| Some(if *x == 6_543.0 { 1e-3 } else { 0.0 })).collect();
        let kept = thinned_together(&abscissae, &[wave, spike], 400);
        assert!(kept.len() <= 400, "{} abscissae", kept.len());
        assert!(kept.contains(&6_543));
        assert!(kept.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!((kept.first(), kept.last()), (Some(&0), Some(&9_999)));
        assert_eq!(thinned_together(&abscissae[..400], &[vec![None; 400]], 400).len(), 400);
        assert_eq!(thinned_together(&abscissae[..401], &[vec![None; 401]], 400).len(), 268);
    }

    #[test]
    fn refined_abscissae_ascend_and_keep_those_of_the_rows() {
        for detail in [Detail::Even(50), Detail::Geometric(50)] {
            let rows = [0.0, 1e-6, 3.0];
            let mut abscissae = rows.to_vec();
            detail.refine(&mut abscissae);
            assert!(50 <= abscissae.len());
            assert!(abscissae.windows(2).all(|pair| pair[0] < pair[1]));
            assert!(rows.iter().all(|row| abscissae.contains(row)));
        }
    }

    #[test]
    fn few_values_are_spread_over_many() {
        assert_eq!(spread(&[1, 2, 3, 4, 5, 6, 7, 8, 9], 3), [1, 5, 9]);
        assert_eq!(spread(&[1, 2], 3), [1, 2]);
    }
}
