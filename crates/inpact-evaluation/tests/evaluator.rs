//! Tables as they are evaluated: whatever the method, the same rows lie outside, and the values are those of the mode.

mod table_judge;

use inpact_evaluation::table::{Evaluator, SeenError, TableValues};
use inpact_evaluation::{Accuracy, Tolerance, Wanted};
use table_judge::random_tables::{Range, compile, random_ending, random_point, random_rows};
use table_judge::{Random, Rows, cases};

const WANTED: [Wanted; 5] = [
    Wanted::Mode(Accuracy::Reference),
    Wanted::Mode(Accuracy::Full),
    Wanted::Mode(Accuracy::Fast),
    Wanted::Within(Tolerance::RelativeToLargest(1e-2)),
    Wanted::Within(Tolerance::Pointwise(1e-9)),
];

/// Points of a table, column by column, NaN and infinities among them.
fn random_columns(random: &mut Random, rows: &Rows, axes: usize, count: usize) -> Vec<Vec<f64>> {
    let mut columns = vec![Vec::new(); axes];
    for _ in 0..count {
        let point = random_point(random, rows);
        for (column, x) in columns.iter_mut().zip(point) {
            column.push(match random.below(20) {
                0 => f64::NAN,
                1 => f64::INFINITY,
                2 => f64::NEG_INFINITY,
                _ => x,
            });
        }
    }
    columns
}

/// Rows on a grid: the groups of each axis have one range.
fn regular_rows(random: &mut Random, axes: usize) -> Rows {
    let counts: Vec<usize> = (0..axes).map(|_| 2 + random.below(3)).collect();
    let mut rows = Rows::new();
    for index in 0..counts.iter().product() {
        let mut row = vec![1.0 + random.unit()];
        let mut rest = index;
        for count in &counts {
            row.push((rest % count) as f64 * 10.0);
            rest /= count;
        }
        rows.push(row);
    }
    rows
}

#[test]
fn the_same_rows_lie_outside_in_every_form() {
    let mut random = Random::new(0xf0a5);
    for round in 0..cases(150) {
        let axes = 1 + round % 3;
        let range = if round % 2 == 0 { Range::Ordinary } else { Range::AllDecades };
        let rows = if round % 5 == 0 { regular_rows(&mut random, axes) } else { random_rows(&mut random, axes, range) };
        let ending = random_ending(&mut random);
        let table = compile(&rows, ending);
        let columns = random_columns(&mut random, &rows, axes, 12);
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        for wanted in WANTED {
            let form = Evaluator::new(&table, wanted);
            let mut found = TableValues::default();
            form.evaluate(&slices, 12, &mut found);
            for row in 0..12 {
                let others: Vec<f64> = columns[1..].iter().map(|column| column[row]).collect();
                let (value, sides) = table.value_and_sides_at(columns[0][row], &others);
                assert_eq!(found.sides_of(row), sides, "{wanted:?}: row {row} of {columns:?} in {rows:?}");
                let at = form.value_at(columns[0][row], &others);
                assert_eq!(at.sides, sides);
                assert_eq!(at.value.to_bits(), found.values[row].to_bits(), "{wanted:?}");
                assert_eq!(value.is_nan(), found.values[row].is_nan());
            }
            let mut seen = SeenError::default();
            form.compare(&slices, &found.values, &mut seen);
            if wanted == Wanted::Mode(Accuracy::Full) && seen.rows > 0 {
                assert!(seen.pointwise <= 3.0 * f64::EPSILON, "{seen:?} in {rows:?}");
            }
        }
    }
}
