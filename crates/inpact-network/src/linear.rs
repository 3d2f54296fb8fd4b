//! Linear networks with conductances of 0, 1e-300 to 1e300 and infinity in one network, solved to the last digits of f64.
//!
//! The steps of a solution, each in the file of its name:
//!
//! 1. `components` refuses connected components without a path to a known value and names their nodes.
//! 2. `core` merges nodes that infinite conductances join, and drops zero conductances.
//! 3. `dead_ends` eliminates parts into which nothing can flow, `series` nodes with two conductances and no source (series reduction).
//! 4. `strength` and `relative` choose the unknowns by the strengths of the conductances: node values where they are alike, jumps where they are not.
//! 5. `matrix` assembles, `ordering` orders, `factor` factors in f64 or f32, `iterative` avoids the complete factor.
//! 6. `refinement` corrects until the balances in edge form (`edges`) and the estimated error are within the tolerance; a network that does not get there is solved again by a more robust method, as a last resort by `elimination`.
//! 7. `series`, `dead_ends`, `infinite` and `spanning_forest` recover what was eliminated: values, the flows through infinite conductances, jumps that no flow determines.
//!
//! `symbolic` does steps 1 to 5 except the factorisation, so that many networks on one graph share the ordering.

mod cholesky;
mod components;
mod core;
mod dead_ends;
mod edges;
mod elimination;
mod factor;
mod found;
mod infinite;
mod iterative;
mod largest;
mod matrix;
mod network;
mod ordering;
mod refinement;
mod relative;
mod report;
mod series;
mod sets;
mod solution;
mod solve;
mod spanning_forest;
mod strength;
mod symbolic;
mod work;

pub(crate) use self::core::{Core, NONE, Origins};
pub use cholesky::Cholesky;
pub(crate) use dead_ends::DeadEnds;
pub(crate) use edges::{Balance, Edges};
pub(crate) use factor::{Factor, Solves};
pub(crate) use iterative::Incomplete;
pub(crate) use largest::largest_or_nan;
pub(crate) use matrix::{Matrix, Pattern, each_part};
pub use network::{LinearNetwork, Link, Store};
pub(crate) use ordering::Analysis;
pub use ordering::Ordering;
pub(crate) use relative::Form;
pub use report::{LAST_DIGIT, LinearReport, Method, MethodFailure, NoSolution, Quality, Reused};
pub(crate) use series::Series;
pub(crate) use sets::{Sets, index};
pub use solution::LinearSolution;
pub use solve::Solver;
pub use symbolic::Symbolic;
pub use work::{Clock, Phases, Work};
