//! Some rows of a result table as columns.

use super::output::Output;
use crate::nodes::NumberColumn;
use std::fmt;
use std::ops::Range;

/// Remarks on a row (column `status`).
///
/// In ascending order of severity: the status of a row is the greatest of those of its laws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Status {
    /// Apart, within the tables.
    Open,
    /// In contact, within the tables.
    Closed,
    /// Farther apart than the cutoff of flow across: no pore fluid crosses.
    Cutoff,
    /// Outside the range of a table along some axis: the value at its end holds.
    BeyondTable,
    /// An infinite permeability holds the pore pressures of both sides equal: the flow across is an unknown of the analysis (P-30).
    Constrained,
}

/// Results of some consecutive rows: the columns of a plan, in its order.
#[derive(Debug, Clone, Default)]
pub struct ResultBatch {
    /// The columns of numbers.
    pub numbers: Vec<NumberColumn>,
    /// The status of each row, the most severe of its laws; `None` where no law was evaluated or contact is undetermined.
    pub status: Vec<Option<Status>>,
    /// The status of each row by law.
    pub status_by_law: StatusByLaw,
}

/// The status of each row by law; `None` where the law was not evaluated or contact is undetermined.
#[derive(Debug, Clone, Default)]
pub struct StatusByLaw {
    /// Of the electrical law.
    pub electrical: Vec<Option<Status>>,
    /// Of the thermal law.
    pub thermal: Vec<Option<Status>>,
    /// Of the pore fluid law.
    pub pore: Vec<Option<Status>>,
}

impl ResultBatch {
    /// Resets it to this number of rows and columns, without numbers.
    pub fn reset(&mut self, rows: usize, columns: usize) {
        self.reset_numbers(rows, columns);
        self.reset_statuses(rows);
    }

    /// Resets its numbers to this many columns and rows of missing numbers.
    pub(crate) fn reset_numbers(&mut self, rows: usize, columns: usize) {
        self.numbers.resize_with(columns, NumberColumn::default);
        self.numbers.iter_mut().for_each(|column| column.reset(rows));
    }

    /// The same where every number of the columns that are `written` is about to be set: their contents until then are arbitrary.
    pub(crate) fn shape(&mut self, rows: usize, columns: usize, is_written: impl Fn(usize) -> bool) {
        self.numbers.resize_with(columns, NumberColumn::default);
        for (place, column) in self.numbers.iter_mut().enumerate() {
            if is_written(place) {
                column.shape(rows);
            } else {
                column.reset(rows);
            }
        }
    }

    /// Resets it to this many rows without a status.
    pub(crate) fn reset_statuses(&mut self, rows: usize) {
        let StatusByLaw { electrical, thermal, pore } = &mut self.status_by_law;
        for statuses in [&mut self.status, electrical, thermal, pore] {
            statuses.clear();
            statuses.resize(rows, None);
        }
    }

    /// Scatters these results, of the rows with these numbers, into `whole`.
    pub(crate) fn scatter(&self, rows: &[u32], whole: &mut Self) {
        for (column, of_whole) in self.numbers.iter().zip(&mut whole.numbers) {
            column.scatter(rows, of_whole);
        }
        let own = [&self.status, &self.status_by_law.electrical, &self.status_by_law.thermal, &self.status_by_law.pore];
        let StatusByLaw { electrical, thermal, pore } = &mut whole.status_by_law;
        for (own, whole) in own.into_iter().zip([&mut whole.status, electrical, thermal, pore]) {
            own.iter().zip(rows).for_each(|(status, row)| whole[*row as usize] = *status);
        }
    }

    /// The statuses of a column of them; `None` for a column of numbers.
    pub fn statuses(&self, output: Output) -> Option<&[Option<Status>]> {
        match output {
            Output::Status => Some(&self.status),
            Output::ElectricalStatus => Some(&self.status_by_law.electrical),
            Output::ThermalStatus => Some(&self.status_by_law.thermal),
            Output::PoreStatus => Some(&self.status_by_law.pore),
            _ => None,
        }
    }

    /// Sets the numbers of some rows, where the plan has their column; `of` counts the rows from 0.
    #[inline]
    pub(crate) fn set_rows(&mut self, column: Option<usize>, rows: &Range<usize>, of: impl Fn(usize) -> f64) {
        if let Some(column) = column {
            self.numbers[column].set_rows(rows.clone(), (0..rows.len()).map(of));
        }
    }

    /// Sets the flows of some rows, or what flows add up to, where the plan has their column: no flow is 0, not −0.
    #[inline]
    pub(crate) fn set_flows(&mut self, column: Option<usize>, rows: Range<usize>, flows: impl Iterator<Item = f64>) {
        if let Some(column) = column {
            self.numbers[column].set_rows(rows, flows.map(|flow| flow + 0.0));
        }
    }

    /// Detects columns without missing numbers, which avoids checks row by row.
    pub(crate) fn settle(&mut self) {
        self.numbers.iter_mut().for_each(NumberColumn::settle);
    }

    /// Sets a number, where the plan has its column and the number is known.
    #[inline]
    pub fn set(&mut self, column: Option<usize>, row: usize, value: Option<f64>) {
        if let (Some(column), Some(value)) = (column, value) {
            self.numbers[column].set(row, value);
        }
    }
}

impl Status {
    /// All of them, in ascending order.
    pub const ALL: [Self; 5] = [Self::Open, Self::Closed, Self::Cutoff, Self::BeyondTable, Self::Constrained];

    /// The word of the column.
    pub fn word(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Closed => "closed",
            Self::Cutoff => "cutoff",
            Self::BeyondTable => "beyond_table",
            Self::Constrained => "constrained",
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.word())
    }
}
