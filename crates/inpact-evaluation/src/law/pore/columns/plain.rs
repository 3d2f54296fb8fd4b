//! Steady pore fluid flow over the rows of a part by plain arithmetic, in columns: the bits of [`PoreColumns::row`] where no number is missing and none is extreme.

use super::{Length, PoreColumns};
use crate::evaluate::{InteractionTally, Outcome, PERMEABILITY, Part, contact_status};
use crate::evaluator::TableValues;
use crate::kernel::scan::are_moderate;
use crate::law::contact::ContactState;
use crate::law::pore::CutoffBoundary;
use crate::numbers::is_moderate;
use crate::results::{ResultBatch, Status};
use inpact_parser::model::Regime;
use std::ops::Range;

/// Rows that are looked at together before any of them is written.
const CHUNK: usize = 256;

/// The numbers that the flow across a part follows from, NaN where one is missing.
#[derive(Clone, Copy)]
struct Inputs<'p> {
    clearances: &'p [f64],
    permeabilities: &'p [f64],
    /// Of slave and master.
    pressures: Option<[&'p [f64]; 2]>,
    jump: Option<&'p [f64]>,
    area: Option<&'p [f64]>,
    cutoff: Cutoff<'p>,
}

/// The clearance up to which fluid crosses.
#[derive(Clone, Copy)]
enum Cutoff<'p> {
    Of(f64),
    Column(&'p [f64]),
}

/// Flow across some rows: the permeability in force, zero beyond the cutoff, and the flow from master to slave.
struct Flows {
    permeability: [f64; CHUNK],
    crossing: [f64; CHUNK],
    is_cut_off: [bool; CHUNK],
}

impl PoreColumns {
    /// The law in all rows of a part, none of which has a history; gives their statuses.
    pub(crate) fn rows(
        &self,
        part: &Part<'_>,
        found: &TableValues,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> Vec<Outcome> {
        let clearances = part.clearances();
        let inputs = self.inputs(part, found, &clearances);
        let mut flows = Flows { permeability: [0.0; CHUNK], crossing: [0.0; CHUNK], is_cut_off: [false; CHUNK] };
        let mut outcomes = Vec::with_capacity(part.rows());
        let mut slopes: Option<Vec<Vec<f64>>> = None;
        let mut first = 0;
        while first < part.rows() {
            let rows = first..part.rows().min(first + CHUNK);
            first = rows.end;
            let plain = inputs.filter(|inputs| self.find_flows(*inputs, part, rows.clone(), &mut flows));
            if let Some(inputs) = plain {
                self.write_flows(inputs, &flows, rows.clone(), results);
                let slopes = slopes.get_or_insert_with(|| self.slope_columns(part));
                for ((slot, _), column) in self.slopes.iter().zip(&*slopes) {
                    let (column, is_cut_off) = (&column[rows.clone()], &flows.is_cut_off);
                    results.set_rows(Some(*slot), &rows, |row| if is_cut_off[row] { 0.0 } else { column[row] });
                }
                outcomes.extend(rows.clone().map(|index| {
                    let sides = found.sides_of(index);
                    Outcome::Evaluated(if flows.is_cut_off[index - rows.start] {
                        Some(Status::Cutoff)
                    } else if sides.is_within() {
                        part.states[index].and_then(contact_status)
                    } else {
                        tally.count_sides(PERMEABILITY, sides);
                        Some(Status::BeyondTable)
                    })
                }));
                continue;
            }
            outcomes.extend(rows.map(|index| match part.row(index, index) {
                Some(row) => self.row(row, found, None, results, tally),
                // Where contact cannot be told no law is evaluated.
                None => Outcome::Incomplete,
            }));
        }
        outcomes
    }

    /// The inputs of steady flow across a part; `None` where it takes more than a product.
    fn inputs<'p>(&self, part: &'p Part<'_>, found: &'p TableValues, clearances: &'p [f64]) -> Option<Inputs<'p>> {
        let column = |place: usize| part.batch().numbers[place].values();
        let cutoff = match (self.law.cutoffs.flow_across, self.characteristic_length) {
            (Some(cutoff), _) | (None, Length::Given(cutoff)) => Cutoff::Of(cutoff),
            (None, Length::Place(place)) => Cutoff::Column(column(place)),
            (None, Length::Unknown) => return None,
        };
        let inputs = Inputs {
            clearances,
            permeabilities: &found.values,
            pressures: self.pressures.map(|(slave, master)| [column(slave), column(master)]),
            jump: self.jump.map(column),
            area: self.area.map(column),
            cutoff,
        };
        let needs_mean = self.needs.variables.contains(&0);
        let is_difference_known = inputs.pressures.is_some() || inputs.jump.is_some() && !needs_mean;
        let is_rounded = found.rests.is_empty() && found.values.len() == part.rows();
        // A gap that does not change is filled by nothing, whatever its shares, as long as they are numbers.
        let is_plain = self.regime == Regime::SteadyState && self.bulk.is_none();
        (self.form.is_some() && is_plain && is_difference_known && is_rounded).then_some(inputs)
    }

    /// Finds the flow across some rows; false where a number is missing, extreme, infinite or NaN.
    fn find_flows(&self, inputs: Inputs<'_>, part: &Part<'_>, rows: Range<usize>, flows: &mut Flows) -> bool {
        let Inputs { clearances, permeabilities, pressures, jump, area, cutoff } = inputs.of(rows.clone());
        let columns = [Some(clearances), Some(permeabilities), jump, area];
        let mut columns = columns.into_iter().flatten().chain(pressures.into_iter().flatten());
        let can_be_told = |state: &Option<ContactState>| !matches!(state, None | Some(ContactState::Undetermined));
        if !columns.all(are_moderate) || !part.states[rows.clone()].iter().all(can_be_told) {
            return false;
        }
        let mut is_plain = true;
        for row in 0..rows.len() {
            let cutoff = match cutoff {
                Cutoff::Of(cutoff) => cutoff,
                Cutoff::Column(column) => column[row],
            };
            is_plain &= is_moderate(cutoff);
            let is_cut_off = match self.law.boundary {
                CutoffBoundary::Inclusive => cutoff < clearances[row],
                CutoffBoundary::Exclusive => cutoff <= clearances[row],
            };
            let difference = match (jump, pressures) {
                (Some(jump), _) => 0.0 - jump[row],
                (None, Some([slave, master])) => master[row] - slave[row],
                (None, None) => return false,
            };
            let flow = permeabilities[row] * difference;
            flows.is_cut_off[row] = is_cut_off;
            flows.permeability[row] = if is_cut_off { 0.0 } else { permeabilities[row] };
            flows.crossing[row] = if is_cut_off { 0.0 } else { flow };
        }
        is_plain
    }

    fn write_flows(&self, inputs: Inputs<'_>, flows: &Flows, rows: Range<usize>, results: &mut ResultBatch) {
        let slots = &self.slots;
        let count = rows.len();
        let area = inputs.of(rows.clone()).area;
        let (permeability, crossing) = (&flows.permeability[..count], &flows.crossing[..count]);
        results.set_rows(slots.permeability, &rows, |row| permeability[row]);
        results.set_rows(slots.q_across, &rows, |row| crossing[row]);
        results.set_rows(slots.q_gap_slave, &rows, |_| 0.0);
        results.set_rows(slots.q_gap_master, &rows, |_| 0.0);
        // Sums with nothing: no flow is 0, not −0.
        results.set_rows(slots.q_slave, &rows, |row| crossing[row] + 0.0);
        results.set_rows(slots.q_master, &rows, |row| 0.0 - crossing[row]);
        results.set_rows(slots.pfl, &rows, |row| 0.0 - crossing[row]);
        if let Some(area) = area {
            results.set_rows(slots.pfla, &rows, |row| (0.0 - crossing[row]) * area[row]);
        }
    }
}

impl<'p> Inputs<'p> {
    /// Those of some rows.
    fn of(self, rows: Range<usize>) -> Self {
        let column = |column: &'p [f64]| &column[rows.clone()];
        Self {
            clearances: column(self.clearances),
            permeabilities: column(self.permeabilities),
            pressures: self.pressures.map(|sides| sides.map(column)),
            jump: self.jump.map(column),
            area: self.area.map(column),
            cutoff: match self.cutoff {
                Cutoff::Of(cutoff) => Cutoff::Of(cutoff),
                Cutoff::Column(cutoffs) => Cutoff::Column(column(cutoffs)),
            },
        }
    }
}
