//! K007: parameters without the value they need.

use crate::parameter::all_given;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::ValueUse;
use inpact_parser::span::Span;

declare_rule! {
    /// A parameter lacks the value that it needs, or nothing follows its `=`.
    ///
    /// ## Why
    /// `DEPENDENCIES` alone does not say how many field variables there are.
    /// inpact reads the line as if the parameter were not there.
    ///
    /// ## What to do
    /// Write the value: `DEPENDENCIES=1`.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES
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
    "K007", "missing-value", Error, fix: None, source: "S-17"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for given in all_given(context) {
        let value_use = given.definition.value_use();
        let is_empty = given.parameter.value.is_some_and(Span::is_empty);
        let is_missing = match value_use {
            ValueUse::Never => false,
            // CalculiX reads what is empty as 0.
            ValueUse::Optional => is_empty && !context.is_for_calculix(),
            ValueUse::Always => given.value().is_none(),
        };
        if !is_missing {
            continue;
        }
        let name = &given.definition.name;
        report
            .at(given.parameter.span(), format!("`{name}` of `*{}` has no value", given.block.name))
            .label("a value is missing")
            .note(format!("`{name}`: {}", given.definition.description))
            .help(match value_use {
                ValueUse::Optional => format!("write a value after `=`, or `{name}` alone"),
                _ => format!("write `{name}=…`"),
            });
    }
}
