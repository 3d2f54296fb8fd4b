//! T001: rows whose first independent variable falls inside a group.

use inpact_diagnostics::FixSafety;
use crate::order::{falls, sort_edits};
use crate::quantity::{and_more, column_name, number};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::sound_tables;

declare_rule! {
    /// The first independent variable of a table falls from one row to the next.
    ///
    /// The second item of a row is the variable that runs fastest: the clearance or the contact pressure.
    /// It must increase from row to row as long as the temperature and the field variables stay the same.
    ///
    /// ## Why
    /// Abaqus interpolates between neighbouring rows and refuses a table that is not in ascending order.
    ///
    /// ## What to do
    /// Put the rows in order.
    /// The fix sorts all rows of the table; comments between them stay where they are.
    /// It is offered where that mends the table: not when two rows agree in all their variables, which mostly means that a column is missing.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    ///  1.E6, 0.
    ///  5.E7, 2.E7
    /// ** measured later
    ///  3.E7, 1.E7
    ///  8.E7, 4.E7
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    ///  1.E6, 0.
    ///  3.E7, 1.E7
    /// ** measured later
    ///  5.E7, 2.E7
    ///  8.E7, 4.E7
    /// ```
    ///
    /// The rows of one group agree in all further variables; a row that goes over two lines moves as one.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=SWITCH
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=6
    /// 5.E6, 0., 20., 0., 0.1, 8., 1., 0.5
    /// 0.
    /// 9.E7, 4.E7, 20., 0., 0.1, 8., 1., 0.5
    /// 0.
    /// 8.E7, 1.E7, 20., 0., 0.1, 8., 1., 0.5
    /// 0.
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=SWITCH
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=6
    /// 5.E6, 0., 20., 0., 0.1, 8., 1., 0.5
    /// 0.
    /// 8.E7, 1.E7, 20., 0., 0.1, 8., 1., 0.5
    /// 0.
    /// 9.E7, 4.E7, 20., 0., 0.1, 8., 1., 0.5
    /// 0.
    /// ```
    ///
    /// A new group begins again at zero:
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.,   300.
    /// 3.E7, 1.E7, 300.
    /// 1.E6, 0.,   400.
    /// 2.E7, 1.E7, 400.
    /// ```
    "T001", "not-ascending", Error, fix: ChangesMeaning, source: "T-01, T-02, T-08, T-09"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for of in sound_tables(context) {
        let table = of.table;
        let Some(fall) = falls(table, |column| column == 1) else { continue };
        let (value, before) = (table.row(fall.row)[1], table.row(fall.before)[1]);
        let name = column_name(&table.columns[1]);
        let message = format!("{name} {} falls below {} of the row before", number(value), number(before));
        // Of a finding that is only counted nobody sees the fix.
        let edits = if report.is_full() { None } else { sort_edits(context, table) };
        let found = report
            .at(context.cell(of, fall.row, 1), message)
            .label("should be greater than the value before")
            .also(context.cell(of, fall.before, 1), "the row before");
        let more = and_more(fall.count - 1, "row of this table falls", "rows of this table fall");
        found.note(format!("within a group the rows must be in ascending order of the {name}{more}"));
        match edits {
            Some(edits) => {
                let help = "put the rows in ascending order";
                found.help(help).fix(FixSafety::ChangesMeaning, "sort the rows of the table", edits);
            }
            None if value == table.row(0)[1] && table.row_count() > 2 => {
                found.help(
                    "if a new group begins here, tell it from the one before by the temperature or a field variable",
                );
            }
            None => {
                found.help("put the rows in ascending order");
            }
        }
    }
}
