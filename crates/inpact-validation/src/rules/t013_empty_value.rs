//! T013: rows whose dependent value is left empty.

use crate::problems::BlocksByKeyword;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::ProblemKind;

declare_rule! {
    /// The first item of a row, the value that the row is for, is left empty.
    ///
    /// ## Why
    /// An empty item reads as 0 where the option has no other default: a perfect insulator, or a sealed interface.
    /// More likely the value was forgotten.
    ///
    /// ## What to do
    /// Give the value; write `0.` if 0 is meant.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    ///    , 0.1
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0.,  0.1
    /// *GAP HEAT GENERATION
    /// , 0.3
    /// ```
    "T013", "empty-value", Warning, fix: None, source: "S-32"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let empty = context.problems.iter().filter_map(|problem| match &problem.kind {
        ProblemKind::EmptyValue { column } => Some((problem, column)),
        _ => None,
    });
    let mut empty = empty.peekable();
    if empty.peek().is_none() {
        return;
    }
    let blocks = BlocksByKeyword::of(context);
    for (problem, column) in empty {
        let columns = blocks.get(problem.keyword).map_or(&[][..], |block| &block.definition.data.columns);
        if columns.iter().any(|definition| definition.name == *column && definition.default.is_some()) {
            continue;
        }
        report
            .at(problem.span, format!("{column} is left empty and reads as 0"))
            .label(format!("expected the {column} here"))
            .note("an item that is left empty means 0")
            .help("give the value, or write `0.`");
    }
}
