//! The header of a node table: the meaning of its columns.

use super::column::Column;
use super::rules::{DUPLICATE_COLUMN, UNKNOWN_COLUMN};
use inpact_diagnostics::{Findings, Place};
use std::collections::HashMap;

/// The header line of a node table.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Header {
    /// Its cells in the order of the file.
    pub cells: Vec<HeaderCell>,
    /// The first cell that means each column.
    places: HashMap<Column, usize>,
    /// Its line, in a text table.
    line: Option<u64>,
}

/// A cell of the header.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HeaderCell {
    /// Its text, without blanks around it.
    pub text: String,
    /// Its meaning; `None` for a name the contract does not have.
    pub column: Option<Column>,
}

impl Header {
    /// The header whose cells have these texts.
    pub fn new<'a>(cells: impl IntoIterator<Item = &'a str>) -> Self {
        let cells =
            cells.into_iter().map(|text| HeaderCell { text: text.trim().to_owned(), column: Column::named(text) });
        let cells: Vec<HeaderCell> = cells.collect();
        let mut places = HashMap::new();
        for (index, cell) in cells.iter().enumerate() {
            if let Some(column) = cell.column {
                places.entry(column).or_insert(index);
            }
        }
        Self { cells, places, line: None }
    }

    /// Whether a cell of the header means that column.
    pub fn has(&self, column: Column) -> bool {
        self.position(column).is_some()
    }

    /// The index of the first cell that means that column, from 0.
    pub fn position(&self, column: Column) -> Option<usize> {
        self.places.get(&column).copied()
    }

    /// The name of the column in the header, which may be an alias; the canonical name where it is absent.
    pub fn name_of(&self, column: Column) -> String {
        self.position(column).map_or_else(|| column.to_string(), |index| self.cells[index].text.clone())
    }

    /// Reports unknown names that are similar to a column that the header does not have (D020).
    pub(crate) fn report_unknown(&self, findings: &mut Findings) {
        for cell in self.cells.iter().filter(|cell| cell.column.is_none()) {
            let Some(near) = Column::near(&cell.text).filter(|near| !self.has(*near)) else { continue };
            let message = format!("a node table has no column `{}`, and nothing reads it", cell.text);
            let place = Place { line: self.line, column: Some(cell.text.clone()), ..Place::default() };
            findings.report(&UNKNOWN_COLUMN, place, message, format!("did you mean `{near}`?"));
        }
    }

    /// The header in a line of a text.
    pub(super) fn at_line(self, line: u64) -> Self {
        Self { line: Some(line), ..self }
    }

    /// Reports cells that mean the same column (D005).
    pub(super) fn report_duplicates(&self, findings: &mut Findings) {
        for (index, cell) in self.cells.iter().enumerate() {
            let Some(column) = cell.column else { continue };
            let Some(first) = self.position(column).filter(|first| *first < index) else { continue };
            let first = &self.cells[first];
            let message = if first.text.eq_ignore_ascii_case(&cell.text) {
                format!("column `{column}` stands twice in the header")
            } else {
                format!("columns `{}` and `{}` both mean `{column}`", first.text, cell.text)
            };
            let place = Place { line: self.line, column: Some(cell.text.clone()), ..Place::default() };
            findings.report(&DUPLICATE_COLUMN, place, message, "keep one of the two");
        }
    }
}
