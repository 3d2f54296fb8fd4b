//! What a row costs in each form of a table: the numbers that `inpact_evaluation::accuracy::cost` chooses by.
//!
//! Random tables with abscissae of their own in each group, random queries over the range and 5 % beyond either end, one thread, the least of several rounds.
//! Every form is measured in the same run on the same queries.
//! A resampled table of one axis is measured too, though no such form exists: to show why.

use std::hint::black_box;
use std::io::{self, Write};
use std::time::Instant;

use inpact_evaluation::accuracy::Approximation;
use inpact_evaluation::table::{PiecewiseTable, Tail};

use crate::random::Random;

/// Number of axes and abscissae of an axis.
const SHAPES: &[(usize, usize)] = &[
    (1, 4),
    (1, 16),
    (1, 32),
    (1, 100),
    (1, 1000),
    (2, 4),
    (2, 10),
    (2, 32),
    (2, 100),
    (3, 4),
    (3, 10),
    (3, 20),
    (4, 4),
    (4, 8),
];

/// Measures and writes the committed table of costs, then what a resampled table of one axis and a copy cost.
///
/// # Errors
/// What `out` says.
pub fn write(rows: usize, rounds: usize, out: &mut impl Write) -> io::Result<()> {
    let mut notes = Vec::new();
    writeln!(out, "const MEASURED: &[Measured] = &[")?;
    for &(axes, knots) in SHAPES {
        let table = random_table(axes, knots);
        let columns = random_columns(&table, rows);
        let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let mut values = vec![0.0; rows];
        let reference = fastest(rows.div_ceil(10), rounds.div_ceil(3), || {
            by_row(&columns, &mut values[..rows.div_ceil(10)], |first, others| table.reference_value_at(first, others));
        });
        let full =
            fastest(rows, rounds, || by_row(&columns, &mut values, |first, others| table.value_at(first, others)));
        let mut of = |made: Option<Approximation>| {
            made.map_or(f64::INFINITY, |made| fastest(rows, rounds, || made.values(&columns, &mut values)))
        };
        let slope = of(Approximation::slope(&table).ok());
        let single = of(Approximation::single(&table).ok());
        let of_single_columns = single_columns(&table, &columns, rounds);
        let cells = vec![if axes < 3 { 64 } else { 24 / (axes - 2) }; axes];
        let grid = of(Approximation::grid(&table, &cells).ok());
        writeln!(
            out,
            "    Measured {{ axes: {axes}, knots: {knots}, reference: {reference:.1}, full: {full:.2}, slope: {slope:.2}, single: {single:.2}, of_single_columns: {of_single_columns:.2}, grid: {} }},",
            if grid.is_finite() { format!("{grid:.2}") } else { "f64::INFINITY".to_owned() },
        )?;
        notes.push(note(&table, &columns, &mut values, rounds, axes, knots));
    }
    writeln!(out, "];")?;
    for note in notes {
        writeln!(out, "// {note}")?;
    }
    Ok(())
}

/// The f32 form from f32 columns to f32 values.
#[expect(clippy::cast_possible_truncation, reason = "f32 columns are what is measured")]
fn single_columns(table: &PiecewiseTable, columns: &[&[f64]], rounds: usize) -> f64 {
    let rows = columns[0].len();
    let singles: Vec<Vec<f32>> =
        columns.iter().map(|column| column.iter().map(|&value| value as f32).collect()).collect();
    let singles: Vec<&[f32]> = singles.iter().map(Vec::as_slice).collect();
    let mut values = vec![0.0_f32; rows];
    Approximation::single(table)
        .map_or(f64::INFINITY, |made| fastest(rows, rounds, || made.values_single(&singles, &mut values)))
}

/// What the committed table does not hold: a resampled table of one axis, and the copy of a column.
fn note(
    table: &PiecewiseTable,
    columns: &[&[f64]],
    values: &mut [f64],
    rounds: usize,
    axes: usize,
    knots: usize,
) -> String {
    let rows = values.len();
    let copy = fastest(rows, rounds, || values.copy_from_slice(columns[0]));
    let mut note = format!("{axes} axes, {knots} knots: copy of an f64 column {copy:.2}");
    if axes == 1 {
        for cells in [1024, 65536] {
            let resampled = Resampled::new(table, cells);
            let cost = fastest(rows, rounds, || {
                for (value, &x) in values.iter_mut().zip(columns[0]) {
                    *value = resampled.value(x);
                }
            });
            let worst = columns[0].iter().map(|&x| (resampled.value(x) - table.value(&[x])).abs()).fold(0.0, f64::max);
            note += &format!(", resampled to {cells} cells {cost:.2} with an error of {worst:.1e}");
        }
    }
    note
}

/// A table of one axis resampled on a regular grid, as no form of a table is.
struct Resampled {
    least: f64,
    greatest: f64,
    scale: f64,
    nodes: Vec<f64>,
}

impl Resampled {
    fn new(table: &PiecewiseTable, cells: usize) -> Self {
        let axis = table.axes()[0];
        let width = axis.greatest - axis.least;
        let nodes =
            (0..=cells + 1).map(|node| table.value(&[axis.least + width * node as f64 / cells as f64])).collect();
        Self { least: axis.least, greatest: axis.greatest, scale: cells as f64 / width, nodes }
    }

    #[inline]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the range of the grid")]
    fn value(&self, x: f64) -> f64 {
        let place = (x.clamp(self.least, self.greatest) - self.least) * self.scale;
        let cell = place as usize;
        let (a, b) = (self.nodes[cell], self.nodes[cell + 1]);
        a + (place - cell as f64) * (b - a)
    }
}

/// The nanoseconds of a row in the fastest of `rounds` runs of `work` over `rows` rows.
fn fastest(rows: usize, rounds: usize, mut work: impl FnMut()) -> f64 {
    (0..rounds)
        .map(|_| {
            let start = Instant::now();
            work();
            black_box(());
            start.elapsed().as_secs_f64() * 1e9 / rows as f64
        })
        .fold(f64::INFINITY, f64::min)
}

/// Evaluates row by row.
fn by_row(columns: &[&[f64]], values: &mut [f64], of: impl Fn(f64, &[f64]) -> f64) {
    let mut others = vec![0.0; columns.len() - 1];
    for (row, value) in values.iter_mut().enumerate() {
        for (other, column) in others.iter_mut().zip(&columns[1..]) {
            *other = column[row];
        }
        *value = of(columns[0][row], &others);
    }
}

/// A table with `knots` abscissae on each axis, unevenly spaced and different in each group.
fn random_table(axes: usize, knots: usize) -> PiecewiseTable {
    let mut random = Random::new(1);
    let mut cells = Vec::new();
    add_groups(&mut random, axes, knots, &mut vec![0.0; axes], &mut cells);
    PiecewiseTable::from_rows(&cells, axes + 1, Tail::Constant)
        .unwrap_or_else(|error| unreachable!("the rows rise: {error}"))
}

fn add_groups(random: &mut Random, axis: usize, knots: usize, abscissae: &mut Vec<f64>, cells: &mut Vec<f64>) {
    if axis == 0 {
        cells.push(random.between(1.0, 10.0));
        cells.extend_from_slice(abscissae);
        return;
    }
    for knot in 0..knots {
        abscissae[axis - 1] = knot as f64 + random.between(0.0, 0.8);
        add_groups(random, axis - 1, knots, abscissae, cells);
    }
}

/// Random queries, 5 % of them beyond either end of an axis.
fn random_columns(table: &PiecewiseTable, rows: usize) -> Vec<Vec<f64>> {
    let mut random = Random::new(2);
    let of_axis = |axis: &inpact_evaluation::table::AxisSummary| {
        let margin = 0.05 * (axis.greatest - axis.least);
        (0..rows).map(|_| random.between(axis.least - margin, axis.greatest + margin)).collect()
    };
    table.axes().iter().map(of_axis).collect()
}
