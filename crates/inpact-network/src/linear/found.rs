//! The solution of a core, before it is mapped back to the network.

use super::spanning_forest::SpanningForest;
use inpact_evaluation::numbers::DoubleDouble;

/// Flows up to this have lost digits to underflow.
pub(super) const SMALL: f64 = f64::MIN_POSITIVE / f64::EPSILON / f64::EPSILON;

/// The solution of a core: values of its free nodes, flows of its elements.
pub(super) struct CoreFound {
    pub(super) values: Vec<DoubleDouble>,
    pub(super) flows: Vec<DoubleDouble>,
    /// The spanning forest with its jumps; `None` for elimination.
    pub(super) forest: Option<SpanningForest>,
}
