//! Times and counts of a solution, and their sums over many.

use std::ops::AddAssign;
use std::time::Duration;

/// A monotonic clock of the caller: the time since some instant. No other clock is read here.
pub type Clock = fn() -> Duration;

/// A clock that measures nothing.
pub(super) fn no_clock() -> Duration {
    Duration::ZERO
}

/// The time since this reading of a clock, in seconds.
pub(super) fn seconds_since(clock: Clock, then: Duration) -> f64 {
    clock().saturating_sub(then).as_secs_f64()
}

/// Times of the phases of a solution, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phases {
    /// Reduction, choice of unknowns, assembly.
    pub set_up: f64,
    /// Ordering and symbolic analysis; 0 where that was reused.
    pub order: f64,
    /// Numeric factorisation; 0 where that was reused.
    pub factor: f64,
    /// Solving and refining.
    pub solve: f64,
}

/// Total work of solving some networks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// The number of networks.
    pub networks: usize,
    /// Solves of refinements.
    pub solves: usize,
    /// Iterations of conjugate gradients.
    pub iterations: usize,
    /// Time of each phase.
    pub phases: Phases,
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
