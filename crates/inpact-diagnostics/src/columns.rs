//! Column units of other programs: bytes, UTF-16 code units, characters.
//!
//! Editors name a place by its line and a number of units from the start of that line; which units is agreed on with each editor.
//! Text that is not valid UTF-8 is counted as [`Position`](crate::span::Position) counts it: continuation bytes count as nothing.

/// The maximum width of a column of a text table.
const WIDEST: usize = 200;

/// The width in characters of a column of a table in text: that of its longest cell, up to 200. A longer cell overflows.
///
/// Names may have any length, and the width of formatting is limited: padding to the longest of them may fail.
///
/// ```
/// use inpact_diagnostics::column_width;
/// assert_eq!(column_width(["pressure", "temp_s"]), 8);
/// assert_eq!(column_width([&*"x".repeat(1 << 20)]), 200);
/// ```
pub fn column_width<'a>(cells: impl IntoIterator<Item = &'a str>) -> usize {
    cells.into_iter().map(|cell| cell.chars().take(WIDEST).count()).max().unwrap_or(0)
}

/// Units of columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ColumnUnit {
    /// Bytes of UTF-8.
    Utf8,
    /// Code units of UTF-16: two for a character beyond the first plane, one for any other.
    #[default]
    Utf16,
    /// Characters.
    Utf32,
}

impl ColumnUnit {
    /// The number of units of a text.
    pub fn count(self, text: &[u8]) -> u64 {
        if self == Self::Utf8 {
            return text.len() as u64;
        }
        text.iter().map(|byte| self.units_at(*byte)).sum()
    }

    /// The byte of a line at this number of units.
    ///
    /// A position inside a character is the start of that character; one beyond the line is its end.
    pub fn offset(self, line: &[u8], units: u64) -> usize {
        let mut passed = 0;
        let mut start = 0;
        for (at, byte) in line.iter().enumerate() {
            if !begins_character(*byte) {
                continue;
            }
            // The units of the previous character are known now.
            if units < passed {
                return start;
            }
            if units == passed {
                return at;
            }
            start = at;
            passed += match self {
                Self::Utf8 => bytes_of_character(&line[at..]),
                Self::Utf16 | Self::Utf32 => self.units_at(*byte),
            };
        }
        if units < passed { start } else { line.len() }
    }

    /// The number of units that a byte adds to a column.
    fn units_at(self, byte: u8) -> u64 {
        match self {
            Self::Utf8 => 1,
            Self::Utf16 => u64::from(begins_character(byte)) + u64::from(0xF0 <= byte),
            Self::Utf32 => u64::from(begins_character(byte)),
        }
    }
}

/// Whether a character begins at a byte.
fn begins_character(byte: u8) -> bool {
    byte & 0xC0 != 0x80
}

/// The number of bytes of the character that `text` begins with.
fn bytes_of_character(text: &[u8]) -> u64 {
    1 + text[1..].iter().take_while(|byte| !begins_character(**byte)).count() as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use ColumnUnit::{Utf8, Utf16, Utf32};

    #[test]
    fn units_of_a_text() {
        let text = "aé温😀b";
        assert_eq!(Utf8.count(text.as_bytes()), text.len() as u64);
        assert_eq!(Utf16.count(text.as_bytes()), text.encode_utf16().count() as u64);
        assert_eq!(Utf32.count(text.as_bytes()), text.chars().count() as u64);
    }

    #[test]
    fn there_and_back() {
        let text = "aé温😀b";
        for unit in [Utf8, Utf16, Utf32] {
            for at in text.char_indices().map(|(at, _)| at).chain([text.len()]) {
                let units = unit.count(&text.as_bytes()[..at]);
                assert_eq!(unit.offset(text.as_bytes(), units), at, "{unit:?} {units}");
            }
            assert_eq!(unit.offset(text.as_bytes(), 1000), text.len());
        }
    }

    #[test]
    fn inside_of_a_character_is_its_start() {
        let text = "a😀b".as_bytes();
        assert_eq!(Utf16.offset(text, 2), 1);
        assert_eq!(Utf8.offset(text, 3), 1);
        assert_eq!(Utf8.offset("a温".as_bytes(), 2), 1);
    }

    #[test]
    fn bytes_that_are_no_utf_8() {
        assert_eq!(Utf32.count(b"\xFFa\x80"), 2);
        assert_eq!(Utf32.offset(b"\xFFa\x80", 2), 3);
    }
}
