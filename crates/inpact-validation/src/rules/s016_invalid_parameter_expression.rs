//! S016: statements of *PARAMETER that cannot be executed, and values that cannot be substituted.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::ProblemKind;

declare_rule! {
    /// A row of *PARAMETER is no statement that can be executed, or a value of a parameter cannot be put where it is used.
    ///
    /// Rows of *PARAMETER are `name = expression`, as Python reads them: `**` is a power, and `#` begins a comment.
    ///
    /// ## Why
    /// Abaqus stops at a statement that Python cannot execute.
    ///
    /// ## What to do
    /// Correct the statement; a name must be defined above the statement that uses it.
    ///
    /// ```inp,expect
    /// *PARAMETER
    /// area = width*height
    /// height = 2.5
    /// ```
    ///
    /// ```inp
    /// *PARAMETER
    /// width = 4
    /// height = 2.5   # in metres
    /// area = width*height
    /// ```
    "S016", "invalid-parameter-expression", Error, fix: None, source: "S-60, S-61"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let has_unread_files = context.has_unread_files();
    for problem in context.problems {
        if let ProblemKind::SubstitutionTooLong { bytes, most } = problem.kind {
            report
                .at(problem.span, format!("these {bytes} bytes become more than {most} with the values of their parameters"))
                .label("not substituted")
                .help("write fewer parameters here, or shorter texts into them");
            continue;
        }
        let ProblemKind::InvalidExpression { message, help, undefined } = &problem.kind else { continue };
        if undefined.is_some() && has_unread_files {
            // A file that was not read may define it.
            continue;
        }
        let found = report.at(problem.span, message.clone());
        found.label("not executed");
        match help {
            Some(help) => found.help(help.clone()),
            None => found.help("write `name = expression`, with + - * / ** and the functions of *PARAMETER"),
        };
    }
}
