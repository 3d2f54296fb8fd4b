//! Node tables of contact pairs: from a mesh, and what is known of its nodes, to rows that laws are evaluated on.
//!
//! This is the only place where a mesh meets the columns of node tables: `inpact-geometry` knows no deck, `inpact-evaluation` no mesh, and here no law is known.
//! [`State`] is what is known of the nodes at one time: the beginning, or an increment of a result file.
//! [`NodeRows`] makes a row a slave node and state, as [`Batch`](inpact_evaluation::nodes::Batch)es of the columns that any of the states can fill,
//! and counts what it made ([`PairSummary`]).
//!
//! Nothing is guessed: a node without a master face across has an empty clearance, and a master field that a node of its face lacks is empty too.

mod naming;
mod rows;
mod state;
mod summary;

pub use rows::{NodeRows, RowsError};
pub use state::{NodeField, Pressure, State};
pub use summary::{AreaSource, ColumnSummary, PairSummary};
