//! The list of measured modes, each with its evaluation of a table, its error bound and its memory traffic.
//!
//! Only values are computed, columns in, columns out, in blocks of the size that an evaluation uses.

use super::subjects::Subject;
use inpact_evaluation::table::{
    ErrorBound, Grid, Refusal, TableKernel, commensurate_cells, full_bound, reference_bound,
};
use std::hint::black_box;

pub(super) struct Mode {
    pub(super) name: &'static str,
    /// Prepares it for a table, or returns why it does not support that table.
    pub(super) of: for<'a> fn(&'a Subject) -> Result<Prepared<'a>, String>,
}

/// A mode prepared for a table and its rows: f64 columns through a block function.
pub(super) struct Prepared<'a> {
    columns: Vec<&'a [f64]>,
    of_block: OfBlock<'a>,
    output: Vec<f64>,
    pub(super) form: String,
    /// The error bound.
    pub(super) bound: ErrorBound,
}

/// Computes the values of a block of rows from its coordinates, one column per axis.
type OfBlock<'a> = Box<dyn FnMut(&[&[f64]], &mut [f64]) + 'a>;

/// The coarsest grids timed in addition to [`MODES`] have these cells along each axis, by the number of axes; the finest that fit into cache first.
const GRIDS: [[usize; 3]; 3] = [[128, 32, 8], [30, 12, 4], [12, 6, 2]];

/// All modes, most accurate first.
pub(super) const MODES: &[Mode] = &[
    Mode {
        name: "reference",
        of: |subject| {
            let table = &subject.table;
            let mut others = vec![f64::NAN; subject.columns.len().saturating_sub(1)];
            let of_block = move |columns: &[&[f64]], values: &mut [f64]| {
                let coordinate = |axis: usize, row: usize| columns[axis].get(row).copied().unwrap_or(f64::NAN);
                for (row, value) in values.iter_mut().enumerate() {
                    for (index, other) in others.iter_mut().enumerate() {
                        *other = coordinate(index + 1, row);
                    }
                    *value = table.reference_value_at(coordinate(0, row), &others);
                }
            };
            Ok(Prepared::new(subject, Box::new(of_block), "double-double", reference_bound(table)))
        },
    },
    Mode {
        name: "full",
        of: |subject| {
            let kernel = TableKernel::new(&subject.table);
            let of_block = move |columns: &[&[f64]], values: &mut [f64]| kernel.values(columns, values);
            Ok(Prepared::new(subject, Box::new(of_block), "kernel", full_bound(&subject.table)))
        },
    },
    Mode { name: "grid exact", of: exact_grid },
    Mode { name: "grid fine", of: |subject| grid(subject, 0) },
    Mode { name: "grid medium", of: |subject| grid(subject, 1) },
    Mode { name: "grid coarse", of: |subject| grid(subject, 2) },
];

/// The block size in rows, as in an evaluation.
const ROWS_OF_A_BLOCK: usize = 1024;

impl<'a> Prepared<'a> {
    fn new(subject: &'a Subject, of_block: OfBlock<'a>, form: &str, bound: ErrorBound) -> Self {
        let columns = subject.columns.iter().map(Vec::as_slice).collect();
        Self { columns, of_block, output: vec![0.0; subject.rows()], form: form.to_owned(), bound }
    }

    /// Evaluates every row.
    pub(super) fn run(&mut self) {
        each_block(&self.columns, &mut self.output, &mut self.of_block);
    }

    /// The value of a row, from the previous run.
    pub(super) fn value(&self, row: usize) -> f64 {
        self.output[row]
    }

    /// The coordinate of a row from its columns; NaN along an axis that the value does not depend on.
    pub(super) fn coordinate(&self, axis: usize, row: usize) -> f64 {
        self.columns[axis].get(row).copied().unwrap_or(f64::NAN)
    }
}

/// The table on a grid.
fn resampled<'a>(subject: &'a Subject, cells: &[usize]) -> Result<Prepared<'a>, String> {
    let grid = Grid::new(&subject.table, cells).map_err(|refusal| refusal.to_string())?;
    let bound = grid.bound();
    let cells: Vec<String> = cells.iter().map(usize::to_string).collect();
    let of_block = move |columns: &[&[f64]], values: &mut [f64]| grid.values(columns, values);
    Ok(Prepared::new(subject, Box::new(of_block), &format!("grid {}", cells.join("x")), bound))
}

/// The grid that is the table itself up to rounding.
fn exact_grid(subject: &Subject) -> Result<Prepared<'_>, String> {
    if subject.axes() < 2 {
        return Err(Refusal::OneAxis.to_string());
    }
    let cells = commensurate_cells(&subject.table)
        .ok_or_else(|| "no regular grid that stays in cache meets all abscissae".to_owned())?;
    resampled(subject, &cells)
}

/// The grid of one of the standard sizes.
fn grid(subject: &Subject, size: usize) -> Result<Prepared<'_>, String> {
    let axes = subject.axes();
    let cells = GRIDS.get(axes.saturating_sub(2)).map_or(1, |sizes| sizes[size]);
    resampled(subject, &vec![cells; axes])
}

fn each_block(columns: &[&[f64]], output: &mut [f64], mut of_block: impl FnMut(&[&[f64]], &mut [f64])) {
    let mut block: Vec<&[f64]> = Vec::with_capacity(columns.len());
    for (number, output) in output.chunks_mut(ROWS_OF_A_BLOCK).enumerate() {
        let start = number * ROWS_OF_A_BLOCK;
        block.clear();
        block.extend(columns.iter().map(|column| column.get(start..start + output.len()).unwrap_or_default()));
        of_block(&block, output);
    }
    black_box(output);
}

/// A copy of the same columns: the minimum memory traffic of any mode.
pub(super) struct Copied {
    columns: Vec<Vec<f64>>,
    output: Vec<f64>,
}

impl Copied {
    pub(super) fn new(subject: &Subject) -> Self {
        Self { columns: subject.columns.clone(), output: vec![0.0; subject.rows()] }
    }

    /// Reads and writes each column, in the same blocks.
    pub(super) fn run(&mut self) {
        for column in self.columns.iter().filter(|column| !column.is_empty()) {
            each_block(&[column], &mut self.output, |columns, values| values.copy_from_slice(columns[0]));
        }
    }
}

/// The part of the time of a copy that moving a row of a mode takes: its coordinates and its value, where the copy reads and writes each coordinate.
pub(super) fn share_of_copy(subject: &Subject) -> f64 {
    (subject.axes() + 1) as f64 / (2 * subject.axes()) as f64
}
