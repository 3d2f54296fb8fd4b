//! The text of a node table cut into pieces of whole rows, and rows into cells (RFC 4180).
//!
//! Lines end with LF, CRLF or a lone CR; a lone CR outside of quotes becomes LF as it is read, so that the rest of the code has one line end (S-02).
//! Cells are separated by commas, or by semicolons or tabs where the header uses them.
//! A quote at the beginning of a cell opens a quoted cell, in which separators and line ends are text and a doubled quote is one quote; any other quote is an ordinary character.

use super::column::Column;
use memchr::{memchr, memchr2, memchr3, memrchr};
use std::io::{self, Read};

/// The approximate size of a piece.
const PIECE: usize = 512 * 1024;

/// The maximum length of a row: an unclosed quote must not make a cell of the whole table.
pub(super) const LONGEST_ROW: usize = 64 * 1024 * 1024;

/// The byte order mark that some programs write.
pub(super) const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// Separators of cells; where a header is ambiguous, the first of them is used.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// A text read in pieces of whole rows.
pub(super) struct Pieces<'a> {
    input: Box<dyn Read + Send + 'a>,
    /// Bytes read beyond the last piece.
    rest: Vec<u8>,
    separator: u8,
    state: State,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Reading,
    /// The end of the input was reached.
    Ended,
    /// A row exceeded the limit; the rest is not read.
    GaveUp,
}

/// Some rows as text.
#[derive(Debug, Default)]
pub(super) struct Piece {
    pub(super) text: Vec<u8>,
    /// Whether there is a quote in it.
    pub(super) has_quotes: bool,
}

/// The cells of a row, without quotes.
#[derive(Debug, Default)]
pub(super) struct Cells {
    text: Vec<u8>,
    ends: Vec<usize>,
}

impl<'a> Pieces<'a> {
    /// Begins to read a text and detects its separator.
    pub(super) fn open(input: Box<dyn Read + Send + 'a>) -> io::Result<Self> {
        let mut pieces = Self { input, rest: Vec::new(), separator: SEPARATORS[0], state: State::Reading };
        let mut start = Vec::new();
        pieces.fill(&mut start, PIECE)?;
        if start.starts_with(BYTE_ORDER_MARK) {
            start.drain(..BYTE_ORDER_MARK.len());
        }
        let first = start.split(|byte| matches!(byte, b'\n' | b'\r')).find(|line| !line.trim_ascii().is_empty());
        pieces.separator = first.map_or(SEPARATORS[0], separator_of);
        pieces.rest = start;
        Ok(pieces)
    }

    /// The separator of cells.
    pub(super) fn separator(&self) -> u8 {
        self.separator
    }

    /// Whether it ended early, at a row that exceeds the limit.
    pub(super) fn gave_up(&self) -> bool {
        self.state == State::GaveUp
    }

    /// Reads the next rows; false when there are no more.
    pub(super) fn next(&mut self, piece: &mut Piece) -> io::Result<bool> {
        piece.text.clear();
        piece.text.append(&mut self.rest);
        let mut wanted = PIECE;
        loop {
            self.fill(&mut piece.text, wanted)?;
            piece.has_quotes = memchr(b'"', &piece.text).is_some();
            self.mend_line_ends(piece);
            let end = match self.state {
                State::Reading => end_of_rows(piece, self.separator),
                State::Ended | State::GaveUp => piece.text.len(),
            };
            if end > 0 || self.state != State::Reading {
                self.rest.extend_from_slice(&piece.text[end..]);
                piece.text.truncate(end);
                return Ok(end > 0);
            }
            if piece.text.len() >= LONGEST_ROW {
                piece.text.clear();
                self.state = State::GaveUp;
                return Ok(false);
            }
            wanted = 2 * piece.text.len();
        }
    }

    /// Turns every lone CR that ends a row into a LF.
    fn mend_line_ends(&self, piece: &mut Piece) {
        let mut at = 0;
        while let Some(found) = memchr(b'\r', &piece.text[at..]) {
            at += found + 1;
            let is_lone = match piece.text.get(at) {
                Some(next) => *next != b'\n',
                // The next byte may be a LF that was not read yet; the piece does not end here.
                None => self.state != State::Reading,
            };
            if is_lone {
                mend_lone(&mut piece.text, self.separator, piece.has_quotes);
                return;
            }
        }
    }

    /// Reads until there are `wanted` bytes, or no more.
    fn fill(&mut self, text: &mut Vec<u8>, wanted: usize) -> io::Result<()> {
        if self.state == State::Reading && text.len() < wanted {
            let missing = wanted - text.len();
            if self.input.by_ref().take(missing as u64).read_to_end(text)? < missing {
                self.state = State::Ended;
            }
        }
        Ok(())
    }
}

impl Cells {
    /// Splits a row, without its line end, into cells; false where a quote in it is not closed.
    pub(super) fn cut(&mut self, row: &[u8], separator: u8) -> bool {
        self.text.clear();
        self.ends.clear();
        let mut at = 0;
        let mut is_closed = true;
        loop {
            if row.get(at) == Some(&b'"') {
                at += 1;
                loop {
                    let Some(text) = memchr(b'"', &row[at..]) else {
                        self.text.extend_from_slice(&row[at..]);
                        at = row.len();
                        is_closed = false;
                        break;
                    };
                    self.text.extend_from_slice(&row[at..at + text]);
                    at += text + 1;
                    if row.get(at) != Some(&b'"') {
                        break;
                    }
                    self.text.push(b'"');
                    at += 1;
                }
            }
            // Text after a closing quote belongs to the cell.
            let end = memchr(separator, &row[at..]).map_or(row.len(), |length| at + length);
            self.text.extend_from_slice(&row[at..end]);
            self.ends.push(self.text.len());
            at = end + 1;
            if at > row.len() {
                return is_closed;
            }
        }
    }

    /// Their number.
    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// A cell; `None` where the row has too few.
    pub(super) fn get(&self, index: usize) -> Option<&[u8]> {
        let end = *self.ends.get(index)?;
        let start = index.checked_sub(1).map_or(0, |before| self.ends[before]);
        Some(&self.text[start..end])
    }
}

/// Whether a line is not a row: blanks, and no separator among them.
#[inline]
pub(super) fn is_blank(line: &[u8], separator: u8) -> bool {
    line.trim_ascii().is_empty() && !line.contains(&separator)
}

/// The end of the first row of a text, after its line end; `None` where the row is incomplete.
pub(super) fn end_of_row(text: &[u8], separator: u8) -> Option<usize> {
    let mut at = 0;
    loop {
        let found = at + memchr2(b'\n', b'"', &text[at..])?;
        at = found + 1;
        if text[found] == b'\n' {
            return Some(at);
        }
        if found == 0 || text[found - 1] == separator {
            loop {
                at += memchr(b'"', &text[at..])? + 1;
                if *text.get(at)? != b'"' {
                    break;
                }
                at += 1;
            }
        }
    }
}

/// Turns lone CRs outside of quotes into LFs, in a text that begins with a row; a CR in the last byte is left.
#[cold]
fn mend_lone(text: &mut [u8], separator: u8, has_quotes: bool) {
    let mut is_quoted = false;
    let mut at = 0;
    while let Some(found) = memchr3(b'\r', b'\n', b'"', &text[at..]) {
        let here = at + found;
        at = here + 1;
        match text[here] {
            b'"' if !has_quotes => {}
            b'"' if is_quoted => {
                // Two quotes are one.
                if text.get(at) == Some(&b'"') {
                    at += 1;
                } else {
                    is_quoted = false;
                }
            }
            b'"' => is_quoted = here == 0 || text[here - 1] == separator || text[here - 1] == b'\n',
            b'\r' if !is_quoted && text.get(at).is_some_and(|next| *next != b'\n') => text[here] = b'\n',
            _ => {}
        }
    }
}

/// The end of the last complete row of a piece.
fn end_of_rows(piece: &Piece, separator: u8) -> usize {
    if !piece.has_quotes {
        return memrchr(b'\n', &piece.text).map_or(0, |end| end + 1);
    }
    let mut end = 0;
    while let Some(length) = end_of_row(&piece.text[end..], separator) {
        end += length;
    }
    end
}

/// The separator of a header: the one that gives the most columns of the contract, then the most cells.
pub(super) fn separator_of(header: &[u8]) -> u8 {
    let mut cells = Cells::default();
    let mut score = |separator: u8| {
        cells.cut(header.strip_suffix(b"\r").unwrap_or(header), separator);
        let texts = (0..cells.len()).filter_map(|index| cells.get(index));
        let known = texts.filter(|text| Column::named(&String::from_utf8_lossy(text)).is_some()).count();
        (known, cells.len())
    };
    let first = score(SEPARATORS[0]);
    let better = |(best, of_best), separator| {
        let of = score(separator);
        if of_best < of { (separator, of) } else { (best, of_best) }
    };
    SEPARATORS[1..].iter().copied().fold((SEPARATORS[0], first), better).0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(row: &str) -> (Vec<String>, bool) {
        let mut cells = Cells::default();
        let is_closed = cells.cut(row.as_bytes(), b',');
        let texts = (0..cells.len()).map(|index| cells.get(index).expect("there are so many"));
        (texts.map(|text| String::from_utf8_lossy(text).into_owned()).collect(), is_closed)
    }

    #[test]
    fn rows_are_cut_into_cells() {
        for (row, cells) in [
            ("", vec![""]),
            ("a,b", vec!["a", "b"]),
            (",", vec!["", ""]),
            ("\"a,b\",\"c\"\"d\"", vec!["a,b", "c\"d"]),
            ("\"\",\"\"\"\"", vec!["", "\""]),
            ("\"a\"b,c\"d\"", vec!["ab", "c\"d\""]),
            ("\"a\nb\",1", vec!["a\nb", "1"]),
        ] {
            let expected: Vec<String> = cells.into_iter().map(str::to_owned).collect();
            assert_eq!(cut(row), (expected, true), "{row:?}");
        }
        assert_eq!(cut("1,\"a,b"), (vec!["1".to_owned(), "a,b".to_owned()], false));
    }

    #[test]
    fn rows_end_outside_of_quotes() {
        assert_eq!(end_of_row(b"a,\"b\nc\"\nd\n", b','), Some(8));
        assert_eq!(end_of_row(b"a\"b\nc\n", b','), Some(4));
        assert_eq!(end_of_row(b"\"a\"\"\n\"\n", b','), Some(7));
        assert_eq!(end_of_row(b"\"a\n", b','), None);
        assert_eq!(end_of_row(b"\"a\"", b','), None);
        assert_eq!(end_of_row(b"a,b", b','), None);
    }

    #[test]
    fn lone_carriage_returns_end_rows_outside_of_quotes() {
        let read = |text: &str, wanted: &[&str]| {
            let mut pieces = Pieces::open(Box::new(text.as_bytes())).expect("a slice can be read");
            let (mut piece, mut all) = (Piece::default(), String::new());
            while pieces.next(&mut piece).expect("a slice can be read") {
                all += &String::from_utf8_lossy(&piece.text);
            }
            assert_eq!(all.split('\n').collect::<Vec<_>>(), wanted, "{text:?}");
        };
        read("a,b\r1,2\r3,4", &["a,b", "1,2", "3,4"]);
        read("a,b\r1,2\r3,4\r", &["a,b", "1,2", "3,4\r"]);
        read("a,b\r\n1,2\r\n", &["a,b\r", "1,2\r", ""]);
        read("a,b\r\n1,2\r3,4\n", &["a,b\r", "1,2", "3,4", ""]);
        read("a,b\r\"x\ry\",\"\"\"\r\"\r3,4\r", &["a,b", "\"x\ry\",\"\"\"\r\"", "3,4\r"]);
    }

    #[test]
    fn a_long_table_of_lone_carriage_returns_is_cut_into_pieces() {
        let rows = PIECE / 4;
        let text = format!("node,clearance\r{}", "1,2\r".repeat(rows));
        let mut pieces = Pieces::open(Box::new(text.as_bytes())).expect("a slice can be read");
        let (mut piece, mut found) = (Piece::default(), 0);
        while pieces.next(&mut piece).expect("a slice can be read") {
            found += piece.text.split(|byte| matches!(byte, b'\n' | b'\r')).filter(|line| !line.is_empty()).count();
        }
        assert_eq!(found, rows + 1);
    }

    #[test]
    fn the_header_tells_the_separator() {
        assert_eq!(separator_of(b"node,clearance"), b',');
        assert_eq!(separator_of(b"node;clearance\r"), b';');
        assert_eq!(separator_of(b"node\tclearance"), b'\t');
        assert_eq!(separator_of(b"clearance"), b',');
        assert_eq!(separator_of(b"clearance,\"a;b;c;d\""), b',');
        assert_eq!(separator_of(b"node;clearance;x,y,z,w"), b';');
    }
}
