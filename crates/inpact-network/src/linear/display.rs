//! Names of methods and reasons of failure as users read them.

use super::elimination::MOST_FILLED;
use super::factor::NoSolution;
use super::network::Unsolvable;
use super::refinement::Quality;
use super::solve::{LinearFailure, Method, Shortcoming};
use std::error::Error;
use std::fmt;

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

impl fmt::Display for Shortcoming {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSolution(reason) => reason.fmt(formatter),
            Self::Stalled(Quality { residual, error, .. }) => {
                write!(formatter, "it came no nearer than a residual of {residual:.1e} and an error of {error:.1e}")
            }
            Self::Overflow => formatter.write_str("a value or a flow is beyond the range of f64"),
            Self::TooLarge => write!(
                formatter,
                "it would need room for more than {MOST_FILLED} conductances between nodes that are not neighbours"
            ),
        }
    }
}

impl fmt::Display for Unsolvable {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Floating(components) => {
                write!(formatter, "{} of its connected components have no path to a known value", components.len())
            }
            Self::Contradiction { nodes: [a, b], values: [x, y] } => {
                write!(formatter, "infinite conductances join node {a}, held at {x:?}, and node {b}, held at {y:?}")
            }
        }
    }
}

impl fmt::Display for LinearFailure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unsolvable(reason) => reason.fmt(formatter),
            Self::NotSolved(tried) => {
                formatter.write_str("no method solved it")?;
                tried.iter().try_for_each(|(method, why)| write!(formatter, "; {method}: {why}"))
            }
        }
    }
}

impl Error for Unsolvable {}

impl Error for LinearFailure {}
