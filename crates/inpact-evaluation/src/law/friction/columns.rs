//! Friction row by row.

use super::{ShearStress, SlipRate, frictional_heat_amounts};
use crate::evaluate::{Binder, InteractionTally, Row};
use crate::law::contact::ContactState;
use crate::law::heat::{HeatAmounts, HeatGeneration};
use crate::nodes::Column;
use crate::plan::{FrictionPlan, SlipRateSource};
use inpact_parser::grammar::Dialect;

/// Friction with its columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrictionColumns {
    shear: usize,
    slip_rate: Speed,
    pub(crate) generation: HeatGeneration,
    /// CalculiX takes shear and slip rate by their magnitudes.
    dialect: Dialect,
}

/// Where the slip rate comes from.
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

    /// The heat of friction; an open row has none, whatever it says of it.
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
