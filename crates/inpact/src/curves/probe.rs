//! Precomputed values of a law at sampled temperatures and field variables, for the sliders of a page that cannot evaluate the law itself.

use super::law::Law;
use super::sample::{Side as SideRows, sort_and_dedup, spread, thinned_together};
use super::{Detail, Half, Quantity, Side};

/// The values of a law at all combinations of sample values.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Probe {
    /// The variables that can be moved, the first slowest.
    pub axes: Vec<ProbeAxis>,
    /// While open, and while closed.
    pub branches: [ProbeBranch; 2],
}

/// A variable with its sample values.
#[derive(Debug, Clone, PartialEq)]
pub struct ProbeAxis {
    /// The quantity.
    pub quantity: Quantity,
    /// Its values, ascending.
    pub stops: Vec<f64>,
}

/// The values on one side of contact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProbeBranch {
    /// Clearances or contact pressures, ascending.
    pub abscissae: Vec<f64>,
    /// The number of all abscissae of its rows; more than here where there are too many for a page.
    pub all_abscissae: usize,
    /// For each combination of sample values, the last variable varying fastest, one value per abscissa; `None` where the law has none.
    pub values: Vec<Option<f64>>,
}

/// The maximum number of values of a law in a page.
const MAX_VALUES: usize = 4000;

const MAX_ABSCISSAE: usize = 40;

/// The maximum number of values of each side from which these are chosen.
const MAX_CHOSEN_FROM: usize = 200_000;

/// The number of intervals between two values of a variable.
const PARTS: [usize; 3] = [4, 2, 1];

/// The law at the sample values of `movable` variables, given by index among all `variables`; `None` where there are none.
pub(super) fn probe(
    law: Law<'_>,
    sides: &[SideRows<'_>; 2],
    halves: &[Half; 2],
    variables: &[f64],
    movable: &[(usize, &Quantity, &[f64])],
) -> Option<Probe> {
    if movable.is_empty() {
        return None;
    }
    let most_stops = MAX_VALUES / (2 * MAX_ABSCISSAE);
    let axes = axes(movable, most_stops);
    let stops: usize = axes.iter().map(|axis| axis.stops.len()).product();
    let variables: Vec<Vec<f64>> = (0..stops).map(|stop| at_stop(variables, movable, &axes, stop)).collect();
    let branches = [0, 1].map(|side| {
        let cutoff: Vec<f64> = law.cutoff().filter(|_| side == 0).into_iter().collect();
        let ends = (halves[side].start, halves[side].end);
        let each = variables.iter().flat_map(|of| sides[side].abscissae(of, ends, &cutoff, Detail::Rows));
        let mut abscissae: Vec<f64> = each.collect();
        sort_and_dedup(&mut abscissae);
        let all = abscissae.len();
        let abscissae = spread(&abscissae, MAX_CHOSEN_FROM / stops);
        let value = |x: &f64, of: &Vec<f64>| law.value(Side::BOTH[side], *x, of).map(|value| value.y);
        let values = variables.iter().map(|of| abscissae.iter().map(|x| value(x, of)).collect());
        let values: Vec<Vec<Option<f64>>> = values.collect();
        let kept = thinned_together(&abscissae, &values, MAX_ABSCISSAE);
        ProbeBranch {
            abscissae: kept.iter().map(|index| abscissae[*index]).collect(),
            values: values.iter().flat_map(|of| kept.iter().map(|index| of[*index])).collect(),
            all_abscissae: all,
        }
    });
    Some(Probe { axes, branches })
}

/// Sample values at the values of the rows and between them, as many as fit; variables beyond the first few stay fixed.
fn axes(movable: &[(usize, &Quantity, &[f64])], most: usize) -> Vec<ProbeAxis> {
    for parts in PARTS {
        let axes: Vec<ProbeAxis> = movable.iter().map(|(_, quantity, values)| axis(quantity, values, parts)).collect();
        if axes.iter().map(|axis| axis.stops.len()).product::<usize>() <= most {
            return axes;
        }
    }
    let mut left = most;
    let axes = movable.iter().map(|(_, quantity, values)| {
        let fitting = spread(values, left.clamp(1, 9));
        let stops = if fitting.len() <= left { fitting } else { values[..1].to_vec() };
        left = (left / stops.len()).max(1);
        ProbeAxis { quantity: (*quantity).clone(), stops }
    });
    axes.collect()
}

fn axis(quantity: &Quantity, values: &[f64], parts: usize) -> ProbeAxis {
    let mut stops = Vec::new();
    for pair in values.windows(2) {
        stops.push(pair[0]);
        let part = |part: usize| pair[0] + (pair[1] - pair[0]) * (part as f64 / parts as f64);
        stops.extend((1..parts).map(part).filter(|stop| pair[0] < *stop && *stop < pair[1]));
    }
    stops.extend(values.last());
    ProbeAxis { quantity: quantity.clone(), stops }
}

fn at_stop(variables: &[f64], movable: &[(usize, &Quantity, &[f64])], axes: &[ProbeAxis], mut stop: usize) -> Vec<f64> {
    let mut at = variables.to_vec();
    for ((index, ..), axis) in movable.iter().zip(axes).rev() {
        at[*index] = axis.stops[stop % axis.stops.len()];
        stop /= axis.stops.len();
    }
    at
}
