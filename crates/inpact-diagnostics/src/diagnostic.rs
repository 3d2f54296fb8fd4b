//! A finding with its place, reason and help: the single source of every output format.

use crate::fix::{Edit, Fix, FixSafety};
use crate::rule::Rule;
use crate::severity::Severity;
use crate::span::{Position, Span};
use std::sync::Arc;

/// One finding.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// The stable code, such as `T001`.
    pub code: &'static str,
    /// The stable name, such as `not-ascending`.
    pub name: &'static str,
    /// Its severity.
    pub severity: Severity,
    /// The fault, with the values in it; names in backticks, no full stop.
    pub message: String,
    /// Its place.
    pub primary: Label,
    /// Row and column by name, for a finding in a table or a scene; `None` in a deck.
    pub cell: Option<Cell>,
    /// The related places.
    pub secondary: Vec<Label>,
    /// The reason: the rule or the physics.
    pub note: Option<String>,
    /// The help.
    pub help: Option<String>,
    /// A change of the deck that fixes it.
    pub fix: Option<Fix>,
}

/// A place in a file with a short text.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// The name of the file in messages; empty until line and column are known.
    pub file: Arc<str>,
    /// The bytes it points at.
    pub span: Span,
    /// Line and column of the first of them.
    pub position: Position,
    /// Whether the line or the exact place is known.
    pub extent: Extent,
    /// The text of the label; may be empty.
    pub text: String,
    /// The lines around the place, stored where their file is not kept.
    pub lines: Option<Arc<Lines>>,
}

/// Precision of a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// By its bytes.
    Span,
    /// By its line: neither the column nor the bytes mean anything.
    Line,
    /// The file as a whole, or a row of a file that has no lines.
    File,
}

/// A cell of a table by header and row number; `None` for parts that do not apply.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Cell {
    /// The row, counted from 1 below the header.
    pub row: Option<u64>,
    /// The header of the column.
    pub field: Option<String>,
}

/// Complete lines of a file: that of a finding, the one before and the one after it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lines {
    /// The offset in the file of the first byte.
    pub start: u64,
    /// The number of the first line, from 1.
    pub first: u64,
    /// The line of the finding, in `bytes`, without its line end.
    pub line: std::ops::Range<usize>,
    /// The bytes, line ends included.
    pub bytes: Vec<u8>,
}

impl Diagnostic {
    /// A finding of a rule at a place, with the severity of the rule.
    pub fn new(rule: &Rule, message: impl Into<String>, primary: Label) -> Self {
        Self {
            code: rule.code,
            name: rule.name,
            severity: rule.severity,
            message: message.into(),
            primary,
            cell: None,
            secondary: Vec::new(),
            note: None,
            help: None,
            fix: None,
        }
    }

    /// The primary place, then the others.
    pub fn labels(&self) -> impl Iterator<Item = &Label> {
        std::iter::once(&self.primary).chain(&self.secondary)
    }

    /// The same, mutable.
    pub fn labels_mut(&mut self) -> impl Iterator<Item = &mut Label> {
        std::iter::once(&mut self.primary).chain(&mut self.secondary)
    }

    /// Sets the text of the primary label.
    pub fn label(&mut self, text: impl Into<String>) -> &mut Self {
        self.primary.text = text.into();
        self
    }

    /// Adds a secondary label.
    pub fn also(&mut self, span: Span, text: impl Into<String>) -> &mut Self {
        self.secondary.push(Label::new(span, text));
        self
    }

    /// Sets the help.
    pub fn help(&mut self, text: impl Into<String>) -> &mut Self {
        self.help = Some(text.into());
        self
    }

    /// Sets the note on why it matters.
    pub fn note(&mut self, text: impl Into<String>) -> &mut Self {
        self.note = Some(text.into());
        self
    }

    /// Sets a fix.
    pub fn fix(&mut self, safety: FixSafety, title: impl Into<String>, edits: Vec<Edit>) -> &mut Self {
        self.fix = Some(Fix { title: title.into(), safety, edits });
        self
    }

    /// Overrides the rule's severity.
    pub fn severity(&mut self, severity: Severity) -> &mut Self {
        self.severity = severity;
        self
    }
}

impl Label {
    /// A label whose file, line and column are computed later, all at once.
    pub fn new(span: Span, text: impl Into<String>) -> Self {
        Self {
            file: Arc::default(),
            span,
            position: Position { line: 1, column: 1 },
            extent: Extent::Span,
            text: text.into(),
            lines: None,
        }
    }

    /// The line, from 1, where it is known.
    pub fn line(&self) -> Option<u64> {
        (self.extent != Extent::File).then_some(self.position.line)
    }

    /// The column, from 1, where it is known.
    pub fn column(&self) -> Option<u64> {
        (self.extent == Extent::Span).then_some(self.position.column)
    }

    /// The bytes from start to end, where they are known.
    pub fn bytes(&self) -> Option<[u64; 2]> {
        (self.extent == Extent::Span).then_some([self.span.start(), self.span.end()])
    }
}
