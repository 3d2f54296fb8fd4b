//! Rows of a batch as the laws see them: the part of one interaction, its numbers by name, the outcome of each row, and counts.
//!
//! Knows no law and no evaluation: the columnar laws and the evaluation that calls them both build on it.

mod binder;
mod outcome;
mod part;
mod tally;
mod totals;

pub use tally::{AxisTally, InteractionTally, RemarkedRows, Tally, UserFaultInRow};
pub use totals::Totals;

pub(crate) use binder::{Binder, numbers};
pub(crate) use outcome::{Outcome, contact_status};
pub(crate) use part::{Part, Row, mean_mass_flow_of};
pub(crate) use tally::{PERMEABILITY, THERMAL_CONDUCTANCE, VIEW_FACTOR};
pub(crate) use totals::summed;
