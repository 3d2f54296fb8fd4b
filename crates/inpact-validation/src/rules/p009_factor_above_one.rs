//! P009: view factors and emissivities above 1.

use inpact_parser::model::TableKind;
use crate::quantity::{and_more, number};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::{emissivities, sound_tables};

declare_rule! {
    /// A view factor or an emissivity of *GAP RADIATION is above 1.
    ///
    /// ## Why
    /// No surface radiates more than a black body, and none sees more of another than the whole of it.
    ///
    /// ## What to do
    /// Check whether the columns are swapped, or whether the value is in percent.
    ///
    /// ```inp,expect
    /// *PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67E-8
    /// *SURFACE INTERACTION, NAME=FURNACE
    /// *GAP RADIATION
    /// 80., 0.3
    /// 1., 0.
    /// 0., 0.1
    /// ```
    ///
    /// ```inp
    /// *PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67E-8
    /// *SURFACE INTERACTION, NAME=FURNACE
    /// *GAP RADIATION
    /// 0.8, 0.3
    /// 1., 0.
    /// 0., 0.1
    /// ```
    "P009", "factor-above-one", Error, fix: None, source: "2.6, T-27, H-06"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for of in sound_tables(context).filter(|of| of.kind == TableKind::ViewFactor) {
        let mut above = of.table.row_values().enumerate().filter(|(_, row)| row[0] > 1.0);
        let Some((index, row)) = above.next() else { continue };
        let more = and_more(above.count(), "row of this table is above 1", "rows of this table are above 1");
        report
            .at(context.cell(of, index, 0), format!("view factor {} is above 1", number(row[0])))
            .label("should be from 0 to 1")
            .note(format!("a surface cannot see more than the whole of another{more}"))
            .help("check the value, and that the view factor precedes the clearance");
    }
    for (item, emissivity) in emissivities(context).into_iter().filter(|(_, emissivity)| *emissivity > 1.0) {
        report
            .at(item, format!("emissivity {} is above 1", number(emissivity)))
            .label("should be from 0 to 1")
            .note("no surface radiates more than a black body")
            .help("check the value; the first row holds the emissivities of both surfaces");
    }
}
