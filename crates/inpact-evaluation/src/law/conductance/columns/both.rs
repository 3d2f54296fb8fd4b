//! Both branches of a conductance evaluated at all rows; each row takes the one of its state.
//!
//! Where both tables are small, a value costs less than partitioning the rows and merging them again: open and closed rows alternate unpredictably.
//! Rows that do not use a table are given an abscissa within it, so that they neither count as outside nor take the slow path of a NaN.

#![expect(
    clippy::inline_always,
    reason = "what is not inlined is compiled without the instruction set that was asked for"
)]

use super::{Branch, BranchColumns, ConductanceColumn, place};
use crate::evaluator::{Evaluator, SeenError};
use crate::kernel::{InstructionSet, Lanes, OnlyRange, Operation, TableKernel};
use crate::law::contact::ContactState;
use crate::law::contact::columns::count_states;
use crate::rows::Part;
use crate::table::Sides;

/// The block size in rows, so that intermediate values stay in the L1 cache.
const CHUNK: usize = 512;

/// A table with the abscissa of the rows that do not read it.
#[derive(Clone, Copy)]
struct Small<'a> {
    kernel: &'a TableKernel,
    range: OnlyRange,
    neutral: f64,
}

impl<'a> Small<'a> {
    fn of(form: &'a Evaluator) -> Option<Self> {
        let (kernel, range) = form.small_kernel()?;
        let neutral = form.table().axes().first()?.least;
        Some(Self { kernel, range, neutral })
    }
}

impl BranchColumns {
    /// The conductance of every row, where both tables are small and closed and open rows, none of which lacks its abscissa, are mixed.
    pub(super) fn evaluate_both(&self, part: &Part<'_>, seen: Option<&mut SeenError>) -> Option<ConductanceColumn> {
        let [clearance_form, pressure_form] = &self.forms;
        let has_all = |branch| part.has_all_abscissae(branch);
        if !part.is_mixed() || !has_all(Branch::Clearance) || !has_all(Branch::Pressure) {
            return None;
        }
        let clearance = Small::of(clearance_form.as_ref()?)?;
        let pressure = Small::of(pressure_form.as_ref()?)?;
        let (clearances, pressures) = (part.clearances(), part.pressures());
        let set = InstructionSet::best();
        let mut column = ConductanceColumn { values: vec![0.0; part.rows()], ..ConductanceColumn::default() };
        let (mut of_clearance, mut of_pressure) = ([0.0; CHUNK], [0.0; CHUNK]);
        let (mut open_values, mut first) = ([0.0; CHUNK], 0);
        for values in column.values.chunks_mut(CHUNK) {
            let rows = first..first + values.len();
            let states = &part.states[rows.clone()];
            let of_clearance = &mut of_clearance[..rows.len()];
            let of_pressure = &mut of_pressure[..rows.len()];
            let open_values = &mut open_values[..rows.len()];
            set.run(FindAbscissae {
                states,
                given: [&clearances[rows.clone()], &pressures[rows.clone()]],
                neutral: [clearance.neutral, pressure.neutral],
                abscissae: [&mut *of_clearance, &mut *of_pressure],
            });
            clearance.kernel.values(&[of_clearance], open_values);
            pressure.kernel.values(&[of_pressure], values);
            set.run(Choose { states, open: open_values, values });
            for (range, abscissae) in [(clearance.range, &*of_clearance), (pressure.range, &*of_pressure)] {
                if range.is_left_by(&[abscissae], rows.len()) {
                    column.sides.resize(part.rows(), Sides::default());
                    let sides = column.sides[rows.clone()].iter_mut().zip(abscissae);
                    // A row that does not read the table is within it.
                    sides.for_each(|(sides, x)| *sides = sides.or(range.sides(*x)));
                }
            }
            first = rows.end;
        }
        if let Some(seen) = seen {
            for (state, branch) in [(ContactState::Open, Branch::Clearance), (ContactState::Closed, Branch::Pressure)] {
                if let Some(form) = &self.forms[place(branch)] {
                    compare(part, (state, branch), form, &column.values, seen);
                }
            }
        }
        Some(column)
    }
}

/// Compares some of the values of a branch, evenly spaced over the rows that read it, with the reference.
fn compare(
    part: &Part<'_>,
    (state, branch): (ContactState, Branch),
    form: &Evaluator,
    values: &[f64],
    seen: &mut SeenError,
) {
    let given = if branch == Branch::Pressure { part.pressures() } else { part.clearances() };
    let count = if state == ContactState::Closed { part.closed } else { part.open };
    for row in rows_of(&part.states, state, Evaluator::compared(usize::try_from(count).unwrap_or(usize::MAX))) {
        let of_table =
            if branch == Branch::Pressure { Some(given[row]) } else { state.table_clearance(Some(given[row])) };
        form.compare_one(of_table.unwrap_or(f64::NAN), values[row], seen);
    }
}

/// The rows that have a state, those with these places among them, which ascend.
fn rows_of(
    states: &[Option<ContactState>],
    state: ContactState,
    places: impl Iterator<Item = usize>,
) -> impl Iterator<Item = usize> {
    const BLOCK: usize = 128;
    // The number of them before this row.
    let (mut row, mut before) = (0, 0);
    places.map_while(move |place| {
        while row < states.len() {
            let block = &states[row..states.len().min(row + BLOCK)];
            let of_block = usize::try_from(count_states(block, Some(state))).unwrap_or(usize::MAX);
            if place < before + of_block {
                let mut own = block.iter().enumerate().filter(|(_, found)| **found == Some(state));
                return own.nth(place - before).map(|(index, _)| row + index);
            }
            (row, before) = (row + BLOCK, before + of_block);
        }
        None
    })
}

/// The abscissae of some rows in both tables.
struct FindAbscissae<'a> {
    states: &'a [Option<ContactState>],
    /// Clearances and pressures.
    given: [&'a [f64]; 2],
    neutral: [f64; 2],
    abscissae: [&'a mut [f64]; 2],
}

impl Operation for FindAbscissae<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes>(self, _: L) {
        let Self { states, given: [clearances, pressures], neutral, abscissae: [of_clearance, of_pressure] } = self;
        for ((state, clearance), abscissa) in states.iter().zip(clearances).zip(of_clearance) {
            // Overclosure counts as zero clearance (J-5); NaN stays NaN.
            let clearance = if *clearance < 0.0 { 0.0 } else { *clearance };
            *abscissa = if *state == Some(ContactState::Closed) { neutral[0] } else { clearance };
        }
        for ((state, pressure), abscissa) in states.iter().zip(pressures).zip(of_pressure) {
            *abscissa = if *state == Some(ContactState::Closed) { *pressure } else { neutral[1] };
        }
    }
}

/// Merges the values of open rows into those of closed ones.
struct Choose<'a> {
    states: &'a [Option<ContactState>],
    open: &'a [f64],
    values: &'a mut [f64],
}

impl Operation for Choose<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes>(self, _: L) {
        for ((state, open), value) in self.states.iter().zip(self.open).zip(self.values) {
            *value = if *state == Some(ContactState::Closed) { *value } else { *open };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_found_by_their_place_among_those_of_a_state() {
        let kinds = [Some(ContactState::Open), Some(ContactState::Closed), None];
        let states: Vec<_> = (0..1000_usize).map(|row| kinds[(row * row / 7) % 3]).collect();
        for state in [ContactState::Open, ContactState::Closed] {
            let all: Vec<usize> = (0..states.len()).filter(|row| states[*row] == Some(state)).collect();
            for step in [1, 2, 13, 400] {
                let places = (0..all.len()).step_by(step);
                let expected: Vec<usize> = places.clone().map(|place| all[place]).collect();
                assert_eq!(rows_of(&states, state, places).collect::<Vec<_>>(), expected);
            }
        }
    }
}
