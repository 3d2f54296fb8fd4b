//! P002: cutoff distances below zero.

use crate::parameter::all_given;
use crate::quantity::number;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::number::read_float;

declare_rule! {
    /// A cutoff distance of *CONTACT PERMEABILITY or *GAP DIFFUSIVITY is negative.
    ///
    /// ## Why
    /// A cutoff is a clearance above which nothing flows; a clearance below zero is contact.
    /// A negative cutoff would stop the flow in contact as well.
    ///
    /// ## What to do
    /// Give a length of zero or more; zero means that there is flow in contact only.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=WALL
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=-0.001, CUTOFF GAP FILL=0.01
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=WALL
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0., CUTOFF GAP FILL=0.01
    /// ```
    "P002", "negative-cutoff", Error, fix: None, source: "Q-13, K-23, P-22"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let is_cutoff = |name: &str| matches!(name, "CUTOFF FLOW ACROSS" | "CUTOFF GAP FILL");
    for given in all_given(context).filter(|given| is_cutoff(&given.definition.name)) {
        let Some(value) = given.value() else { continue };
        let cutoff = read_float(context.value(value).as_bytes()).ok();
        let Some(cutoff) = cutoff.filter(|cutoff| *cutoff < 0.0) else { continue };
        report
            .at(value, format!("`{}` {} is negative", given.definition.name, number(cutoff)))
            .label("below 0")
            .note("a cutoff is a clearance above which nothing flows, and a clearance below 0 is contact")
            .help("give a length of 0 or above");
    }
}
