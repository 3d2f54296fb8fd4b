//! The electrical law over rows that end increments of histories, a chunk at a time in three steps: each row takes the start of its increment from the previous row,
//! current and heat are computed by column, and each row adds to the integrals of its node, which are still in the cache.

use super::alone::set_contact;
use super::{CHUNK, ElectricalColumns, FlowColumns, FlowInputs, lost_digits};
use crate::history::{ElectricalHistory, ElectricalIncrement, StepColumns};
use crate::kernel::scan::are_moderate;
use crate::law::conductance::columns::ConductanceColumn;
use crate::law::contact::PotentialJump;
use crate::law::heat::HeatAmounts;
use crate::nodes::Cells;
use crate::numbers::is_moderate;
use crate::results::ResultBatch;
use crate::rows::{InteractionTally, Outcome, Part, contact_status};
use std::ops::Range;

/// Rows of a part, none of which lacks a number, that end increments.
#[derive(Debug)]
pub(crate) struct Increments<'p, 'a> {
    law: &'p ElectricalColumns,
    part: &'p Part<'a>,
    found: &'p ConductanceColumn,
    times: &'p [f64],
    jump: Cells<'p>,
    area: Option<Cells<'p>>,
}

/// Some of them, with the increments that they end; its memory is that of the chunk before.
#[derive(Debug, Default)]
pub(crate) struct Chunk {
    /// The row of the results that the first of them fills.
    first: usize,
    times: Vec<f64>,
    conductance: Vec<f64>,
    jump: Vec<f64>,
    /// Empty where there are no areas.
    area: Vec<f64>,
    begun: Vec<ElectricalIncrement>,
    jump_at_start: Vec<f64>,
    /// 0 where an increment has none.
    durations: Vec<f64>,
    /// The rows that close a circuit.
    closing: Vec<usize>,
    /// Whether a node has had a row without an area.
    lacks_area: bool,
    arithmetic: Arithmetic,
    flows: Box<FlowColumns>,
    steps: StepColumns,
    /// The integrals at the rows: of current and heat, each per area and of the area.
    integrals: Vec<[f64; 4]>,
}

/// How current, heat and integrals of a chunk are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Arithmetic {
    /// Row by row: a number is extreme.
    #[default]
    Careful,
    /// Current and heat in columns, integrals row by row.
    PlainFlows,
    /// All in columns: the rows differ in nothing but their steps.
    PlainSteps,
}

impl ElectricalColumns {
    /// The rows of a part as columns; `None` where one of them lacks a number, or where double-double is requested.
    pub(crate) fn increments<'p, 'a>(
        &'p self,
        part: &'p Part<'a>,
        found: Option<&'p ConductanceColumn>,
    ) -> Option<Increments<'p, 'a>> {
        let (found, source, times) = (found?, self.jump?, part.times()?);
        let jump = Cells::of_source(part.batch(), &source, |slave, master| PotentialJump::between(slave, master).0);
        let area = self.area.map(|place| Cells::at(part.batch(), place));
        let is_full =
            found.is_full() && part.tells_contact() && jump.is_full() && area.as_ref().is_none_or(Cells::is_full);
        if !is_full || self.accuracy.is_reference() || !is_moderate(self.heat_generation.fraction) {
            return None;
        }
        Some(Increments { law: self, part, found, times, jump, area })
    }
}

impl Increments<'_, '_> {
    /// The maximum number of rows in a chunk.
    pub(crate) const CHUNK: usize = CHUNK;

    /// The columns of results that every row fills.
    pub(crate) fn filled(&self) -> [Option<usize>; 8] {
        let slots = &self.law.slots;
        let [conductance, weight, ecdt, sjdt] = [slots.conductance, slots.weight, slots.ecdt, slots.sjdt];
        [conductance, weight, slots.ecd, slots.sjd, slots.heat_slave, slots.heat_master, ecdt, sjdt]
    }

    /// Makes `chunk` some rows, no more than [`Self::CHUNK`], the first of which fills row `first` of the results.
    pub(crate) fn take(&self, rows: &[usize], first: usize, chunk: &mut Chunk) {
        chunk.first = first;
        gather(self.times, rows, &mut chunk.times);
        gather(&self.found.values, rows, &mut chunk.conductance);
        gather(&self.jump.values, rows, &mut chunk.jump);
        gather(self.area.as_ref().map_or(&[], |area| &area.values), rows, &mut chunk.area);
        chunk.begun.clear();
        chunk.jump_at_start.clear();
        chunk.durations.clear();
        chunk.closing.clear();
        chunk.lacks_area = self.area.is_none();
        chunk.arithmetic = Arithmetic::Careful;
    }

    /// Conductance, current and heat of a chunk, each of whose rows has begun.
    pub(crate) fn evaluate(&self, chunk: &mut Chunk, results: &mut ResultBatch) {
        let to = chunk.results();
        let Chunk { conductance, jump, jump_at_start, durations, area, flows, steps, .. } = chunk;
        let inputs = FlowInputs {
            conductance,
            jump: Some(jump),
            jump_at_start: Some(jump_at_start),
            area: self.area.is_some().then_some(area),
        };
        if ![&*conductance, &*jump, &*jump_at_start, &*durations, &*area].into_iter().all(|column| are_moderate(column))
        {
            return;
        }
        let count = to.len();
        self.law.plain_flows(inputs, to, results, flows);
        chunk.arithmetic = Arithmetic::PlainFlows;
        let is_uniform = !chunk.lacks_area && self.law.slopes.is_empty() && self.found.sides.is_empty();
        let flows = [&flows.current_density[..count], &flows.heat[..count]];
        if is_uniform && steps.find([conductance, jump], flows, [durations, area]) {
            chunk.arithmetic = Arithmetic::PlainSteps;
            chunk.integrals.clear();
        }
    }

    /// Sets integrals and statuses of a chunk after [`Chunk::add_steps`], and counts remarks on its rows.
    pub(crate) fn end_steps(
        &self,
        chunk: &Chunk,
        rows: &[usize],
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) {
        let slots = &self.law.slots;
        for (place, slot) in [slots.ecdt, slots.ecdta, slots.sjdt, slots.sjdta].into_iter().enumerate() {
            results.set_flows(slot, chunk.results(), chunk.integrals.iter().map(|integrals| integrals[place]));
        }
        for at in &chunk.closing {
            if let Some(row) = self.part.row(rows[*at], chunk.result_of(*at)) {
                self.law.count_closing(row, &chunk.begun[*at], PotentialJump(chunk.jump[*at]), tally);
            }
        }
        match contiguous(rows) {
            Some(rows) => set_contact(&self.part.states[rows], chunk.results(), results),
            None => {
                for (to, row) in chunk.results().zip(rows) {
                    set_contact(&self.part.states[*row..=*row], to..to + 1, results);
                }
            }
        }
    }

    /// Adds row number `at` of a chunk, which is row `index` of the part, to the integrals of its node; gives its status and the heat of its current.
    pub(crate) fn finish(
        &self,
        chunk: &Chunk,
        (at, index): (usize, usize),
        history: &mut ElectricalHistory,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> (Outcome, Option<HeatAmounts>) {
        if chunk.arithmetic == Arithmetic::Careful {
            return self.finish_with_care(chunk, (at, index), history, results, tally);
        }
        let (law, to) = (self.law, chunk.result_of(at));
        let (sides, state) = (self.found.sides_of(index), self.part.states[index]);
        let (increment, jump, flow) = (&chunk.begun[at], chunk.jump[at], chunk.flows.row(at));
        let rest = chunk.conductance[at].mul_add(jump, -flow.current_density);
        history.finish(increment, &flow, rest, chunk.area.get(at).copied());
        law.set_integrals(history, to, results);
        let heat = Some(HeatAmounts::from(flow.heat));
        if law.slopes.is_empty() && sides.is_within() && !increment.closes_circuit {
            return (Outcome::Evaluated(state.and_then(contact_status)), heat);
        }
        let Some(row) = self.part.row(index, to) else { return (Outcome::Incomplete, None) };
        law.count_closing(row, increment, PotentialJump(jump), tally);
        law.set_slopes(row, results);
        (Outcome::Evaluated(law.status(row, sides, tally)), heat)
    }

    /// The same where a number is extreme.
    #[cold]
    fn finish_with_care(
        &self,
        chunk: &Chunk,
        (at, index): (usize, usize),
        history: &mut ElectricalHistory,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> (Outcome, Option<HeatAmounts>) {
        let (law, to, value) = (self.law, chunk.result_of(at), chunk.conductance[at]);
        let Some(row) = self.part.row(index, to) else { return (Outcome::Incomplete, None) };
        results.set(law.slots.conductance, to, Some(value));
        results.set(law.slots.weight, to, Some(law.heat_generation.slave_weight));
        law.set_slopes(row, results);
        let rest = self.found.rest(index).unwrap_or(0.0);
        let history = Some((history, chunk.begun[at]));
        let heat = law.flow_of_increment(row, (value, rest), PotentialJump(chunk.jump[at]), history, results, tally);
        (Outcome::Evaluated(law.status(row, self.found.sides_of(index), tally)), Some(heat))
    }

    /// Counts the rows whose jump has lost its digits, and marks all numbers of the rows as present.
    pub(crate) fn end(&self, rows: &[usize], results: &mut ResultBatch, tally: &mut InteractionTally) {
        if let Some(source) = &self.law.jump {
            let rows = rows.iter().map(|row| (*row, self.jump.values[*row]));
            tally.lost_digits += lost_digits(source, self.part, rows);
        }
        let slots = &self.law.slots;
        for slot in [slots.ecda, slots.sjda, slots.ecdta, slots.sjdta].into_iter().flatten() {
            results.numbers[slot].settle();
        }
    }
}

impl Chunk {
    /// The row of the results that row number `at` of it fills.
    #[inline]
    pub(crate) fn result_of(&self, at: usize) -> usize {
        self.first + at
    }

    /// The rows of the results that it fills.
    fn results(&self) -> Range<usize> {
        self.first..self.first + self.times.len()
    }

    /// Goes on to the next row, whose node has this history.
    #[inline]
    pub(crate) fn begin(&mut self, history: &mut ElectricalHistory) {
        let next = self.begun.len();
        let jump = PotentialJump(self.jump[next]);
        self.lacks_area |= history.lacks_area();
        let increment = history.begin(self.times[next], jump, self.conductance[next]);
        if increment.closes_circuit {
            self.closing.push(next);
        }
        self.jump_at_start.push(increment.jump_at_start.0);
        self.durations.push(increment.duration.unwrap_or(0.0));
        self.begun.push(increment);
    }

    /// Whether the rows differ in nothing but their steps: then [`Self::add_steps`] and [`Increments::end_steps`] finish them.
    pub(crate) fn is_uniform(&self) -> bool {
        self.arithmetic == Arithmetic::PlainSteps
    }

    /// Adds the next row to the integrals of its node, where the rows are uniform.
    #[inline]
    pub(crate) fn add_steps(&mut self, at: usize, history: &mut ElectricalHistory) {
        history.add_steps(&self.steps.rows[at]);
        self.integrals.push(history.integrals());
    }
}

/// The rows, where they stand together; rows ascend.
fn contiguous(rows: &[usize]) -> Option<Range<usize>> {
    let (first, last) = (*rows.first()?, *rows.last()?);
    (last - first + 1 == rows.len()).then_some(first..last + 1)
}

/// The numbers of some rows; none of an empty column.
fn gather(column: &[f64], rows: &[usize], numbers: &mut Vec<f64>) {
    numbers.clear();
    match contiguous(rows) {
        _ if column.is_empty() => {}
        Some(rows) => numbers.extend_from_slice(&column[rows]),
        None => numbers.extend(rows.iter().map(|row| column[*row])),
    }
}
