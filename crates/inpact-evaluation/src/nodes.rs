//! Node tables: the state of contact surfaces, row by row, as columns of text or numbers.
//!
//! The columns and their alternative names are a contract with users; [`Column`] lists them.
//! A table is streamed in batches of rows, so that memory does not grow with its length: [`NodeReader`] turns the requested cells into [`Batch`]es
//! and skips everything else.
//! A fault of a table is a value, a `Diagnostic` of rules D001 to D010 and D020 to D022; errors are input errors only.
//!
//! Knows no law and no deck: the plan decides which columns are needed.

#[cfg(feature = "columnar")]
pub(crate) mod arrays;
mod batch;
mod cells;
mod column;
mod column_name;
#[cfg(feature = "columnar")]
mod columnar;
mod contract;
mod csv;
mod decode;
mod foreign;
mod header;
mod kept;
mod lines;
mod made;
mod node_index;
mod node_label;
mod number;
mod places;
mod reader;
mod rules;
#[cfg(feature = "columnar")]
mod soundness;
mod spill;
mod stored;
mod wait;

#[cfg(feature = "columnar")]
pub(crate) use arrays::without_dictionary;
pub use batch::{Batch, LabelColumn, NumberColumn};
pub(crate) use cells::Cells;
pub(crate) use column::coordinates;
pub use column::{Column, Direction, Part};
#[cfg(feature = "columnar")]
pub use columnar::RecordBatches;
pub use contract::{COLUMN_PAGES, ColumnPage};
pub use header::{Header, HeaderCell};
pub use inpact_diagnostics::{Findings, Place};
pub use kept::{KeptRows, KeptRowsIter, MakeSpillFile, SpillFile};
pub use made::MadeBatches;
pub use node_index::HistoryOrder;
pub(crate) use node_index::{HistorySlot, NodeIndex, NodeRuns};
pub(crate) use node_label::{NodeLabel, NodeLabels};
pub use places::locate;
pub use reader::{NodeReader, Selection};
pub(crate) use rules::{BEYOND_TABLE, HEAT_OF_CLOSING, NEGATIVE_AREA, NEGATIVE_PROPERTY, TIME_NOT_ASCENDING};
pub use rules::{
    CONTRADICTORY_RATE, DATA_RULES, DUPLICATE_COLUMN, MALFORMED_CELL, MISSING_COLUMN, NON_FINITE, UNKNOWN_INTERACTION,
    USER_FAULT,
};
pub use stored::{ColumnStatistics, ReadSeek};
