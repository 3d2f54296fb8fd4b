//! The textbook way to solve a network, for comparison: nodes as unknowns, one assembled matrix, one Cholesky factor.

use super::grid::Assembled;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Side};
use inpact_network::linear::LinearNetwork;

/// The values of the free nodes; `None` where a pivot is not positive.
pub fn values(network: &LinearNetwork) -> Option<Vec<f64>> {
    let Assembled { diagonal, below, right } = Assembled::of(network);
    let of_diagonal = diagonal.iter().enumerate().map(|(node, &value)| Triplet::new(node, node, value));
    let of_below = below.iter().map(|&(row, column, value)| Triplet::new(row, column, value));
    let entries: Vec<_> = of_diagonal.chain(of_below).collect();
    let matrix = SparseColMat::try_new_from_triplets(diagonal.len(), diagonal.len(), &entries).ok()?;
    let factor = matrix.sp_cholesky(Side::Lower).ok()?;
    let right = Col::from_fn(right.len(), |node| right[node]);
    Some(factor.solve(&right).iter().copied().collect())
}
