//! The text of a file that is being edited, in pieces of which only those that change are rescanned.
//!
//! A deck of a hundred megabytes is mostly mesh. Each piece is surveyed once; a scan skips a piece of mesh rows
//! without touching its bytes, and gives the same deck as the whole text would.
//! A piece ends after a line end, and a CR is not separated from its LF; only the last piece may end in the middle of a line.

use super::Scanner;
use super::lines::{count_line_ends, lines, without_line_end};
use super::survey::Survey;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// The approximate size of a piece; lines are never split.
const PIECE: usize = 32 * 1024;

/// Text that can be changed, and rescanned at the cost of its interpreted blocks.
///
/// A clone shares the pieces.
#[derive(Debug, Clone, Default)]
pub struct EditedText {
    pieces: Vec<Arc<Piece>>,
    /// Where each piece begins: its byte and its line.
    starts: Vec<Start>,
    length: u64,
}

/// Text received in parts and split into pieces on arrival, so that it is never a second time in memory as a whole.
#[derive(Debug, Default)]
pub struct TextInParts {
    pieces: Vec<Arc<Piece>>,
    /// The end of the received bytes, which may continue.
    rest: Vec<u8>,
    /// Its length at the last split, so that a very long line is not rescanned for every byte.
    left_over: usize,
}

/// Whole lines, and their survey.
#[derive(Debug)]
struct Piece {
    bytes: Box<[u8]>,
    line_ends: u64,
    survey: Survey,
    /// The starts of its lines, computed lazily.
    line_starts: OnceLock<Box<[usize]>>,
}

/// Where a piece begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Start {
    offset: u64,
    line: u64,
}

impl Piece {
    fn of(bytes: &[u8]) -> Self {
        let line_ends = count_line_ends(bytes);
        Self { bytes: bytes.into(), line_ends, survey: Survey::of(bytes), line_starts: OnceLock::new() }
    }

    /// The starts of its lines, plus the position after the last line end, where the next piece continues.
    fn line_starts(&self) -> &[usize] {
        self.line_starts.get_or_init(|| {
            let after = ends_line(&self.bytes).then_some(self.bytes.len());
            lines(&self.bytes).map(|range| range.start).chain(after).collect()
        })
    }
}

impl EditedText {
    /// The text of those bytes.
    pub fn new(bytes: &[u8]) -> Self {
        Self::in_pieces(bytes, PIECE)
    }

    fn in_pieces(bytes: &[u8], piece_length: usize) -> Self {
        let mut text = Self { pieces: cut(bytes, piece_length), ..Self::default() };
        text.place_pieces(0);
        text
    }

    /// Computes the starts of the pieces, from one of them on.
    fn place_pieces(&mut self, first: usize) {
        self.starts.truncate(first);
        let mut next = match first.checked_sub(1) {
            Some(before) => self.starts[before].after(&self.pieces[before]),
            None => Start { offset: 0, line: 0 },
        };
        for piece in &self.pieces[first..] {
            self.starts.push(next);
            next = next.after(piece);
        }
        self.length = next.offset;
    }

    /// The number of bytes.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The number of line ends.
    pub fn line_ends(&self) -> u64 {
        self.pieces.iter().map(|piece| piece.line_ends).sum()
    }

    /// Replaces bytes; a range that goes beyond the text is truncated.
    pub fn replace(&mut self, range: Range<u64>, with: &[u8]) {
        self.replace_in_pieces(range, with, PIECE);
    }

    fn replace_in_pieces(&mut self, range: Range<u64>, with: &[u8], piece_length: usize) {
        let (start, end) = (range.start.min(self.length), range.end.clamp(range.start.min(self.length), self.length));
        let (mut first, mut first_start) = self.piece_at(start);
        if let Some(before) = first.checked_sub(1) {
            // A CR at the end of the previous piece may be joined with its LF now.
            first = before;
            first_start -= self.pieces[before].bytes.len() as u64;
        }
        let (mut after, mut behind_start) = (first, first_start);
        let mut joined = Vec::new();
        while after < self.pieces.len() && behind_start <= end {
            joined.extend_from_slice(&self.pieces[after].bytes);
            behind_start += self.pieces[after].bytes.len() as u64;
            after += 1;
        }
        let index = |offset: u64| usize::try_from(offset - first_start).unwrap_or(usize::MAX).min(joined.len());
        joined.splice(index(start)..index(end), with.iter().copied());
        // Following pieces begin with a new line, and a CR here is not separated from an LF there.
        while after < self.pieces.len() && !matches!(joined.last(), None | Some(b'\n')) {
            joined.extend_from_slice(&self.pieces[after].bytes);
            after += 1;
        }
        self.pieces.splice(first..after, cut(&joined, piece_length));
        self.place_pieces(first);
    }

    /// The bytes of a range, as far as they exist.
    pub fn bytes(&self, range: Range<u64>) -> Cow<'_, [u8]> {
        let end = range.end.min(self.length);
        let (index, piece_start) = self.piece_at(range.start.min(end));
        let Some(piece) = self.pieces.get(index) else { return Cow::Borrowed(&[]) };
        let local = |offset: u64| usize::try_from(offset - piece_start).unwrap_or(usize::MAX);
        if end <= piece_start + piece.bytes.len() as u64 {
            return Cow::Borrowed(piece.bytes.get(local(range.start.min(end))..local(end)).unwrap_or(&[]));
        }
        let mut bytes = Vec::new();
        let mut skipped = local(range.start);
        let mut left = usize::try_from(end - range.start).unwrap_or(usize::MAX);
        for piece in &self.pieces[index..] {
            let part = &piece.bytes[skipped..piece.bytes.len().min(skipped.saturating_add(left))];
            bytes.extend_from_slice(part);
            skipped = 0;
            left -= part.len();
            if left == 0 {
                break;
            }
        }
        Cow::Owned(bytes)
    }

    /// All bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.bytes(0..self.length).into_owned()
    }

    /// The bytes of a line without its line end, and where it begins; lines are counted from 0, and one after the last is empty.
    pub fn line(&self, line: u64) -> (u64, &[u8]) {
        let index = self.starts.partition_point(|start| start.line <= line).saturating_sub(1);
        let (Some(piece), Some(start)) = (self.pieces.get(index), self.starts.get(index)) else { return (0, &[]) };
        let line_starts = piece.line_starts();
        let local = usize::try_from(line - start.line).unwrap_or(usize::MAX);
        let Some(from) = line_starts.get(local).copied() else { return (self.length, &[]) };
        let to = line_starts.get(local.saturating_add(1)).copied().unwrap_or(piece.bytes.len());
        (start.offset + from as u64, without_line_end(&piece.bytes[from..to]))
    }

    /// The line of a byte, counted from 0, and where it begins.
    pub fn line_of(&self, offset: u64) -> (u64, u64) {
        let offset = offset.min(self.length);
        let index = self.starts.partition_point(|start| start.offset <= offset).saturating_sub(1);
        let (Some(piece), Some(start)) = (self.pieces.get(index), self.starts.get(index)) else { return (0, 0) };
        let line_starts = piece.line_starts();
        let local = usize::try_from(offset - start.offset).unwrap_or(usize::MAX);
        let line = line_starts.partition_point(|from| *from <= local).saturating_sub(1);
        (start.line + line as u64, start.offset + line_starts[line] as u64)
    }

    /// Pushes the text into a scanner, skipping pieces of rows that are not kept; calls `watch` before each piece, which may unwind to cancel.
    pub fn push_watched(&self, scanner: &mut Scanner<'_>, watch: &dyn Fn()) {
        for piece in &self.pieces {
            watch();
            scanner.push_surveyed(&piece.bytes, piece.survey);
        }
    }

    /// The lengths of the common prefix and suffix with another text; they do not overlap.
    ///
    /// Whole pieces are compared by identity.
    pub fn shared_with(&self, other: &Self) -> (u64, u64) {
        let same = |(a, b): &(&Arc<Piece>, &Arc<Piece>)| Arc::ptr_eq(a, b);
        let length = |(piece, _): (&Arc<Piece>, &Arc<Piece>)| piece.bytes.len() as u64;
        let before = self.pieces.iter().zip(&other.pieces).take_while(same).count();
        let (rest, rest_of_other) = (&self.pieces[before..], &other.pieces[before..]);
        let after = rest.iter().rev().zip(rest_of_other.iter().rev()).take_while(same).map(length).sum();
        (self.pieces[..before].iter().map(|piece| piece.bytes.len() as u64).sum(), after)
    }

    /// The piece of a byte and its start; after the last byte the last piece, where it does not end a line.
    fn piece_at(&self, offset: u64) -> (usize, u64) {
        let index = self.starts.partition_point(|start| start.offset <= offset).saturating_sub(1);
        match (self.pieces.get(index), self.starts.get(index)) {
            (Some(piece), Some(start))
                if start.offset + piece.bytes.len() as u64 <= offset && ends_line(&piece.bytes) =>
            {
                (index + 1, start.offset + piece.bytes.len() as u64)
            }
            (Some(_), Some(start)) => (index, start.offset),
            _ => (0, 0),
        }
    }
}

impl TextInParts {
    /// Adds bytes at the end.
    pub fn push(&mut self, bytes: &[u8]) {
        self.push_in_pieces(bytes, PIECE);
    }

    fn push_in_pieces(&mut self, bytes: &[u8], piece_length: usize) {
        self.rest.extend_from_slice(bytes);
        if self.rest.len() < (4 * piece_length).max(2 * self.left_over) {
            return;
        }
        let mut pieces = cut(&self.rest, piece_length);
        // The last one may end in the middle of a line, or of a CR and its LF.
        let last = pieces.pop().map_or(0, |piece| piece.bytes.len());
        self.rest.drain(..self.rest.len() - last);
        self.left_over = last;
        self.pieces.append(&mut pieces);
    }

    /// The text of all bytes received.
    pub fn finish(self) -> EditedText {
        self.finish_in_pieces(PIECE)
    }

    fn finish_in_pieces(self, piece_length: usize) -> EditedText {
        let mut pieces = self.pieces;
        pieces.append(&mut cut(&self.rest, piece_length));
        let mut text = EditedText { pieces, ..EditedText::default() };
        text.place_pieces(0);
        text
    }
}

impl Start {
    /// Where the piece after one that begins here does.
    fn after(self, piece: &Piece) -> Self {
        Self { offset: self.offset + piece.bytes.len() as u64, line: self.line + piece.line_ends }
    }
}

/// Splits bytes into pieces of about that length, after line ends.
fn cut(bytes: &[u8], length: usize) -> Vec<Arc<Piece>> {
    let mut pieces = Vec::new();
    let mut rest = bytes;
    while !rest.is_empty() {
        let mut end = rest.len().min(length);
        while end < rest.len() && (rest[end - 1] != b'\n' && (rest[end - 1] != b'\r' || rest[end] == b'\n')) {
            end += memchr::memchr2(b'\n', b'\r', &rest[end..]).map_or(rest.len() - end, |found| found + 1);
        }
        let (piece, after) = rest.split_at(end);
        pieces.push(Arc::new(Piece::of(piece)));
        rest = after;
    }
    pieces
}

fn ends_line(bytes: &[u8]) -> bool {
    matches!(bytes.last(), Some(b'\n' | b'\r'))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::{Keep, ScanOptions};
    use crate::grammar::Grammar;
    use proptest::prelude::*;

    fn text() -> impl Strategy<Value = Vec<u8>> {
        let part = prop_oneof![
            8 => Just("1, 2., 3.\n"),
            2 => Just("*NODE\n"),
            2 => Just("*SURFACE INTERACTION, NAME=A\n"),
            2 => Just("*GAP CONDUCTANCE,\n"),
            1 => Just(" PRESSURE"),
            1 => Just("** inpact: ignore T001\n"),
            1 => Just("\r\n"),
            1 => Just("\r"),
            1 => Just("\n"),
            1 => Just("é"),
            1 => Just("*"),
            1 => Just("*PARAMETER\nx = 1\n"),
            1 => Just("1234567890123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890\
                1234567890123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890\
                12345678901234567890123456789012345678901234567890123456789012345678901234567890"),
        ];
        prop::collection::vec(part, 0..40).prop_map(|parts| parts.concat().into_bytes())
    }

    fn check(text: &EditedText, expected: &[u8]) {
        assert_eq!(text.to_bytes(), expected);
        assert_eq!(text.length(), expected.len() as u64);
        for piece in &text.pieces {
            assert_eq!(piece.line_ends, count_line_ends(&piece.bytes));
        }
        let starts: Vec<u64> = lines(expected).map(|range| range.start as u64).collect();
        for (number, range) in lines(expected).enumerate() {
            let found = text.line(number as u64);
            assert_eq!(found, (range.start as u64, without_line_end(&expected[range.clone()])));
            for offset in range {
                assert_eq!(text.line_of(offset as u64), (number as u64, starts[number]), "{offset}");
            }
        }
        let options = |keep| ScanOptions { grammar: Grammar::builtin(), keep };
        for keep in [Keep::Everything, Keep::Interpreted] {
            let mut in_pieces = Scanner::new("x", options(keep));
            text.push_watched(&mut in_pieces, &|| ());
            let mut at_once = Scanner::new("x", options(keep));
            at_once.push(expected);
            assert_eq!(in_pieces.finish(), at_once.finish());
        }
    }

    proptest! {
        #[test]
        fn edits_give_the_text_and_the_deck_that_the_whole_text_gives(
            first in text(),
            edits in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..60, text()), 1..8),
        ) {
            const LENGTH: usize = 24;
            let mut text = EditedText::in_pieces(&first, LENGTH);
            let mut expected = first;
            check(&text, &expected);
            for (at, removed, inserted) in edits {
                let start = at.index(expected.len() + 1);
                let end = (start + removed).min(expected.len());
                let before = text.clone();
                let as_it_was = expected.clone();
                text.replace_in_pieces(start as u64..end as u64, &inserted, LENGTH);
                expected.splice(start..end, inserted);
                check(&text, &expected);
                let (shared, shared_end) = text.shared_with(&before);
                let (shared, shared_end) = (usize::try_from(shared).unwrap(), usize::try_from(shared_end).unwrap());
                prop_assert!(shared + shared_end <= expected.len().min(as_it_was.len()));
                prop_assert_eq!(&expected[..shared], &as_it_was[..shared]);
                prop_assert_eq!(&expected[expected.len() - shared_end..], &as_it_was[as_it_was.len() - shared_end..]);
            }
        }

        #[test]
        fn text_in_parts_is_the_whole_text(text in text(), lengths in prop::collection::vec(1_usize..50, 1..20)) {
            let mut parts = TextInParts::default();
            let mut rest = &text[..];
            for length in lengths.iter().cycle() {
                let (part, after) = rest.split_at(rest.len().min(*length));
                parts.push_in_pieces(part, 8);
                rest = after;
                if rest.is_empty() {
                    break;
                }
            }
            check(&parts.finish_in_pieces(8), &text);
        }

        #[test]
        fn any_range_of_bytes(text in text(), from in 0_u64..400, length in 0_u64..400) {
            let edited = EditedText::in_pieces(&text, 24);
            let index = |offset: u64| usize::try_from(offset).unwrap().min(text.len());
            let bytes = edited.bytes(from..from + length);
            prop_assert_eq!(&*bytes, &text[index(from)..index(from + length)]);
        }
    }

    #[test]
    fn a_change_beyond_the_end_is_at_the_end() {
        let mut text = EditedText::new(b"*NODE\n1, 2.");
        text.replace(100..200, b"\n");
        assert_eq!(text.to_bytes(), b"*NODE\n1, 2.\n");
        assert_eq!(text.line(2), (12, &b""[..]));
        assert_eq!(text.line_of(12), (2, 12));
        assert_eq!(text.line(9), (12, &b""[..]));
    }
}
