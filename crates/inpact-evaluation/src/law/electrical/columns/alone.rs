//! The electrical law over rows without histories and without other laws: results and statuses are written in place, a chunk at a time.
//!
//! Bitwise equal to [`ElectricalColumns::rows`]; it saves the columns and outcomes that only other laws would use.

#![expect(
    clippy::inline_always,
    reason = "what is not inlined is compiled without the instruction set that was asked for"
)]

use super::{CHUNK, ElectricalColumns, LOST_DIGITS, Slots};
use crate::kernel::{Lanes, Operation};
use crate::law::conductance::columns::{ConductanceColumn, write_slopes};
use crate::law::contact::ContactState;
use crate::law::heat::HeatGeneration;
use crate::nodes::Batch;
use crate::numbers::{is_moderate, is_zero_or_ordinary};
use crate::plan::Source;
use crate::results::ResultBatch;
use crate::rows::{InteractionTally, Part, UserFaultInRow, contact_status};
use inpact_parser::model::Regime;
use std::ops::Range;

/// The jump of potential over the rows of a part, none of which lacks it.
#[derive(Clone, Copy)]
enum Jump<'a> {
    /// A column.
    Given(&'a [f64]),
    /// The difference of slave and master.
    Between(&'a [f64], &'a [f64]),
}

impl<'a> Jump<'a> {
    /// The jump of a source; `None` where a number is missing, or one column is a fallback for another.
    fn of(batch: &'a Batch, source: &Source<usize>) -> Option<Self> {
        let full = |place: usize| full_values(batch, place);
        match *source {
            Source::Cell(cell) | Source::CellOrSides(cell, ..) => Some(Self::Given(full(cell)?)),
            Source::Sides(slave, master) => Some(Self::Between(full(slave)?, full(master)?)),
        }
    }

    fn of_rows(self, rows: &Range<usize>) -> Self {
        match self {
            Self::Given(jump) => Self::Given(&jump[rows.clone()]),
            Self::Between(slave, master) => Self::Between(&slave[rows.clone()], &master[rows.clone()]),
        }
    }
}

/// The numbers of a column that lacks none.
fn full_values(batch: &Batch, place: usize) -> Option<&[f64]> {
    let column = &batch.numbers[place];
    column.presence().is_none_or(|present| present.iter().all(|is_there| *is_there)).then(|| column.values())
}

impl ElectricalColumns {
    /// The law in all rows of a part, none of which has a history or another law; `columns` is the number of columns of numbers in the results.
    pub(crate) fn rows_alone(
        &self,
        part: &Part<'_>,
        found: Option<&ConductanceColumn>,
        columns: usize,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
        faults: &mut Vec<UserFaultInRow>,
    ) {
        let count = part.rows();
        results.reset_statuses(count);
        let inputs = found.and_then(|found| self.full_inputs(part, found));
        let Some(inputs) = inputs else {
            results.reset_numbers(count, columns);
            return self.rows_one_by_one(part, found, 0..count, results, tally, faults);
        };
        let given = self.slots.given(&inputs);
        results.shape(count, columns, |slot| given.contains(&Some(slot)));
        let mut slopes = None;
        let mut first = 0;
        while first < count {
            let rows = first..count.min(first + CHUNK);
            first = rows.end;
            let Some(lost_digits) = self.write_plain(&inputs, &rows, results) else {
                self.rows_one_by_one(part, found, rows, results, tally, faults);
                continue;
            };
            tally.lost_digits += lost_digits;
            if let Some(tables) = self.tables().filter(|_| !self.slopes.is_empty()) {
                let slopes = slopes.get_or_insert_with(|| tables.slopes(part, &self.slopes));
                write_slopes(&self.slopes, slopes, &rows, results);
            }
            if inputs.found.sides.is_empty() {
                set_contact(&part.states[rows.clone()], rows, results);
                continue;
            }
            for index in rows {
                let Some(row) = part.row(index, index) else { continue };
                let status = self.status(row, inputs.found.sides_of(index), tally);
                tally.count_statuses([status, None, None]);
                (results.status[index], results.status_by_law.electrical[index]) = (status, status);
            }
        }
    }

    /// The columns that the law reads of a part, where no row lacks one of their numbers.
    fn full_inputs<'a>(&self, part: &'a Part<'_>, found: &'a ConductanceColumn) -> Option<Inputs<'a>> {
        let batch = part.batch();
        let generation = self.heat_generation;
        let is_plain = !self.accuracy.is_reference()
            && is_moderate(generation.fraction)
            && is_zero_or_ordinary(generation.slave_weight)
            && found.is_full()
            && part.tells_contact();
        if !is_plain {
            return None;
        }
        let jump = match &self.jump {
            Some(source) => Some(Jump::of(batch, source)?),
            None => None,
        };
        let area = match self.area {
            Some(place) => Some(full_values(batch, place)?),
            None => None,
        };
        Some(Inputs { found, jump, area })
    }

    /// Some rows, row by row; those whose contact is undetermined have no results.
    fn rows_one_by_one(
        &self,
        part: &Part<'_>,
        found: Option<&ConductanceColumn>,
        rows: Range<usize>,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
        faults: &mut Vec<UserFaultInRow>,
    ) {
        for index in rows {
            let Some(row) = part.row(index, index) else { continue };
            let (outcome, _) = self.row(row, found, None, results, tally);
            tally.finish_row([Some(outcome), None, None], index, results, faults);
        }
    }

    /// Conductance, current and heat of some rows in plain arithmetic, and the number of those whose jump has lost its digits;
    /// `None`, and nothing written, where a number is extreme.
    fn write_plain(&self, inputs: &Inputs<'_>, rows: &Range<usize>, results: &mut ResultBatch) -> Option<u64> {
        let mut written = Written::default();
        for (slot, column) in results.numbers.iter_mut().enumerate() {
            if let Some(place) = written.place(&self.slots, slot) {
                *place = Some(&mut column.values_mut()[rows.clone()]);
            }
        }
        let operation = WritePlain {
            generation: self.heat_generation,
            regime: self.regime,
            conductance: &inputs.found.values[rows.clone()],
            jump: inputs.jump.map(|jump| jump.of_rows(rows)),
            area: inputs.area.map(|area| &area[rows.clone()]),
            written,
        };
        self.set.run(operation)
    }
}

/// The columns that the law reads, none of which lacks a number.
struct Inputs<'a> {
    found: &'a ConductanceColumn,
    jump: Option<Jump<'a>>,
    area: Option<&'a [f64]>,
}

impl Slots {
    /// Those that every row of a part fills.
    fn given(&self, inputs: &Inputs<'_>) -> [Option<usize>; 8] {
        let of_flow = |slot: Option<usize>| slot.filter(|_| inputs.jump.is_some());
        let of_area = |slot: Option<usize>| of_flow(slot).filter(|_| inputs.area.is_some());
        [
            self.conductance,
            self.weight,
            of_flow(self.ecd),
            of_flow(self.sjd),
            of_flow(self.heat_slave),
            of_flow(self.heat_master),
            of_area(self.ecda),
            of_area(self.sjda),
        ]
    }
}

/// The rows of the columns of results that are written.
#[derive(Default)]
struct Written<'a> {
    conductance: Option<&'a mut [f64]>,
    weight: Option<&'a mut [f64]>,
    current_density: Option<&'a mut [f64]>,
    current: Option<&'a mut [f64]>,
    heat: Option<&'a mut [f64]>,
    heat_of_area: Option<&'a mut [f64]>,
    heat_slave: Option<&'a mut [f64]>,
    heat_master: Option<&'a mut [f64]>,
}

impl<'a> Written<'a> {
    /// The column of a slot, if it is one of the law's.
    fn place(&mut self, slots: &Slots, slot: usize) -> Option<&mut Option<&'a mut [f64]>> {
        let slot = Some(slot);
        let places = [
            (slots.conductance, &mut self.conductance),
            (slots.weight, &mut self.weight),
            (slots.ecd, &mut self.current_density),
            (slots.ecda, &mut self.current),
            (slots.sjd, &mut self.heat),
            (slots.sjda, &mut self.heat_of_area),
            (slots.heat_slave, &mut self.heat_slave),
            (slots.heat_master, &mut self.heat_master),
        ];
        places.into_iter().find(|(of, _)| *of == slot).map(|(_, place)| place)
    }
}

/// Conductance, current and heat of at most [`CHUNK`] rows, compiled for each set of instructions.
struct WritePlain<'a> {
    generation: HeatGeneration,
    regime: Regime,
    conductance: &'a [f64],
    jump: Option<Jump<'a>>,
    area: Option<&'a [f64]>,
    written: Written<'a>,
}

impl Operation for WritePlain<'_> {
    type Output = Option<u64>;

    #[inline(always)]
    fn call<L: Lanes>(self, _: L) -> Option<u64> {
        let Self { generation, regime, conductance, jump, area, written } = self;
        let count = conductance.len();
        let mut lost_digits = 0;
        let mut differences = [0.0; CHUNK];
        let differences = &mut differences[..count];
        let jump = match jump {
            None => None,
            Some(Jump::Given(jump)) => Some(jump),
            Some(Jump::Between(slave, master)) => {
                for ((jump, slave), master) in differences.iter_mut().zip(slave).zip(master) {
                    *jump = slave - master;
                }
                for ((jump, slave), master) in differences.iter().zip(slave).zip(master) {
                    let (slave, master) = (slave.abs(), master.abs());
                    let larger = if slave < master { master } else { slave };
                    lost_digits += u64::from(jump.abs() < LOST_DIGITS * larger);
                }
                Some(&*differences)
            }
        };
        let is_plain = all_moderate(conductance) && jump.is_none_or(all_moderate) && area.is_none_or(all_moderate);
        if !is_plain {
            return None;
        }
        if let Some(column) = written.conductance {
            column.copy_from_slice(conductance);
        }
        if let Some(column) = written.weight {
            column.fill(generation.slave_weight);
        }
        let Some(jump) = jump else { return Some(lost_digits) };
        // Zero current is +0, not −0, by adding 0.
        if let Some(column) = written.current_density {
            for ((current, conductance), jump) in column.iter_mut().zip(conductance).zip(jump) {
                *current = conductance * jump + 0.0;
            }
        }
        if let Some((column, area)) = written.current.zip(area) {
            for (((current, conductance), jump), area) in column.iter_mut().zip(conductance).zip(jump).zip(area) {
                *current = conductance * jump * area + 0.0;
            }
        }
        let mut heats = [0.0; CHUNK];
        let heats = &mut heats[..count];
        let HeatGeneration { fraction, slave_weight } = generation;
        for ((heat, conductance), jump) in heats.iter_mut().zip(conductance).zip(jump) {
            let square = jump * jump;
            let mean_square = match regime {
                Regime::SteadyState => square,
                // Without a history an increment starts as it ends (C-25).
                Regime::Transient => (square + square + square) / 3.0,
            };
            *heat = fraction * (conductance * mean_square);
        }
        let shares =
            [(written.heat, 1.0), (written.heat_slave, slave_weight), (written.heat_master, 1.0 - slave_weight)];
        for (column, share) in shares {
            let Some(column) = column else { continue };
            for (part, heat) in column.iter_mut().zip(&*heats) {
                *part = share * heat + 0.0;
            }
        }
        if let Some((column, area)) = written.heat_of_area.zip(area) {
            for ((of_area, heat), area) in column.iter_mut().zip(&*heats).zip(area) {
                *of_area = heat * area + 0.0;
            }
        }
        Some(lost_digits)
    }
}

#[inline(always)]
fn all_moderate(column: &[f64]) -> bool {
    column.iter().fold(true, |all, value| all & is_moderate(*value))
}

/// Sets the statuses of rows within all tables.
pub(super) fn set_contact(states: &[Option<ContactState>], rows: Range<usize>, results: &mut ResultBatch) {
    let [open, closed] = [ContactState::Open, ContactState::Closed].map(|state| (Some(state), contact_status(state)));
    let statuses = &mut results.status[rows.clone()];
    // Compared and not matched: a table of the cases would keep the loop from its vectors.
    for (status, state) in statuses.iter_mut().zip(states) {
        let apart = if *state == open.0 { open.1 } else { None };
        *status = if *state == closed.0 { closed.1 } else { apart };
    }
    results.status_by_law.electrical[rows].copy_from_slice(statuses);
}
