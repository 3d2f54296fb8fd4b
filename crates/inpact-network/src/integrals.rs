//! Time integrals of the flows at the rows, and the error that an increment adds.
//!
//! ECDT, HTL and PTL are integrated by backward Euler, the flow at the end of an increment times its length h (O-5): the error of one is h/2 · |q₁ − q₀| to first order.
//! SJDT takes the mean of Δφ² over the increment and the conductance at its end (H-08), so that its error is h/2 · |σ₁ − σ₀| times that mean.
//! Errors are relative to the largest integral of their kind, taken by magnitude so that flows of alternating sign do not cancel.

use crate::problem::Problem;
use crate::scene::Field;
use crate::state::State;

/// The integrals: of current, of its heat, of heat, of pore fluid.
const KINDS: usize = 4;

/// Flows below this fraction of the conductance times the values of its sides are rounding.
const ROUNDING: f64 = 1e-16;

/// Flows through the rows at one state.
#[derive(Debug, Clone, Default)]
pub(crate) struct RowFlows {
    /// By kind, the flow in each row; for the heat of currents the conductances.
    flows: [Vec<f64>; KINDS],
    /// The jumps of potential.
    jumps: Vec<f64>,
    /// By kind, a bound below which a flow is rounding.
    rounding: [f64; KINDS],
}

/// The integrals so far and their errors, by kind.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Integrals {
    /// The largest flow, or an estimate of it at the next kink.
    reach: [f64; KINDS],
    sum: [f64; KINDS],
    error: [f64; KINDS],
}

/// The integrals and their errors over one increment.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Added {
    amount: [f64; KINDS],
    error: [f64; KINDS],
    rounding: [f64; KINDS],
}

impl RowFlows {
    /// The flows of a state.
    pub(crate) fn of(problem: &Problem<'_>, state: &State) -> Self {
        let mut found = Self::default();
        for (field, kind) in [(Field::Potential, 0), (Field::Temperature, 2), (Field::PorePressure, 3)] {
            let Some(nodes) = problem.field(field) else { continue };
            for &row in &nodes.rows {
                let flow = state.row_flow(problem, field, row).unwrap_or(0.0);
                found.flows[kind].push(flow);
                let sides = problem.scene.interfaces[row as usize].nodes();
                let [slave, master] = sides.map(|node| state.value(problem, field, node).map_or(0.0, f64::abs));
                let conductance = state.conductance(problem, field, row).unwrap_or(0.0);
                let rounding = ROUNDING * conductance * slave.max(master);
                if rounding.is_finite() {
                    found.rounding[kind] = found.rounding[kind].max(rounding);
                }
                if field == Field::Potential {
                    let jump = state.row_jump(problem, field, row).unwrap_or(0.0);
                    found.flows[1].push(conductance);
                    found.jumps.push(jump);
                    let rounding = rounding * slave.max(master);
                    if rounding.is_finite() {
                        found.rounding[1] = found.rounding[1].max(rounding);
                    }
                }
            }
        }
        found
    }
}

impl Added {
    /// The integrals over an increment of this length between two states.
    pub(crate) fn between(before: &RowFlows, after: &RowFlows, duration: f64) -> Self {
        let mut added = Self::default();
        for kind in 0..KINDS {
            let pairs = before.flows[kind].iter().zip(&after.flows[kind]);
            for (row, (&start, &end)) in pairs.enumerate() {
                let factor = if kind == 1 {
                    let (first, last) = (before.jumps[row], after.jumps[row]);
                    (first * first + first * last + last * last) / 3.0
                } else {
                    1.0
                };
                let amount = factor * duration * end.abs();
                let error = factor * 0.5 * duration * (end - start).abs();
                added.amount[kind] = added.amount[kind].max(if amount.is_finite() { amount } else { 0.0 });
                added.error[kind] = added.error[kind].max(if error.is_finite() { error } else { 0.0 });
            }
            added.rounding[kind] = duration * before.rounding[kind].max(after.rounding[kind]);
        }
        added
    }
}

impl Integrals {
    /// Includes an increment to the next kink in the magnitude of the integrals.
    pub(crate) fn reach(&mut self, added: &Added) {
        for (kind, reach) in self.reach.iter_mut().enumerate() {
            *reach = reach.max(self.sum[kind] + added.amount[kind]);
        }
    }

    /// The largest error of an increment, relative to the integrals.
    pub(crate) fn share(&self, added: &Added) -> f64 {
        let share = |kind: usize| {
            let size = self.reach[kind].max(self.sum[kind] + added.amount[kind]).max(added.rounding[kind]);
            if size > 0.0 { added.error[kind] / size } else { 0.0 }
        };
        (0..KINDS).map(share).fold(0.0, f64::max)
    }

    /// Accepts an increment.
    pub(crate) fn add(&mut self, added: &Added) {
        for kind in 0..KINDS {
            self.sum[kind] += added.amount[kind];
            self.error[kind] += if added.rounding[kind] < added.amount[kind] { added.error[kind] } else { 0.0 };
        }
    }

    /// The estimated error of all increments so far, relative to the integrals; the largest of any kind.
    pub(crate) fn error(&self) -> f64 {
        let share = |kind: usize| if self.sum[kind] > 0.0 { self.error[kind] / self.sum[kind] } else { 0.0 };
        (0..KINDS).map(share).fold(0.0, f64::max)
    }
}
