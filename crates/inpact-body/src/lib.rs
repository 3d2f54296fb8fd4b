//! Bodies between their terminals: from the mesh and the materials of a deck to conductances and capacities.
//!
//! A *terminal* is a surface or a node set where a body ends; a *body* is a connected component of solid elements.
//! [`Body::read`] reads both, [`Body::lumped`] solves the body once for each terminal, which is held at 1 while the others are held at 0:
//!
//! - [`Lumped::isothermal`]: the conductances between terminals of one uniform temperature (or potential) each;
//! - [`Lumped::even`]: the same where the flow of each terminal is uniformly distributed over its area;
//! - [`Lumped::terminals`]: the conductance of each terminal to all others, both ways. By Dirichlet's principle no joint lets a body conduct more than the first;
//!   by Thomson's none with a uniform flow lets it conduct less than the second. Their relative difference is a measure of the lumping error.
//! - [`Lumped::capacities`]: ∫ ρ c φ dV of each terminal, φ being its own potential, so that they sum to the capacity of the bodies.
//!
//! ```
//! use inpact_body::{Body, BodyField};
//! use inpact_parser::deck::scan;
//! use inpact_parser::grammar::{Dialect, Grammar, Release};
//! use inpact_parser::mesh::KeptRows;
//! use inpact_parser::model::Name;
//!
//! let deck = b"*NODE
//! 1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.
//! 5, 0., 0., 3.\n6, 1., 0., 3.\n7, 1., 1., 3.\n8, 0., 1., 3.
//! *ELEMENT, TYPE=C3D8, ELSET=BAR
//! 1, 1, 2, 3, 4, 5, 6, 7, 8
//! *NSET, NSET=LOW\n1, 2, 3, 4
//! *NSET, NSET=HIGH\n5, 6, 7, 8
//! *SOLID SECTION, ELSET=BAR, MATERIAL=STEEL
//! *MATERIAL, NAME=STEEL
//! *CONDUCTIVITY\n60.
//! ";
//! let grammar = Grammar::new(Dialect::Abaqus, Release::default());
//! let deck = scan("bar.inp", deck, &grammar);
//! let names = [Name::new("LOW"), Name::new("HIGH")];
//! let body = Body::read(&deck, &grammar, &names, &mut KeptRows(&deck))??;
//! let lumped = body.lumped(BodyField::Thermal, None)?;
//! assert!((lumped.isothermal.between(0, 1) - 20.0).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Nothing here opens files or prints.

mod assembly;
mod body;
mod conductances;
mod dissipation;
mod error;
mod even;
mod lumped;
mod material;
mod nodes;
mod rules;
mod solve;

pub use body::{Body, BodyPart};
pub use conductances::Conductances;
pub use dissipation::JouleHeat;
pub use error::{BodyFault, Error};
pub use lumped::{BodySummary, Lumped, TerminalSummary};
pub use material::BodyField;
pub use rules::{BESIDE_BODIES, BODY_RULES, NEGATIVE_CONDUCTANCE, UNUSABLE_MESH, UNUSABLE_PROPERTY, UNUSABLE_TERMINAL};
pub use solve::{Solution, SolutionMethod};
