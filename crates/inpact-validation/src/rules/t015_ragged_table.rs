//! T015: groups that have their own abscissae.

use crate::order::{curves, is_alone};
use crate::quantity::{and_more, column_name, group_label};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::{sound_tables, starts_as_it_must};
use inpact_parser::model::Table;
use std::ops::Range;

declare_rule! {
    /// The groups of a table have different values of the first independent variable.
    ///
    /// ## Why
    /// Such a table is legal, but the manual does not spell out how it is interpolated.
    /// inpact takes each group at its own values first, constant outside of them, and then interpolates between the groups.
    ///
    /// ## What to do
    /// Nothing, if that is what you mean.
    /// Otherwise give every group the same clearances or pressures.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=BRUSH
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 10., 0., 300.
    /// 6.,  1., 300.
    /// 0.,  2., 300.
    /// 20., 0., 400.
    /// 0.,  4., 400.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=BRUSH
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 10., 0., 300.
    /// 0.,  2., 300.
    /// 20., 0., 400.
    /// 0.,  2., 400.
    /// ```
    "T015", "ragged-table", Note, fix: None, source: "T-05, T-06, T-07"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for of in sound_tables(context) {
        let table = of.table;
        // A field value with a single row is what T012 is about, a wrong start T004 and T005.
        if (0..table.row_count()).any(|row| is_alone(table, row)) {
            continue;
        }
        let mut groups = curves(table).filter(|rows| starts_as_it_must(of, table.row(rows.start)[1]));
        let Some(first) = groups.next() else { continue };
        let mut others = groups.filter(|other| !abscissae(table, other).eq(abscissae(table, &first)));
        let Some(other) = others.next() else { continue };
        let name = column_name(&table.columns[1]);
        let group = group_label(table, table.row(other.start));
        let more = and_more(others.count(), "group differs from the first", "groups differ from the first");
        report
            .at(table.row_span(other.start), format!("the group{group} has its own values of the {name}"))
            .label("this group begins here")
            .also(table.row_span(first.start), "the first group begins here")
            .note(format!("each group is interpolated at its own values, then the groups among each other{more}"));
    }
}

/// The values of the first independent variable in a group, each once: what occurs twice is T002.
fn abscissae<'a>(table: &'a Table, rows: &Range<usize>) -> impl Iterator<Item = f64> + 'a {
    let mut before = f64::NAN;
    let values = rows.clone().map(|row| table.row(row)[1]);
    values.filter(move |value| std::mem::replace(&mut before, *value) != *value)
}
