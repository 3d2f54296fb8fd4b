//! Fast path for rows of numbers only, as nearly all are: parsed in one pass, without splitting into items first.
//!
//! The numbers are the same as from the reader of items, which reads any row that has anything else.

use crate::number::{FLOAT_CHARACTERS, read_float, read_plain};
use std::ops::Range;

/// The most items of a line (K-50).
pub(crate) const MAX_CELLS: usize = 8;

/// A row of plain numbers.
pub(crate) struct PlainRow {
    /// The number of its cells.
    pub(crate) width: usize,
    /// Its bytes without blanks around them.
    pub(crate) content: Range<usize>,
    /// The start of the line after it.
    pub(super) next: usize,
}

/// Reads the row on the line that begins at `start` into `cells`; `None` if there is anything but numbers, commas and blanks.
pub(crate) fn plain_row(text: &[u8], start: usize, cells: &mut [f64; MAX_CELLS]) -> Option<PlainRow> {
    let mut at = after_blanks(text, start);
    let first = at;
    for (index, cell) in cells.iter_mut().enumerate() {
        let rest = &text[at..];
        let (value, length) = match read_plain(rest) {
            Some(found) if rest.get(found.1).is_none_or(|byte| is_separator(*byte)) => found,
            _ => {
                let length = rest.iter().position(|byte| is_separator(*byte)).unwrap_or(rest.len());
                (read_float(&rest[..length]).ok()?, length)
            }
        };
        if FLOAT_CHARACTERS < length {
            return None;
        }
        *cell = value;
        let end = at + length;
        at = after_blanks(text, end);
        let next = match text.get(at) {
            Some(b',') => {
                at = after_blanks(text, at + 1);
                continue;
            }
            None => at,
            Some(b'\n') => at + 1,
            Some(b'\r') if text.get(at + 1) == Some(&b'\n') => at + 2,
            Some(_) => return None,
        };
        return Some(PlainRow { width: index + 1, content: first..end, next });
    }
    None
}

fn is_separator(byte: u8) -> bool {
    matches!(byte, b',' | b' ' | b'\t' | b'\n' | b'\r')
}

fn after_blanks(text: &[u8], mut at: usize) -> usize {
    while let Some(b' ' | b'\t') = text.get(at) {
        at += 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::items;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn a_plain_row_has_the_numbers_of_its_items(line in "[ \t]{0,2}([0-9.+-]{1,4}|1.5[eEdD]?-?[0-9]{1,2}|[0-9]{18,22}|[ ,\"*<])([ ,]{1,3}[0-9.]{1,8}){0,8}[ ,\t]{0,2}") {
            let mut cells = [0.0; MAX_CELLS];
            let text = format!("{line}\r\nrest");
            let Some(row) = plain_row(text.as_bytes(), 0, &mut cells) else { return Ok(()) };
            let found: Vec<u64> = cells[..row.width].iter().map(|cell| cell.to_bits()).collect();
            let item = |item: Range<usize>| {
                prop_assert!(item.len() <= FLOAT_CHARACTERS);
                read_float(&line.as_bytes()[item]).map(f64::to_bits).map_err(|_| TestCaseError::fail("no number"))
            };
            let expected: Vec<u64> = items(line.as_bytes()).map(item).collect::<Result<_, _>>()?;
            prop_assert_eq!(found, expected);
            prop_assert_eq!(&line[row.content], line.trim());
            prop_assert_eq!(&text[row.next..], "rest");
        }
    }

    #[test]
    fn a_row_of_tables_is_plain() {
        let mut cells = [0.0; MAX_CELLS];
        let row = plain_row(b" 1.5e7, -2.,\t300 \n", 0, &mut cells).expect("numbers");
        assert_eq!((row.width, row.content, row.next), (3, 1..16, 18));
        assert_eq!(cells[..3], [1.5e7, -2.0, 300.0]);
        for other in ["", "\n", "1.,\n", "1., x\n", "1. 2.\n", "1, 2, 3, 4, 5, 6, 7, 8, 9\n", "1.\r2.\n"] {
            assert!(plain_row(other.as_bytes(), 0, &mut cells).is_none(), "{other:?}");
        }
    }
}
