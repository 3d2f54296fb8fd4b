//! T004: clearance tables that do not start at zero.

use inpact_parser::model::TableKind;
use crate::order::starts;
use crate::quantity::{group_label, number};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::{sound_tables, starts_as_it_must};

declare_rule! {
    /// A table against clearance does not start at zero clearance.
    ///
    /// The rule holds for conductance and for radiation, and for each temperature and field variable on its own.
    ///
    /// ## Why
    /// The value at zero clearance is what counts at the moment of contact, and a clearance below zero does not exist: it is contact.
    /// The manual demands the start at zero (Analysis User's Guide 37.2.1, 37.3.1).
    ///
    /// ## What to do
    /// Give a row for zero clearance.
    /// If the second column holds contact pressures, say so by `PRESSURE` on the keyword line.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=PLUG
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 3.E7, 1.E-6, 300.
    /// 0.,   1.E-5, 300.
    /// 3.E7, 0.,    400.
    /// 0.,   1.E-5, 400.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=PLUG
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 3.E7, 0.,    300.
    /// 0.,   1.E-5, 300.
    /// 3.E7, 0.,    400.
    /// 0.,   1.E-5, 400.
    /// ```
    "T004", "clearance-start", Error, fix: None, source: "T-24, T-25, Q-11, T-27"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for of in sound_tables(context).filter(|of| of.kind.is_against_clearance()) {
        for index in starts(of.table) {
            let row = of.table.row(index);
            if starts_as_it_must(of, row[1]) {
                continue;
            }
            let group = group_label(of.table, row);
            let message = format!("clearance table starts at {} instead of 0{group}", number(row[1]));
            let found = report.at(context.cell(of, index, 1), message);
            found
                .label("the first clearance of the group")
                .also(context.trimmed(of.table.keyword), "the table of this option")
                .note("a table against clearance must start at zero clearance");
            if row[1] < 0.0 {
                found.help("start at 0; what holds in contact belongs into a table with `PRESSURE`");
            } else if of.kind == TableKind::ViewFactor {
                found.help("add a row for clearance 0");
            } else {
                found.help("add a row for clearance 0, or give `PRESSURE` if these are contact pressures");
            }
        }
    }
}
