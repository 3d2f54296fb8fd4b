//! A table of numbers in columns of equal width, from its first row to the blank line after it.

use crate::lines::{Line, LineEnd, Lines};
use crate::number;
use crate::problem::{Place, Problem, shown};

pub(super) const DAMAGED: &str = "the report is damaged here or was changed by hand; the part before is read";
pub(super) const CUT: &str =
    "the report is cut short: write it again, or end it with a blank line if it is whole; the part before is read";

/// A table that is being read.
#[derive(Debug, Default)]
pub(super) struct Table {
    columns: Vec<Vec<f64>>,
    /// The first column with the places of its cells: labels, or values of X.
    labels: Vec<(f64, Place)>,
    /// The end of each column, from the first row.
    ends: Vec<usize>,
}

impl Table {
    /// Reads rows up to a blank line; blank lines before the first row belong to the head.
    pub(super) fn rows(&mut self, lines: &mut Lines<'_>) -> Result<(), Problem> {
        for line in lines.by_ref() {
            if line.is_blank() {
                if self.labels.is_empty() {
                    continue;
                }
                return Ok(());
            }
            self.row(&line)?;
        }
        Err(Problem::new(lines.place(), "the table has no blank line after its last row", CUT))
    }

    fn row(&mut self, line: &Line<'_>) -> Result<(), Problem> {
        let mut row = Vec::with_capacity(self.columns.len());
        let mut ends = Vec::new();
        let mut cells = line.cells().peekable();
        while let Some((at, cell)) = cells.next() {
            let mut end = at + cell.len();
            let value = match cell {
                b"NoValue" => Some(f64::NAN),
                b"No" => cells.next_if(|(_, next)| *next == b"Value").map(|(at, next)| {
                    end = at + next.len();
                    f64::NAN
                }),
                _ => number::real(cell),
            };
            let value = value.ok_or_else(|| {
                Problem::new(line.at(at), format!("expected a number, found `{}`", shown(cell)), DAMAGED)
            })?;
            row.push(value);
            ends.push(end);
        }
        if line.end == LineEnd::File && (self.labels.is_empty() || row.len() == self.columns.len() && ends != self.ends)
        {
            return Err(Problem::new(line.place, "the last row has no end", CUT));
        }
        if self.labels.is_empty() {
            self.columns = vec![Vec::new(); row.len()];
            self.ends = ends;
        } else if row.len() != self.columns.len() {
            let message = format!("a row has {} columns, its table {}", row.len(), self.columns.len());
            return Err(Problem::new(line.place, message, if line.end == LineEnd::File { CUT } else { DAMAGED }));
        }
        self.labels.push((row[0], line.place));
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(value);
        }
        Ok(())
    }

    /// The names of the columns, from the lines above them.
    ///
    /// A name may contain blanks: where the number of cells of a line differs from that of columns, the text above a column is its name.
    pub(super) fn names(&self, head: &[Line<'_>]) -> Vec<String> {
        let mut names = vec![String::new(); self.columns.len()];
        for line in head {
            let cells: Vec<_> = line.cells().map(|(_, cell)| cell).collect();
            let mut begin = 0;
            for (at, (name, end)) in names.iter_mut().zip(&self.ends).enumerate() {
                let above = line.text.get(begin.min(line.text.len())..(*end).min(line.text.len())).unwrap_or_default();
                let cell = if cells.len() == self.columns.len() { cells[at] } else { above };
                let cell = String::from_utf8_lossy(cell);
                let cell = cell.trim();
                if !name.is_empty() && !cell.is_empty() {
                    name.push(' ');
                }
                name.push_str(cell);
                begin = *end;
            }
        }
        names
    }

    pub(super) fn labels(&self) -> &[(f64, Place)] {
        &self.labels
    }

    pub(super) fn into_columns(self) -> Vec<Vec<f64>> {
        self.columns
    }
}
