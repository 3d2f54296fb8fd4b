//! One table in one fast form.

use std::fmt;

use super::flat::Flat;
use super::grid::Grid;
use super::registers::Registers;
use super::{ErrorBound, Refusal, running};
use crate::table::PiecewiseTable;

/// The fast forms of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Form {
    /// f64, yᵢ + (x − xᵢ)·sᵢ with slopes computed beforehand; plain linear interpolation across outer axes.
    Slope,
    /// The slope form in f32.
    Single,
    /// Resampled on a regular grid and interpolated multilinearly in f64.
    Grid {
        /// How many cells the grid has along each axis the value depends on, fastest first.
        cells: Vec<usize>,
    },
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Slope => write!(f, "slope"),
            Self::Single => write!(f, "single"),
            Self::Grid { cells } => {
                let cells: Vec<String> = cells.iter().map(usize::to_string).collect();
                write!(f, "grid {}", cells.join("x"))
            }
        }
    }
}

/// A table in a fast form, with the bound of its error.
#[derive(Clone, Debug)]
pub struct Approximation {
    kernel: Kernel,
    bound: ErrorBound,
}

#[derive(Clone, Debug)]
enum Kernel {
    Slope(Flat<f64>, Option<Box<Registers<f64, 16>>>),
    Single(Flat<f32>, Option<Box<Registers<f32, 32>>>),
    Grid(Grid),
}

impl Approximation {
    /// The table in f64 slope form.
    ///
    /// # Errors
    /// Why it has none: it depends on no axis or on more than four, or its numbers are so extreme that a slope or a width would over- or underflow.
    pub fn slope(table: &PiecewiseTable) -> Result<Self, Refusal> {
        let flat = Flat::new(table)?;
        let bound = running::bound(table, &flat);
        let registers = Registers::new(&flat).map(Box::new);
        Ok(Self { kernel: Kernel::Slope(flat, registers), bound })
    }

    /// The table in f32 slope form: knots, values, slopes and coordinates rounded to f32.
    ///
    /// # Errors
    /// As [`Self::slope`] for the range of f32, and where two abscissae would become one.
    pub fn single(table: &PiecewiseTable) -> Result<Self, Refusal> {
        let flat = Flat::new(table)?;
        let bound = running::bound(table, &flat);
        let registers = Registers::new(&flat).map(Box::new);
        Ok(Self { kernel: Kernel::Single(flat, registers), bound })
    }

    /// The table resampled on a regular grid of `cells` along each axis the value depends on, fastest first.
    ///
    /// # Errors
    /// A table of one axis is never resampled; otherwise the grid, or the refinement its error is computed on, is too large.
    pub fn grid(table: &PiecewiseTable, cells: &[usize]) -> Result<Self, Refusal> {
        let (grid, bound) = Grid::new(table, cells)?;
        Ok(Self { kernel: Kernel::Grid(grid), bound })
    }

    /// How far a value can be from the table's, over all queries.
    ///
    /// For [`Form::Single`] coordinates are f64 numbers, rounded inside; the bound holds also for f32 coordinates taken as they are.
    /// Coordinates rounded beforehand are other coordinates: within the range that costs no more than this bound,
    /// but a coordinate rounded across the end of a table that drops to zero there gives the table's value on the other side.
    pub fn bound(&self) -> ErrorBound {
        self.bound
    }

    /// The form.
    pub fn form(&self) -> Form {
        match &self.kernel {
            Kernel::Slope(..) => Form::Slope,
            Kernel::Single(..) => Form::Single,
            Kernel::Grid(grid) => Form::Grid { cells: grid.cells() },
        }
    }

    /// The memory the form takes, in bytes.
    pub fn bytes(&self) -> usize {
        match &self.kernel {
            Kernel::Slope(flat, registers) => flat.bytes() + registers.as_ref().map_or(0, |all| size_of_val(&**all)),
            Kernel::Single(flat, registers) => flat.bytes() + registers.as_ref().map_or(0, |all| size_of_val(&**all)),
            Kernel::Grid(grid) => grid.bytes(),
        }
    }

    /// The value at `point`, one coordinate an axis; the same bits as [`Self::values`] gives.
    ///
    /// NaN where a coordinate the value depends on is NaN or missing, as in [`PiecewiseTable::value`].
    pub fn value(&self, point: &[f64]) -> f64 {
        let columns: Vec<&[f64]> =
            (0..self.axis_count()).map(|axis| point.get(axis).map_or(&[f64::NAN][..], std::slice::from_ref)).collect();
        let mut value = [f64::NAN];
        self.values(&columns, &mut value);
        value[0]
    }

    /// The values at many points, one for each place of `values`: `columns` has a column an axis, which may be empty where the value does not depend on the axis.
    ///
    /// # Panics
    /// If a column that matters is missing or shorter than `values`.
    pub fn values(&self, columns: &[&[f64]], values: &mut [f64]) {
        let rows = values.len();
        match &self.kernel {
            Kernel::Slope(_, Some(registers)) if registers.values(&columns[self.first_axis()][..rows], values) => {}
            Kernel::Single(_, Some(registers)) if registers.values(&columns[self.first_axis()][..rows], values) => {}
            Kernel::Slope(flat, _) => {
                pulp::Arch::new().dispatch(Each { flat, columns, values, convert: |value| value });
            }
            Kernel::Single(flat, _) => pulp::Arch::new().dispatch(Each { flat, columns, values, convert: f64::from }),
            Kernel::Grid(grid) => grid.values(columns, values),
        }
    }

    /// [`Self::values`] from f32 coordinates to f32 values, without a detour for [`Form::Single`]; the other forms compute in f64 and round once.
    ///
    /// # Panics
    /// If a column that matters is missing or shorter than `values`.
    pub fn values_single(&self, columns: &[&[f32]], values: &mut [f32]) {
        let rows = values.len();
        match &self.kernel {
            Kernel::Single(_, Some(registers))
                if registers.values_single(&columns[self.first_axis()][..rows], values) => {}
            Kernel::Single(flat, _) => {
                pulp::Arch::new().dispatch(Each { flat, columns, values, convert: |value| value });
            }
            Kernel::Slope(..) | Kernel::Grid(_) => self.values_widened(columns, values),
        }
    }

    /// f32 columns through an f64 form, a block at a time.
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
    fn values_widened(&self, columns: &[&[f32]], values: &mut [f32]) {
        const BLOCK: usize = 256;
        let mut wide = vec![[0.0; BLOCK]; columns.len()];
        let mut results = [0.0; BLOCK];
        for (block, values) in values.chunks_mut(BLOCK).enumerate() {
            let rows = values.len();
            let start = block * BLOCK;
            for (wide, column) in wide.iter_mut().zip(columns).filter(|(_, column)| !column.is_empty()) {
                for (wide, &single) in wide.iter_mut().zip(&column[start..start + rows]) {
                    *wide = f64::from(single);
                }
            }
            let columns: Vec<&[f64]> = wide.iter().map(|column| &column[..rows]).collect();
            self.values(&columns, &mut results[..rows]);
            for (value, &result) in values.iter_mut().zip(&results) {
                *value = result as f32;
            }
        }
    }

    /// How many columns a query needs: the last axis that matters and all before it.
    fn axis_count(&self) -> usize {
        match &self.kernel {
            Kernel::Slope(flat, _) => flat.levels.last().map_or(0, |level| level.axis + 1),
            Kernel::Single(flat, _) => flat.levels.last().map_or(0, |level| level.axis + 1),
            Kernel::Grid(grid) => grid.axis_count(),
        }
    }

    /// The innermost axis that matters.
    fn first_axis(&self) -> usize {
        match &self.kernel {
            Kernel::Slope(flat, _) => flat.levels[0].axis,
            Kernel::Single(flat, _) => flat.levels[0].axis,
            Kernel::Grid(_) => 0,
        }
    }
}

/// [`Flat::each`] compiled for the processor at hand.
struct Each<'a, T, Q, V, C> {
    flat: &'a Flat<T>,
    columns: &'a [&'a [Q]],
    values: &'a mut [V],
    convert: C,
}

impl<T: super::number::Number, Q: Copy + Into<f64>, V, C: Fn(T) -> V> pulp::WithSimd for Each<'_, T, Q, V, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.flat.each(self.columns, self.values, self.convert);
    }
}
