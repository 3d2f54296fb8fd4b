//! The electrical law over rows that end increments of histories, a chunk at a time in three steps: each row takes the start of its increment from the previous row,
//! current and heat are computed by column, and each row adds to the integrals of its node, which are still in the cache.

use super::alone::set_contact;
use super::{CHUNK, ElectricalColumns, FlowInputs, PlainFlow, lost_digits};
use crate::history::{ElectricalHistory, ElectricalIncrement, ElectricalSteps};
use crate::kernel::scan::are_moderate;
use crate::law::conductance::columns::ConductanceColumn;
use crate::law::contact::PotentialJump;
use crate::law::electrical::ElectricalFlow;
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

/// Some of them, with the increments that they end.
#[derive(Debug)]
pub(crate) struct Chunk<'r> {
    /// The rows, by their numbers in the part.
    rows: &'r [usize],
    /// The row of the results that the first of them fills.
    first: usize,
    times: Vec<f64>,
    conductance: Vec<f64>,
    jump: Vec<f64>,
    area: Option<Vec<f64>>,
    begun: Vec<ElectricalIncrement>,
    /// Current and heat, where plain arithmetic gives them.
    flows: Option<Vec<PlainFlow>>,
    /// The contributions of the rows to the integrals, where all numbers are moderate.
    steps: Option<Vec<ElectricalSteps>>,
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

    /// Some rows, no more than [`Self::CHUNK`], the first of which fills row `first` of the results.
    pub(crate) fn chunk<'r>(&self, rows: &'r [usize], first: usize) -> Chunk<'r> {
        let of_rows = |values: &[f64]| rows.iter().map(|row| values[*row]).collect::<Vec<f64>>();
        Chunk {
            rows,
            first,
            times: of_rows(self.times),
            conductance: of_rows(&self.found.values),
            jump: of_rows(&self.jump.values),
            area: self.area.as_ref().map(|area| of_rows(&area.values)),
            begun: Vec::with_capacity(rows.len()),
            flows: None,
            steps: None,
        }
    }

    /// Conductance, current and heat of a chunk, each of whose rows has begun.
    pub(crate) fn evaluate(&self, chunk: &mut Chunk<'_>, results: &mut ResultBatch) {
        let starts: Vec<f64> = chunk.begun.iter().map(|increment| increment.jump_at_start.0).collect();
        let inputs = FlowInputs {
            conductance: &chunk.conductance,
            jump: Some(&chunk.jump),
            jump_at_start: Some(&starts),
            area: chunk.area.as_deref(),
        };
        let of_rows = [Some(inputs.conductance), inputs.jump, inputs.jump_at_start, inputs.area];
        let durations = chunk.begun.iter().filter_map(|increment| increment.duration);
        let is_plain = of_rows.into_iter().flatten().all(are_moderate)
            && durations.fold(true, |all, duration| all & is_moderate(duration));
        if !is_plain {
            return;
        }
        let mut flows = Vec::with_capacity(chunk.rows.len());
        self.law.plain_flows(inputs, chunk.results(), results, Some(&mut flows));
        chunk.steps = chunk.steps(&flows);
        chunk.flows = Some(flows);
    }

    /// Whether the rows of a chunk differ only in their steps: then [`Self::finish_steps`] and [`Self::set_statuses`] finish them.
    pub(crate) fn is_uniform(&self, chunk: &Chunk<'_>) -> bool {
        chunk.steps.is_some() && self.law.slopes.is_empty() && self.found.sides.is_empty()
    }

    /// Adds row number `at` of a chunk, where they are uniform, to the integrals of its node, and counts remarks.
    #[inline]
    pub(crate) fn finish_steps(
        &self,
        chunk: &Chunk<'_>,
        at: usize,
        history: &mut ElectricalHistory,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) {
        let Some(steps) = &chunk.steps else { return };
        let (increment, to) = (&chunk.begun[at], chunk.result_of(at));
        history.finish_steps(increment, &steps[at]);
        self.law.set_integrals(history, to, results);
        if increment.closes_circuit
            && let Some(row) = self.part.row(chunk.rows[at], to)
        {
            self.law.count_closing(row, increment, PotentialJump(chunk.jump[at]), tally);
        }
    }

    /// Sets the statuses of a chunk whose rows are uniform.
    pub(crate) fn set_statuses(&self, chunk: &Chunk<'_>, results: &mut ResultBatch) {
        match chunk.rows {
            [first, .., last] if last - first + 1 == chunk.rows.len() => {
                set_contact(&self.part.states[*first..=*last], chunk.results(), results);
            }
            rows => {
                for (to, row) in chunk.results().zip(rows) {
                    set_contact(&self.part.states[*row..=*row], to..to + 1, results);
                }
            }
        }
    }

    /// Adds row number `at` of a chunk to the integrals of its node; returns its status and the heat of its current.
    pub(crate) fn finish(
        &self,
        chunk: &Chunk<'_>,
        at: usize,
        history: &mut ElectricalHistory,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> (Outcome, Option<HeatAmounts>) {
        let (law, index, to) = (self.law, chunk.rows[at], chunk.first + at);
        let (sides, state) = (self.found.sides_of(index), self.part.states[index]);
        let Some(flow) = chunk.flows.as_ref().map(|flows| flows[at]) else {
            return self.finish_with_care(chunk, at, history, results, tally);
        };
        let (increment, jump) = (&chunk.begun[at], chunk.jump[at]);
        let area = chunk.area.as_ref().map(|area| area[at]);
        let rest = chunk.conductance[at].mul_add(jump, -flow.current_density);
        let of_row = ElectricalFlow { current_density: flow.current_density, heat: flow.heat };
        history.finish(increment, &of_row, rest, area);
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
        chunk: &Chunk<'_>,
        at: usize,
        history: &mut ElectricalHistory,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> (Outcome, Option<HeatAmounts>) {
        let (law, index, to, value) = (self.law, chunk.rows[at], chunk.first + at, chunk.conductance[at]);
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
        let of_area = [slots.ecda, slots.sjda].map(|slot| slot.filter(|_| self.area.is_some()));
        let others = [slots.conductance, slots.weight, slots.ecd, slots.sjd, slots.heat_slave, slots.heat_master];
        for slot in others.into_iter().chain(of_area).chain([slots.ecdt, slots.sjdt]).flatten() {
            results.numbers[slot].set_all_present();
        }
    }
}

impl Chunk<'_> {
    /// The row of the results that row number `at` of it fills.
    #[inline]
    pub(crate) fn result_of(&self, at: usize) -> usize {
        self.first + at
    }

    /// The rows of the results that it fills.
    fn results(&self) -> Range<usize> {
        self.first..self.first + self.rows.len()
    }

    /// Advances to the next row, whose node has this history.
    pub(crate) fn begin(&mut self, history: &mut ElectricalHistory) {
        let next = self.begun.len();
        let jump = PotentialJump(self.jump[next]);
        self.begun.push(history.begin(self.times[next], jump, self.conductance[next]));
    }

    /// The contributions of the rows to the integrals; `None` where a row has no area, or a number is not moderate.
    fn steps(&self, flows: &[PlainFlow]) -> Option<Vec<ElectricalSteps>> {
        let durations: Vec<f64> = self.begun.iter().map(|increment| increment.duration.unwrap_or(0.0)).collect();
        let currents: Vec<f64> = flows.iter().map(|flow| flow.current_density).collect();
        let heats: Vec<f64> = flows.iter().map(|flow| flow.heat.total).collect();
        ElectricalSteps::of([&self.conductance, &self.jump], &currents, &heats, &durations, self.area.as_deref()?)
    }
}
