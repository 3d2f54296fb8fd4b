//! P006: conductances that fall as contact pressure rises.

use crate::quantity::{and_more, number, value_name};
use crate::rule::{Context, Report, declare_rule};
use crate::trend::{Trend, against};
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
        let Trend { before, row, wrong: falling, total } = trend;
        let (lower, upper) = (of.table.row(before), of.table.row(row));
        let message = format!(
            "{} falls from {} to {} as the contact pressure rises from {} to {}",
            value_name(of.kind),
            number(lower[0]),
            number(upper[0]),
            number(lower[1]),
            number(upper[1]),
        );
        let more = and_more(falling - 1, "step of this table falls", "steps of this table fall");
        let found = report.at(context.cell(of, row, 0), message);
        found
            .label("lower than at the lower pressure")
            .also(context.cell(of, before, 0), "the value at the lower pressure")
            .note(format!("pressure brings more of the surfaces into touch{more}"));
        if falling == total {
            found.help("take `PRESSURE` out if the second column holds clearances");
        } else {
            found.help("check the values");
        }
    }
}
