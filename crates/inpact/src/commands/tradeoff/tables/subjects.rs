//! Subjects of measurement: the tables in force and, as columns, the coordinates of the rows that reach them.

use crate::commands::evaluable::{Evaluable, PATIENCE, spill_file};
use crate::failure::Failure;
use inpact_evaluation::nodes::{Batch, KeptRowsIter};
use inpact_evaluation::plan::{Choices, Plan};
use inpact_evaluation::results::{Along, ResultBatch, ResultWriter};
use inpact_evaluation::table::PiecewiseTable;
use inpact_evaluation::{Coordinates, Evaluation, TableReads, TabulatedQuantity};
use inpact_parser::model::Model;
use std::io;
use std::path::Path;
use std::time::{Duration, Instant};

/// A table with the coordinates of the rows that reach it.
pub(super) struct Subject {
    /// The interaction and the kind of the table.
    pub(super) name: String,
    /// The table as evaluated: folded along the axes on which all rows have one value.
    pub(super) table: PiecewiseTable,
    /// One column per axis; empty for axes that the value does not depend on.
    pub(super) columns: Vec<Vec<f64>>,
}

/// The rows that are measured on.
pub(super) struct Sample {
    /// The tables that vary and are reached by a row.
    pub(super) subjects: Vec<Subject>,
    /// The number of rows of the node table.
    pub(super) rows: u64,
    /// The sampling stride.
    pub(super) one_of: u64,
    pub(super) whole: WholeRow,
}

/// The minimum times of `eval` per row of the node table, on its default number of threads, ns.
#[derive(Debug, Clone, Copy)]
pub(super) struct WholeRow {
    /// Reading and survey.
    pub(super) read: f64,
    /// All laws, including their tables.
    pub(super) laws: f64,
    /// Writing its results as comma-separated values.
    pub(super) write: f64,
}

impl WholeRow {
    pub(super) fn total(self) -> f64 {
        self.read + self.laws + self.write
    }
}

impl Subject {
    /// The number of rows that reach it.
    pub(super) fn rows(&self) -> usize {
        self.columns.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// The number of axes that the value depends on.
    pub(super) fn axes(&self) -> usize {
        self.columns.iter().filter(|column| !column.is_empty()).count()
    }
}

/// Evaluates the node table, and keeps, for at most `most` of its rows, the coordinates at which tables in force are evaluated.
pub(super) fn gather(
    evaluable: &mut Evaluable,
    nodes_path: &Path,
    (most, rounds): (u64, u32),
) -> Result<Sample, Failure> {
    let Evaluable { model, plan, choices, rows, reading, .. } = evaluable;
    let mut coordinates = Coordinates::new(model, plan, choices);
    let one_of = plan.rows.div_ceil(most).max(1);
    let unreadable = |error| Failure::read(nodes_path, error);
    let begun = Instant::now();
    let (mut laws, mut write) = (Duration::MAX, Duration::MAX);
    for round in 1..=rounds {
        if 1 < round && PATIENCE < begun.elapsed() {
            break;
        }
        let again = if round < rounds { Some(rows.try_clone(spill_file()).map_err(unreadable)?) } else { None };
        let take = |batch: &Batch| {
            if round == 1 {
                coordinates.take(batch, one_of);
            }
        };
        let given = rows.give_back(&plan.selection).map_err(unreadable)?;
        let times = timed((model, plan, choices), given, take).map_err(unreadable)?;
        (laws, write) = (laws.min(times.0), write.min(times.1));
        if let Some(again) = again {
            *rows = again;
        }
    }
    let a_row = |time: Duration| time.as_secs_f64() * 1e9 / plan.rows.max(1) as f64;
    let whole = WholeRow { read: a_row(*reading), laws: a_row(laws), write: a_row(write) };
    let subjects = coordinates.finish().into_iter().map(|reads| subject(model, reads));
    Ok(Sample { subjects: subjects.collect(), rows: plan.rows, one_of, whole })
}

/// Evaluates all rows and discards the written results; returns the times of laws and writing.
fn timed(
    (model, plan, choices): (&Model, &Plan, &Choices),
    mut rows: KeptRowsIter,
    mut take: impl FnMut(&Batch),
) -> io::Result<(Duration, Duration)> {
    let mut evaluation = Evaluation::on_all_threads(model, plan, choices);
    let mut sink = io::sink();
    let mut writer = ResultWriter::new(&mut sink, plan.keys(), &plan.outputs)?;
    let (mut laws, mut write) = (Duration::ZERO, Duration::ZERO);
    let (mut window, mut results): (Vec<Batch>, Vec<ResultBatch>) = (Vec::new(), Vec::new());
    loop {
        window.clear();
        while window.len() < evaluation.batches_at_a_time() {
            let Some(mut batch) = rows.next_batch()? else { break };
            plan.name_rows(&mut batch);
            window.push(batch);
        }
        if window.is_empty() {
            return Ok((laws, write));
        }
        results.resize_with(window.len(), ResultBatch::default);
        let start = Instant::now();
        evaluation.evaluate_all(&window, &mut results);
        laws += start.elapsed();
        let start = Instant::now();
        let mut each = window.iter().zip(&results);
        each.try_for_each(|(batch, results)| writer.write(batch, results))?;
        write += start.elapsed();
        window.iter().for_each(&mut take);
    }
}

fn subject(model: &Model, reads: TableReads) -> Subject {
    let interaction = model.interactions.get_index(reads.interaction).map(|of| of.name.to_string());
    let against = if reads.against == Along::Pressure { "pressure" } else { "clearance" };
    let what = match reads.quantity {
        TabulatedQuantity::ElectricalConductance => format!("conductance against {against}"),
        TabulatedQuantity::ThermalConductance => format!("thermal conductance against {against}"),
        TabulatedQuantity::Permeability => "permeability".to_owned(),
    };
    let name = format!("{}: {what}", interaction.unwrap_or_default());
    Subject { name, table: reads.table, columns: reads.columns }
}
