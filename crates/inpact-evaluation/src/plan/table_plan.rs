//! Parts of the plans of all laws: the columns that decide contact, histories, tables with their forms and axes.

use crate::accuracy::{ErrorBound, Method, Shape, Wanted};
use crate::error::Error;
use crate::evaluator::Evaluator;
use crate::law::contact::ContactState;
use crate::nodes::Column;
use crate::results::Along;
use crate::table::Tail;

/// The columns that tell clearance, contact pressure and contact, those that have numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ContactColumns {
    /// `clearance`.
    pub clearance: Option<Column>,
    /// `pressure`.
    pub pressure: Option<Column>,
    /// `closed`.
    pub closed: Option<Column>,
    /// The state of every row, where there is only one: then the columns are read for the tables alone.
    pub state: Option<ContactState>,
}

/// Whether the rows of a node are increments of a history.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum History {
    /// They are: `node` and `time` are there.
    ByTime,
    /// Every row stands for itself.
    None,
}

/// A table in use.
#[derive(Debug, Clone, PartialEq)]
pub struct TablePlan {
    /// The first of its variables.
    pub against: Along,
    /// How many rows it has.
    pub rows: usize,
    /// The continuation beyond its last row.
    pub tail: Tail,
    /// Whether the last value of every group is zero, so that no choice of tail makes a difference.
    pub ends_in_zero: bool,
    /// Its variables.
    pub axes: Vec<AxisPlan>,
    /// How many rows are left of it once it is folded.
    pub folded_rows: usize,
    /// The variables that have one value and along which it could not be folded.
    pub not_folded: Vec<(Along, Error)>,
    /// The properties that decide how fast the whole table is evaluated.
    pub shape: Shape,
    /// The form in which it is evaluated; `None` for a table that no row reaches.
    pub form: Option<FormPlan>,
}

/// The form in which a table is evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct FormPlan {
    /// How its values are found.
    pub method: Method,
    /// How exactly they were to be found.
    pub wanted: Wanted,
    /// The bound of their error, where there is one.
    pub bound: Option<ErrorBound>,
    /// A tolerance that the bound is above, as no form keeps it.
    pub missed: Option<f64>,
    /// The cost of a value by the shape of the table, in about a nanosecond.
    pub cost: f64,
    /// The cost by the table's own kernel.
    pub full_cost: f64,
    /// The other ways that were considered, and why they were not chosen.
    pub refused: Vec<(String, String)>,
    /// The table, folded, ready to be evaluated in that form.
    pub(crate) evaluator: Evaluator,
}

/// A variable of a table in use.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisPlan {
    /// Which one it is.
    pub along: Along,
    /// Its smallest abscissa.
    pub least: f64,
    /// Its largest abscissa.
    pub greatest: f64,
    /// How many different abscissae there are.
    pub points: usize,
    /// Whether the table's value depends on it; otherwise nothing of the node table is read for it.
    pub matters: bool,
    /// Its value in every row, along which the table is folded.
    pub fold: Option<f64>,
    /// Whether the table no longer depends on it once others are folded.
    pub is_idle: bool,
}
