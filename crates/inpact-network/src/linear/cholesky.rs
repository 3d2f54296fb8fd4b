//! Cholesky factors of other symmetric positive definite matrices, with the orderings used for networks.

use super::factor::{Factor, Solves};
use super::matrix::Matrix;
use super::ordering::{Analysis, Ordering};
use super::report::NoSolution;
use crate::error::{Error, ErrorKind};
use faer::sparse::SymbolicSparseColMatRef;
use std::sync::Arc;

/// A Cholesky factor in f64.
///
/// ```
/// use inpact_network::linear::Cholesky;
/// // | 25 15 |   by its lower triangle, column by column
/// // | 15 25 |
/// let mut factor = Cholesky::new(&[0, 2, 3], &[0, 1, 1], vec![25.0, 15.0, 25.0])?;
/// let mut right = [55.0, 65.0];
/// factor.solve(&mut right)?;
/// assert_eq!(right, [1.0, 2.0]);
/// # Ok::<(), inpact_network::Error>(())
/// ```
#[derive(Debug)]
pub struct Cholesky {
    factor: Factor<f64>,
    ordering: Ordering,
    entries: usize,
}

impl Cholesky {
    /// Factors the matrix whose lower triangle is given in compressed sparse column form: the start of each column in `rows`, and the end of the last; rows ascending in each column.
    ///
    /// # Errors
    ///
    /// The matrix is not positive definite, or memory runs out.
    ///
    /// # Panics
    ///
    /// The columns are not a lower triangle.
    pub fn new(starts: &[u32], rows: &[u32], values: Vec<f64>) -> Result<Self, Error> {
        let count = starts.len() - 1;
        let pattern = SymbolicSparseColMatRef::new_checked(count, count, starts, None, rows);
        let analysis = Arc::new(Analysis::of(pattern).ok_or(NoSolution::Memory).map_err(not_factored)?);
        let factor = Factor::new(&analysis, &Matrix { pattern, values }).map_err(not_factored)?;
        Ok(Self { factor, ordering: analysis.ordering, entries: analysis.entries() })
    }

    /// Solves in place.
    ///
    /// # Errors
    ///
    /// Memory runs out.
    pub fn solve(&mut self, right: &mut [f64]) -> Result<(), Error> {
        self.factor.solve(right).map_err(not_factored)
    }

    /// The order of elimination.
    pub fn ordering(&self) -> Ordering {
        self.ordering
    }

    /// The number of entries of the factor.
    pub fn entries(&self) -> usize {
        self.entries
    }
}

fn not_factored(reason: NoSolution) -> Error {
    ErrorKind::NotFactored(reason).into()
}
