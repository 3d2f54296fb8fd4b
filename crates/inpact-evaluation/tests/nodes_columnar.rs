//! Node tables as Parquet and Arrow hold what the same table of comma-separated values holds.

#![cfg(feature = "columnar")]

use inpact_evaluation::arrow::array::{
    Array, ArrayRef, AsArray, BooleanArray, DictionaryArray, Float32Array, Float64Array, Int64Array, RecordBatch,
    StringArray,
};
use inpact_evaluation::arrow::datatypes::{DataType, Float64Type, Int32Type};
use inpact_evaluation::arrow::ipc::reader::FileReader;
use inpact_evaluation::arrow::ipc::writer::{FileWriter, StreamWriter};
use inpact_evaluation::nodes::{Batch, Column, Findings, NodeReader, Part, Selection};
use inpact_evaluation::results::{Output, ResultBatch, ResultWriter, Status, TableFormat};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::basic::{Compression, GzipLevel, ZstdLevel};
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterVersion};
use proptest::prelude::*;
use std::io::{self, Cursor};
use std::path::Path;
use std::sync::Arc;

/// A row: node, interaction, clearance, potential.
type Row = (i64, Option<u8>, Option<f64>, Option<f64>);

#[derive(Debug, Clone, Copy)]
enum Storage {
    Csv,
    Parquet,
    ArrowFile,
    ArrowStream,
}

const STORAGES: [Storage; 4] = [Storage::Csv, Storage::Parquet, Storage::ArrowFile, Storage::ArrowStream];

fn number() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![
        2 => any::<u64>().prop_map(|bits| Some(f64::from_bits(bits))),
        1 => Just(None),
        1 => prop_oneof![Just(-0.0), Just(f64::NAN), Just(f64::INFINITY), Just(0.1)].prop_map(Some),
    ]
}

fn rows() -> impl Strategy<Value = Vec<Row>> {
    prop::collection::vec((any::<i64>(), prop::option::of(0..3_u8), number(), number()), 1..60)
}

fn word(number: u8) -> &'static str {
    ["GAP", "Steel, polished", "\"q\""][usize::from(number)]
}

fn record(rows: &[Row]) -> RecordBatch {
    let texts: DictionaryArray<Int32Type> = rows.iter().map(|row| row.1.map(word)).collect();
    let columns: [(&str, ArrayRef); 5] = [
        ("Node", Arc::new(rows.iter().map(|row| Some(row.0)).collect::<Int64Array>())),
        ("comment", Arc::new(StringArray::from(vec!["not read"; rows.len()]))),
        ("interaction", Arc::new(texts)),
        ("COPEN", Arc::new(rows.iter().map(|row| row.2).collect::<Float64Array>())),
        ("epot_s", Arc::new(rows.iter().map(|row| row.3).collect::<Float64Array>())),
    ];
    RecordBatch::try_from_iter_with_nullable(columns.map(|(name, array)| (name, array, true)))
        .expect("columns of one length")
}

fn csv(rows: &[Row]) -> Vec<u8> {
    let mut text = "Node;comment;interaction;COPEN;epot_s\n".to_owned();
    for (node, interaction, clearance, potential) in rows {
        let word = interaction.map_or(String::new(), |number| format!("\"{}\"", word(number).replace('"', "\"\"")));
        let number = |value: &Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
        text += &format!("{node};\"not\nread\";{word};{};{}\n", number(clearance), number(potential));
    }
    text.into_bytes()
}

fn stored(record: &RecordBatch, storage: Storage) -> Vec<u8> {
    let mut bytes = Vec::new();
    let schema = record.schema();
    match storage {
        Storage::Csv => {}
        Storage::Parquet => {
            let mut writer = ArrowWriter::try_new(&mut bytes, schema, None).expect("a vector takes all");
            writer.write(record).expect("a vector takes all");
            writer.close().expect("a vector takes all");
        }
        Storage::ArrowFile => {
            let mut writer = FileWriter::try_new(&mut bytes, &schema).expect("a vector takes all");
            writer.write(record).expect("a vector takes all");
            writer.finish().expect("a vector takes all");
        }
        Storage::ArrowStream => {
            let mut writer = StreamWriter::try_new(&mut bytes, &schema).expect("a vector takes all");
            writer.write(record).expect("a vector takes all");
            writer.finish().expect("a vector takes all");
        }
    }
    bytes
}

fn selection() -> Selection {
    Selection {
        labels: vec![Column::Interaction, Column::Node, Column::Time],
        numbers: vec![Column::Potential(Part::Slave), Column::Area, Column::Clearance],
    }
}

/// All rows of a table, in batches of so many rows.
fn read(bytes: Vec<u8>, rows_of_a_batch: usize, read_ahead: usize) -> (Vec<Batch>, Vec<String>) {
    let mut findings = Findings::new("nodes");
    let mut reader = NodeReader::open_any(Box::new(Cursor::new(bytes)), &mut findings).expect("sound");
    reader.set_rows_of_a_batch(rows_of_a_batch);
    reader.set_read_ahead(read_ahead);
    reader.select(&selection());
    let mut batches = Vec::new();
    let mut batch = Batch::default();
    while reader.read_batch(&mut batch, &mut findings).expect("sound") {
        batches.push(std::mem::take(&mut batch));
    }
    (batches, findings.into_list().into_iter().map(|found| format!("{} {}", found.code, found.message)).collect())
}

/// What a row is to those who read it: its number, its texts, and the bits of its numbers.
type RowCells = (u64, Vec<Vec<u8>>, Vec<Option<u64>>);

fn cells(batches: &[Batch]) -> Vec<RowCells> {
    let rows = batches.iter().flat_map(|batch| (0..batch.rows).map(move |row| (batch, row)));
    // The sign and payload of a NaN say nothing.
    let bits = |value: f64| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() };
    rows.map(|(batch, row)| {
        let labels = batch.labels.iter().map(|column| column.get(row).to_vec()).collect();
        let numbers = batch.numbers.iter().map(|column| column.get(row).map(bits)).collect();
        (batch.first_row + row as u64, labels, numbers)
    })
    .collect()
}

/// The result table that repeats the numbers of the node table.
fn results(batches: &[Batch], format: TableFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    let keys = [Column::Interaction, Column::Node, Column::Time];
    let mut writer = ResultWriter::with_format(&mut bytes, format, &keys, &[Output::Ecd, Output::Status, Output::Sjd])
        .expect("a vector takes all");
    for batch in batches {
        let numbers = vec![batch.numbers[0].clone(), batch.numbers[2].clone()];
        let status = (0..batch.rows).map(|row| [None, Some(Status::Open), Some(Status::Closed)][row % 3]).collect();
        writer.write(batch, &ResultBatch { numbers, status, ..ResultBatch::default() }).expect("a vector takes all");
    }
    writer.finish().expect("a vector takes all");
    bytes
}

proptest! {
    #[test]
    fn every_storage_gives_the_same_batches_and_results(rows in rows(), size in 1..30_usize, ahead in 0..4_usize) {
        let record = record(&rows);
        let (whole, findings) = read(csv(&rows), usize::MAX, 0);
        prop_assert_eq!(findings, Vec::<String>::new());
        prop_assert_eq!(whole.iter().map(|batch| batch.rows).sum::<usize>(), rows.len());
        for storage in STORAGES {
            let bytes = if let Storage::Csv = storage { csv(&rows) } else { stored(&record, storage) };
            let (batches, findings) = read(bytes.clone(), size, ahead);
            prop_assert_eq!(findings, Vec::<String>::new());
            prop_assert!(batches.iter().all(|batch| batch.rows <= size));
            prop_assert_eq!(cells(&batches), cells(&whole), "{:?}", storage);
            let (unlimited, _) = read(bytes, usize::MAX, 0);
            prop_assert_eq!(results(&unlimited, TableFormat::Csv), results(&whole, TableFormat::Csv), "{:?}", storage);
        }
    }

    #[test]
    fn results_read_back_from_parquet_and_arrow(rows in rows()) {
        let record = record(&rows);
        for storage in STORAGES {
            let bytes = if let Storage::Csv = storage { csv(&rows) } else { stored(&record, storage) };
            let (batches, _) = read(bytes, usize::MAX, 0);
            let parquet = results(&batches, TableFormat::Parquet);
            let parquet = ParquetRecordBatchReaderBuilder::try_new(bytes::Bytes::from(parquet)).expect("sound");
            let from_parquet: Vec<RecordBatch> = parquet.build().expect("sound").map(|batch| batch.expect("sound")).collect();
            let arrow = FileReader::try_new(Cursor::new(results(&batches, TableFormat::Arrow)), None).expect("sound");
            let from_arrow: Vec<RecordBatch> = arrow.map(|batch| batch.expect("sound")).collect();
            for table in [&from_parquet[0], &from_arrow[0]] {
                let names: Vec<String> = table.schema().fields().iter().map(|field| field.name().clone()).collect();
                prop_assert_eq!(names.join(","), "interaction,node,time,ECD,status,SJD");
                let kind = if let Storage::Csv = storage { DataType::Utf8 } else { DataType::Int64 };
                prop_assert_eq!(table.column(1).data_type(), &kind);
                for (column, value) in [(3, 3_usize), (5, 2)] {
                    let found = table.column(column).as_primitive::<Float64Type>();
                    for (row, expected) in rows.iter().enumerate() {
                        let expected = if value == 3 { expected.3 } else { expected.2 };
                        let found = found.is_valid(row).then(|| found.value(row));
                        prop_assert!(found == expected || found.is_some_and(f64::is_nan) && expected.is_some_and(f64::is_nan));
                    }
                }
                let texts = table.column(0).as_string::<i32>();
                for (row, expected) in rows.iter().enumerate() {
                    // Comma-separated values cannot tell an empty text from none.
                    let found = if texts.is_null(row) { "" } else { texts.value(row) };
                    prop_assert_eq!(found, expected.1.map_or("", word));
                }
            }
        }
    }
}

#[test]
fn numbers_of_other_types_are_numbers() {
    let columns: [(&str, ArrayRef); 3] = [
        ("clearance", Arc::new(Float32Array::from(vec![Some(0.5), None]))),
        ("epot_s", Arc::new(BooleanArray::from(vec![Some(true), Some(false)]))),
        ("area", Arc::new(Int64Array::from(vec![Some(-3), None]))),
    ];
    let record = RecordBatch::try_from_iter(columns).expect("columns of one length");
    for storage in [Storage::Parquet, Storage::ArrowFile, Storage::ArrowStream] {
        let (batches, findings) = read(stored(&record, storage), 10, 0);
        assert_eq!(findings, Vec::<String>::new());
        let numbers = |column: usize| [batches[0].numbers[column].get(0), batches[0].numbers[column].get(1)];
        assert_eq!(numbers(2), [Some(0.5), None]);
        assert_eq!(numbers(0), [Some(1.0), Some(0.0)]);
        assert_eq!(numbers(1), [Some(-3.0), None]);
    }
}

#[test]
fn a_column_of_texts_is_no_column_of_numbers_d002() {
    let texts: ArrayRef = Arc::new(StringArray::from(vec!["0.5"]));
    let record = RecordBatch::try_from_iter([("copen", texts)]).expect("one column");
    for storage in [Storage::Parquet, Storage::ArrowFile, Storage::ArrowStream] {
        let (batches, findings) = read(stored(&record, storage), 10, 0);
        assert_eq!(findings, ["D002 column `copen` is of type Utf8, which holds no numbers"]);
        assert_eq!((batches[0].rows, batches[0].numbers[2].get(0)), (1, None));
    }
}

#[test]
fn parquet_says_what_its_columns_hold() {
    let rows: Vec<Row> = vec![(7, None, Some(0.5), None), (8, Some(1), Some(-2.0), None), (9, None, None, None)];
    let bytes = stored(&record(&rows), Storage::Parquet);
    let mut findings = Findings::new("nodes");
    let reader = NodeReader::open_any(Box::new(Cursor::new(bytes)), &mut findings).expect("sound");
    let clearance = reader.statistics(Column::Clearance).expect("statistics");
    assert_eq!((clearance.least, clearance.greatest, clearance.nulls, clearance.rows), (-2.0, 0.5, 1, 3));
    let potential = reader.statistics(Column::Potential(Part::Slave)).expect("statistics");
    assert_eq!((potential.nulls, potential.rows), (3, 3));
    assert!(reader.statistics(Column::Area).is_none() && reader.statistics(Column::Interaction).is_none());
}

#[test]
fn a_file_that_is_cut_short_cannot_be_read() {
    let rows: Vec<Row> = (0..100).map(|node| (node, None, Some(0.5), None)).collect();
    for storage in [Storage::Parquet, Storage::ArrowFile] {
        let bytes = stored(&record(&rows), storage);
        for length in [8, bytes.len() / 2, bytes.len() - 1] {
            let mut findings = Findings::new("nodes");
            let opened = NodeReader::open_any(Box::new(Cursor::new(bytes[..length].to_vec())), &mut findings);
            assert_eq!(opened.expect_err("a part is no table").kind(), io::ErrorKind::InvalidData, "{storage:?}");
        }
    }
}

#[test]
fn extensions_tell_the_format() {
    for (name, format) in [
        ("a.csv", Some(TableFormat::Csv)),
        ("a.b.Parquet", Some(TableFormat::Parquet)),
        ("a.arrow", Some(TableFormat::Arrow)),
        ("a.ipc", Some(TableFormat::Arrow)),
        ("a.feather", Some(TableFormat::Arrow)),
        ("a.txt", None),
        ("parquet", None),
    ] {
        assert_eq!(TableFormat::of_extension(Path::new(name)), format, "{name}");
    }
}

/// A table of three rows, packed in a way.
fn packed(compression: Compression, version: WriterVersion) -> Vec<u8> {
    let clearance = Float64Array::from(vec![0.05, 0.25, 1.0]);
    let record = RecordBatch::try_from_iter([("clearance", Arc::new(clearance) as ArrayRef)]).expect("one column");
    let properties = WriterProperties::builder().set_compression(compression).set_writer_version(version).build();
    let mut bytes = Vec::new();
    let mut writer = ArrowWriter::try_new(&mut bytes, record.schema(), Some(properties)).expect("a vector takes all");
    writer.write(&record).expect("a vector takes all");
    writer.close().expect("a vector takes all");
    bytes
}

fn clearances(bytes: Vec<u8>) -> Result<Vec<Option<f64>>, String> {
    clearances_with(bytes, Vec::new())
}

/// The same, with columns of labels that are read as well.
fn clearances_with(bytes: Vec<u8>, labels: Vec<Column>) -> Result<Vec<Option<f64>>, String> {
    let mut findings = Findings::new("nodes");
    let mut reader =
        NodeReader::open_any(Box::new(Cursor::new(bytes)), &mut findings).map_err(|error| error.to_string())?;
    reader.select(&Selection { labels, numbers: vec![Column::Clearance] });
    let mut batch = Batch::default();
    reader.read_batch(&mut batch, &mut findings).map_err(|error| error.to_string())?;
    Ok((0..batch.rows).map(|row| batch.numbers[0].get(row)).collect())
}

#[test]
fn compressed_parquet_is_read_or_refused_by_the_name_of_its_codec() {
    let gzip = Compression::GZIP(GzipLevel::default());
    let zstd = Compression::ZSTD(ZstdLevel::default());
    for compression in
        [Compression::UNCOMPRESSED, Compression::SNAPPY, zstd, gzip, Compression::LZ4, Compression::LZ4_RAW]
    {
        for version in [WriterVersion::PARQUET_1_0, WriterVersion::PARQUET_2_0] {
            let read = clearances(packed(compression, version));
            assert_eq!(read, Ok(vec![Some(0.05), Some(0.25), Some(1.0)]), "{compression:?} {version:?}");
        }
    }
    // The codec of a column stands behind its name: 2 is gzip, 4 Brotli, 3 LZO, each in zigzag.
    let bytes = packed(gzip, WriterVersion::PARQUET_1_0);
    let footer = bytes.windows(11).rposition(|bytes| bytes == b"clearance\x15\x04").expect("the codec of the column");
    for (code, name) in [(4, "Brotli"), (3, "LZO")] {
        let mut bytes = bytes.clone();
        bytes[footer + 10] = 2 * code;
        let said = format!(
            "column `clearance` is compressed with {name}, which is not read; write the table with Zstandard, Snappy, gzip or LZ4, or without compression"
        );
        assert_eq!(clearances(bytes), Err(said));
    }
}

/// Statistics of long texts in the header of a page make it longer than any is read.
#[test]
fn headers_of_pages_have_a_greatest_length() {
    let labels = |length: usize| Arc::new(StringArray::from(vec!["a".repeat(length), "b".repeat(length)])) as ArrayRef;
    let written = |length: usize| {
        let clearances = Arc::new(Float64Array::from(vec![0.5, 0.25])) as ArrayRef;
        let columns = [("node", labels(length)), ("clearance", clearances)];
        let record = RecordBatch::try_from_iter(columns).expect("two columns");
        let properties = WriterProperties::builder()
            .set_statistics_enabled(EnabledStatistics::Page)
            .set_write_page_header_statistics(true)
            .set_statistics_truncate_length(None)
            .set_dictionary_enabled(false)
            .build();
        let mut bytes = Vec::new();
        let mut writer =
            ArrowWriter::try_new(&mut bytes, record.schema(), Some(properties)).expect("a vector takes all");
        writer.write(&record).expect("a vector takes all");
        writer.close().expect("a vector takes all");
        bytes
    };
    let labelled = |bytes| clearances_with(bytes, vec![Column::Node]);
    assert_eq!(labelled(written(100_000)), Ok(vec![Some(0.5), Some(0.25)]));
    let said = "it is no sound Parquet table (the header of a page is no header, or longer than 1048576 bytes: write the table without statistics of its pages)";
    assert_eq!(labelled(written(600_000)), Err(said.to_owned()));
}

/// Columns in groups in groups: those of a table are on their own.
#[test]
fn groups_of_columns_have_a_greatest_depth() {
    // The schema, a list: the root, then groups of one child each.
    let mut footer = vec![0x29, 0xFC, 70];
    footer.extend([0x55, 2, 0].repeat(70));
    footer.push(0);
    let length = u32::try_from(footer.len()).expect("a few bytes");
    let bytes = [b"PAR1".as_slice(), &footer, &length.to_le_bytes(), b"PAR1"].concat();
    let said = "it is no sound Parquet table (its columns lie in more than 64 groups in one another: write the columns by themselves)";
    assert_eq!(clearances(bytes), Err(said.to_owned()));
}

/// A page that says fewer bytes than gzip makes of it is not unpacked into memory.
#[test]
fn a_gzipped_page_comes_to_what_it_says() {
    let zeros = Float64Array::from(vec![0.0; 1 << 16]);
    let record = RecordBatch::try_from_iter([("clearance", Arc::new(zeros) as ArrayRef)]).expect("one column");
    let properties = WriterProperties::builder()
        .set_compression(Compression::GZIP(GzipLevel::default()))
        .set_dictionary_enabled(false)
        .build();
    let mut bytes = Vec::new();
    let mut writer = ArrowWriter::try_new(&mut bytes, record.schema(), Some(properties)).expect("a vector takes all");
    writer.write(&record).expect("a vector takes all");
    writer.close().expect("a vector takes all");
    // PageHeader: its kind, 0, then how many bytes it comes to, as seven bits a byte.
    assert_eq!(bytes[4..7], [0x15, 0, 0x15]);
    let last = (7..bytes.len()).find(|at| bytes[*at] & 0x80 == 0).expect("the last byte of a number");
    assert_ne!(bytes[last], 1);
    bytes[last] = 1;
    let error = clearances(bytes).expect_err("it comes to more");
    assert!(error.starts_with("it is no sound Parquet table (a page comes to more than the "), "{error}");
}
