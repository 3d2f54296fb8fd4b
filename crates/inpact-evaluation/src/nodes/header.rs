//! The header of a node table: which of its columns mean what.

use super::column::Column;
use super::diagnostic::{DUPLICATE_COLUMN, Findings, Place};

/// The header line of a node table.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Header {
    /// Its cells in the order of the file.
    pub cells: Vec<HeaderCell>,
}

/// A cell of the header.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HeaderCell {
    /// What stands there, without blanks around it.
    pub text: String,
    /// What it means; `None` for a name the contract does not have.
    pub column: Option<Column>,
}

impl Header {
    /// The header whose cells have these texts.
    pub fn new<'a>(cells: impl IntoIterator<Item = &'a str>) -> Self {
        let cells =
            cells.into_iter().map(|text| HeaderCell { text: text.trim().to_owned(), column: Column::named(text) });
        Self { cells: cells.collect() }
    }

    /// Whether a cell of the header means that column.
    pub fn has(&self, column: Column) -> bool {
        self.position(column).is_some()
    }

    /// The place of the first cell that means that column, counted from 0.
    pub fn position(&self, column: Column) -> Option<usize> {
        self.cells.iter().position(|cell| cell.column == Some(column))
    }

    /// What the header calls the column: an alias where that is what stands there, otherwise the canonical name.
    pub fn name_of(&self, column: Column) -> String {
        self.position(column).map_or_else(|| column.to_string(), |index| self.cells[index].text.clone())
    }

    /// Reports cells that mean the same column (D005).
    pub(super) fn report_duplicates(&self, line: Option<u64>, findings: &mut Findings) {
        for (index, cell) in self.cells.iter().enumerate() {
            let Some(column) = cell.column else { continue };
            let Some(first) = self.cells[..index].iter().find(|before| before.column == cell.column) else { continue };
            let message = if first.text.eq_ignore_ascii_case(&cell.text) {
                format!("column `{column}` stands twice in the header")
            } else {
                format!("columns `{}` and `{}` both mean `{column}`", first.text, cell.text)
            };
            let place = Place { row: None, line, column: Some(cell.text.clone()) };
            findings.report(&DUPLICATE_COLUMN, place, message, "keep one of the two");
        }
    }
}
