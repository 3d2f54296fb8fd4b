//! A node table of comma-separated values, read in batches of rows.
//!
//! RFC 4180: cells between commas, quoted where they hold commas, quotes or line ends; blank lines are passed over.
//! A cell that is empty or blank is a missing number. A row is never left out: what cannot be read is reported and stands there as missing.

use super::batch::Batch;
use super::column::Column;
use super::diagnostic::{Findings, MALFORMED_CELL, MISSING_COLUMN, Place};
use super::header::Header;
use csv::{ByteRecord, ReaderBuilder, Terminator};
use std::fmt;
use std::io::{self, Read};

/// How much is read from the input at a time.
const PIECE: usize = 256 * 1024;

/// How many rows a batch has, unless asked otherwise: its columns stay in cache.
const ROWS_OF_A_BATCH: usize = 1024;

/// Reads a node table from a stream.
pub struct NodeReader<'a> {
    csv: csv::Reader<Box<dyn Read + 'a>>,
    header: Header,
    record: ByteRecord,
    rows_read: u64,
    rows_of_a_batch: usize,
    label_fields: Vec<usize>,
    number_fields: Vec<usize>,
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
        formatter.debug_struct("NodeReader").field("header", &self.header).finish_non_exhaustive()
    }
}

impl<'a> NodeReader<'a> {
    /// Opens a node table and reads its header.
    ///
    /// # Errors
    /// Those of reading the input.
    pub fn open(input: Box<dyn Read + 'a>, findings: &mut Findings) -> io::Result<Self> {
        let mut builder = ReaderBuilder::new();
        // The end of a line is LF for the csv crate, so that it counts lines right; a CR before it is taken off here.
        builder.has_headers(false).flexible(true).terminator(Terminator::Any(b'\n')).buffer_capacity(PIECE);
        let mut reader = Self {
            // A file may end without a line end; one more blank line is no row, so that every row has its own.
            csv: builder.from_reader(Box::new(input.chain(&b"\n"[..]))),
            header: Header::default(),
            record: ByteRecord::new(),
            rows_read: 0,
            rows_of_a_batch: ROWS_OF_A_BATCH,
            label_fields: Vec::new(),
            number_fields: Vec::new(),
        };
        if reader.read_record()? {
            let cells = reader.record.iter().map(|cell| String::from_utf8_lossy(without_mark(cell)).into_owned());
            let cells: Vec<String> = cells.collect();
            reader.header = Header::new(cells.iter().map(String::as_str));
            reader.header.report_duplicates(reader.line(), findings);
        } else {
            let message = "the node table is empty: it has no header line";
            findings.report(&MISSING_COLUMN, Place::default(), message, "name the columns in the first line");
        }
        Ok(reader)
    }

    /// The header.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Chooses the columns of the batches to come; one the header does not have gives missing numbers and empty texts.
    pub fn select(&mut self, selection: &Selection) {
        let field = |column: &Column| self.header.position(*column).unwrap_or(usize::MAX);
        self.label_fields = selection.labels.iter().map(field).collect();
        self.number_fields = selection.numbers.iter().map(field).collect();
    }

    /// Sets how many rows a batch has at most, 1 at least.
    pub fn set_rows_of_a_batch(&mut self, rows: usize) {
        self.rows_of_a_batch = rows.max(1);
    }

    /// Reads the next rows into `batch`; false when there are no more.
    ///
    /// # Errors
    /// Those of reading the input.
    pub fn read_batch(&mut self, batch: &mut Batch, findings: &mut Findings) -> io::Result<bool> {
        batch.clear();
        batch.labels.resize_with(self.label_fields.len(), Default::default);
        batch.numbers.resize_with(self.number_fields.len(), Default::default);
        batch.first_row = self.rows_read;
        while batch.rows < self.rows_of_a_batch && self.read_record()? {
            self.rows_read += 1;
            batch.rows += 1;
            batch.lines.push(self.line());
            if self.record.len() != self.header.cells.len() {
                self.report_count(findings);
            }
            for (field, column) in self.label_fields.iter().zip(&mut batch.labels) {
                column.push(self.record.get(*field).unwrap_or_default());
            }
            for (index, column) in batch.numbers.iter_mut().enumerate() {
                let cell = self.record.get(self.number_fields[index]).unwrap_or_default().trim_ascii();
                let value = number(cell);
                if value.is_none() && !cell.is_empty() {
                    self.report_cell(self.number_fields[index], findings);
                }
                column.push(value);
            }
        }
        Ok(batch.rows > 0)
    }

    /// Where the row read last stands.
    fn place(&self, column: Option<String>) -> Place {
        Place { row: Some(self.rows_read), line: Some(self.line()), column }
    }

    /// Reads the next row that is not blank; false at the end.
    fn read_record(&mut self) -> io::Result<bool> {
        while self.csv.read_byte_record(&mut self.record)? {
            self.take_off_carriage_return();
            if self.record.len() > 1 || !self.record[0].trim_ascii().is_empty() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn take_off_carriage_return(&mut self) {
        if self.record.as_slice().last() != Some(&b'\r') {
            return;
        }
        let last = self.record.len() - 1;
        let text = self.record[last].to_vec();
        self.record.truncate(last);
        self.record.push_field(text.strip_suffix(b"\r").unwrap_or(&text));
    }

    /// The line on which the row read last ends.
    fn line(&self) -> u64 {
        // Its line end has been counted already.
        self.csv.position().line() - 1
    }

    fn report_count(&self, findings: &mut Findings) {
        let (found, expected) = (self.record.len(), self.header.cells.len());
        let message = format!("row {} has {found} cells, the header {expected}", self.rows_read);
        let help = "write a comma for every cell that is empty, and quotes around a text that holds commas";
        findings.report(&MALFORMED_CELL, self.place(None), message, help);
    }

    #[cold]
    fn report_cell(&self, field: usize, findings: &mut Findings) {
        let column = self.header.cells[field].text.clone();
        let cell = String::from_utf8_lossy(self.record[field].trim_ascii()).into_owned();
        let shown: String = cell.chars().take(40).collect();
        let message = format!("`{column}` of row {} is `{shown}`, which is no number", self.rows_read);
        let help = if cell.contains(',') {
            "write numbers with a decimal point, as in 1.5e-3"
        } else {
            "write a number such as 1.5e-3, or leave the cell empty where there is none"
        };
        findings.report(&MALFORMED_CELL, self.place(Some(column)), message, help);
    }
}

/// The number a cell holds: what Rust reads as f64, `nan` and `inf` among it.
#[inline]
fn number(cell: &[u8]) -> Option<f64> {
    std::str::from_utf8(cell).ok()?.parse().ok()
}

/// The cell without the byte order mark it may begin with.
fn without_mark(cell: &[u8]) -> &[u8] {
    cell.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(cell)
}
