//! Result tables: the results of each row of a node table, as columns in the order of the contract.
//!
//! [`Output`] is the list of columns, [`ResultBatch`] holds some rows of them, [`ResultWriter`] writes them as comma-separated values.
//! Knows no law: numbers in, text out.

mod batch;
#[cfg(feature = "columnar")]
mod columnar;
mod contract;
mod format;
mod heading;
mod number;
mod output;
#[cfg(feature = "columnar")]
mod parquet;
#[cfg(feature = "columnar")]
mod records;
#[cfg(feature = "columnar")]
mod status_words;
mod writer;

pub use batch::{ResultBatch, Status, StatusByLaw};
pub use contract::{OUTPUT_PAGES, OutputPage};
pub use format::TableFormat;
pub(crate) use number::number_text;
pub use number::{push_number, rounded_up};
pub use output::{Along, Output};
#[cfg(feature = "columnar")]
pub use records::{ResultRecords, node_record_batch};
pub use writer::ResultWriter;
