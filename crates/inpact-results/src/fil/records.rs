//! The stream of words in an ASCII `.fil` file, which is broken into lines of 80 characters regardless of word boundaries.

use crate::lines::{LineEnd, LineStream};
use crate::number;
use crate::problem::{Place, Problem, shown};

/// The characters of a line. Trailing blanks may have been lost; they belong to words.
const LINE: usize = 80;
/// The maximum number of words of a record, far above the 80 of the manual.
const MAX_WORDS: i64 = 1 << 20;

pub(super) const CUT: &str =
    "the file is cut short: copy it again, or let the job run to its end; the part before is read";
const FOREIGN: &str = "the file is damaged here, or is no results file of Abaqus in ASCII; the part before is read";

/// One word of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Word {
    Integer(i64),
    Real(f64),
    Text([u8; 8]),
}

impl Word {
    pub(super) fn integer(self) -> Option<i64> {
        match self {
            Self::Integer(value) => Some(value),
            _ => None,
        }
    }

    /// A value, which may be written as an integer.
    pub(super) fn real(self) -> Option<f64> {
        match self {
            Self::Real(value) => Some(value),
            #[expect(clippy::cast_precision_loss, reason = "a count of 2^53 is none that a solver writes")]
            Self::Integer(value) => Some(value as f64),
            Self::Text(_) => None,
        }
    }

    pub(super) fn text(self) -> Option<String> {
        match self {
            Self::Text(text) => Some(String::from_utf8_lossy(&text).into_owned()),
            _ => None,
        }
    }
}

/// A record: `*`, the number of its words, its key, its attributes.
pub(super) struct Record<'a> {
    pub(super) key: i64,
    pub(super) attributes: &'a [Word],
    pub(super) place: Place,
}

/// Reads records sequentially.
pub(super) struct Records<'a, 'b> {
    lines: &'a mut LineStream<'b>,
    column: usize,
    record: Vec<Word>,
}

impl<'a, 'b> Records<'a, 'b> {
    pub(super) fn new(lines: &'a mut LineStream<'b>) -> Self {
        lines.next();
        Self { lines, column: 0, record: Vec::new() }
    }

    /// The current place.
    pub(super) fn place(&self) -> Place {
        self.lines.line().map_or(self.lines.place(), |line| line.at(self.column.min(line.text.len())))
    }

    /// The next record; none at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Record<'_>>, Problem> {
        let place = loop {
            let place = self.place();
            match self.byte() {
                None => return Ok(None),
                Some(b' ') => (),
                Some(b'*') => break place,
                Some(other) => {
                    let message = format!("expected `*`, which begins a record, found `{}`", shown(&[other]));
                    return Err(Problem::new(place, message, FOREIGN));
                }
            }
        };
        let count = self.count(place)?;
        self.record.clear();
        for _ in 1..count {
            let word = self.word()?;
            self.record.push(word);
        }
        match self.record.split_first() {
            Some((Word::Integer(key), attributes)) => Ok(Some(Record { key: *key, attributes, place })),
            _ => Err(Problem::new(place, "expected the key of a record, an integer", FOREIGN)),
        }
    }

    /// The number of words of the record.
    fn count(&mut self, place: Place) -> Result<i64, Problem> {
        match self.word()? {
            Word::Integer(count @ 2..=MAX_WORDS) => Ok(count),
            word => {
                let found = match word {
                    Word::Integer(value) => value.to_string(),
                    Word::Real(value) => value.to_string(),
                    Word::Text(text) => shown(&text),
                };
                let message = format!("expected the number of words of a record, 2 to {MAX_WORDS}, found `{found}`");
                Err(Problem::new(place, message, FOREIGN))
            }
        }
    }

    fn word(&mut self) -> Result<Word, Problem> {
        let place = self.place();
        match self.needed(place)? {
            b'I' => {
                let digits = self.take::<2>(place)?;
                let length = number::integer(digits.trim_ascii()).and_then(|length| usize::try_from(length).ok());
                let Some(length) = length.filter(|length| (1..=20).contains(length)) else {
                    return Err(wrong(place, "the number of digits of an integer", &digits));
                };
                let mut text = [0; 20];
                for byte in &mut text[..length] {
                    *byte = self.needed(place)?;
                }
                let text = &text[..length];
                number::integer(text).map(Word::Integer).ok_or_else(|| wrong(place, "an integer", text))
            }
            b'D' => {
                let text = self.take::<22>(place)?;
                number::real(text.trim_ascii()).map(Word::Real).ok_or_else(|| wrong(place, "a number", &text))
            }
            b'E' => self.single_precision(place),
            b'A' => Ok(Word::Text(self.take::<8>(place)?)),
            other => Err(wrong(place, "a word, which begins with `I`, `D`, `E` or `A`", &[other])),
        }
    }

    /// A number of single precision, whose width differs: it ends with the two digits of its exponent.
    fn single_precision(&mut self, place: Place) -> Result<Word, Problem> {
        const MOST: usize = 24;
        let (mut text, mut length, mut left) = ([0; MOST], 0, MOST);
        while 0 < left {
            let byte = self.needed(place)?;
            text[length] = byte;
            length += 1;
            left = match byte {
                b'E' | b'D' if length + 3 <= MOST => 3,
                _ => left - 1,
            };
        }
        let text = &text[..length];
        number::real(text.trim_ascii()).map(Word::Real).ok_or_else(|| wrong(place, "a number", text))
    }

    fn take<const N: usize>(&mut self, place: Place) -> Result<[u8; N], Problem> {
        let mut taken = [0; N];
        if let Some(text) = self.lines.line().and_then(|line| line.text.get(self.column..self.column + N)) {
            taken.copy_from_slice(text);
            self.column += N;
            return Ok(taken);
        }
        for byte in &mut taken {
            *byte = self.needed(place)?;
        }
        Ok(taken)
    }

    fn needed(&mut self, place: Place) -> Result<u8, Problem> {
        self.byte().ok_or_else(|| Problem::new(place, "the file ends within a record", CUT))
    }

    fn byte(&mut self) -> Option<u8> {
        loop {
            let line = self.lines.line()?;
            let column = self.column;
            self.column += 1;
            if let Some(byte) = line.text.get(column) {
                return Some(*byte);
            }
            if column < LINE && line.end == LineEnd::Line {
                return Some(b' ');
            }
            self.lines.next();
            self.column = 0;
        }
    }
}

fn wrong(place: Place, expected: &str, found: &[u8]) -> Problem {
    Problem::new(place, format!("expected {expected}, found `{}`", shown(found)), FOREIGN)
}
