//! Iterative refinement: an approximate solver gives a solution accurate to the last digits of f64.
//!
//! The residual of each unknown is computed in edge form and in 106 bits, the approximate solver gives a correction, and so on.
//! Each step gains as many digits as the solver has. The largest relative change of a flow in the last step, times the factor by which the changes shrink,
//! estimates the remaining error; a solution is accepted only when that and the balances are within the tolerance.
//! After the first step that factor is unknown: there the estimate is the residual of the balances, relative to the flows, times the condition number.
//! Conjugate gradients stop when most of the residual is corrected, so that small flows may be wrong and not change: there the larger of both estimates counts.
//! A residual below the rounding of its balance is no reason to continue. The rounding error of a flow counts as its error;
//! a flow no larger than that counts as zero. When steps gain nothing more, the result is a solution where rounding accounts for the remaining error, and a failure elsewhere.

use super::core::{Core, ROUNDING};
use super::edges::{Balance, Edges};
use super::factor::{Accuracy, Solves};
use super::matrix::{scaled_flows, shift, unscale};
use super::report::{MethodFailure, NoSolution, Quality};
use inpact_evaluation::numbers::DoubleDouble;

/// The maximum number of steps of a refinement: a body without any flow decreases from rounding to zero by some sixteen decades a step, if necessary through all six hundred of f64.
const MAX_STEPS: usize = 100;

/// Steps without progress after which a refinement fails.
const PATIENCE: usize = 24;

/// Steps without progress after which a solution is accepted whose estimated error is explained by rounding.
const AT_ROUNDING: usize = 4;

/// A step makes progress where the largest residual decreases by this factor.
const FALLS: f64 = 1e-3;

/// Result of a refinement.
#[derive(Debug)]
pub(crate) struct Refined {
    /// The jump along the forest of each unknown.
    pub(crate) jumps: Vec<DoubleDouble>,
    pub(crate) balance: Balance,
    pub(crate) quality: Quality,
}

/// Reasons why a refinement failed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum GaveUp {
    /// The approximate solver failed.
    Solver(NoSolution),
    /// The steps make no more progress; the accuracy reached.
    Stalled(Quality),
    /// A flow is beyond the range of f64.
    Overflow,
}

impl From<GaveUp> for MethodFailure {
    fn from(reason: GaveUp) -> Self {
        match reason {
            GaveUp::Solver(reason) => Self::NoSolution(reason),
            GaveUp::Stalled(quality) => Self::Stalled(quality),
            GaveUp::Overflow => Self::Overflow,
        }
    }
}

/// Solves by refinement until residual and estimated error are within `tolerance`.
///
/// # Errors
/// See [`GaveUp`].
pub(crate) fn refine(core: &Core, edges: &Edges, solver: &mut dyn Solves, tolerance: f64) -> Result<Refined, GaveUp> {
    let form = &edges.form;
    let sources = edges.sources(core);
    let mut jumps = vec![DoubleDouble::ZERO; form.count()];
    let mut balance = Balance::default();
    let mut changes: Vec<f64> = Vec::new();
    let mut quality = Quality::default();
    let mut progress = Progress::default();
    loop {
        edges.balance(core, &jumps, &sources, &mut balance);
        quality.residual = balance.worst_share();
        if !quality.residual.is_finite() {
            return Err(GaveUp::Overflow);
        }
        if quality.solves > 0 {
            let is_first = quality.solves == 1;
            quality.error = progress.error_after(edges.change_of_flows(core, &balance, &changes), solver.accuracy());
            if is_first || !solver.is_even() {
                let by_balance = quality.condition * edges.missing_in_flows(core, &balance);
                quality.error = if is_first { by_balance } else { quality.error.max(by_balance) };
            }
            if quality.error <= tolerance && quality.residual <= tolerance {
                break;
            }
            let largest = balance.missing().map(f64::abs).fold(0.0, f64::max);
            let idle = progress.idle_after(quality.residual, largest);
            if AT_ROUNDING <= idle && quality.residual <= tolerance {
                // The rounding error of a flow exceeds its remaining error: no further step, and no
                // other method, improves this. (Flows set to zero here are recomputed by the next balance.)
                let open = edges.settle(core, quality.condition.max(1.0), &mut balance);
                if quality.error <= open {
                    quality.error = open;
                    return Ok(Refined { jumps, balance, quality });
                }
            }
            if PATIENCE <= idle || MAX_STEPS <= quality.solves {
                return Err(GaveUp::Stalled(quality));
            }
        }
        let Some(shift) = shift(form, balance.missing()) else {
            // Every balance is at its rounding.
            quality.error = ROUNDING * quality.condition;
            break;
        };
        changes = scaled_flows(form, balance.missing(), shift);
        solver.solve(&mut changes).map_err(GaveUp::Solver)?;
        if quality.solves == 0 {
            quality.condition = solver.norm() * inverse_norm(&changes, solver).map_err(GaveUp::Solver)?;
        }
        unscale(form, &mut changes, shift);
        quality.solves += 1;
        for (jump, change) in jumps.iter_mut().zip(edges.changes_of_jumps(&changes)) {
            *jump += DoubleDouble::new(change);
        }
    }
    quality.error = quality.error.max(edges.settle(core, quality.condition.max(1.0), &mut balance));
    Ok(Refined { jumps, balance, quality })
}

/// Progress of the steps.
#[derive(Debug)]
struct Progress {
    change: f64,
    best: f64,
    least: f64,
    idle: usize,
}

impl Default for Progress {
    fn default() -> Self {
        Self { change: f64::INFINITY, best: f64::INFINITY, least: f64::INFINITY, idle: 0 }
    }
}

impl Progress {
    /// The estimated error after a step that changed flows by `change`: the sum of all further changes, a geometric series.
    fn error_after(&mut self, change: f64, accuracy: Accuracy) -> f64 {
        let before = std::mem::replace(&mut self.change, change);
        if !before.is_finite() || change == 0.0 {
            return change;
        }
        let contraction = change / before;
        let further = if contraction < 1.0 { contraction / (1.0 - contraction) } else { f64::INFINITY };
        match accuracy {
            Accuracy::Full => change * further,
            // A bound where each change is no more than half of the previous one.
            Accuracy::Rough => change * further.max(1.0),
        }
    }

    /// The number of consecutive steps without progress, given the largest relative and absolute residuals.
    fn idle_after(&mut self, residual: f64, largest: f64) -> usize {
        let left = residual + self.change;
        // A flow that should be zero has a relative residual of 1 until it is, however small it has become.
        if left < 0.5 * self.best || largest < FALLS * self.least {
            self.best = self.best.min(left);
            self.least = self.least.min(largest);
            self.idle = 0;
        } else {
            self.idle += 1;
        }
        self.idle
    }
}

/// A lower bound estimate of the norm of the inverse of a matrix: its amplification of a first solution, in which slow modes already dominate.
fn inverse_norm(solution: &[f64], solver: &mut dyn Solves) -> Result<f64, NoSolution> {
    let length = |vector: &[f64]| vector.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    let first = length(solution);
    if first == 0.0 {
        return Ok(0.0);
    }
    let mut stretched: Vec<f64> = solution.iter().map(|entry| entry / first).collect();
    solver.solve_roughly(&mut stretched)?;
    Ok(length(&stretched))
}

#[cfg(test)]
mod tests {
    use super::{AT_ROUNDING, GaveUp, PATIENCE, refine};
    use crate::linear::dead_ends::DeadEnds;
    use crate::linear::factor::Solves;
    use crate::linear::iterative::ConjugateGradients;
    use crate::linear::matrix::Pattern;
    use crate::linear::report::{NoSolution, Quality};
    use crate::linear::{Core, Edges, Form, LAST_DIGIT, LinearNetwork, Link, Series};

    /// Conjugate gradients that stagnate after some corrections, the last of which is incomplete.
    ///
    /// This happens on large plates, where rounding hides the last digits of small flows.
    struct Exhausted {
        solver: ConjugateGradients,
        corrections: usize,
        short_by: f64,
    }

    impl Solves for Exhausted {
        fn solve(&mut self, right: &mut [f64]) -> Result<(), NoSolution> {
            let factor = match self.corrections {
                0 => 0.0,
                1 => 1.0 - self.short_by,
                _ => 1.0,
            };
            self.corrections = self.corrections.saturating_sub(1);
            self.solver.solve(right)?;
            for change in right {
                *change *= factor;
            }
            Ok(())
        }

        fn solve_roughly(&mut self, right: &mut [f64]) -> Result<(), NoSolution> {
            self.solver.solve_roughly(right)
        }

        fn is_even(&self) -> bool {
            false
        }

        fn norm(&self) -> f64 {
            self.solver.norm()
        }
    }

    /// A grid between two held edges, whose conductances differ so little that almost nothing flows across.
    fn grid(side: u32, difference: f64) -> LinearNetwork {
        let node = |i: u32, j: u32| i * side + j;
        let mut network = LinearNetwork::of_nodes((side * side) as usize);
        for i in 0..side {
            network.held[node(0, i) as usize] = Some(1.0);
            network.held[node(side - 1, i) as usize] = Some(0.0);
            for j in 0..side {
                let more = 1.0 + difference * f64::from((i * 7 + j * 13) % 11);
                let mut link = |other: u32, conductance: f64| {
                    network.links.push(Link { nodes: [node(i, j), other], conductance });
                };
                if i + 1 < side {
                    link(node(i + 1, j), more);
                }
                if j + 1 < side {
                    link(node(i, j + 1), more);
                }
            }
        }
        network
    }

    fn refined(network: &LinearNetwork, corrections: usize, short_by: f64) -> Result<Quality, GaveUp> {
        let (mut core, _) = Core::merged(network, &|_| false).expect("conductances are finite");
        let series = Series::take_out(&mut core, &DeadEnds::default(), &|_| false);
        let form = Form::choose(&core, &series.is_there, &series.is_free);
        let edges = Edges::new(&core, form, &series.is_there);
        let pattern = Pattern::of(&core, &edges);
        let matrix = pattern.matrix(&core, &edges);
        let mut solver = Exhausted { solver: ConjugateGradients::new(&matrix, LAST_DIGIT), corrections, short_by };
        refine(&core, &edges, &mut solver, LAST_DIGIT).map(|refined| refined.quality)
    }

    /// The residual when the corrections end is more than the rounding of any balance, and less than the rounding error of the flows.
    #[test]
    fn a_solution_at_rounding_is_taken() {
        let network = grid(12, 1e-12);
        let taken = refined(&network, 4, 1e-4).expect("rounding accounts for what is missing");
        assert_eq!(taken.solves, 4 + AT_ROUNDING + 1);
        assert!(LAST_DIGIT < taken.error && taken.error < 1e-11, "{taken:?}");
        assert!(0.0 < taken.residual && taken.residual < LAST_DIGIT, "{taken:?}");
        // Ten times as much is not explained by rounding.
        let refused = refined(&network, 4, 1e-3);
        assert!(matches!(refused, Err(GaveUp::Stalled(quality)) if PATIENCE < quality.solves), "{refused:?}");
        // Nothing falls short.
        assert_eq!(refined(&network, 5, 0.0).map(|quality| (quality.solves, quality.residual)), Ok((4, 0.0)));
    }
}
