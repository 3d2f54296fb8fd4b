//! Node tables as Parquet or Arrow IPC (file and stream): the requested columns, copied as columns.
//!
//! Numbers may be floats, integers, booleans, or dictionaries of these; a null is a missing number, NaN is NaN.
//! Key columns keep their array, so that a result table has them unchanged; their text is made lazily.

use super::arrays;
use super::batch::{Batch, LabelColumn, NumberColumn};
use super::header::Header;
use super::rules::MALFORMED_CELL;
use super::soundness::{self, caught, unsound};
use super::stored::{ColumnStatistics, ReadSeek};
use super::wait::{begin, wait_for};
use crate::arrow::array::{ArrayRef, AsArray, RecordBatch};
use crate::arrow::datatypes::{DataType, Float64Type, SchemaRef};
use crate::arrow::error::ArrowError;
use crate::arrow::ipc::reader::{FileReader, StreamReader};
use bytes::Bytes;
use inpact_diagnostics::{Findings, Place};
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{ArrowReaderMetadata, ArrowReaderOptions, ParquetRecordBatchReaderBuilder};
use parquet::errors::ParquetError;
use parquet::file::reader::{ChunkReader, Length};
use parquet::file::statistics::Statistics;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};

/// Formats of columnar tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Storage {
    Parquet,
    ArrowFile,
    ArrowStream,
}

impl Storage {
    /// The name of the format.
    fn kind(self) -> &'static str {
        match self {
            Self::Parquet => "Parquet",
            Self::ArrowFile | Self::ArrowStream => "Arrow",
        }
    }
}

/// Reads a node table of columns.
pub(super) struct ColumnarReader {
    header: Header,
    schema: SchemaRef,
    rows: Rows,
    /// Indices in the schema of the requested columns; `usize::MAX` for one it does not have.
    labels: Vec<usize>,
    numbers: Vec<usize>,
    rows_of_a_batch: usize,
    rows_read: u64,
    reads_ahead: bool,
}

/// Where rows come from.
enum Rows {
    /// Nothing has been read.
    Parquet(Shared, ArrowReaderMetadata),
    /// Nothing has been read.
    Arrow(Storage, Box<dyn ReadSeek>),
    /// Rows given as record batches; nothing has been read.
    Batches(RecordBatches),
    Begun(Source),
    /// Another thread is reading the next rows.
    UnderWay(Receiver<(Source, Read1)>),
    Ended,
}

/// Results of one step of reading: rows, the end, or an error.
type Read1 = io::Result<Option<Columns>>;

/// An iterator of record batches.
pub type RecordBatches = Box<dyn Iterator<Item = Result<RecordBatch, ArrowError>> + Send>;

/// Rows of the requested columns.
struct Source {
    kind: &'static str,
    batches: RecordBatches,
    /// The rest of the batch read last.
    rest: Option<RecordBatch>,
    rows_of_a_batch: usize,
    /// The index of each label and number in a record batch, if it can be read.
    labels: Vec<Option<usize>>,
    numbers: Vec<Option<usize>>,
}

/// Rows for a batch: arrays of labels, and of numbers as f64.
struct Columns {
    rows: usize,
    labels: Vec<Option<ArrayRef>>,
    numbers: Vec<Option<ArrayRef>>,
}

impl ColumnarReader {
    pub(super) fn open(mut input: Box<dyn ReadSeek>, storage: Storage, findings: &mut Findings) -> io::Result<Self> {
        let (schema, rows) = caught(storage.kind(), || match storage {
            Storage::Parquet => {
                let shared = Shared::new(input)?;
                soundness::parquet::check_footer(&shared)?;
                let options = ArrowReaderOptions::new();
                let metadata = ArrowReaderMetadata::load(&shared, options).map_err(|error| invalid_parquet(&error))?;
                Ok((Arc::clone(metadata.schema()), Rows::Parquet(shared, metadata)))
            }
            Storage::ArrowFile => {
                soundness::arrow::check_file(&mut *input)?;
                let schema = FileReader::try_new(BufReader::new(&mut input), None).map_err(invalid)?.schema();
                Ok((schema, Rows::Arrow(storage, input)))
            }
            Storage::ArrowStream => {
                soundness::arrow::check_stream(&mut *input)?;
                let schema = StreamReader::try_new(BufReader::new(&mut input), None).map_err(invalid)?.schema();
                Ok((schema, Rows::Arrow(storage, input)))
            }
        })?;
        Ok(Self::new(schema, rows, findings))
    }

    /// Reads record batches of this schema.
    pub(super) fn of_batches(schema: SchemaRef, batches: RecordBatches, findings: &mut Findings) -> Self {
        Self::new(schema, Rows::Batches(batches), findings)
    }

    fn new(schema: SchemaRef, rows: Rows, findings: &mut Findings) -> Self {
        let header = Header::new(schema.fields().iter().map(|field| field.name().as_str()));
        header.report_duplicates(findings);
        Self {
            header,
            schema,
            rows,
            labels: Vec::new(),
            numbers: Vec::new(),
            rows_of_a_batch: usize::MAX,
            rows_read: 0,
            reads_ahead: false,
        }
    }

    pub(super) fn header(&self) -> &Header {
        &self.header
    }

    /// Selects the columns of the following batches.
    pub(super) fn select(&mut self, labels: &[usize], numbers: &[usize], rows_of_a_batch: usize) {
        self.labels = labels.to_vec();
        self.numbers = numbers.to_vec();
        self.rows_of_a_batch = rows_of_a_batch;
    }

    /// Reads the next rows on another thread while others are evaluated.
    pub(super) fn set_reads_ahead(&mut self, reads_ahead: bool) {
        self.reads_ahead = reads_ahead;
    }

    /// Statistics of column number `index` in a Parquet file, if they are of all rows.
    pub(super) fn statistics(&self, index: usize) -> Option<ColumnStatistics> {
        let Rows::Parquet(_, metadata) = &self.rows else { return None };
        caught(Storage::Parquet.kind(), || Ok(statistics(metadata, index))).ok()?
    }

    /// Reads the next rows; false when there are no more.
    pub(super) fn read_batch(&mut self, batch: &mut Batch, findings: &mut Findings) -> io::Result<bool> {
        batch.clear(self.labels.len(), self.numbers.len());
        batch.first_row = self.rows_read;
        let (source, read) = match std::mem::replace(&mut self.rows, Rows::Ended) {
            Rows::Ended => return Ok(false),
            Rows::UnderWay(receiver) => wait_for(&receiver)?,
            Rows::Begun(source) => source.step(),
            begin => {
                self.rows = begin;
                self.report_types(findings);
                caught("Parquet or Arrow", || self.begin())?.step()
            }
        };
        let Some(columns) = read? else { return Ok(false) };
        self.rows = if self.reads_ahead {
            let (sender, receiver) = channel();
            begin(move || {
                // The receiver is gone when the reader was dropped.
                let _ = sender.send(source.step());
            });
            Rows::UnderWay(receiver)
        } else {
            Rows::Begun(source)
        };
        columns.fill(batch);
        self.rows_read += batch.rows as u64;
        Ok(true)
    }

    /// Reports requested columns whose type is neither number nor key.
    fn report_types(&self, findings: &mut Findings) {
        let wrong_labels = self.labels.iter().filter(|index| self.is_wrong(**index, is_key));
        let wrong_numbers = self.numbers.iter().filter(|index| self.is_wrong(**index, is_numeric));
        let wrong_labels = wrong_labels.map(|index| (*index, "store it as a text or a number"));
        let wrong_numbers = wrong_numbers.map(|index| (*index, "store it as a float, an integer or a boolean"));
        for (index, help) in wrong_labels.chain(wrong_numbers) {
            let field = self.schema.field(index);
            let name = field.name();
            let what = if help.contains("text") { "labels" } else { "numbers" };
            let message = format!("column `{name}` is of type {}, which holds no {what}", field.data_type());
            let place = Place { column: Some(name.clone()), ..Place::default() };
            findings.report(&MALFORMED_CELL, place, message, help);
        }
    }

    fn is_wrong(&self, index: usize, is_right: fn(&DataType) -> bool) -> bool {
        self.schema.fields().get(index).is_some_and(|field| !is_right(field.data_type()))
    }

    /// Begins to read the requested columns.
    fn begin(&mut self) -> io::Result<Source> {
        let right = |index: &usize, is_right| *index < self.schema.fields().len() && !self.is_wrong(*index, is_right);
        let labels: Vec<Option<usize>> =
            self.labels.iter().map(|index| Some(*index).filter(|index| right(index, is_key))).collect();
        let numbers: Vec<Option<usize>> =
            self.numbers.iter().map(|index| Some(*index).filter(|index| right(index, is_numeric))).collect();
        let mut read: Vec<usize> = labels.iter().chain(&numbers).flatten().copied().collect();
        read.sort_unstable();
        read.dedup();
        let kind = match &self.rows {
            Rows::Parquet(..) => Storage::Parquet.kind(),
            _ => Storage::ArrowFile.kind(),
        };
        let batches: RecordBatches = match std::mem::replace(&mut self.rows, Rows::Ended) {
            Rows::Parquet(shared, metadata) => {
                soundness::parquet::check_pages(&shared, metadata.metadata(), |root| read.contains(&root))?;
                let mask = ProjectionMask::roots(metadata.parquet_schema(), read.iter().copied());
                let builder = ParquetRecordBatchReaderBuilder::new_with_metadata(shared, metadata);
                let rows = self.rows_of_a_batch.min(MAX_ROWS_AT_ONCE);
                let reader = builder
                    .with_projection(mask)
                    .with_batch_size(rows)
                    .build()
                    .map_err(|error| invalid_parquet(&error))?;
                Box::new(reader)
            }
            Rows::Arrow(storage, mut input) => {
                input.seek(SeekFrom::Start(0))?;
                let input = BufReader::new(input);
                if storage == Storage::ArrowFile {
                    Box::new(FileReader::try_new(input, Some(read.clone())).map_err(invalid)?)
                } else {
                    Box::new(StreamReader::try_new(input, Some(read.clone())).map_err(invalid)?)
                }
            }
            Rows::Batches(batches) => {
                let read = read.clone();
                Box::new(batches.map(move |batch| batch?.project(&read)))
            }
            Rows::Begun(_) | Rows::UnderWay(_) | Rows::Ended => Box::new(std::iter::empty()),
        };
        let place = |index: Option<usize>| read.iter().position(|read| Some(*read) == index);
        Ok(Source {
            kind,
            batches,
            rest: None,
            rows_of_a_batch: self.rows_of_a_batch,
            labels: labels.into_iter().map(place).collect(),
            numbers: numbers.into_iter().map(place).collect(),
        })
    }
}

/// The maximum number of rows of a Parquet file decoded at once.
const MAX_ROWS_AT_ONCE: usize = 8192;

impl Source {
    /// Reads the next rows.
    fn step(mut self) -> (Self, Read1) {
        let kind = self.kind;
        let read = caught(kind, || self.next_columns().map_err(|error| invalid_as(kind, error)));
        (self, read)
    }

    fn next_columns(&mut self) -> Result<Option<Columns>, ArrowError> {
        loop {
            let whole = match self.rest.take() {
                Some(rest) => rest,
                None => match self.batches.next() {
                    Some(batch) => batch?,
                    None => return Ok(None),
                },
            };
            let rows = whole.num_rows().min(self.rows_of_a_batch);
            if rows == 0 {
                continue;
            }
            if rows < whole.num_rows() {
                self.rest = Some(whole.slice(rows, whole.num_rows() - rows));
            }
            let columns = whole.slice(0, rows);
            let labels = self.labels.iter().map(|place| place.map(|place| Arc::clone(columns.column(place)))).collect();
            let number = |place: &Option<usize>| place.map(|place| arrays::numbers(columns.column(place))).transpose();
            let numbers = self.numbers.iter().map(number).collect::<Result<_, _>>()?;
            return Ok(Some(Columns { rows, labels, numbers }));
        }
    }
}

impl Columns {
    fn fill(self, batch: &mut Batch) {
        batch.rows = self.rows;
        for (label, column) in self.labels.into_iter().zip(&mut batch.labels) {
            match label {
                Some(array) => *column = LabelColumn::from_array(array),
                None => (0..self.rows).for_each(|_| column.push(b"")),
            }
        }
        for (numbers, column) in self.numbers.into_iter().zip(&mut batch.numbers) {
            match numbers {
                Some(numbers) => *column = number_column(numbers),
                None => column.reset(self.rows),
            }
        }
    }
}

/// The column of an array of f64, whose memory is taken over or shared where no number is missing.
fn number_column(array: ArrayRef) -> NumberColumn {
    let numbers = array.as_primitive::<Float64Type>().clone();
    drop(array);
    let (_, values, nulls) = numbers.into_parts();
    match nulls.filter(|nulls| nulls.null_count() > 0) {
        None => NumberColumn::of_buffer(values),
        Some(nulls) => {
            let values = values.into_inner().into_vec().unwrap_or_else(|shared| shared.typed_data().to_vec());
            NumberColumn::from_parts(values, nulls.iter().collect())
        }
    }
}

/// Whether arrays of a type hold numbers.
fn is_numeric(kind: &DataType) -> bool {
    match kind {
        DataType::Boolean | DataType::Null => true,
        DataType::Dictionary(_, values) => is_numeric(values),
        kind => kind.is_integer() || kind.is_floating(),
    }
}

/// Whether arrays of a type hold labels.
fn is_key(kind: &DataType) -> bool {
    match kind {
        DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View => true,
        DataType::Dictionary(_, values) => is_key(values),
        kind => is_numeric(kind),
    }
}

/// Statistics of column number `index` in a Parquet file, if they are of all rows.
fn statistics(metadata: &ArrowReaderMetadata, index: usize) -> Option<ColumnStatistics> {
    let parquet = metadata.metadata();
    let descriptor = parquet.file_metadata().schema_descr();
    let leaf = (0..descriptor.num_columns()).find(|leaf| descriptor.get_column_root_idx(*leaf) == index)?;
    let mut whole = ColumnStatistics { least: f64::INFINITY, greatest: f64::NEG_INFINITY, nulls: 0, rows: 0 };
    for group in parquet.row_groups() {
        let of = group.column(leaf).statistics()?;
        let rows = u64::try_from(group.num_rows()).ok()?;
        let nulls = of.null_count_opt()?;
        whole.nulls += nulls;
        whole.rows += rows;
        if nulls == rows {
            continue;
        }
        let (least, greatest) = bounds(of)?;
        whole.least = whole.least.min(least);
        whole.greatest = whole.greatest.max(greatest);
    }
    Some(whole)
}

/// Minimum and maximum of some rows, if known exactly.
fn bounds(of: &Statistics) -> Option<(f64, f64)> {
    let exact = of.min_is_exact() && of.max_is_exact();
    let (least, greatest) = match of {
        Statistics::Int32(of) => (f64::from(*of.min_opt()?), f64::from(*of.max_opt()?)),
        Statistics::Int64(of) => (*of.min_opt()? as f64, *of.max_opt()? as f64),
        Statistics::Float(of) => (f64::from(*of.min_opt()?), f64::from(*of.max_opt()?)),
        Statistics::Double(of) => (*of.min_opt()?, *of.max_opt()?),
        Statistics::Boolean(of) => (f64::from(*of.min_opt()?), f64::from(*of.max_opt()?)),
        Statistics::Int96(_) | Statistics::ByteArray(_) | Statistics::FixedLenByteArray(_) => return None,
    };
    (exact && least <= greatest).then_some((least, greatest))
}

/// The error of an inconsistent Arrow file.
fn invalid(error: ArrowError) -> io::Error {
    invalid_as(Storage::ArrowFile.kind(), error)
}

fn invalid_as(kind: &str, error: ArrowError) -> io::Error {
    use io::ErrorKind::{InvalidData, InvalidInput, Other, UnexpectedEof};
    match error {
        // A sound file does not point before its beginning or beyond its end;
        // faulty compression is reported as an error without a kind, unlike errors of the system.
        ArrowError::IoError(_, error)
            if !matches!(error.kind(), UnexpectedEof | InvalidInput | InvalidData | Other) =>
        {
            error
        }
        error => unsound(kind, error),
    }
}

fn invalid_parquet(error: &ParquetError) -> io::Error {
    unsound(Storage::Parquet.kind(), error)
}

/// A file shared by several readers.
#[derive(Clone)]
struct Shared {
    file: Arc<Mutex<Box<dyn ReadSeek>>>,
    length: u64,
}

/// A position in a [`Shared`] file.
struct Cursor {
    file: Shared,
    at: u64,
}

impl Shared {
    fn new(mut file: Box<dyn ReadSeek>) -> io::Result<Self> {
        let length = file.seek(SeekFrom::End(0))?;
        Ok(Self { file: Arc::new(Mutex::new(file)), length })
    }
}

impl Length for Shared {
    fn len(&self) -> u64 {
        self.length
    }
}

impl ChunkReader for Shared {
    type T = BufReader<Cursor>;

    fn get_read(&self, start: u64) -> Result<Self::T, ParquetError> {
        Ok(BufReader::new(Cursor { file: self.clone(), at: start }))
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes, ParquetError> {
        if self.length.saturating_sub(start) < length as u64 {
            return Err(ParquetError::EOF(format!("{length} bytes are expected at {start}, beyond the end")));
        }
        let mut bytes = vec![0; length];
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(start))?;
        file.read_exact(&mut bytes)?;
        Ok(bytes.into())
    }
}

impl Read for Cursor {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut file = self.file.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(self.at))?;
        let count = file.read(buffer)?;
        self.at += count as u64;
        Ok(count)
    }
}
