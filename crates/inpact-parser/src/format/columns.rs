//! Alignment of items in columns: numbers by their decimal points, everything else by its first character.

use crate::number::read_float;
use std::ops::Range;

/// An item of a line.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    range: Range<usize>,
    is_number: bool,
    /// The characters before the decimal point, or before the exponent where there is no point.
    before: usize,
    /// The other characters.
    after: usize,
}

impl Cell {
    /// The cell whose item is at `range` of `text`.
    pub(super) fn new(range: Range<usize>, text: &[u8]) -> Self {
        let item = &text[range.clone()];
        let is_number = is_number_or_symbol(item);
        let is_symbol = item.contains(&b'<');
        let point = memchr::memchr(b'.', item).or_else(|| item.iter().position(u8::is_ascii_alphabetic));
        let split = if is_symbol { item.len() } else { point.unwrap_or(item.len()) };
        Self { range, is_number, before: characters(&item[..split]), after: characters(&item[split..]) }
    }

    /// The item.
    pub(super) fn text<'a>(&self, text: &'a [u8]) -> &'a [u8] {
        &text[self.range.clone()]
    }

    pub(super) fn is_empty(&self) -> bool {
        self.range.is_empty()
    }

    fn width(&self) -> usize {
        self.before + self.after
    }
}

/// The widths of the columns of a group of lines.
#[derive(Debug, Default)]
pub(super) struct Columns {
    columns: Vec<Column>,
}

/// The widths that the items of a column need.
#[derive(Debug, Default, Clone)]
struct Column {
    /// Some item is not a number: then all begin at the left.
    has_text: bool,
    width: usize,
    before: usize,
    after: usize,
}

impl Columns {
    /// Widens the columns for the cells of a line.
    pub(super) fn make_room(&mut self, cells: &[Cell]) {
        if self.columns.len() < cells.len() {
            self.columns.resize(cells.len(), Column::default());
        }
        for (column, cell) in self.columns.iter_mut().zip(cells).filter(|(_, cell)| !cell.is_empty()) {
            column.has_text |= !cell.is_number;
            column.width = column.width.max(cell.width());
            column.before = column.before.max(cell.before);
            column.after = column.after.max(cell.after);
        }
    }

    /// Writes a line without its line end: each item in its column, the comma directly after it, no trailing blanks.
    pub(super) fn write(&self, cells: &[Cell], text: &[u8], line: &mut Vec<u8>) {
        let mut due = 0;
        for (index, (column, cell)) in self.columns.iter().zip(cells).enumerate() {
            let (before, after) = column.blanks_around(cell);
            let is_last = index + 1 == cells.len();
            // Nothing is written after the last comma of `1.,`.
            if !(is_last && cell.is_empty()) {
                line.resize(line.len() + due + before, b' ');
            }
            line.extend_from_slice(cell.text(text));
            if !is_last {
                line.push(b',');
            }
            due = after + 1;
        }
    }
}

impl Column {
    /// The blanks before an item and after its comma.
    fn blanks_around(&self, cell: &Cell) -> (usize, usize) {
        if self.has_text {
            (0, self.width - cell.width())
        } else {
            (self.before - cell.before, self.after - cell.after)
        }
    }
}

/// The number of characters, for UTF-8 text; other text is only aligned less well.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| **byte & 0xC0 != 0x80).count()
}

/// Whether it is a number, or the name of one.
pub(super) fn is_number_or_symbol(item: &[u8]) -> bool {
    item.contains(&b'<') || read_float(item).is_ok()
}
