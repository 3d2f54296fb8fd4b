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

/// One thread: otherwise the order of sums, and so the last digits, would depend on the number of threads.
pub(crate) const PAR: Par = Par::Seq;

/// An approximate or accurate solver for the scaled jumps.
pub(crate) trait Solves {
    /// Solves in place; the right-hand side has magnitude about 1.
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

    /// Whether its relative accuracy is the same for small and large flows; not for one that stops by the norm of the residual.
    fn is_even(&self) -> bool {
        true
    }

    /// The accuracy of a single correction.
    fn accuracy(&self) -> Accuracy {
        Accuracy::Full
    }

    /// The norm of the matrix it solves with: the largest sum of the magnitudes of a row.
    fn norm(&self) -> f64;
}

/// The accuracy of a correction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Accuracy {
    /// That of f64: the remaining error follows from the convergence factor of the changes.
    Full,
    /// So low that changes shrink unevenly: the remaining error is only known to be less than the last change.
    Rough,
}

/// A Cholesky factor in numbers `T`.
#[derive(Debug)]
pub(crate) struct Factor<T> {
    analysis: Arc<Analysis>,
    values: Vec<T>,
    norm: f64,
    /// Matrix and right-hand sides are multiplied by 2 to this power.
    shift: i32,
    right: Vec<T>,
}

/// Scalar types of a factor.
pub(crate) trait FactorNumber: ComplexField + Copy {
    /// The exponent to which the norm of a matrix is scaled; `None` leaves it unscaled.
    ///
    /// Fill-in far from its origin becomes tiny: in f32 it would soon be subnormal, which is twenty times as slow on processors.
    /// Its magnitude scales with the matrix, which is therefore scaled as large as the condition number permits.
    const EXPONENT: Option<i32>;

    /// The accuracy of a correction by a factor in this type.
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
