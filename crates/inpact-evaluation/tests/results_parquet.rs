//! Results in Parquet read back bit for bit, and their statistics are those that the library gives the same columns.

#![cfg(feature = "columnar")]

use inpact_evaluation::arrow::array::{Array, AsArray, RecordBatch};
use inpact_evaluation::arrow::datatypes::Float64Type;
use inpact_evaluation::nodes::{Batch, NumberColumn};
use inpact_evaluation::results::{Output, ResultBatch, ResultWriter, Status, TableFormat};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::ParquetMetaData;
use parquet::file::statistics::Statistics;

/// Numbers that are hard on statistics, in runs of each kind.
fn number(kind: usize, row: usize) -> Option<f64> {
    let some = ((row * row) % 1009) as f64 - 500.0;
    match kind {
        0 => Some(some),
        1 => (row % 7 != 3).then_some(some),
        2 => None,
        3 => Some([0.0, -0.0][row % 2]),
        4 => Some([f64::NAN, some, f64::INFINITY, f64::NEG_INFINITY][row % 4]),
        5 => Some(f64::NAN),
        _ => [None, Some(-0.0), Some(f64::NAN), Some(1e-300)][row % 4],
    }
}

fn status(kind: usize, row: usize) -> Option<Status> {
    match kind {
        0 => Some(Status::ALL[(row * row / 3) % Status::ALL.len()]),
        1 => Some(Status::Closed),
        2 => None,
        _ => [None, Some(Status::Open), Some(Status::BeyondTable)][row % 3],
    }
}

/// Both columns of a kind in batches of so many rows, as a file.
fn written(kinds: (usize, usize), rows: usize, rows_of_a_batch: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = ResultWriter::with_format(&mut bytes, TableFormat::Parquet, &[], &[Output::Ecd, Output::Status])
        .expect("sound");
    for first in (0..rows).step_by(rows_of_a_batch) {
        let of_batch = first..rows.min(first + rows_of_a_batch);
        let mut numbers = NumberColumn::default();
        of_batch.clone().for_each(|row| numbers.push(number(kinds.0, row)));
        let status = of_batch.clone().map(|row| status(kinds.1, row)).collect();
        let batch = Batch { rows: of_batch.len(), first_row: first as u64, ..Batch::default() };
        let results = ResultBatch { numbers: vec![numbers], status, ..ResultBatch::default() };
        writer.write(&batch, &results).expect("a vector takes all");
    }
    writer.finish().expect("a vector takes all");
    bytes
}

fn read(bytes: &[u8]) -> (Vec<RecordBatch>, ParquetMetaData) {
    let reader = ParquetRecordBatchReaderBuilder::try_new(bytes::Bytes::from(bytes.to_vec())).expect("sound");
    let metadata = reader.metadata().as_ref().clone();
    (reader.build().expect("sound").map(|batch| batch.expect("sound")).collect(), metadata)
}

/// Smallest and largest number by their bits, and how many are missing.
fn statistics(metadata: &ParquetMetaData, group: usize) -> (Option<[u64; 2]>, Option<u64>) {
    let Some(Statistics::Double(of)) = metadata.row_group(group).column(0).statistics() else { panic!("of floats") };
    let range = of.min_opt().zip(of.max_opt()).map(|(least, greatest)| [least.to_bits(), greatest.to_bits()]);
    (range, of.null_count_opt())
}

#[test]
fn results_are_read_back_and_have_the_statistics_of_the_library() {
    let kinds = (0..7).map(|kind| (kind, kind % 4)).chain([(0, 0), (1, 3)]);
    for ((numbers, statuses), (rows, of_batch)) in
        kinds.flat_map(|kinds| [(1, 1), (700, 64), (40_000, 40_000)].map(|sizes| (kinds, sizes)))
    {
        let (batches, metadata) = read(&written((numbers, statuses), rows, of_batch));
        let of_rows: Vec<(Option<u64>, Option<String>)> = batches
            .iter()
            .flat_map(|batch| {
                let (values, words) =
                    (batch.column(0).as_primitive::<Float64Type>(), batch.column(1).as_string::<i32>());
                let cell = |row: usize| values.is_valid(row).then(|| values.value(row).to_bits());
                let word = |row: usize| words.is_valid(row).then(|| words.value(row).to_owned());
                (0..batch.num_rows()).map(|row| (cell(row), word(row))).collect::<Vec<_>>()
            })
            .collect();
        let expected: Vec<(Option<u64>, Option<String>)> = (0..rows)
            .map(|row| {
                let word = status(statuses, row).map(|status| status.word().to_owned());
                (number(numbers, row).map(f64::to_bits), word)
            })
            .collect();
        assert_eq!(of_rows, expected, "kinds {numbers} and {statuses}, {rows} rows");
        // The library's own writer on the same columns.
        let mut bytes = Vec::new();
        let mut writer = ArrowWriter::try_new(&mut bytes, batches[0].schema(), None).expect("sound");
        for batch in &batches {
            writer.write(batch).expect("a vector takes all");
        }
        writer.close().expect("a vector takes all");
        assert_eq!(statistics(&metadata, 0), statistics(&read(&bytes).1, 0), "kind {numbers}, {rows} rows");
        assert_eq!(metadata.file_metadata().num_rows(), i64::try_from(rows).expect("few"));
    }
}

/// A row group ends within a batch, and the next begins anew.
#[test]
fn row_groups_follow_one_another() {
    let rows = (1 << 18) + 5000;
    let (batches, metadata) = read(&written((1, 0), rows, 60_000));
    assert_eq!(metadata.num_row_groups(), 2);
    let found =
        batches.iter().flat_map(|batch| batch.column(0).as_primitive::<Float64Type>().iter().collect::<Vec<_>>());
    assert!(found.eq((0..rows).map(|row| number(1, row))));
    let words = batches.iter().flat_map(|batch| batch.column(1).as_string::<i32>().iter().collect::<Vec<_>>());
    assert!(words.eq((0..rows).map(|row| status(0, row).map(Status::word))));
    let missing = (1 << 18..rows).filter(|row| number(1, *row).is_none()).count() as u64;
    assert_eq!(statistics(&metadata, 1).1, Some(missing));
}
