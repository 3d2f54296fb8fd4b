//! The modes that are measured: a list, each with how it evaluates a table, its bound and what it moves in memory.

use super::subjects::Subject;
use inpact_evaluation::accuracy::full_bound;
use std::hint::black_box;

/// A mode of evaluation.
pub(super) struct Mode {
    pub(super) name: &'static str,
    /// Makes it ready for a table; `None` where it does not serve that table.
    pub(super) of: for<'a> fn(&'a Subject) -> Option<Prepared<'a>>,
}

/// A mode made ready for a table and its rows.
pub(super) struct Prepared<'a> {
    pub(super) run: Box<dyn Run + 'a>,
    /// The largest error there can be, as a part of the largest value of the table.
    pub(super) bound: f64,
    /// What it reads and writes for a row, in bytes.
    pub(super) bytes: usize,
}

/// Something that can be timed, over all rows of its columns.
pub(super) trait Run {
    /// Evaluates every row.
    fn run(&mut self);

    /// The value of a row, from the run before.
    fn value(&self, row: usize) -> f64;
}

/// All modes, most exact first. The first is what the others are measured against.
pub(super) const MODES: &[Mode] = &[
    Mode {
        name: "reference",
        of: |subject| {
            let run = Scalar::new(subject, |first, others| subject.table.reference_value_at(first, others));
            Some(Prepared { run: Box::new(run), bound: REFERENCE_ULPS * f64::EPSILON, bytes: bytes(subject, 8) })
        },
    },
    Mode {
        name: "full",
        of: |subject| {
            let run = Scalar::new(subject, |first, others| subject.table.value_at(first, others));
            let bound = full_bound(&subject.table).relative_to_largest;
            Some(Prepared { run: Box::new(run), bound, bytes: bytes(subject, 8) })
        },
    },
];

/// The bound of `reference`, in ulp.
const REFERENCE_ULPS: f64 = 0.501;

/// What a mode reads and writes for a row with numbers of that size.
fn bytes(subject: &Subject, size: usize) -> usize {
    (subject.axes() + 1) * size
}

/// One row after the other.
struct Scalar<'a, F> {
    subject: &'a Subject,
    value: F,
    others: Vec<f64>,
    output: Vec<f64>,
}

impl<'a, F: Fn(f64, &[f64]) -> f64> Scalar<'a, F> {
    fn new(subject: &'a Subject, value: F) -> Self {
        let others = vec![f64::NAN; subject.columns.len().saturating_sub(1)];
        Self { subject, value, others, output: vec![0.0; subject.rows()] }
    }
}

impl<F: Fn(f64, &[f64]) -> f64> Run for Scalar<'_, F> {
    fn run(&mut self) {
        let Some((first, others)) = self.subject.columns.split_first() else { return };
        for (row, output) in self.output.iter_mut().enumerate() {
            for (coordinate, column) in self.others.iter_mut().zip(others) {
                *coordinate = column.get(row).copied().unwrap_or(f64::NAN);
            }
            *output = (self.value)(first.get(row).copied().unwrap_or(f64::NAN), &self.others);
        }
        black_box(&mut self.output);
    }

    fn value(&self, row: usize) -> f64 {
        self.output[row]
    }
}

/// A copy of the same columns: what any mode must move at least.
pub(super) struct Copied<'a> {
    subject: &'a Subject,
    output: Vec<f64>,
}

impl<'a> Copied<'a> {
    pub(super) fn new(subject: &'a Subject) -> Self {
        Self { subject, output: vec![0.0; subject.rows()] }
    }

    /// What it moves for a row: each column is read and written.
    pub(super) fn bytes(&self) -> usize {
        16 * self.subject.axes()
    }

    pub(super) fn run(&mut self) {
        for column in self.subject.columns.iter().filter(|column| !column.is_empty()) {
            self.output.copy_from_slice(column);
            black_box(&mut self.output);
        }
    }
}
