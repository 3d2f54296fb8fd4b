//! T012: values of a field variable with one row.

use super::t008_too_few_rows::is_thermal_clearance;
use crate::order::{has_clear_groups, is_alone};
use crate::quantity::{and_more, values_of_row};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::sound_tables;
use inpact_parser::model::Table;

declare_rule! {
    /// A table that depends on field variables has a single row for one of their values.
    ///
    /// ## Why
    /// The manual requires two or more rows for every value of a field variable (Analysis User's Guide 37.2.1, 37.4.1).
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
    // Of a thermal conductance against clearance that is an error: T008.
    for of in sound_tables(context).filter(|of| with_fields(of.table) && !is_thermal_clearance(*of)) {
        let table = of.table;
        // A row that takes no part may be the second one (S006), and out of order it may occur elsewhere (T003).
        let is_clear = has_clear_groups(table);
        let mut alone = (0..table.row_count()).filter(|row| is_clear && is_alone(table, *row));
        let Some(row) = alone.next() else { continue };
        let fields = table.width() - table.dependencies();
        let more = and_more(alone.count(), "value has one row", "values have one row");
        report
            .at(table.row_span(row), format!("one row for {}", values_of_row(table, row, fields)))
            .label("the only row for these values")
            .also(context.trimmed(table.keyword), "the table of this option")
            .note(format!("every value of a field variable needs two or more rows{more}"))
            .help("add a row for another clearance or pressure at the same values");
    }
}
