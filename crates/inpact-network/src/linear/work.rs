//! What solving took: parts of a solution, and sums over many.

use super::solve::LinearReport;
use std::ops::AddAssign;

/// How long the parts of a solution took, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phases {
    /// Leaving out what can be left out, choosing unknowns, assembling.
    pub set_up: f64,
    /// Ordering and analysing; nothing where that was kept.
    pub order: f64,
    /// Factoring; nothing where that was kept.
    pub factor: f64,
    /// Solving and refining.
    pub solve: f64,
}

/// What the solution of some networks took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// How many networks there were.
    pub networks: usize,
    /// Solves of refinements.
    pub solves: usize,
    /// Iterations of conjugate gradients.
    pub iterations: usize,
    /// How long their parts took.
    pub phases: Phases,
}

impl Work {
    pub(super) fn of(report: &LinearReport) -> Self {
        let LinearReport { quality, iterations, phases, .. } = report;
        Self { networks: 1, solves: quality.solves, iterations: *iterations, phases: *phases }
    }
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.networks += other.networks;
        self.solves += other.solves;
        self.iterations += other.iterations;
        self.phases += other.phases;
    }
}

impl AddAssign for Phases {
    fn add_assign(&mut self, other: Self) {
        self.set_up += other.set_up;
        self.order += other.order;
        self.factor += other.factor;
        self.solve += other.solve;
    }
}
