//! The thermal law in one row.
//!
//! Every part gives what it can. Their sum, HFL, and its integral need all parts that the plan has, the heat of the current among them.

use super::tally::{THERMAL_CONDUCTANCE, VIEW_FACTOR};
use super::{InteractionTally, Outcome, Row, contact_status};
use crate::compile::{CompiledConduction, CompiledFriction, CompiledRadiation, CompiledThermal, MASS_FLOW, Speed};
use crate::history::ThermalHistory;
use crate::law::conductance::{Branch, ContactPoint};
use crate::law::contact::{Clearance, ContactPressure, ContactState};
use crate::law::friction::{ShearStress, SlipRate, frictional_heat_amounts};
use crate::law::heat::HeatAmounts;
use crate::law::thermal::{InterfaceHeat, Temperatures, ThermalConductance, conducted_heat_amount, mean_mass_flow};
use crate::numbers::{Amount, mean};
use crate::plan::{CurrentHeat, MassFlow};
use crate::results::{Along, ResultBatch, Status};
use crate::table::Sides;
use inpact_parser::grammar::Dialect;

/// Evaluates the law, given the heat of the current in the same row; gives its status.
pub(super) fn evaluate(
    law: &CompiledThermal,
    row: Row<'_>,
    heat_of_current: Option<HeatAmounts>,
    history: Option<&mut ThermalHistory>,
    scratch: (&mut Vec<f64>, &mut Vec<f64>),
    results: &mut ResultBatch,
    tally: &mut InteractionTally,
) -> Outcome {
    let jump = law.jump.and_then(|place| row.number(place));
    let temperatures = law.temperatures.and_then(|(slave, master)| {
        Some(Temperatures { slave: row.number(slave)?, master: row.number(master)?, jump })
    });
    let across = temperatures.or_else(|| jump.map(Temperatures::of_jump));
    let (mut is_beyond, mut gives_something) = (false, false);
    // A part that the plan does not have is known to be nothing.
    let conduction = match &law.conduction {
        None => Some(Amount::ZERO),
        Some(part) => {
            let conductance = evaluate_conductance(law, part, row, scratch, results, tally);
            is_beyond |= conductance.is_some_and(|(.., sides)| !sides.is_within());
            gives_something |= conductance.is_some();
            let both = conductance.zip(across);
            let heat = both.map(|((value, rest, _), sides)| conducted_heat_amount(value, rest, sides));
            results.set(law.slots.conduction, row.index, heat.map(Amount::value));
            heat
        }
    };
    let radiation = match &law.radiation {
        None => Some(Amount::ZERO),
        Some(part) => {
            let radiated = temperatures.and_then(|sides| radiate(part, row, sides, tally));
            is_beyond |= radiated.is_some_and(|(_, sides)| !sides.is_within());
            gives_something |= radiated.is_some();
            let heat = radiated.map(|(heat, _)| heat);
            results.set(law.slots.radiation, row.index, heat.map(Amount::value));
            heat
        }
    };
    let friction = law.friction.map_or(Some(HeatAmounts::ZERO), |part| rub(part, row, tally));
    let current = if law.current == CurrentHeat::Generated { heat_of_current } else { Some(HeatAmounts::ZERO) };
    let all = (|| {
        Some(InterfaceHeat { conduction: conduction?, radiation: radiation?, current: current?, friction: friction? })
    })();
    let rubbed = friction.filter(|_| law.friction.is_some());
    gives_something |= rubbed.is_some();
    set_flows(law, row, all.as_ref(), rubbed, history, results);
    if !gives_something {
        return Outcome::Incomplete;
    }
    // Without `HFL` in the plan nothing of it is missed.
    tally.incomplete_heat += u64::from((all.is_none() && law.slots.hfl.is_some()) || friction.is_none());
    Outcome::Evaluated(if is_beyond { Some(Status::BeyondTable) } else { contact_status(row.state) })
}

/// The conductance with its slopes, what rounding took away from it where that is known, and along which axes the row lies outside its table; `None` where the row lacks a number for it.
fn evaluate_conductance(
    law: &CompiledThermal,
    part: &CompiledConduction,
    row: Row<'_>,
    (variables, slopes): (&mut Vec<f64>, &mut Vec<f64>),
    results: &mut ResultBatch,
    tally: &mut InteractionTally,
) -> Option<(f64, Option<f64>, Sides)> {
    let needs = part.needs(row.state);
    if let Some((against, needs)) = needs {
        let abscissa =
            if against == Along::Clearance { row.state.table_clearance(row.clearance) } else { row.pressure };
        if needs.abscissa && abscissa.is_none() {
            return None;
        }
    }
    variables.clear();
    for (index, source) in part.variables.iter().enumerate() {
        let value = match (index, part.mass_flow) {
            (MASS_FLOW, Some(source)) => mass_flow(source, row),
            _ => source.as_ref().and_then(|source| row.fetch(source, mean)),
        };
        if value.is_none() && needs.is_some_and(|(_, needs)| needs.variables.contains(&index)) {
            return None;
        }
        variables.push(value.unwrap_or(f64::NAN));
    }
    let point = ContactPoint {
        clearance: Clearance(row.clearance.unwrap_or(f64::NAN)),
        pressure: ContactPressure(row.pressure.unwrap_or(f64::NAN)),
        state: row.state,
        variables,
    };
    let (conductance, rest) = part.conductance_at(&point);
    results.set(law.slots.conductance, row.index, Some(conductance.value));
    if !part.slopes.is_empty() {
        slopes.clear();
        slopes.resize(variables.len(), 0.0);
        let along_contact = part.conductance.slopes(&point, slopes);
        for (slot, along) in &part.slopes {
            let slope = match along {
                Along::Clearance => Some(along_contact.clearance),
                Along::Pressure => Some(along_contact.pressure),
                Along::Temperature => slopes.first().copied(),
                Along::MassFlow => slopes.get(MASS_FLOW).copied(),
                Along::FieldVariable(number) => slopes.get(*number as usize + MASS_FLOW).copied(),
                Along::PorePressure => None,
            };
            results.set(Some(*slot), row.index, slope);
        }
    }
    if !conductance.sides.is_within() {
        match &part.conductance {
            ThermalConductance::Calculix(_) => tally.beyond_curves += 1,
            ThermalConductance::Tables(_) => {
                let table = THERMAL_CONDUCTANCE + usize::from(conductance.branch == Branch::Pressure);
                tally.count_sides(table, conductance.sides);
            }
        }
    }
    Some((conductance.value, rest, conductance.sides))
}

/// The mean of the magnitudes: as given, or from the sides that have a number (K-32).
pub(super) fn mass_flow(source: MassFlow<usize>, row: Row<'_>) -> Option<f64> {
    let number = |place: Option<usize>| row.number(place?);
    if let Some(mean) = number(source.mean) {
        return Some(mean.abs());
    }
    let (slave, master) = (number(source.slave), number(source.master));
    (slave.is_some() || master.is_some()).then(|| mean_mass_flow(slave, master))
}

/// The radiated heat, and whether the clearance lies beyond the view factors; `None` for an open row without a clearance.
fn radiate(
    part: &CompiledRadiation,
    row: Row<'_>,
    temperatures: Temperatures,
    tally: &mut InteractionTally,
) -> Option<(Amount, Sides)> {
    let clearance = row.state.table_clearance(row.clearance)?;
    let (view_factor, sides) = part.law.view_factor(Clearance(clearance), row.state);
    if !sides.is_within() {
        tally.count_sides(VIEW_FACTOR, sides);
    }
    let zero = part.law.absolute_zero;
    tally.below_absolute_zero += u64::from(temperatures.slave < zero || temperatures.master < zero);
    Some((part.law.heat_amount(view_factor, temperatures), sides))
}

/// The heat of friction; an open row has none, whatever it says of it.
fn rub(part: CompiledFriction, row: Row<'_>, tally: &mut InteractionTally) -> Option<HeatAmounts> {
    if row.state == ContactState::Open {
        return Some(HeatAmounts::ZERO);
    }
    let slip_rate = match part.slip_rate {
        Speed::Place(place) => row.number(place).map(SlipRate),
        Speed::Given(speed) => Some(speed),
    };
    match row.number(part.shear).map(ShearStress).zip(slip_rate) {
        Some((shear, slip_rate)) => {
            let (shear, slip_rate) = match part.dialect {
                Dialect::Abaqus => (shear, slip_rate),
                Dialect::Calculix => (ShearStress(shear.0.abs()), SlipRate(slip_rate.0.abs())),
            };
            let heat = frictional_heat_amounts(shear, slip_rate, part.generation);
            tally.negative_friction += u64::from(heat.total.value() < 0.0);
            Some(heat)
        }
        None => None,
    }
}

fn set_flows(
    law: &CompiledThermal,
    row: Row<'_>,
    all: Option<&InterfaceHeat>,
    friction: Option<HeatAmounts>,
    history: Option<&mut ThermalHistory>,
    results: &mut ResultBatch,
) {
    let slots = &law.slots;
    let area = law.area.and_then(|place| row.number(place));
    let mut set = |slot, value| results.set(slot, row.index, value);
    let leaving = all.map(InterfaceHeat::leaving_slave);
    set(slots.weight, law.friction.map(|part| part.generation.slave_weight));
    set(slots.into_slave, all.map(InterfaceHeat::into_slave));
    set(slots.into_master, all.map(InterfaceHeat::into_master));
    set(slots.hfl, leaving.map(Amount::value));
    set(slots.hfla, leaving.zip(area).map(|(leaving, area)| leaving.times(area)));
    let rubbed = friction.map(|heat| heat.total);
    set(slots.sfdr, rubbed.map(Amount::value));
    set(slots.sfdra, rubbed.zip(area).map(|(rubbed, area)| rubbed.times(area)));
    let Some((history, time)) = history.zip(row.time) else { return };
    if let Some(leaving) = leaving {
        history.leaving.add(time, leaving, area);
        set(slots.htl, Some(history.leaving.per_area()));
        set(slots.htla, history.leaving.of_area());
    }
    if let Some(rubbed) = rubbed {
        history.friction.add(time, rubbed, area);
        set(slots.sfdrt, Some(history.friction.per_area()));
        set(slots.sfdrta, history.friction.of_area());
    }
}
