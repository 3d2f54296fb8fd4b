//! How far two states of one scene are from each other.

use crate::problem::{FieldNodes, Problem};
use crate::scene::Field;
use crate::state::{FieldState, NOTHING, State};

/// How far a state is from another, as numbers are printed: those that print alike are alike.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distance {
    /// The largest difference of a node's value, as a part of the range of the other state's values of that field; where that is one value, as a part of its magnitude.
    pub values: f64,
    /// The largest difference of a flow through a link or an interface, as a part of the larger of the two; differences that are the rounding of 106 bits are none.
    pub flows: f64,
}

impl Distance {
    /// The larger of two distances.
    pub fn max(self, other: Self) -> Self {
        Self { values: self.values.max(other.values), flows: self.flows.max(other.flows) }
    }
}

impl State {
    /// How far it is from another state of the same problem.
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

/// A flow that is zero but for rounding has no digits to compare: its rounding is a part of what its conductance would let through at the values of its ends, and of what flows there.
fn distance_of_flows(
    problem: &Problem<'_>,
    field: Field,
    nodes: &FieldNodes,
    (found, wanted): (&FieldState, &FieldState),
) -> f64 {
    let scene = problem.scene;
    let of_links = nodes.links.iter().map(|&link| {
        let of = &scene.links[link as usize];
        (of.nodes, of.conductances[field.index()])
    });
    let of_rows = nodes.rows.iter().zip(&wanted.rows).map(|(&row, &conductance)| {
        let of = &scene.interfaces[row as usize];
        ([of.slave, of.master], conductance)
    });
    let ends: Vec<([usize; 2], f64)> = of_links
        .chain(of_rows)
        .map(|(ends, conductance)| (ends.map(|node| nodes.place[node as usize] as usize), conductance))
        .collect();
    let values: Vec<f64> = wanted.values().collect();
    let flows = |of: &FieldState| of.solution.flows.iter().map(|flow| flow.to_f64()).collect::<Vec<f64>>();
    let (found, wanted) = (flows(found), flows(wanted));
    let mut through = vec![0.0_f64; values.len()];
    for ((ends, _), flow) in ends.iter().zip(&wanted) {
        for &end in ends {
            through[end] = through[end].max(flow.abs());
        }
    }
    let mut largest = 0.0_f64;
    for (&(ends, conductance), (found, wanted)) in ends.iter().zip(found.into_iter().zip(wanted)) {
        let most = |of: &[f64]| of[ends[0]].abs().max(of[ends[1]].abs());
        // An infinite conductance between values of zero lets through what flows there.
        let rounding = NOTHING * most(&through).min(conductance * most(&values));
        let difference = (found - wanted).abs();
        if rounding < difference {
            largest = largest.max(difference / found.abs().max(wanted.abs()));
        }
    }
    largest
}
