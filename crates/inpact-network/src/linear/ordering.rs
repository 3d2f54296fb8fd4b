//! Orders in which unknowns are eliminated so that few entries fill in.
//!
//! Approximate minimum degree is cheap and, in two dimensions, as good as any. In three dimensions nested dissection leaves half the entries and a third of the operations,
//! and costs more to find: it is tried where the factor by minimum degree would cost more than that.

use arael_faer::nd::{Graph, NdParams, order_graph};
use faer::Side;
use faer::perm::PermRef;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};

/// Operations of a factorization for each unknown above which nested dissection is tried: about what it costs to find.
///
/// Measured: 1e6 unknowns in two dimensions need 1.4e4 for each, and dissection takes five times as long as the factor it would save a tenth of;
/// 46³ in three need 6e5, and dissection takes a tenth of the factor it saves half of.
const WORTH_DISSECTING: f64 = 1e5;

/// The order and the structure of a factor.
#[derive(Debug)]
pub(crate) struct Analysis {
    pub(crate) symbolic: SymbolicCholesky<u32>,
    pub(crate) ordering: Ordering,
}

/// How unknowns are ordered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ordering {
    /// Approximate minimum degree.
    MinimumDegree,
    /// Nested dissection.
    NestedDissection,
}

impl Analysis {
    /// Analyses the lower triangle of a symmetric matrix; `None` where memory runs out.
    pub(crate) fn of(pattern: SymbolicSparseColMatRef<'_, u32>) -> Option<Self> {
        let by_degree = Self::ordered(pattern, SymmetricOrdering::Amd, Ordering::MinimumDegree)?;
        if by_degree.operations() < WORTH_DISSECTING * pattern.ncols() as f64 {
            return Some(by_degree);
        }
        let forward = dissection(pattern);
        let mut inverse = vec![0; forward.len()];
        for (place, &unknown) in (0..).zip(&forward) {
            inverse[unknown as usize] = place;
        }
        let order = SymmetricOrdering::Custom(PermRef::new_checked(&forward, &inverse, forward.len()));
        let dissected = Self::ordered(pattern, order, Ordering::NestedDissection)?;
        Some(if dissected.operations() < by_degree.operations() { dissected } else { by_degree })
    }

    fn ordered(
        pattern: SymbolicSparseColMatRef<'_, u32>,
        order: SymmetricOrdering<'_, u32>,
        ordering: Ordering,
    ) -> Option<Self> {
        let parameters = CholeskySymbolicParams::default();
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, order, parameters).ok()?;
        Some(Self { symbolic, ordering })
    }

    /// How many entries the factor has.
    pub(crate) fn entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// How many multiplications the factorization takes, about: the squares of the heights of all columns.
    fn operations(&self) -> f64 {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(columns) => {
                columns.col_ptr().windows(2).map(|ends| f64::from(ends[1] - ends[0]).powi(2)).sum()
            }
            SymbolicCholeskyRaw::Supernodal(blocks) => {
                let widths =
                    blocks.supernode_begin().iter().zip(blocks.supernode_end()).map(|(begin, end)| end - begin);
                let heights = blocks.col_ptr_for_row_idx().windows(2).map(|ends| ends[1] - ends[0]);
                let of_block = |(width, below): (u32, u32)| {
                    let (width, below) = (f64::from(width), f64::from(below));
                    width * (below * below + below * width + width * width / 3.0)
                };
                widths.zip(heights).map(of_block).sum()
            }
        }
    }
}

/// The unknowns in the order of a nested dissection.
fn dissection(pattern: SymbolicSparseColMatRef<'_, u32>) -> Vec<u32> {
    let (starts, rows) = (pattern.col_ptr(), pattern.row_idx());
    let column = |column: usize| {
        rows[starts[column] as usize..starts[column + 1] as usize].iter().map(move |&row| (row as usize, column))
    };
    let graph = Graph::from_edges(pattern.ncols(), (0..pattern.ncols()).flat_map(column));
    order_graph(&graph, NdParams::default()).into_iter().map(super::sets::index).collect()
}
