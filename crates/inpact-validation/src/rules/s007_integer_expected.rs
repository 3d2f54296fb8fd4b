//! S007: values that are no integers where integers are due.

use crate::parameter;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::ParameterKind;
use inpact_parser::number::{NumberError, read_float};
use inpact_parser::ProblemKind;

declare_rule! {
    /// A value is a number with a point, or a text, where an integer is due.
    ///
    /// ## Why
    /// Abaqus refuses a floating-point number where it counts something.
    ///
    /// ## What to do
    /// Write the number without point and exponent: `2`, not `2.` or `2.0`.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1.0
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    "S007", "integer-expected", Error, fix: None, source: "S-35"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for problem in context.problems {
        if let ProblemKind::MalformedNumber { error: NumberError::NotAnInteger, column } = &problem.kind {
            let shown = context.shown(problem.span);
            report
                .at(problem.span, format!("`{shown}` in column `{column}` is no integer"))
                .label("should be an integer")
                .help("write digits without point and exponent");
        }
    }
    for given in parameter::all_given(context).filter(|given| given.definition.kind == ParameterKind::Integer) {
        let (Some(value), Some(Err(error))) = (given.value(), given.number(context)) else { continue };
        let (name, shown) = (&given.definition.name, context.shown(value));
        if error == NumberError::TooLarge {
            report
                .at(value, format!("`{name}={shown}` is too large for an integer"))
                .label("an integer has at most 9 digits")
                .help("check the number of digits");
            continue;
        }
        let number = given.text(context).and_then(|text| read_float(&text).ok()).filter(|number| number.fract() == 0.0);
        let help = match number.filter(|number| number.abs() < 1e9) {
            Some(number) => format!("write `{name}={number:.0}`"),
            None => "write digits without point and exponent".to_owned(),
        };
        report
            .at(value, format!("`{shown}` as the value of `{name}` is no integer"))
            .label("should be an integer")
            .help(help);
    }
}
