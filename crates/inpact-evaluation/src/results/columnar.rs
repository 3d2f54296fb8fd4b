//! A result table, or a node table, as Parquet or as an Arrow file.
//!
//! Key columns keep the type they have in the node table, dictionaries apart, which become their values;
//! from comma-separated values `node` and `interaction` are texts and `time` is a float.
//! Results are floats with nulls where there is no number. Floats are stored plain and nothing is compressed, which is fastest;
//! row groups are bounded, and so is memory.

use super::format::TableFormat;
use super::writer::{Heading, Values};
use crate::nodes::{Batch, Column, LabelColumn, NumberColumn};
use arrow::array::{Array, ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow::buffer::{NullBuffer, ScalarBuffer};
use arrow::compute::cast;
use arrow::datatypes::{DataType, Field, Schema, SchemaRef};
use arrow::error::ArrowError;
use arrow::ipc::writer::FileWriter;
use parquet::arrow::ArrowWriter;
use parquet::errors::ParquetError;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::schema::types::ColumnPath;
use std::error::Error;
use std::io::{self, Write};
use std::sync::Arc;

/// How many rows a row group has at most.
const ROWS_OF_A_GROUP: usize = 1 << 18;

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
    Parquet(SchemaRef, Box<ArrowWriter<Stream<'a>>>),
    Arrow(SchemaRef, Box<FileWriter<Stream<'a>>>),
    Finished,
}

impl<'a> ColumnarWriter<'a> {
    pub(super) fn new(output: Stream<'a>, format: TableFormat, keys: &[Column], headings: &[Heading]) -> Self {
        Self { format, keys: keys.to_vec(), headings: headings.to_vec(), sink: Sink::Waiting(output) }
    }

    pub(super) fn write(&mut self, batch: &Batch, values: Values<'_>) -> io::Result<()> {
        let mut arrays = Vec::with_capacity(self.keys.len() + self.headings.len());
        for (key, label) in self.keys.iter().zip(&batch.labels) {
            arrays.push(key_array(*key, label, batch)?);
        }
        let mut numbers = values.numbers.iter();
        for heading in &self.headings {
            arrays.push(match values.statuses(*heading) {
                Some(statuses) => status_array(statuses),
                None => numbers
                    .next()
                    .map_or_else(|| Arc::new(Float64Array::new_null(batch.rows)) as ArrayRef, number_array),
            });
        }
        self.begin(arrays.iter().map(|array| array.data_type().clone()).collect())?;
        match &mut self.sink {
            Sink::Parquet(schema, writer) => {
                let rows = RecordBatch::try_new(Arc::clone(schema), arrays).map_err(of_arrow)?;
                writer.write(&rows).map_err(of_parquet)
            }
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
            Sink::Parquet(_, writer) => writer.close().map(drop).map_err(of_parquet),
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
            TableFormat::Parquet => {
                let properties = properties(&schema);
                let writer = ArrowWriter::try_new(output, Arc::clone(&schema), Some(properties)).map_err(of_parquet)?;
                Sink::Parquet(schema, Box::new(writer))
            }
            TableFormat::Arrow | TableFormat::Csv => {
                let writer = FileWriter::try_new(output, &schema).map_err(of_arrow)?;
                Sink::Arrow(schema, Box::new(writer))
            }
        };
        Ok(())
    }
}

fn properties(schema: &Schema) -> WriterProperties {
    let mut properties = WriterProperties::builder()
        .set_max_row_group_row_count(Some(ROWS_OF_A_GROUP))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_dictionary_enabled(false);
    for field in schema.fields().iter().filter(|field| *field.data_type() == DataType::Utf8) {
        properties = properties.set_column_dictionary_enabled(ColumnPath::from(field.name().as_str()), true);
    }
    properties.build()
}

/// The array of a key column.
pub(super) fn key_array(key: Column, label: &LabelColumn, batch: &Batch) -> io::Result<ArrayRef> {
    if let Some(array) = label.array() {
        return match array.data_type() {
            DataType::Dictionary(_, values) => cast(array, values).map_err(of_arrow),
            _ => Ok(Arc::clone(array)),
        };
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

/// A time as a number; the text itself where it is none.
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

pub(super) fn status_array(statuses: &[Option<super::Status>]) -> ArrayRef {
    Arc::new(statuses.iter().map(|status| status.map(super::Status::word)).collect::<StringArray>())
}

pub(super) fn number_array(column: &NumberColumn) -> ArrayRef {
    let nulls = column.presence().map(NullBuffer::from).filter(|nulls| nulls.null_count() > 0);
    Arc::new(Float64Array::new(ScalarBuffer::from(column.values().to_vec()), nulls))
}

pub(super) fn of_arrow(error: ArrowError) -> io::Error {
    match error {
        ArrowError::IoError(_, error) => error,
        error => io::Error::other(error),
    }
}

fn of_parquet(error: ParquetError) -> io::Error {
    match error {
        // A closed pipe must be known for what it is.
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(error) => io::Error::other(error as Box<dyn Error + Send + Sync>),
        },
        error => io::Error::other(error),
    }
}
