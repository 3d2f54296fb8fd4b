//! P007: clearance and pressure tables that are far apart at the moment of contact.

use crate::order::{curves, step};
use crate::quantity::{group_label, number, value_name};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::sound_tables;
use inpact_parser::model::{Interaction, Table, TableKind, TableOf};
use std::cmp::Ordering;
use std::ops::Range;

declare_rule! {
    /// The table against clearance and the one against contact pressure differ by more than a factor of ten where they meet.
    ///
    /// They meet at the moment of contact: at clearance zero and pressure zero.
    ///
    /// ## Why
    /// A jump there is legal: once the surfaces touch, the pressure table holds (Analysis User's Guide 37.3.1).
    /// But a large one makes a solver converge badly, since every node that opens or closes changes the law by it, and it may come from units that differ between the two tables.
    ///
    /// ## What to do
    /// Nothing, if the jump is meant.
    /// Otherwise give both tables the same value at zero.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0.,  0.1
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 5000., 0.
    /// 6500., 100.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0.,  0.1
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 50., 0.
    /// 65., 100.
    /// ```
    "P007", "jump-at-contact", Note, fix: None, source: "4.2, T-21"
}

/// The largest ratio of the two values.
const FACTOR: f64 = 10.0;

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let mut tables = sound_tables(context).filter(|of| of.interaction.is_some()).peekable();
    while let Some(first) = tables.next() {
        let mut of_interaction = vec![first];
        of_interaction.extend(std::iter::from_fn(|| tables.next_if(|of| is_same(of.interaction, first.interaction))));
        let of_kind = |kind: TableKind| of_interaction.iter().copied().rfind(|of| of.kind == kind);
        let branches = [
            (TableKind::ElectricalClearance, TableKind::ElectricalPressure),
            (TableKind::ThermalClearance, TableKind::ThermalPressure),
        ];
        for (clearance, pressure) in branches {
            if let (Some(clearance), Some(pressure)) = (of_kind(clearance), of_kind(pressure)) {
                check_branches(context, report, clearance, pressure);
            }
        }
    }
}

fn is_same(a: Option<&Interaction>, b: Option<&Interaction>) -> bool {
    a.zip(b).is_some_and(|(a, b)| std::ptr::eq(a, b))
}

/// Reports the first group in which the branches are far apart.
fn check_branches(context: &Context<'_>, report: &mut Report<'_>, clearance: TableOf<'_>, pressure: TableOf<'_>) {
    let (open, closed) = (clearance.table, pressure.table);
    let jump = groups_in_both(open, closed).find_map(|(open_rows, closed_rows)| {
        let at_zero = open.row(open_rows.start);
        let (row, on_closing) = value_at_zero_pressure(closed, closed_rows)?;
        let (lower, higher) = (at_zero[0].min(on_closing), at_zero[0].max(on_closing));
        let is_jump = at_zero[1] == 0.0 && lower >= 0.0 && higher > FACTOR * lower;
        is_jump.then_some((open_rows.start, at_zero[0], row, on_closing))
    });
    let Some((open_row, before, closed_row, after)) = jump else { return };
    let name = value_name(clearance.kind);
    let group = group_label(open, open.row(open_row));
    report
        .at(
            context.cell(pressure, closed_row, 0),
            format!("{name} jumps from {} to {} at contact{group}", number(before), number(after)),
        )
        .label("at contact pressure 0")
        .also(context.cell(clearance, open_row, 0), "at clearance 0")
        .note("the jump is legal; one of more than a factor of ten may come from units, and converges badly")
        .help("give both tables the same value at 0 if no jump is meant");
}

/// The groups of both tables that belong together: those with the same outer variables.
fn groups_in_both<'a>(open: &'a Table, closed: &'a Table) -> impl Iterator<Item = (Range<usize>, Range<usize>)> + 'a {
    let mut open_groups = curves(open).peekable();
    let mut closed_groups = curves(closed).peekable();
    let comparable = open.columns[2..] == closed.columns[2..];
    std::iter::from_fn(move || {
        loop {
            let (a, b) = (open_groups.peek()?.clone(), closed_groups.peek()?.clone());
            let ordering = if comparable {
                step(&closed.row(b.start)[1..], &open.row(a.start)[1..]).0
            } else {
                // One of the laws depends on more than the other: only two plain tables can be seen to meet.
                Ordering::Equal
            };
            match ordering {
                Ordering::Less => drop(open_groups.next()),
                Ordering::Greater => drop(closed_groups.next()),
                Ordering::Equal => {
                    let pair = (open_groups.next()?, closed_groups.next()?);
                    let is_only = open_groups.peek().is_none() && closed_groups.peek().is_none();
                    return (comparable || is_only).then_some(pair);
                }
            }
        }
    })
}

/// The value on closing, and a row of it: at zero pressure, or at the highest pressure where all are negative.
///
/// `None` where the table starts above zero (T005).
fn value_at_zero_pressure(closed: &Table, rows: Range<usize>) -> Option<(usize, f64)> {
    let Some(row) = rows.clone().find(|row| closed.row(*row)[1] >= 0.0) else {
        return Some((rows.end - 1, closed.row(rows.end - 1)[0]));
    };
    let above = closed.row(row);
    if above[1] == 0.0 {
        return Some((row, above[0]));
    }
    if row == rows.start {
        return None;
    }
    let below = closed.row(row - 1);
    let share = -below[1] / (above[1] - below[1]);
    Some((row, below[0] + share * (above[0] - below[0])))
}
