//! A result table, or a node table, as comma-separated values.
//!
//! Texts of the node table come out as they went in, quoted where they must be (RFC 4180).
//! Numbers are printed in the shortest form that reads back to the same f64; a missing number is an empty cell.

use super::batch::ResultBatch;
#[cfg(feature = "columnar")]
use super::columnar::ColumnarWriter;
use super::format::TableFormat;
use super::output::Output;
use crate::nodes::{Batch, Column, NumberColumn};
use crate::spread;
use std::fmt;
use std::io::{self, Write};

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

/// A column behind the key columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Heading {
    /// Numbers of a node table.
    Given(Column),
    /// A result.
    Result(Output),
}

impl Heading {
    fn all(outputs: &[Output]) -> Vec<Self> {
        outputs.iter().copied().map(Self::Result).collect()
    }

    /// Whether its cells are numbers: the others are statuses.
    pub(super) fn is_number(self) -> bool {
        match self {
            Self::Given(_) => true,
            Self::Result(output) => output.is_number(),
        }
    }
}

impl fmt::Display for Heading {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given(column) => column.fmt(formatter),
            Self::Result(output) => output.fmt(formatter),
        }
    }
}

/// Values of some rows besides their keys.
#[derive(Clone, Copy)]
pub(super) struct Values<'b> {
    pub(super) numbers: &'b [NumberColumn],
    /// `None` for rows of a node table, which has no statuses.
    pub(super) results: Option<&'b ResultBatch>,
}

impl<'b> Values<'b> {
    /// The statuses of a column of them.
    pub(super) fn statuses(self, heading: Heading) -> Option<&'b [Option<super::Status>]> {
        match heading {
            Heading::Given(_) => None,
            Heading::Result(output) => self.results?.statuses(output),
        }
    }
}

/// How many rows are turned into text at a time; blocks of them are independent of each other.
const ROWS_OF_A_BLOCK: usize = 1024;

/// Where the cells of a column come from.
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

    /// Writes the rows of a batch with their results; threads share the work where feature `threads` is on.
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

    /// Writes what the table ends with; gives how many rows were written.
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

    /// How many rows were written.
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
            for row in first..batch.rows.min(first + ROWS_OF_A_BLOCK) {
                push_row(text, columns, batch, values, row);
            }
        });
        for text in &self.blocks[..blocks] {
            self.output.write_all(text)?;
        }
        Ok(())
    }
}

/// Adds a row.
fn push_row(text: &mut Vec<u8>, columns: &[ResultColumn], batch: &Batch, values: Values<'_>, row: usize) {
    let start = text.len();
    for (index, column) in columns.iter().enumerate() {
        if index > 0 {
            text.push(b',');
        }
        match column {
            ResultColumn::Label(label) => push_text(text, batch.labels[*label].get(row)),
            ResultColumn::Number(number) => {
                if let Some(value) = values.numbers[*number].get(row) {
                    push_number(text, value);
                }
            }
            ResultColumn::Status(heading) => {
                let status = values.statuses(*heading).and_then(|statuses| statuses[row]);
                text.extend_from_slice(status.map_or("", super::Status::word).as_bytes());
            }
        }
    }
    // A line of one empty cell would be a blank line, which is no row.
    if text.len() == start {
        text.extend_from_slice(b"\"\"");
    }
    text.push(b'\n');
}

/// Adds a text, in quotes where commas, quotes or line ends in it would be taken for the table's.
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

/// Adds a number in the shortest form that reads back to the same f64: `20`, `0.05`, `1e-7`, `-0`, `inf`, `NaN`.
///
/// It turns to an exponent below 1e-4 and from 1e16 on, where digits would be many.
#[inline]
pub fn push_number(text: &mut Vec<u8>, value: f64) {
    if !value.is_finite() {
        let word: &[u8] = if value.is_nan() { b"NaN" } else { b"inf" };
        if value == f64::NEG_INFINITY {
            text.push(b'-');
        }
        text.extend_from_slice(word);
        return;
    }
    let size = value.abs();
    let mut buffer = zmij::Buffer::new();
    let printed = buffer.format_finite(value).as_bytes();
    if size != 0.0 && size < 1e-4 {
        push_small(text, printed);
    } else if size < 1e16 {
        text.extend_from_slice(printed.strip_suffix(b".0").unwrap_or(printed));
    } else {
        // An exponent needs no sign.
        text.extend(printed.iter().filter(|byte| **byte != b'+'));
    }
}

/// Adds a number below 1e-4, which may have been printed without an exponent: `0.000012` is `1.2e-5`.
fn push_small(text: &mut Vec<u8>, printed: &[u8]) {
    let (sign, size) = printed.split_at(usize::from(printed[0] == b'-'));
    let Some(digits) = size.strip_prefix(b"0.").filter(|digits| !digits.contains(&b'e')) else {
        text.extend_from_slice(printed);
        return;
    };
    let zeros = digits.iter().take_while(|digit| **digit == b'0').count();
    let digits = &digits[zeros..];
    text.extend_from_slice(sign);
    text.push(digits[0]);
    if digits.len() > 1 {
        text.push(b'.');
        text.extend_from_slice(&digits[1..]);
    }
    // Writing into a vector cannot fail.
    let _ = write!(text, "e-{}", zeros + 1);
}

/// A bound in two digits, never below it: `6.7e-16`.
pub fn rounded_up(bound: f64) -> String {
    let text = format!("{bound:.1e}");
    let is_below = text.parse().is_ok_and(|shown: f64| shown < bound);
    match text.split_once('e') {
        Some((digits, exponent)) if is_below => {
            let digits: f64 = digits.parse().unwrap_or_default();
            format!("{:.1}e{exponent}", digits + 0.1)
        }
        _ => text,
    }
}

/// A number in its shortest form, see [`push_number`].
pub(crate) fn number_text(value: f64) -> String {
    let mut text = Vec::new();
    push_number(&mut text, value);
    String::from_utf8_lossy(&text).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        let text = |value| {
            let mut line = Vec::new();
            push_number(&mut line, value);
            String::from_utf8(line).expect("ASCII")
        };
        assert_eq!(text(0.0), "0");
        assert_eq!(text(-0.0), "-0");
        assert_eq!(text(20.0), "20");
        assert_eq!(text(0.1), "0.1");
        assert_eq!(text(2.5e-7), "2.5e-7");
        assert_eq!(text(1e300), "1e300");
        assert_eq!(text(f64::INFINITY), "inf");
        assert_eq!(text(-f64::INFINITY), "-inf");
        assert_eq!(text(f64::NAN), "NaN");
        assert_eq!(text(-f64::NAN), "NaN");
        assert_eq!(text(-9.999_999e-5), "-9.999999e-5");
        for value in [f64::MIN_POSITIVE, 5e-324, 1.0 / 3.0, 1e15, 1e16, 123_456_789.0, f64::MAX, -2.0f64.powi(60)] {
            assert_eq!(text(value).parse(), Ok(value));
        }
    }

    /// The debug form of the standard library but for the `.0` of whole numbers.
    fn judge(value: f64) -> String {
        let text = format!("{value:?}");
        text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
    }

    proptest! {
        /// The same number in as many digits as the standard library prints; the last one may differ where the number lies halfway between two.
        #[test]
        fn numbers_are_as_short_as_those_of_the_standard_library(bits in any::<u64>(), digits in -99_999..99_999_i32, power in -25..25_i32) {
            let short = f64::from(digits) * 10.0f64.powi(power);
            let halfway = (2.0f64.powi(50) + f64::from(digits.unsigned_abs()) + 0.25) * f64::from(digits.signum());
            for value in [f64::from_bits(bits), halfway, 263_508_915_864_979.0 + 0.625, short, short.next_up(), short.next_down()] {
                let mut text = Vec::new();
                push_number(&mut text, value);
                let (text, judge) = (String::from_utf8_lossy(&text).into_owned(), judge(value));
                prop_assert_eq!(text.len(), judge.len(), "{} for {}", text, judge);
                let read: f64 = text.parse().expect("a number");
                prop_assert!(read == value || (read.is_nan() && value.is_nan()), "{} for {}", text, judge);
                let differing = text.bytes().zip(judge.bytes()).filter(|(a, b)| a != b).count();
                prop_assert!(differing <= 1, "{} for {}", text, judge);
            }
        }
    }

    #[test]
    fn bounds_are_never_shown_smaller() {
        assert_eq!(rounded_up(4.44e-16), "4.5e-16");
        assert_eq!(rounded_up(4.5e-16), "4.5e-16");
        assert_eq!(rounded_up(9.96e-3), "1.0e-2");
        assert_eq!(rounded_up(9.94e-3), "10.0e-3");
        assert_eq!(rounded_up(0.0), "0.0e0");
        assert_eq!(rounded_up(f64::INFINITY), "inf");
    }

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
