//! K008: flags that are given a value.

use crate::parameter::all_given;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::ValueUse;

declare_rule! {
    /// A parameter that takes no value is given one.
    ///
    /// ## Why
    /// The value has no meaning: `PRESSURE=0` means just what `PRESSURE` means.
    ///
    /// ## What to do
    /// Take the value away, or the parameter with it when the opposite was meant.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE=1
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    "K008", "unexpected-value", Warning, fix: None, source: "S-17"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    // CalculiX looks at the name of a flag only (CX-03).
    if context.is_for_calculix() {
        return;
    }
    for given in all_given(context).filter(|given| given.definition.value_use() == ValueUse::Never) {
        let Some(value) = given.parameter.value else { continue };
        let (name, keyword) = (&given.definition.name, given.block.name);
        let shown = context.shown(value);
        report
            .at(given.parameter.span(), format!("`{name}` of `*{keyword}` takes no value, yet `{shown}` is given"))
            .label("the value means nothing")
            .note(format!("`{name}` holds whenever it is given, whatever its value"))
            .help(format!("write `{name}` alone, or leave it out"));
    }
}
