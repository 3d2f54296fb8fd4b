//! A node table, read in batches of rows.
//!
//! A row is never dropped: a cell that cannot be read is reported and becomes a missing number.
//! A cell that is empty or blank is a missing number.

use super::batch::Batch;
use super::column::Column;
#[cfg(feature = "columnar")]
use super::columnar::{ColumnarReader, Storage};
use super::csv::CsvReader;
use super::foreign;
use super::header::Header;
use super::made::{MadeBatches, MadeReader};
use super::stored::{ColumnStatistics, ReadSeek};
use inpact_diagnostics::Findings;
use std::fmt;
use std::io::{self, Read, Seek, SeekFrom};

/// The default maximum number of rows of a batch.
const ROWS_OF_A_BATCH: usize = 8192;

/// Reads a node table from a stream.
pub struct NodeReader<'a> {
    table: Table<'a>,
    rows_of_a_batch: usize,
    selection: Selection,
}

/// The format of the table.
enum Table<'a> {
    Csv(Box<CsvReader<'a>>),
    #[cfg(feature = "columnar")]
    Columnar(Box<ColumnarReader>),
    Made(Box<MadeReader<'a>>),
}

/// Which columns of a node table to read.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Selection {
    /// Columns to read as texts.
    pub labels: Vec<Column>,
    /// Columns to read as numbers.
    pub numbers: Vec<Column>,
}

impl Selection {
    /// The index of a column among the labels.
    pub fn label(&self, column: Column) -> Option<usize> {
        self.labels.iter().position(|selected| *selected == column)
    }

    /// The index of a column among the numbers.
    pub fn number(&self, column: Column) -> Option<usize> {
        self.numbers.iter().position(|selected| *selected == column)
    }
}

impl fmt::Debug for NodeReader<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("NodeReader").field("header", self.header()).finish_non_exhaustive()
    }
}

impl<'a> NodeReader<'a> {
    /// Opens a node table of comma-separated values and reads its header.
    ///
    /// # Errors
    /// Those of reading the input.
    pub fn open(input: Box<dyn Read + Send + 'a>, findings: &mut Findings) -> io::Result<Self> {
        Ok(Self::new(Table::Csv(Box::new(CsvReader::open(input, findings)?))))
    }

    /// Opens a node table and detects its format from the first bytes: Parquet, an Arrow file or stream, otherwise comma-separated values.
    ///
    /// # Errors
    /// Those of reading the input; of kind [`io::ErrorKind::InvalidData`] where it is not in the format of its first bytes, or these are those of another kind of file,
    /// [`io::ErrorKind::Unsupported`] for Parquet and Arrow where feature `columnar` is off.
    pub fn open_any(mut input: Box<dyn ReadSeek>, findings: &mut Findings) -> io::Result<NodeReader<'static>> {
        let mut magic = Vec::new();
        input.by_ref().take(foreign::LOOKED_AT as u64).read_to_end(&mut magic)?;
        input.seek(SeekFrom::Start(0))?;
        #[cfg(feature = "columnar")]
        {
            let storage = match magic.as_slice() {
                [b'P', b'A', b'R', b'1', ..] => Some(Storage::Parquet),
                [b'A', b'R', b'R', b'O', b'W', b'1', ..] => Some(Storage::ArrowFile),
                [0xFF, 0xFF, 0xFF, 0xFF, ..] => Some(Storage::ArrowStream),
                _ => None,
            };
            if let Some(storage) = storage {
                let table = ColumnarReader::open(input, storage, findings)?;
                return Ok(NodeReader::new(Table::Columnar(Box::new(table))));
            }
        }
        #[cfg(not(feature = "columnar"))]
        if matches!(
            magic.as_slice(),
            [b'P', b'A', b'R', b'1', ..] | [b'A', b'R', b'R', b'O', b'W', b'1', ..] | [0xFF, 0xFF, 0xFF, 0xFF, ..]
        ) {
            let message = "it is a Parquet or Arrow table, which this program was built without (feature `columnar`)";
            return Err(io::Error::new(io::ErrorKind::Unsupported, message));
        }
        foreign::refuse(&magic)?;
        NodeReader::open(Box::new(input), findings)
    }

    /// Opens a node table given as record batches of one schema, which are pulled one by one.
    #[cfg(feature = "columnar")]
    pub fn of_batches(
        schema: crate::arrow::datatypes::SchemaRef,
        batches: super::RecordBatches,
        findings: &mut Findings,
    ) -> NodeReader<'static> {
        let table = ColumnarReader::of_batches(schema, batches, findings);
        NodeReader::new(Table::Columnar(Box::new(table)))
    }

    /// Opens a node table that is generated while it is read: key columns, the labels of its batches, and columns of numbers.
    pub fn of_made(keys: &[Column], numbers: &[Column], batches: MadeBatches<'a>) -> Self {
        Self::new(Table::Made(Box::new(MadeReader::new(keys, numbers, batches))))
    }

    fn new(table: Table<'a>) -> Self {
        Self { table, rows_of_a_batch: ROWS_OF_A_BATCH, selection: Selection::default() }
    }

    /// The header.
    pub fn header(&self) -> &Header {
        match &self.table {
            Table::Csv(table) => table.header(),
            #[cfg(feature = "columnar")]
            Table::Columnar(table) => table.header(),
            Table::Made(table) => table.header(),
        }
    }

    /// Statistics of a column of numbers stored in the table itself, as in Parquet files: for all rows, available until the first batch is read.
    pub fn statistics(&self, column: Column) -> Option<ColumnStatistics> {
        match &self.table {
            Table::Csv(_) | Table::Made(_) => None,
            #[cfg(feature = "columnar")]
            Table::Columnar(table) => table.statistics(table.header().position(column)?),
        }
        .filter(|_: &ColumnStatistics| self.header().has(column))
    }

    /// Selects the columns of the following batches; one the header does not have gives missing numbers and empty texts.
    ///
    /// To be called before the first batch is read.
    pub fn select(&mut self, selection: &Selection) {
        selection.clone_into(&mut self.selection);
        self.apply();
    }

    /// Sets the largest number of rows of a batch, at least 1; to be called before the first batch is read.
    pub fn set_rows_of_a_batch(&mut self, rows: usize) {
        self.rows_of_a_batch = rows.max(1);
        self.apply();
    }

    /// Reads ahead: decodes up to this many pieces of the table on rayon's current thread pool while others are evaluated.
    ///
    /// With 0, the default, each piece is decoded when it is needed. The result is the same.
    pub fn set_read_ahead(&mut self, pieces: usize) {
        match &mut self.table {
            Table::Csv(table) => table.set_read_ahead(pieces),
            #[cfg(feature = "columnar")]
            Table::Columnar(table) => table.set_reads_ahead(0 < pieces),
            Table::Made(_) => {}
        }
    }

    /// Reads the next rows into `batch`; false when there are no more.
    ///
    /// # Errors
    /// Those of reading the input.
    pub fn read_batch(&mut self, batch: &mut Batch, findings: &mut Findings) -> io::Result<bool> {
        match &mut self.table {
            Table::Csv(table) => table.read_batch(batch, findings),
            #[cfg(feature = "columnar")]
            Table::Columnar(table) => table.read_batch(batch, findings),
            Table::Made(table) => table.read_batch(batch),
        }
    }

    fn apply(&mut self) {
        let header = self.header();
        let field = |column: &Column| header.position(*column).unwrap_or(usize::MAX);
        let labels: Vec<usize> = self.selection.labels.iter().map(field).collect();
        let numbers: Vec<usize> = self.selection.numbers.iter().map(field).collect();
        match &mut self.table {
            Table::Csv(table) => table.select(&labels, &numbers, self.rows_of_a_batch),
            #[cfg(feature = "columnar")]
            Table::Columnar(table) => table.select(&labels, &numbers, self.rows_of_a_batch),
            Table::Made(table) => table.select(&labels, &numbers, self.rows_of_a_batch),
        }
    }
}
