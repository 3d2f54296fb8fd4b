//! Times of the kernels beside a memory copy of the same columns, the scalar functions, other crates and numpy, in one run.
//!
//! `cargo bench -p inpact-bench --bench kernels`; `-- 1000000 10000000` are the rows, `-- --rounds 7` how often all are timed in turn.
//! Every figure is the least of its rounds, which take turns so that a busy moment of the machine hits all alike.
//! The first line times a chain of additions: where it says much more than four cycles of the processor, the machine was not giving its full speed.

#![allow(clippy::print_stdout, reason = "a benchmark prints")]

mod peers;
mod tables;

use std::hint::black_box;
use std::time::Instant;

use inpact_evaluation::law::{ElectricalInputs, ElectricalOutputs, HeatGeneration, electrical_outputs};
use inpact_evaluation::table::{Grid, InstructionSet, TableKernel};
use tables::Case;

/// Something that is timed: what it is and one run of it over all rows.
pub(crate) struct Contender<'a> {
    name: String,
    run: Box<dyn FnMut() + 'a>,
}

impl<'a> Contender<'a> {
    pub(crate) fn new(name: impl Into<String>, run: impl FnMut() + 'a) -> Self {
        Self { name: name.into(), run: Box::new(run) }
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let after = |option: &str| arguments.iter().position(|word| word == option).and_then(|at| arguments.get(at + 1));
    let rounds = after("--rounds").and_then(|rounds| rounds.parse().ok()).unwrap_or(7);
    let mut sizes: Vec<usize> =
        arguments.iter().filter_map(|word| word.parse().ok()).filter(|&rows| rows > 1000).collect();
    if sizes.is_empty() {
        sizes = vec![1_000_000, 10_000_000];
    }
    println!("a chain of additions: {:.2} ns each", addition_chain());
    println!("instruction sets: {:?}", InstructionSet::available());
    for rows in sizes {
        for case in tables::cases(rows) {
            time_case(&case, rounds);
        }
        time_electrical(rows, rounds);
    }
    println!("a chain of additions: {:.2} ns each", addition_chain());
}

/// One table: the copy, the kernels, the scalar function and the peers.
fn time_case(case: &Case, rounds: usize) {
    let rows = case.columns[0].len();
    let columns: Vec<&[f64]> = case.columns.iter().map(Vec::as_slice).collect();
    let columns = &columns[..];
    let kernel = TableKernel::new(&case.table);
    let kernel = &kernel;
    let mut contenders = vec![copy_of(columns)];
    for set in InstructionSet::available() {
        let mut values = vec![0.0; rows];
        contenders.push(Contender::new(format!("kernel, {set}"), move || {
            kernel.values_with(set, columns, black_box(&mut values));
        }));
    }
    let cells = vec![if columns.len() < 3 { 64 } else { 24 }; columns.len()];
    contenders.extend(Grid::new(&case.table, &cells).ok().map(|grid| {
        let mut values = vec![0.0; rows];
        Contender::new("grid", move || grid.values(columns, black_box(&mut values)))
    }));
    let mut values = vec![0.0; rows];
    contenders.push(Contender::new("scalar function", move || {
        for (row, value) in black_box(&mut values).iter_mut().enumerate() {
            let mut point = [0.0; 3];
            point.iter_mut().zip(columns).for_each(|(x, column)| *x = column[row]);
            *value = case.table.value(&point[..columns.len()]);
        }
    }));
    contenders.extend(peers::of(case));
    println!("\n## {}, {rows} rows, search: {:?}", case.name, kernel.search());
    let copy = print_times(rows, rounds, contenders);
    peers::time_python(case, rounds, copy);
}

/// The whole electrical output set from a table of ten points, against a copy of its columns.
fn time_electrical(rows: usize, rounds: usize) {
    let case = &tables::cases(rows)[1];
    let kernel = &TableKernel::new(&case.table);
    let clearance = &case.columns[0];
    let jump: &Vec<f64> = &(0..rows).map(|row| 1e-3 * (row % 1000) as f64 + 0.1).collect();
    let area: &Vec<f64> = &(0..rows).map(|row| 1.0 + 1e-3 * (row % 77) as f64).collect();
    let mut from = [clearance, jump, area, jump, clearance, jump, area];
    let mut copies = vec![vec![0.0; rows]; 7];
    // Three columns are read and seven written: a copy reads and writes seven.
    let copy = Contender::new("copy of 7 columns", move || {
        for (copy, column) in black_box(&mut copies).iter_mut().zip(black_box(&mut from)) {
            copy.copy_from_slice(column);
        }
    });
    let mut contenders = vec![copy];
    for set in InstructionSet::available() {
        let mut columns = vec![vec![0.0; rows]; 7];
        contenders.push(Contender::new(format!("all electrical outputs, {set}"), move || {
            let [conductance, j, i, q, qa, slave, master] = black_box(&mut columns[..]) else { return };
            let mut outputs = ElectricalOutputs {
                current_density: Some(j),
                current: Some(i),
                heat: Some(q),
                heat_of_area: Some(qa),
                heat_slave: Some(slave),
                heat_master: Some(master),
            };
            let inputs = ElectricalInputs { jump, jump_at_start: None, area: Some(area) };
            let generation = HeatGeneration::default();
            kernel.values_with(set, &[clearance], conductance);
            electrical_outputs(set, generation, conductance, &inputs, &mut outputs);
        }));
    }
    println!("\n## Electrical outputs with conductance, {}, {rows} rows", case.name);
    print_times(rows, rounds, contenders);
}

/// A copy of a column: what reading and writing eight bytes a row costs, for each column.
fn copy_of<'a>(columns: &[&'a [f64]]) -> Contender<'a> {
    let columns = columns.to_vec();
    let mut copies: Vec<Vec<f64>> = columns.iter().map(|column| vec![0.0; column.len()]).collect();
    Contender::new("memory copy", move || {
        for (copy, column) in black_box(&mut copies).iter_mut().zip(&columns) {
            copy.copy_from_slice(column);
        }
    })
}

/// Times the contenders in turn and prints each one's best and its ratio to the first; gives the first one's time in nanoseconds a row.
fn print_times(rows: usize, rounds: usize, mut contenders: Vec<Contender<'_>>) -> f64 {
    let mut best = vec![f64::INFINITY; contenders.len()];
    for _ in 0..=rounds {
        for (contender, best) in contenders.iter_mut().zip(&mut best) {
            let start = Instant::now();
            (contender.run)();
            *best = best.min(start.elapsed().as_secs_f64() * 1e9 / rows as f64);
        }
    }
    println!("| | ns a row | times the copy |\n|---|---:|---:|");
    for (contender, time) in contenders.iter().zip(&best) {
        println!("| {} | {time:.2} | {:.2} |", contender.name, time / best[0]);
    }
    best[0]
}

/// Nanoseconds of an addition that waits for the one before.
fn addition_chain() -> f64 {
    let count = 10_000_000;
    let start = Instant::now();
    let mut sum = 1.0;
    for _ in 0..count {
        sum += black_box(1e-9);
    }
    black_box(sum);
    start.elapsed().as_secs_f64() * 1e9 / f64::from(count)
}
