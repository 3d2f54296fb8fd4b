//! The method, size and quality of a solution, and the reasons why methods fail: plain values.

use super::ordering::Ordering;
use super::work::{Phases, Work};
use std::fmt;

/// The tolerance of the last digit of f64.
pub const LAST_DIGIT: f64 = f64::EPSILON / 16.0;

/// Methods of solving a network.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// A Cholesky factor in f64.
    #[default]
    Direct,
    /// A Cholesky factor in f32: half the memory and, in three dimensions, about half the time.
    Mixed,
    /// Conjugate gradients with an incomplete factor: memory of a few entries per node.
    Iterative,
    /// Subtraction-free (GTH) elimination in 106 bits: slow, and exact at any contrast, except where a jump exceeds the range of f64 or jumps of opposite sign nearly cancel, which it rejects.
    Elimination,
}

/// Method, size and quality of a solution.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct LinearReport {
    /// The method that gave it.
    pub method: Method,
    /// The permitted relative error of a flow.
    pub tolerance: f64,
    /// The number of unknowns.
    pub unknowns: usize,
    /// The number of unknowns that are jumps from another node.
    pub relative: usize,
    /// The number of levels of strength of the conductances.
    pub levels: usize,
    /// The number of nodes merged with another by an infinite conductance.
    pub merged: usize,
    /// The number of nodes eliminated in series: they only pass on the flow.
    pub taken_out: usize,
    /// The number of nodes in dead ends: no flow reaches them, and they have the value of another.
    pub dead_ends: usize,
    /// The number of infinite conductances that close cycles, so that the distribution of their flow is undetermined; they share it as equal ones would.
    pub shared: usize,
    /// The order of elimination, where there was a factor.
    pub ordering: Option<Ordering>,
    /// Entries of the factor.
    pub factor_entries: usize,
    /// Results of the previous network that were reused.
    pub reused: Reused,
    /// Iterations of conjugate gradients.
    pub iterations: usize,
    /// Residual and estimated error; elimination has no estimate.
    pub quality: Quality,
    /// The methods that were tried before, and why they failed.
    pub given_up: Vec<(Method, MethodFailure)>,
    /// Time of each phase.
    pub phases: Phases,
}

/// Measures of the error of a solution.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Quality {
    /// The number of solves.
    pub solves: usize,
    /// The largest residual of a balance relative to its flows, except balances at their rounding.
    pub residual: f64,
    /// An estimate of the largest relative error of a flow, before rounding to f64.
    pub error: f64,
    /// A lower bound estimate of the condition number of the scaled matrix.
    pub condition: f64,
}

/// Results of the previous network that were reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Reused {
    /// None.
    #[default]
    Nothing,
    /// The order of elimination.
    Order,
    /// The order and the factor: only sources and held values differ.
    Factor,
}

/// Reasons why a method failed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MethodFailure {
    /// It could not start.
    NoSolution(NoSolution),
    /// It came no nearer than this.
    Stalled(Quality),
    /// A flow, or its approximation by an inaccurate factor, is beyond the range of f64.
    Overflow,
    /// The filled network would be too large.
    TooLarge {
        /// The maximum fill-in.
        most: usize,
    },
    /// There are too many different held values: every two of them would be neighbours.
    TooManyHeld {
        /// The number of different ones.
        found: usize,
        /// The most that there may be.
        most: usize,
    },
}

/// Reasons why a factorisation or iteration has no solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoSolution {
    /// A pivot was not positive: rounding has made the matrix indefinite.
    Pivot,
    /// There is not enough memory.
    Memory,
    /// Iterations did not converge.
    Iterations,
}

impl LinearReport {
    /// The work of one solution.
    pub(super) fn work(&self) -> Work {
        Work { networks: 1, solves: self.quality.solves, iterations: self.iterations, phases: self.phases }
    }
}

impl From<NoSolution> for MethodFailure {
    fn from(reason: NoSolution) -> Self {
        Self::NoSolution(reason)
    }
}

impl fmt::Display for Method {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Direct => "direct",
            Self::Mixed => "mixed",
            Self::Iterative => "iterative",
            Self::Elimination => "elimination",
        })
    }
}

impl fmt::Display for NoSolution {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Pivot => "a pivot was not above zero",
            Self::Memory => "there is not enough memory",
            Self::Iterations => "the iterations did not converge",
        })
    }
}

impl fmt::Display for MethodFailure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSolution(reason) => reason.fmt(formatter),
            Self::Stalled(Quality { residual, error, .. }) => {
                write!(formatter, "it came no nearer than a residual of {residual:.1e} and an error of {error:.1e}")
            }
            Self::Overflow => formatter.write_str("a value or a flow is beyond the range of f64"),
            Self::TooLarge { most } => write!(
                formatter,
                "it would need room for more than {most} conductances between nodes that are not neighbours"
            ),
            Self::TooManyHeld { found, most } => {
                write!(formatter, "{found} different values are held, and it takes no more than {most}")
            }
        }
    }
}
