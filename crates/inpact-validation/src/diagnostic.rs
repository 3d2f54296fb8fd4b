//! What is wrong with a deck, where, why, and what to do: the one source of every output format.
//!
//! Knows no colours and no terminals; the command line renders it.

use inpact_parser::span::{Position, Span};
use std::fmt;

/// How grave a diagnostic is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Abaqus would refuse the deck, or the result would be meaningless.
    Error,
    /// Accepted, likely not what was meant.
    Warning,
    /// Good to know.
    Note,
}

impl Severity {
    /// The word of the output formats: `error`, `warning` or `note`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

impl fmt::Display for Severity {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.word())
    }
}

/// One finding.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// The stable code, such as `T001`.
    pub code: &'static str,
    /// The stable name, such as `not-ascending`.
    pub name: &'static str,
    /// How grave it is.
    pub severity: Severity,
    /// What is wrong, with the values in it; names in backticks, no full stop.
    pub message: String,
    /// Where it is.
    pub primary: Label,
    /// The other places it has to do with.
    pub secondary: Vec<Label>,
    /// Why it matters: the rule or the physics.
    pub note: Option<String>,
    /// What to do.
    pub help: Option<String>,
    /// A change of the deck that mends it.
    pub fix: Option<Fix>,
}

/// A place in the deck with a few words about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// The bytes it points at.
    pub span: Span,
    /// Line and column of the first of them.
    pub position: Position,
    /// What to say there; may be empty.
    pub text: String,
}

/// A change of the deck that makes a finding go away.
#[derive(Debug, Clone, PartialEq)]
pub struct Fix {
    /// What it does, in the imperative.
    pub title: String,
    /// Whether the meaning of the deck stays the same.
    pub safety: FixSafety,
    /// The changes; they do not overlap, and no byte outside their spans is touched.
    pub edits: Vec<Edit>,
}

/// Whether a fix may be applied without being asked for by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FixSafety {
    /// The deck means the same afterwards.
    Safe,
    /// The deck means something else afterwards: what was likely meant.
    ChangesMeaning,
}

/// Bytes put in the place of a span.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced; an empty span inserts.
    pub span: Span,
    /// What stands there afterwards.
    pub replacement: Vec<u8>,
}

impl Diagnostic {
    /// Says a few words at the place itself.
    pub fn label(&mut self, text: impl Into<String>) -> &mut Self {
        self.primary.text = text.into();
        self
    }

    /// Points at another place.
    pub fn also(&mut self, span: Span, text: impl Into<String>) -> &mut Self {
        self.secondary.push(Label::new(span, text));
        self
    }

    /// Says what to do.
    pub fn help(&mut self, text: impl Into<String>) -> &mut Self {
        self.help = Some(text.into());
        self
    }

    /// Says why it matters.
    pub fn note(&mut self, text: impl Into<String>) -> &mut Self {
        self.note = Some(text.into());
        self
    }

    /// Offers a change that mends it.
    pub fn fix(&mut self, safety: FixSafety, title: impl Into<String>, edits: Vec<Edit>) -> &mut Self {
        self.fix = Some(Fix { title: title.into(), safety, edits });
        self
    }

    /// Departs from the rule's own severity.
    pub fn severity(&mut self, severity: Severity) -> &mut Self {
        self.severity = severity;
        self
    }
}

impl Label {
    /// A label whose line and column are found out later, all at once.
    pub(crate) fn new(span: Span, text: impl Into<String>) -> Self {
        Self { span, position: Position { line: 1, column: 1 }, text: text.into() }
    }
}

impl Edit {
    /// Puts `replacement` in the place of `span`.
    pub fn new(span: Span, replacement: impl Into<Vec<u8>>) -> Self {
        Self { span, replacement: replacement.into() }
    }

    /// Takes the bytes of `span` away.
    pub fn delete(span: Span) -> Self {
        Self::new(span, Vec::new())
    }
}

/// Applies edits to the bytes of the file they point into.
///
/// Of two edits that overlap the later one is left out.
pub fn apply(bytes: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut sorted: Vec<&Edit> = edits.iter().collect();
    sorted.sort_by_key(|edit| (edit.span.start, edit.span.end));
    let mut result = Vec::with_capacity(bytes.len());
    let mut copied: u64 = 0;
    let slice = |from: u64, to: u64| {
        let index = |offset: u64| usize::try_from(offset).unwrap_or(bytes.len()).min(bytes.len());
        &bytes[index(from)..index(to)]
    };
    for edit in sorted {
        if edit.span.start < copied {
            continue;
        }
        result.extend_from_slice(slice(copied, edit.span.start));
        result.extend_from_slice(&edit.replacement);
        copied = edit.span.end;
    }
    result.extend_from_slice(slice(copied, u64::MAX));
    result
}
