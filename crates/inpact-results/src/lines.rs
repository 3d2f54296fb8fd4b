//! Lines with their places, whichever end of line a system writes.

use crate::problem::Place;

/// A line without its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'a> {
    pub(crate) text: &'a [u8],
    pub(crate) place: Place,
    pub(crate) end: LineEnd,
}

/// Ends of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineEnd {
    /// An end of line.
    Line,
    /// The end of the file: the line may have been longer.
    File,
}

impl<'a> Line<'a> {
    /// The place of a byte of this line, or of its end.
    pub(crate) fn at(&self, column: usize) -> Place {
        Place { byte: self.place.byte + column.min(self.text.len()) as u64, ..self.place }
    }

    /// Whether there is nothing on it but blanks.
    pub(crate) fn is_blank(&self) -> bool {
        self.text.trim_ascii().is_empty()
    }

    /// The cells between blanks, with their columns.
    pub(crate) fn cells(&self) -> impl Iterator<Item = (usize, &'a [u8])> + use<'a> {
        let (text, mut at) = (self.text, 0);
        std::iter::from_fn(move || {
            at += text[at..].iter().position(|byte| !byte.is_ascii_whitespace())?;
            let begin = at;
            at = text[begin..].iter().position(u8::is_ascii_whitespace).map_or(text.len(), |length| begin + length);
            Some((begin, &text[begin..at]))
        })
    }
}

/// The lines of a file.
#[derive(Clone, Debug)]
pub(crate) struct Lines<'a> {
    bytes: &'a [u8],
    next: Place,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        // The mark that some editors put before UTF-8.
        let begin = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        Self { bytes, next: Place { byte: begin, line: 1 } }
    }

    /// The start of the next line.
    pub(crate) fn place(&self) -> Place {
        self.next
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let place = self.next;
        let rest = self.bytes.get(usize::try_from(place.byte).ok()?..).filter(|rest| !rest.is_empty())?;
        let (text, length, end) = match memchr::memchr(b'\n', rest) {
            Some(at) => (&rest[..at], at + 1, LineEnd::Line),
            None => (rest, rest.len(), LineEnd::File),
        };
        self.next = Place { byte: place.byte + length as u64, line: place.line + 1 };
        Some(Line { text: text.strip_suffix(b"\r").unwrap_or(text), place, end })
    }
}
