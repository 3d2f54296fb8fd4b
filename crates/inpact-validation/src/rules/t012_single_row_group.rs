//! T012: values of a field variable with one row.

use crate::quantity::{and_more, column_words, number};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::{Arranged, RADIATION, sound_tables};
use inpact_parser::model::Table;

declare_rule! {
    /// A table that depends on field variables has a single row for one of their values.
    ///
    /// ## Why
    /// The manual asks for two or more rows for every value of a field variable (Analysis User's Guide 37.2.1, 37.4.1).
    /// From one row the law is a constant in clearance, pressure and temperature at that value, which is seldom meant.
    ///
    /// ## What to do
    /// Add the rows that are missing; for a constant repeat the value at a second clearance or pressure.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1
    /// 1.E6, 0.,   , 0.8
    /// 3.E7, 1.E7, , 0.8
    /// 5.E5, 0.,   , 3.2
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1
    /// 1.E6, 0.,   , 0.8
    /// 3.E7, 1.E7, , 0.8
    /// 5.E5, 0.,   , 3.2
    /// 5.E5, 1.E7, , 3.2
    /// ```
    "T012", "single-row-group", Warning, fix: None, source: "T-11, P-35"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let with_fields = |table: &Table| table.dependencies() > 0 && table.row_count() > 1;
    for of in sound_tables(context).filter(|of| of.keyword != RADIATION && with_fields(of.table)) {
        let table = of.table;
        let fields = table.width() - table.dependencies();
        let Some(arranged) = Arranged::new(table) else { continue };
        let (mut first, mut alone) = (None, 0);
        let mut start = 0;
        for place in 1..=table.row_count() {
            let ends = place == table.row_count() || arranged.row(place)[fields..] != arranged.row(start)[fields..];
            if ends && place - start == 1 {
                first.get_or_insert(start);
                alone += 1;
            }
            if ends {
                start = place;
            }
        }
        let Some(place) = first else { continue };
        let values = table.columns[fields..].iter().zip(&arranged.row(place)[fields..]);
        let values: Vec<String> =
            values.map(|(column, value)| format!("{} = {}", column_words(column), number(*value))).collect();
        let more = and_more(alone - 1, "value has one row", "values have one row");
        report
            .at(table.row_span(arranged.index(place)), format!("one row for {}", values.join(", ")))
            .label("the only row for these values")
            .also(context.trimmed(table.keyword), "the table of this option")
            .note(format!("every value of a field variable needs two or more rows{more}"))
            .help("add a row for another clearance or pressure at the same values");
    }
}
