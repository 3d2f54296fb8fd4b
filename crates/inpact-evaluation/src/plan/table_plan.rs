//! Parts of the plans of all laws: the columns that decide contact, histories, tables with their forms and axes.

use crate::accuracy::{ErrorBound, Method, Shape, Wanted};
use crate::error::Error;
use crate::evaluator::Evaluator;
use crate::law::contact::ContactState;
use crate::nodes::Column;
use crate::results::Along;
use crate::table::Tail;

/// The columns of clearance, contact pressure and contact that have numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ContactColumns {
    /// `clearance`.
    pub clearance: Option<Column>,
    /// `pressure`.
    pub pressure: Option<Column>,
    /// `closed`.
    pub closed: Option<Column>,
    /// The state of all rows, where it is the same: then the columns are read for the tables only.
    pub state: Option<ContactState>,
}

/// Whether the rows of a node are increments of a history.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum History {
    /// They are: `node` and `time` are there.
    ByTime,
    /// Rows are independent.
    None,
}

/// A table in use.
#[derive(Debug, Clone, PartialEq)]
pub struct TablePlan {
    /// The first of its variables.
    pub against: Along,
    /// The number of rows.
    pub rows: usize,
    /// The continuation beyond its last row.
    pub tail: Tail,
    /// Whether the last value of every group is zero, so that no choice of tail makes a difference.
    pub ends_in_zero: bool,
    /// Its variables.
    pub axes: Vec<AxisPlan>,
    /// The number of rows after folding.
    pub folded_rows: usize,
    /// The variables with a constant value along which it could not be folded.
    pub not_folded: Vec<(Along, Error)>,
    /// The shape that determines the cost of the whole table.
    pub shape: Shape,
    /// The method by which it is evaluated; `None` for a table that no row reaches.
    pub form: Option<FormPlan>,
}

/// The method by which a table is evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct FormPlan {
    /// The method.
    pub method: Method,
    /// The requested accuracy.
    pub wanted: Wanted,
    /// The error bound, where there is one.
    pub bound: Option<ErrorBound>,
    /// A tolerance that the bound exceeds, as no method meets it.
    pub missed: Option<f64>,
    /// The cost of a value by the shape of the table, in units of about a nanosecond.
    pub cost: f64,
    /// The cost by the table's own kernel.
    pub full_cost: f64,
    /// The other methods considered, and why they were not chosen.
    pub refused: Vec<(String, String)>,
    /// The evaluator of the folded table.
    pub(crate) evaluator: Evaluator,
}

/// A variable of a table in use.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisPlan {
    /// The variable.
    pub along: Along,
    /// Its smallest abscissa.
    pub least: f64,
    /// Its largest abscissa.
    pub greatest: f64,
    /// The number of distinct abscissae.
    pub points: usize,
    /// Whether the table's value depends on it; otherwise no column of the node table is read for it.
    pub matters: bool,
    /// Its constant value, at which the table is folded.
    pub fold: Option<f64>,
    /// Whether the table no longer depends on it once others are folded.
    pub is_idle: bool,
}
