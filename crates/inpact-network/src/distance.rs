//! The distance between two states of one scene.

use crate::problem::{FieldNodes, Problem};
use crate::scene::Field;
use crate::state::{FieldState, State};

/// Below this fraction of the surrounding flows a flow is the residue of refinement in 106 bits.
const NOTHING: f64 = 1e-20;

/// The distance between two states, of their numbers as printed: those that print alike are equal.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distance {
    /// The largest difference of a node's value, relative to the range of the other state's values of that field, or to their magnitude where they are all equal.
    pub values: f64,
    /// The largest difference of a flow through a link or an interface, relative to the larger of the two; differences below 1e-20 of the flows around it are ignored.
    pub flows: f64,
}

impl Distance {
    /// The larger of two distances.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self { values: self.values.max(other.values), flows: self.flows.max(other.flows) }
    }
}

impl State {
    /// The distance from another state of the same problem.
    pub fn distance(&self, problem: &Problem<'_>, other: &Self) -> Distance {
        let of_field = |field: Field| {
            let (nodes, found, wanted) = (problem.field(field)?, self.field(field)?, other.field(field)?);
            let flows = distance_of_flows(problem, field, nodes, (found, wanted));
            Some(Distance { values: distance_of_values(found, wanted), flows })
        };
        Field::ALL.into_iter().filter_map(of_field).fold(Distance::default(), Distance::max)
    }
}

fn distance_of_values(found: &FieldState, wanted: &FieldState) -> f64 {
    let least = wanted.values().fold(f64::INFINITY, f64::min);
    let greatest = wanted.values().fold(f64::NEG_INFINITY, f64::max);
    let size = if least < greatest { greatest - least } else { greatest.abs() };
    let differences = found.values().zip(wanted.values()).map(|(found, wanted)| (found - wanted).abs());
    differences.map(|difference| if difference == 0.0 { 0.0 } else { difference / size }).fold(0.0, f64::max)
}

/// A flow that is zero up to rounding has no digits to compare. Its rounding is a small fraction of the flow through its conductance at the
/// values of its ends, and of the flow through the end with less flow: a strong conductance to such an end is known with all its digits.
fn distance_of_flows(
    problem: &Problem<'_>,
    field: Field,
    nodes: &FieldNodes,
    (found, wanted): (&FieldState, &FieldState),
) -> f64 {
    let scene = problem.scene;
    let of_links = nodes.links.iter().map(|&link| scene.links[link as usize].conductances[field.index()]);
    let conductances = of_links.chain(wanted.rows.iter().copied());
    let of_nodes =
        |ends: [u32; 2], of: &[f64]| -> [f64; 2] { ends.map(|node| of[nodes.place[node as usize] as usize]) };
    let values: Vec<f64> = wanted.values().collect();
    let through = through(problem, field, nodes, wanted);
    let flows = |of: &FieldState| of.solution.flows.iter().map(|flow| flow.to_f64()).collect::<Vec<f64>>();
    let mut largest = 0.0_f64;
    for ((ends, conductance), (found, wanted)) in
        nodes.ends(scene).zip(conductances).zip(flows(found).into_iter().zip(flows(wanted)))
    {
        let [one, other] = of_nodes(ends, &values).map(f64::abs);
        let quieter = of_nodes(ends, &through).into_iter().fold(f64::INFINITY, f64::min);
        // Between values of zero an infinite conductance carries any flow.
        let rounding = NOTHING * quieter.min(conductance * one.max(other));
        let difference = (found - wanted).abs();
        if rounding < difference {
            largest = largest.max(difference / found.abs().max(wanted.abs()));
        }
    }
    largest
}

/// The largest term of the balance of each node; unbounded for held nodes and nodes with a capacity.
fn through(problem: &Problem<'_>, field: Field, nodes: &FieldNodes, state: &FieldState) -> Vec<f64> {
    let (scene, conditions) = (problem.scene, problem.scene.conditions(field));
    let mut through: Vec<f64> = state.sources.iter().map(|source| source.abs()).collect();
    for (ends, flow) in nodes.ends(scene).zip(&state.solution.flows) {
        for end in ends {
            let part = &mut through[nodes.place[end as usize] as usize];
            *part = part.max(flow.to_f64().abs());
        }
    }
    for (node, part) in nodes.nodes.iter().zip(&mut through) {
        if conditions.fixed.contains_key(node) || conditions.capacities.contains_key(node) {
            *part = f64::INFINITY;
        }
    }
    through
}
