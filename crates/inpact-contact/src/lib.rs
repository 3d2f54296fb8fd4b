//! Node tables of contact pairs: from a mesh, and values at its nodes, to the rows that laws are evaluated on.
//!
//! This is the only place where a mesh meets the columns of node tables and the fields of result files: `inpact-geometry` knows no deck, `inpact-evaluation` no
//! mesh, `inpact-results` neither, and this crate knows no law.
//! [`State`] holds the values at the nodes at one time: the beginning, or an increment of a result file.
//! [`Join`] makes states of result files: it maps labels to nodes of the mesh and fields to pairs, and joins the frames of one time.
//! [`NodeRows`] makes a row for each slave node and state, in [`Batch`](inpact_evaluation::nodes::Batch)es of the columns that any of the states can fill,
//! and counts them ([`PairSummary`]).
//!
//! Nothing is guessed: a node without an opposite master face has an empty clearance unless a solver gives one, a master field that a node of its face lacks is empty
//! too, and the parts of a result file that could not be used are reported.
//!
//! ```
//! use inpact_contact::{NodeRows, State};
//! use inpact_evaluation::nodes::Column;
//! use inpact_parser::mesh::{self, KeptRows};
//! use inpact_parser::{deck::scan, grammar::Grammar, model};
//!
//! // Two squares of shell, 0.5 apart.
//! let text = b"*NODE
//! 1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.
//! 5, 0., 0., .5\n6, 1., 0., .5\n7, 1., 1., .5\n8, 0., 1., .5
//! *ELEMENT, TYPE=R3D4, ELSET=LOW\n1, 1, 2, 3, 4
//! *ELEMENT, TYPE=R3D4, ELSET=HIGH\n2, 5, 6, 7, 8
//! *SURFACE, NAME=MASTER\nLOW, SPOS
//! *SURFACE, NAME=SLAVE\nHIGH, SNEG
//! *SURFACE INTERACTION, NAME=JOINT
//! *CONTACT PAIR, INTERACTION=JOINT\nSLAVE, MASTER
//! ";
//! let deck = scan("joint.inp", text, Grammar::builtin());
//! let (model, _) = model::read(&deck, Grammar::builtin());
//! let mesh = mesh::read(&deck, Grammar::builtin(), &model, &mut KeptRows(&deck))?;
//! let states = [State::initial(&mesh)];
//! let mut rows = NodeRows::new(&mesh, &model, &states)?;
//! let clearance = rows.numbers().iter().position(|column| *column == Column::Clearance).expect("from the mesh");
//! let batch = rows.batches(&states).next().expect("a pair")?;
//! assert_eq!((batch.rows, batch.numbers[clearance].get(0)), (4, Some(0.5)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod check;
mod error;
mod interfaces;
mod join;
mod naming;
mod pair;
mod picture;
mod rows;
mod state;
mod summary;
mod values;

pub use check::{GEOMETRY_RULES, check_geometry};
pub use error::Error;
pub use interfaces::{InterfaceRow, Interfaces, LumpedPair, PairInterfaces, ProjectionRow, WeightedMean};
pub use join::{FileSummary, Join, Joined, MatchedBy, ResultFile, ResultNote};
pub use picture::SlaveFaces;
pub use rows::NodeRows;
pub use state::{
    ContactField, ContactQuantity, Displacements, HeatFlux, Moment, NodeField, NodeQuantity, OutputField, PairTotal,
    Source, State, TotalQuantity,
};
pub use summary::{AreaSource, ColumnSummary, PairSummary};
