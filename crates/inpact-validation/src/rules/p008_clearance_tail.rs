//! P008: clearance tables that do not end at zero.

use crate::order::curves;
use crate::quantity::{and_more, group_label, number};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::{sound_tables, starts_as_it_must};
use inpact_parser::model::TableKind;
use std::ops::Range;

declare_rule! {
    /// The last value of a *GAP ELECTRICAL CONDUCTANCE table against clearance is not zero.
    ///
    /// ## Why
    /// The manual disagrees with itself on what holds beyond the last clearance.
    /// The text of 37.3.1 says that the conductance stays constant; its figure, and Abaqus/CAE, let it drop to zero.
    /// inpact follows the text by default (`--clearance-tail zero`).
    /// *GAP CONDUCTANCE always drops to zero there.
    ///
    /// ## What to do
    /// Add a last row with conductance 0 at the clearance beyond which nothing is conducted: then both readings agree.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 10., 0.1
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 10., 0.1
    /// 0.,  0.11
    /// ```
    "P008", "clearance-tail", Note, fix: None, source: "Q-1"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    // The meaning of one row beyond its clearance is the subject of T008.
    let of_kind = |kind| kind == TableKind::ElectricalClearance;
    for of in sound_tables(context).filter(|of| of_kind(of.kind) && of.table.row_count() > 1) {
        let table = of.table;
        // A table with a wrong start (T004), or one that only rises (P005), is more likely one against pressure.
        let is_meant = |rows: &Range<usize>| starts_as_it_must(of, table.row(rows.start)[1]);
        let only_rises = |rows: &Range<usize>| {
            rows.len() > 1 && rows.clone().skip(1).all(|row| table.row(row)[0] > table.row(row - 1)[0])
        };
        let tails = curves(table).filter(|rows| is_meant(rows) && !only_rises(rows)).map(|rows| rows.end - 1);
        let mut tails = tails.filter(|row| table.row(*row)[0] > 0.0);
        let Some(index) = tails.next() else { continue };
        let row = table.row(index);
        let group = group_label(table, row);
        let message =
            format!("conductance is {} at the last clearance {}{group}, not 0", number(row[0]), number(row[1]));
        let more = and_more(tails.count(), "group does not end at 0", "groups do not end at 0");
        report
            .at(context.cell(of, index, 0), message)
            .label("constant or 0 beyond this clearance?")
            .note(format!("beyond the last clearance the manual's text says constant, its figure says 0{more}"))
            .help("add a last row with conductance 0");
    }
}
