//! Times and errors of every mode.

use super::modes::{Copied, MODES, Mode, Prepared, share_of_copy};
use super::subjects::{Sample, Subject, WholeRow};
use crate::commands::tradeoff::front::front;
use crate::commands::tradeoff::rounds::least_times;
use inpact_evaluation::numbers::{CompensatedSum, Scaled, ulp};
use inpact_evaluation::table::ErrorBound;

/// Fewer rows are repeated, so that a run is long enough to be timed.
const LEAST_ROWS: usize = 1 << 16;

/// Measurements on a deck and its node table.
pub(super) struct Measured {
    /// Rows of the node table.
    pub(super) rows: u64,
    /// The sampling stride.
    pub(super) one_of: u64,
    pub(super) rounds: u32,
    /// The time of `eval` for a row in all.
    pub(super) whole: WholeRow,
    /// One for each table and, where there are several, one for all of them.
    pub(super) groups: Vec<Group>,
}

/// The modes on one table, or on all.
pub(super) struct Group {
    pub(super) name: String,
    /// Rows that reach it, and rows of one run, which repeats them.
    pub(super) rows: usize,
    pub(super) rows_of_a_run: usize,
    /// Rows of the table itself; of all tables together.
    pub(super) table_rows: usize,
    /// The time that a copy takes to move the coordinates and the value of a row, in ns.
    pub(super) copy: f64,
    pub(super) entries: Vec<Entry>,
    /// The modes that do not support the table, and why.
    pub(super) refused: Vec<(&'static str, String)>,
}

/// One mode on one table, or on all.
#[derive(Clone)]
pub(super) struct Entry {
    pub(super) mode: &'static str,
    /// The form of the table; of all tables together, nothing.
    pub(super) form: String,
    /// The least time of a row, in ns.
    pub(super) time: f64,
    pub(super) errors: Errors,
    /// The error bound.
    pub(super) bound: ErrorBound,
    /// Read and written for a row.
    pub(super) bytes: f64,
    /// It is on the Pareto front: no other mode is as fast and as accurate, and better in one of the two.
    pub(super) on_front: bool,
}

/// Differences from the exact value.
#[derive(Clone, Copy, Default)]
pub(super) struct Errors {
    /// Relative to the largest value of the table.
    pub(super) largest: f64,
    pub(super) rms: f64,
    /// The largest relative to the exact value of its row.
    pub(super) pointwise: f64,
    /// In units in the last place of the exact value.
    pub(super) largest_ulp: f64,
    pub(super) rms_ulp: f64,
}

/// Times every mode on every table in interleaved rounds, then computes its errors.
pub(super) fn measure(sample: &Sample, rounds: u32) -> Measured {
    let repeated: Vec<Subject> = sample.subjects.iter().map(repeated).collect();
    let mut groups: Vec<Group> =
        sample.subjects.iter().zip(&repeated).map(|(subject, repeated)| group(subject, repeated, rounds)).collect();
    if groups.len() > 1 {
        groups.push(all_of(&groups));
    }
    for group in &mut groups {
        mark_front(&mut group.entries);
    }
    Measured { rows: sample.rows, one_of: sample.one_of, rounds, whole: sample.whole, groups }
}

/// The same rows over and over, until there are enough.
fn repeated(subject: &Subject) -> Subject {
    let times = LEAST_ROWS.div_ceil(subject.rows());
    let columns = subject.columns.iter().map(|column| column.repeat(times)).collect();
    Subject { name: subject.name.clone(), table: subject.table.clone(), columns }
}

fn group(subject: &Subject, repeated: &Subject, rounds: u32) -> Group {
    let mut modes: Vec<(&Mode, Prepared<'_>)> = Vec::new();
    let mut refused = Vec::new();
    for mode in MODES {
        match (mode.of)(repeated) {
            Ok(prepared) => modes.push((mode, prepared)),
            Err(reason) => refused.push((mode.name, reason)),
        }
    }
    let mut copied = Copied::new(repeated);
    let rows = repeated.rows();
    let mut runs: Vec<Box<dyn FnMut() + '_>> = vec![Box::new(|| copied.run())];
    for (_, prepared) in &mut modes {
        runs.push(Box::new(|| prepared.run()));
    }
    // The first round warms caches and is not counted.
    least_times(1, &mut runs);
    let times: Vec<f64> = least_times(rounds, &mut runs).iter().map(|time| time * 1e9 / rows as f64).collect();
    drop(runs);
    let entries = modes.into_iter().zip(&times[1..]).map(|((mode, prepared), &time)| Entry {
        mode: mode.name,
        time,
        errors: errors(subject, &prepared),
        form: prepared.form,
        bound: prepared.bound,
        bytes: (size_of::<f64>() * (repeated.axes() + 1)) as f64,
        on_front: false,
    });
    Group {
        name: subject.name.clone(),
        rows: subject.rows(),
        rows_of_a_run: rows,
        table_rows: subject.table.row_count(),
        copy: times[0] * share_of_copy(repeated),
        entries: entries.collect(),
        refused,
    }
}

/// The errors over the rows of a subject, which the rows of a run begin with.
fn errors(subject: &Subject, prepared: &Prepared<'_>) -> Errors {
    let greatest = subject.table.values().iter().fold(0.0, |greatest: f64, value| greatest.max(value.abs()));
    let mut errors = Errors::default();
    let (mut squares, mut ulp_squares) = (CompensatedSum::default(), CompensatedSum::default());
    let mut point = vec![f64::NAN; subject.columns.len()];
    let mut rows = 0;
    for row in 0..subject.rows() {
        for (axis, coordinate) in point.iter_mut().enumerate() {
            *coordinate = prepared.coordinate(axis, row);
        }
        let value = prepared.value(row);
        let Some(exact) = subject.table.reference_at(point[0], &point[1..]) else { continue };
        let error = if value.is_finite() { (Scaled::new(value) + -exact).to_f64().abs() } else { f64::INFINITY };
        let part = if error == 0.0 { 0.0 } else { error / greatest };
        let rounded = exact.to_f64();
        let ulps = error / ulp(rounded);
        if error > 0.0 {
            errors.pointwise = errors.pointwise.max(error / rounded.abs().max(f64::MIN_POSITIVE));
        }
        errors.largest = errors.largest.max(part);
        errors.largest_ulp = errors.largest_ulp.max(ulps);
        squares.add(part * part);
        ulp_squares.add(ulps * ulps);
        rows += 1;
    }
    if rows > 0 {
        errors.rms = (squares.total() / f64::from(rows)).sqrt();
        errors.rms_ulp = (ulp_squares.total() / f64::from(rows)).sqrt();
    }
    errors
}

/// The modes over all tables, each row in its own; a table that a mode does not support is evaluated in `full`.
fn all_of(groups: &[Group]) -> Group {
    let rows: usize = groups.iter().map(|group| group.rows).sum();
    let share = |group: &Group| group.rows as f64 / rows as f64;
    let entries = MODES.iter().filter_map(|mode| {
        let named = |group: &Group, name| group.entries.iter().find(|entry| entry.mode == name).cloned();
        let serves_any = groups.iter().any(|group| named(group, mode.name).is_some());
        let of_groups = groups
            .iter()
            .filter_map(|group| Some((share(group), named(group, mode.name).or_else(|| named(group, "full"))?)));
        let of_groups: Vec<(f64, Entry)> = of_groups.collect();
        let mean = |of: fn(&Entry) -> f64| of_groups.iter().map(|(share, entry)| share * of(entry)).sum::<f64>();
        let largest = |of: fn(&Entry) -> f64| of_groups.iter().map(|(_, entry)| of(entry)).fold(0.0, f64::max);
        serves_any.then(|| Entry {
            mode: mode.name,
            form: String::new(),
            time: mean(|entry| entry.time),
            errors: Errors {
                largest: largest(|entry| entry.errors.largest),
                rms: mean(|entry| entry.errors.rms.powi(2)).sqrt(),
                pointwise: largest(|entry| entry.errors.pointwise),
                largest_ulp: largest(|entry| entry.errors.largest_ulp),
                rms_ulp: mean(|entry| entry.errors.rms_ulp.powi(2)).sqrt(),
            },
            bound: ErrorBound {
                absolute: largest(|entry| entry.bound.absolute),
                relative_to_largest: largest(|entry| entry.bound.relative_to_largest),
                pointwise: largest(|entry| entry.bound.pointwise),
            },
            bytes: mean(|entry| entry.bytes),
            on_front: false,
        })
    });
    Group {
        name: "all tables".to_owned(),
        rows,
        rows_of_a_run: groups.iter().map(|group| group.rows_of_a_run).sum(),
        table_rows: groups.iter().map(|group| group.table_rows).sum(),
        copy: groups.iter().map(|group| share(group) * group.copy).sum(),
        entries: entries.collect(),
        refused: Vec::new(),
    }
}

fn mark_front(entries: &mut [Entry]) {
    let places: Vec<(f64, f64)> = entries.iter().map(|entry| (entry.time, entry.errors.largest)).collect();
    for (entry, on_front) in entries.iter_mut().zip(front(&places)) {
        entry.on_front = on_front;
    }
}
