//! The formats of a result table.

use std::path::Path;

/// The format of a result table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum TableFormat {
    /// Comma-separated values (RFC 4180).
    #[default]
    Csv,
    /// Parquet.
    Parquet,
    /// Arrow IPC, file format.
    Arrow,
}

impl TableFormat {
    /// The format of a file name extension, in any case; `None` for any other.
    pub fn of_extension(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_ascii_lowercase();
        match extension.to_str()? {
            "csv" => Some(Self::Csv),
            "parquet" => Some(Self::Parquet),
            "arrow" | "ipc" | "feather" => Some(Self::Arrow),
            _ => None,
        }
    }
}
