//! A table of a sub-option: rows of numbers with the places they were read from (section 4 of the semantics).

use super::row_places::RowPlaces;
use crate::span::Span;
use std::sync::Arc;

/// Rows of numbers in the order of the deck.
///
/// The first column is the dependent value; the others are its independent variables, the one that varies fastest
/// first (T-02, T-03). Rows are kept unchanged, in order or not: the rules check them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// The names of the columns: `conductance`, `clearance`, `temp`, `fv1`, ….
    ///
    /// Tables of one kind share them: a deck may have more tables than numbers.
    pub columns: Arc<[String]>,
    /// The cells, row by row; `columns.len()` per row. Units are those of the columns (see the grammar).
    ///
    /// A cell that is not a number, or a parameter without a value, is NaN; see [`Table::texts`].
    pub values: Box<[f64]>,
    /// The places of the rows; see [`Table::row_span`].
    pub places: RowPlaces,
    /// The text of the cells that are not written as a number: a parameter, `<name>` (S-62), or a malformed number (S006).
    /// In ascending order of [`CellText::cell`].
    pub texts: Box<[CellText]>,
    /// The keyword line the table belongs to.
    pub keyword: Span,
    /// The number of field variables of DEPENDENCIES after `columns`: no row has them, so they are zero throughout (S-32).
    ///
    /// Rows are not padded: a deck of a few bytes may declare a thousand.
    pub unwritten: usize,
}

/// The text of a cell that is not written as a number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellText {
    /// Index into [`Table::values`].
    pub cell: usize,
    /// The text, without the blanks around it.
    pub text: String,
}

impl Table {
    /// The number of columns.
    #[inline]
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// The number of rows.
    #[inline]
    pub fn row_count(&self) -> usize {
        self.values.len() / self.width().max(1)
    }

    /// The numbers of each row.
    #[inline]
    pub fn row_values(&self) -> std::slice::ChunksExact<'_, f64> {
        self.values.chunks_exact(self.width().max(1))
    }

    /// The numbers of row `index`, counted from 0.
    #[inline]
    pub fn row(&self, index: usize) -> &[f64] {
        &self.values[index * self.width()..(index + 1) * self.width()]
    }

    /// The span of row `index`; an empty span at the keyword when the table was not read from a deck.
    #[inline]
    pub fn row_span(&self, index: usize) -> Span {
        self.places.get(index, self.keyword).unwrap_or(self.keyword)
    }

    /// The spans of the rows; fewer than there are rows when the table was not read from a deck.
    pub fn row_spans(&self) -> impl ExactSizeIterator<Item = Span> {
        self.places.iter(self.keyword)
    }

    /// Sets the places of the rows; [`keyword`](Self::keyword) must be set before.
    pub fn set_row_spans(&mut self, spans: impl IntoIterator<Item = Span>) {
        self.places = RowPlaces::of(spans, self.keyword);
    }

    /// The position of a column of that name.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == name)
    }

    /// The number of field variables in the columns, `fv1` and on.
    pub fn dependencies(&self) -> usize {
        self.columns.iter().filter(|column| is_field(column)).count()
    }

    /// DEPENDENCIES: the field variables in the columns, and those that no row has.
    pub fn declared_dependencies(&self) -> usize {
        self.dependencies() + self.unwritten
    }

    pub(super) fn forget_places(&mut self) {
        self.places = RowPlaces::default();
        self.keyword = Span::default();
    }

    /// The ranges of rows that form a group: all independent variables but the first are equal, bit for bit (T-09, T-10).
    pub fn groups(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        let outer = |row: usize| self.row(row).get(2..).unwrap_or(&[]);
        let mut start = 0;
        std::iter::from_fn(move || {
            let count = self.row_count();
            if start == count {
                return None;
            }
            let first = start;
            start += 1;
            while start < count && outer(start) == outer(first) {
                start += 1;
            }
            Some(first..start)
        })
    }
}

/// Whether a column holds a field variable: `fv1`, `fv2`, ….
fn is_field(column: &str) -> bool {
    column.strip_prefix("fv").is_some_and(|number| number.parse::<usize>().is_ok())
}
