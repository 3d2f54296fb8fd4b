//! A transient: backward Euler increments from the state at the start to the end.
//!
//! The local error of an increment of length h is h²/2 · |x''| to first order; x'' is the change of the rate from the previous increment, divided by h.
//! Adaptive increments are as long as that allows, and end where a time course of the scene has a kink; one with too large an error is rejected and shortened.
//! The error is compared with the range of the field's values so far. So that this works in a scene that starts at rest or has come to rest,
//! one increment to the next kink is tried after each kink and counted in the range: backward Euler does not overshoot.
//! Where time integrals of the rows are requested, their error in an increment counts as well, relative to the integrals (`integrals.rs`).
//! Source: Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.8, for the step size control.

use crate::error::Error;
use crate::integrals::{Added, Integrals, RowFlows};
use crate::problem::Problem;
use crate::scene::{Field, Procedure, Scene, Steps, TimeSpan};
use crate::solve::{Equations, Histories};
use crate::state::{FieldState, State};

/// The minimum increment, relative to the total time.
const SHORTEST: f64 = 1e-12;

/// A remainder below this fraction of an increment is not an increment of its own.
const REMAINDER: f64 = 1e-9;

/// Increments of a transient.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TransientReport {
    /// The number of increments.
    pub increments: usize,
    /// The number of rejected increments.
    pub taken_back: usize,
    /// The largest estimated local error of an increment, relative to the range of its field's values so far.
    pub local_error: f64,
    /// The number of points of time courses inside increments of fixed length.
    pub passed_over: usize,
    /// The estimated relative error of the time integrals of the rows; `None` where they are not requested.
    pub integral_error: Option<f64>,
}

/// Solves a scene: its steady state, or the states of its transient one by one; `take` gets each as it is computed.
///
/// # Errors
/// The first failure, after the states before it, or what `take` returns.
pub fn run<E: From<Error>>(
    equations: &mut Equations<'_>,
    mut take: impl FnMut(&State) -> Result<(), E>,
) -> Result<TransientReport, E> {
    let problem = equations.problem();
    let Procedure::Transient(span) = problem.scene.procedure else {
        take(&equations.steady()?)?;
        return Ok(TransientReport::default());
    };
    let start = equations.start(span.start)?;
    take(&start)?;
    let rates = initial_rates(problem, &start);
    let ranges = [None; 2];
    let flows = match equations.histories() {
        Histories::Wanted => Some((RowFlows::of(problem, &start), Integrals::default())),
        Histories::NotWanted => None,
    };
    let mut march = March { problem, equations, rates, ranges, flows, report: TransientReport::default() };
    march.widen(&start);
    match span.steps {
        Steps::Given(step) => march.by_length(start, span, step, &mut take)?,
        Steps::ByError { tolerance, first } => march.by_error(start, span, tolerance, first, &mut take)?,
    }
    march.report.integral_error = march.flows.as_ref().map(|(_, integrals)| integrals.error());
    Ok(march.report)
}

/// Solves the beginning of a scene: its steady state, or the state at the start of its transient and the one an increment later; `take` gets each as it is computed.
///
/// # Errors
/// The first failure, after the states before it, or what `take` returns.
pub fn begin<E: From<Error>>(
    equations: &mut Equations<'_>,
    mut take: impl FnMut(State) -> Result<(), E>,
) -> Result<(), E> {
    let Procedure::Transient(span) = equations.problem().scene.procedure else {
        return take(equations.steady()?);
    };
    let start = equations.start(span.start)?;
    take(start.clone())?;
    let (Steps::Given(length) | Steps::ByError { first: length, .. }) = span.steps;
    take(equations.step(&start, (span.start + length).min(span.end))?)
}

/// A transient in progress.
struct March<'a, 'p> {
    problem: &'p Problem<'p>,
    equations: &'a mut Equations<'p>,
    /// The rate of each node with a capacity, for temperature and pore pressure.
    rates: [Vec<f64>; 2],
    /// Minimum and maximum so far, of the same fields.
    ranges: [Option<[f64; 2]>; 2],
    /// The flows of the last state, and their integrals, where they are requested.
    flows: Option<(RowFlows, Integrals)>,
    report: TransientReport,
}

/// The fields that have capacities.
const STORING: [Field; 2] = [Field::Temperature, Field::PorePressure];

impl March<'_, '_> {
    fn by_length<E: From<Error>>(
        &mut self,
        mut state: State,
        span: TimeSpan,
        step: f64,
        take: &mut impl FnMut(&State) -> Result<(), E>,
    ) -> Result<(), E> {
        let whole = ((span.end - span.start) / step).round();
        let exact = ((span.end - span.start) / step - whole).abs() <= REMAINDER;
        let mut number = 0.0;
        let corners = corners(self.problem.scene, span);
        while state.time < span.end {
            number += 1.0;
            let time = span.start + number * step;
            let is_last = if exact { number >= whole } else { time >= span.end };
            let next = self.equations.step(&state, if is_last { span.end } else { time })?;
            self.report.passed_over += inside(&corners, [state.time, next.time], REMAINDER * step);
            let rates = self.rates_of(&state, &next);
            self.widen(&next);
            self.accept(&state, &next, rates);
            take(&next)?;
            state = next;
        }
        Ok(())
    }

    fn by_error<E: From<Error>>(
        &mut self,
        mut state: State,
        span: TimeSpan,
        tolerance: f64,
        first: f64,
        take: &mut impl FnMut(&State) -> Result<(), E>,
    ) -> Result<(), E> {
        let corners = corners(self.problem.scene, span);
        let shortest = (SHORTEST * (span.end - span.start)).max(span.resolution());
        let mut length = first;
        let mut tried = f64::NEG_INFINITY;
        while state.time < span.end {
            let until = corners.iter().copied().find(|&corner| corner > state.time).unwrap_or(span.end);
            // The rest is split evenly into the last two increments, so that none is tiny.
            let left = until - state.time;
            if tried < until {
                tried = until;
                if let Ok(trial) = self.equations.step(&state, until) {
                    self.widen(&trial);
                    if let Some((before, integrals)) = &mut self.flows {
                        let after = RowFlows::of(self.problem, &trial);
                        integrals.reach(&Added::between(before, &after, left));
                    }
                }
            }
            let taken = if length >= left { left } else { length.min(0.5 * left).max(shortest.min(left)) };
            let time = if taken >= left { until } else { state.time + taken };
            let next = match self.equations.step(&state, time) {
                Ok(next) => next,
                Err(failure) if failure.may_be_of_length() && taken > 2.0 * shortest => {
                    self.report.taken_back += 1;
                    length = 0.25 * taken;
                    continue;
                }
                Err(failure) => return Err(failure.into()),
            };
            let rates = self.rates_of(&state, &next);
            let error = self.local_error(&state, &next, &rates).max(self.integral_share(&state, &next));
            let factor = if error > 0.0 { (0.9 * (tolerance / error).sqrt()).clamp(0.2, 5.0) } else { 5.0 };
            length = factor * taken;
            if error > tolerance && taken > 2.0 * shortest {
                self.report.taken_back += 1;
                continue;
            }
            self.widen(&next);
            self.accept(&state, &next, rates);
            take(&next)?;
            state = next;
        }
        Ok(())
    }

    /// Includes the values of a state in the ranges.
    fn widen(&mut self, state: &State) {
        for (range, field) in self.ranges.iter_mut().zip(STORING) {
            let values = state.field(field).into_iter().flat_map(FieldState::values).filter(|value| value.is_finite());
            let wider = |[least, greatest]: [f64; 2], value: f64| [least.min(value), greatest.max(value)];
            *range = values.fold(*range, |range, value| Some(wider(range.unwrap_or([value; 2]), value)));
        }
    }

    fn accept(&mut self, before: &State, after: &State, rates: [Vec<f64>; 2]) {
        self.report.local_error = self.report.local_error.max(self.local_error(before, after, &rates));
        if let Some((flows, integrals)) = &mut self.flows {
            let end = RowFlows::of(self.problem, after);
            integrals.add(&Added::between(flows, &end, after.time - before.time));
            *flows = end;
        }
        self.report.increments += 1;
        self.rates = rates;
    }

    /// The relative error of time integrals in an increment; 0 where they are not requested.
    fn integral_share(&self, before: &State, after: &State) -> f64 {
        self.flows.as_ref().map_or(0.0, |(flows, integrals)| {
            let end = RowFlows::of(self.problem, after);
            integrals.share(&Added::between(flows, &end, after.time - before.time))
        })
    }

    /// The rates over an increment.
    fn rates_of(&self, before: &State, after: &State) -> [Vec<f64>; 2] {
        let duration = after.time - before.time;
        STORING.map(|field| {
            let nodes = self.problem.scene.conditions(field).capacities.keys();
            let rate = |&node: &u32| {
                let change =
                    after.exact_value(self.problem, field, node)? - before.exact_value(self.problem, field, node)?;
                Some(change.to_f64() / duration)
            };
            nodes.map(|node| rate(node).unwrap_or(0.0)).collect()
        })
    }

    /// The estimated local error of an increment, relative to the range of values so far.
    fn local_error(&self, before: &State, after: &State, rates: &[Vec<f64>; 2]) -> f64 {
        let duration = after.time - before.time;
        let mut largest = 0.0_f64;
        for ((rates, rates_before), range) in rates.iter().zip(&self.rates).zip(&self.ranges) {
            let changes = rates.iter().zip(rates_before).map(|(now, before)| (now - before).abs());
            let error = 0.5 * duration * changes.fold(0.0, f64::max);
            if let Some([least, greatest]) = range.filter(|[least, greatest]| least < greatest) {
                largest = largest.max(error / (greatest - least));
            }
        }
        largest
    }
}

/// The rates with which nodes with a capacity leave their initial values.
fn initial_rates(problem: &Problem<'_>, start: &State) -> [Vec<f64>; 2] {
    STORING.map(|field| {
        let leaving = start.leaving(problem, field);
        let rate = |(&node, &capacity): (&u32, &f64)| {
            let place = problem.field(field)?.place[node as usize];
            (capacity > 0.0).then_some(-leaving.get(place as usize)?.to_f64() / capacity)
        };
        problem.scene.conditions(field).capacities.iter().map(|of| rate(of).unwrap_or(0.0)).collect()
    })
}

/// The number of kinks inside an increment, further than a distance from both its ends.
fn inside(corners: &[f64], [start, end]: [f64; 2], distance: f64) -> usize {
    let first = corners.partition_point(|corner| *corner <= start + distance);
    let after = corners.partition_point(|corner| *corner < end - distance);
    after.saturating_sub(first)
}

/// The times inside a span at which a time course of the scene changes its slope, and the end.
fn corners(scene: &Scene, span: TimeSpan) -> Vec<f64> {
    let of_conditions = scene.conditions.iter().flat_map(|of| of.fixed.values().chain(of.sources.values()));
    let of_rows = scene.interfaces.iter().flat_map(|row| row.clearance.iter().chain(&row.pressure));
    let all = of_conditions.chain(of_rows).flat_map(crate::scene::Course::corners);
    let mut corners: Vec<f64> = all.filter(|time| span.start < *time && *time < span.end).collect();
    corners.push(span.end);
    corners.sort_unstable_by(f64::total_cmp);
    corners.dedup();
    corners
}

#[cfg(test)]
mod tests {
    use super::inside;

    #[test]
    fn a_corner_near_an_end_is_not_inside() {
        let corners = [0.0, 0.25, 0.5, 1.0 + 0.75e-9, 2.0];
        assert_eq!(inside(&corners, [0.0, 1.0], 1e-9), 2);
        assert_eq!(inside(&corners, [1.0, 1.0 + 1.5e-9], 1e-9), 0);
        assert_eq!(inside(&corners, [0.25, 0.5], 1e-9), 0);
        assert_eq!(inside(&corners, [1.0, 2.0], 1e-10), 1);
    }
}
