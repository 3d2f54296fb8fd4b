//! A result table as comma-separated values.
//!
//! Texts of the node table come out as they went in, quoted where they must be (RFC 4180).
//! Numbers are printed in the shortest form that reads back to the same f64; a missing number is an empty cell.

use super::batch::ResultBatch;
use super::output::Output;
use crate::nodes::{Batch, Column};
use std::io::{self, Write};

/// Writes a result table to a stream.
pub struct ResultWriter<'a> {
    output: &'a mut dyn Write,
    columns: Vec<ResultColumn>,
    line: Vec<u8>,
    rows_written: u64,
}

/// Where the cells of a column come from.
#[derive(Debug, Clone, Copy)]
enum ResultColumn {
    /// A text of the node table.
    Label(usize),
    /// A number of the results.
    Number(usize),
    Status,
}

impl std::fmt::Debug for ResultWriter<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("ResultWriter").field("columns", &self.columns).finish_non_exhaustive()
    }
}

impl<'a> ResultWriter<'a> {
    /// Writes the header: the key columns, which are those of the batches' labels, then the outputs.
    ///
    /// # Errors
    /// Those of writing.
    pub fn new(output: &'a mut dyn Write, keys: &[Column], outputs: &[Output]) -> io::Result<Self> {
        let names = keys.iter().map(ToString::to_string).chain(outputs.iter().map(ToString::to_string));
        let header: Vec<String> = names.collect();
        output.write_all((header.join(",") + "\n").as_bytes())?;
        let mut columns: Vec<_> = (0..keys.len()).map(ResultColumn::Label).collect();
        let mut number = 0;
        for kind in outputs {
            if *kind == Output::Status {
                columns.push(ResultColumn::Status);
            } else {
                columns.push(ResultColumn::Number(number));
                number += 1;
            }
        }
        Ok(Self { output, columns, line: Vec::new(), rows_written: 0 })
    }

    /// Writes the rows of a batch with their results.
    ///
    /// # Errors
    /// Those of writing.
    pub fn write(&mut self, batch: &Batch, results: &ResultBatch) -> io::Result<()> {
        self.line.clear();
        for row in 0..batch.rows {
            for (index, column) in self.columns.iter().enumerate() {
                if index > 0 {
                    self.line.push(b',');
                }
                match column {
                    ResultColumn::Label(label) => push_text(&mut self.line, batch.labels[*label].get(row)),
                    ResultColumn::Number(number) => {
                        if let Some(value) = results.numbers[*number].get(row) {
                            push_number(&mut self.line, value);
                        }
                    }
                    ResultColumn::Status => {
                        let word = results.status[row].map_or("", super::Status::word);
                        self.line.extend_from_slice(word.as_bytes());
                    }
                }
            }
            // A line of one empty cell would be a blank line, which is no row.
            if self.line.last().is_none_or(|byte| *byte == b'\n') {
                self.line.extend_from_slice(b"\"\"");
            }
            self.line.push(b'\n');
        }
        self.output.write_all(&self.line)?;
        self.rows_written += batch.rows as u64;
        Ok(())
    }

    /// How many rows were written.
    pub fn rows_written(&self) -> u64 {
        self.rows_written
    }
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
#[inline]
pub fn push_number(line: &mut Vec<u8>, value: f64) {
    if value == 0.0 && value.is_sign_positive() {
        line.push(b'0');
        return;
    }
    // The debug form turns to an exponent where digits would be many; only its `.0` of whole numbers says nothing.
    // Writing into a vector cannot fail.
    let _ = write!(line, "{value:?}");
    if line.ends_with(b".0") {
        line.truncate(line.len() - 2);
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
        for value in [f64::MIN_POSITIVE, 5e-324, 1.0 / 3.0, 1e15, 1e16, 123_456_789.0, f64::MAX, -2.0f64.powi(60)] {
            assert_eq!(text(value).parse(), Ok(value));
        }
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
