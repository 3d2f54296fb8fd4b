//! Some rows of a result table as columns.

use crate::nodes::NumberColumn;
use std::fmt;

/// What there is to say of a row (column `status`).
///
/// In ascending order: of two laws in one row, the greater status is shown.
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
    /// The status of each row; `None` where no law was evaluated or contact cannot be told.
    pub status: Vec<Option<Status>>,
}

impl ResultBatch {
    /// Makes it a batch of so many rows and columns without a number.
    pub fn reset(&mut self, rows: usize, columns: usize) {
        self.numbers.resize_with(columns, NumberColumn::default);
        self.numbers.iter_mut().for_each(|column| column.reset(rows));
        self.status.clear();
        self.status.resize(rows, None);
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
