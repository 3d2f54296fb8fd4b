//! Reads Abaqus `.inp` decks without losing a byte, and builds the typed model of their contact interfaces.
//!
//! Data flows one way: bytes, [`deck::Deck`], [`model::Model`].
//! [`deck::Scanner`] splits bytes into blocks, [`model::read`] turns the blocks of contact interfaces into typed values,
//! [`mesh::read`] finds the surfaces of contact pairs, and [`json`] writes deck or model as JSON and reads it back.
//! Nothing here opens a file, prints, or stops at bad input: faults of a deck are values ([`Problem`]).
//!
//! The rule numbers in this crate (S-13, T-05, K-52, Q-1, …) are those of the project's semantics,
//! which restate the Abaqus Analysis User's Guide, Keywords Reference Guide and Theory Guide.
//!
//! ```
//! use inpact_parser::deck::scan;
//! use inpact_parser::grammar::Grammar;
//! use inpact_parser::model::{self, Name};
//!
//! let text = b"*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n4000., 0.\n0., 2.\n";
//! let grammar = Grammar::builtin();
//! let deck = scan("joint.inp", text, grammar);
//! let (model, problems) = model::read(&deck, grammar);
//! assert!(problems.is_empty());
//! assert!(model.interactions[&Name::new("joint")].gap_electrical_conductance.is_some());
//! ```

pub use inpact_diagnostics::span;

pub mod grammar;

pub mod deck;

mod problem;

pub mod number;

pub mod expression;

pub mod model;

pub mod mesh;

mod error;
mod format;

pub mod json;

pub use error::Error;
pub use format::{format, format_edits};
pub use problem::{LongNumber, Problem, ProblemKind};
