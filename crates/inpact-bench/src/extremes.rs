//! The page of extremes: results for inputs at the limits of f64, and their error against the exact result.
//!
//! Everything is computed by the library behind `inpact eval`; exact results are computed with rationals, by the reference of the library's own tests.
//! All inputs are fixed or drawn from fixed seeds, so that equal code gives equal pages; `docs/extremes.md` is such a page, and a test keeps it up to date.

mod evaluators;
mod flows;
#[path = "../../inpact-evaluation/tests/table_judge/mod.rs"]
mod judge;
mod judged;
mod markdown;
mod matrix;
mod random_tables;
mod run;
mod shapes;

/// The page, Markdown with one sentence per line.
pub fn page() -> String {
    let sections = [matrix::section(), random_tables::section(), shapes::section(), flows::section()];
    format!("{HEAD}\n{}", sections.join("\n"))
}

const HEAD: &str = "\
# Extremes

This page is written by `inpact-bench extremes > docs/extremes.md`; a test writes it again and fails where the two differ.
Every number in it comes from the evaluation that `inpact eval` runs; what is exact is computed with rational numbers from the manual's rules, not from the program's own formulas.
An *ulp* is the distance between neighbouring f64 at the exact result: half of one is the best that any f64 can do.
";
