//! Columnar files: their sources and the metadata of their columns.

use std::io::{Read, Seek};

/// Sources of columnar tables.
pub trait ReadSeek: Read + Seek + Send + 'static {}

impl<T: Read + Seek + Send + 'static> ReadSeek for T {}

/// Statistics of a column of numbers stored in a table, available without reading its rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnStatistics {
    /// The smallest number that is not NaN; infinity where there is none.
    pub least: f64,
    /// The largest number that is not NaN; minus infinity where there is none.
    pub greatest: f64,
    /// The number of missing numbers.
    pub nulls: u64,
    /// The number of rows.
    pub rows: u64,
}
