//! A shard of the nodes with their histories: their rows are evaluated sequentially, in order.

use super::found::Found;
use super::laws::{InteractionLaws, Laws};
use crate::history::{ElectricalHistory, PoreHistory, ThermalHistory};
use crate::law::electrical::columns::increments::{Chunk, Increments};
use crate::nodes::{HistoryOrder, HistorySlot, NodeIndex, NodeLabel, NodeLabels};
use crate::plan::Plan;
use crate::results::ResultBatch;
use crate::rows::{Part, Row, Tally};

/// The nodes whose labels hash to it.
#[derive(Debug)]
pub(super) struct Shard {
    nodes: NodeIndex,
    histories: Vec<NodeHistory>,
    /// The current chunk of rows, and the slots of its nodes.
    chunk: Chunk,
    slots: Vec<HistorySlot>,
    pub(super) tally: Tally,
}

/// Sums over a node's rows so far.
#[derive(Debug, Clone)]
struct NodeHistory {
    electrical: ElectricalHistory,
    /// Those of the other laws, allocated when one of them begins: without them the histories of more nodes fit into the cache.
    others: Option<Box<OtherHistories>>,
}

#[derive(Debug, Clone)]
struct OtherHistories {
    thermal: ThermalHistory,
    pore: PoreHistory,
}

/// A part whose rows have histories, with its columns of table values.
#[derive(Debug)]
pub(super) struct Waiting<'a> {
    part: Part<'a>,
    found: Found,
    /// The shard of each row.
    shards: Vec<u32>,
}

/// The results of the rows of one shard in a batch.
#[derive(Debug)]
pub(super) struct ShardResults {
    pub(super) batch: usize,
    /// Their numbers in the batch.
    pub(super) rows: Vec<u32>,
    pub(super) results: ResultBatch,
}

impl<'a> Waiting<'a> {
    pub(super) fn new(laws: &Laws, part: Part<'a>, found: Found, shards: usize) -> Self {
        let shards = shards_of(laws, &part, shards);
        Self { part, found, shards }
    }
}

/// The shard of each row of a part.
fn shards_of(laws: &Laws, part: &Part<'_>, shards: usize) -> Vec<u32> {
    let nodes = laws.node.map(|node| NodeLabels::of(&part.batch().labels[node]));
    let label = |row| nodes.as_ref().map_or(NodeLabel::Text(b""), |nodes| nodes.get(row));
    (0..part.rows()).map(|row| shard_of(part.interaction, label(row), shards)).collect()
}

/// The shard of a node, the same for all of its rows.
fn shard_of(interaction: usize, label: NodeLabel<'_>, shards: usize) -> u32 {
    let step = |hash: u64, part: u64| (hash ^ part).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let begun = step(0, interaction as u64);
    let hash = match label {
        NodeLabel::Number(number) => step(begun, number.cast_unsigned()),
        NodeLabel::Text(text) => text.iter().fold(begun, |hash, byte| step(hash, u64::from(*byte))),
    };
    // The upper half of the hash is mixed better; the remainder fits into 32 bits.
    ((hash >> 32) % shards as u64) as u32
}

impl NodeHistory {
    /// One that has not begun.
    fn of(laws: &Laws) -> Self {
        Self { electrical: ElectricalHistory::new(laws.history_start, laws.closing_heat), others: None }
    }

    /// The histories of the other laws.
    fn others(&mut self, laws: &Laws) -> &mut OtherHistories {
        self.others.get_or_insert_with(|| {
            let start = laws.history_start;
            Box::new(OtherHistories { thermal: ThermalHistory::new(start), pore: PoreHistory::new(start) })
        })
    }
}

/// The history of a row; that of a node's first row starts from zero.
#[inline]
fn entered(histories: &mut [NodeHistory], slot: HistorySlot) -> &mut NodeHistory {
    let history = &mut histories[slot.number];
    if slot.is_first {
        history.electrical.clear_integrals();
        history.others = None;
    }
    history
}

impl Shard {
    pub(super) fn new(plan: &Plan, tally: Tally) -> Self {
        let nodes = match plan.order {
            HistoryOrder::ByNode => NodeIndex::by_node(),
            HistoryOrder::Interleaved => NodeIndex::default(),
        };
        Self { nodes, histories: Vec::new(), chunk: Chunk::default(), slots: Vec::new(), tally }
    }

    /// Evaluates the pending rows of shard `number`, batch by batch.
    pub(super) fn evaluate(&mut self, laws: &Laws, number: usize, waiting: &[Vec<Waiting<'_>>]) -> Vec<ShardResults> {
        let mut all = Vec::new();
        for (batch, waiting) in waiting.iter().enumerate() {
            for Waiting { part, found, shards } in waiting {
                let Some(of) = &laws.interactions[part.interaction] else { continue };
                let own: Vec<usize> = (0..part.rows()).filter(|row| shards[*row] as usize == number).collect();
                let mut results = ResultBatch::default();
                self.evaluate_rows(laws, (part, of), found, &own, &mut results);
                let number = |row: &usize| match &part.numbers {
                    Some(numbers) => Some(numbers[*row]),
                    None => u32::try_from(*row).ok(),
                };
                all.push(ShardResults { batch, rows: own.iter().filter_map(number).collect(), results });
            }
        }
        all
    }

    /// Evaluates all rows of a part.
    pub(super) fn evaluate_part(&mut self, laws: &Laws, part: &Part<'_>, found: &Found, results: &mut ResultBatch) {
        let Some(of) = &laws.interactions[part.interaction] else { return };
        let all: Vec<usize> = (0..part.rows()).collect();
        self.evaluate_rows(laws, (part, of), found, &all, results);
    }

    /// Evaluates some rows of a part, which ascend, one result each.
    fn evaluate_rows(
        &mut self,
        laws: &Laws,
        (part, of): (&Part<'_>, &InteractionLaws),
        found: &Found,
        rows: &[usize],
        results: &mut ResultBatch,
    ) {
        let nodes = laws.node.map(|node| NodeLabels::of(&part.batch().labels[node]));
        let electrical = of.electrical.as_ref();
        let increments = electrical.and_then(|law| law.increments(part, found.conductances.as_ref()));
        if let Some((increments, nodes)) = increments.zip(nodes.as_ref()) {
            let filled = increments.filled();
            results.reset_statuses(rows.len());
            results.shape(rows.len(), laws.result_columns, |slot| filled.contains(&Some(slot)));
            for (number, some) in rows.chunks(Increments::CHUNK).enumerate() {
                increments.take(some, number * Increments::CHUNK, &mut self.chunk);
                self.evaluate_chunk(laws, (part, of), found, (&increments, nodes, some), results);
            }
            return increments.end(rows, results, &mut self.tally.interactions[part.interaction]);
        }
        results.reset(rows.len(), laws.result_columns);
        for (to, index) in rows.iter().enumerate() {
            if let Some(row) = part.row(*index, to) {
                let node = nodes.as_ref().filter(|_| row.time.is_some()).map(|nodes| nodes.get(*index));
                self.evaluate_row(laws, of, (row, node), found, results);
            }
        }
    }

    /// Evaluates the rows of the chunk, each of which ends an increment of the electrical law.
    fn evaluate_chunk(
        &mut self,
        laws: &Laws,
        (part, of): (&Part<'_>, &InteractionLaws),
        found: &Found,
        (increments, nodes, rows): (&Increments<'_, '_>, &NodeLabels<'_>, &[usize]),
        results: &mut ResultBatch,
    ) {
        let Self { nodes: index, histories, chunk, slots, tally } = self;
        slots.clear();
        for row in rows {
            let slot = index.enter(part.interaction, nodes.get(*row));
            if slot.number == histories.len() {
                histories.push(NodeHistory::of(laws));
            } else if slot.is_first {
                histories[slot.number].electrical.restart();
            }
            chunk.begin(&mut histories[slot.number].electrical);
            slots.push(slot);
        }
        increments.evaluate(chunk, results);
        let (tally, faults) = (&mut tally.interactions[part.interaction], &mut tally.user_faults);
        let is_alone = of.thermal.is_none() && of.pore.is_none();
        if is_alone && chunk.is_uniform() {
            for (at, slot) in slots.iter().enumerate() {
                chunk.add_steps(at, &mut entered(histories, *slot).electrical);
            }
            return increments.end_steps(chunk, rows, results, tally);
        }
        for (at, index) in rows.iter().enumerate() {
            let history = entered(histories, slots[at]);
            let (outcome, heat) = increments.finish(chunk, (at, *index), &mut history.electrical, results, tally);
            let to = chunk.result_of(at);
            let row = if is_alone { None } else { part.row(*index, to) };
            let thermal = of.thermal.as_ref().zip(row).map(|(law, row)| {
                let history = Some(&mut history.others(laws).thermal);
                law.row(row, &found.thermal, heat, history, results, tally)
            });
            let pore = of.pore.as_ref().zip(row).map(|(law, row)| {
                law.row(row, &found.permeabilities, Some(&mut history.others(laws).pore), results, tally)
            });
            tally.finish_row([Some(outcome), thermal, pore], to, results, faults);
        }
    }

    fn evaluate_row(
        &mut self,
        laws: &Laws,
        of: &InteractionLaws,
        (row, node): (Row<'_, '_>, Option<NodeLabel<'_>>),
        found: &Found,
        results: &mut ResultBatch,
    ) {
        let interaction = row.part.interaction;
        let mut history = node.map(|node| {
            let slot = self.nodes.enter(interaction, node);
            if slot.number == self.histories.len() {
                self.histories.push(NodeHistory::of(laws));
            } else if slot.is_first {
                self.histories[slot.number] = NodeHistory::of(laws);
            }
            &mut self.histories[slot.number]
        });
        let tally = &mut self.tally.interactions[interaction];
        let mut heat = None;
        let electrical = of.electrical.as_ref().map(|law| {
            let history = history.as_mut().map(|history| &mut history.electrical);
            let (outcome, of_current) = law.row(row, found.conductances.as_ref(), history, results, tally);
            heat = of_current;
            outcome
        });
        let thermal = of.thermal.as_ref().map(|law| {
            let history = history.as_mut().map(|history| &mut history.others(laws).thermal);
            law.row(row, &found.thermal, heat, history, results, tally)
        });
        let pore = of.pore.as_ref().map(|law| {
            let history = history.as_mut().map(|history| &mut history.others(laws).pore);
            law.row(row, &found.permeabilities, history, results, tally)
        });
        tally.finish_row([electrical, thermal, pore], row.to, results, &mut self.tally.user_faults);
    }
}
