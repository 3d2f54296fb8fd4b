//! Random tables against exact rationals, mode by mode.

use super::evaluators::EVALUATORS;
use super::judge::random_tables::{Range, compile, random_ending, random_point, random_rows};
use super::judge::{Random, table_value};
use super::judged::{Errors, judged};
use super::markdown::{count, table, ulps};

const TEXT: &str = "\
## Random tables

Ragged tables with abscissae and values drawn from all decades of f64 (5e-324 to 1.8e308, zero included) or from twenty binary ones, one to four rows a group.
Queries lie at, beside, between and beyond the abscissae.
`full` is held to n + 1 ulp for n axes; the fast forms have bounds of their own, computed for each table.
The line of every instruction set evaluates each query with all sets of the machine, in whole vectors and in parts of one; a difference of one bit between them would count as an infinite error.
*Made for* says how many of the tables a form can be made for: the others are refused, since a slope, a width or a value would leave the range of its arithmetic, or since no regular grid meets their abscissae.
*Outside the bound* counts the values that are farther from the exact one than the form's bound says.
An infinite error within the bound is one of more than 1.8e308 ulp: of a value near zero between very large ones, in a form whose error is a part of the largest.
";

/// Queries of a table of this many axes.
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
                    format!("{} of {}", count(measured.made), count(measured.tables)),
                    count(measured.queries),
                    ulps(measured.errors.largest),
                    count(measured.errors.outside),
                    format!("{} of {}", count(measured.rows_met), count(measured.rows)),
                ]);
            }
        }
    }
    let header = [
        "axes",
        "decades",
        "mode and kernel",
        "made for",
        "queries",
        "largest error, ulp",
        "outside the bound",
        "rows met exactly",
    ];
    format!("{TEXT}\n{}", table(&header, rows))
}

/// The measurements of one evaluator.
#[derive(Clone, Default)]
struct Measured {
    /// Tables tried, and those supported.
    tables: usize,
    made: usize,
    queries: usize,
    errors: Errors,
    rows: usize,
    rows_met: usize,
}

/// For each evaluator the largest error over at least this many queries, the same for all.
fn largest_errors(axes: usize, queries: usize, range: Range) -> Vec<Measured> {
    let mut random = Random::new(0xe7_7e3e + axes as u64);
    let mut measured = vec![Measured::default(); EVALUATORS.len()];
    let mut queried = 0;
    while queried < queries {
        let rows = random_rows(&mut random, axes, range);
        let ending = random_ending(&mut random);
        let built = compile(&rows, ending);
        let points: Vec<Vec<f64>> = (0..8).map(|_| random_point(&mut random, &rows)).collect();
        let exact: Vec<_> = points.iter().map(|point| table_value(&rows, point, ending)).collect();
        queried += points.len();
        for (evaluator, measured) in EVALUATORS.iter().zip(&mut measured) {
            measured.tables += 1;
            let Ok(ready) = (evaluator.of)(&built) else { continue };
            measured.made += 1;
            measured.queries += points.len();
            for (point, exact) in points.iter().zip(&exact) {
                measured.errors.add(judged((ready.value)(point), exact, &ready.bound));
            }
            measured.rows += rows.len();
            measured.rows_met += rows.iter().filter(|row| (ready.value)(&row[1..]) == row[0]).count();
        }
    }
    measured
}
