//! The electrical law over rows that end increments of histories, in three steps: each row learns from the row before how its increment began,
//! current and heat are found in columns, and each row adds to the integrals of its node.

use super::{CHUNK, ElectricalColumns, FlowInputs, PlainFlow, lost_digits};
use crate::evaluate::{InteractionTally, Outcome, Part, contact_status};
use crate::history::{ElectricalHistory, ElectricalIncrement};
use crate::kernel::scan::are_moderate;
use crate::law::conductance::columns::ConductanceColumn;
use crate::law::contact::PotentialJump;
use crate::law::electrical::ElectricalFlow;
use crate::law::heat::HeatAmounts;
use crate::nodes::Cells;
use crate::numbers::is_moderate;
use crate::results::ResultBatch;

/// Rows of a part, none of which lacks a number, with the increments that they end.
#[derive(Debug)]
pub(crate) struct Increments<'p, 'a> {
    law: &'p ElectricalColumns,
    part: &'p Part<'a>,
    found: &'p ConductanceColumn,
    /// The rows, by their numbers in the part.
    rows: &'p [usize],
    times: Vec<f64>,
    conductance: Vec<f64>,
    jump: Vec<f64>,
    area: Option<Vec<f64>>,
    begun: Vec<ElectricalIncrement>,
    /// Current and heat of the rows that plain arithmetic gives them for.
    flows: Vec<Option<PlainFlow>>,
}

impl ElectricalColumns {
    /// Some rows of a part as columns; `None` where one of them lacks a number, or where they are wanted in twice the precision of f64.
    pub(crate) fn increments<'p, 'a>(
        &'p self,
        part: &'p Part<'a>,
        found: Option<&'p ConductanceColumn>,
        rows: &'p [usize],
    ) -> Option<Increments<'p, 'a>> {
        let (found, source, times) = (found?, self.jump?, part.times()?);
        let jump = Cells::of_source(part.batch(), &source, |slave, master| PotentialJump::between(slave, master).0);
        let area = self.area.map(|place| Cells::at(part.batch(), place));
        let is_full =
            found.is_full() && part.tells_contact() && jump.is_full() && area.as_ref().is_none_or(Cells::is_full);
        if !is_full || self.accuracy.is_reference() || !is_moderate(self.heat_generation.fraction) {
            return None;
        }
        let of_rows = |values: &[f64]| rows.iter().map(|row| values[*row]).collect::<Vec<f64>>();
        Some(Increments {
            law: self,
            part,
            found,
            rows,
            times: of_rows(times),
            conductance: of_rows(&found.values),
            jump: of_rows(&jump.values),
            area: area.map(|area| of_rows(&area.values)),
            begun: Vec::with_capacity(rows.len()),
            flows: Vec::with_capacity(rows.len()),
        })
    }
}

impl<'p> Increments<'p, '_> {
    /// The rows, by their numbers in the part.
    pub(crate) fn rows(&self) -> &'p [usize] {
        self.rows
    }

    /// Goes on to the next row, whose node has this history.
    pub(crate) fn begin(&mut self, history: &mut ElectricalHistory) {
        let next = self.begun.len();
        let jump = PotentialJump(self.jump[next]);
        self.begun.push(history.begin(self.times[next], jump, self.conductance[next]));
    }

    /// Conductance, current and heat of all rows, each of which has begun.
    pub(crate) fn evaluate(&mut self, results: &mut ResultBatch) {
        let starts: Vec<f64> = self.begun.iter().map(|increment| increment.jump_at_start.0).collect();
        let mut flows = Vec::with_capacity(CHUNK);
        let mut first = 0;
        while first < self.rows.len() {
            let rows = first..self.rows.len().min(first + CHUNK);
            first = rows.end;
            let inputs = FlowInputs {
                conductance: &self.conductance[rows.clone()],
                jump: Some(&self.jump[rows.clone()]),
                jump_at_start: Some(&starts[rows.clone()]),
                area: self.area.as_ref().map(|area| &area[rows.clone()]),
            };
            let of_rows = [Some(inputs.conductance), inputs.jump, inputs.jump_at_start, inputs.area];
            let durations = self.begun[rows.clone()].iter().filter_map(|increment| increment.duration);
            let is_plain = of_rows.into_iter().flatten().all(are_moderate)
                && durations.fold(true, |all, duration| all & is_moderate(duration));
            if !is_plain {
                self.flows.extend(rows.map(|_| None));
                continue;
            }
            flows.clear();
            self.law.plain_flows(inputs, rows.clone(), results, Some(&mut flows));
            self.flows.extend(flows.iter().copied().map(Some));
        }
    }

    /// Adds row number `to` to the integrals of its node; gives its status and the heat of its current.
    pub(crate) fn finish(
        &self,
        to: usize,
        history: &mut ElectricalHistory,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> (Outcome, Option<HeatAmounts>) {
        let (law, index) = (self.law, self.rows[to]);
        let (sides, state) = (self.found.sides_of(index), self.part.states[index]);
        let Some(flow) = self.flows[to] else { return self.finish_with_care(to, history, results, tally) };
        let (increment, jump) = (&self.begun[to], self.jump[to]);
        let area = self.area.as_ref().map(|area| area[to]);
        let rest = self.conductance[to].mul_add(jump, -flow.current_density);
        let of_row = ElectricalFlow { current_density: flow.current_density, heat: flow.heat };
        history.finish(increment, &of_row, rest, area);
        let slots = &law.slots;
        // No current is 0, not −0.
        let mut set = |slot, value: Option<f64>| results.set(slot, to, value.map(|value| value + 0.0));
        set(slots.ecdt, Some(history.current()));
        set(slots.ecdta, history.current_of_area());
        set(slots.sjdt, Some(history.heat()));
        set(slots.sjdta, history.heat_of_area());
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
        to: usize,
        history: &mut ElectricalHistory,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> (Outcome, Option<HeatAmounts>) {
        let (law, index, value) = (self.law, self.rows[to], self.conductance[to]);
        let Some(row) = self.part.row(index, to) else { return (Outcome::Incomplete, None) };
        results.set(law.slots.conductance, to, Some(value));
        results.set(law.slots.weight, to, Some(law.heat_generation.slave_weight));
        law.set_slopes(row, results);
        let rest = self.found.rest(index).unwrap_or(0.0);
        let history = Some((history, self.begun[to]));
        let heat = law.flow_of_increment(row, (value, rest), PotentialJump(self.jump[to]), history, results, tally);
        (Outcome::Evaluated(law.status(row, self.found.sides_of(index), tally)), Some(heat))
    }

    /// Counts the rows whose jump has lost its digits, and says that no number of the rows is missing.
    pub(crate) fn end(&self, results: &mut ResultBatch, tally: &mut InteractionTally) {
        if let Some(source) = &self.law.jump {
            let rows = self.rows.iter().copied().zip(self.jump.iter().copied());
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
