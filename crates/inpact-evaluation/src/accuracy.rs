//! Accuracy of table evaluation: double-double, f64 to within rounding, or faster on a grid with an a-priori error bound.
//!
//! [`choose`] takes the cheapest [`Method`] whose error bound is acceptable.
//! A bound is computed from the table and holds for every finite query; it is never an estimate from a sample.
//!
//! The rules of evaluation are those of [`crate::table`]: T-04 to T-07, constant ends, [`Tail::Zero`](crate::table::Tail), NaN in gives NaN out.
//! Knows tables and numbers, no plan, no column names, no files.

#![allow(clippy::inline_always, reason = "what is not inlined is not compiled for the processor at hand")]

mod choose;
mod grid;
mod refusal;
mod vertices;
mod wanted;
mod work;

pub use choose::{Candidate, Choice, choose};
pub use grid::{Grid, commensurate_cells};
pub use refusal::Refusal;
pub(crate) use wanted::FAST_TOLERANCE;
pub use wanted::{Tolerance, Wanted};
pub use work::{Method, Shape};

use crate::table::{AxisSummary, PiecewiseTable};

/// The accuracy a user asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Accuracy {
    /// Double-double throughout, rounded once: within 0.501 ulp.
    Reference,
    /// f64, within n + 1 ulp for n axes: the table's own kernel.
    #[default]
    Full,
    /// The cheapest method whose error bound is acceptable; never slower than [`Self::Full`] by the shape of the table.
    Fast,
}

/// The error bound of a method for a table, over all finite queries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorBound {
    /// The largest error, in the unit of the table's values.
    pub absolute: f64,
    /// [`Self::absolute`] relative to the largest magnitude among the table's values.
    pub relative_to_largest: f64,
    /// The largest error relative to the exact value at the same point.
    /// Where that value is below the smallest normal f64, 2.2e-308, the error is taken relative to the latter.
    /// Infinite where the value can be zero, or arbitrarily small, while the error is not.
    pub pointwise: f64,
}

impl ErrorBound {
    /// No error at all.
    pub const EXACT: Self = Self { absolute: 0.0, relative_to_largest: 0.0, pointwise: 0.0 };

    /// The bound of a table whose values were rounded before.
    pub(crate) fn and_half_an_ulp(self, table: &PiecewiseTable) -> Self {
        let largest = largest_magnitude(table.values());
        if largest == 0.0 {
            return self;
        }
        Self::of_magnitudes(
            self.absolute + 0.5 * crate::numbers::ulp(largest),
            self.pointwise + 0.5 * f64::EPSILON,
            largest,
        )
    }

    /// The bound of a table whose values have the magnitude `largest` at most.
    pub(crate) fn of_magnitudes(absolute: f64, pointwise: f64, largest: f64) -> Self {
        let relative_to_largest = if absolute == 0.0 { 0.0 } else { absolute / largest };
        Self { absolute, relative_to_largest, pointwise }
    }
}

/// The error bound of the table's own kernel, n + 1 ulp for n axes that the value depends on.
///
/// An ulp is at most 2⁻⁵² of a value. The error for values of opposite sign is relative to the larger value: where the result is near zero, its relative error is unbounded,
/// so the pointwise bound of such a table is infinite.
pub fn full_bound(table: &PiecewiseTable) -> ErrorBound {
    let axes = table.axes().iter().filter(|axis| axis.matters()).count();
    bound_in_ulps(table, if axes == 0 { 0.0 } else { axes as f64 + 1.0 })
}

/// The error bound of the reference: one rounding, plus the error of 106-bit arithmetic.
pub fn reference_bound(table: &PiecewiseTable) -> ErrorBound {
    bound_in_ulps(table, if table.axes().iter().any(AxisSummary::matters) { 0.501 } else { 0.0 })
}

fn bound_in_ulps(table: &PiecewiseTable, ulps: f64) -> ErrorBound {
    if ulps == 0.0 {
        return ErrorBound::EXACT;
    }
    let relative = ulps * f64::EPSILON;
    let has_one_sign =
        table.values().iter().all(|&value| value >= 0.0) || table.values().iter().all(|&value| value <= 0.0);
    let largest = largest_magnitude(table.values());
    if largest == 0.0 {
        // Nothing is rounded where all values are zero.
        return ErrorBound::EXACT;
    }
    ErrorBound::of_magnitudes(
        ulps * crate::numbers::ulp(largest),
        if has_one_sign { relative } else { f64::INFINITY },
        largest,
    )
}

/// The largest magnitude among `values`.
pub(crate) fn largest_magnitude(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}
