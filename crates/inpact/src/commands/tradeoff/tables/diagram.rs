//! The work–precision diagram: error against time, the Pareto front, the copy of the same columns.

use super::measure::Measured;
use super::report::{Names, how};
use crate::chart::{Chart, Point};
use crate::commands::tradeoff::LEAST_ERROR;
use crate::commands::tradeoff::cells::file_name;

/// The diagram of all tables together.
pub(super) fn chart(measured: &Measured, names: Names<'_>) -> Chart {
    let Some(group) = measured.groups.last() else { return Chart::default() };
    let points = group.entries.iter().map(|entry| Point {
        x: entry.time,
        y: entry.errors.largest.max(LEAST_ERROR),
        bar_to: Some(entry.bound.relative_to_largest.max(LEAST_ERROR)).filter(|bound| bound.is_finite()),
        label: format!("{}, {} ns, {:.0} B/row", entry.mode, short(entry.time), entry.bytes),
        on_front: entry.on_front,
    });
    Chart {
        title: format!("Work and precision of {}", file_name(names.deck)),
        subtitle: format!("{} on {}", group.name, file_name(names.nodes)),
        x_title: "time of a row, ns".to_owned(),
        y_title: "largest error / largest value of the table".to_owned(),
        points: points.collect(),
        vertical: vec![(group.copy, format!("roofline: copy of the columns, {} ns", short(group.copy)))],
        horizontal: vec![(f64::EPSILON / 2.0, "½ ulp of the largest value".to_owned())],
        footnote: format!("{}; bars go up to the error bound computed from the table", how(measured)),
    }
}

/// A time with about three digits.
fn short(time: f64) -> String {
    match time {
        ..10.0 => format!("{time:.2}"),
        ..100.0 => format!("{time:.1}"),
        _ => format!("{time:.0}"),
    }
}
