//! T005: pressure tables that start above zero.

use crate::order::starts;
use crate::quantity::{group_label, number};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::{sound_tables, starts_as_it_must};

declare_rule! {
    /// A table of conductance against contact pressure starts above zero pressure.
    ///
    /// The rule holds for each temperature and field variable on its own.
    /// A table of contact permeability may start anywhere.
    ///
    /// ## Why
    /// The manual demands that the table starts at zero pressure, or at the most negative pressure of contact that carries tension (Analysis User's Guide 37.2.1, 37.3.1).
    /// The value at zero pressure is what counts at the moment of contact.
    ///
    /// ## What to do
    /// Give a row for zero pressure.
    /// inpact takes the first value for all lower pressures; if that is what you mean, repeat it at zero, or lower the severity of this rule.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 0.05, 100.
    /// 0.2,  200.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 0.05, 0.
    /// 0.05, 100.
    /// 0.2,  200.
    /// ```
    "T005", "pressure-start", Error, fix: None, source: "Q-11, T-23, T-24"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    // CalculiX takes the first value for all lower pressures.
    if context.is_for_calculix() {
        return;
    }
    for of in sound_tables(context).filter(|of| of.kind.is_conductance_against_pressure()) {
        for index in starts(of.table) {
            let row = of.table.row(index);
            if starts_as_it_must(of, row[1]) {
                continue;
            }
            let group = group_label(of.table, row);
            let message = format!("pressure table starts at {}, above 0{group}", number(row[1]));
            report
                .at(context.cell(of, index, 1), message)
                .label("the first contact pressure of the group")
                .also(context.trimmed(of.table.keyword), "the table of this option")
                .note("a table against contact pressure must start at zero, or below where contact carries tension")
                .help(format!("add a row for pressure 0; below {} the first value holds", number(row[1])));
        }
    }
}
