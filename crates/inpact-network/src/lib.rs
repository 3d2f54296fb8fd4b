//! Solves networks of nodes that are coupled by the interface laws of a deck.
//!
//! [`scene`] reads a scene, [`Problem`] is the part of it that is solved with the laws of a deck, [`transient::run`] gives the states one by one, [`tables`] makes tables of them.
//! [`linear`] solves linear networks on their own:
//!
//! ```
//! use inpact_network::linear::{LAST_DIGIT, LinearNetwork, Link, Method, Solver};
//!
//! // 100 — 1 — o — 1e300 — o — 1e-300 — 50
//! let mut network = LinearNetwork::of_nodes(4);
//! network.held[0] = Some(100.0);
//! network.held[3] = Some(50.0);
//! for (node, conductance) in [(0, 1.0), (1, 1e300), (2, 1e-300)] {
//!     network.links.push(Link { nodes: [node, node + 1], conductance });
//! }
//! let solution = Solver::new(Method::Direct, LAST_DIGIT).solve(&network)?;
//! assert_eq!(solution.flows[1].to_f64(), 50.0 * 1e-300);
//! assert_eq!(solution.jump(&network, 2).to_f64(), 50.0);
//! # Ok::<(), inpact_network::Error>(())
//! ```
//!
//! Nothing here opens files or prints.

mod assembly;
mod dependence;
mod distance;
mod effect;
mod error;
mod integrals;
mod interface;
mod knowledge;
pub mod linear;
mod newton;
mod problem;
pub mod scene;
mod solve;
mod state;
pub mod tables;
pub mod transient;

pub use distance::Distance;
pub use error::{Error, ErrorKind, RowFault};
pub use problem::{Problem, report_unknown_interactions};
pub use solve::{Equations, Histories};
pub use state::{FieldBalance, StageReport, State};
