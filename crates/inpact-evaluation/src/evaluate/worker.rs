//! The work of one thread on a batch: its rows partitioned by interaction, all tables by column, and every law of the rows without histories.

use super::found::Found;
use super::laws::{InteractionLaws, Laws, Summary};
use super::shard::{Shard, Waiting};
use crate::evaluator::SeenError;
use crate::law::contact::columns::count_states;
use crate::law::thermal::columns::ThermalColumns;
use crate::nodes::Batch;
use crate::plan::{Plan, RowInteractions};
use crate::results::ResultBatch;
use crate::rows::{InteractionTally, Outcome, Part, Tally, UserFaultInRow};
use inpact_parser::model::Model;

/// The interactions that a thread has processed, and its counts.
#[derive(Debug)]
pub(super) struct Worker<'a> {
    interactions: RowInteractions<'a>,
    pub(super) tally: Tally,
    asks_user: bool,
}

impl<'a> Worker<'a> {
    pub(super) fn new(model: &'a Model, plan: &Plan, laws: &Laws, tally: Tally) -> Self {
        let interactions = RowInteractions::new(model, plan.governed_by, laws.interaction);
        Self { interactions, tally, asks_user: laws.asks_user }
    }

    /// The rows of a batch by the interaction that governs them, those that have laws; in the order of the rows where a user's routine sees them.
    pub(super) fn parts<'b>(&mut self, laws: &Laws, batch: &'b Batch) -> Vec<Part<'b>> {
        let part = |interaction: usize, numbers| {
            let contact = laws.interactions[interaction].as_ref()?.contact;
            Some(Part::new(batch, numbers, &laws.labels(), (interaction, contact), laws.time))
        };
        if 0 < batch.rows && self.interactions.end_of_run(batch, 0) == batch.rows {
            let interaction = self.interactions.of_row(batch, 0);
            return interaction.and_then(|interaction| part(interaction, None)).into_iter().collect();
        }
        let mut groups: Vec<(usize, Vec<u32>)> = Vec::new();
        let (mut first, mut ungoverned) = (0, 0);
        while first < batch.rows {
            let interaction = self.interactions.of_row(batch, first);
            let rows = first..self.interactions.end_of_run(batch, first);
            first = rows.end;
            let Some(interaction) = interaction.filter(|interaction| laws.interactions[*interaction].is_some()) else {
                ungoverned += rows.len();
                continue;
            };
            let group = match groups.iter_mut().rev().find(|(met, _)| *met == interaction) {
                Some((_, group)) if !self.asks_user => group,
                _ => {
                    groups.push((interaction, Vec::new()));
                    let last = groups.len() - 1;
                    &mut groups[last].1
                }
            };
            group.extend(rows.filter_map(|row| u32::try_from(row).ok()));
        }
        let is_one = groups.len() == 1 && ungoverned == 0;
        groups.into_iter().filter_map(|(interaction, rows)| part(interaction, (!is_one).then_some(rows))).collect()
    }

    /// Evaluates a batch; rows with a history go to the single `shard`, or are queued for one of `shards` where there are several.
    pub(super) fn evaluate<'b>(
        &mut self,
        laws: &Laws,
        batch: &'b Batch,
        mut shard: Option<&mut Shard>,
        shards: usize,
        results: &mut ResultBatch,
    ) -> Vec<Waiting<'b>> {
        let mut waiting = Vec::new();
        let parts = self.parts(laws, batch);
        if parts.iter().all(|part| part.numbers.is_some()) {
            results.reset(batch.rows, laws.result_columns);
        }
        for part in parts {
            let Some(of) = &laws.interactions[part.interaction] else { continue };
            let tally = &mut self.tally.interactions[part.interaction];
            tally.count_contact(&part);
            let seen = (laws.summary == Summary::Made).then_some(&mut tally.seen_error);
            let found = of.find(&part, seen);
            let has_histories = of.keeps_history && laws.node.is_some() && laws.time.is_some();
            if has_histories && shard.is_none() {
                if part.numbers.is_none() {
                    results.reset(batch.rows, laws.result_columns);
                }
                waiting.push(Waiting::new(laws, part, found, shards));
                continue;
            }
            let mut own = None;
            let results_of_part = match &part.numbers {
                None => &mut *results,
                Some(_) => own.insert(ResultBatch::default()),
            };
            match (&of.electrical, &mut shard) {
                (_, Some(shard)) if has_histories => shard.evaluate_part(laws, &part, &found, results_of_part),
                (Some(law), _) if of.thermal.is_none() && of.pore.is_none() => {
                    let (found, faults) = (found.conductances.as_ref(), &mut self.tally.user_faults);
                    law.rows_alone(&part, found, laws.result_columns, results_of_part, tally, faults);
                }
                _ => {
                    results_of_part.reset(part.rows(), laws.result_columns);
                    of.evaluate_rows(&part, &found, results_of_part, tally, &mut self.tally.user_faults);
                }
            }
            if let (Some(own), Some(numbers)) = (own, &part.numbers) {
                own.scatter(numbers, results);
            }
        }
        waiting
    }

    /// Adds the results of a batch to the totals of its interactions, in the order of the rows.
    pub(super) fn add_up(&mut self, laws: &Laws, batch: &Batch, results: &ResultBatch, tally: &mut Tally) {
        if laws.summed.is_empty() {
            return;
        }
        let mut first = 0;
        while first < batch.rows {
            let interaction = self.interactions.of_row(batch, first);
            let rows = first..self.interactions.end_of_run(batch, first);
            first = rows.end;
            let Some(interaction) = interaction.filter(|interaction| laws.interactions[*interaction].is_some()) else {
                continue;
            };
            let totals = &mut tally.interactions[interaction].totals;
            totals.take(laws.time.map(|place| &batch.numbers[place]), &laws.summed, results, rows);
        }
    }
}

impl InteractionLaws {
    /// Evaluates the tables over a part; a sample of conductances is compared with the reference on request.
    pub(super) fn find(&self, part: &Part<'_>, seen: Option<&mut SeenError>) -> Found {
        Found {
            conductances: self.electrical.as_ref().and_then(|law| law.conductances(part, seen)),
            thermal: self.thermal.as_ref().map(|law| law.find(part)).unwrap_or_default(),
            permeabilities: self.pore.as_ref().map(|law| law.permeabilities(part)).unwrap_or_default(),
        }
    }

    /// All laws of the rows of a part without histories.
    fn evaluate_rows(
        &self,
        part: &Part<'_>,
        found: &Found,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
        faults: &mut Vec<UserFaultInRow>,
    ) {
        let takes_heat = self.thermal.as_ref().is_some_and(ThermalColumns::takes_heat_of_current);
        let (mut electrical, heats) = match &self.electrical {
            Some(law) => law.rows(part, found.conductances.as_ref(), takes_heat, results, tally),
            None => Default::default(),
        };
        let mut thermal = self.thermal.as_ref().map(|law| law.rows(part, &found.thermal, &heats, results, tally));
        let mut pore = self.pore.as_ref().map(|law| law.rows(part, &found.permeabilities, results, tally));
        let taken =
            |outcomes: &mut [Outcome], index: usize| std::mem::replace(&mut outcomes[index], Outcome::Incomplete);
        for index in 0..part.rows() {
            let Some(row) = part.row(index, index) else { continue };
            let of_current = self.electrical.is_some().then(|| taken(&mut electrical, index));
            let thermal = thermal.as_mut().map(|outcomes| taken(outcomes, index));
            let pore = pore.as_mut().map(|outcomes| taken(outcomes, index));
            tally.finish_row([of_current, thermal, pore], row.to, results, faults);
        }
        results.settle();
    }
}

impl InteractionTally {
    /// Counts the rows of a part, and how many are closed and open.
    fn count_contact(&mut self, part: &Part<'_>) {
        self.rows += part.rows() as u64;
        self.closed += part.closed;
        self.open += part.open;
        self.incomplete += count_states(&part.states, None);
    }

    /// Counts a row and sets its status: the outcomes of electrical, thermal and pore fluid law.
    #[inline]
    pub(crate) fn finish_row(
        &mut self,
        outcomes: [Option<Outcome>; 3],
        row: usize,
        results: &mut ResultBatch,
        faults: &mut Vec<UserFaultInRow>,
    ) {
        self.incomplete += u64::from(outcomes.iter().any(|outcome| matches!(outcome, Some(Outcome::Incomplete))));
        let [electrical, thermal, pore] = outcomes.map(|outcome| match outcome? {
            Outcome::Incomplete => None,
            Outcome::Evaluated(status) => status,
            Outcome::Faulty(fault) => {
                faults.extend(fault.map(|fault| *fault));
                None
            }
        });
        self.count_statuses([electrical, pore, thermal]);
        results.status[row] = electrical.max(pore).max(thermal);
        results.status_by_law.electrical[row] = electrical;
        results.status_by_law.thermal[row] = thermal;
        results.status_by_law.pore[row] = pore;
    }
}
