//! A result table, or a node table, as Parquet or as an Arrow file.
//!
//! Key columns keep the type they have in the node table, except that dictionaries become their values;
//! from comma-separated values `node` and `interaction` are texts and `time` is a float.
//! Results are floats with nulls where there is no number.
//! The columns of a batch are made, and for Parquet encoded, on rayon's current thread pool; the bytes do not depend on its size.

use super::format::TableFormat;
use super::heading::{Heading, Values};
use super::parquet::{ParquetTable, of_arrow};
use super::status_words::StatusRoom;
use crate::arrow::array::{Array, ArrayRef, DictionaryArray, Float64Array, Int8Array, RecordBatch, StringArray};
use crate::arrow::buffer::{NullBuffer, ScalarBuffer};
use crate::arrow::datatypes::{DataType, Field, Schema, SchemaRef};
use crate::arrow::ipc::writer::FileWriter;
use crate::nodes::{Batch, Column, LabelColumn, NumberColumn, without_dictionary};
use crate::spread;
use std::io::{self, Write};
use std::sync::Arc;

type Stream<'a> = &'a mut (dyn Write + Send);

/// Writes a result table of columns.
pub(super) struct ColumnarWriter<'a> {
    format: TableFormat,
    keys: Vec<Column>,
    headings: Vec<Heading>,
    sink: Sink<'a>,
}

enum Sink<'a> {
    /// The types of the key columns are not known yet.
    Waiting(Stream<'a>),
    Parquet(Box<ParquetTable<Stream<'a>>>),
    Arrow(SchemaRef, Box<FileWriter<Stream<'a>>>),
    Finished,
}

impl<'a> ColumnarWriter<'a> {
    pub(super) fn new(output: Stream<'a>, format: TableFormat, keys: &[Column], headings: &[Heading]) -> Self {
        Self { format, keys: keys.to_vec(), headings: headings.to_vec(), sink: Sink::Waiting(output) }
    }

    pub(super) fn write(&mut self, batch: &Batch, values: Values<'_>) -> io::Result<()> {
        let mut numbers = values.numbers.iter();
        let of_heading = |heading: &Heading| match values.statuses(*heading) {
            Some(statuses) if self.format == TableFormat::Parquet => Source::StatusesToEncode(statuses),
            Some(statuses) => Source::Statuses(statuses),
            None => numbers.next().map_or(Source::Nothing, Source::Numbers),
        };
        let keys = self.keys.iter().zip(&batch.labels).map(|(key, label)| Source::Key(*key, label));
        let sources: Vec<Source<'_>> = keys.chain(self.headings.iter().map(of_heading)).collect();
        let arrays = spread::map(sources, |source| source.array(batch)).into_iter().collect::<io::Result<Vec<_>>>()?;
        let kind = |array: &ArrayRef| match array.data_type() {
            DataType::Dictionary(_, values) => values.as_ref().clone(),
            kind => kind.clone(),
        };
        self.begin(arrays.iter().map(kind).collect())?;
        match &mut self.sink {
            Sink::Parquet(table) => table.write(&arrays, batch.rows),
            Sink::Arrow(schema, writer) => {
                let rows = RecordBatch::try_new(Arc::clone(schema), arrays).map_err(of_arrow)?;
                writer.write(&rows).map_err(of_arrow)
            }
            Sink::Waiting(_) | Sink::Finished => Ok(()),
        }
    }

    /// Writes what a file ends with.
    pub(super) fn finish(&mut self) -> io::Result<()> {
        let keys = self.keys.iter().map(|key| if *key == Column::Time { DataType::Float64 } else { DataType::Utf8 });
        let values =
            self.headings.iter().map(|heading| if heading.is_number() { DataType::Float64 } else { DataType::Utf8 });
        self.begin(keys.chain(values).collect())?;
        match std::mem::replace(&mut self.sink, Sink::Finished) {
            Sink::Parquet(table) => table.finish(),
            Sink::Arrow(_, mut writer) => writer.finish().map_err(of_arrow),
            Sink::Waiting(_) | Sink::Finished => Ok(()),
        }
    }

    /// Begins the file with columns of these types, if it has not begun.
    fn begin(&mut self, types: Vec<DataType>) -> io::Result<()> {
        let output = match std::mem::replace(&mut self.sink, Sink::Finished) {
            Sink::Waiting(output) => output,
            begun => {
                self.sink = begun;
                return Ok(());
            }
        };
        let names = self.keys.iter().map(ToString::to_string).chain(self.headings.iter().map(ToString::to_string));
        let fields = names.zip(types).map(|(name, kind)| Field::new(name, kind, true));
        let schema = Arc::new(Schema::new(fields.collect::<Vec<_>>()));
        self.sink = match self.format {
            TableFormat::Parquet => Sink::Parquet(Box::new(ParquetTable::begin(output, schema, self.keys.len())?)),
            TableFormat::Arrow | TableFormat::Csv => {
                let writer = FileWriter::try_new(output, &schema).map_err(of_arrow)?;
                Sink::Arrow(schema, Box::new(writer))
            }
        };
        Ok(())
    }
}

/// Sources of a column of the table.
enum Source<'b> {
    Key(Column, &'b LabelColumn),
    Numbers(&'b NumberColumn),
    Statuses(&'b [Option<super::Status>]),
    /// Those of a file whose encoder takes dictionary indices.
    StatusesToEncode(&'b [Option<super::Status>]),
    /// A column of numbers that no row has.
    Nothing,
}

impl Source<'_> {
    fn array(self, batch: &Batch) -> io::Result<ArrayRef> {
        match self {
            Self::Key(key, label) => key_array(key, label, batch),
            Self::Numbers(column) => Ok(number_array(column)),
            Self::Statuses(statuses) => Ok(StatusRoom::default().array(statuses)),
            Self::StatusesToEncode(statuses) => Ok(status_dictionary(statuses)),
            Self::Nothing => Ok(Arc::new(Float64Array::new_null(batch.rows))),
        }
    }
}

/// The array of a key column.
pub(super) fn key_array(key: Column, label: &LabelColumn, batch: &Batch) -> io::Result<ArrayRef> {
    if let Some(array) = label.array() {
        return without_dictionary(array).map_err(of_arrow);
    }
    if key == Column::Time {
        let times = (0..batch.rows).map(|row| time(label.get(row)).map_err(|text| no_key(batch, row, key, &text)));
        return Ok(Arc::new(times.collect::<io::Result<Float64Array>>()?));
    }
    let text = |row| {
        let text = std::str::from_utf8(label.get(row));
        text.map(Some).map_err(|_| no_key(batch, row, key, &String::from_utf8_lossy(label.get(row))))
    };
    Ok(Arc::new((0..batch.rows).map(text).collect::<io::Result<StringArray>>()?))
}

/// A time as a number; the text itself where it is not a number.
fn time(text: &[u8]) -> Result<Option<f64>, String> {
    let text = String::from_utf8_lossy(text.trim_ascii());
    if text.is_empty() { Ok(None) } else { text.parse().map(Some).map_err(|_| text.into_owned()) }
}

fn no_key(batch: &Batch, row: usize, key: Column, text: &str) -> io::Error {
    let row = batch.first_row + row as u64 + 1;
    let what = if key == Column::Time { "number" } else { "text of UTF-8" };
    let message = format!("`{key}` of row {row} is `{text}`, which is no {what}; comma-separated values can hold it");
    io::Error::new(io::ErrorKind::InvalidData, message)
}

fn status_dictionary(statuses: &[Option<super::Status>]) -> ArrayRef {
    let keys: Int8Array = if statuses.contains(&None) {
        statuses.iter().map(|status| status.map(|status| status as i8)).collect()
    } else {
        Int8Array::from_iter_values(statuses.iter().flatten().map(|status| *status as i8))
    };
    let words = StringArray::from_iter_values(super::Status::ALL.map(super::Status::word));
    Arc::new(DictionaryArray::new(keys, Arc::new(words)))
}

pub(super) fn number_array(column: &NumberColumn) -> ArrayRef {
    let nulls = column.presence().filter(|present| present.contains(&false)).map(NullBuffer::from);
    Arc::new(Float64Array::new(ScalarBuffer::from(column.values().to_vec()), nulls))
}
