//! Linear networks: conductances from zero over 1e-300 to 1e300 and infinite, in one network, to the last digits of f64.

mod bodies;
mod core;
mod edges;
mod elimination;
mod factor;
mod hanging;
mod infinite;
mod iterative;
mod matrix;
mod network;
mod ordering;
mod refinement;
mod relative;
mod series;
mod sets;
mod solve;
mod strength;
mod work;

pub(crate) use self::core::{Core, NONE, Origins};
pub(crate) use edges::{Balance, Edges};
pub use factor::NoSolution;
pub(crate) use matrix::each_part;
pub use network::{LinearNetwork, Link, Store, Unsolvable};
pub use ordering::Ordering;
pub use refinement::Quality;
pub(crate) use relative::Form;
pub(crate) use series::Series;
pub(crate) use sets::{Sets, index};
pub use solve::{LAST_DIGIT, LinearFailure, LinearReport, LinearSolution, Method, Shortcoming, Solver};
pub use work::{Phases, Work};
