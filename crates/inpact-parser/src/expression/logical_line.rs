//! Logical lines: physical lines joined where a statement continues, without comments.

use super::lexer::{Lexer, Token, is_blank};
use crate::span::Span;
use std::borrow::Cow;
use std::iter::Peekable;
use std::ops::Range;

/// One line of a *PARAMETER block; the deck's own comment lines (`**`) are already skipped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StatementLine<'deck> {
    /// Its place.
    pub span: Span,
    /// Its bytes, without line end.
    pub text: &'deck [u8],
}

/// Physical lines that belong together, as one text.
#[derive(Debug)]
pub(super) struct LogicalLine<'deck> {
    pub(super) text: Cow<'deck, [u8]>,
    /// The start in `text` of each physical line, and its place in the deck; never empty.
    pieces: Vec<(usize, Span)>,
}

/// Ends of a physical line.
enum LineEnd {
    /// The statement ends, or continues only because a parenthesis is open.
    Plain,
    /// A backslash outside a text.
    Continued,
    /// A backslash inside a text, which continues with the first character of the next line.
    ContinuedText,
}

/// Quotes and brackets open so far.
#[derive(Default)]
struct Open {
    quote: Option<u8>,
    parentheses: usize,
}

/// Takes the next logical line from `lines`.
///
/// It continues after a backslash (S-60; blanks after it are ignored, S-06) and, as in Python, while a parenthesis is
/// open, but then not beyond a line that is itself a definition: a missing parenthesis must not swallow the block.
pub(super) fn next_logical_line<'deck>(
    lines: &mut Peekable<impl Iterator<Item = StatementLine<'deck>>>,
) -> Option<LogicalLine<'deck>> {
    let first = lines.next()?;
    let mut open = Open::default();
    let (content, mut end) = scan(first.text, &mut open);
    let mut text = Cow::Borrowed(content);
    let mut pieces = vec![(0, first.span)];
    loop {
        let goes_on = match end {
            LineEnd::Continued | LineEnd::ContinuedText => true,
            LineEnd::Plain => {
                open.parentheses > 0
                    && open.quote.is_none()
                    && lines.peek().is_some_and(|line| !begins_definition(line.text))
            }
        };
        if !goes_on {
            break;
        }
        let Some(line) = lines.next() else { break };
        let joined = text.to_mut();
        if !matches!(end, LineEnd::ContinuedText) {
            // Tokens do not continue over line ends.
            joined.push(b' ');
        }
        pieces.push((joined.len(), line.span));
        let (content, next_end) = scan(line.text, &mut open);
        joined.extend_from_slice(content);
        end = next_end;
    }
    Some(LogicalLine { text, pieces })
}

/// The line without comment and continuation mark, and how it ends.
fn scan<'deck>(line: &'deck [u8], open: &mut Open) -> (&'deck [u8], LineEnd) {
    let mut at = 0;
    while let Some(byte) = line.get(at) {
        match (open.quote, byte) {
            (Some(_), b'\\') if at + 1 == line.len() => return (&line[..at], LineEnd::ContinuedText),
            (Some(_), b'\\') => at += 1,
            (Some(quote), byte) if *byte == quote => open.quote = None,
            (None, b'\'' | b'"') => open.quote = Some(*byte),
            (None, b'#') => return (&line[..at], LineEnd::Plain),
            (None, b'\\') if line[at + 1..].iter().all(|byte| is_blank(*byte)) => {
                return (&line[..at], LineEnd::Continued);
            }
            (None, b'(') => open.parentheses += 1,
            (None, b')') => open.parentheses = open.parentheses.saturating_sub(1),
            _ => {}
        }
        at += 1;
    }
    (line, LineEnd::Plain)
}

fn begins_definition(line: &[u8]) -> bool {
    let mut lexer = Lexer::new(line, 0);
    lexer.next_token().0 == Token::Name && lexer.next_token().0 == Token::Assign
}

impl LogicalLine<'_> {
    /// The place of a range of the text in the deck; truncated at the end of its first line when it continues in another file.
    pub(super) fn place(&self, range: &Range<usize>) -> Span {
        let start = self.offset(range.start);
        let end = self.offset(range.end);
        if start.source() == end.source() && start.start() <= end.start() {
            return Span::new(start.source(), start.start(), end.start());
        }
        let (_, line) = self.piece(range.start);
        Span::new(line.source(), start.start(), line.end().max(start.start()))
    }

    /// The physical line of an offset of the text.
    fn piece(&self, offset: usize) -> (usize, Span) {
        let after = self.pieces.partition_point(|(start, _)| *start <= offset);
        self.pieces[after.saturating_sub(1)]
    }

    fn offset(&self, offset: usize) -> Span {
        let (start, line) = self.piece(offset);
        let at = (line.start() + (offset - start) as u64).min(line.end());
        Span::new(line.source(), at, at)
    }
}
