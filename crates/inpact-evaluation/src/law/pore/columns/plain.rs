//! Pore fluid flow over the rows of a part without histories in plain arithmetic, by column: bitwise equal to [`PoreColumns::row`] where no number is missing and none is extreme.

use super::{Length, PoreColumns};
use crate::evaluator::TableValues;
use crate::kernel::scan::are_moderate;
use crate::law::contact::{Clearance, ClearanceRate, ContactState};
use crate::law::pore::{BulkPermeabilities, CutoffBoundary, given_rate};
use crate::numbers::{compensated_sum, is_moderate};
use crate::results::{ResultBatch, Status};
use crate::rows::{InteractionTally, Outcome, PERMEABILITY, Part, contact_status};
use inpact_parser::model::Regime;
use std::ops::Range;

/// The block size in rows; inputs are checked before any row of a block is written.
const CHUNK: usize = 256;

/// The inputs of the flow across a part, NaN where one is missing.
#[derive(Clone, Copy)]
struct Inputs<'p> {
    clearances: &'p [f64],
    permeabilities: &'p [f64],
    /// Of slave and master.
    pressures: Option<[&'p [f64]; 2]>,
    jump: Option<&'p [f64]>,
    area: Option<&'p [f64]>,
    cutoff: Cutoff<'p>,
    /// The change of the gap; `None` in steady state.
    gap: Option<GapInputs<'p>>,
}

/// The inputs of the filling of a changing gap, NaN where one is missing.
#[derive(Clone, Copy)]
struct GapInputs<'p> {
    /// The given rates; without them no gap changes.
    rates: Option<&'p [f64]>,
    cutoff: Cutoff<'p>,
    /// Bulk permeabilities behind slave and master.
    bulk: Option<[&'p [f64]; 2]>,
}

/// The clearance up to which fluid crosses.
#[derive(Clone, Copy)]
enum Cutoff<'p> {
    Of(f64),
    Column(&'p [f64]),
}

/// Flow of some rows: the permeability in force, zero beyond the cutoff, the flow from master to slave, that out of the closing gap into slave and master, and the sums.
struct Flows {
    permeability: [f64; CHUNK],
    crossing: [f64; CHUNK],
    filling: [[f64; CHUNK]; 2],
    into: [[f64; CHUNK]; 2],
    leaving_slave: [f64; CHUNK],
    is_cut_off: [bool; CHUNK],
}

impl Flows {
    fn none() -> Self {
        let nothing = [0.0; CHUNK];
        Self {
            permeability: nothing,
            crossing: nothing,
            filling: [nothing; 2],
            into: [nothing; 2],
            leaving_slave: nothing,
            is_cut_off: [false; CHUNK],
        }
    }

    /// Sums flow across and gap filling; false where a sum is not finite.
    fn add_up(&mut self, count: usize) -> bool {
        let mut are_finite = true;
        for row in 0..count {
            let (crossing, [slave, master]) = (self.crossing[row], self.filling.each_ref().map(|filling| filling[row]));
            let sums = [[slave, crossing], [master, -crossing], [-slave, -crossing]].map(compensated_sum);
            are_finite &= sums.iter().all(|sum| sum.is_finite());
            // Zero flow is +0, not −0.
            let [into_slave, into_master, leaving] = sums.map(|sum| sum + 0.0);
            (self.into[0][row], self.into[1][row], self.leaving_slave[row]) = (into_slave, into_master, leaving);
        }
        are_finite
    }
}

impl Cutoff<'_> {
    /// That of some rows.
    fn of(self, rows: Range<usize>) -> Self {
        match self {
            Self::Of(cutoff) => Self::Of(cutoff),
            Self::Column(cutoffs) => Self::Column(&cutoffs[rows]),
        }
    }

    #[inline]
    fn at(self, row: usize) -> f64 {
        match self {
            Self::Of(cutoff) => cutoff,
            Self::Column(column) => column[row],
        }
    }
}

impl PoreColumns {
    /// The law in all rows of a part without histories; returns their statuses.
    pub(crate) fn rows(
        &self,
        part: &Part<'_>,
        found: &TableValues,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> Vec<Outcome> {
        let clearances = part.clearances();
        let inputs = self.inputs(part, found, &clearances);
        let mut flows = Flows::none();
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
                // Where contact is undetermined no law is evaluated.
                None => Outcome::Incomplete,
            }));
        }
        outcomes
    }

    /// The inputs of flow across a part; `None` where it takes more than a product.
    fn inputs<'p>(&self, part: &'p Part<'_>, found: &'p TableValues, clearances: &'p [f64]) -> Option<Inputs<'p>> {
        let column = |place: usize| part.batch().numbers[place].values();
        let cutoff_of = |given: Option<f64>| match (given, self.characteristic_length) {
            (Some(cutoff), _) | (None, Length::Given(cutoff)) => Some(Cutoff::Of(cutoff)),
            (None, Length::Place(place)) => Some(Cutoff::Column(column(place))),
            (None, Length::Unknown) => None,
        };
        let gap = match self.regime {
            // A constant gap takes up no fluid, whatever the shares.
            Regime::SteadyState => None,
            Regime::Transient => Some(GapInputs {
                rates: self.rate.map(column),
                cutoff: cutoff_of(self.law.cutoffs.gap_fill)?,
                bulk: self.bulk.map(|(slave, master)| [column(slave), column(master)]),
            }),
        };
        let inputs = Inputs {
            clearances,
            permeabilities: &found.values,
            pressures: self.pressures.map(|(slave, master)| [column(slave), column(master)]),
            jump: self.jump.map(column),
            area: self.area.map(column),
            cutoff: cutoff_of(self.law.cutoffs.flow_across)?,
            gap,
        };
        let needs_mean = self.needs.variables.contains(&0);
        let is_difference_known = inputs.pressures.is_some() || inputs.jump.is_some() && !needs_mean;
        let is_rounded = found.rests.is_empty() && found.values.len() == part.rows();
        (self.form.is_some() && is_difference_known && is_rounded).then_some(inputs)
    }

    /// Computes the flow across some rows; false where a number is missing, extreme, infinite or NaN.
    fn find_flows(&self, inputs: Inputs<'_>, part: &Part<'_>, rows: Range<usize>, flows: &mut Flows) -> bool {
        let Inputs { clearances, permeabilities, pressures, jump, area, cutoff, gap } = inputs.of(rows.clone());
        let columns = [Some(clearances), Some(permeabilities), jump, area];
        let mut columns = columns.into_iter().flatten().chain(pressures.into_iter().flatten());
        let can_be_told = |state: &Option<ContactState>| !matches!(state, None | Some(ContactState::Undetermined));
        if !columns.all(are_moderate) || !part.states[rows.clone()].iter().all(can_be_told) {
            return false;
        }
        let mut is_plain = true;
        for row in 0..rows.len() {
            let cutoff = cutoff.at(row);
            is_plain &= is_moderate(cutoff);
            let is_cut_off = self.is_beyond(cutoff, clearances[row]);
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
        let is_filled = gap.is_none_or(|gap| self.fill(gap, clearances, &mut flows.filling));
        is_plain && is_filled && flows.add_up(rows.len())
    }

    /// Computes the flow out of the gap of some rows; false where a number is missing, negative, extreme, infinite or NaN.
    fn fill(&self, gap: GapInputs<'_>, clearances: &[f64], filling: &mut [[f64; CHUNK]; 2]) -> bool {
        let GapInputs { rates, cutoff, bulk } = gap;
        let mut is_plain = rates.is_none_or(are_moderate);
        for (row, clearance) in clearances.iter().enumerate() {
            let cutoff = cutoff.at(row);
            let rate = if self.is_beyond(cutoff, *clearance) {
                0.0
            } else {
                given_rate(Clearance(*clearance), ClearanceRate(rates.map_or(0.0, |rates| rates[row])))
            };
            let bulk = bulk.map(|[slave, master]| BulkPermeabilities { slave: slave[row], master: master[row] });
            let (slave, master) = self.law.gap_shares(bulk);
            let is_share = |share: f64| 0.0 <= share && is_moderate(share);
            is_plain &= is_moderate(cutoff) && is_share(slave) && is_share(master);
            (filling[0][row], filling[1][row]) = (0.0 - slave * rate, 0.0 - master * rate);
        }
        is_plain
    }

    /// Whether surfaces at a clearance are beyond a cutoff.
    #[inline]
    fn is_beyond(&self, cutoff: f64, clearance: f64) -> bool {
        match self.law.boundary {
            CutoffBoundary::Inclusive => cutoff < clearance,
            CutoffBoundary::Exclusive => cutoff <= clearance,
        }
    }

    fn write_flows(&self, inputs: Inputs<'_>, flows: &Flows, rows: Range<usize>, results: &mut ResultBatch) {
        let slots = &self.slots;
        let count = rows.len();
        let area = inputs.of(rows.clone()).area;
        let (permeability, crossing) = (&flows.permeability[..count], &flows.crossing[..count]);
        results.set_rows(slots.permeability, &rows, |row| permeability[row]);
        results.set_rows(slots.q_across, &rows, |row| crossing[row]);
        let [gap_slave, gap_master] = flows.filling.each_ref().map(|column| &column[..count]);
        let [slave, master] = flows.into.each_ref().map(|column| &column[..count]);
        let leaving = &flows.leaving_slave[..count];
        results.set_rows(slots.q_gap_slave, &rows, |row| gap_slave[row]);
        results.set_rows(slots.q_gap_master, &rows, |row| gap_master[row]);
        results.set_rows(slots.q_slave, &rows, |row| slave[row]);
        results.set_rows(slots.q_master, &rows, |row| master[row]);
        results.set_rows(slots.pfl, &rows, |row| leaving[row]);
        if let Some(area) = area {
            results.set_rows(slots.pfla, &rows, |row| leaving[row] * area[row]);
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
            cutoff: self.cutoff.of(rows.clone()),
            gap: self.gap.map(|GapInputs { rates, cutoff, bulk }| GapInputs {
                rates: rates.map(column),
                cutoff: cutoff.of(rows.clone()),
                bulk: bulk.map(|sides| sides.map(column)),
            }),
        }
    }
}
