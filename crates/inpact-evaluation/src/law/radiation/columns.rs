//! Radiation over the rows of a part: view factors by column, and heat too where no number is missing or extreme.

use super::{RadiationLaw, is_mild, plain_heat};
use crate::kernel::TableKernel;
use crate::law::thermal::Temperatures;
use crate::numbers::{Amount, is_moderate};
use crate::rows::{InteractionTally, Part, Row, VIEW_FACTOR};
use crate::table::Sides;

/// Radiation; it needs the clearance of open rows.
#[derive(Debug, Clone)]
pub(crate) struct RadiationColumns {
    law: RadiationLaw,
    view_factor: TableKernel,
}

impl RadiationColumns {
    /// A law over columns.
    pub(crate) fn new(law: &RadiationLaw) -> Self {
        Self { law: law.clone(), view_factor: TableKernel::new(&law.view_factor) }
    }

    /// The view factor of every row; NaN where the clearance is unknown ([`RadiationLaw::view_factor`]).
    pub(crate) fn view_factors(&self, part: &Part<'_>) -> Vec<(f64, Sides)> {
        let clearances = part.clearances();
        let states = part.states.iter().zip(&*clearances);
        let clearances: Vec<f64> = states
            .map(|(state, clearance)| {
                state.and_then(|state| state.table_clearance(Some(*clearance))).unwrap_or(f64::NAN)
            })
            .collect();
        let mut values = vec![f64::NAN; clearances.len()];
        let mut sides = vec![Sides::default(); clearances.len()];
        self.view_factor.values_and_sides(&[&clearances], &mut values, &mut sides);
        let found = values.into_iter().zip(sides).zip(&clearances);
        // A table of one value does not depend on the clearance, but on whether it is determined.
        found.map(|(found, clearance)| if clearance.is_nan() { (f64::NAN, Sides::default()) } else { found }).collect()
    }

    /// The radiated heat of some rows by plain arithmetic; false where a number is extreme, infinite or NaN.
    pub(crate) fn plain_heats(
        &self,
        view_factors: &[(f64, Sides)],
        [slave, master]: [&[f64]; 2],
        jump: Option<&[f64]>,
        heats: &mut [f64],
    ) -> bool {
        let RadiationLaw { coefficient, absolute_zero, .. } = self.law;
        let mut is_plain = is_moderate(coefficient.0) && is_moderate(absolute_zero);
        for (row, heat) in heats.iter_mut().enumerate() {
            let (view_factor, _) = view_factors[row];
            let (slave, master) = (slave[row], master[row]);
            let from_zero = [slave - absolute_zero, master - absolute_zero];
            let difference = jump.map_or(slave - master, |jump| jump[row]);
            let numbers = [view_factor, slave, master, difference];
            is_plain &= numbers.into_iter().fold(true, |all, number| all & is_moderate(number));
            is_plain &= is_mild(from_zero[0]) & is_mild(from_zero[1]) & is_mild(difference);
            *heat = plain_heat(coefficient, view_factor, from_zero, difference);
        }
        is_plain
    }

    /// How many rows have a temperature below absolute zero.
    pub(crate) fn rows_below_absolute_zero(&self, slave: &[f64], master: &[f64]) -> u64 {
        let zero = self.law.absolute_zero;
        slave.iter().zip(master).map(|(slave, master)| u64::from(*slave < zero || *master < zero)).sum()
    }

    /// The radiated heat, and whether the clearance lies beyond the view factors; `None` for an open row without a clearance.
    pub(crate) fn in_row(
        &self,
        row: Row<'_, '_>,
        view_factors: &[(f64, Sides)],
        temperatures: Temperatures,
        tally: &mut InteractionTally,
    ) -> Option<(Amount, Sides)> {
        row.state.table_clearance(row.clearance)?;
        let (view_factor, sides) = view_factors[row.index];
        if !sides.is_within() {
            tally.count_sides(VIEW_FACTOR, sides);
        }
        let zero = self.law.absolute_zero;
        tally.below_absolute_zero += u64::from(temperatures.slave < zero || temperatures.master < zero);
        Some((self.law.heat_amount(view_factor, temperatures), sides))
    }
}
