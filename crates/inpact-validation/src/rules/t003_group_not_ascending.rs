//! T003: groups of rows in other than ascending order.

use inpact_diagnostics::FixSafety;
use crate::order::{falls, sort_edits};
use crate::quantity::{and_more, column_name, number};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::{is_written, sound_tables};

declare_rule! {
    /// A temperature, a field variable or another outer variable of a table falls from one row to the next.
    ///
    /// After the clearance or pressure come the outer variables, each slower than the one before it.
    /// A new group of rows begins when one of them increases; a faster one may then begin anew, the slowest may never fall.
    ///
    /// ## Why
    /// Abaqus interpolates between neighbouring groups and refuses a table whose groups are not in ascending order.
    ///
    /// ## What to do
    /// Put the groups in order: the last column slowest, the second column fastest.
    /// The fix sorts all rows of the table; comments between them stay where they are.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.,   400.
    /// 2.E7, 1.E7, 400.
    /// 1.E6, 0.,   300.
    /// 3.E7, 1.E7, 300.
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.,   300.
    /// 3.E7, 1.E7, 300.
    /// 1.E6, 0.,   400.
    /// 2.E7, 1.E7, 400.
    /// ```
    ///
    /// The temperature begins anew with each value of the field variable:
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1
    /// 1.E6, 0.,   300., 1.
    /// 3.E7, 1.E7, 300., 1.
    /// 1.E6, 0.,   400., 1.
    /// 2.E7, 1.E7, 400., 1.
    /// 2.E6, 0.,   300., 2.
    /// 6.E7, 1.E7, 300., 2.
    /// ```
    "T003", "group-not-ascending", Error, fix: ChangesMeaning, source: "T-02, T-03, T-09"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for of in sound_tables(context) {
        let table = of.table;
        let Some(fall) = falls(table, |column| column > 1) else { continue };
        let (value, before) = (table.row(fall.row)[fall.column], table.row(fall.before)[fall.column]);
        let name = column_name(&table.columns[fall.column]);
        let empty = !is_written(context, of, fall.row, fall.column);
        let reads_as = if empty { " (an empty item)" } else { "" };
        let message = format!("{name} {}{reads_as} falls below {} of the row before", number(value), number(before));
        // Of a finding that is only counted nobody sees the fix.
        let edits = if report.is_full() { None } else { sort_edits(context, table) };
        let found = report
            .at(context.cell(of, fall.row, fall.column), message)
            .label(if empty { "left empty, which reads as 0" } else { "should not be less than the value before" })
            .also(context.cell(of, fall.before, fall.column), "the row before");
        let more = and_more(fall.count - 1, "row of this table falls", "rows of this table fall");
        found.note(format!("groups of rows must be in ascending order, the last column slowest{more}"));
        if empty {
            found.help(format!("give the {name} in every row"));
        } else {
            found.help("put the groups in ascending order");
        }
        if let Some(edits) = edits {
            found.fix(FixSafety::ChangesMeaning, "sort the rows of the table", edits);
        }
    }
}
