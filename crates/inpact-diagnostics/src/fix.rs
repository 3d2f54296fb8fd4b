//! Fixes of a finding: edits on spans, and their application to the bytes of a file.

use crate::span::Span;

/// A change of the deck that removes a finding.
#[derive(Debug, Clone, PartialEq)]
pub struct Fix {
    /// Its description, in the imperative.
    pub title: String,
    /// Whether the meaning of the deck stays the same.
    pub safety: FixSafety,
    /// The changes; they do not overlap, and no byte outside their spans is touched.
    pub edits: Vec<Edit>,
}

/// Classes of fixes: applied by default, or only by the code of their rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FixSafety {
    /// The deck means the same afterwards.
    Safe,
    /// The deck means something else afterwards: what was likely meant.
    ChangesMeaning,
}

/// A replacement of a span.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// The bytes replaced; an empty span inserts.
    pub span: Span,
    /// The new bytes.
    pub replacement: Vec<u8>,
}

impl Edit {
    /// Replaces `span` by `replacement`.
    pub fn new(span: Span, replacement: impl Into<Vec<u8>>) -> Self {
        Self { span, replacement: replacement.into() }
    }

    /// Deletes the bytes of `span`.
    pub fn delete(span: Span) -> Self {
        Self::new(span, Vec::new())
    }
}

/// Applies edits to the bytes of their file.
///
/// Of two overlapping edits the later one is dropped.
pub fn apply(bytes: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut sorted: Vec<&Edit> = edits.iter().collect();
    sorted.sort_by_key(|edit| (edit.span.start(), edit.span.end()));
    let mut result = Vec::with_capacity(bytes.len());
    let mut copied: u64 = 0;
    let slice = |from: u64, to: u64| {
        let index = |offset: u64| usize::try_from(offset).unwrap_or(bytes.len()).min(bytes.len());
        &bytes[index(from)..index(to)]
    };
    for edit in sorted {
        if edit.span.start() < copied {
            continue;
        }
        result.extend_from_slice(slice(copied, edit.span.start()));
        result.extend_from_slice(&edit.replacement);
        copied = edit.span.end();
    }
    result.extend_from_slice(slice(copied, u64::MAX));
    result
}
