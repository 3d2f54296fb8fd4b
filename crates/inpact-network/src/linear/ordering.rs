//! Fill-reducing orderings.
//!
//! Approximate minimum degree is cheap and, in two dimensions, as good as any. In three dimensions nested dissection needs half the entries and a third of the operations,
//! and costs more to compute: it is tried where the factorisation by minimum degree would cost more than that, and used at once where the network is clearly three-dimensional.

use super::sets::index;
use arael_faer::nd::{Graph, NdParams, order_graph};
use faer::Side;
use faer::perm::PermRef;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};

/// Operations of a factorisation per unknown above which nested dissection is tried: about the cost of the ordering.
///
/// Measured: 1e6 unknowns in two dimensions need 1.4e4 each, and dissection takes five times as long as the factorisation, of which it would save a tenth;
/// 46³ in three need 6e5 each, and dissection takes a tenth of the factorisation, of which it saves half.
const WORTH_DISSECTING: f64 = 1e5;

/// Fewer unknowns are ordered by minimum degree first, which may be good enough: from 22³ on it is not.
const LEAST_IN_SPACE: usize = 10_000;

/// Entries below the diagonal per unknown from which a network may be three-dimensional: a grid in the plane has two, one in space three.
const NEIGHBOURS_IN_SPACE: f64 = 2.5;

/// A network counts as three-dimensional where the width of its levels exceeds this multiple of the square root of the unknowns: grids in the plane have at most that root, 46³ in space 2.3 times as many.
const WIDTH_IN_SPACE: f64 = 1.5;

/// The order and the structure of a factor.
#[derive(Debug)]
pub(crate) struct Analysis {
    pub(crate) symbolic: SymbolicCholesky<u32>,
    pub(crate) ordering: Ordering,
}

/// Orders of elimination.
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
        let count = pattern.ncols() as f64;
        let may_be_in_space =
            LEAST_IN_SPACE <= pattern.ncols() && (pattern.row_idx().len() as f64) > (1.0 + NEIGHBOURS_IN_SPACE) * count;
        let mut graph = may_be_in_space.then(|| graph_of(pattern));
        let mut by_degree = None;
        if !graph.as_ref().is_some_and(is_in_space) {
            let analysis = Self::ordered(pattern, SymmetricOrdering::Amd, Ordering::MinimumDegree)?;
            if analysis.operations() < WORTH_DISSECTING * count {
                return Some(analysis);
            }
            by_degree = Some(analysis);
        }
        let graph = graph.get_or_insert_with(|| graph_of(pattern));
        let forward: Vec<u32> = order_graph(graph, NdParams::default()).into_iter().map(index).collect();
        let mut inverse = vec![0; forward.len()];
        for (place, &unknown) in (0..).zip(&forward) {
            inverse[unknown as usize] = place;
        }
        let order = SymmetricOrdering::Custom(PermRef::new_checked(&forward, &inverse, forward.len()));
        let dissected = Self::ordered(pattern, order, Ordering::NestedDissection)?;
        let is_better = |of: &Self| of.operations() <= dissected.operations();
        Some(by_degree.filter(is_better).unwrap_or(dissected))
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

    /// The number of entries of the factor.
    pub(crate) fn entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// The approximate number of multiplications of the factorisation: the squares of the heights of all columns.
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

/// The adjacency graph of a matrix.
fn graph_of(pattern: SymbolicSparseColMatRef<'_, u32>) -> Graph {
    let (starts, rows) = (pattern.col_ptr(), pattern.row_idx());
    let column = |column: usize| {
        rows[starts[column] as usize..starts[column + 1] as usize].iter().map(move |&row| (row as usize, column))
    };
    Graph::from_edges(pattern.ncols(), (0..pattern.ncols()).flat_map(column))
}

/// Whether most of a network is clearly three-dimensional, by the width of its levels: the unknowns at equal distance from a peripheral one.
fn is_in_space(graph: &Graph) -> bool {
    let (outermost, ..) = walk(graph, 0);
    let (_, levels, reached) = walk(graph, outermost);
    let width = reached as f64 / levels as f64;
    2 * reached > graph.nodes() && width > WIDTH_IN_SPACE * (reached as f64).sqrt()
}

/// Breadth-first search from an unknown: the last one reached, the number of levels, and of unknowns in them.
fn walk(graph: &Graph, from: usize) -> (usize, usize, usize) {
    let mut is_reached = vec![false; graph.nodes()];
    is_reached[from] = true;
    let mut reached = vec![from];
    let (mut levels, mut begin) = (0, 0);
    while begin < reached.len() {
        levels += 1;
        let end = reached.len();
        for place in begin..end {
            for &other in graph.neighbours(reached[place]) {
                if !std::mem::replace(&mut is_reached[other], true) {
                    reached.push(other);
                }
            }
        }
        begin = end;
    }
    (reached[reached.len() - 1], levels, reached.len())
}
