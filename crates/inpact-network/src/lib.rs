//! Solves networks of nodes that are coupled by the interface laws of a deck.

mod assembly;
mod distance;
mod interface;
mod knowledge;
pub mod linear;
mod newton;
mod problem;
pub mod scene;
mod solve;
mod state;
pub mod tables;
pub mod transient;

pub use assembly::{RowFault, RowFaultReason};
pub use distance::Distance;
pub use problem::Problem;
pub use solve::{Equations, SolveFailure};
pub use state::{FieldBalance, StageReport, State};
