//! T002: rows that agree in all independent variables.

use crate::order::steps;
use crate::quantity::{column_name, group_label, number};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::sound_tables;

declare_rule! {
    /// Two rows that follow each other have the same values of all independent variables.
    ///
    /// ## Why
    /// The values must increase from row to row, so Abaqus refuses the table.
    /// A vertical jump cannot be written into a table: a law jumps only where contact closes, between the clearance table and the pressure table.
    ///
    /// ## What to do
    /// Take one of the rows out.
    /// For a steep change, move one of the two values a little.
    /// If the rows belong to different temperatures or field variables, give these in their columns.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 10., 0.1
    /// 5.,  0.10
    /// 0.,  0.2
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 10., 0.1
    /// 5.,  0.1001
    /// 0.,  0.2
    /// ```
    "T002", "duplicate-abscissa", Error, fix: None, source: "T-08, T-10"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for of in sound_tables(context) {
        let table = of.table;
        for (before, row, ordering, _) in steps(table).filter(|(_, _, ordering, _)| ordering.is_eq()) {
            debug_assert!(ordering.is_eq());
            let values = table.row(row);
            let name = column_name(&table.columns[1]);
            let message = format!("{name} {} occurs twice{}", number(values[1]), group_label(table, values));
            let found = report.at(context.cell(of, row, 1), message);
            found
                .label("the same value again")
                .also(context.cell(of, before, 1), "the value of the row before")
                .note("rows must be in strictly ascending order; a jump is possible only where contact closes")
                .help("take one of the two rows out, or correct its value");
        }
    }
}
