//! T007: rows over several lines that are cut short.

use crate::problems::{first_of_each_block, of_clear_columns};
use crate::quantity::count;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::ProblemKind;

declare_rule! {
    /// The last row of a table should go over several lines and has too few.
    ///
    /// A line holds at most eight items, so with many field variables a row goes on in the next line.
    ///
    /// ## Why
    /// Abaqus takes as many lines for a row as `DEPENDENCIES` gives, whatever is on them.
    /// If a line is missing anywhere in the table, every row after it is read wrongly.
    ///
    /// ## What to do
    /// Look for the row that lacks a line, which need not be the last one, and check `DEPENDENCIES`.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=SWITCH
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=6
    /// 5.E6, 0.,   20., 0., 0.1, 8., 1., 0.5
    /// 0.
    /// 8.E7, 1.E7, 20., 0., 0.1, 8., 1., 0.5
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=SWITCH
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=6
    /// 5.E6, 0.,   20., 0., 0.1, 8., 1., 0.5
    /// 0.
    /// 8.E7, 1.E7, 20., 0., 0.1, 8., 1., 0.5
    /// 0.
    /// ```
    "T007", "incomplete-row", Error, fix: None, source: "K-50, K-52, K-55"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for problem in context.problems {
        let ProblemKind::PropertyCount { stated, given } = problem.kind else { continue };
        if given < stated {
            report
                .at(context.trimmed(problem.span), format!("`PROPERTIES={stated}`, and {} given", are(given)))
                .label("the properties end here")
                .also(context.trimmed(problem.keyword), format!("{} should follow", count(stated, "value")))
                .note("a line has eight values; without an Explicit step the thickness has the first line for itself")
                .help(format!("give {stated} values, or write `PROPERTIES={given}`"));
        }
    }
    // A row with too many items says the same of the table, at a better place.
    let is_meant =
        |kind: &ProblemKind| matches!(kind, ProblemKind::IncompleteRow { .. } | ProblemKind::TooManyItems { .. });
    for first in of_clear_columns(context, first_of_each_block(context, is_meant)) {
        let ProblemKind::IncompleteRow { lines, given } = first.problem.kind else { continue };
        let message = format!("last row of the table has {} of {lines}", count(given, "line"));
        report
            .at(first.problem.span, message)
            .label("the table ends inside this row")
            .also(context.trimmed(first.problem.keyword), format!("a row of this option goes over {lines} lines"))
            .note("the number of lines of the table must be a multiple of the lines of a row")
            .help("look for a row that lacks a line, and check `DEPENDENCIES`");
    }
}

/// `1 value is`, `3 values are`.
fn are(values: usize) -> String {
    let verb = if values == 1 { "is" } else { "are" };
    format!("{} {verb}", count(values, "value"))
}
