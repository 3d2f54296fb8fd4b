//! The pore fluid law in one row.

use super::tally::PERMEABILITY;
use super::{InteractionTally, Outcome, Row, contact_status};
use crate::compile::{CompiledPore, Length};
use crate::evaluator::FoundValue;
use crate::history::{PoreHistory, PoreIncrement};
use crate::law::contact::{Clearance, ClearanceRate, ContactPressure, ContactState, PorePressure};
use crate::law::pore::{BulkPermeabilities, Flow, Gap, PoreFlow, PorePoint};
use crate::numbers::{Amount, mean};
use crate::results::{Along, ResultBatch, Status};
use inpact_parser::model::Regime;

/// Evaluates the law; gives its status.
pub(super) fn evaluate(
    law: &CompiledPore,
    row: Row<'_>,
    history: Option<&mut PoreHistory>,
    (variables, slopes): (&mut Vec<f64>, &mut Vec<f64>),
    results: &mut ResultBatch,
    tally: &mut InteractionTally,
) -> Outcome {
    let jump = law.jump.and_then(|place| row.number(place));
    let sides = law.pressures.and_then(|(slave, master)| Some((row.number(slave)?, row.number(master)?)));
    let is_mean_needed = law.needs.variables.contains(&0);
    let (slave, master) = match (sides, jump) {
        (Some(sides), _) => sides,
        // The difference is enough for a flow that does not depend on the mean.
        (None, Some(_)) if !is_mean_needed => (f64::NAN, f64::NAN),
        _ => return Outcome::Incomplete,
    };
    let Some(clearance) = row.clearance.map(Clearance) else { return Outcome::Incomplete };
    variables.clear();
    variables.push(mean(slave, master));
    for (index, source) in law.variables.iter().enumerate() {
        let value = source.as_ref().and_then(|source| row.fetch(source, mean));
        if value.is_none() && law.needs.variables.contains(&(index + 1)) {
            return Outcome::Incomplete;
        }
        variables.push(value.unwrap_or(f64::NAN));
    }
    // While open the table is read at zero pressure (P-34).
    if law.needs.abscissa && row.pressure.is_none() && row.state == ContactState::Closed {
        return Outcome::Incomplete;
    }
    let given_rate = law.rate.and_then(|place| row.number(place)).map(ClearanceRate);
    let mut history = history.zip(row.time);
    let increment = history.as_mut().map(|(history, time)| history.begin(*time, clearance, given_rate));
    let gap = match law.regime {
        Regime::SteadyState => Gap::Steady,
        Regime::Transient => {
            increment.as_ref().map_or(Gap::Changing(given_rate.unwrap_or_default()), |increment| increment.gap)
        }
    };
    if let (Some(given), Some(rate), Regime::Transient) =
        (given_rate, increment.as_ref().and_then(|increment| increment.contradicted), law.regime)
    {
        tally.contradictory_rates.count(row, || {
            format!("the first has a rate of {:?}, and its clearance has changed at {:?}", given.0, rate.0)
        });
    }
    let bulk = law.bulk.and_then(|(slave, master)| {
        Some(BulkPermeabilities { slave: row.number(slave)?, master: row.number(master)? })
    });
    let point = PorePoint {
        clearance,
        pressure: ContactPressure(row.pressure.unwrap_or(f64::NAN)),
        state: row.state,
        slave: PorePressure(slave),
        master: PorePressure(master),
        jump,
        variables,
        characteristic_length: match law.characteristic_length {
            Length::Place(place) => row.number(place),
            Length::Given(length) => Some(length),
            Length::Unknown => None,
        },
        bulk,
        gap,
        multiplier: law.across.and_then(|place| row.number(place)),
    };
    let flow = law.law.flow_with(&point, |table, first, others| match &law.form {
        Some(form) => form.value_at(first, others),
        None => {
            let (value, sides) = table.value_and_sides_at(first, others);
            FoundValue { value, rest: None, sides }
        }
    });
    if !law.slopes.is_empty() {
        slopes.clear();
        slopes.resize(variables.len(), 0.0);
        let along_pressure = law.law.permeability_slopes(&point, slopes);
        for (slot, along) in &law.slopes {
            let slope = match along {
                Along::Pressure => Some(along_pressure),
                Along::PorePressure => slopes.first().copied(),
                Along::Temperature => slopes.get(1).copied(),
                Along::FieldVariable(number) => slopes.get(*number as usize + 1).copied(),
                Along::Clearance | Along::MassFlow => None,
            };
            // Without a permeability there is no slope of it either.
            results.set(Some(*slot), row.index, slope.filter(|_| flow.permeability.is_some()));
        }
    }
    let history = history.map(|(history, _)| history).zip(increment);
    set_flow(law, row, &flow, gap, history, results);
    Outcome::Evaluated(status(&flow, row, tally))
}

fn set_flow(
    law: &CompiledPore,
    row: Row<'_>,
    flow: &PoreFlow,
    gap: Gap,
    history: Option<(&mut PoreHistory, PoreIncrement)>,
    results: &mut ResultBatch,
) {
    let slots = &law.slots;
    let area = law.area.and_then(|place| row.number(place));
    let leaving = flow.leaving_slave();
    let mut set = |slot, value| results.set(slot, row.index, value);
    set(slots.pfl, leaving.map(Amount::value));
    set(slots.pfla, leaving.zip(area).map(|(leaving, area)| leaving.times(area)));
    set(slots.permeability, flow.permeability);
    set(slots.q_across, flow.q_across());
    set(slots.q_gap_slave, flow.q_gap_slave());
    set(slots.q_gap_master, flow.q_gap_master());
    set(slots.q_slave, flow.into_slave());
    set(slots.q_master, flow.into_master());
    if let Some((history, increment)) = history {
        history.finish(&increment, gap, flow, area);
        set(slots.ptl, history.volume());
        set(slots.ptla, history.volume_of_area());
    }
}

fn status(flow: &PoreFlow, row: Row<'_>, tally: &mut InteractionTally) -> Option<Status> {
    let is_unknown = [flow.across, flow.gap_fill].contains(&Flow::NeedsCharacteristicLength);
    tally.needs_length += u64::from(is_unknown);
    if flow.across == Flow::CutOff {
        return Some(Status::Cutoff);
    }
    if row.state == ContactState::Undetermined {
        return None;
    }
    if flow.is_constrained {
        return Some(Status::Constrained);
    }
    if !flow.sides.is_within() {
        tally.count_sides(PERMEABILITY, flow.sides);
        return Some(Status::BeyondTable);
    }
    contact_status(row.state)
}
