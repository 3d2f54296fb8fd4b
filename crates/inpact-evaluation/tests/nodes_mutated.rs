//! Node tables with bytes changed at random: whatever a file says, reading it ends with rows or with an error; never with a panic,
//! an abort, or more memory than 512 MiB.
//!
//! The seeds are fixed. A long run, whose figures go into `docs/reliability.md`:
//! `INPACT_TABLES=20000 cargo test -p inpact-evaluation --test nodes_mutated`.

#![cfg(feature = "columnar")]

use inpact_evaluation::arrow::array::{
    ArrayRef, BooleanArray, DictionaryArray, Float32Array, Float64Array, Int64Array, PrimitiveArray, RecordBatch,
    StringArray, StringViewArray,
};
use inpact_evaluation::arrow::datatypes::{Float64Type, Int16Type, Int32Type};
use inpact_evaluation::arrow::ipc::CompressionType;
use inpact_evaluation::arrow::ipc::writer::{FileWriter, IpcWriteOptions, StreamWriter};
use inpact_evaluation::nodes::{Batch, Column, Findings, NodeReader, Part, Selection};
use parquet::arrow::ArrowWriter;
use parquet::basic::Compression;
use parquet::file::properties::{WriterProperties, WriterVersion};
use std::fmt::Write;
use std::io::{Cursor, ErrorKind};
use std::path::Path;
use std::sync::Arc;

#[path = "../../../tests/attack/page.rs"]
#[expect(unreachable_pub, reason = "the same file belongs to the suites of attacks")]
mod page;

/// The rows of every sample.
const ROWS: usize = 40;

/// The most memory, in bytes, that the process may have had.
const MAX_MEMORY: u64 = 512 << 20;

/// Pseudo-random numbers (xorshift64*).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 16;
        usize::try_from(bits).expect("48 bits") % end.max(1)
    }
}

fn record() -> RecordBatch {
    let numbers = 0..ROWS;
    let texts: DictionaryArray<Int32Type> = numbers.clone().map(|row| Some(["GAP", "LAP", "TAPE"][row % 3])).collect();
    let areas = Float64Array::from(vec![0.5, 0.25, 2.0]);
    let keys: PrimitiveArray<Int16Type> = numbers.clone().map(|row| i16::try_from(row % 3).ok()).collect();
    let areas = DictionaryArray::<Int16Type>::try_new(keys, Arc::new(areas)).expect("keys of the values");
    let clearance = numbers.clone().map(|row| (row % 7 != 3).then_some(row as f64 * 0.125));
    let columns: [(&str, ArrayRef); 7] = [
        (
            "node",
            Arc::new(numbers.clone().map(|row| Some(i64::try_from(row).expect("few rows"))).collect::<Int64Array>()),
        ),
        ("interaction", Arc::new(texts)),
        ("comment", Arc::new(StringArray::from_iter_values(numbers.clone().map(|row| format!("row {row}"))))),
        ("copen", Arc::new(clearance.collect::<PrimitiveArray<Float64Type>>())),
        ("temp_s", Arc::new(numbers.clone().map(|row| Some(300.0 + row as f32)).collect::<Float32Array>())),
        ("closed", Arc::new(numbers.map(|row| Some(row % 2 == 0)).collect::<BooleanArray>())),
        ("area", Arc::new(areas)),
    ];
    RecordBatch::try_from_iter_with_nullable(columns.map(|(name, array)| (name, array, true))).expect("of one length")
}

/// The same with labels of texts, short and long.
fn record_of_texts() -> RecordBatch {
    let text = |row: usize| format!("node {row}{}", " of a part with a long name".repeat(row % 2));
    let nodes = StringArray::from_iter_values((0..ROWS).map(text));
    let interactions = StringViewArray::from_iter_values((0..ROWS).map(text));
    let columns: [(&str, ArrayRef); 3] = [
        ("node", Arc::new(nodes)),
        ("interaction", Arc::new(interactions)),
        ("copen", Arc::new((0..ROWS).map(|row| Some(row as f64)).collect::<Float64Array>())),
    ];
    RecordBatch::try_from_iter_with_nullable(columns.map(|(name, array)| (name, array, true))).expect("of one length")
}

fn parquet(record: &RecordBatch, compression: Compression, version: WriterVersion) -> Vec<u8> {
    let mut bytes = Vec::new();
    let properties = WriterProperties::builder()
        .set_compression(compression)
        .set_writer_version(version)
        // The second version writes texts by their lengths, where no dictionary stands for them.
        .set_dictionary_enabled(version == WriterVersion::PARQUET_1_0)
        .set_max_row_group_row_count(Some(ROWS / 2));
    let mut writer = ArrowWriter::try_new(&mut bytes, record.schema(), Some(properties.build())).expect("a vector");
    writer.write(record).expect("a vector takes all");
    writer.close().expect("a vector takes all");
    bytes
}

fn arrow(record: &RecordBatch, compression: Option<CompressionType>, is_file: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    let options = IpcWriteOptions::default().try_with_compression(compression).expect("built in");
    let halves = [record.slice(0, ROWS / 2), record.slice(ROWS / 2, ROWS / 2)];
    if is_file {
        let mut writer = FileWriter::try_new_with_options(&mut bytes, &record.schema(), options).expect("a vector");
        for half in &halves {
            writer.write(half).expect("a vector takes all");
        }
        writer.finish().expect("a vector takes all");
    } else {
        let mut writer = StreamWriter::try_new_with_options(&mut bytes, &record.schema(), options).expect("a vector");
        for half in &halves {
            writer.write(half).expect("a vector takes all");
        }
        writer.finish().expect("a vector takes all");
    }
    bytes
}

/// Sound tables in every way that they can be stored, by name.
fn samples() -> Vec<(String, Vec<u8>)> {
    let mut samples = Vec::new();
    for (what, record) in [("numbers", record()), ("texts", record_of_texts())] {
        let zstd = Compression::ZSTD(parquet::basic::ZstdLevel::default());
        let gzip = Compression::GZIP(parquet::basic::GzipLevel::default());
        let lz4 = [Compression::LZ4, Compression::LZ4_RAW];
        for compression in [Compression::UNCOMPRESSED, Compression::SNAPPY, zstd, gzip, lz4[0], lz4[1]] {
            for version in [WriterVersion::PARQUET_1_0, WriterVersion::PARQUET_2_0] {
                let name = format!("Parquet {compression:?} {version:?} of {what}");
                samples.push((name, parquet(&record, compression, version)));
            }
        }
        for compression in [None, Some(CompressionType::LZ4_FRAME), Some(CompressionType::ZSTD)] {
            for (kind, is_file) in [("file", true), ("stream", false)] {
                samples.push((format!("Arrow {kind} {compression:?} of {what}"), arrow(&record, compression, is_file)));
            }
        }
    }
    let rows: String = (0..ROWS).map(|row| format!("{row},\"GAP, {row}\",0.{row},300,1,1\n")).collect();
    samples.push(("CSV".to_owned(), format!("node,interaction,copen,temp_s,closed,area\n{rows}").into_bytes()));
    samples
}

/// A copy with one to eight changes, more of them at the ends, where a file says how it is built.
fn mutated(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.below(8) {
        let length = bytes.len();
        let at = match random.below(4) {
            0 => random.below(length.min(400)),
            1 => length - 1 - random.below(length.min(800)),
            _ => random.below(length),
        };
        let end = |count: usize| (at + count).min(length);
        match random.below(8) {
            0 | 1 => bytes[at] ^= 1 << random.below(8),
            2 => bytes[at] = [0, 1, 0x7F, 0x80, 0xFF][random.below(5)],
            3 => {
                let extreme = [u64::MAX, 1 << 31, 0x7FFF_FFFF, 1 << 63, 0, 1 << 40][random.below(6)].to_le_bytes();
                let count = [2, 4, 8][random.below(3)];
                bytes[at..end(count)].copy_from_slice(&extreme[..end(count) - at]);
            }
            4 => drop(bytes.drain(at..end(1 + random.below(16)))),
            5 => bytes.truncate(at.max(8)),
            6 => {
                let from = random.below(length);
                let piece = bytes[from..(from + 1 + random.below(64)).min(length)].to_vec();
                bytes.splice(at..at, piece);
            }
            _ => {
                // The compact numbers of Parquet go on while the highest bit is set.
                let many = [0xFF, 0xFF, 0xFF, 0xFF, 0x0F];
                bytes[at..end(5)].copy_from_slice(&many[..end(5) - at]);
            }
        }
        if bytes.len() < 16 {
            break;
        }
    }
    bytes
}

/// Reads all of a table as an evaluation would; gives the rows, or the kind of the error.
fn read(bytes: Vec<u8>) -> Result<u64, ErrorKind> {
    let mut findings = Findings::new("mutated");
    let mut reader = NodeReader::open_any(Box::new(Cursor::new(bytes)), &mut findings).map_err(|error| error.kind())?;
    reader.select(&Selection {
        labels: vec![Column::Node, Column::Interaction],
        numbers: vec![Column::Clearance, Column::Temperature(Part::Slave), Column::Closed, Column::Area],
    });
    let _ = reader.statistics(Column::Clearance);
    let mut batch = Batch::default();
    let mut rows = 0;
    while rows < 1_000_000 && reader.read_batch(&mut batch, &mut findings).map_err(|error| error.kind())? {
        for row in 0..batch.rows {
            let labels = batch.labels.iter().map(|labels| labels.get(row).len()).sum::<usize>();
            assert!(labels < usize::MAX && batch.numbers.len() == 4);
        }
        rows += batch.rows as u64;
    }
    Ok(rows)
}

/// The most memory the process has had, in bytes, where the system says it.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()? * 1024)
}

#[test]
fn samples_are_read_as_they_are() {
    for (name, bytes) in samples() {
        assert_eq!(read(bytes), Ok(ROWS as u64), "{name}");
    }
}

#[test]
fn mutated_tables_give_rows_or_an_error() {
    let chosen = std::env::var("INPACT_TABLES").ok().map(|count| count.parse().expect("how many tables"));
    let count: usize = chosen.unwrap_or(3000);
    let mut random = Random(20_261_129);
    let samples = samples();
    let (mut whole, mut unsound) = (0, 0);
    for number in 0..count {
        let (name, bytes) = &samples[number % samples.len()];
        match read(mutated(bytes, &mut random)) {
            Ok(_) => whole += 1,
            // What it says is not true, or is what this program was not built to read.
            Err(ErrorKind::InvalidData) => unsound += 1,
            Err(other) => panic!("table {number}, {name}: {other}"),
        }
    }
    assert!(count / 20 < whole && count / 20 < unsound, "{whole} were read, {unsound} refused");
    let peak = peak_memory();
    assert!(peak.is_none_or(|peak| peak < MAX_MEMORY), "{peak:?} bytes");
    if chosen.is_some() {
        record_figures(count, &samples, (whole, unsound), peak);
    }
}

/// Writes the figures of a long run into their section of `docs/reliability.md`.
fn record_figures(count: usize, samples: &[(String, Vec<u8>)], (whole, unsound): (usize, usize), peak: Option<u64>) {
    let mut section = format!(
        "## Mutated node tables\n\n\
         `INPACT_TABLES={count} cargo test -p inpact-evaluation --test nodes_mutated`\n\n\
         {} sound tables (Parquet of both versions, Arrow files and streams, each with every compression; CSV) are changed at random, \
         in one to eight places each, and read to the end in one process.\n\
         A run with a panic that comes out, or an abort, stops at it, and writes nothing here.\n\n| | |\n|---|---|\n",
        samples.len()
    );
    let peak = peak.map_or("not known".to_owned(), |peak| format!("{} MiB", peak >> 20));
    let rows: [(&str, String); 6] = [
        ("tables", count.to_string()),
        ("read to the end", whole.to_string()),
        ("refused as unsound", unsound.to_string()),
        ("panics that came out", "0".to_owned()),
        ("aborts", "0".to_owned()),
        ("most memory of the process, 512 MiB allowed", peak),
    ];
    for (what, figure) in rows {
        writeln!(section, "| {what} | {figure} |").expect("a string takes all");
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reliability.md");
    page::write_section(&path, "tables", &section).expect("written");
}
