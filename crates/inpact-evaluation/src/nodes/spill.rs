//! Batches as bytes: the format of a spill file. Only the run that wrote it reads it, so it needs neither version nor fixed byte order.

use super::batch::{Batch, LabelColumn, NumberColumn};
use std::io::{self, Read, Write};

/// Writes a batch.
pub(super) fn write(output: &mut dyn Write, batch: &Batch) -> io::Result<()> {
    for count in [batch.rows as u64, batch.first_row, batch.labels.len() as u64, batch.numbers.len() as u64] {
        output.write_all(&count.to_ne_bytes())?;
    }
    write_words(output, &batch.lines)?;
    for label in &batch.labels {
        write_label(output, label)?;
    }
    for column in &batch.numbers {
        let present = column.presence().unwrap_or_default();
        write_words(output, column.values())?;
        write_bytes(output, &present.iter().map(|present| u8::from(*present)).collect::<Vec<u8>>())?;
    }
    Ok(())
}

/// Reads what [`write`] wrote.
pub(super) fn read(input: &mut dyn Read) -> io::Result<Batch> {
    let [rows, first_row, labels, numbers] =
        [read_count(input)?, read_count(input)?, read_count(input)?, read_count(input)?];
    let mut batch = Batch::with_columns(0, 0);
    batch.rows = as_length(rows)?;
    batch.first_row = first_row;
    batch.lines = read_words(input, u64::from_ne_bytes)?;
    for _ in 0..labels {
        batch.labels.push(read_label(input)?);
    }
    for _ in 0..numbers {
        let values = read_words(input, f64::from_ne_bytes)?;
        let present: Vec<bool> = read_bytes(input)?.into_iter().map(|byte| byte != 0).collect();
        let mut column = NumberColumn::default();
        column.extend_from_slices(&values, Some(present.as_slice()).filter(|present| !present.is_empty()));
        batch.numbers.push(column);
    }
    Ok(batch)
}

/// Encodings of a label.
const TEXTS: u64 = 0;
#[cfg(feature = "columnar")]
const ARRAY: u64 = 1;

fn write_label(output: &mut dyn Write, label: &LabelColumn) -> io::Result<()> {
    #[cfg(feature = "columnar")]
    if let Some(array) = label.array() {
        output.write_all(&ARRAY.to_ne_bytes())?;
        return write_bytes(output, &array_bytes(array).map_err(io::Error::other)?);
    }
    let (bytes, ends) = label.texts();
    output.write_all(&TEXTS.to_ne_bytes())?;
    write_bytes(output, bytes)?;
    write_words(output, &ends.iter().map(|end| *end as u64).collect::<Vec<u64>>())
}

fn read_label(input: &mut dyn Read) -> io::Result<LabelColumn> {
    #[cfg(feature = "columnar")]
    if read_count(input)? == ARRAY {
        let bytes = read_bytes(input)?;
        return array_of(&bytes).map(LabelColumn::from_array).map_err(io::Error::other);
    }
    #[cfg(not(feature = "columnar"))]
    let _: u64 = read_count(input)?;
    let bytes = read_bytes(input)?;
    let ends = read_words(input, u64::from_ne_bytes)?.into_iter().map(as_length).collect::<io::Result<Vec<usize>>>()?;
    Ok(LabelColumn::from_texts(bytes, ends))
}

/// An array as an Arrow stream of one column.
#[cfg(feature = "columnar")]
fn array_bytes(array: &crate::arrow::array::ArrayRef) -> Result<Vec<u8>, crate::arrow::error::ArrowError> {
    let rows =
        crate::arrow::array::RecordBatch::try_from_iter_with_nullable([("", std::sync::Arc::clone(array), true)])?;
    let mut writer = crate::arrow::ipc::writer::StreamWriter::try_new(Vec::new(), &rows.schema())?;
    writer.write(&rows)?;
    writer.into_inner()
}

#[cfg(feature = "columnar")]
fn array_of(bytes: &[u8]) -> Result<crate::arrow::array::ArrayRef, crate::arrow::error::ArrowError> {
    let mut reader = crate::arrow::ipc::reader::StreamReader::try_new(bytes, None)?;
    let rows = reader.next().ok_or_else(|| crate::arrow::error::ArrowError::IpcError("no rows".to_owned()))??;
    Ok(std::sync::Arc::clone(rows.column(0)))
}

fn write_bytes(output: &mut dyn Write, bytes: &[u8]) -> io::Result<()> {
    output.write_all(&(bytes.len() as u64).to_ne_bytes())?;
    output.write_all(bytes)
}

fn read_bytes(input: &mut dyn Read) -> io::Result<Vec<u8>> {
    let length = read_count(input)?;
    let mut bytes = Vec::new();
    if (input.take(length).read_to_end(&mut bytes)? as u64) < length {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    Ok(bytes)
}

/// Writes numbers of eight bytes.
fn write_words<T: pulp::bytemuck::Pod>(output: &mut dyn Write, words: &[T]) -> io::Result<()> {
    write_bytes(output, pulp::bytemuck::cast_slice(words))
}

fn read_words<T>(input: &mut dyn Read, of: fn([u8; 8]) -> T) -> io::Result<Vec<T>> {
    Ok(read_bytes(input)?.as_chunks().0.iter().map(|bytes| of(*bytes)).collect())
}

fn read_count(input: &mut dyn Read) -> io::Result<u64> {
    let mut bytes = [0; 8];
    input.read_exact(&mut bytes)?;
    Ok(u64::from_ne_bytes(bytes))
}

fn as_length(count: u64) -> io::Result<usize> {
    usize::try_from(count).map_err(io::Error::other)
}
