//! Random ragged tables and points near, in and beyond them.

use super::{Ending, Random, Rows};
use inpact_evaluation::table::{PiecewiseTable, Tail};

/// How the numbers of a random table are chosen.
#[derive(Clone, Copy, Debug)]
pub enum Range {
    AllDecades,
    Ordinary,
}

impl Range {
    /// A value of a row.
    pub fn value(self, random: &mut Random) -> f64 {
        match self {
            Range::AllDecades => random.of_any_decade(),
            Range::Ordinary => random.positive(-10, 10),
        }
    }

    /// Where a group may begin.
    pub fn first(self, random: &mut Random) -> f64 {
        match self {
            Range::AllDecades => random.signed(),
            Range::Ordinary => [0.0, 1.0, -3.0, 273.15][random.below(4)],
        }
    }

    /// An abscissa after `x`, if it is above it.
    pub fn next(self, random: &mut Random, x: f64) -> f64 {
        match self {
            Range::AllDecades => random.above(x),
            Range::Ordinary => x + random.positive(-8, 8),
        }
    }
}

/// Rows of a random table with `axes` axes, each group with abscissae of its own.
pub fn random_rows(random: &mut Random, axes: usize, range: Range) -> Rows {
    let mut rows = Rows::new();
    let mut outer = vec![0.0; axes];
    add_groups(random, axes, range, &mut outer, &mut rows);
    rows
}

fn add_groups(random: &mut Random, axis: usize, range: Range, abscissae: &mut Vec<f64>, rows: &mut Rows) {
    if axis == 0 {
        let mut row = vec![range.value(random)];
        row.extend_from_slice(abscissae);
        rows.push(row);
        return;
    }
    let mut x = range.first(random);
    for _ in 0..=random.below(if axis > 2 { 3 } else { 4 }) {
        abscissae[axis - 1] = x;
        add_groups(random, axis - 1, range, abscissae, rows);
        let next = range.next(random, x);
        if next <= x || !next.is_finite() {
            return;
        }
        x = next;
    }
}

/// The table of some rows.
pub fn compile(rows: &Rows, ending: Ending) -> PiecewiseTable {
    let tail = match ending {
        Ending::Constant => Tail::Constant,
        Ending::Zero => Tail::Zero,
    };
    PiecewiseTable::from_rows(&rows.concat(), rows[0].len(), tail).unwrap()
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

/// Constant or zero beyond the last row.
pub fn random_ending(random: &mut Random) -> Ending {
    if random.below(3) == 0 { Ending::Zero } else { Ending::Constant }
}
