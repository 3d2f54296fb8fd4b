//! A node table, read in batches of rows.
//!
//! A row is never left out: what cannot be read is reported and stands there as missing.
//! A cell that is empty or blank is a missing number.

use super::batch::Batch;
use super::column::Column;
use super::csv::CsvReader;
use super::diagnostic::Findings;
use super::header::Header;
use std::fmt;
use std::io::{self, Read};

/// How many rows a batch has at most, unless asked otherwise.
const ROWS_OF_A_BATCH: usize = 8192;

/// Reads a node table from a stream.
pub struct NodeReader<'a> {
    table: CsvReader<'a>,
    rows_of_a_batch: usize,
    selection: Selection,
}

/// Which columns of a node table to read.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Selection {
    /// Columns whose texts are wanted.
    pub labels: Vec<Column>,
    /// Columns whose numbers are wanted.
    pub numbers: Vec<Column>,
}

impl Selection {
    /// The place of a column among the labels.
    pub fn label(&self, column: Column) -> Option<usize> {
        self.labels.iter().position(|selected| *selected == column)
    }

    /// The place of a column among the numbers.
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
        let table = CsvReader::open(input, findings)?;
        Ok(Self { table, rows_of_a_batch: ROWS_OF_A_BATCH, selection: Selection::default() })
    }

    /// The header.
    pub fn header(&self) -> &Header {
        self.table.header()
    }

    /// Chooses the columns of the batches to come; one the header does not have gives missing numbers and empty texts.
    ///
    /// To be called before the first batch is read.
    pub fn select(&mut self, selection: &Selection) {
        selection.clone_into(&mut self.selection);
        self.apply();
    }

    /// Sets how many rows a batch has at most, 1 at least; to be called before the first batch is read.
    pub fn set_rows_of_a_batch(&mut self, rows: usize) {
        self.rows_of_a_batch = rows.max(1);
        self.apply();
    }

    /// Reads and decodes up to so many pieces of the table on the threads of rayon's current pool while others are evaluated.
    ///
    /// 0, which holds unless asked otherwise, decodes each piece when its turn comes. What comes out is the same.
    pub fn set_read_ahead(&mut self, pieces: usize) {
        self.table.set_read_ahead(pieces);
    }

    /// Reads the next rows into `batch`; false when there are no more.
    ///
    /// # Errors
    /// Those of reading the input.
    pub fn read_batch(&mut self, batch: &mut Batch, findings: &mut Findings) -> io::Result<bool> {
        self.table.read_batch(batch, findings)
    }

    fn apply(&mut self) {
        let header = self.table.header();
        let field = |column: &Column| header.position(*column).unwrap_or(usize::MAX);
        let labels: Vec<usize> = self.selection.labels.iter().map(field).collect();
        let numbers: Vec<usize> = self.selection.numbers.iter().map(field).collect();
        self.table.select(&labels, &numbers, self.rows_of_a_batch);
    }
}
