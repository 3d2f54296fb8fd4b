//! A table with its evaluation method, by the requested accuracy, over columns.
//!
//! The meaning of a law's tables is in [`crate::table`]; the accuracy and speed of their evaluation are chosen once ([`choose`]).

use std::sync::Arc;

use crate::accuracy::{Choice, Grid, Method, Wanted, choose};
use crate::kernel::{OnlyRange, TableKernel};
use crate::numbers::Scaled;
use crate::table::{PiecewiseTable, Sides};

/// A table with its evaluation method, for columns of coordinates; built once and shared.
#[derive(Clone, Debug)]
pub struct Evaluator(Arc<Ready>);

#[derive(Debug)]
struct Ready {
    table: PiecewiseTable,
    method: Method,
    kernel: TableKernel,
    grid: Option<Resampled>,
}

/// Data besides the table where a grid replaces it.
#[derive(Debug)]
struct Resampled {
    grid: Grid,
    /// The table with marks, if its axes have one range each: it finds rows outside without a search.
    marked: Option<PiecewiseTable>,
}

/// The value of a table at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundValue {
    /// The value, rounded.
    pub value: f64,
    /// The part lost by rounding, where the method gives it.
    pub rest: Option<f64>,
    /// On which sides of the table the point lies outside.
    pub sides: Sides,
}

/// The values of a table in some rows.
#[derive(Clone, Debug, Default)]
pub struct TableValues {
    /// The values, rounded.
    pub values: Vec<f64>,
    /// The part lost by rounding; empty unless the method gives it.
    pub rests: Vec<f64>,
    /// On which sides of the table each row lies outside; empty where all of them lie within.
    pub sides: Vec<Sides>,
}

impl TableValues {
    /// On which sides of the table a row lies outside.
    #[inline]
    pub fn sides_of(&self, row: usize) -> Sides {
        self.sides.get(row).copied().unwrap_or_default()
    }
}

/// The largest error in a sample of rows, against the reference.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeenError {
    /// The number of rows compared.
    pub rows: u64,
    /// The largest error relative to the reference value of its row; infinite where that is zero.
    pub pointwise: f64,
    /// The largest error relative to the largest magnitude in the table.
    pub relative_to_largest: f64,
}

impl Evaluator {
    /// The table, with the method chosen for it here.
    pub fn new(table: &PiecewiseTable, wanted: Wanted) -> Self {
        Self::of_choice(table, choose(table, wanted))
    }

    /// The table, with the method already chosen for it.
    pub fn of_choice(table: &PiecewiseTable, choice: Choice) -> Self {
        let grid = choice.grid.map(|grid| Resampled { grid, marked: table.with_marks() });
        let (table, kernel) = (table.clone(), TableKernel::new(table));
        Self(Arc::new(Ready { table, method: choice.chosen.method, kernel, grid }))
    }

    /// The table itself.
    pub fn table(&self) -> &PiecewiseTable {
        &self.0.table
    }

    /// The values at some points, one column of coordinates for each axis; a column that the table does not depend on may be empty.
    pub fn evaluate(&self, columns: &[&[f64]], rows: usize, found: &mut TableValues) {
        found.values.resize(rows, f64::NAN);
        found.sides.clear();
        found.rests.clear();
        let marked = self.0.grid.as_ref().and_then(|resampled| resampled.marked.as_ref());
        match (marked, self.0.kernel.only_range()) {
            (Some(marked), _) => {
                found.sides.resize(rows, Sides::default());
                marked.mark_sides(columns, &mut found.sides);
            }
            (None, Some(range)) if !range.is_left_by(columns, rows) => self.0.kernel.values(columns, &mut found.values),
            // Without a single range per axis only the table itself can determine which rows lie outside.
            (None, _) => {
                found.sides.resize(rows, Sides::default());
                self.0.kernel.values_and_sides(columns, &mut found.values, &mut found.sides);
            }
        }
        if let Some(resampled) = &self.0.grid {
            resampled.grid.values(columns, &mut found.values);
        } else if self.0.method == Method::Reference {
            for row in 0..rows {
                let (value, rest) = self.reference_in(columns, row);
                found.values[row] = value;
                found.rests.push(rest);
            }
        }
    }

    /// The table's kernel, where its values are those of the kernel and depend on the first coordinate only: then evaluating all rows costs less than selecting
    /// those that need it.
    pub(crate) fn small_kernel(&self) -> Option<(&TableKernel, OnlyRange)> {
        let is_plain = self.0.grid.is_none() && self.0.method == Method::Full;
        let range = self.0.kernel.only_range().filter(|range| is_plain && range.axis == 0)?;
        Some((&self.0.kernel, range))
    }

    /// The value at one point.
    pub fn value_at(&self, first: f64, others: &[f64]) -> FoundValue {
        let (value, sides) = self.0.table.value_and_sides_at(first, others);
        if let Some(resampled) = &self.0.grid {
            let point: Vec<f64> = std::iter::once(first).chain(others.iter().copied()).collect();
            return FoundValue { value: resampled.grid.value(&point), rest: None, sides };
        }
        if self.0.method == Method::Reference {
            let (value, rest) = self.reference_at(first, others);
            return FoundValue { value, rest: Some(rest), sides };
        }
        FoundValue { value, rest: None, sides }
    }

    /// Compares an evenly spaced sample of the values with the reference.
    pub fn compare(&self, columns: &[&[f64]], values: &[f64], seen: &mut SeenError) {
        let largest = self.largest();
        for row in Self::compared(values.len()) {
            seen.take(values[row], self.reference_in(columns, row), largest);
        }
    }

    /// The indices of the values that are compared with the reference.
    pub(crate) fn compared(count: usize) -> impl Iterator<Item = usize> {
        /// The sample size per batch.
        const SAMPLE: usize = 16;
        (0..count).step_by(count.div_ceil(SAMPLE).max(1))
    }

    /// Compares the value at one point of a table that depends on its first coordinate alone.
    pub(crate) fn compare_one(&self, first: f64, value: f64, seen: &mut SeenError) {
        seen.take(value, self.reference_at(first, &[]), self.largest());
    }

    fn largest(&self) -> f64 {
        self.0.table.values().iter().fold(0.0_f64, |largest, value| largest.max(value.abs()))
    }

    /// The reference value in a row, rounded, and the rounding error.
    fn reference_in(&self, columns: &[&[f64]], row: usize) -> (f64, f64) {
        let coordinate = |column: &&[f64]| column.get(row).copied().unwrap_or(f64::NAN);
        let mut coordinates = columns.iter().map(coordinate);
        let first = coordinates.next().unwrap_or(f64::NAN);
        let others: Vec<f64> = coordinates.collect();
        self.reference_at(first, &others)
    }

    fn reference_at(&self, first: f64, others: &[f64]) -> (f64, f64) {
        self.0.table.reference_at(first, others).map_or((f64::NAN, 0.0), Scaled::to_pair)
    }
}

impl PartialEq for Evaluator {
    /// The same table, evaluated in the same way.
    fn eq(&self, other: &Self) -> bool {
        self.0.table == other.0.table && self.0.method == other.0.method
    }
}

impl SeenError {
    /// Takes a value with the reference and its rounding error.
    fn take(&mut self, value: f64, (reference, rest): (f64, f64), largest: f64) {
        if !reference.is_finite() {
            return;
        }
        // The remainder resolves errors of less than an ulp.
        let error = ((value - reference) - rest).abs();
        self.rows += 1;
        if error > 0.0 {
            self.pointwise = self.pointwise.max(error / reference.abs());
            self.relative_to_largest = self.relative_to_largest.max(error / largest);
        }
    }

    /// Merges the errors of another sample.
    pub fn merge(&mut self, other: &Self) {
        self.rows += other.rows;
        self.pointwise = self.pointwise.max(other.pointwise);
        self.relative_to_largest = self.relative_to_largest.max(other.relative_to_largest);
    }
}
