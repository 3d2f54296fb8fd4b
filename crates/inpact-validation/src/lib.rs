//! The rules of `inpact check`, over a deck and its model, one file per rule.
//!
//! [`check`] runs every rule and gives the [`Diagnostic`]s in the order of the deck.
//! A rule sees the deck, the grammar, the model and the reader's problems; it opens no file, prints nothing and cannot fail.
//! Its doc comment is its page, its `explain` text and its test: the examples in it are run.
//!
//! ```
//! use inpact_parser::{deck::scan, grammar::Grammar, model};
//!
//! let text = b"*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n4000., 0.\n0., -2.\n";
//! let grammar = Grammar::builtin();
//! let deck = scan("joint.inp", text, grammar);
//! let (model, problems) = model::read(&deck, grammar);
//! let findings = inpact_validation::check(&deck, grammar, &model, &problems);
//! assert_eq!((findings[0].code, findings[0].primary.line()), ("T001", Some(4)));
//! ```

mod assembly;
mod checking;
mod constants;
mod directives;
mod heat;
mod invisible;
mod lost;
mod order;
mod parameter;
mod placement;
mod problems;
mod quantity;
mod references;
mod rule;
mod rules;
mod suggestion;
mod tables;
mod trend;

pub use checking::{check, check_watched, check_with, fixable, time_rules};
pub use inpact_diagnostics::{Diagnostic, Edit, Fix, FixKind, FixSafety, Label, Rule, Severity, apply};
pub use rules::RULES;
