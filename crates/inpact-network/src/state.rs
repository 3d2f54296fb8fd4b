//! The state of a scene at one time: values, flows, and the report of their solution.

use crate::linear::{LinearReport, LinearSolution};
use crate::problem::Problem;
use crate::scene::Field;
use inpact_evaluation::numbers::DoubleDouble;

/// The state of a scene at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// The time; 0 in a steady state.
    pub time: f64,
    /// The number of the increment that led to it; 0 for the first state.
    pub increment: i32,
    /// The values of each field, by [`Field`].
    pub(crate) fields: [Option<FieldState>; 3],
    /// The solution of each group of fields that were solved together.
    pub reports: Vec<StageReport>,
}

/// The state of one field.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FieldState {
    /// Values of its nodes; flows through its links, then through its rows; flows into stores.
    pub(crate) solution: LinearSolution,
    /// The conductance times area of each row; infinite where both sides have one value.
    pub(crate) rows: Vec<f64>,
    /// The source of each node, heat of interfaces included.
    pub(crate) sources: Vec<f64>,
}

/// The solution of a group of fields.
#[derive(Debug, Clone, PartialEq)]
pub struct StageReport {
    /// The fields.
    pub fields: Vec<Field>,
    /// The number of Newton steps; 0 for a linear stage.
    pub iterations: usize,
    /// The relative distance of the conductances from those at the solution.
    pub inconsistency: f64,
    /// The last linear solution of each field.
    pub linear: Vec<LinearReport>,
}

impl FieldState {
    /// The values of its nodes as f64.
    pub(crate) fn values(&self) -> impl Iterator<Item = f64> {
        self.solution.values.iter().map(|value| value.to_f64())
    }
}

impl State {
    pub(crate) fn field(&self, field: Field) -> Option<&FieldState> {
        self.fields[field.index()].as_ref()
    }

    /// The value of a field at a node of the scene; `None` where it is not solved for.
    pub fn value(&self, problem: &Problem<'_>, field: Field, node: u32) -> Option<f64> {
        self.exact_value(problem, field, node).map(number)
    }

    pub(crate) fn exact_value(&self, problem: &Problem<'_>, field: Field, node: u32) -> Option<DoubleDouble> {
        let place = problem.field(field)?.place[node as usize];
        self.field(field)?.solution.values.get(place as usize).copied()
    }

    /// The flow through a link of the scene, from its first to its second node; `None` where the field is not solved or the link does not conduct it.
    pub fn link_flow(&self, problem: &Problem<'_>, field: Field, link: u32) -> Option<f64> {
        let place = problem.field(field)?.links.binary_search(&link).ok()?;
        Some(number(self.field(field)?.solution.flows[place]))
    }

    /// The flow through an interface row by its conductance, from slave to master; without the heat and fluid generated there.
    pub fn row_flow(&self, problem: &Problem<'_>, field: Field, row: u32) -> Option<f64> {
        let nodes = problem.field(field)?;
        let place = nodes.rows.binary_search(&row).ok()?;
        Some(number(self.field(field)?.solution.flows[nodes.links.len() + place]))
    }

    /// The conductance of an interface row for a field, times its area; `None` where the field is not solved or does not cross it.
    pub(crate) fn conductance(&self, problem: &Problem<'_>, field: Field, row: u32) -> Option<f64> {
        let place = problem.field(field)?.rows.binary_search(&row).ok()?;
        self.field(field)?.rows.get(place).copied()
    }

    /// The jump of a field across an interface row, slave − master, with all its known digits.
    pub fn row_jump(&self, problem: &Problem<'_>, field: Field, row: u32) -> Option<f64> {
        let nodes = problem.field(field)?;
        let state = self.field(field)?;
        let sides = problem.scene.interfaces[row as usize].nodes();
        let [slave, master] = sides.map(|node| self.exact_value(problem, field, node));
        let values = [slave?, master?];
        let jump = match nodes.rows.binary_search(&row) {
            Ok(place) => state.solution.jump_at(nodes.links.len() + place, state.rows[place]),
            Err(_) => values[0] - values[1],
        };
        Some(number(jump))
    }

    /// Whether both sides of a row have one value, by an infinite conductance.
    pub fn is_constrained(&self, problem: &Problem<'_>, field: Field, row: u32) -> bool {
        let place = problem.field(field).and_then(|nodes| nodes.rows.binary_search(&row).ok());
        place.zip(self.field(field)).is_some_and(|(place, state)| state.rows[place] == f64::INFINITY)
    }

    /// The flow that leaves each node of a field through links and rows, minus its sources; zero except at held values and stores.
    pub(crate) fn leaving(&self, problem: &Problem<'_>, field: Field) -> Vec<DoubleDouble> {
        let (Some(nodes), Some(state)) = (problem.field(field), self.field(field)) else { return Vec::new() };
        let mut leaving: Vec<DoubleDouble> = state.sources.iter().map(|&source| -DoubleDouble::new(source)).collect();
        let place = |node: u32| nodes.place[node as usize] as usize;
        for (ends, &flow) in nodes.ends(problem.scene).zip(&state.solution.flows) {
            leaving[place(ends[0])] += flow;
            leaving[place(ends[1])] -= flow;
        }
        leaving
    }

    /// The supply of each held node of a field: the flow that leaves it, less its sources.
    pub fn supplies(&self, problem: &Problem<'_>, field: Field) -> Vec<(u32, f64)> {
        let Some(nodes) = problem.field(field) else { return Vec::new() };
        let fixed = &problem.scene.conditions(field).fixed;
        let leaving = self.leaving(problem, field);
        let held = nodes.nodes.iter().zip(&leaving).filter(|(node, _)| fixed.contains_key(node));
        held.map(|(&node, &leaving)| (node, number(leaving))).collect()
    }

    /// The balance of a field: supply and withdrawal at fixed values, sources, and storage; they sum to zero up to rounding.
    pub fn balance(&self, problem: &Problem<'_>, field: Field) -> Option<FieldBalance> {
        let (nodes, state) = (problem.field(field)?, self.field(field)?);
        let fixed = &problem.scene.conditions(field).fixed;
        let leaving = self.leaving(problem, field);
        let held = nodes.nodes.iter().zip(&leaving).filter(|(node, _)| fixed.contains_key(node));
        let held: Vec<DoubleDouble> = held.map(|(_, leaving)| *leaving).collect();
        let generated: Vec<DoubleDouble> = state.sources.iter().map(|&source| DoubleDouble::new(source)).collect();
        let stored = &state.solution.stored;
        let sum = |parts: &[DoubleDouble]| parts.iter().copied().sum::<DoubleDouble>();
        let turnover: DoubleDouble = [&held, &generated, stored].into_iter().flatten().map(|part| part.abs()).sum();
        // A sum below the rounding of the whole is zero.
        let sizable =
            |sum: DoubleDouble| if sum.to_f64().abs() <= NOTHING * turnover.to_f64() { 0.0 } else { number(sum) };
        let (supplied, withdrawn): (Vec<DoubleDouble>, Vec<DoubleDouble>) =
            held.iter().partition(|part| part.to_f64() > 0.0);
        Some(FieldBalance {
            supplied: sizable(sum(&supplied)),
            withdrawn: sizable(-sum(&withdrawn)),
            generated: sizable(sum(&generated)),
            stored: sizable(sum(stored)),
            missing: (sum(&held) + sum(&generated) - sum(stored)).to_f64(),
            turnover: turnover.to_f64(),
        })
    }
}

/// The fraction of the turnover below which a sum is rounding.
const NOTHING: f64 = 1e-27;

/// The nearest f64 to a number in 106 bits; zero is +0, not −0.
fn number(value: DoubleDouble) -> f64 {
    value.to_f64() + 0.0
}

/// The balance of one field over the whole scene, per time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldBalance {
    /// Inflow at fixed values.
    pub supplied: f64,
    /// Outflow at fixed values.
    pub withdrawn: f64,
    /// Sources, interfaces included.
    pub generated: f64,
    /// Storage.
    pub stored: f64,
    /// Supplied and generated minus withdrawn and stored: zero up to rounding.
    pub missing: f64,
    /// The sum of the magnitudes of all of these at their nodes, to which the imbalance is compared.
    pub turnover: f64,
}
