//! Parts of a law that the plan drops.

use super::reason::Reason;

/// A part of a law that the plan drops.
#[derive(Debug, Clone, PartialEq)]
pub struct Dropped {
    /// Its name.
    pub what: String,
    /// The cost saved, in nanoseconds for each row of the interaction.
    pub cost: f64,
    /// The reason.
    pub reason: Reason,
}

impl Dropped {
    pub(super) fn not_requested(what: &str, cost: f64) -> Self {
        Self { what: what.to_owned(), cost, reason: Reason::NotRequested }
    }
}
