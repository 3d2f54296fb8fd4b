//! The solution of a linear network.

use super::network::LinearNetwork;
use super::report::LinearReport;
use super::sets::index;
use inpact_evaluation::numbers::DoubleDouble;

/// The solution of a linear network.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearSolution {
    /// The value of each node.
    pub values: Vec<DoubleDouble>,
    /// The flow through each link, from its first to its second node.
    pub flows: Vec<DoubleDouble>,
    /// The flow into each store.
    pub stored: Vec<DoubleDouble>,
    /// The links whose flow does not determine the jump, ascending, and the jump across each.
    pub(super) undetermined: Vec<(u32, DoubleDouble)>,
    /// Method, size and quality of the solution.
    pub report: LinearReport,
}

impl LinearSolution {
    /// The jump across a link of the network that was solved, first node minus second, with all its digits: not a difference of values.
    pub fn jump(&self, network: &LinearNetwork, link: usize) -> DoubleDouble {
        self.jump_at(link, network.links[link].conductance)
    }

    /// Whether all of it is in the range of f64.
    pub(super) fn is_finite(&self) -> bool {
        let all = self.values.iter().chain(&self.flows).chain(&self.stored);
        all.into_iter().all(|number| number.to_f64().is_finite())
    }

    /// The jump across a link of this conductance.
    pub(crate) fn jump_at(&self, link: usize, conductance: f64) -> DoubleDouble {
        if conductance == f64::INFINITY {
            return DoubleDouble::ZERO;
        }
        match self.undetermined.binary_search_by_key(&index(link), |(number, _)| *number) {
            Ok(place) => self.undetermined[place].1,
            Err(_) => self.flows[link] / DoubleDouble::new(conductance),
        }
    }
}
