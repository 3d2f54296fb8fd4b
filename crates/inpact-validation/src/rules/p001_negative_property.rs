//! P001: conductances, permeabilities and radiation factors below zero.

use crate::quantity::{and_more, column_name, number, value_name};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::{emissivities, sound_tables};
use inpact_parser::model::{TableKind, TableOf};
use inpact_parser::span::Span;

declare_rule! {
    /// A conductance, a permeability, a view factor or an emissivity is negative.
    ///
    /// ## Why
    /// With a negative conductance current flows from the lower to the higher potential, and the interface creates energy instead of dissipating it.
    /// With a negative permeability water flows towards the higher pressure.
    ///
    /// ## What to do
    /// Correct the sign.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// -1.E6, 0.
    /// 3.E7,  1.E7
    /// ```
    ///
    /// ```inp,expect
    /// *PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67E-8
    /// *SURFACE INTERACTION, NAME=FURNACE
    /// *GAP RADIATION
    /// 0.8, -0.3
    /// 1., 0.
    /// 0., 0.1
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=SEALED
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1, CUTOFF GAP FILL=0.1
    /// 0., 0.
    /// ```
    "P001", "negative-property", Error, fix: None, source: "Q-13, K-13, K-23, T-27"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for of in sound_tables(context).filter(|of| of.kind != TableKind::Other) {
        let mut negative = of.table.row_values().enumerate().filter(|(_, row)| row[0] < 0.0);
        let Some((index, row)) = negative.next() else { continue };
        let more = and_more(negative.count(), "row of this table is negative", "rows of this table are negative");
        say(report, context.cell(of, index, 0), name(of).as_ref(), row[0], &more);
    }
    for (item, emissivity) in emissivities(context).into_iter().filter(|(_, emissivity)| *emissivity < 0.0) {
        say(report, item, "emissivity", emissivity, "");
    }
}

fn name(of: TableOf<'_>) -> std::borrow::Cow<'_, str> {
    if of.kind == TableKind::ViewFactor { column_name(&of.table.columns[0]) } else { value_name(of.kind).into() }
}

fn say(report: &mut Report<'_>, span: Span, name: &str, value: f64, more: &str) {
    let found = report.at(span, format!("{name} {} is negative", number(value)));
    found
        .label("below 0")
        .note(format!("such an interface would create energy instead of dissipating it{more}"))
        .help("give a value of 0 or above");
}
