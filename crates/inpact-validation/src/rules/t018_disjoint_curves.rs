//! T018: curves of CalculiX that share no pressures.

use crate::order::curves;
use crate::quantity::number;
use crate::rule::{Context, Report, declare_rule};
use crate::tables::sound_tables;
use inpact_parser::model::{Table, TableKind};
use std::ops::Range;

declare_rule! {
    /// Two neighbouring curves of a *GAP CONDUCTANCE share no contact pressures, in a deck for CalculiX.
    ///
    /// ## Why
    /// Between two temperatures CalculiX takes the pressures that both curves have.
    /// Without a common pressure ccx stops, as soon as a mean temperature lies between the two.
    ///
    /// ## What to do
    /// Give the curves rows at the same pressures.
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *GAP CONDUCTANCE
    /// 100., 0., 293.
    /// 200., 500., 293.
    /// 150., 600., 393.
    /// 300., 900., 393.
    /// ```
    ///
    /// ```inp,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *GAP CONDUCTANCE
    /// 100., 0., 293.
    /// 200., 500., 293.
    /// 150., 0., 393.
    /// 300., 500., 393.
    /// ```
    "T018", "disjoint-curves", Error, fix: None, source: "CalculiX ccx 2.20, plmix.f"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    if !context.is_for_calculix() {
        return;
    }
    for of in sound_tables(context).filter(|of| of.kind == TableKind::ThermalPressure) {
        let table = of.table;
        let groups: Vec<Range<usize>> = curves(table).collect();
        for pair in groups.windows(2).filter(|pair| !do_share(table, &pair[0], &pair[1])) {
            let temperature = |rows: &Range<usize>| number(table.row(rows.start)[2]);
            let (first, second) = (temperature(&pair[0]), temperature(&pair[1]));
            report
                .at(table.row_span(pair[1].start), format!("the curves at {first} and {second} share no pressures"))
                .label("this curve begins here")
                .also(table.row_span(pair[0].start), "the other one begins here")
                .note("CalculiX stops as soon as a mean temperature lies between them")
                .help("give both curves rows at the same pressures");
        }
    }
}

/// Whether the curve that begins at the lower pressure reaches beyond where the other begins.
fn do_share(table: &Table, one: &Range<usize>, other: &Range<usize>) -> bool {
    let ends = |rows: &Range<usize>| (table.row(rows.start)[1], table.row(rows.end - 1)[1]);
    let ((first, first_end), (second, second_end)) = (ends(one), ends(other));
    first == second || if first < second { second < first_end } else { first < second_end }
}
