//! P006: conductances that fall as contact pressure rises.

use crate::quantity::and_more;
use crate::rule::{Context, Report, declare_rule};
use crate::trend::against;
use inpact_parser::model::TableKind;

declare_rule! {
    /// A conductance falls from one contact pressure to the next higher one.
    ///
    /// Contact permeability may fall: pressure closes the pores.
    ///
    /// ## Why
    /// Pressure flattens the asperities, so that more of the surfaces touches and more current and heat pass.
    /// A table that falls is most often one against clearance with a `PRESSURE` too many.
    ///
    /// ## What to do
    /// If the second column holds clearances, take `PRESSURE` out.
    /// Otherwise check the values.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// 2.E7, 2.E7
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// 3.E7, 2.E7
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.01, CUTOFF GAP FILL=0.01
    /// 1.E-9, 0.
    /// 1.E-10, 1.E7
    /// ```
    "P006", "falls-with-pressure", Warning, fix: None, source: "4.2, T-21"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for (of, trend) in against(context, TableKind::is_conductance_against_pressure, |before, value| value < before) {
        let more = and_more(trend.wrong - 1, "step of this table falls", "steps of this table fall");
        let found = trend.report(context, report, of, ["falls", "the contact pressure rises"]);
        found.label("lower than at the lower pressure");
        found.also(context.cell(of, trend.before, 0), "the value at the lower pressure");
        found.note(format!("pressure brings more of the surfaces into touch{more}"));
        found.help(trend.help("take `PRESSURE` out if the second column holds clearances"));
    }
}
