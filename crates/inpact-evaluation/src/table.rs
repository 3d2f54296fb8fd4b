//! Tables of a property against any number of variables: nested piecewise-linear functions.
//!
//! A table's rows are in the order of the deck, the first variable varying fastest (semantics T-01 to T-03; Analysis User's Guide 1.2.1 and 21.1.2).
//! They need not form a grid: each combination of the outer variables has its own abscissae of the inner ones (T-05), and the value is found from the inside out (T-06):
//! each group is interpolated at its own abscissae with its own constant ends, then the results are interpolated over the next variable.
//!
//! Independent of keywords and files: numbers in, numbers out, no allocation at a query.

mod arithmetic;
mod build;
mod evaluate;
mod fold;
mod marks;
mod sides;

pub use sides::Sides;

pub use crate::accuracy::{
    Candidate, Choice, ErrorBound, Grid, Method, Refusal, Shape, choose, commensurate_cells, full_bound,
    reference_bound,
};
pub use crate::evaluator::{Evaluator, FoundValue, SeenError, TableValues};
pub use crate::kernel::{InstructionSet, Search, TableKernel};

use std::sync::Arc;

use crate::numbers::KernelSlope;
use marks::Marks;

/// A nested piecewise-linear function of any number of variables ("axes"), compiled for evaluation.
///
/// Axis 0 is the first variable of the deck's rows and varies fastest; the last axis varies slowest.
/// Without axes the function is a constant.
///
/// Between rows the function is linear along each axis, outside the rows of a group it is constant (T-04), or zero beyond the last row of axis 0 with [`Tail::Zero`].
/// A group with one row is constant along its axis (T-07), except axis 0 with [`Tail::Zero`], which applies beyond a single row too.
/// It is built once and reference-counted: a clone is cheap.
#[derive(Clone, Debug)]
pub struct PiecewiseTable(Arc<Content>);

/// Parts of a table.
#[derive(Clone, Debug)]
struct Content {
    /// The number of axes of the rows.
    axis_count: usize,
    /// The continuation beyond the last row of a group of axis 0.
    tail: Tail,
    /// The axes the value depends on, fastest first. An axis every group of which has one row is left out, unless the value drops beyond it.
    levels: Vec<Level>,
    /// One value per row.
    values: Vec<f64>,
    /// For each row the slope towards the next; meaningless in the last row of a group.
    slopes: Vec<KernelSlope>,
    /// Each axis of the rows, left out or not.
    axes: Vec<AxisSummary>,
    /// Which points count as outside, where the rows of a folded table no longer determine it.
    marks: Option<Marks>,
}

/// Continuations of a table beyond the last abscissa of axis 0 within each group.
///
/// Electrical conductance against clearance is constant by the text of Analysis User's Guide 37.3.1 and zero by its figure;
/// thermal conductance against clearance is zero (37.2.1). At the last abscissa itself the row's value holds in either case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tail {
    /// The last row's value.
    #[default]
    Constant,
    /// Zero immediately beyond the last row.
    Zero,
}

/// One axis of a table, from its rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisSummary {
    /// The smallest abscissa.
    pub least: f64,
    /// The largest abscissa.
    pub greatest: f64,
    /// The number of groups of this axis: 1 for the last axis, and for the others one for each row of the next outer axis.
    pub group_count: usize,
    /// The total number of abscissae of the groups.
    pub knot_count: usize,
    /// The number of distinct ones.
    pub distinct_count: usize,
    /// Whether the value drops to zero beyond the last abscissa of each group: axis 0 under [`Tail::Zero`].
    pub drops: bool,
}

impl AxisSummary {
    /// Whether the table's value depends on this axis at all: some group has two abscissae, or the value drops beyond the last.
    pub fn matters(&self) -> bool {
        self.drops || self.group_count < self.knot_count
    }
}

/// One axis the value depends on: the abscissae of all its groups in row order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Level {
    /// The axis of the rows.
    pub(crate) axis: usize,
    /// The abscissae.
    pub(crate) knots: Vec<f64>,
    /// Knot j owns the knots `children[j]..children[j + 1]` of the level below. Empty in the innermost level, whose knot j owns row j.
    pub(crate) children: Vec<usize>,
    /// Whether the value drops to zero beyond the last knot of each group.
    pub(crate) drops: bool,
}

/// The coordinates of a query: axis 0, then the others.
#[derive(Clone, Copy)]
struct Point<'a> {
    first: f64,
    others: &'a [f64],
}

impl Point<'_> {
    /// The coordinate along `axis`; NaN where the caller gave none.
    #[inline]
    fn along(self, axis: usize) -> f64 {
        match axis {
            0 => self.first,
            _ => self.others.get(axis - 1).copied().unwrap_or(f64::NAN),
        }
    }
}

impl PartialEq for PiecewiseTable {
    /// The same rows with the same tail, and the same points outside.
    fn eq(&self, other: &Self) -> bool {
        let parts = |table: &Self| (table.axis_count(), table.tail());
        parts(self) == parts(other)
            && self.axes() == other.axes()
            && self.levels() == other.levels()
            && self.values() == other.values()
            && self.0.marks == other.0.marks
    }
}

impl PiecewiseTable {
    /// A constant table.
    pub fn constant(value: f64) -> Self {
        Self(Arc::new(Content {
            axis_count: 0,
            tail: Tail::Constant,
            levels: Vec::new(),
            values: vec![value],
            slopes: vec![KernelSlope::UNUSED],
            axes: Vec::new(),
            marks: None,
        }))
    }

    /// The same table with other marks.
    fn marked(&self, marks: Marks) -> Self {
        Self(Arc::new(Content { marks: Some(marks), ..Content::clone(&self.0) }))
    }

    /// The axes the value depends on, fastest first.
    pub(crate) fn levels(&self) -> &[Level] {
        &self.0.levels
    }

    /// For each row the slope towards the next; meaningless in the last row of a group.
    pub(crate) fn slopes(&self) -> &[KernelSlope] {
        &self.0.slopes
    }

    /// The number of axes of the rows, including those that the value does not depend on.
    pub fn axis_count(&self) -> usize {
        self.0.axis_count
    }

    /// The number of rows from which the table was built.
    pub fn row_count(&self) -> usize {
        self.0.values.len()
    }

    /// Each axis' range and size, in the order of the columns.
    pub fn axes(&self) -> &[AxisSummary] {
        &self.0.axes
    }

    /// The number of groups of axis 0, that is, combinations of the outer variables; 1 for a table without axes.
    pub fn group_count(&self) -> usize {
        self.0.axes.first().map_or(1, |axis| axis.group_count)
    }

    /// The values of the rows, in row order.
    pub fn values(&self) -> &[f64] {
        &self.0.values
    }

    /// The continuation beyond the last row of a group of axis 0.
    pub fn tail(&self) -> Tail {
        self.0.tail
    }
}
