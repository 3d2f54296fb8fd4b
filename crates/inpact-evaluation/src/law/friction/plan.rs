//! The plan of the heat of friction of one interaction.

use crate::law::heat::HeatGeneration;
use crate::nodes::Column;
use crate::plan::ContactColumns;
use crate::plan::planner::{LeftOuts, Planner};
use crate::plan::reason::{Missing, Reason};
use inpact_parser::grammar::Dialect;
use inpact_parser::model::{Interaction, OptionKind};

/// The plan of the heat of friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionPlan {
    /// The dialect: CalculiX uses the magnitudes of shear and slip rate.
    pub dialect: Dialect,
    /// `shear`.
    pub shear: Column,
    /// The source of the slip rate.
    pub slip_rate: SlipRateSource,
}

/// Sources of a slip rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SlipRateSource {
    /// `slip_rate`.
    Column,
    /// The deck gives one for all rows (K-38, CalculiX).
    Given(f64),
}

/// The slip rate that the deck gives (K-38, CalculiX).
pub(crate) fn given_slip_rate(interaction: &Interaction) -> Option<f64> {
    interaction.gap_heat_generation.as_deref().and_then(inpact_parser::model::HeatGeneration::given_slip_rate)
}

/// Whether the options of an interaction define heat by friction: only then are `shear` and `slip_rate` used.
pub(crate) fn tells_of_friction(interaction: &Interaction) -> bool {
    tells_of_heat(interaction) || interaction.friction().is_some()
}

/// Whether one of the options concerns heat: a deck without any may have friction too, without its heat.
fn tells_of_heat(interaction: &Interaction) -> bool {
    interaction.gap_heat_generation.is_some()
        || interaction.gap_conductance().is_some()
        || interaction.gap_radiation().is_some()
}

/// Plans friction: where the deck defines it and `shear` and `slip_rate` have numbers, or the deck gives the speed (K-38).
pub(crate) fn plan_friction(
    planner: Planner<'_>,
    heat: Option<HeatGeneration>,
    left_out: &mut LeftOuts,
) -> Result<Option<FrictionPlan>, Reason> {
    const SWITCHED_OFF: &str = "heat generation";
    let columns = [Column::Shear, Column::SlipRate];
    let is_there = |column: &Column| planner.may_have(*column);
    if !tells_of_friction(planner.interaction) {
        let is_described = columns.iter().all(is_there);
        return if is_described { Err(Reason::NoKeyword(OptionKind::Friction.keyword())) } else { Ok(None) };
    }
    let given_speed = given_slip_rate(planner.interaction);
    let is_reported = columns.iter().any(is_there)
        || (tells_of_heat(planner.interaction) && planner.interaction.friction().is_some());
    if !is_reported {
        return Ok(None);
    }
    if heat.is_none() {
        if !left_out.0.iter().any(|left_out| left_out.what == SWITCHED_OFF) {
            left_out.push(SWITCHED_OFF, Reason::HeatSwitchedOff);
        }
        return Ok(None);
    }
    if planner.choices.dialect == Dialect::Calculix && planner.interaction.gap_heat_generation.is_none() {
        return Err(Reason::NotInCalculix("generates heat with *GAP HEAT GENERATION only"));
    }
    match given_speed {
        Some(_) => planner.cell(Column::Shear).map(drop)?,
        None => planner.all_of(columns).map(drop)?,
    }
    if planner.contact() == ContactColumns::default() {
        return Err(Missing::absent(vec![Column::Clearance]).into());
    }
    Ok(Some(FrictionPlan {
        dialect: planner.choices.dialect,
        shear: Column::Shear,
        slip_rate: given_speed.map_or(SlipRateSource::Column, SlipRateSource::Given),
    }))
}
