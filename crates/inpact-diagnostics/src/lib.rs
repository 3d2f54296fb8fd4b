//! A finding: its [`Rule`], severity, place, reason, help and fix.
//!
//! Findings in decks, node tables and scenes are of one kind, [`Diagnostic`], a plain value that knows its file, line, column and bytes.
//! Knows nothing of keywords, tables or laws, opens no file and prints nothing.
//!
//! A [`Fix`] is edits on bytes:
//!
//! ```
//! use inpact_diagnostics::span::{SourceId, Span};
//! use inpact_diagnostics::{Edit, apply};
//!
//! let comma = Span::new(SourceId::ROOT, 7, 10);
//! assert_eq!(apply(b"4000., 0,2\n", &[Edit::new(comma, "0.2")]), b"4000., 0.2\n");
//! ```

mod columns;
mod diagnostic;
mod findings;
mod fix;
mod lines;
mod rule;
mod severity;

pub mod span;
pub mod visible;

pub use columns::{ColumnUnit, column_width};
pub use diagnostic::{Cell, Diagnostic, Extent, Label, Lines};
pub use findings::{Findings, Place};
pub use fix::{Edit, Fix, FixSafety, apply};
pub use lines::keep_lines;
pub use rule::{FixKind, Rule};
pub use severity::Severity;
