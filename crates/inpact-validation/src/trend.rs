//! Trend of the value of a conductance table along its first independent variable, for P005 and P006.

use crate::order::curves;
use crate::quantity::{number, value_name};
use crate::rule::{Context, Report};
use crate::tables::{is_written, sound_tables, starts_as_it_must};
use inpact_diagnostics::Diagnostic;
use inpact_parser::model::{TableKind, TableOf};
use std::ops::Range;

/// The first step in the wrong direction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Trend {
    /// The row before.
    pub(crate) before: usize,
    /// The row that goes the wrong way.
    pub(crate) row: usize,
    /// The number of steps in the wrong direction.
    pub(crate) wrong: usize,
    /// The number of steps.
    pub(crate) total: usize,
}

impl Trend {
    /// Reports the step: `conductance rises from 1 to 2 as the clearance grows from 0 to 0.1`.
    pub(crate) fn report<'r>(
        &self,
        context: &Context<'_>,
        report: &'r mut Report<'_>,
        of: TableOf<'_>,
        [goes, as_axis_goes]: [&str; 2],
    ) -> &'r mut Diagnostic {
        let [before, row] = [self.before, self.row].map(|row| of.table.row(row));
        let [[from, to], [start, end]] = [0, 1].map(|column| [before, row].map(|row| number(row[column])));
        let name = value_name(of.kind);
        let message = format!("{name} {goes} from {from} to {to} as {as_axis_goes} from {start} to {end}");
        report.at(context.cell(of, self.row, 0), message)
    }

    /// The help: a table whose every step goes the wrong way may be of the other kind.
    pub(crate) fn help(&self, of_other_kind: &'static str) -> &'static str {
        if self.wrong == self.total { of_other_kind } else { "check the values" }
    }
}

/// The tables of a kind in which some step inside a group `is_wrong`, with the first such step.
///
/// Negative values and empty ones have findings of their own and are skipped.
pub(crate) fn against<'a>(
    context: &'a Context<'_>,
    is_meant: impl Fn(TableKind) -> bool,
    is_wrong: impl Fn(f64, f64) -> bool,
) -> impl Iterator<Item = (TableOf<'a>, Trend)> {
    sound_tables(context).filter(move |of| is_meant(of.kind)).filter_map(move |of| {
        let table = of.table;
        let mut trend = None;
        let (mut wrong, mut total) = (0, 0);
        // A group that starts where it must not may be one of the other kind (T004): it is judged by its values no further.
        let starts_well = |rows: &Range<usize>| starts_as_it_must(of, table.row(rows.start)[1]);
        for rows in curves(table).filter(|rows| !of.kind.is_against_clearance() || starts_well(rows)) {
            for index in rows.skip(1) {
                let (before, row) = (table.row(index - 1), table.row(index));
                if row[1] == before[1] || row[0] < 0.0 || before[0] < 0.0 {
                    continue;
                }
                total += 1;
                let written = |index: usize| is_written(context, of, index, 0);
                if is_wrong(before[0], row[0]) && written(index) && written(index - 1) {
                    wrong += 1;
                    trend.get_or_insert((index - 1, index));
                }
            }
        }
        let (before, row) = trend?;
        Some((of, Trend { before, row, wrong, total }))
    })
}
