//! Results in memory as Arrow record batches.

use super::batch::ResultBatch;
use super::columnar::{key_array, number_array};
use super::output::Output;
use super::parquet::of_arrow;
use super::status_words::{StatusRoom, words};
use crate::arrow::array::{ArrayRef, Float64Array, RecordBatch};
use crate::arrow::buffer::{Buffer, NullBuffer, ScalarBuffer};
use crate::arrow::datatypes::{DataType, Field, Schema, SchemaRef};
use crate::nodes::{Batch, Column};
use std::io;
use std::sync::Arc;

/// Makes record batches of result batches, all of one schema: that of the columns [`ResultWriter`](super::ResultWriter) writes.
#[derive(Debug)]
pub struct ResultRecords {
    keys: Vec<Column>,
    outputs: Vec<Output>,
    schema: Option<SchemaRef>,
    given: Given,
}

/// The memory of the previous record batch, reused if its receiver has dropped it.
#[derive(Debug, Default)]
struct Given {
    numbers: Vec<Buffer>,
    words: Vec<Buffer>,
}

impl ResultRecords {
    /// Begins with the key columns, which are those of the batches' labels, and the outputs.
    pub fn new(keys: &[Column], outputs: &[Output]) -> Self {
        Self { keys: keys.to_vec(), outputs: outputs.to_vec(), schema: None, given: Given::default() }
    }

    /// The rows of a batch with their results, whose numbers are moved, not copied.
    ///
    /// # Errors
    /// A key that its column cannot hold.
    pub fn record_batch(&mut self, batch: &Batch, results: &mut ResultBatch) -> io::Result<RecordBatch> {
        let mut arrays: Vec<ArrayRef> = Vec::with_capacity(self.keys.len() + self.outputs.len());
        for (key, label) in self.keys.iter().zip(&batch.labels) {
            arrays.push(key_array(*key, label, batch)?);
        }
        let Given { numbers, words: room_for_words } = std::mem::take(&mut self.given);
        let mut room = numbers.into_iter().filter_map(|buffer| buffer.into_vec::<f64>().ok());
        let mut room_for_words = room_for_words.into_iter().map(StatusRoom::of);
        let mut number = 0;
        for output in &self.outputs {
            if let Some(statuses) = results.statuses(*output) {
                let array = room_for_words.next().unwrap_or_default().array(statuses);
                self.given.words.extend(words(&array));
                arrays.push(array);
                continue;
            }
            arrays.push(match results.numbers.get_mut(number) {
                Some(column) => {
                    let (values, present) = column.take(room.next().unwrap_or_default());
                    let nulls = present.map(NullBuffer::from).filter(|nulls| nulls.null_count() > 0);
                    let values = ScalarBuffer::from(values);
                    self.given.numbers.push(values.inner().clone());
                    Arc::new(Float64Array::new(values, nulls))
                }
                None => Arc::new(Float64Array::new_null(batch.rows)),
            });
            number += 1;
        }
        let schema = match &self.schema {
            Some(schema) => Arc::clone(schema),
            None => self.begin(arrays.iter().map(|array| array.data_type().clone())),
        };
        RecordBatch::try_new(schema, arrays).map_err(of_arrow)
    }

    /// The schema of the record batches; where there was none, that of comma-separated values.
    pub fn schema(&mut self) -> SchemaRef {
        if let Some(schema) = &self.schema {
            return Arc::clone(schema);
        }
        let keys = self.keys.iter().map(|key| if *key == Column::Time { DataType::Float64 } else { DataType::Utf8 });
        let values =
            self.outputs.iter().map(|output| if output.is_number() { DataType::Float64 } else { DataType::Utf8 });
        let types: Vec<DataType> = keys.chain(values).collect();
        self.begin(types.into_iter())
    }

    fn begin(&mut self, types: impl Iterator<Item = DataType>) -> SchemaRef {
        let names = self.keys.iter().map(ToString::to_string).chain(self.outputs.iter().map(ToString::to_string));
        let fields = names.zip(types).map(|(name, kind)| Field::new(name, kind, true));
        let schema = Arc::new(Schema::new(fields.collect::<Vec<_>>()));
        self.schema = Some(Arc::clone(&schema));
        schema
    }
}

/// The rows of a batch of a node table: key columns, which are its labels, then columns of numbers.
///
/// # Errors
/// A key that its column cannot hold.
pub fn node_record_batch(keys: &[Column], numbers: &[Column], batch: &Batch) -> io::Result<RecordBatch> {
    let mut arrays: Vec<ArrayRef> = Vec::with_capacity(keys.len() + numbers.len());
    for (key, label) in keys.iter().zip(&batch.labels) {
        arrays.push(key_array(*key, label, batch)?);
    }
    arrays.extend(batch.numbers.iter().map(number_array));
    let names = keys.iter().chain(numbers).map(ToString::to_string);
    let fields = names.zip(&arrays).map(|(name, array)| Field::new(name, array.data_type().clone(), true));
    RecordBatch::try_new(Arc::new(Schema::new(fields.collect::<Vec<_>>())), arrays).map_err(of_arrow)
}
