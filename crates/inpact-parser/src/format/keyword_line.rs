//! Formats one keyword line: names in full and in upper case, `, ` between the parameters (S-10 to S-19).
//!
//! The pieces between the commas and the separators are replaced; a value is never changed.

use super::LINE_CHARACTERS;
use crate::deck::lines::{is_comment, lines, without_line_end};
use crate::deck::{Deck, KeywordLine, Parameter};
use crate::grammar::{Definition, Dialect};
use crate::span::Span;

/// The indent of a line that continues another.
const CONTINUATION_INDENT: &[u8] = b"    ";

/// The formatted keyword line with its line ends; `None` when it stays unchanged.
///
/// That is the case for a line with an open quote, an empty parameter, a piece that spans a line end, and for one that
/// would grow too long.
pub(super) fn format(deck: &Deck, keyword: &KeywordLine, definition: &Definition, dialect: Dialect) -> Option<Vec<u8>> {
    if keyword.unterminated_quote().is_some() {
        return None;
    }
    let mut line = Line { written: deck.text(keyword.span), offset: keyword.span.start(), formatted: b"*".to_vec() };
    let name = line.piece(keyword.name())?;
    line.formatted.extend_from_slice(definition.name.as_bytes());
    let mut after = keyword.name().start() + name.len() as u64;
    for parameter in keyword.parameters() {
        let piece = line.piece(parameter.span())?;
        line.take_comma(line.at(after, parameter.name.start()))?;
        match known_name(parameter, definition, dialect) {
            None => line.formatted.extend_from_slice(piece),
            Some(known) => {
                line.formatted.extend_from_slice(known.as_bytes());
                if let Some(value) = parameter.value {
                    line.formatted.push(b'=');
                    line.formatted.extend_from_slice(line.piece(value)?);
                }
            }
        }
        after = parameter.name.start() + piece.len() as u64;
    }
    line.take_end(line.at(after, keyword.span.end()))?;
    let formatted = line.formatted;
    let fits = lines(&formatted).all(|range| {
        let physical = &formatted[range];
        is_comment(physical) || without_line_end(physical).len() <= LINE_CHARACTERS
    });
    fits.then_some(formatted)
}

/// The name of a parameter in full.
fn known_name(parameter: Parameter, definition: &Definition, dialect: Dialect) -> Option<&str> {
    let index = parameter.resolved.found_in(dialect)?;
    Some(&definition.parameters[usize::from(index)].name)
}

/// A keyword line under construction.
struct Line<'deck> {
    /// The original line.
    written: &'deck [u8],
    /// Its offset in the file.
    offset: u64,
    formatted: Vec<u8>,
}

impl<'deck> Line<'deck> {
    /// The bytes between two offsets of the file.
    fn at(&self, start: u64, end: u64) -> &'deck [u8] {
        let index = |offset: u64| usize::try_from(offset.saturating_sub(self.offset)).unwrap_or(usize::MAX);
        self.written.get(index(start)..index(end)).unwrap_or(&[])
    }

    /// A piece without trailing blanks, which an empty value leaves; `None` for one that spans a line end.
    fn piece(&self, span: Span) -> Option<&'deck [u8]> {
        let piece = self.at(span.start(), span.end()).trim_ascii_end();
        (!piece.iter().any(|byte| matches!(byte, b'\n' | b'\r'))).then_some(piece)
    }

    /// Takes the text between two pieces: one comma, and after it perhaps a line end and comments (S-19, Q-35).
    fn take_comma(&mut self, between: &[u8]) -> Option<()> {
        let mut physical = lines(between).map(|range| &between[range]);
        let first = physical.next()?;
        let content = without_line_end(first);
        if content.trim_ascii() != b"," {
            return None;
        }
        self.formatted.push(b',');
        if content.len() == first.len() {
            self.formatted.push(b' ');
            return Some(());
        }
        self.formatted.extend_from_slice(&first[content.len()..]);
        for line in physical {
            let is_indent = line.trim_ascii().is_empty() && without_line_end(line).len() == line.len();
            match () {
                () if is_comment(line) => self.formatted.extend_from_slice(line),
                () if is_indent => {}
                () => return None,
            }
        }
        self.formatted.extend_from_slice(CONTINUATION_INDENT);
        Some(())
    }

    /// Takes the text after the last piece: a comma at most, which stays, since Abaqus looks for a continuation after it.
    fn take_end(&mut self, rest: &[u8]) -> Option<()> {
        let content = without_line_end(rest);
        match content.trim_ascii() {
            b"" => {}
            b"," => self.formatted.push(b','),
            _ => return None,
        }
        self.formatted.extend_from_slice(&rest[content.len()..]);
        Some(())
    }
}
