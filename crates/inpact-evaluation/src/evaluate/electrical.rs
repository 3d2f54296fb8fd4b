//! The electrical law in one row.

use super::conductances::RowConductance;
use super::{InteractionTally, Outcome, Row, contact_status, user};
use crate::compile::{CompiledElectrical, CompiledTables, ConductanceSource};
use crate::history::{ElectricalHistory, ElectricalIncrement};
use crate::law::conductance::{Branch, Conductance, ContactPoint};
use crate::law::contact::{Clearance, ContactPressure, PotentialJump};
use crate::law::electrical::{Dissipation, ExactFlow, flow};
use crate::law::heat::HeatAmounts;
use crate::numbers::{Amount, is_moderate, mean};
use crate::plan::Source;
use crate::results::{Along, ResultBatch, Status};
use crate::table::Sides;
use inpact_parser::model::Regime;

/// Below this share of the potentials their difference has lost its digits.
const LOST_DIGITS: f64 = 1e-8;

/// Room that one row leaves to the next.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    /// Temperatures and field variables of a row, for tables.
    pub(super) variables: Vec<f64>,
    /// Slopes along them.
    pub(super) slopes: Vec<f64>,
    /// The field variables of a row on either side, for a user's routine.
    fields: Vec<[f64; 2]>,
}

/// Evaluates the law; gives its status and the heat of the current, where the row has a jump of potential.
///
/// `found` is the conductance by tables; a user's routine is asked here, row by row.
pub(super) fn evaluate(
    law: &CompiledElectrical,
    row: Row<'_>,
    found: Option<RowConductance>,
    history: Option<&mut ElectricalHistory>,
    scratch: &mut Scratch,
    results: &mut ResultBatch,
    tally: &mut InteractionTally,
) -> (Outcome, Option<HeatAmounts>) {
    let found = match &law.conductance {
        ConductanceSource::Tables(_) => found,
        ConductanceSource::User(routine) => match user::conductance(routine, row, &mut scratch.fields, tally) {
            Some(Ok(value)) => {
                // The plan asks for no other slope.
                for (slot, _) in &law.slopes {
                    results.set(Some(*slot), row.index, Some(value.slope_along_mean_temperature()));
                }
                let (value, branch, sides) = (value.conductance, Branch::Neither, Sides::default());
                Some(RowConductance { conductance: Conductance { value, branch, sides }, rest: 0.0 })
            }
            Some(Err(fault)) => {
                return (Outcome::Faulty(tally.count_fault().then(|| user::fault_in_row(routine, row, &fault))), None);
            }
            None => None,
        },
    };
    let Some(found) = found else { return (Outcome::Incomplete, None) };
    let conductance = found.conductance;
    results.set(law.slots.conductance, row.index, Some(conductance.value));
    results.set(law.slots.weight, row.index, Some(law.heat_generation.slave_weight));
    if let ConductanceSource::Tables(tables) = &law.conductance
        && !law.slopes.is_empty()
    {
        set_slopes(tables, &law.slopes, row, scratch, results);
    }
    let heat = evaluate_flow(law, row, &found, history, results, tally);
    (Outcome::Evaluated(status(&conductance, row, tally)), heat)
}

/// The slopes of the conductance, one column each.
fn set_slopes(
    tables: &CompiledTables,
    slots: &[(usize, Along)],
    row: Row<'_>,
    Scratch { variables, slopes, .. }: &mut Scratch,
    results: &mut ResultBatch,
) {
    variables.clear();
    variables.extend(tables.variables.iter().map(|source| {
        let value = source.as_ref().and_then(|source| row.fetch(source, mean));
        value.unwrap_or(f64::NAN)
    }));
    slopes.clear();
    slopes.resize(variables.len(), 0.0);
    let point = ContactPoint {
        clearance: Clearance(row.clearance.unwrap_or(f64::NAN)),
        pressure: ContactPressure(row.pressure.unwrap_or(f64::NAN)),
        state: row.state,
        variables,
    };
    let along_contact = tables.tables.slopes(&point, slopes);
    for (slot, along) in slots {
        let slope = match along {
            Along::Clearance => Some(along_contact.clearance),
            Along::Pressure => Some(along_contact.pressure),
            Along::Temperature => slopes.first().copied(),
            Along::FieldVariable(number) => slopes.get(*number as usize).copied(),
            Along::PorePressure | Along::MassFlow => None,
        };
        results.set(Some(*slot), row.index, slope);
    }
}

/// Current and heat, where the row has a jump of potential.
fn evaluate_flow(
    law: &CompiledElectrical,
    row: Row<'_>,
    found: &RowConductance,
    history: Option<&mut ElectricalHistory>,
    results: &mut ResultBatch,
    tally: &mut InteractionTally,
) -> Option<HeatAmounts> {
    let source = law.jump.as_ref()?;
    let Some(jump) = row.fetch(source, |slave, master| PotentialJump::between(slave, master).0) else {
        tally.incomplete_flows += 1;
        return None;
    };
    tally.lost_digits += u64::from(has_lost_digits(source, row, jump));
    let jump = PotentialJump(jump);
    let area = law.area.and_then(|place| row.number(place));
    let mut history = history.zip(row.time);
    let value = found.conductance.value;
    let increment: Option<ElectricalIncrement> =
        history.as_mut().map(|(history, time)| history.begin(*time, jump, value));
    let dissipation = match law.regime {
        Regime::SteadyState => Dissipation::Steady,
        Regime::Transient => Dissipation::Transient {
            jump_at_start: increment.as_ref().map_or(jump, |increment| increment.jump_at_start),
        },
    };
    let generation = law.heat_generation;
    if let (Some(increment), Regime::Transient) = (&increment, law.regime)
        && increment.closes_circuit
        && generation.fraction != 0.0
    {
        tally.closing.count(row, || {
            let (start, end) = (increment.jump_at_start.0, jump.0);
            format!("the first has a jump of {end:?}, and its increment starts open with {start:?}")
        });
    }
    let duration = increment.as_ref().and_then(|increment| increment.duration);
    let needs_care = law.accuracy.is_reference() || {
        let start = increment.as_ref().map_or(jump, |increment| increment.jump_at_start);
        let inputs = [value, jump.0, start.0, generation.fraction, area.unwrap_or(0.0), duration.unwrap_or(0.0)];
        !inputs.into_iter().all(is_moderate)
    };
    let exact = if needs_care { ExactFlow::new((value, found.rest), jump, dissipation, generation) } else { None };
    let flow = match exact {
        Some(exact) => exact.rounded(),
        None => flow(value, jump, dissipation, generation),
    };
    let current_density = exact.map_or_else(|| Amount::new(flow.current_density), |exact| exact.current_density);
    let heat = exact.map_or_else(|| HeatAmounts::from(flow.heat), |exact| exact.heat);
    // Of a flow out of the range of f64 the part of a small area may be within it.
    let of_area = |amount: Amount| area.map(|area| amount.times(area));
    let slots = &law.slots;
    // No current is 0, not −0.
    let mut set = |slot, value: Option<f64>| results.set(slot, row.index, value.map(|value| value + 0.0));
    set(slots.ecd, Some(flow.current_density));
    set(slots.ecda, of_area(current_density));
    set(slots.sjd, Some(flow.heat.total));
    set(slots.sjda, of_area(heat.total));
    set(slots.heat_slave, Some(flow.heat.slave));
    set(slots.heat_master, Some(flow.heat.master));
    if let (Some((history, _)), Some(increment)) = (history, increment) {
        match &exact {
            Some(exact) => history.finish_exactly(&increment, exact, area),
            None => history.finish(&increment, &flow, value.mul_add(jump.0, -flow.current_density), area),
        }
        set(slots.ecdt, Some(history.current()));
        set(slots.ecdta, history.current_of_area());
        set(slots.sjdt, Some(history.heat()));
        set(slots.sjdta, history.heat_of_area());
    }
    Some(heat)
}

/// Whether the jump is the difference of potentials so much larger that few of its digits are left.
fn has_lost_digits(source: &Source<usize>, row: Row<'_>, jump: f64) -> bool {
    let (slave, master) = match *source {
        Source::Sides(slave, master) => (slave, master),
        Source::CellOrSides(cell, slave, master) if row.number(cell).is_none() => (slave, master),
        _ => return false,
    };
    let magnitude = |place| row.number(place).map_or(0.0, f64::abs);
    jump.abs() < LOST_DIGITS * magnitude(slave).max(magnitude(master))
}

fn status(conductance: &Conductance, row: Row<'_>, tally: &mut InteractionTally) -> Option<Status> {
    if !conductance.sides.is_within() {
        tally.count_sides(usize::from(conductance.branch == Branch::Pressure), conductance.sides);
        return Some(Status::BeyondTable);
    }
    contact_status(row.state)
}
