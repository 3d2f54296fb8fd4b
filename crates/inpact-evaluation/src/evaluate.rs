//! Evaluates the laws of a plan over batches of rows: tables and, where possible, current and heat by column, everything else row by row.
//!
//! Rows of one node under one interaction are increments of its history, in the order they come in; a node's first row starts it unless
//! [`Choices::history_start`] says otherwise (C-25):
//! its time integrals are 0, the jump of potential at its start is its own, the rate of its clearance is 0 unless given.
//! Results depend on the rows alone, not on the batch size or the number of threads.
//! Rows without histories are partitioned by batch, those with histories by node; a user's routine is called from one thread, in the order of the rows.
//!
//! A row that lacks a number needed by a law has no results of that law and is no increment of its history;
//! the next increment then begins at the last complete row.
//! Opens no file: batches in, batches out.

mod coordinates;
mod found;
mod laws;
mod pipeline;
mod shard;
mod worker;

pub use coordinates::{Coordinates, TableReads, TabulatedQuantity};

use self::laws::Laws;
use self::shard::{Shard, ShardResults, Waiting};
use self::worker::Worker;
use crate::nodes::Batch;
use crate::plan::{Choices, Plan};
use crate::results::ResultBatch;
use crate::rows::Tally;
use crate::spread;
use inpact_parser::model::Model;

/// The state of an evaluation: the laws, the histories of the nodes so far, and counts.
#[derive(Debug)]
pub struct Evaluation<'a> {
    laws: Laws,
    workers: Vec<Worker<'a>>,
    shards: Vec<Shard>,
    /// Counts of rows, and totals; workers and shards count the rest.
    tally: Tally,
}

impl<'a> Evaluation<'a> {
    /// Begins an evaluation of a plan that was made from this model and these choices.
    pub fn new(model: &'a Model, plan: &Plan, choices: &Choices) -> Self {
        Self::shared_by(1, model, plan, choices)
    }

    /// The same, spread over rayon's current thread pool where feature `threads` is on.
    pub fn on_all_threads(model: &'a Model, plan: &Plan, choices: &Choices) -> Self {
        Self::shared_by(spread::threads(), model, plan, choices)
    }

    /// The same, split into this number of shares, at least one; the results are the same.
    pub fn shared_by(shares: usize, model: &'a Model, plan: &Plan, choices: &Choices) -> Self {
        let laws = Laws::of(model, plan, choices);
        let shares = if laws.asks_user { 1 } else { shares.max(1) };
        let tally = Tally::new(plan, laws.summed_outputs(), model.interactions.len());
        Self {
            workers: (0..shares).map(|_| Worker::new(model, plan, &laws, tally.clone())).collect(),
            shards: (0..shares).map(|_| Shard::new(plan, tally.clone())).collect(),
            tally,
            laws,
        }
    }

    /// Leaves out the data of the summary: the totals over each interface, and the errors of its conductances in a sample of rows.
    #[must_use]
    pub fn without_summary(mut self) -> Self {
        self.laws.leave_out_summary();
        self.tally.summed.clear();
        self
    }

    /// The number of batches to pass to [`Self::evaluate_all`] at a time to keep every share busy.
    pub fn batches_at_a_time(&self) -> usize {
        /// Of each share.
        const BATCHES: usize = 4;
        if self.workers.len() == 1 { 1 } else { BATCHES * self.workers.len() }
    }

    /// Evaluates the rows of a batch, which continue the previous batch.
    pub fn evaluate(&mut self, batch: &Batch, results: &mut ResultBatch) {
        self.evaluate_all(std::slice::from_ref(batch), std::slice::from_mut(results));
    }

    /// Evaluates the rows of several batches, each of which continues the previous one.
    ///
    /// # Panics
    /// If the numbers of results and batches differ.
    pub fn evaluate_all(&mut self, batches: &[Batch], results: &mut [ResultBatch]) {
        assert_eq!(batches.len(), results.len(), "results for every batch");
        let Self { laws, workers, shards, .. } = self;
        match (&mut workers[..], &mut shards[..]) {
            ([worker], [shard]) => {
                for (batch, results) in batches.iter().zip(&mut *results) {
                    worker.evaluate(laws, batch, Some(&mut *shard), 1, results);
                }
            }
            _ => evaluate_shared(laws, workers, shards, batches, results),
        }
        for (batch, results) in batches.iter().zip(results) {
            self.tally.rows += batch.rows as u64;
            self.workers[0].add_up(&self.laws, batch, results, &mut self.tally);
        }
    }

    /// The counts.
    pub fn finish(mut self) -> Tally {
        let parts =
            self.workers.into_iter().map(|worker| worker.tally).chain(self.shards.into_iter().map(|shard| shard.tally));
        parts.for_each(|part| self.tally.merge(part));
        self.tally
    }
}

/// Batches are distributed to the workers; rows with a history are evaluated afterwards, partitioned by node.
fn evaluate_shared(
    laws: &Laws,
    workers: &mut [Worker<'_>],
    shards: &mut [Shard],
    batches: &[Batch],
    results: &mut [ResultBatch],
) {
    let (share, shard_count) = (batches.len().div_ceil(workers.len()).max(1), shards.len());
    let shares = workers.iter_mut().zip(batches.chunks(share)).zip(results.chunks_mut(share));
    let waiting: Vec<Vec<Waiting<'_>>> = spread::map(shares, |((worker, batches), results)| {
        let each = batches.iter().zip(results);
        each.map(|(batch, results)| worker.evaluate(laws, batch, None, shard_count, results)).collect::<Vec<_>>()
    })
    .into_iter()
    .flatten()
    .collect();
    if waiting.iter().all(Vec::is_empty) {
        return;
    }
    let found: Vec<Vec<ShardResults>> =
        spread::map(shards.iter_mut().enumerate(), |(number, shard)| shard.evaluate(laws, number, &waiting));
    let mut of_batches: Vec<Vec<ShardResults>> = Vec::new();
    of_batches.resize_with(batches.len(), Vec::new);
    for of_shard in found.into_iter().flatten() {
        of_batches[of_shard.batch].push(of_shard);
    }
    spread::for_each(of_batches.into_iter().zip(results), |(found, results)| {
        for ShardResults { rows, results: own, .. } in &found {
            own.scatter(rows, results);
        }
    });
}
