//! Columnar files: their sources and the metadata of their columns.

use std::io::{Read, Seek};

/// Sources of tables that are stored as columns.
pub trait ReadSeek: Read + Seek + Send + 'static {}

impl<T: Read + Seek + Send + 'static> ReadSeek for T {}

/// Statistics of a column of numbers that a table itself has, without its rows being read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnStatistics {
    /// The smallest number that is not NaN; infinity where there is none.
    pub least: f64,
    /// The largest number that is not NaN; minus infinity where there is none.
    pub greatest: f64,
    /// How many numbers are missing.
    pub nulls: u64,
    /// How many rows there are.
    pub rows: u64,
}
