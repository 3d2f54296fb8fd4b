//! T006: rows with more items than the option has.

use inpact_diagnostics::Severity;
use crate::parameter::given_as;
use crate::problems::{first_of_each_block, has_no_place, of_clear_columns};
use crate::quantity::{and_more, count};
use crate::rule::{Context, DefinedBlock, Report, declare_rule};
use inpact_parser::ProblemKind;
use inpact_parser::span::Span;
use std::collections::HashSet;

declare_rule! {
    /// A row has more items than the option has columns.
    ///
    /// Empty items at the end of a row do not count.
    ///
    /// ## Why
    /// Abaqus allows only the items that the option has.
    /// inpact leaves out what is too much and does not judge the table any further.
    ///
    /// ## What to do
    /// For field variables after the temperature, give their number: `DEPENDENCIES=1` makes room for one.
    /// A row that goes over several lines has eight items at most on a line.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.,   20., 0.8
    /// 3.E7, 1.E7, 20., 0.8
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1
    /// 1.E6, 0.,   20., 0.8
    /// 3.E7, 1.E7, 20., 0.8,,
    /// ```
    "T006", "too-many-items", Error, fix: None, source: "S-33, K-54"
}

/// The most items on a line that CalculiX has room for.
const CALCULIX_ITEMS: usize = 16;

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for problem in context.problems {
        let ProblemKind::PropertyCount { stated, given } = problem.kind else { continue };
        if stated < given {
            report
                .at(context.trimmed(problem.span), format!("{}, and `PROPERTIES` is {stated}", count(given, "value")))
                .label("too much")
                .also(context.trimmed(problem.keyword), "the option")
                .note("`PROPERTIES` is the number of values that the user subroutine is given")
                .help(format!("write `PROPERTIES={given}`, or take the values out"));
        }
    }
    // No item at all is allowed on a row that has no place: that is T017.
    let surplus = |kind: &ProblemKind| matches!(kind, ProblemKind::TooManyItems { allowed, .. } if *allowed > 0);
    // Surplus rows mean that a keyword is missing in front of all of them: T017 reports it.
    let other = first_of_each_block(context, has_no_place);
    let other: HashSet<Span> = other.iter().map(|first| first.problem.keyword).collect();
    let found =
        first_of_each_block(context, surplus).into_iter().filter(|first| !other.contains(&first.problem.keyword));
    for first in of_clear_columns(context, found.collect()) {
        let ProblemKind::TooManyItems { allowed, given, lines } = first.problem.kind else { continue };
        let place = if lines > 1 { "line of the row" } else { "row" };
        let message = format!("{place} has {}, the option has room for {allowed}", count(given, "item"));
        let found = report.at(first.problem.span, message);
        if context.is_for_calculix() {
            let is_refused = CALCULIX_ITEMS < given;
            found.severity(if is_refused { Severity::Error } else { Severity::Warning });
            found.label(if is_refused { "CalculiX stops at more than 16 items" } else { "CalculiX does not read this" });
            found.also(context.trimmed(first.problem.keyword), "the option").help("take the items out");
            continue;
        }
        found.label("too much").also(context.trimmed(first.problem.keyword), "the option");
        let more = and_more(first.more, "row of this block has too many", "rows of this block have too many");
        found.note(format!("a row has only the items of the option; inpact leaves out the rest{more}"));
        found.help(match first.block {
            Some(block) if lines == 1 && has_no_dependencies(block) => {
                format!("give `DEPENDENCIES={}` if these are field variables, or take them out", given - allowed)
            }
            Some(block) if block.definition.parameter("DEPENDENCIES").is_some() => {
                "check `DEPENDENCIES`, or take the items out".to_owned()
            }
            _ => "take the items out".to_owned(),
        });
    }
}

/// Whether the option could have field variables and its line does not give their number.
fn has_no_dependencies(block: DefinedBlock<'_>) -> bool {
    block.definition.parameter("DEPENDENCIES").is_some() && given_as(block, "DEPENDENCIES").is_none()
}
