//! Friction over the rows of a part: by column where no number is missing or extreme, row by row otherwise.

use super::{ShearStress, SlipRate, frictional_heat_amounts};
use crate::law::contact::ContactState;
use crate::law::heat::{HeatAmounts, HeatGeneration};
use crate::nodes::Column;
use crate::numbers::{is_moderate, is_zero_or_ordinary};
use crate::plan::{FrictionPlan, SlipRateSource};
use crate::rows::{Binder, InteractionTally, Part, Row};
use inpact_parser::grammar::Dialect;
use std::ops::Range;

/// Friction with its columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrictionColumns {
    shear: usize,
    slip_rate: Speed,
    pub(crate) generation: HeatGeneration,
    /// CalculiX uses the magnitudes of shear and slip rate.
    dialect: Dialect,
}

/// The source of the slip rate.
#[derive(Debug, Clone, Copy)]
enum Speed {
    Place(usize),
    Given(SlipRate),
}

impl FrictionColumns {
    pub(crate) fn bind(binder: Binder<'_>, plan: FrictionPlan, generation: HeatGeneration) -> Option<Self> {
        let slip_rate = match plan.slip_rate {
            SlipRateSource::Column => Speed::Place(binder.place(Column::SlipRate)?),
            SlipRateSource::Given(speed) => Speed::Given(SlipRate(speed)),
        };
        Some(Self { shear: binder.place(plan.shear)?, slip_rate, generation, dialect: plan.dialect })
    }

    /// The heat of friction of some rows by plain arithmetic, in all, into slave and into master; false where a number is extreme, infinite or NaN.
    pub(crate) fn plain_heats(
        self,
        part: &Part<'_>,
        rows: Range<usize>,
        [totals, slave, master]: [&mut [f64]; 3],
    ) -> bool {
        let column = |place: usize| &part.batch().numbers[place].values()[rows.clone()];
        let shears = column(self.shear);
        let (speeds, given) = match self.slip_rate {
            Speed::Place(place) => (Some(column(place)), 0.0),
            Speed::Given(speed) => (None, speed.0),
        };
        let HeatGeneration { fraction, slave_weight } = self.generation;
        let mut is_plain = is_moderate(fraction) && is_moderate(slave_weight);
        for (row, state) in part.states[rows.clone()].iter().enumerate() {
            let (shear, speed) = (shears[row], speeds.map_or(given, |speeds| speeds[row]));
            let (shear, speed) = match self.dialect {
                Dialect::Abaqus => (shear, speed),
                Dialect::Calculix => (shear.abs(), speed.abs()),
            };
            // Same expression as `frictional_heat` for such numbers.
            let total = fraction * shear * speed;
            let is_open = *state == Some(ContactState::Open);
            is_plain &= is_open | (is_moderate(shear) & is_moderate(speed) & is_zero_or_ordinary(total));
            // Zero heat is +0, not −0.
            let share = |weight: f64| if is_open { 0.0 } else { weight * total + 0.0 };
            (totals[row], slave[row], master[row]) = (share(1.0), share(slave_weight), share(1.0 - slave_weight));
        }
        is_plain
    }

    /// The heat of friction; an open row has none, whatever its shear and slip rate.
    pub(crate) fn in_row(self, row: Row<'_, '_>, tally: &mut InteractionTally) -> Option<HeatAmounts> {
        if row.state == ContactState::Open {
            return Some(HeatAmounts::ZERO);
        }
        let slip_rate = match self.slip_rate {
            Speed::Place(place) => row.number(place).map(SlipRate),
            Speed::Given(speed) => Some(speed),
        };
        let (shear, slip_rate) = row.number(self.shear).map(ShearStress).zip(slip_rate)?;
        let (shear, slip_rate) = match self.dialect {
            Dialect::Abaqus => (shear, slip_rate),
            Dialect::Calculix => (ShearStress(shear.0.abs()), SlipRate(slip_rate.0.abs())),
        };
        let heat = frictional_heat_amounts(shear, slip_rate, self.generation);
        tally.negative_friction += u64::from(heat.total.value() < 0.0);
        Some(heat)
    }
}
