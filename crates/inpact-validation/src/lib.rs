//! The rules of `inpact check`: over a deck and its model, one file a rule.
//!
//! [`check`] runs every rule and gives the [`Diagnostic`]s in the order of the deck.
//! A rule sees the deck, the grammar, the model and what the reader met; it opens no file, prints nothing and cannot fail.
//! Its doc comment is its page, its `explain` text and its test: the examples in it are run.

pub mod rule;

pub mod rules;

mod assembly;
mod checking;

mod constants;

mod heat;
mod invisible;
mod lost;

mod order;

mod parameter;

mod placement;

mod problems;

mod quantity;

mod references;

mod tables;

mod trend;

mod suggestion;

mod directives;

pub use checking::{check, check_with, fixable, time_rules};
pub use inpact_diagnostics::{Diagnostic, Edit, Fix, FixKind, FixSafety, Label, Rule, Severity, apply};
pub use rule::{Context, Report};
