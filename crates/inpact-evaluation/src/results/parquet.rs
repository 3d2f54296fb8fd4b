//! Columns of rows as a Parquet file, each encoded by itself.
//!
//! Floats are stored plain and nothing is compressed, which is fastest; row groups are bounded, and so is memory.
//! Keys, which may be of any type, are encoded by the library, all other columns by [`flat`].
//! A row group is written once its rows are complete, column after column: the file does not depend on the number of threads that encoded them.

mod flat;

pub(super) use self::flat::Cells;
use self::flat::FlatColumn;
use crate::arrow::array::{Array, ArrayRef};
use crate::arrow::datatypes::{DataType, Field, Schema, SchemaRef};
use crate::arrow::error::ArrowError;
use crate::spread;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_writer::{ArrowColumnWriter, ArrowRowGroupWriterFactory, compute_leaves};
use parquet::errors::ParquetError;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::ColumnPath;
use std::io::{self, Write};
use std::sync::Arc;

/// How many rows a row group has at most.
const ROWS_OF_A_GROUP: usize = 1 << 18;

/// How many bytes a page of a column has at most: those of a batch or two, so that they are still in the cache when the page is written.
const BYTES_OF_A_PAGE: usize = 1 << 17;

/// A Parquet file under way.
pub(super) struct ParquetTable<W: Write + Send> {
    schema: SchemaRef,
    file: SerializedFileWriter<W>,
    groups: ArrowRowGroupWriterFactory,
    /// The key columns of the row group under way; empty between row groups.
    keys: Vec<ArrowColumnWriter>,
    /// The other columns, whose memory serves the next row group too.
    columns: Vec<FlatColumn>,
    /// How many rows they have.
    rows: usize,
}

impl<W: Write + Send> ParquetTable<W> {
    /// Begins a file of these columns, so many of which are keys.
    pub(super) fn begin(output: W, schema: SchemaRef, keys: usize) -> io::Result<Self> {
        let properties = properties(&schema, keys);
        let writer = ArrowWriter::try_new(output, schema.clone(), Some(properties)).map_err(of_parquet)?;
        let (file, groups) = writer.into_serialized_writer().map_err(of_parquet)?;
        let descriptors = file.schema_descr().columns()[keys..].iter();
        let columns = descriptors.map(|descriptor| match descriptor.physical_type() {
            parquet::basic::Type::DOUBLE => FlatColumn::numbers(descriptor.clone()),
            _ => FlatColumn::statuses(descriptor.clone()),
        });
        let columns = columns.collect();
        Ok(Self { schema, file, groups, keys: Vec::new(), columns, rows: 0 })
    }

    /// Adds so many rows: the keys, which are flat and of the types of the schema, or dictionaries of these, and the cells of the other columns.
    pub(super) fn write(&mut self, keys: &[ArrayRef], cells: &[Cells<'_>], rows: usize) -> io::Result<()> {
        let mut first = 0;
        while first < rows {
            if self.rows == 0 {
                let group = self.file.flushed_row_groups().len();
                self.keys = self.groups.create_column_writers(group).map_err(of_parquet)?;
                self.keys.truncate(keys.len());
            }
            let count = (rows - first).min(ROWS_OF_A_GROUP - self.rows);
            let of_keys = self.keys.iter_mut().zip(self.schema.fields()).zip(keys);
            let of_keys = of_keys.map(|((column, field), array)| Part::Key(column, field, array));
            let others = self.columns.iter_mut().zip(cells).map(|(column, cells)| Part::Flat(column, *cells));
            let encoded = spread::map(of_keys.chain(others), |part| match part {
                Part::Key(column, field, array) => {
                    let leaves = compute_leaves(field, &array.slice(first, count))?;
                    leaves.iter().try_for_each(|leaf| column.write(leaf))
                }
                Part::Flat(column, cells) => column.write(cells, first..first + count),
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

    /// Writes the last rows and what the file ends with.
    pub(super) fn finish(mut self) -> io::Result<()> {
        self.finish_group()?;
        self.file.close().map(drop).map_err(of_parquet)
    }

    /// Writes the row group under way, if there is one.
    fn finish_group(&mut self) -> io::Result<()> {
        if self.rows == 0 {
            return Ok(());
        }
        self.rows = 0;
        let chunks = spread::map(std::mem::take(&mut self.keys), ArrowColumnWriter::close);
        let mut group = self.file.next_row_group().map_err(of_parquet)?;
        for chunk in chunks {
            chunk.and_then(|chunk| chunk.append_to_row_group(&mut group)).map_err(of_parquet)?;
        }
        for column in &mut self.columns {
            column.append(&mut group).map_err(of_parquet)?;
        }
        group.close().map(drop).map_err(of_parquet)
    }
}

/// The work on one column.
enum Part<'b> {
    Key(&'b mut ArrowColumnWriter, &'b Arc<Field>, &'b ArrayRef),
    Flat(&'b mut FlatColumn, Cells<'b>),
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
            // The least and the greatest status by the alphabet help nobody, and cost as much as the column.
            properties = properties.set_column_statistics_enabled(column, EnabledStatistics::None);
        }
    }
    properties.build()
}

fn of_parquet(error: ParquetError) -> io::Error {
    match error {
        // A closed pipe must be known for what it is.
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
