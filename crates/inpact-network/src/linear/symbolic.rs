//! The symbolic factorisation of a network: the sparsity pattern and the elimination ordering.
//!
//! It depends on the graph only: made once, it serves any number of solvers, each of which does the numeric factorisation and keeps its factor for further right-hand sides.

use super::components::refuse_floating;
use super::core::Core;
use super::dead_ends::DeadEnds;
use super::edges::Edges;
use super::matrix::Pattern;
use super::network::LinearNetwork;
use super::ordering::{Analysis, Ordering};
use super::relative::Form;
use super::report::{Method, MethodFailure, NoSolution};
use super::series::Series;
use super::solve::Solver;
use crate::error::Error;
use std::sync::Arc;

/// A symbolic factorisation, shared by the solvers made from it.
///
/// A solver checks whether a network matches: where other nodes are held or have sources, or conductances of other magnitudes couple other unknowns, it repeats the analysis for that network and keeps the result.
/// [`LinearReport::reused`](super::LinearReport::reused) says which part of the work was reused.
///
/// ```
/// use inpact_network::linear::{LAST_DIGIT, LinearNetwork, Link, Method, Reused, Symbolic};
///
/// // A grid of 20 by 20 nodes, held at one corner and fed at the opposite one.
/// let node = |row: u32, column: u32| 20 * row + column;
/// let mut network = LinearNetwork::of_nodes(400);
/// for row in 0..20 {
///     for column in 0..20 {
///         let ends = [(row, column + 1), (row + 1, column)];
///         let ends = ends.into_iter().filter(|(row, column)| *row < 20 && *column < 20);
///         network.links.extend(ends.map(|(r, c)| Link { nodes: [node(row, column), node(r, c)], conductance: 1.0 }));
///     }
/// }
/// network.held[0] = Some(0.0);
/// network.sources[399] = 1.0;
///
/// let symbolic = Symbolic::of(&network)?;
/// let mut solver = symbolic.solver(Method::Direct, LAST_DIGIT);
///
/// // Many right-hand sides: one factor.
/// for source in [1.0, 2.0, 3.0] {
///     network.sources[399] = source;
///     let solution = solver.solve(&network)?;
///     let expected = if source == 1.0 { Reused::Order } else { Reused::Factor };
///     assert_eq!(solution.report.reused, expected);
/// }
///
/// // Changed conductances: the order stays, here for a solver of another thread.
/// network.links.iter_mut().for_each(|link| link.conductance *= 1.5);
/// let solution = symbolic.solver(Method::Mixed, LAST_DIGIT).solve(&network)?;
/// assert_eq!(solution.report.reused, Reused::Order);
/// # Ok::<(), inpact_network::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Symbolic {
    pattern: Arc<Pattern>,
    analysis: Arc<Analysis>,
}

impl Symbolic {
    /// Analyses the graph of a network.
    ///
    /// # Errors
    /// The network has no solution, or more than one; or memory runs out.
    pub fn of(network: &LinearNetwork) -> Result<Self, Error> {
        refuse_floating(network)?;
        let (core, _) = Core::merged(network, &|_| false)?;
        let mut core = core;
        // As the solver does, so that the unknowns are the same.
        let dead_ends = DeadEnds::find(&core);
        let series = Series::take_out(&mut core, &dead_ends, &|_| false);
        let form = Form::choose(&core, &series.is_there, &series.is_free);
        let edges = Edges::new(&core, form, &series.is_there);
        let pattern = Pattern::of(&core, &edges);
        let memory = || Error::not_solved(vec![(Method::Direct, MethodFailure::NoSolution(NoSolution::Memory))]);
        let analysis = Analysis::of(pattern.symbolic()).ok_or_else(memory)?;
        Ok(Self { pattern: Arc::new(pattern), analysis: Arc::new(analysis) })
    }

    /// The order of elimination.
    pub fn ordering(&self) -> Ordering {
        self.analysis.ordering
    }

    /// The number of entries of a factor.
    pub fn factor_entries(&self) -> usize {
        self.analysis.entries()
    }

    /// A solver that starts with this ordering; `method` and `tolerance` as in [`Solver::new`].
    pub fn solver(&self, method: Method, tolerance: f64) -> Solver {
        Solver::with_order(method, tolerance, (Arc::clone(&self.pattern), Arc::clone(&self.analysis)))
    }
}
