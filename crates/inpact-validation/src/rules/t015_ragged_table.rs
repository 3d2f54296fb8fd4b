//! T015: groups that have their own abscissae.

use crate::quantity::{and_more, column_words, group_words};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::{Arranged, sound_tables, starts_as_it_must};
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
        let Some(arranged) = Arranged::in_order(table) else { continue };
        // A field value with a single row is what T012 is about, a wrong start T004 and T005.
        let is_meant = |places: &Range<usize>| {
            (places.len() > 1 || table.dependencies() == 0) && starts_as_it_must(of, arranged.row(places.start)[1])
        };
        let mut groups = arranged.complete_groups().filter(is_meant);
        let Some(first) = groups.next() else { continue };
        let mut others = groups.filter(|other| !abscissae(&arranged, other).eq(abscissae(&arranged, &first)));
        let Some(other) = others.next() else { continue };
        let row = arranged.row(other.start);
        let name = column_words(&table.columns[1]);
        let message = format!("the group{} has its own values of the {name}", group_words(table, row));
        let more = and_more(others.count(), "group differs from the first", "groups differ from the first");
        report
            .at(table.row_span(arranged.index(other.start)), message)
            .label("this group begins here")
            .also(table.row_span(arranged.index(first.start)), "the first group begins here")
            .note(format!("each group is interpolated at its own values, then the groups among each other{more}"));
    }
}

/// The values of the first independent variable in a group, each once: what stands twice is T002.
fn abscissae<'a>(arranged: &'a Arranged<'_>, places: &Range<usize>) -> impl Iterator<Item = f64> + 'a {
    let mut before = f64::NAN;
    let values = places.clone().map(|place| arranged.row(place)[1]);
    values.filter(move |value| std::mem::replace(&mut before, *value) != *value)
}
