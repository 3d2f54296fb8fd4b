//! C008: the penalty method beside a finite permeability.

use inpact_parser::model::OptionKind;
use crate::parameter::given_as;
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// *CONTACT PERMEABILITY has `CONSTRAINT METHOD=PENALTY` and rows.
    ///
    /// ## Why
    /// The method says how equal pore pressures are enforced.
    /// With a permeability on the rows the pressures need not be equal; then DIRECT is the only legal value.
    ///
    /// ## What to do
    /// Take `CONSTRAINT METHOD` out, or the rows.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=WALL
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.002, CUTOFF GAP FILL=0.01, CONSTRAINT METHOD=PENALTY
    /// 1.E-9, 0.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=WALL
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.002, CUTOFF GAP FILL=0.01, CONSTRAINT METHOD=PENALTY
    /// ```
    "C008", "penalty-with-permeability", Error, fix: None, source: "K-24"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for block in context.defined_blocks().filter(|block| block.kind() == OptionKind::ContactPermeability) {
        let Some(method) = given_as(block, "CONSTRAINT METHOD") else { continue };
        let value = method.value().map(|value| context.value(value)).unwrap_or_default();
        if method.definition.choice_named(value.as_bytes()) != Some("PENALTY") {
            continue;
        }
        let Some(row) = context.rows(block).next() else { continue };
        report
            .at(method.parameter.span(), "`CONSTRAINT METHOD=PENALTY` beside a permeability")
            .label("legal without rows only")
            .also(context.trimmed(row.span), "the permeability")
            .note("with a permeability the pore pressures need not be equal, so there is no constraint to enforce")
            .help("take `CONSTRAINT METHOD` or the rows out");
    }
}
