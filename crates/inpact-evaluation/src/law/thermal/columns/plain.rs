//! Heat over the rows of a part in plain arithmetic, by column: bitwise equal to [`ThermalColumns::row`] where no number is missing and none is extreme.

use super::{ThermalColumns, ThermalFound};
use crate::kernel::scan::are_moderate;
use crate::law::conductance::columns::write_slopes;
use crate::law::contact::ContactState;
use crate::law::heat::HeatAmounts;
use crate::numbers::compensated_sum;
use crate::results::{ResultBatch, Status};
use crate::rows::{InteractionTally, Outcome, Part, VIEW_FACTOR, contact_status};
use std::ops::Range;

/// The block size in rows; inputs are checked before any row of a block is written.
const CHUNK: usize = 256;

/// The inputs of the heat of a part, NaN where one is missing.
#[derive(Clone, Copy)]
struct Inputs<'p> {
    conductances: Option<&'p [f64]>,
    /// Of slave and master.
    temperatures: Option<[&'p [f64]; 2]>,
    jump: Option<&'p [f64]>,
    area: Option<&'p [f64]>,
    /// The heat of the current, where it is part of that of the interface.
    current: Option<&'p [Option<HeatAmounts>]>,
}

/// Heat of some rows: conducted, radiated and generated, and the sums.
struct Heats {
    conduction: [f64; CHUNK],
    radiation: [f64; CHUNK],
    /// Of friction: in all, into the slave, into the master surface.
    friction: [[f64; CHUNK]; 3],
    leaving_slave: [f64; CHUNK],
    into_master: [f64; CHUNK],
}

impl ThermalColumns {
    /// The law in all rows of a part without histories, given the heat of the current in each; returns their statuses.
    pub(crate) fn rows(
        &self,
        part: &Part<'_>,
        found: &ThermalFound,
        current: &[Option<HeatAmounts>],
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> Vec<Outcome> {
        let inputs = self.inputs(part, found, current);
        let mut heats = inputs.map(|_| Box::new(Heats::none()));
        let mut outcomes = Vec::with_capacity(part.rows());
        let mut slopes: Option<Vec<Vec<f64>>> = None;
        let mut first = 0;
        while first < part.rows() {
            let rows = first..part.rows().min(first + CHUNK);
            first = rows.end;
            let mut both = inputs.zip(heats.as_mut());
            let plain = both.take_if(|(inputs, heats)| self.find_heats(*inputs, (part, found), rows.clone(), heats));
            if let Some((inputs, heats)) = plain {
                self.write_heats(inputs, heats, rows.clone(), results);
                self.count_heats(inputs, heats, rows.clone(), tally);
                if let Some(conduction) = &self.conduction {
                    let slopes = slopes.get_or_insert_with(|| conduction.slopes(part));
                    write_slopes(&conduction.slopes, slopes, &rows, results);
                }
                outcomes.extend(rows.map(|index| self.outcome(part, found, index, tally)));
                continue;
            }
            outcomes.extend(rows.map(|index| match part.row(index, index) {
                Some(row) => self.row(row, found, current.get(index).copied().flatten(), None, results, tally),
                // Where contact is undetermined no law is evaluated.
                None => Outcome::Incomplete,
            }));
        }
        outcomes
    }

    /// The inputs of the heat of a part; `None` where a column is missing, or where double-double is requested.
    fn inputs<'p>(
        &self,
        part: &'p Part<'_>,
        found: &'p ThermalFound,
        current: &'p [Option<HeatAmounts>],
    ) -> Option<Inputs<'p>> {
        let column = |place: usize| part.batch().numbers[place].values();
        let takes_current = self.takes_heat_of_current();
        let inputs = Inputs {
            conductances: self.conduction.as_ref().map(|_| &found.conductances.values[..]),
            temperatures: self.temperatures.map(|(slave, master)| [column(slave), column(master)]),
            jump: self.jump.map(column),
            area: self.area.map(column),
            current: takes_current.then_some(current),
        };
        // Radiation depends on more than the difference.
        let is_crossing_known = match (inputs.temperatures, inputs.jump) {
            (Some(_), _) => true,
            (None, Some(_)) => self.radiation.is_none(),
            (None, None) => self.conduction.is_none() && self.radiation.is_none(),
        };
        let gives_something = self.conduction.is_some() || self.radiation.is_some() || self.friction.is_some();
        let is_current_known = !takes_current || current.len() == part.rows();
        let is_rounded = found.conductances.rests.is_empty();
        (is_crossing_known && gives_something && is_current_known && is_rounded).then_some(inputs)
    }

    /// Computes the heat of some rows; false where a number is missing, extreme, infinite or NaN.
    fn find_heats(
        &self,
        inputs: Inputs<'_>,
        (part, found): (&Part<'_>, &ThermalFound),
        rows: Range<usize>,
        heats: &mut Heats,
    ) -> bool {
        let count = rows.len();
        let Inputs { conductances, temperatures, jump, area, current } = inputs.of(rows.clone());
        let mut columns = [conductances, jump, area].into_iter().flatten().chain(temperatures.into_iter().flatten());
        let can_be_told = |state: &Option<ContactState>| !matches!(state, None | Some(ContactState::Undetermined));
        if !columns.all(are_moderate) || !part.states[rows.clone()].iter().all(can_be_told) {
            return false;
        }
        let mut is_plain = true;
        if let Some(conductances) = conductances {
            let heat = heats.conduction[..count].iter_mut().zip(conductances);
            // Same expression as `conducted_heat` for such numbers; zero heat is +0, not −0.
            match (jump, temperatures) {
                (Some(jump), _) => heat.zip(jump).for_each(|((heat, k), jump)| *heat = k * jump + 0.0),
                (None, Some([slave, master])) => {
                    let sides = slave.iter().zip(master);
                    heat.zip(sides).for_each(|((heat, k), (slave, master))| *heat = k * (slave - master) + 0.0);
                }
                (None, None) => return false,
            }
        }
        if let (Some(radiation), Some(sides)) = (&self.radiation, temperatures) {
            let view_factors = &found.view_factors[rows.clone()];
            is_plain &= radiation.plain_heats(view_factors, sides, jump, &mut heats.radiation[..count]);
        }
        if let Some(friction) = self.friction {
            let columns = heats.friction.each_mut().map(|column| &mut column[..count]);
            is_plain &= friction.plain_heats(part, rows, columns);
        }
        is_plain && heats.add_up(current, count)
    }

    fn write_heats(&self, inputs: Inputs<'_>, heats: &Heats, rows: Range<usize>, results: &mut ResultBatch) {
        let slots = &self.slots;
        let Inputs { conductances, area, .. } = inputs.of(rows.clone());
        let count = rows.len();
        let (leaving, into_master) = (&heats.leaving_slave[..count], &heats.into_master[..count]);
        results.set_rows(slots.hfl, &rows, |row| leaving[row]);
        results.set_rows(slots.into_slave, &rows, |row| 0.0 - leaving[row]);
        results.set_rows(slots.into_master, &rows, |row| into_master[row]);
        if let Some(conductances) = conductances {
            results.set_rows(slots.conductance, &rows, |row| conductances[row]);
            results.set_rows(slots.conduction, &rows, |row| heats.conduction[row]);
        }
        if self.radiation.is_some() {
            results.set_rows(slots.radiation, &rows, |row| heats.radiation[row]);
        }
        if let Some(area) = area {
            results.set_rows(slots.hfla, &rows, |row| leaving[row] * area[row]);
        }
        if let Some(friction) = self.friction {
            let [rubbed, ..] = &heats.friction;
            results.set_rows(slots.weight, &rows, |_| friction.generation.slave_weight);
            results.set_rows(slots.sfdr, &rows, |row| rubbed[row]);
            if let Some(area) = area {
                results.set_rows(slots.sfdra, &rows, |row| rubbed[row] * area[row]);
            }
        }
    }

    /// Counts remarks on some rows.
    fn count_heats(&self, inputs: Inputs<'_>, heats: &Heats, rows: Range<usize>, tally: &mut InteractionTally) {
        let count = rows.len();
        if let (Some(radiation), Some([slave, master])) = (&self.radiation, inputs.of(rows).temperatures) {
            tally.below_absolute_zero += radiation.rows_below_absolute_zero(slave, master);
        }
        if self.friction.is_some() {
            tally.negative_friction +=
                heats.friction[0][..count].iter().map(|heat| u64::from(*heat < 0.0)).sum::<u64>();
        }
    }

    /// The status of a row with heat.
    #[inline]
    fn outcome(&self, part: &Part<'_>, found: &ThermalFound, index: usize, tally: &mut InteractionTally) -> Outcome {
        let Some(state) = part.states[index] else { return Outcome::Incomplete };
        let mut is_within = true;
        if let Some(conduction) = &self.conduction {
            let sides = found.conductances.sides_of(index);
            if !sides.is_within() {
                conduction.count_sides(state, sides, tally);
                is_within = false;
            }
        }
        if self.radiation.is_some() {
            let (_, sides) = found.view_factors[index];
            if !sides.is_within() {
                tally.count_sides(VIEW_FACTOR, sides);
                is_within = false;
            }
        }
        Outcome::Evaluated(if is_within { contact_status(state) } else { Some(Status::BeyondTable) })
    }
}

impl<'p> Inputs<'p> {
    /// Those of some rows.
    fn of(self, rows: Range<usize>) -> Self {
        let column = |column: &'p [f64]| &column[rows.clone()];
        Self {
            conductances: self.conductances.map(column),
            temperatures: self.temperatures.map(|sides| sides.map(column)),
            jump: self.jump.map(column),
            area: self.area.map(column),
            current: self.current.map(|current| &current[rows.clone()]),
        }
    }
}

impl Heats {
    fn none() -> Self {
        let nothing = [0.0; CHUNK];
        Self {
            conduction: nothing,
            radiation: nothing,
            friction: [nothing; 3],
            leaving_slave: nothing,
            into_master: nothing,
        }
    }

    /// The sums of the first rows; false where the heat of the current is missing or extreme, or a sum is.
    fn add_up(&mut self, current: Option<&[Option<HeatAmounts>]>, count: usize) -> bool {
        let mut are_finite = true;
        for row in 0..count {
            let [into_slave, into_master] = match current {
                None => [0.0; 2],
                Some(current) => match current[row].and_then(|heat| heat.plain_shares()) {
                    Some(shares) => shares,
                    None => return false,
                },
            };
            let (conduction, radiation) = (self.conduction[row], self.radiation[row]);
            let [_, slave, master] = self.friction.each_ref().map(|column| column[row]);
            let leaving = compensated_sum([conduction, radiation, -into_slave, -slave]);
            let into_master = compensated_sum([conduction, radiation, into_master, master]);
            are_finite &= leaving.is_finite() & into_master.is_finite();
            // Zero heat is +0, not −0.
            (self.leaving_slave[row], self.into_master[row]) = (leaving + 0.0, into_master + 0.0);
        }
        are_finite
    }
}
