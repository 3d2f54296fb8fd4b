//! A finding: its [`Rule`], severity, place, reason, help and fix.
//!
//! Findings in decks, node tables and scenes are of one kind, [`Diagnostic`], a plain value that knows its file, line, column and bytes.
//! Knows nothing of keywords, tables or laws, opens no file and prints nothing.

mod columns;
mod diagnostic;
mod findings;
mod fix;
mod lines;
mod rule;
mod severity;

pub mod span;
pub mod visible;

pub use columns::ColumnUnit;
pub use diagnostic::{Cell, Diagnostic, Extent, Label};
pub use findings::{Findings, Place};
pub use fix::{Edit, Fix, FixSafety, apply};
pub use lines::{Lines, keep_lines};
pub use rule::{FixKind, Rule};
pub use severity::Severity;
