//! Node tables: what the contact surfaces of a model do, row by row, as text or numbers in columns.
//!
//! The columns and their other names are a contract with users; [`Column`] is its list.
//! A table is read in batches of rows, so that its length costs no memory: [`NodeReader`] turns the cells that were asked for into [`Batch`]es,
//! and everything else is passed over unread.
//! What is wrong with a table is a value, [`DataDiagnostic`] (rules D001 to D010); errors are those of reading only.
//!
//! Knows no law and no deck: what a column is needed for is the plan's business.

mod batch;
mod column;
mod diagnostic;
mod header;
mod node_index;
mod reader;

pub use batch::{Batch, LabelColumn, NumberColumn};
pub(crate) use column::coordinates;
pub use column::{Column, Direction, Part};
pub(crate) use diagnostic::{
    BEYOND_TABLE, MALFORMED_CELL, MISSING_COLUMN, NEGATIVE_AREA, NEGATIVE_PROPERTY, NON_FINITE, TIME_NOT_ASCENDING,
    UNKNOWN_INTERACTION, USER_FAULT,
};
pub use diagnostic::{DATA_RULES, DataDiagnostic, DataRule, Findings, Place};
pub use header::{Header, HeaderCell};
pub use node_index::NodeIndex;
pub use reader::{NodeReader, Selection};
