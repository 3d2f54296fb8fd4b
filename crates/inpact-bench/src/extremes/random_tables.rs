//! Random tables against exact rationals, mode by mode.

use super::evaluators::EVALUATORS;
use super::judge::{Ending, Random, Rows, table_value, ulps_from};
use super::markdown::{count, table, ulps};
use inpact_evaluation::table::{PiecewiseTable, Tail};

const TEXT: &str = "\
## Random tables

Ragged tables with abscissae and values drawn from all decades of f64 (5e-324 to 1.8e308, zero included) or from twenty binary ones, one to four rows a group.
Queries lie at, beside, between and beyond the abscissae.
The bound of `full` is 2 ulp an axis.
";

/// Which numbers a table is made of.
#[derive(Clone, Copy)]
enum Decades {
    All,
    Ordinary,
}

impl Decades {
    fn words(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Ordinary => "2⁻¹⁰ to 2¹⁰",
        }
    }

    fn value(self, random: &mut Random) -> f64 {
        match self {
            Self::All => random.of_any_decade(),
            Self::Ordinary => random.positive(-10, 10),
        }
    }

    fn first(self, random: &mut Random) -> f64 {
        match self {
            Self::All => random.signed(),
            Self::Ordinary => random.positive(-10, 10),
        }
    }

    fn next(self, random: &mut Random, x: f64) -> f64 {
        match self {
            Self::All => random.above(x),
            Self::Ordinary => x + random.positive(-8, 8),
        }
    }
}

/// Queries of a table of so many axes.
const QUERIES: [(usize, usize); 3] = [(1, 6_000), (2, 2_000), (3, 600)];

/// The section of the page.
pub(super) fn section() -> String {
    let mut rows = Vec::new();
    for (axes, queries) in QUERIES {
        for decades in [Decades::All, Decades::Ordinary] {
            for (evaluator, measured) in EVALUATORS.iter().zip(largest_errors(axes, queries, decades)) {
                rows.push(vec![
                    axes.to_string(),
                    decades.words().to_owned(),
                    evaluator.name.to_owned(),
                    count(measured.queries),
                    ulps(measured.largest),
                    format!("{} of {}", count(measured.rows_met), count(measured.rows)),
                ]);
            }
        }
    }
    let header = ["axes", "decades", "mode and kernel", "queries", "largest error, ulp", "rows met exactly"];
    format!("{TEXT}\n{}", table(&header, rows))
}

/// What was measured of one evaluator.
#[derive(Clone, Default)]
struct Measured {
    queries: usize,
    largest: f64,
    rows: usize,
    rows_met: usize,
}

/// For each evaluator the largest error over at least so many queries; all answer the same ones.
fn largest_errors(axes: usize, queries: usize, decades: Decades) -> Vec<Measured> {
    let mut random = Random::new(0xe7_7e3e + axes as u64);
    let mut measured = vec![Measured::default(); EVALUATORS.len()];
    let mut asked = 0;
    while asked < queries {
        let rows = random_rows(&mut random, axes, decades);
        let ending = if random.below(3) == 0 { Ending::Zero } else { Ending::Constant };
        let tail = if ending == Ending::Zero { Tail::Zero } else { Tail::Constant };
        let built = PiecewiseTable::from_rows(&rows.concat(), axes + 1, tail).expect("rows that ascend");
        let points: Vec<Vec<f64>> = (0..8).map(|_| random_point(&mut random, &rows)).collect();
        let exact: Vec<_> = points.iter().map(|point| table_value(&rows, point, ending)).collect();
        asked += points.len();
        for (evaluator, measured) in EVALUATORS.iter().zip(&mut measured) {
            let Some(value) = (evaluator.of)(&built) else { continue };
            measured.queries += points.len();
            for (point, exact) in points.iter().zip(&exact) {
                measured.largest = measured.largest.max(ulps_from(value(point), exact));
            }
            measured.rows += rows.len();
            measured.rows_met += rows.iter().filter(|row| value(&row[1..]) == row[0]).count();
        }
    }
    measured
}

/// Rows of a random table, each group with abscissae of its own.
fn random_rows(random: &mut Random, axes: usize, decades: Decades) -> Rows {
    let mut rows = Rows::new();
    add_groups(random, axes, decades, &mut vec![0.0; axes], &mut rows);
    rows
}

fn add_groups(random: &mut Random, axis: usize, decades: Decades, abscissae: &mut [f64], rows: &mut Rows) {
    let Some(this) = axis.checked_sub(1) else {
        rows.push([&[decades.value(random)], &*abscissae].concat());
        return;
    };
    let mut x = decades.first(random);
    for _ in 0..=random.below(4) {
        abscissae[this] = x;
        add_groups(random, this, decades, abscissae, rows);
        let next = decades.next(random, x);
        if !(next.is_finite() && x < next) {
            return;
        }
        x = next;
    }
}

/// A query at, beside, between and beyond the abscissae of rows chosen at random.
fn random_point(random: &mut Random, rows: &Rows) -> Vec<f64> {
    let coordinate = |column: usize| {
        let a = rows[random.below(rows.len())][column];
        let b = rows[random.below(rows.len())][column];
        match random.below(12) {
            0 => a,
            1 => a.next_up().min(f64::MAX),
            2 => a.next_down().max(f64::MIN),
            3 => random.signed(),
            _ => random.within(a.min(b), a.max(b)),
        }
    };
    (1..rows[0].len()).map(coordinate).collect()
}
