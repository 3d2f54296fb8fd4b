//! The error type of this crate.

use crate::accuracy::Refusal;
use std::error;
use std::fmt;

/// Rows that do not form a table, or a table that cannot be folded or resampled.
///
/// A fault of a node table is a finding, not an error; streams that cannot be read or written are [`std::io::Error`]s.
///
/// ```
/// use inpact_evaluation::table::{PiecewiseTable, Tail};
/// use inpact_evaluation::{ErrorKind, TableFault};
///
/// // The second clearance is below the first.
/// let error = PiecewiseTable::from_rows(&[4000.0, 2.0, 0.0, 0.5], 2, Tail::Zero).unwrap_err();
/// let fault = TableFault::NotAscending { axis: 0, previous: 2.0, found: 0.5 };
/// assert_eq!(*error.kind(), ErrorKind::Rows { row: 1, fault });
/// assert_eq!(error.to_string(), "row 2 has 0.5 after 2.0 in column 2, which must ascend");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Error(ErrorKind);

/// Kinds of errors.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// Rows do not form a table.
    Rows {
        /// The row at fault, counted from zero.
        row: usize,
        /// The fault.
        fault: TableFault,
    },
    /// A table is not folded: the groups of an axis, counted from zero, have different ranges, so that no one range says which points lie beyond the table.
    RangesDiffer {
        /// The axis.
        axis: usize,
    },
    /// A table is not folded: groups of axis 0 between which values are interpolated drop to zero at different abscissae.
    DropsDiffer,
    /// A table is not folded: the folded one would have too many rows.
    TooManyRows {
        /// The most that it may have.
        most: usize,
    },
    /// A table has no grid.
    Grid(Refusal),
}

/// Faults of rows of tables.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TableFault {
    /// There are no rows.
    NoRows,
    /// The cells do not divide into rows of `width`, which is at least 1: the last row has only `found`.
    IncompleteRow {
        /// Cells a row has.
        width: usize,
        /// Cells the last row has.
        found: usize,
    },
    /// A cell holds an infinity or NaN.
    NotFinite {
        /// The column, 0 for the value and a + 1 for axis a.
        column: usize,
        /// The number.
        found: f64,
    },
    /// A second row of a table without axes, which is a single constant.
    SecondConstant,
    /// The abscissa of `axis` is not above the row before while all outer axes are unchanged.
    NotAscending {
        /// The axis, counted from zero.
        axis: usize,
        /// The abscissa of the previous row.
        previous: f64,
        /// The abscissa of this row.
        found: f64,
    },
    /// Neighbouring curves of a conductance for CalculiX have no pressures in common, where ccx stops.
    NoSharedPressures {
        /// The temperatures of the two curves, θ.
        temperatures: [f64; 2],
    },
}

impl Error {
    /// The kind, with its numbers.
    pub fn kind(&self) -> &ErrorKind {
        &self.0
    }

    /// A row, counted from zero, that does not belong to a table.
    pub(crate) fn of_rows(row: usize, fault: TableFault) -> Self {
        Self(ErrorKind::Rows { row, fault })
    }
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(kind)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            ErrorKind::Rows { row, fault } => fault.fmt(row + 1, formatter),
            ErrorKind::RangesDiffer { .. } => formatter.write_str("its groups have different ranges"),
            ErrorKind::DropsDiffer => formatter.write_str("its groups drop to zero at different abscissae"),
            ErrorKind::TooManyRows { most } => write!(formatter, "the folded table would have more than {most} rows"),
            ErrorKind::Grid(refusal) => refusal.fmt(formatter),
        }
    }
}

impl TableFault {
    /// The fault of a row of this number, counted from one.
    fn fmt(self, row: usize, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRows => write!(f, "the table has no rows"),
            Self::IncompleteRow { width, found } => {
                write!(f, "row {row} has {found} of {width} cells")
            }
            Self::NotFinite { column, found } => {
                write!(f, "row {row} has {found} in column {}", column + 1)
            }
            Self::SecondConstant => {
                write!(f, "row {row} follows a constant, which has one row")
            }
            Self::NotAscending { axis, previous, found } => {
                write!(f, "row {row} has {found:?} after {previous:?} in column {}, which must ascend", axis + 2)
            }
            Self::NoSharedPressures { temperatures: [first, second] } => {
                write!(f, "the curves at temperatures {first:?} and {second:?} share no pressures")
            }
        }
    }
}

impl error::Error for Error {}
