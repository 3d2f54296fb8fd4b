//! Columns as a Parquet file, each encoded independently.
//!
//! Floats are stored plain and nothing is compressed, which is fastest; row groups are bounded, and so is memory.
//! A row group is written once it is complete, column by column: the file does not depend on the number of threads that encoded it.

use crate::arrow::array::{Array, ArrayRef};
use crate::arrow::datatypes::{DataType, Schema, SchemaRef};
use crate::arrow::error::ArrowError;
use crate::spread;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_writer::{ArrowColumnWriter, ArrowRowGroupWriterFactory, compute_leaves};
use parquet::errors::ParquetError;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::ColumnPath;
use std::io::{self, Write};

/// The maximum number of rows of a row group.
const ROWS_OF_A_GROUP: usize = 1 << 18;

/// The maximum number of bytes of a page: one or two batches, which are still in the cache when the page is written.
const BYTES_OF_A_PAGE: usize = 1 << 17;

/// A Parquet file being written.
pub(super) struct ParquetTable<W: Write + Send> {
    schema: SchemaRef,
    file: SerializedFileWriter<W>,
    groups: ArrowRowGroupWriterFactory,
    /// The columns of the current row group; empty between row groups.
    columns: Vec<ArrowColumnWriter>,
    /// Their number of rows.
    rows: usize,
}

impl<W: Write + Send> ParquetTable<W> {
    /// Begins a file with these columns, this many of which are keys.
    pub(super) fn begin(output: W, schema: SchemaRef, keys: usize) -> io::Result<Self> {
        let properties = properties(&schema, keys);
        let writer = ArrowWriter::try_new(output, schema.clone(), Some(properties)).map_err(of_parquet)?;
        let (file, groups) = writer.into_serialized_writer().map_err(of_parquet)?;
        Ok(Self { schema, file, groups, columns: Vec::new(), rows: 0 })
    }

    /// Adds rows, whose columns are flat and of the types of the schema, or dictionaries of these.
    pub(super) fn write(&mut self, arrays: &[ArrayRef], rows: usize) -> io::Result<()> {
        let mut first = 0;
        while first < rows {
            if self.columns.is_empty() {
                let group = self.file.flushed_row_groups().len();
                self.columns = self.groups.create_column_writers(group).map_err(of_parquet)?;
            }
            let count = (rows - first).min(ROWS_OF_A_GROUP - self.rows);
            let columns = self.columns.iter_mut().zip(self.schema.fields()).zip(arrays);
            let encoded = spread::map(columns, |((column, field), array)| {
                let leaves = compute_leaves(field, &array.slice(first, count))?;
                leaves.iter().try_for_each(|leaf| column.write(leaf))
            });
            encoded.into_iter().collect::<Result<(), _>>().map_err(of_parquet)?;
            self.rows += count;
            first += count;
            if self.rows == ROWS_OF_A_GROUP {
                self.finish_group()?;
            }
        }
        Ok(())
    }

    /// Writes the last rows and the footer.
    pub(super) fn finish(mut self) -> io::Result<()> {
        self.finish_group()?;
        self.file.close().map(drop).map_err(of_parquet)
    }

    /// Writes the current row group, if any.
    fn finish_group(&mut self) -> io::Result<()> {
        let columns = std::mem::take(&mut self.columns);
        self.rows = 0;
        if columns.is_empty() {
            return Ok(());
        }
        let chunks = spread::map(columns, ArrowColumnWriter::close);
        let mut group = self.file.next_row_group().map_err(of_parquet)?;
        for chunk in chunks {
            chunk.and_then(|chunk| chunk.append_to_row_group(&mut group)).map_err(of_parquet)?;
        }
        group.close().map(drop).map_err(of_parquet)
    }
}

fn properties(schema: &Schema, keys: usize) -> WriterProperties {
    let mut properties = WriterProperties::builder()
        .set_max_row_group_row_count(Some(ROWS_OF_A_GROUP))
        .set_data_page_size_limit(BYTES_OF_A_PAGE)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_dictionary_enabled(false);
    for (index, field) in schema.fields().iter().enumerate().filter(|(_, field)| *field.data_type() == DataType::Utf8) {
        let column = ColumnPath::from(field.name().as_str());
        properties = properties.set_column_dictionary_enabled(column.clone(), true);
        if keys <= index {
            // Alphabetic minimum and maximum of statuses are useless, and cost as much as the column.
            properties = properties.set_column_statistics_enabled(column, EnabledStatistics::None);
        }
    }
    properties.build()
}

fn of_parquet(error: ParquetError) -> io::Error {
    match error {
        // A closed pipe must be recognisable.
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(error) => of_arrow(ArrowError::ExternalError(error)),
        },
        error => io::Error::other(error),
    }
}

/// An error of Arrow as one of the stream.
pub(super) fn of_arrow(error: ArrowError) -> io::Error {
    match error {
        ArrowError::IoError(_, error) => error,
        error => io::Error::other(error),
    }
}
