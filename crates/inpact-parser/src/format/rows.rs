//! Formats the rows of a block: items aligned in columns, `, ` between them (S-31 to S-33).
//!
//! The text of an item is never changed, and a line keeps its items; only empty ones at the end of a row of numbers
//! are left out, since they are equivalent to nothing (S-33).

use super::LINE_CHARACTERS;
use super::columns::{Cell, Columns, is_number_or_symbol};
use crate::deck::lines::{LineKind, line_kind, lines, without_line_end};
use crate::deck::{Block, Deck, items};
use crate::grammar::{Definition, RowShape};
use crate::number::read_integer;
use std::ops::Range;

/// The formatted rows of a block; `None` when they stay unchanged.
///
/// That is the case for rows the grammar does not describe, for rows that are ignored because of a parameter, and where a
/// line would grow too long: then the rows of the block cannot be aligned.
pub(super) fn format(deck: &Deck, block: &Block, definition: &Definition) -> Option<Vec<u8>> {
    let order = Order::of(deck, block, definition)?;
    let text = deck.text(block.rows());
    let rows = Rows::read(text, order, definition.rows())?;
    let mut formatted = Vec::with_capacity(text.len());
    for line in &rows.lines {
        let physical = &text[line.range.clone()];
        let Some(cells) = &line.cells else {
            formatted.extend_from_slice(physical);
            continue;
        };
        let start = formatted.len();
        rows.columns[line.group].write(&rows.cells[cells.clone()], text, &mut formatted);
        if formatted.len() - start > LINE_CHARACTERS {
            return None;
        }
        formatted.extend_from_slice(&physical[without_line_end(physical).len()..]);
    }
    Some(formatted)
}

/// Alignment of the lines of a block.
#[derive(Debug, Clone, Copy)]
enum Order {
    /// A row of `width` items spans `lines` lines; the first lines of all rows are one group, and so on (K-52).
    Repeated { lines: usize, width: usize },
    /// The first line is a group of its own, all others are another.
    Headed,
}

impl Order {
    /// `None` for rows that are not formatted.
    fn of(deck: &Deck, block: &Block, definition: &Definition) -> Option<Self> {
        match definition.rows() {
            RowShape::None | RowShape::Text | RowShape::Uninterpreted => return None,
            RowShape::Items => return Some(Self::Repeated { lines: 1, width: 0 }),
            RowShape::Line | RowShape::Table | RowShape::HeadedTable => {}
        }
        let keyword = block.keyword.as_ref()?;
        let parameter = |name: &str| keyword.given(name, definition);
        let counted = definition.data.counted.as_ref().and_then(|counted| parameter(&counted.count)?.value);
        // The value of a symbol is not known here, and only affects the layout.
        let count = counted.and_then(|value| read_integer(deck.text(value)).ok()).unwrap_or(0);
        let count = usize::try_from(count).unwrap_or(0).min(crate::model::MAX_FIELD_VARIABLES);
        let layout = definition.layout(|name| parameter(name).is_some(), count)?;
        Some(match definition.rows() {
            RowShape::Table => Self::Repeated { lines: layout.lines_per_row(), width: layout.columns.len() },
            _ => Self::Headed,
        })
    }

    fn groups(self) -> usize {
        match self {
            Self::Repeated { lines, .. } => lines,
            Self::Headed => 2,
        }
    }

    /// The group of the line after one of `group` with this number of items.
    fn next_group(self, group: usize, items: usize) -> usize {
        match self {
            Self::Headed => 1,
            // All of a row on one line (K-53).
            Self::Repeated { width, .. } if group == 0 && items == width => 0,
            Self::Repeated { lines, .. } => (group + 1) % lines,
        }
    }
}

/// The lines of a block, split into cells, and the columns they need.
struct Rows {
    lines: Vec<Line>,
    /// The cells of all lines, line by line.
    cells: Vec<Cell>,
    /// One set of columns per group.
    columns: Vec<Columns>,
}

/// A physical line of rows.
struct Line {
    /// The line with its line end.
    range: Range<usize>,
    /// The group of lines that it is aligned with.
    group: usize,
    /// Its cells; `None` for a line that stays unchanged.
    cells: Option<Range<usize>>,
}

impl Rows {
    /// `None` for rows with more items than fit on a line.
    fn read(text: &[u8], order: Order, shape: RowShape) -> Option<Self> {
        let mut rows = Self { lines: Vec::new(), cells: Vec::new(), columns: Vec::new() };
        rows.columns.resize_with(order.groups(), Columns::default);
        let mut group = 0;
        for range in lines(text) {
            let line = &text[range.clone()];
            if line_kind(line) != LineKind::Data {
                rows.lines.push(Line { range, group: 0, cells: None });
                continue;
            }
            let first = rows.cells.len();
            let of_text = |item: Range<usize>| range.start + item.start..range.start + item.end;
            rows.cells.extend(items(line).take(LINE_CHARACTERS + 1).map(|item| Cell::new(of_text(item), text)));
            if rows.cells.len() - first > LINE_CHARACTERS {
                return None;
            }
            let items = used(&rows.cells[first..]);
            let cells = if is_well_formed(line, &rows.cells[first..], text, shape) {
                rows.cells.truncate(first + kept(&rows.cells[first..], shape));
                rows.columns[group].make_room(&rows.cells[first..]);
                Some(first..rows.cells.len())
            } else {
                rows.cells.truncate(first);
                None
            };
            rows.lines.push(Line { range, group, cells });
            group = order.next_group(group, items);
        }
        Some(rows)
    }
}

/// Whether every item is what it should be: a number or a symbol (S-62) in a table, text with closed quotes elsewhere.
fn is_well_formed(line: &[u8], cells: &[Cell], text: &[u8], shape: RowShape) -> bool {
    if !shape.is_numbers() {
        return memchr::memchr_iter(b'"', line).count().is_multiple_of(2);
    }
    cells.iter().map(|cell| cell.text(text)).all(|item| item.is_empty() || is_number_or_symbol(item))
}

/// The number of cells of a row that are written.
///
/// In a row of numbers the empty ones at the end are not, except for one comma after a first item: `1.,` is how a single
/// item is usually written, and `,` alone is a row, which a blank line is not (S-08).
fn kept(cells: &[Cell], shape: RowShape) -> usize {
    if !shape.is_numbers() {
        return cells.len();
    }
    let used = used(cells);
    if used <= 1 { cells.len().min(2) } else { used }
}

/// The number of cells without the empty ones at the end.
fn used(cells: &[Cell]) -> usize {
    cells.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1)
}
