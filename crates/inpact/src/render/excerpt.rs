//! The lines of a file around the labels of a finding, in a form the renderer can show.
//!
//! A deck may hold any bytes and lines of any length: invalid UTF-8 is shown as `?`, byte for byte, so that offsets
//! are unchanged, and of a very long line only the surroundings of the label are shown.

use super::Sources;
use super::sources::place_of;
use inpact_diagnostics::visible::{is_hidden, visible_line};
use inpact_validation::Label;
use memchr::{memchr, memrchr};
use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

/// The number of bytes of a line shown on either side of a label.
const SIDE: usize = 160;

/// The pieces of a file around some labels.
#[derive(Debug)]
pub(super) struct Excerpt {
    name: String,
    pieces: Vec<Piece>,
}

/// Some whole lines, or the part of a very long one around a label.
#[derive(Debug)]
struct Piece {
    /// Offset in the file.
    start: usize,
    /// The number of the first line, counted from 0.
    line: usize,
    /// The column of the first byte, counted from 0.
    column: usize,
    text: String,
}

impl Excerpt {
    /// The lines around each label, with `context` lines before and after.
    pub(super) fn around<'a>(sources: Sources<'_>, labels: impl Iterator<Item = &'a Label>, context: usize) -> Self {
        let mut name = String::new();
        let mut pieces = Vec::new();
        for label in labels {
            name = visible_line(sources.file(label)).into_owned();
            pieces.push(Piece::around(sources, label, context));
        }
        Self { name, pieces }
    }
}

impl Piece {
    fn around(sources: Sources<'_>, label: &Label, context: usize) -> Self {
        let (base, bytes) = sources.surroundings(label);
        let index = |offset: u64| usize::try_from(offset - base).unwrap_or(0).min(bytes.len());
        let (start, end) = place_of(label);
        let (from, to) = (index(start), index(end));
        let mut lines_before = 0;
        let mut start = start_of_line(bytes, from);
        while lines_before < context && start > 0 && from - start < SIDE {
            start = start_of_line(bytes, start - 1);
            lines_before += 1;
        }
        let mut end = end_of_line(bytes, to.max(from));
        for _ in 0..context {
            end = end_of_line(bytes, (end + 1).min(bytes.len()));
        }
        // Of very long lines only the surroundings; whole lines otherwise.
        let mut column = 0;
        if from - start > 3 * SIDE {
            (start, lines_before) = (from - SIDE, 0);
            column = start - start_of_line(bytes, start);
        }
        let end = end.min(to.min(from + 8 * SIDE) + 3 * SIDE).max(from);
        let line = usize::try_from(label.position.line).unwrap_or(1) - 1 - lines_before;
        Self { start: usize::try_from(base).unwrap_or(0) + start, line, column, text: printable(&bytes[start..end]) }
    }

    fn end(&self) -> usize {
        self.start + self.text.len()
    }
}

fn start_of_line(bytes: &[u8], at: usize) -> usize {
    memrchr(b'\n', &bytes[..at]).map_or(0, |found| found + 1)
}

/// The place of the line end, or the end of the bytes.
fn end_of_line(bytes: &[u8], at: usize) -> usize {
    memchr(b'\n', &bytes[at..]).map_or(bytes.len(), |found| at + found)
}

/// The bytes as text of the same length: what is not UTF-8 becomes `?`, and so do hidden characters but tabs and line ends.
fn printable(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len());
    for chunk in bytes.utf8_chunks() {
        for character in chunk.valid().chars() {
            let is_shown = !is_hidden(character) || matches!(character, '\t' | '\n');
            if is_shown {
                text.push(character);
            } else {
                // A CR before its LF is not shown at all, yet keeps its place.
                text.extend(std::iter::repeat_n(if character == '\r' { ' ' } else { '?' }, character.len_utf8()));
            }
        }
        text.extend(chunk.invalid().iter().map(|_| '?'));
    }
    text
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        context_before: usize,
        context_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let (from, to) = (span.offset(), span.offset() + span.len());
        let holds = |piece: &&Piece| piece.start <= from && to <= piece.end();
        let begins = |piece: &&Piece| piece.start <= from && from <= piece.end();
        let piece = self.pieces.iter().find(holds);
        // A label longer than the shown part is truncated; two labels that do not fit into one piece stay separate.
        let piece = piece.or_else(|| self.pieces.iter().find(|piece| begins(piece) && span.len() > 8 * SIDE));
        let piece = piece.ok_or(MietteError::OutOfBounds)?;
        let (from, to) = (from - piece.start, (to - piece.start).min(piece.text.len()));
        let inner = SourceSpan::from((from, to - from));
        let local: Box<dyn SpanContents<'a> + 'a> = piece.text.read_span(&inner, context_before, context_after)?;
        let shown = SourceSpan::from((local.span().offset() + piece.start, local.span().len()));
        let column = if local.line() == 0 { local.column() + piece.column } else { local.column() };
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            local.data(),
            shown,
            local.line() + piece.line,
            column,
            local.line_count(),
        )))
    }
}
