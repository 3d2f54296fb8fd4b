//! Failures of a scene, in its own terms.

use crate::assembly::RowFault;
use crate::linear::{LinearFailure, Method, Shortcoming, Unsolvable};
use crate::problem::FieldNodes;
use crate::scene::Field;

/// Reasons why a scene was not solved.
#[derive(Debug, Clone, PartialEq)]
pub enum SolveFailure {
    /// Bodies without a path to a fixed value: the field, and the nodes of each body, by their numbers in the scene.
    Floating {
        /// The field.
        field: Field,
        /// The nodes.
        components: Vec<Vec<u32>>,
    },
    /// Nodes that are one are held at different values.
    Contradiction {
        /// The field.
        field: Field,
        /// The nodes.
        nodes: [u32; 2],
        /// Their held values.
        values: [f64; 2],
    },
    /// A law of a row gives nothing that can be solved with.
    Row(RowFault),
    /// No linear solver came within the tolerance.
    NotSolved {
        /// The field.
        field: Field,
        /// The methods tried, each with the reason of its failure.
        tried: Vec<(Method, Shortcoming)>,
    },
    /// A temperature would be below absolute zero.
    BelowAbsoluteZero {
        /// The node.
        node: u32,
        /// Its temperature, θ.
        value: f64,
        /// Absolute zero, θ.
        zero: f64,
    },
    /// Newton's iteration did not converge.
    NotConverged {
        /// The number of steps.
        steps: usize,
        /// For each field where most is missing: the share of its largest flow, and the node.
        worst: Vec<(Field, f64, Option<u32>)>,
        /// The relative distance of the conductances from those of the state, where its balances are met.
        inconsistency: Option<f64>,
    },
}

impl SolveFailure {
    /// Whether an increment that is shorter may not fail so.
    pub(crate) fn may_be_of_length(&self) -> bool {
        matches!(self, Self::NotConverged { .. } | Self::BelowAbsoluteZero { .. })
    }
}

/// A failure in terms of the scene.
pub(super) fn failed(field: Field, nodes: &FieldNodes, failure: LinearFailure) -> SolveFailure {
    let node = |place: u32| nodes.nodes[place as usize];
    match failure {
        LinearFailure::Unsolvable(Unsolvable::Floating(components)) => {
            let components =
                components.into_iter().map(|component| component.into_iter().map(node).collect()).collect();
            SolveFailure::Floating { field, components }
        }
        LinearFailure::Unsolvable(Unsolvable::Contradiction { nodes, values }) => {
            SolveFailure::Contradiction { field, nodes: nodes.map(node), values }
        }
        LinearFailure::NotSolved(tried) => SolveFailure::NotSolved { field, tried },
    }
}
