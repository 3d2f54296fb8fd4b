//! S017: parameters that a table gives.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::ProblemKind;

declare_rule! {
    /// A *PARAMETER takes its parameters from a table (TABLE, DEPENDENT, INDEPENDENT), which inpact does not interpret.
    ///
    /// ## Why
    /// The parameters have no value here, so each place that uses one is reported as undefined.
    ///
    /// ## What to do
    /// Nothing is wrong with the deck.
    /// To have it checked or evaluated, define the parameters by statements.
    ///
    /// ```inp,expect
    /// *PARAMETER, TABLE=T, DEPENDENT=(a), INDEPENDENT=(b)
    /// ```
    ///
    /// ```inp
    /// *PARAMETER
    /// a = 1.5
    /// ```
    "S017", "parameters-from-table", Warning, fix: None, source: "S-63"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for problem in context.problems.iter().filter(|problem| problem.kind == ProblemKind::UninterpretedParameters) {
        report
            .at(problem.span, "parameters from a table are not interpreted")
            .label("gives its parameters no value here")
            .help("define the parameters by statements to have the deck checked with their values");
    }
}
