//! Lines with their places, with any line end: of bytes in memory, or of a source that is read in pieces.

use crate::problem::Place;
use std::io;
use std::ops::{Range, RangeInclusive};

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
        let begin = if bytes.starts_with(MARK) { MARK.len() as u64 } else { 0 };
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

/// The initial and maximum read size: small files need no large buffer.
const PIECE: RangeInclusive<usize> = 1 << 12..=1 << 18;

/// The UTF-8 byte order mark.
const MARK: &[u8] = b"\xEF\xBB\xBF";

/// The lines of a source that is read in pieces: one piece, or one longer line, is in memory.
pub(crate) struct LineStream<'a> {
    source: &'a mut dyn io::Read,
    buffer: Vec<u8>,
    /// The bytes of the buffer that were read and belong to no line yet.
    unread: Range<usize>,
    /// The current line: its bytes in the buffer, its place and its end.
    current: Option<(Range<usize>, Place, LineEnd)>,
    next: Place,
    /// Whether the source has no more.
    has_ended: bool,
    /// The error of the source.
    failure: Option<io::Error>,
}

impl<'a> LineStream<'a> {
    pub(crate) fn new(source: &'a mut dyn io::Read) -> Self {
        let mut stream = Self {
            source,
            buffer: Vec::new(),
            unread: 0..0,
            current: None,
            next: Place { byte: 0, line: 1 },
            has_ended: false,
            failure: None,
        };
        while stream.unread.len() < MARK.len() && stream.fill() {}
        if stream.buffer[stream.unread.clone()].starts_with(MARK) {
            stream.unread.start += MARK.len();
            stream.next.byte += MARK.len() as u64;
        }
        stream
    }

    /// The start of the next line.
    pub(crate) fn place(&self) -> Place {
        self.next
    }

    /// The line that was read last; none before the first and after the last.
    pub(crate) fn line(&self) -> Option<Line<'_>> {
        let (range, place, end) = self.current.as_ref()?;
        Some(Line { text: &self.buffer[range.clone()], place: *place, end: *end })
    }

    /// The next line; none at the end.
    pub(crate) fn next(&mut self) -> Option<Line<'_>> {
        self.current = None;
        let mut searched = 0;
        let (length, end) = loop {
            let rest = &self.buffer[self.unread.clone()];
            if let Some(at) = memchr::memchr(b'\n', &rest[searched..]) {
                break (searched + at + 1, LineEnd::Line);
            }
            searched = rest.len();
            if !self.fill() {
                if searched == 0 {
                    return None;
                }
                break (searched, LineEnd::File);
            }
        };
        let start = self.unread.start;
        self.unread.start += length;
        let mut range = start..start + length - usize::from(end == LineEnd::Line);
        if self.buffer[range.clone()].ends_with(b"\r") {
            range.end -= 1;
        }
        let place = self.next;
        self.next = Place { byte: place.byte + length as u64, line: place.line + 1 };
        self.current = Some((range, place, end));
        self.line()
    }

    /// The failure of the source, if it failed.
    pub(crate) fn take_failure(&mut self) -> Option<io::Error> {
        self.failure.take()
    }

    /// Reads more bytes after the unread ones, which move to the front; whether there were any.
    fn fill(&mut self) -> bool {
        if self.has_ended {
            return false;
        }
        self.buffer.copy_within(self.unread.clone(), 0);
        self.unread = 0..self.unread.len();
        // A line that does not fit is read in pieces of its own length.
        let piece = (2 * self.buffer.len()).clamp(*PIECE.start(), *PIECE.end()).max(self.unread.end);
        if self.buffer.len() < self.unread.end + piece {
            self.buffer.resize(self.unread.end + piece, 0);
        }
        loop {
            match self.source.read(&mut self.buffer[self.unread.end..]) {
                Ok(0) => break,
                Ok(count) => {
                    self.unread.end += count;
                    return true;
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => {
                    self.failure = Some(error);
                    break;
                }
            }
        }
        self.has_ended = true;
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A source that gives a few bytes at a time.
    struct Trickle<'a>(&'a [u8], usize);

    impl io::Read for Trickle<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let count = self.1.min(self.0.len()).min(buffer.len());
            buffer[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    #[test]
    fn a_source_has_the_lines_of_its_bytes() {
        let long = "x".repeat(3 * PIECE.end());
        let texts =
            ["", "\n", "a", "a\n", "a\r\nb\r", "\u{feff}a\n\nb c", "\u{feff}", "\u{feff}\n", "a\r\r\n\r\n", &long];
        for text in texts {
            for step in [1, 2, 3, 7, *PIECE.end()] {
                let mut source = Trickle(text.as_bytes(), step);
                let mut stream = LineStream::new(&mut source);
                for expected in Lines::new(text.as_bytes()) {
                    assert_eq!(stream.place(), expected.place);
                    let line = stream.next().expect("a line");
                    assert_eq!((line.text, line.place, line.end), (expected.text, expected.place, expected.end));
                }
                assert!(stream.next().is_none() && stream.line().is_none(), "{text:?} by {step}");
            }
        }
    }
}
