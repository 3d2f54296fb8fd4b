//! Costs of the parts of an evaluation, in nanoseconds a row on one core: enough to compare simplifications, not a guarantee.
//!
//! The cost of a table follows from its [`Shape`]; the rest is measured with the speed page's benchmark on an x86-64 machine with AVX-512; other machines differ by a factor, hardly in the order.

use super::{AxisPlan, TablePlan};
use crate::accuracy::{Method, Shape};

/// Reading a number from a cell of comma-separated values.
pub(crate) const READ_NUMBER: f64 = 18.0;

/// Writing a number as text.
pub(crate) const WRITE_NUMBER: f64 = 40.0;

/// One output of a law, without the table.
pub(crate) const COMPUTE_OUTPUT: f64 = 2.0;

/// Finding a node's history and adding an increment to it.
pub(crate) const KEEP_HISTORY: f64 = 35.0;

impl TablePlan {
    /// The cost of a value of the original table.
    pub(crate) fn whole_cost(&self) -> f64 {
        self.shape.cost(&Method::Full)
    }

    /// The cost of a value of the folded table in f64.
    pub(crate) fn folded_full_cost(&self) -> f64 {
        self.form.as_ref().map_or_else(|| self.folded_cost(), |form| form.full_cost)
    }

    /// The cost of a value of the folded table.
    pub(crate) fn folded_cost(&self) -> f64 {
        if let Some(form) = &self.form {
            return form.cost;
        }
        let axes = self.axes.iter().filter(|axis| AxisPlan::is_read(axis)).count();
        Shape { axes, ..self.shape }.cost(&Method::Full)
    }
}
