//! S015: parameters that nothing defines.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::ProblemKind;

declare_rule! {
    /// `<name>` is in place of a value, and no *PARAMETER defines the name.
    ///
    /// All definitions of a deck count, also those further down; upper and lower case differ.
    ///
    /// ## Why
    /// Abaqus stops at a parameter without a value.
    ///
    /// ## What to do
    /// Define it, or correct the spelling.
    ///
    /// ```inp,expect
    /// *PARAMETER
    /// sigma = 1.E6
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// <Sigma>, 0.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// <sigma>, 0.
    /// *PARAMETER
    /// sigma = 1.E6
    /// ```
    "S015", "undefined-parameter", Error, fix: None, source: "S-61, S-62"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    if context.has_unread_files() {
        // A file that was not read may define it.
        return;
    }
    for problem in context.problems {
        let ProblemKind::UndefinedParameter { name, similar } = &problem.kind else { continue };
        let found = report.at(problem.span, format!("the parameter `{name}` is not defined"));
        found.label("has no value");
        match similar {
            Some(similar) => found.help(format!("did you mean `{similar}`? Upper and lower case differ")),
            None if context.is_for_calculix() => {
                found.help("write the value: CalculiX has no parameters")
            }
            None => found.help(format!("define it: `*PARAMETER` and below it `{name} = …`")),
        };
    }
}
