//! Record batches in memory to record batches in memory through the front door, on one thread, beside a copy of the same columns.
//!
//! `cargo bench -p inpact-bench --bench facade -- [ROWS] [--rounds N]` prints lines of a table of Markdown: ns a row, the least of all rounds.

use inpact::arrow::array::{Array, ArrayRef, AsArray, Float32Array, Float64Array, Int64Array, RecordBatch};
use inpact::arrow::datatypes::{DataType, Float64Type};
use inpact::arrow::error::ArrowError;
use inpact::{Deck, EvaluateOptions, ReadOptions};
use std::error::Error;
use std::hint::black_box;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

const DECK: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP ELECTRICAL CONDUCTANCE
5e6, 0.
4e6, 2e-6
3e6, 4e-6
2e6, 6e-6
1e6, 8e-6
5e5, 1e-5
1e5, 1.2e-5
0., 1.4e-5
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
5e6, 0.
5e7, 5e7
1e8, 1e8
1.5e8, 1.4e8
2e8, 2e8
*STEP
*COUPLED THERMAL-ELECTRICAL, STEADY STATE
*END STEP
";

/// Rows of a record batch, as many as a reader of Parquet gives at a time.
const ROWS_OF_A_BATCH: usize = 8192;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let number = |text: Option<&String>, default| text.map_or(Ok(default), |text| text.parse::<usize>());
    let rounds_at = arguments.iter().position(|argument| argument == "--rounds");
    let rounds = number(rounds_at.and_then(|at| arguments.get(at + 1)), 10)?;
    let rows = number(arguments.first().filter(|_| rounds_at != Some(0)), 1_000_000)?;

    let deck = Deck::parse("joint.inp", DECK, &ReadOptions::new().isolated())?;
    let in_f64 = batches(rows, |values| Arc::new(Float64Array::from(values)))?;
    let in_f32 = batches(rows, singles)?;
    let mut results = Vec::new();
    evaluate(&deck, &in_f64, |batch| results.push(batch))?;
    let mut best = [f64::INFINITY; 3];
    for _ in 0..rounds {
        let mut contenders: [&mut dyn FnMut() -> Result<(), Box<dyn Error>>; 3] = [
            &mut || {
                in_f64.iter().chain(&results).for_each(copy);
                Ok(())
            },
            &mut || evaluate(&deck, &in_f64, |batch| drop(black_box(batch))),
            &mut || evaluate(&deck, &in_f32, |batch| drop(black_box(batch))),
        ];
        for (contender, best) in contenders.iter_mut().zip(&mut best) {
            let start = Instant::now();
            contender()?;
            *best = best.min(start.elapsed().as_secs_f64());
        }
    }
    let mut out = io::stdout();
    let columns = in_f64[0].num_columns() + results[0].num_columns();
    let names = [
        format!("copy of {columns} columns in and out"),
        "all electrical outputs from f64 columns".to_owned(),
        "all electrical outputs from f32 columns".to_owned(),
    ];
    writeln!(out, "| | ns a row | times the copy |\n|---|---:|---:|")?;
    for (name, time) in names.iter().zip(best) {
        writeln!(out, "| {name} | {:.1} | {:.2} |", time * 1e9 / rows as f64, time / best[0])?;
    }
    Ok(())
}

/// Evaluates the batches; results are taken one at a time and dropped, as copies are.
fn evaluate(
    deck: &Deck,
    batches: &[RecordBatch],
    mut take: impl FnMut(RecordBatch) + Send,
) -> Result<(), Box<dyn Error>> {
    let options = EvaluateOptions::new().threads(1);
    let rows = batches.iter().map(|batch| Ok::<_, ArrowError>(batch.clone())).collect::<Vec<_>>();
    deck.evaluate_to(batches[0].schema(), rows, &options, |_, batch| {
        take(batch);
        ControlFlow::Continue(())
    })?;
    Ok(())
}

#[expect(clippy::cast_possible_truncation, reason = "columns of half the size are what is measured")]
fn singles(values: Vec<f64>) -> ArrayRef {
    Arc::new(values.into_iter().map(|value| Some(value as f32)).collect::<Float32Array>())
}

/// Copies the columns of numbers into memory of their own, as new columns are.
fn copy(batch: &RecordBatch) {
    for column in batch.columns().iter().filter(|column| *column.data_type() == DataType::Float64) {
        black_box(column.as_primitive::<Float64Type>().values().to_vec());
    }
}

/// Rows half of which are closed, none of them like its neighbour.
fn batches(rows: usize, numbers: impl Fn(Vec<f64>) -> ArrayRef) -> Result<Vec<RecordBatch>, ArrowError> {
    let mut state = 1_u64;
    let mut chance = || {
        state = state.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut one = |first: usize| {
        let count = ROWS_OF_A_BATCH.min(rows - first);
        let gaps: Vec<f64> = (0..count).map(|_| chance() - 0.5).collect();
        let mut column = |least: f64, reach: f64| numbers((0..count).map(|_| least + reach * chance()).collect());
        let nodes = (1_i64..).skip(first).take(count).collect::<Int64Array>();
        RecordBatch::try_from_iter([
            ("node", Arc::new(nodes) as ArrayRef),
            ("clearance", numbers(gaps.iter().map(|gap| gap.max(0.0) * 2.4e-5).collect())),
            ("pressure", numbers(gaps.iter().map(|gap| (-gap).max(0.0) * 4e8).collect())),
            ("epot_s", column(1.0, 0.5)),
            ("epot_m", column(0.5, 0.5)),
            ("area", column(0.0, 1e-6)),
        ])
    };
    (0..rows).step_by(ROWS_OF_A_BATCH).map(&mut one).collect()
}
