//! Random tables and points for the tests of the accuracy modes.

#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

use inpact_evaluation::table::{PiecewiseTable, Tail};

use crate::table_judge::{Ending, Random, Rows};

/// How the numbers of a random table are chosen.
#[derive(Clone, Copy)]
pub enum Range {
    /// From the smallest subnormal to the largest number; abscissae of either sign.
    AllDecades,
    /// Values of 2⁻¹⁰ to 2¹¹, abscissae of a few hundred at most.
    Ordinary,
}

/// Rows of a random table with `axes` axes, each group with abscissae of its own.
pub fn random_rows(random: &mut Random, axes: usize, range: Range) -> Rows {
    let mut rows = Rows::new();
    add_groups(random, axes, range, &mut vec![0.0; axes], &mut rows);
    rows
}

fn add_groups(random: &mut Random, axis: usize, range: Range, abscissae: &mut Vec<f64>, rows: &mut Rows) {
    if axis == 0 {
        let value = match range {
            Range::AllDecades => random.of_any_decade(),
            Range::Ordinary => random.positive(-10, 10),
        };
        rows.push(std::iter::once(value).chain(abscissae.iter().copied()).collect());
        return;
    }
    let mut x = match range {
        Range::AllDecades => random.signed(),
        Range::Ordinary => [0.0, 1.0, -3.0, 273.15][random.below(4)],
    };
    for _ in 0..=random.below(if axis > 2 { 3 } else { 4 }) {
        abscissae[axis - 1] = x;
        add_groups(random, axis - 1, range, abscissae, rows);
        let next = match range {
            Range::AllDecades => random.above(x),
            Range::Ordinary => x + random.positive(-8, 8),
        };
        if next <= x || !next.is_finite() {
            return;
        }
        x = next;
    }
}

/// A query: near, between and beyond the abscissae of randomly chosen rows.
pub fn random_point(random: &mut Random, rows: &Rows) -> Vec<f64> {
    (1..rows[0].len())
        .map(|column| {
            let a = rows[random.below(rows.len())][column];
            let b = rows[random.below(rows.len())][column];
            match random.below(12) {
                0 => a,
                1 => a.next_up().min(f64::MAX),
                2 => a.next_down().max(f64::MIN),
                3 => random.signed(),
                _ => random.within(a.min(b), a.max(b)),
            }
        })
        .collect()
}

/// Zero beyond the last row for one table of three.
pub fn random_ending(random: &mut Random) -> Ending {
    if random.below(3) == 0 { Ending::Zero } else { Ending::Constant }
}

/// The table of `rows`.
pub fn compile(rows: &Rows, ending: Ending) -> PiecewiseTable {
    let tail = match ending {
        Ending::Constant => Tail::Constant,
        Ending::Zero => Tail::Zero,
    };
    PiecewiseTable::from_rows(&rows.concat(), rows[0].len(), tail).unwrap()
}
