//! Order and groups of the rows of a table (T-01 to T-11).
//!
//! A row with a cell that is not a number (a parameter without a value, something malformed) is skipped: it has a finding
//! of its own, and its other cells may be misread. A subset of the rows of an ascending table
//! ascends as well.

use crate::rule::Context;
use inpact_diagnostics::Edit;
use inpact_parser::model::Table;
use std::cmp::Ordering;
use std::ops::Range;

/// The descents in a table that should ascend.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Falls {
    /// The row before the first fall.
    pub(crate) before: usize,
    /// The row in which the value is lower.
    pub(crate) row: usize,
    /// The column of the value.
    pub(crate) column: usize,
    /// The number of rows that fall.
    pub(crate) count: usize,
}

/// Rows that agree in all independent variables but the first.
#[derive(Debug, Clone)]
pub(crate) struct Group {
    /// The rows, some of which may be skipped.
    pub(crate) rows: Range<usize>,
    /// No row is skipped and none descends: the group can be checked as a curve.
    pub(crate) is_curve: bool,
    /// The group is known to start with its first row: no skipped row precedes it, and none
    /// after it is lower.
    pub(crate) start_is_known: bool,
}

/// Finds the descents of a table in the given columns: the first of them and their number.
///
/// A table that is out of order in many places has one finding.
pub(crate) fn falls(table: &Table, is_meant: impl Fn(usize) -> bool) -> Option<Falls> {
    let mut falls = None;
    for (before, row, ordering, column) in steps(table) {
        if ordering.is_lt() && is_meant(column) {
            falls.get_or_insert(Falls { before, row, column, count: 0 }).count += 1;
        }
    }
    falls
}

/// The steps between rows that are not skipped: both rows, their order, and the column in which they differ.
pub(crate) fn steps(table: &Table) -> impl Iterator<Item = (usize, usize, Ordering, usize)> {
    let mut before = None;
    table.row_values().enumerate().filter(|(_, row)| takes_part(row)).filter_map(move |(index, row)| {
        let (earlier, values) = before.replace((index, row))?;
        let (ordering, column) = step(values, row);
        Some((earlier, index, ordering, column))
    })
}

/// The order of a row after the previous one: by the slowest independent variable in which they differ (T-02, T-09).
///
/// `Equal` is always that of column 1.
pub(crate) fn step(before: &[f64], row: &[f64]) -> (Ordering, usize) {
    for column in (1..row.len()).rev() {
        match row[column].partial_cmp(&before[column]) {
            Some(Ordering::Equal) | None => {}
            Some(ordering) => return (ordering, column),
        }
    }
    (Ordering::Equal, 1)
}

fn takes_part(row: &[f64]) -> bool {
    !row.iter().any(|value| value.is_nan())
}

/// Whether every row is in the group it is meant for: each has all its numbers, and no outer variable falls.
pub(crate) fn has_clear_groups(table: &Table) -> bool {
    !table.values.iter().any(|value| value.is_nan()) && falls(table, |column| column > 1).is_none()
}

/// The groups of a table; none where an outer variable descends, since then the grouping is unknown (T003).
pub(crate) fn groups(table: &Table) -> impl Iterator<Item = Group> {
    let count = if falls(table, |column| column > 1).is_some() { 0 } else { table.row_count() };
    let mut next = 0;
    // A skipped row between two groups may belong to either.
    let mut gap = false;
    std::iter::from_fn(move || {
        while next < count && !takes_part(table.row(next)) {
            gap = true;
            next += 1;
        }
        if next == count {
            return None;
        }
        let first = next;
        let mut group = Group { rows: first..first + 1, is_curve: !gap, start_is_known: !gap };
        let mut last = first;
        gap = false;
        next += 1;
        while next < count {
            let row = table.row(next);
            if !takes_part(row) {
                gap = true;
            } else if row[2..] == table.row(first)[2..] {
                group.is_curve &= !gap && row[1] >= table.row(last)[1];
                group.start_is_known &= row[1] >= table.row(first)[1];
                group.rows.end = next + 1;
                last = next;
                gap = false;
            } else {
                break;
            }
            next += 1;
        }
        group.is_curve &= !gap;
        Some(group)
    })
}

/// The groups that can be checked as curves.
pub(crate) fn curves(table: &Table) -> impl Iterator<Item = Range<usize>> {
    groups(table).filter(|group| group.is_curve).map(|group| group.rows)
}

/// The rows with which groups start, where that is known.
///
/// The only row for a value of the field variables is left out: T012 reports it.
pub(crate) fn starts(table: &Table) -> impl Iterator<Item = usize> {
    let known = groups(table).filter(|group| group.start_is_known).map(|group| group.rows.start);
    known.filter(|row| table.row_count() == 1 || !is_alone(table, *row))
}

/// Whether the row is the only one for its field variables.
pub(crate) fn is_alone(table: &Table, row: usize) -> bool {
    let first_field = table.width() - table.dependencies();
    let fields = |row: usize| &table.row(row)[first_field..];
    let differs = |other: usize| fields(other) != fields(row);
    first_field < table.width()
        && row.checked_sub(1).is_none_or(differs)
        && (row + 1 == table.row_count() || differs(row + 1))
}

/// The edits that put the rows of a table in order, each row whole; comments between rows stay in their places.
///
/// `None` where sorting does not mend the table: a cell is not a number, or rows agree in all independent variables.
pub(crate) fn sort_edits(context: &Context<'_>, table: &Table) -> Option<Vec<Edit>> {
    if !table.row_values().all(takes_part) {
        return None;
    }
    let mut order: Vec<usize> = (0..table.row_count()).collect();
    order.sort_by(|a, b| step(table.row(*b), table.row(*a)).0);
    let repeats = order.windows(2).any(|pair| step(table.row(pair[0]), table.row(pair[1])).0.is_eq());
    let source = table.keyword.source();
    if repeats || table.row_spans().len() != order.len() || table.row_spans().any(|row| row.source() != source) {
        return None;
    }
    let moved = order.iter().enumerate().filter(|(place, row)| place != *row);
    Some(moved.map(|(place, row)| Edit::new(table.row_span(place), context.deck.text(table.row_span(*row)))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rows: &[[f64; 3]]) -> Table {
        let columns = ["conductance", "clearance", "temp"].map(str::to_owned).to_vec();
        Table { columns: columns.into(), values: rows.concat().into(), ..Table::default() }
    }

    /// The groups as `first..end`, with `~` after those that are no curve and `?` before those with an unknown start.
    fn shown(rows: &[[f64; 3]]) -> String {
        let table = table(rows);
        let groups = groups(&table).map(|group| {
            let start = if group.start_is_known { "" } else { "?" };
            let curve = if group.is_curve { "" } else { "~" };
            format!("{start}{}..{}{curve}", group.rows.start, group.rows.end)
        });
        groups.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_step_is_judged_by_the_slowest_variable_that_differs() {
        assert_eq!(step(&[1.0, 0.5, 300.0], &[1.0, 0.0, 400.0]), (Ordering::Greater, 2));
        assert_eq!(step(&[1.0, 0.0, 400.0], &[1.0, 0.5, 300.0]), (Ordering::Less, 2));
        assert_eq!(step(&[1.0, 0.5, 300.0], &[1.0, 0.0, 300.0]), (Ordering::Less, 1));
        assert_eq!(step(&[1.0, 0.5, 300.0], &[2.0, 0.5, 300.0]), (Ordering::Equal, 1));
        // A middle variable begins anew when a slower one grows (T-09).
        assert_eq!(step(&[1.0, 0.5, 400.0, 1.0], &[1.0, 0.0, 300.0, 2.0]), (Ordering::Greater, 3));
    }

    #[test]
    fn rows_are_grouped_by_the_outer_variables() {
        assert_eq!(shown(&[[3.0, 0.0, 300.0], [2.0, 1.0, 300.0], [4.0, 0.0, 400.0]]), "0..2 2..3");
        // A fall inside a group, after its first row and below it.
        assert_eq!(shown(&[[3.0, 0.0, 300.0], [2.0, 2.0, 300.0], [1.0, 1.0, 300.0]]), "0..3~");
        assert_eq!(shown(&[[3.0, 1.0, 300.0], [2.0, 0.0, 300.0], [4.0, 0.0, 400.0]]), "?0..2~ 2..3");
        // An outer variable that falls leaves no group.
        assert_eq!(shown(&[[3.0, 0.0, 300.0], [4.0, 0.0, 200.0]]), "");
        assert_eq!(shown(&[]), "");
    }

    #[test]
    fn rows_without_a_number_take_no_part() {
        let unknown = [2.0, f64::NAN, 300.0];
        assert_eq!(shown(&[[3.0, 0.0, 300.0], unknown, [1.0, 2.0, 300.0], [4.0, 0.0, 400.0]]), "0..3~ 3..4");
        // Between two groups a row may belong to either.
        assert_eq!(shown(&[[3.0, 0.0, 300.0], unknown, [4.0, 0.0, 400.0]]), "0..1~ ?2..3~");
        assert_eq!(shown(&[unknown, [3.0, 0.0, 300.0]]), "?1..2~");
        assert_eq!(shown(&[unknown]), "");
        let steps: Vec<_> = steps(&table(&[[3.0, 1.0, 300.0], unknown, [4.0, 0.0, 300.0]])).collect();
        assert_eq!(steps, [(0, 2, Ordering::Less, 1)]);
    }
}
