//! Random tables against exact rationals, mode by mode.

use super::evaluators::EVALUATORS;
use super::judge::random_tables::{Range, compile, random_ending, random_point, random_rows};
use super::judge::{Random, table_value, ulps_from};
use super::markdown::{count, table, ulps};

const TEXT: &str = "\
## Random tables

Ragged tables with abscissae and values drawn from all decades of f64 (5e-324 to 1.8e308, zero included) or from twenty binary ones, one to four rows a group.
Queries lie at, beside, between and beyond the abscissae.
The bound of `full` is 2 ulp an axis.
";

/// Queries of a table of so many axes.
const QUERIES: [(usize, usize); 3] = [(1, 6_000), (2, 2_000), (3, 600)];

/// The section of the page.
pub(super) fn section() -> String {
    let mut rows = Vec::new();
    for (axes, queries) in QUERIES {
        for (range, decades) in [(Range::AllDecades, "all"), (Range::Ordinary, "2⁻¹⁰ to 2¹⁰")] {
            for (evaluator, measured) in EVALUATORS.iter().zip(largest_errors(axes, queries, range)) {
                rows.push(vec![
                    axes.to_string(),
                    decades.to_owned(),
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
fn largest_errors(axes: usize, queries: usize, range: Range) -> Vec<Measured> {
    let mut random = Random::new(0xe7_7e3e + axes as u64);
    let mut measured = vec![Measured::default(); EVALUATORS.len()];
    let mut asked = 0;
    while asked < queries {
        let rows = random_rows(&mut random, axes, range);
        let ending = random_ending(&mut random);
        let built = compile(&rows, ending);
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
