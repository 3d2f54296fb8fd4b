//! A result table, or a node table, as comma-separated values.
//!
//! Texts of the node table are written unchanged, quoted where necessary (RFC 4180).
//! Numbers are printed in the shortest form that reads back to the same f64; a missing number is an empty cell.

use super::batch::ResultBatch;
#[cfg(feature = "columnar")]
use super::columnar::ColumnarWriter;
use super::format::TableFormat;
use super::heading::{Heading, Values};
use super::number::push_number;
use super::output::Output;
use crate::nodes::{Batch, Column};
use crate::spread;
use std::io::{self, Write};
use std::ops::Range;

/// Writes a result table, or a node table, to a stream.
pub struct ResultWriter<'a> {
    table: Table<'a>,
    rows_written: u64,
}

enum Table<'a> {
    Csv(CsvWriter<'a>),
    #[cfg(feature = "columnar")]
    Columnar(Box<ColumnarWriter<'a>>),
}

struct CsvWriter<'a> {
    output: &'a mut (dyn Write + Send),
    columns: Vec<ResultColumn>,
    /// The text of the blocks of a batch.
    blocks: Vec<Vec<u8>>,
}

/// The block size in rows for formatting; blocks are independent.
const ROWS_OF_A_BLOCK: usize = 1024;

/// Sources of the cells of a column.
#[derive(Debug, Clone, Copy)]
enum ResultColumn {
    /// A text of the node table.
    Label(usize),
    /// A number of the results.
    Number(usize),
    /// A status, that of this column.
    Status(Heading),
}

impl std::fmt::Debug for ResultWriter<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("ResultWriter").field("rows_written", &self.rows_written).finish_non_exhaustive()
    }
}

impl<'a> ResultWriter<'a> {
    /// Begins a table of comma-separated values: the key columns, which are those of the batches' labels, then the outputs.
    ///
    /// # Errors
    /// Those of writing.
    pub fn new(output: &'a mut (dyn Write + Send), keys: &[Column], outputs: &[Output]) -> io::Result<Self> {
        Self::with_headings(output, TableFormat::Csv, keys, &Heading::all(outputs))
    }

    /// Begins a table in some format; Parquet and Arrow are complete only after [`finish`](Self::finish).
    ///
    /// # Errors
    /// Those of writing; of kind [`io::ErrorKind::Unsupported`] for Parquet and Arrow where feature `columnar` is off.
    pub fn with_format(
        output: &'a mut (dyn Write + Send),
        format: TableFormat,
        keys: &[Column],
        outputs: &[Output],
    ) -> io::Result<Self> {
        Self::with_headings(output, format, keys, &Heading::all(outputs))
    }

    /// Begins a node table in some format: the key columns, which are those of the batches' labels, then the columns of numbers.
    ///
    /// # Errors
    /// As [`with_format`](Self::with_format).
    pub fn of_nodes(
        output: &'a mut (dyn Write + Send),
        format: TableFormat,
        keys: &[Column],
        numbers: &[Column],
    ) -> io::Result<Self> {
        let headings: Vec<Heading> = numbers.iter().copied().map(Heading::Given).collect();
        Self::with_headings(output, format, keys, &headings)
    }

    fn with_headings(
        output: &'a mut (dyn Write + Send),
        format: TableFormat,
        keys: &[Column],
        headings: &[Heading],
    ) -> io::Result<Self> {
        match format {
            TableFormat::Csv => {
                let table = Table::Csv(CsvWriter::new(output, keys, headings)?);
                Ok(Self { table, rows_written: 0 })
            }
            #[cfg(feature = "columnar")]
            TableFormat::Parquet | TableFormat::Arrow => {
                let table = ColumnarWriter::new(output, format, keys, headings);
                Ok(Self { table: Table::Columnar(Box::new(table)), rows_written: 0 })
            }
            #[cfg(not(feature = "columnar"))]
            TableFormat::Parquet | TableFormat::Arrow => {
                let message = "this program was built without Parquet and Arrow (feature `columnar`)";
                Err(io::Error::new(io::ErrorKind::Unsupported, message))
            }
        }
    }

    /// Writes the rows of a batch with their results, on several threads where feature `threads` is on.
    ///
    /// # Errors
    /// Those of writing.
    pub fn write(&mut self, batch: &Batch, results: &ResultBatch) -> io::Result<()> {
        self.write_values(batch, Values { numbers: &results.numbers, results: Some(results) })
    }

    /// Writes the rows of a batch itself, to a table that was begun with [`of_nodes`](Self::of_nodes).
    ///
    /// # Errors
    /// Those of writing.
    pub fn write_nodes(&mut self, batch: &Batch) -> io::Result<()> {
        self.write_values(batch, Values { numbers: &batch.numbers, results: None })
    }

    fn write_values(&mut self, batch: &Batch, values: Values<'_>) -> io::Result<()> {
        match &mut self.table {
            Table::Csv(table) => table.write(batch, values)?,
            #[cfg(feature = "columnar")]
            Table::Columnar(table) => table.write(batch, values)?,
        }
        self.rows_written += batch.rows as u64;
        Ok(())
    }

    /// Writes the end of the table; returns the number of rows written.
    ///
    /// # Errors
    /// Those of writing.
    pub fn finish(self) -> io::Result<u64> {
        match self.table {
            Table::Csv(_) => {}
            #[cfg(feature = "columnar")]
            Table::Columnar(mut table) => table.finish()?,
        }
        Ok(self.rows_written)
    }

    /// The number of rows written.
    pub fn rows_written(&self) -> u64 {
        self.rows_written
    }
}

impl<'a> CsvWriter<'a> {
    fn new(output: &'a mut (dyn Write + Send), keys: &[Column], headings: &[Heading]) -> io::Result<Self> {
        let names = keys.iter().map(ToString::to_string).chain(headings.iter().map(ToString::to_string));
        let header: Vec<String> = names.collect();
        output.write_all((header.join(",") + "\n").as_bytes())?;
        let mut columns: Vec<_> = (0..keys.len()).map(ResultColumn::Label).collect();
        let mut number = 0;
        for kind in headings {
            if kind.is_number() {
                columns.push(ResultColumn::Number(number));
                number += 1;
            } else {
                columns.push(ResultColumn::Status(*kind));
            }
        }
        Ok(Self { output, columns, blocks: Vec::new() })
    }

    fn write(&mut self, batch: &Batch, values: Values<'_>) -> io::Result<()> {
        let blocks = batch.rows.div_ceil(ROWS_OF_A_BLOCK);
        if self.blocks.len() < blocks {
            self.blocks.resize_with(blocks, Vec::new);
        }
        let columns = &self.columns;
        spread::for_each(self.blocks[..blocks].iter_mut().enumerate(), |(block, text)| {
            let first = block * ROWS_OF_A_BLOCK;
            text.clear();
            let mut printed = vec![Printed::default(); values.numbers.len()];
            for row in first..batch.rows.min(first + ROWS_OF_A_BLOCK) {
                push_row(text, columns, batch, values, (row, &mut printed));
            }
        });
        for text in &self.blocks[..blocks] {
            self.output.write_all(text)?;
        }
        Ok(())
    }
}

/// The number that a column of a block had last, and where it is printed in the text of the block.
#[derive(Debug, Clone, Default)]
struct Printed {
    bits: u64,
    place: Range<usize>,
}

/// Adds a row; `printed` are the numbers of the columns so far.
fn push_row(
    text: &mut Vec<u8>,
    columns: &[ResultColumn],
    batch: &Batch,
    values: Values<'_>,
    (row, printed): (usize, &mut [Printed]),
) {
    let start = text.len();
    for (index, column) in columns.iter().enumerate() {
        if index > 0 {
            text.push(b',');
        }
        match column {
            ResultColumn::Label(label) => push_text(text, batch.labels[*label].get(row)),
            ResultColumn::Number(number) => {
                if let Some(value) = values.numbers[*number].get(row) {
                    let (start, bits) = (text.len(), value.to_bits());
                    // Weights are the same in all rows, and with one half so is the heat into either surface: what stands above or to the left is copied.
                    let known = [*number, number.saturating_sub(1)].map(|column| &printed[column]);
                    match known.into_iter().find(|known| known.bits == bits && !known.place.is_empty()) {
                        Some(known) => text.extend_from_within(known.place.clone()),
                        None => push_number(text, value),
                    }
                    printed[*number] = Printed { bits, place: start..text.len() };
                }
            }
            ResultColumn::Status(heading) => {
                let status = values.statuses(*heading).and_then(|statuses| statuses[row]);
                text.extend_from_slice(status.map_or("", super::Status::word).as_bytes());
            }
        }
    }
    // A line of one empty cell would be a blank line, which is not a row.
    if text.len() == start {
        text.extend_from_slice(b"\"\"");
    }
    text.push(b'\n');
}

/// Adds a text, in quotes where it contains commas, quotes or line ends.
fn push_text(line: &mut Vec<u8>, text: &[u8]) {
    if !text.iter().any(|byte| matches!(byte, b',' | b'"' | b'\n' | b'\r')) {
        line.extend_from_slice(text);
        return;
    }
    line.push(b'"');
    for byte in text {
        if *byte == b'"' {
            line.push(b'"');
        }
        line.push(*byte);
    }
    line.push(b'"');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_quoted_where_they_must_be() {
        let text = |text: &str| {
            let mut line = Vec::new();
            push_text(&mut line, text.as_bytes());
            String::from_utf8(line).expect("UTF-8")
        };
        assert_eq!(text(" 12 "), " 12 ");
        assert_eq!(text("\"Steel Gap\""), "\"\"\"Steel Gap\"\"\"");
        assert_eq!(text("a,b"), "\"a,b\"");
    }
}
