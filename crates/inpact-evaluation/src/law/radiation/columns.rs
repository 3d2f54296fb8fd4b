//! Radiation over the rows of a part: view factors in columns, heat row by row.

use super::RadiationLaw;
use crate::evaluate::{InteractionTally, Part, Row, VIEW_FACTOR};
use crate::kernel::TableKernel;
use crate::law::thermal::Temperatures;
use crate::numbers::Amount;
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

    /// The view factor of every row; of those whose clearance is not known NaN ([`RadiationLaw::view_factor`]).
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
        // A table of one value does not depend on the clearance, but on whether it can be told.
        found.map(|(found, clearance)| if clearance.is_nan() { (f64::NAN, Sides::default()) } else { found }).collect()
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
