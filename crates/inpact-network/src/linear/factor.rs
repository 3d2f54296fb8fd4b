//! Cholesky factors of the matrix of the scaled jumps, in f64 or f32, by faer.

use super::matrix::Matrix;
use super::ordering::Analysis;
use super::report::NoSolution;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::cholesky::LltRef;
use faer::traits::ComplexField;
use faer::traits::math_utils::zero;
use faer::{Conj, MatMut, Par, Side, Spec};
use inpact_evaluation::numbers::{exponent_of, scale_by_power};
use std::sync::Arc;

/// One thread: with more the order of sums, and so the last digits, would depend on how many there are.
pub(crate) const PAR: Par = Par::Seq;

/// Something that solves for the scaled jumps, roughly or well.
pub(crate) trait Solves {
    /// Solves in place; the right-hand side is of the size of one.
    ///
    /// # Errors
    /// It cannot.
    fn solve(&mut self, right: &mut [f64]) -> Result<(), NoSolution>;

    /// Solves in place to a digit or two, where that is cheaper.
    ///
    /// # Errors
    /// It cannot.
    fn solve_roughly(&mut self, right: &mut [f64]) -> Result<(), NoSolution> {
        self.solve(right)
    }

    /// Whether it corrects small flows as well as large ones, relative to each; one that stops when most is corrected does not.
    fn is_even(&self) -> bool {
        true
    }

    /// How good one correction is by itself.
    fn accuracy(&self) -> Accuracy {
        Accuracy::Full
    }

    /// The norm of the matrix it solves with: the largest sum of the magnitudes of a row.
    fn norm(&self) -> f64;
}

/// How good a correction is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Accuracy {
    /// As good as f64 is: what is left behind it follows from how the changes shrink.
    Full,
    /// So rough that changes shrink unevenly: what is left is only known to be less than the last change.
    Rough,
}

/// A Cholesky factor in numbers `T`.
#[derive(Debug)]
pub(crate) struct Factor<T> {
    analysis: Arc<Analysis>,
    values: Vec<T>,
    norm: f64,
    /// The matrix was multiplied by two to this power, and right-hand sides are.
    shift: i32,
    right: Vec<T>,
}

/// Numbers a factor can be made of.
pub(crate) trait FactorNumber: ComplexField + Copy {
    /// The exponent that the norm of a matrix is brought to; `None` leaves it as it is.
    ///
    /// Entries that fill in far away from where they come from become as small as numbers can be: in f32 they would soon be subnormal, with which processors are twenty times as slow.
    /// Their magnitudes go with those of the matrix, which is made as large as leaves room for the condition.
    const EXPONENT: Option<i32>;

    /// How good a correction by a factor in such numbers is.
    const ACCURACY: Accuracy;

    fn rounded(value: f64) -> Self;
    fn widened(self) -> f64;
}

impl FactorNumber for f64 {
    const EXPONENT: Option<i32> = None;
    const ACCURACY: Accuracy = Accuracy::Full;

    fn rounded(value: f64) -> Self {
        value
    }

    fn widened(self) -> f64 {
        self
    }
}

impl FactorNumber for f32 {
    const EXPONENT: Option<i32> = Some(96);
    const ACCURACY: Accuracy = Accuracy::Rough;

    fn rounded(value: f64) -> Self {
        // Refinement makes up for the digits lost here.
        #[expect(clippy::cast_possible_truncation)]
        let single = value as Self;
        single
    }

    fn widened(self) -> f64 {
        f64::from(self)
    }
}

impl<T: FactorNumber> Factor<T> {
    /// Factors a matrix that has been analysed.
    ///
    /// # Errors
    /// The matrix is not positive definite in the arithmetic of `T`, or memory runs out.
    pub(crate) fn new(analysis: &Arc<Analysis>, matrix: &Matrix<'_>) -> Result<Self, NoSolution> {
        let symbolic = &analysis.symbolic;
        let mut values = Vec::new();
        values.try_reserve_exact(symbolic.len_val()).map_err(|_| NoSolution::Memory)?;
        values.resize(symbolic.len_val(), zero());
        let norm = matrix.norm();
        let shift = T::EXPONENT.map_or(0, |exponent| exponent - exponent_of(norm));
        let rounded: Vec<T> = matrix.values.iter().map(|&value| T::rounded(scale_by_power(value, shift))).collect();
        let scratch = symbolic.factorize_numeric_llt_scratch::<T>(PAR, Spec::default());
        let mut buffer = MemBuffer::try_new(scratch).map_err(|_| NoSolution::Memory)?;
        let factored = symbolic.factorize_numeric_llt(
            &mut values,
            SparseColMatRef::new(matrix.pattern, &rounded),
            Side::Lower,
            LltRegularization::default(),
            PAR,
            MemStack::new(&mut buffer),
            Spec::default(),
        );
        match factored {
            Ok(_) => Ok(Self { analysis: Arc::clone(analysis), values, norm, shift, right: Vec::new() }),
            Err(_) => Err(NoSolution::Pivot),
        }
    }
}

impl<T: FactorNumber> Solves for Factor<T> {
    fn solve(&mut self, right: &mut [f64]) -> Result<(), NoSolution> {
        let symbolic = &self.analysis.symbolic;
        self.right.clear();
        self.right.extend(right.iter().map(|&entry| T::rounded(scale_by_power(entry, self.shift))));
        let scratch = symbolic.solve_in_place_scratch::<T>(1, PAR);
        let mut buffer = MemBuffer::try_new(scratch).map_err(|_| NoSolution::Memory)?;
        let rows = right.len();
        LltRef::new(symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut self.right, rows, 1),
            PAR,
            MemStack::new(&mut buffer),
        );
        for (to, from) in right.iter_mut().zip(&self.right) {
            *to = from.widened();
        }
        Ok(())
    }

    fn accuracy(&self) -> Accuracy {
        T::ACCURACY
    }

    fn norm(&self) -> f64 {
        self.norm
    }
}
