//! Costs of a row in each method, by the shape of the table alone: searches, interpolations and divisions, counted.
//!
//! The unit is about a nanosecond of a present-day core with AVX2; only the order matters for the choice, and it follows from the counts:
//!
//! - `full` searches each axis, once for all groups that share their abscissae and once a group where they do not, and interpolates 2ⁿ⁻¹ times along the innermost axis;
//!   each of the 2ⁿ⁻¹ − 1 interpolations along outer axes takes two divisions, since the values between which it interpolates are known only at the query;
//! - a grid needs no search and has 2ⁿ − 1 fused multiply-adds. With one axis it would save a search that takes no longer than its own loads,
//!   and lose the abscissae: there it gains nothing.
//!
//! `cargo bench -p inpact-bench --bench kernels` compares the times of all of them.

use crate::table::PiecewiseTable;
use std::fmt;

/// One search in a batch for all rows, and one that each row makes in a group of its own.
const SEARCH: f64 = 1.0;
const SEARCH_IN_OWN_GROUP: f64 = 2.0;
/// An interpolation with a slope computed beforehand, and one between values found at the query.
const ALONG_ROWS: f64 = 0.6;
const BETWEEN_GROUPS: f64 = 3.0;
/// The cell of a coordinate in a grid, and a fused multiply-add.
const CELL: f64 = 0.7;
const FUSED: f64 = 0.5;
/// An interpolation in double-double, row by row.
const DOUBLE_DOUBLE: f64 = 40.0;

/// A way to evaluate a table.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// Double-double, rounded once.
    Reference,
    /// The table itself in f64.
    Full,
    /// The table resampled on a regular grid, interpolated multilinearly in f64.
    Grid {
        /// How many cells the grid has along each axis the value depends on, fastest first.
        cells: Vec<usize>,
    },
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reference => write!(f, "reference"),
            Self::Full => write!(f, "full"),
            Self::Grid { cells } => {
                let cells: Vec<String> = cells.iter().map(usize::to_string).collect();
                write!(f, "grid {}", cells.join("x"))
            }
        }
    }
}

/// The properties of a table that decide the cost of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// The number of axes that the value depends on.
    pub axes: usize,
    /// Whether all groups of each axis have the same abscissae.
    pub is_rectilinear: bool,
}

impl Shape {
    /// The shape of a table.
    pub fn of(table: &PiecewiseTable) -> Self {
        let is_rectilinear = table.axes().iter().all(|axis| axis.knot_count == axis.group_count * axis.distinct_count);
        Self { axes: table.levels().len(), is_rectilinear }
    }

    /// The cost of a row, in units of about a nanosecond; 0 for a constant.
    pub fn cost(self, method: &Method) -> f64 {
        if self.axes == 0 {
            return 0.0;
        }
        let groups = 2_f64.powi(i32::try_from(self.axes).unwrap_or(i32::MAX) - 1);
        match method {
            Method::Full => {
                let own_searches = if self.is_rectilinear { 0.0 } else { 2.0 * groups - 2.0 };
                let shared_searches = if self.is_rectilinear { self.axes as f64 } else { 1.0 };
                SEARCH * shared_searches
                    + SEARCH_IN_OWN_GROUP * own_searches
                    + ALONG_ROWS * groups
                    + BETWEEN_GROUPS * (groups - 1.0)
            }
            Method::Reference => DOUBLE_DOUBLE * (groups + 1.0),
            Method::Grid { .. } if self.axes == 1 => f64::INFINITY,
            Method::Grid { .. } => CELL * self.axes as f64 + FUSED * (2.0 * groups - 1.0),
        }
    }
}
