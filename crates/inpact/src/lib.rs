//! Checks, converts, evaluates and solves the contact interfaces of Abaqus input decks.
//!
//! The facade of the other crates: decks with their included files and configuration; findings and their fixes; JSON both ways; the pages of `explain`;
//! interface laws over record batches; scenes.
//! Each is built on a crate that works without files and settings, and can be used on its own: `inpact-parser`, `inpact-validation`, `inpact-evaluation`,
//! `inpact-contact`, `inpact-network`.
//! The command line is [`cli::run`].
//!
//! ```
//! use inpact::{Deck, ReadOptions};
//!
//! let text = "\
//! *SURFACE INTERACTION, NAME=JOINT
//! *GAP ELECTRICAL CONDUCTANCE
//! 4000., 0.
//! 0., -2.
//! ";
//! let deck = Deck::parse("joint.inp", text, &ReadOptions::new().isolated())?;
//! let found = deck.check();
//! assert_eq!(found[0].code, "T001");
//! assert_eq!(found[0].primary.line(), Some(4));
//! # Ok::<(), inpact::Error>(())
//! ```

pub mod cli;
pub mod curves;
pub mod pages;

/// A conductance defined by the caller, in place of user subroutine GAPELECTR.
pub mod user {
    pub use inpact_evaluation::law::{
        NAME_LENGTH, UserConductance, UserConductancePoint, UserConductanceValue, UserFault, UserName, UserNames,
    };
}

mod deck;
mod error;
#[cfg(feature = "columnar")]
mod evaluation;
mod fixes;

mod chart;
mod commands;
mod difference;
mod failure;
mod files;
mod fixing;
mod input;
mod json_deck;
mod laws;
#[cfg(feature = "columnar")]
mod node_table;
mod page;
mod progress;
mod reach;
mod render;
mod report;
mod rules;
mod scene;
#[cfg(feature = "server")]
mod server;
mod settings;
mod stop;
mod terminals;
mod text;
mod threads;
mod user_library;

pub use deck::Deck;
pub use error::Error;
#[cfg(feature = "columnar")]
pub use evaluation::{EvaluateOptions, Evaluated, EvaluatedTo};
pub use fixes::{Fixed, FixedFile, Fixes};
pub use inpact_diagnostics::{Diagnostic, Edit, Extent, Fix, FixKind, FixSafety, Label, Rule, Severity, span};
pub use inpact_evaluation::HistoryStart;
#[cfg(feature = "columnar")]
pub use inpact_evaluation::arrow;
pub use inpact_evaluation::{Accuracy, Tolerance};
pub use inpact_network::linear::Method;
pub use inpact_network::scene::Field;
pub use inpact_parser::grammar::{Dialect, Release};
pub use inpact_parser::model::{Model, Name, Regime};
pub use laws::{Against, ContactColumns, GapConductance};
#[cfg(feature = "columnar")]
pub use node_table::NodeTable;
pub use render::Format;
pub use scene::{Scene, Solution, SolveOptions, SolvedState};
pub use settings::{ReadOptions, RelativeTo};
