//! The commands, one file each: arguments, and the way from them to a result.

pub(crate) mod body;
pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod eval;
pub(crate) mod explain;
pub(crate) mod fmt;
pub(crate) mod inp;
pub(crate) mod interfaces;
pub(crate) mod json;
pub(crate) mod nodes;
pub(crate) mod plan;
pub(crate) mod plot;
pub(crate) mod report;
pub(crate) mod scene;
#[cfg(feature = "server")]
pub(crate) mod server;
pub(crate) mod shell;
pub(crate) mod solve;
pub(crate) mod tradeoff;

mod choice;
mod decks;
mod drawing;
pub(crate) mod evaluable;
pub(crate) mod findings;
pub(crate) mod job_results;
mod joule_heat;
pub(crate) mod laws;
pub(crate) mod mesh_rows;
pub(crate) mod meshed;
mod node_sample;
mod picture;
pub(crate) mod solvable;
mod table_output;
