//! The contents of a node table as a survey finds them.

use super::governing::GovernedBy;
use super::source::Presence;
use crate::kernel::scan;
use crate::nodes::{Column, Header, HistoryOrder};

/// The result of the first pass over a node table.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// Its header.
    pub header: Header,
    /// The number of rows.
    pub rows: u64,
    /// The source of the interaction that governs a row.
    pub governed_by: GovernedBy,
    /// The order of the rows by node, as far as it was determined.
    pub order: HistoryOrder,
    /// The columns of numbers that were read: all that any law of the deck could use.
    pub columns: Vec<Column>,
    /// Contents of the rows of each interaction, in the order of the model.
    pub interactions: Vec<InteractionSurvey>,
}

/// Contents of the rows of one interaction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InteractionSurvey {
    /// The number of rows it governs.
    pub rows: u64,
    /// The number of closed rows.
    pub closed: u64,
    /// The number of open rows; undetermined rows are neither.
    pub open: u64,
    /// The number of rows with a clearance above zero.
    pub above_zero: u64,
    /// The number of its nodes, where `node` and `time` are present.
    pub histories: Option<u64>,
    /// Contents of each of [`Survey::columns`]; empty without rows, so that such interactions cost nothing.
    pub columns: Vec<ColumnSurvey>,
}

impl InteractionSurvey {
    /// Contents of column number `place` of [`Survey::columns`].
    pub fn column(&self, place: usize) -> ColumnSurvey {
        self.columns.get(place).copied().unwrap_or_default()
    }
}

/// Contents of a column of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnSurvey {
    /// The number of cells with a number.
    pub present: u64,
    /// The number of these that are NaN or infinite.
    pub non_finite: u64,
    /// The smallest of the finite ones; infinity where there is none.
    pub least: f64,
    /// The largest of the finite ones; minus infinity where there is none.
    pub greatest: f64,
}

impl ColumnSurvey {
    /// Adds some cells: their numbers, NaN where one is missing, and flags of those present.
    pub(super) fn take(&mut self, values: &[f64], present: Option<&[bool]>) {
        let missing = present.map_or(0, |present| present.iter().filter(|is_there| !**is_there).count() as u64);
        let found = scan::extremes(values);
        self.present += values.len() as u64 - missing;
        self.non_finite += found.non_finite - missing;
        self.least = if found.least < self.least { found.least } else { self.least };
        self.greatest = if self.greatest < found.greatest { found.greatest } else { self.greatest };
    }
}

impl Default for ColumnSurvey {
    fn default() -> Self {
        Self { present: 0, non_finite: 0, least: f64::INFINITY, greatest: f64::NEG_INFINITY }
    }
}

impl Survey {
    /// The coverage of a column in the rows of interaction number `interaction`.
    ///
    /// A table without rows counts as having numbers in every column of its header.
    pub fn presence(&self, interaction: usize, column: Column) -> Presence {
        let Some(place) = self.columns.iter().position(|read| *read == column) else { return Presence::Absent };
        let of = &self.interactions[interaction];
        match of.column(place).present {
            _ if self.rows == 0 => Presence::Full,
            0 => Presence::Empty,
            present if present == of.rows => Presence::Full,
            _ => Presence::Partial,
        }
    }

    /// The smallest and the largest finite number of a column over all rows.
    pub fn range(&self, column: Column) -> Option<(f64, f64)> {
        let place = self.columns.iter().position(|read| *read == column)?;
        let columns = self.interactions.iter().map(|of| of.column(place));
        let whole = columns.fold(ColumnSurvey::default(), |whole, of| ColumnSurvey {
            least: whole.least.min(of.least),
            greatest: whole.greatest.max(of.greatest),
            ..whole
        });
        (whole.least <= whole.greatest).then_some((whole.least, whole.greatest))
    }
}
