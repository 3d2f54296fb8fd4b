//! Kernels of the `full` mode: columns in, columns out, vectorised, bitwise equal to the scalar functions.
//!
//! A [`TableKernel`] evaluates a [`PiecewiseTable`] over columns; [`electrical`] computes all electrical outputs in one pass.
//! The instruction set is selected at run time ([`InstructionSet`]); the results depend neither on it nor on the number of threads.
//!
//! The vectors compute the same expression as [`crate::numbers::interpolate`] and [`crate::numbers::between`], operation by operation.
//! Where these take a slow path (a segment without kernel slope, extreme exponents), the vector gives NaN,
//! and every row that is NaN is recomputed by [`PiecewiseTable::value_and_sides_at`].
//!
//! A kernel knows numbers and tables only; it allocates nothing per row.

#![expect(
    clippy::inline_always,
    reason = "what is not inlined is compiled without the instruction set that was asked for"
)]

mod axis;
pub(crate) mod electrical;
mod instruction_set;
mod lanes;
mod nested;
mod pieces;
#[cfg(target_arch = "x86_64")]
mod registers;
pub(crate) mod scan;
mod search;
#[cfg(target_arch = "x86_64")]
mod vectors;

pub use instruction_set::InstructionSet;
pub(crate) use instruction_set::Operation;
pub(crate) use lanes::Lanes;
pub use search::Search;

use crate::table::{PiecewiseTable, Sides};
use nested::NestedKernel;

/// A table prepared for evaluation over columns.
#[derive(Clone, Debug)]
pub struct TableKernel {
    /// Evaluates the rows that the vectors leave as NaN.
    table: PiecewiseTable,
    shape: Shape,
    set: InstructionSet,
}

/// The range of the one axis that a table depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnlyRange {
    pub(crate) axis: usize,
    /// Below and above these a point is outside the table; infinite for a table of one knot.
    pub(crate) below: f64,
    pub(crate) above: f64,
}

impl OnlyRange {
    /// Whether any of some rows lies outside the table; NaN does not.
    pub(crate) fn is_left_by(&self, columns: &[&[f64]], rows: usize) -> bool {
        scan::has_outside(column_of(columns, self.axis, rows), self.below, self.above)
    }

    /// On which sides a point lies.
    #[inline(always)]
    pub(crate) fn sides(&self, x: f64) -> Sides {
        let mut sides = Sides::default();
        if x < self.below {
            sides.mark_below(self.axis);
        }
        if self.above < x {
            sides.mark_above(self.axis);
        }
        sides
    }
}

/// How the table is evaluated.
#[derive(Clone, Debug)]
enum Shape {
    Constant(f64),
    Nested {
        /// The table in vector registers, if it has one axis and is small, for processors with enough registers.
        #[cfg(target_arch = "x86_64")]
        registers: Option<Box<registers::RegisterKernel>>,
        nested: NestedKernel,
    },
}

impl TableKernel {
    /// Prepares a table.
    pub fn new(table: &PiecewiseTable) -> Self {
        let shape = if table.levels().is_empty() {
            Shape::Constant(table.values()[0])
        } else {
            Shape::Nested {
                #[cfg(target_arch = "x86_64")]
                registers: registers::RegisterKernel::new(table).map(Box::new),
                nested: NestedKernel::new(table),
            }
        };
        Self { table: table.clone(), shape, set: InstructionSet::best() }
    }

    /// The values of all rows: `columns` holds one slice per axis, axis 0 first.
    ///
    /// The slice of an axis that the table does not depend on may be empty or left out, any other must have `values.len()` rows.
    /// A row with NaN along an axis the table depends on gives NaN.
    ///
    /// # Panics
    /// Where a column the table depends on is shorter than `values`.
    pub fn values(&self, columns: &[&[f64]], values: &mut [f64]) {
        self.values_with(self.set, columns, values);
    }

    /// [`Self::values`], and on which sides of the table each row lies.
    ///
    /// # Panics
    /// Where a column the table depends on is shorter than `values`, or `sides` is.
    pub fn values_and_sides(&self, columns: &[&[f64]], values: &mut [f64], sides: &mut [Sides]) {
        self.values_and_sides_with(self.set, columns, values, sides);
    }

    /// [`Self::values`] with the instructions of `set`, for tests and measurements. A set that this machine lacks is replaced by scalar instructions.
    pub fn values_with(&self, set: InstructionSet, columns: &[&[f64]], values: &mut [f64]) {
        match &self.shape {
            Shape::Constant(value) => values.fill(*value),
            #[cfg(target_arch = "x86_64")]
            Shape::Nested { registers: Some(registers), .. } if set == InstructionSet::Avx512 => {
                if registers.values(column_of(columns, registers.axis, values.len()), values) {
                    self.redo(columns, values, None);
                }
            }
            Shape::Nested { nested, .. } => {
                if set.run(NestedValues { nested, set, columns, values: &mut *values, sides: None }) {
                    self.redo(columns, values, None);
                }
            }
        }
    }

    /// [`Self::values_and_sides`] with the instructions of `set`.
    ///
    /// # Panics
    /// Where a column the table depends on is shorter than `values`, or `sides` is.
    pub fn values_and_sides_with(
        &self,
        set: InstructionSet,
        columns: &[&[f64]],
        values: &mut [f64],
        sides: &mut [Sides],
    ) {
        let sides = &mut sides[..values.len()];
        if self.table.marks_sides() {
            self.values_with(set, columns, values);
            self.table.mark_sides(columns, sides);
            return;
        }
        sides.fill(Sides::default());
        match &self.shape {
            Shape::Constant(value) => values.fill(*value),
            #[cfg(target_arch = "x86_64")]
            Shape::Nested { registers: Some(registers), .. } if set == InstructionSet::Avx512 => {
                let column = column_of(columns, registers.axis, values.len());
                let redo = registers.values(column, values);
                registers.sides(column, sides);
                if redo {
                    self.redo(columns, values, Some(sides));
                }
            }
            Shape::Nested { nested, .. } => {
                if set.run(NestedValues { nested, set, columns, values: &mut *values, sides: Some(&mut *sides) }) {
                    self.redo(columns, values, Some(sides));
                }
            }
        }
    }

    /// The range of the only axis that the table depends on, where its rows determine which points lie outside.
    pub(crate) fn only_range(&self) -> Option<OnlyRange> {
        let [level] = self.table.levels() else { return None };
        if self.table.marks_sides() {
            return None;
        }
        let (below, above) = match level.knots[..] {
            [_] if !level.drops => (f64::NEG_INFINITY, f64::INFINITY),
            [only] => (only, only),
            [first, .., last] => (first, last),
            [] => return None,
        };
        Some(OnlyRange { axis: level.axis, below, above })
    }

    /// The search method for the rows' segments.
    pub fn search(&self) -> Search {
        match &self.shape {
            Shape::Constant(_) => Search::Constant,
            #[cfg(target_arch = "x86_64")]
            Shape::Nested { registers: Some(_), .. } if self.set == InstructionSet::Avx512 => Search::Registers,
            Shape::Nested { nested, .. } => nested.search(),
        }
    }

    /// Recomputes the rows whose value is NaN by the scalar functions.
    #[cold]
    fn redo(&self, columns: &[&[f64]], values: &mut [f64], mut sides: Option<&mut [Sides]>) {
        let mut others = [f64::NAN; FEW_AXES];
        let mut many_others = Vec::new();
        let other_count = columns.len().saturating_sub(1);
        let others = if other_count <= FEW_AXES {
            &mut others[..other_count]
        } else {
            many_others.resize(other_count, f64::NAN);
            &mut many_others[..]
        };
        for row in 0..values.len() {
            if !values[row].is_nan() {
                continue;
            }
            let along = |axis: usize| columns.get(axis).and_then(|column| column.get(row)).copied().unwrap_or(f64::NAN);
            for (index, other) in others.iter_mut().enumerate() {
                *other = along(index + 1);
            }
            let (value, row_sides) = self.table.value_and_sides_at(along(0), others);
            values[row] = value;
            if let Some(sides) = &mut sides {
                sides[row] = row_sides;
            }
        }
    }
}

/// The number of coordinates besides axis 0 that need no allocation when a row is recomputed.
const FEW_AXES: usize = 16;

/// The column of `axis`, as long as there are rows.
#[inline(always)]
fn column_of<'a>(columns: &[&'a [f64]], axis: usize, rows: usize) -> &'a [f64] {
    &columns[axis][..rows]
}

/// [`NestedKernel::values`] as an operation under an instruction set.
struct NestedValues<'a> {
    nested: &'a NestedKernel,
    set: InstructionSet,
    columns: &'a [&'a [f64]],
    values: &'a mut [f64],
    sides: Option<&'a mut [Sides]>,
}

impl Operation for NestedValues<'_> {
    type Output = bool;

    #[inline(always)]
    fn call<L: Lanes>(self, lanes: L) -> bool {
        self.nested.values(lanes, self.set, self.columns, self.values, self.sides)
    }
}
