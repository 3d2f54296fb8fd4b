//! Node tables of contact pairs: from a mesh, and what is known of its nodes, to rows that laws are evaluated on.
//!
//! This is the only place where a mesh meets the columns of node tables and the fields of result files: `inpact-geometry` knows no deck, `inpact-evaluation` no
//! mesh, `inpact-results` neither, and here no law is known.
//! [`State`] is what is known of the nodes at one time: the beginning, or an increment of a result file.
//! [`Join`] makes states of result files: it finds out which node of the mesh a label is, which pair a field is of, and which frames are of one time.
//! [`NodeRows`] makes a row a slave node and state, as [`Batch`](inpact_evaluation::nodes::Batch)es of the columns that any of the states can fill,
//! and counts what it made ([`PairSummary`]).
//!
//! Nothing is guessed: a node without a master face across has an empty clearance unless a solver says one, a master field that a node of its face lacks is empty
//! too, and what of a result file could not be used is named.

mod check;
mod interfaces;
mod join;
mod naming;
mod pair;
mod picture;
mod rows;
mod state;
mod summary;
mod values;

pub use check::{
    BEYOND_CUTOFF, DEEP_OVERCLOSURE, GEOMETRY_RULES, NODE_BASED_SURFACE, TABLE_NOT_REACHED, WITHOUT_MASTER, WRONG_SIDE,
    check_geometry,
};
pub use interfaces::{InterfaceRow, Interfaces, LumpedPair, PairInterfaces, ProjectionRow, WeightedMean};
pub use join::{FileSummary, Join, JoinError, Joined, MatchedBy, ResultNote};
pub use picture::SlaveFaces;
pub use rows::{NodeRows, RowsError};
pub use state::{
    ContactField, ContactQuantity, Displacements, Moment, NodeField, NodeQuantity, OutputField, Source, State,
};
pub use summary::{AreaSource, ColumnSummary, PairSummary};
