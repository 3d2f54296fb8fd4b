//! The modes that are measured: a list, each with how it evaluates a table, its bound and what it moves in memory.

use super::subjects::Subject;
use inpact_evaluation::accuracy::{Accuracy, Wanted, full_bound};
use inpact_evaluation::table_form::{TableForm, TableValues};
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

/// All modes, most exact first.
pub(super) const MODES: &[Mode] = &[
    Mode {
        name: "reference",
        of: |subject| {
            let run = Formed::new(subject, Accuracy::Reference);
            Some(Prepared { run: Box::new(run), bound: REFERENCE_ULPS * f64::EPSILON, bytes: bytes(subject, 8) })
        },
    },
    Mode {
        name: "full",
        of: |subject| {
            let bound = full_bound(&subject.table).relative_to_largest;
            let run = Formed::new(subject, Accuracy::Full);
            Some(Prepared { run: Box::new(run), bound, bytes: bytes(subject, 8) })
        },
    },
];

/// The bound of `reference`, in ulp.
const REFERENCE_ULPS: f64 = 0.501;

/// Rows are evaluated in blocks of so many, as the batches of an evaluation have.
const ROWS_OF_A_BLOCK: usize = 1024;

/// What a mode reads and writes for a row with numbers of that size.
fn bytes(subject: &Subject, size: usize) -> usize {
    (subject.axes() + 1) * size
}

/// A table in the form in which an evaluation of that accuracy has it.
struct Formed<'a> {
    columns: Vec<&'a [f64]>,
    form: TableForm,
    found: TableValues,
    output: Vec<f64>,
}

impl<'a> Formed<'a> {
    fn new(subject: &'a Subject, accuracy: Accuracy) -> Self {
        Self {
            columns: subject.columns.iter().map(Vec::as_slice).collect(),
            form: TableForm::new(subject.table.clone(), Wanted::Mode(accuracy)),
            found: TableValues::default(),
            output: vec![0.0; subject.rows()],
        }
    }
}

impl Run for Formed<'_> {
    fn run(&mut self) {
        let mut block: Vec<&[f64]> = Vec::with_capacity(self.columns.len());
        for (number, output) in self.output.chunks_mut(ROWS_OF_A_BLOCK).enumerate() {
            let start = number * ROWS_OF_A_BLOCK;
            block.clear();
            block.extend(self.columns.iter().map(|column| column.get(start..start + output.len()).unwrap_or_default()));
            self.form.evaluate(&block, output.len(), &mut self.found);
            output.copy_from_slice(&self.found.values);
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
