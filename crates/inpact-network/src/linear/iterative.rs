//! Conjugate gradients with an incomplete factor, for networks whose complete factor would not fit into memory.
//!
//! The incomplete factor has the pattern of the matrix; most of the fill-in elsewhere is added to the diagonal,
//! so that constant vectors, which slow modes resemble, are reproduced nearly exactly (modified incomplete Cholesky).
//! A pivot that is not safely positive is replaced by the diagonal of the matrix, so that the preconditioner stays positive definite.
//!
//! Source: Gustafsson, A class of first order factorization methods, BIT 18 (1978) 142–156; the conjugate gradients are faer's.

use super::factor::{PAR, Solves};
use super::matrix::Matrix;
use super::report::NoSolution;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::matrix_free::conjugate_gradient::{CgParams, conjugate_gradient, conjugate_gradient_scratch};
use faer::matrix_free::{InitialGuessStatus, LinOp, Precond};
use faer::{MatMut, MatRef, Par};

/// The fraction of dropped fill-in that is added to the diagonal; 1 would be better on a grid but could break down elsewhere.
const KEPT: f64 = 0.97;

/// The maximum number of iterations for one correction.
const MAX_ITERATIONS: usize = 5_000;

/// The reduction of the residual in one correction, unless less is needed.
const CORRECTION: f64 = 1e-8;

/// A symmetric matrix with its incomplete factor.
#[derive(Debug)]
pub(crate) struct ConjugateGradients {
    matrix: Rows,
    preconditioner: Incomplete,
    norm: f64,
    reduction: f64,
    /// All iterations so far.
    pub(crate) iterations: usize,
}

impl ConjugateGradients {
    /// Prepares to solve with a matrix to a relative residual of at most `tolerance`.
    pub(crate) fn new(matrix: &Matrix<'_>, tolerance: f64) -> Self {
        Self {
            matrix: Rows::of(matrix),
            preconditioner: Incomplete::of(matrix),
            norm: matrix.norm(),
            // The error is some orders above the residual; refinement corrects the rest.
            reduction: CORRECTION.max(1e-3 * tolerance),
            iterations: 0,
        }
    }
}

impl Solves for ConjugateGradients {
    fn solve(&mut self, right: &mut [f64]) -> Result<(), NoSolution> {
        let rows = right.len();
        let scratch = conjugate_gradient_scratch(&self.preconditioner, &self.matrix, 1, PAR);
        let mut buffer = MemBuffer::try_new(scratch).map_err(|_| NoSolution::Memory)?;
        let mut solution = vec![0.0; rows];
        let parameters = CgParams {
            // With `Zero` faer 0.24 leaves its residual uninitialised.
            initial_guess: InitialGuessStatus::MaybeNonZero,
            abs_tolerance: 0.0,
            rel_tolerance: self.reduction,
            max_iters: MAX_ITERATIONS,
            ..CgParams::default()
        };
        let done = conjugate_gradient(
            MatMut::from_column_major_slice_mut(&mut solution, rows, 1),
            &self.preconditioner,
            &self.matrix,
            MatRef::from_column_major_slice(right, rows, 1),
            parameters,
            |_| (),
            PAR,
            MemStack::new(&mut buffer),
        );
        match done {
            Ok(info) => self.iterations += info.iter_count,
            Err(_) => return Err(NoSolution::Iterations),
        }
        right.copy_from_slice(&solution);
        Ok(())
    }

    fn solve_roughly(&mut self, right: &mut [f64]) -> Result<(), NoSolution> {
        let reduction = std::mem::replace(&mut self.reduction, 1e-2);
        let solved = self.solve(right);
        self.reduction = reduction;
        solved
    }

    fn is_even(&self) -> bool {
        false
    }

    fn norm(&self) -> f64 {
        self.norm
    }
}

/// A symmetric matrix in compressed rows, both triangles, so that a product streams through it once.
#[derive(Debug)]
struct Rows {
    starts: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl Rows {
    fn of(matrix: &Matrix<'_>) -> Self {
        let count = matrix.pattern.ncols();
        let mut starts = vec![0_u32; count + 1];
        matrix.each(|row, column, _| {
            starts[row + 1] += 1;
            starts[column + 1] += u32::from(row != column);
        });
        for row in 0..count {
            starts[row + 1] += starts[row];
        }
        let entries = starts[count] as usize;
        let (mut columns, mut values, mut next) = (vec![0; entries], vec![0.0; entries], starts.clone());
        matrix.each(|row, column, value| {
            let mut put = |row: usize, column: usize| {
                let place = next[row] as usize;
                columns[place] = super::sets::index(column);
                values[place] = value;
                next[row] += 1;
            };
            put(row, column);
            if row != column {
                put(column, row);
            }
        });
        Self { starts, columns, values }
    }

    fn apply_to(&self, vector: &[f64], product: &mut [f64]) {
        for (row, sum) in product.iter_mut().enumerate() {
            let range = self.starts[row] as usize..self.starts[row + 1] as usize;
            let terms = self.columns[range.clone()].iter().zip(&self.values[range]);
            *sum = terms.map(|(&column, value)| value * vector[column as usize]).sum();
        }
    }
}

/// An incomplete Cholesky factor with the entries of its matrix, column by column, each column's diagonal first.
#[derive(Debug)]
pub(crate) struct Incomplete {
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl Incomplete {
    /// The incomplete factor of a matrix.
    pub(crate) fn of(matrix: &Matrix<'_>) -> Self {
        let starts = matrix.pattern.col_ptr().to_vec();
        let rows = matrix.pattern.row_idx().to_vec();
        let mut factor = Self { starts, rows, values: matrix.values.clone() };
        let diagonal: Vec<f64> =
            (0..factor.count()).map(|column| factor.values[factor.starts[column] as usize]).collect();
        // The position of each row below the diagonal in the column that is being updated.
        let mut place_of = vec![u32::MAX; factor.count()];
        for (column, &diagonal) in diagonal.iter().enumerate() {
            factor.finish_column(column, diagonal);
            factor.update_from(column, &mut place_of);
        }
        factor
    }

    fn count(&self) -> usize {
        self.starts.len() - 1
    }

    fn range(&self, column: usize) -> std::ops::Range<usize> {
        self.starts[column] as usize..self.starts[column + 1] as usize
    }

    /// Divides a fully updated column by the square root of its pivot.
    fn finish_column(&mut self, column: usize, diagonal: f64) {
        const SAFE: f64 = 1e-3;
        let range = self.range(column);
        let pivot = self.values[range.start];
        let root = if pivot > SAFE * diagonal { pivot } else { diagonal }.sqrt();
        self.values[range.start] = root;
        for value in &mut self.values[range.start + 1..range.end] {
            *value /= root;
        }
    }

    /// Subtracts the products of a finished column from the later columns, at existing entries, and from their diagonals.
    fn update_from(&mut self, column: usize, place_of: &mut [u32]) {
        let range = self.range(column);
        for first in range.start + 1..range.end {
            let (target, factor) = (self.rows[first] as usize, self.values[first]);
            let of_target = self.range(target);
            for place in of_target.clone() {
                place_of[self.rows[place] as usize] = super::sets::index(place);
            }
            for second in first..range.end {
                let row = self.rows[second] as usize;
                let product = factor * self.values[second];
                match place_of[row] {
                    u32::MAX => {
                        let (here, there) = (of_target.start, self.starts[row] as usize);
                        self.values[here] -= KEPT * product;
                        self.values[there] -= KEPT * product;
                    }
                    place => self.values[place as usize] -= product,
                }
            }
            for place in of_target {
                place_of[self.rows[place] as usize] = u32::MAX;
            }
        }
    }

    /// Solves L Lᵀ x = b in place.
    pub(crate) fn solve_in_place(&self, vector: &mut [f64]) {
        for column in 0..self.count() {
            let range = self.range(column);
            let value = vector[column] / self.values[range.start];
            vector[column] = value;
            for place in range.start + 1..range.end {
                vector[self.rows[place] as usize] -= self.values[place] * value;
            }
        }
        for column in (0..self.count()).rev() {
            let range = self.range(column);
            let below =
                (range.start + 1..range.end).map(|place| self.values[place] * vector[self.rows[place] as usize]);
            vector[column] = (vector[column] - below.sum::<f64>()) / self.values[range.start];
        }
    }
}

/// Calls `take` with each column of two matrices as slices.
fn each_column(mut out: MatMut<'_, f64>, right: MatRef<'_, f64>, mut take: impl FnMut(&[f64], &mut [f64])) {
    for column in 0..right.ncols() {
        let input: Vec<f64> = right.col(column).iter().copied().collect();
        let mut output = vec![0.0; input.len()];
        take(&input, &mut output);
        for (to, from) in out.as_mut().col_mut(column).iter_mut().zip(&output) {
            *to = *from;
        }
    }
}

impl LinOp<f64> for Rows {
    fn apply_scratch(&self, _: usize, _: Par) -> StackReq {
        StackReq::EMPTY
    }

    fn nrows(&self) -> usize {
        self.starts.len() - 1
    }

    fn ncols(&self) -> usize {
        self.starts.len() - 1
    }

    fn apply(&self, out: MatMut<'_, f64>, right: MatRef<'_, f64>, _: Par, _: &mut MemStack) {
        each_column(out, right, |input, output| self.apply_to(input, output));
    }

    fn conj_apply(&self, out: MatMut<'_, f64>, right: MatRef<'_, f64>, par: Par, stack: &mut MemStack) {
        self.apply(out, right, par, stack);
    }
}

impl LinOp<f64> for Incomplete {
    fn apply_scratch(&self, _: usize, _: Par) -> StackReq {
        StackReq::EMPTY
    }

    fn nrows(&self) -> usize {
        self.count()
    }

    fn ncols(&self) -> usize {
        self.count()
    }

    fn apply(&self, out: MatMut<'_, f64>, right: MatRef<'_, f64>, _: Par, _: &mut MemStack) {
        each_column(out, right, |input, output| {
            output.copy_from_slice(input);
            self.solve_in_place(output);
        });
    }

    fn conj_apply(&self, out: MatMut<'_, f64>, right: MatRef<'_, f64>, par: Par, stack: &mut MemStack) {
        self.apply(out, right, par, stack);
    }
}

impl Precond<f64> for Incomplete {}
