//! What the parts of an evaluation cost, in nanoseconds a row on one core: enough to weigh cuts against each other, not a promise.
//!
//! Measured with `inpact-bench costs` and the speed page's benchmark on an x86-64 machine with AVX-512; other machines differ by a factor, hardly in the order.

use super::{AxisPlan, TablePlan};

/// Reading a number from a cell of comma-separated values.
pub(super) const READ_NUMBER: f64 = 18.0;

/// Writing a number as text.
pub(super) const WRITE_NUMBER: f64 = 40.0;

/// One output of a law, without the table.
pub(super) const COMPUTE_OUTPUT: f64 = 2.0;

/// Finding a node's history and adding an increment to it.
pub(super) const KEEP_HISTORY: f64 = 35.0;

/// A value of a table with so many axes that are read, and so many rows.
pub(super) fn of_table(axes: usize, rows: usize) -> f64 {
    /// One axis, knots in registers; one axis, knots in buckets; each axis more multiplies the groups that take part.
    const SMALL: f64 = 1.2;
    const LARGE: f64 = 3.0;
    const NESTED: f64 = 14.0;
    const MORE: f64 = 2.3;
    match axes {
        0 => 0.0,
        1 if rows <= 16 => SMALL,
        1 => LARGE,
        _ => (2..axes).fold(NESTED, |cost, _| cost * MORE),
    }
}

impl TablePlan {
    /// The cost of a value of the whole table.
    pub(super) fn whole_cost(&self) -> f64 {
        of_table(self.axes.iter().filter(|axis| axis.matters).count(), self.rows)
    }

    /// The cost of a value of what is left of it.
    pub(super) fn folded_cost(&self) -> f64 {
        if let Some(form) = &self.form {
            return form.cost;
        }
        of_table(self.axes.iter().filter(|axis| AxisPlan::is_read(axis)).count(), self.folded_rows)
    }
}
