//! The pore fluid law over the rows of a part: permeabilities by column, and steady flow too where there is no extreme number.

mod plain;

use super::{BulkPermeabilities, Flow, Gap, Permeability, PoreFlow, PoreLaw, PorePoint};
use crate::evaluator::{Evaluator, FoundValue, TableValues};
use crate::history::{PoreHistory, PoreIncrement};
use crate::law::conductance::columns::{Gathered, Needs};
use crate::law::contact::{Clearance, ClearanceRate, ContactPressure, ContactState, PorePressure};
use crate::nodes::{Cells, Column, Part as Side};
use crate::numbers::{Amount, mean};
use crate::plan::{Bulk, CharacteristicLength, Choices, History, InteractionTables, PorePlan, Rate, Source};
use crate::results::{Along, Output, ResultBatch, Status};
use crate::rows::{Binder, InteractionTally, Outcome, PERMEABILITY, Part, Row, contact_status};
use inpact_parser::model::Regime;
use std::borrow::Cow;

/// The pore fluid law with the columns it reads and fills.
#[derive(Debug, Clone)]
pub(crate) struct PoreColumns {
    law: PoreLaw,
    /// The evaluator of the table of permeabilities.
    form: Option<Evaluator>,
    regime: Regime,
    /// The variables that the permeability needs; variable 0 is the mean pore pressure, which is always there.
    needs: Needs,
    /// The mean temperature, then the field variables.
    variables: Vec<Option<Source<usize>>>,
    /// The pore pressures of slave and master.
    pressures: Option<(usize, usize)>,
    jump: Option<usize>,
    /// The flow across where the permeability is infinite.
    across: Option<usize>,
    bulk: Option<(usize, usize)>,
    rate: Option<usize>,
    characteristic_length: Length,
    area: Option<usize>,
    pub(crate) history: History,
    slots: Slots,
    slopes: Vec<(usize, Along)>,
}

/// The source of the characteristic element length.
#[derive(Debug, Clone, Copy)]
enum Length {
    Place(usize),
    Given(f64),
    Unknown,
}

/// Indices of the results.
#[derive(Debug, Clone, Copy)]
struct Slots {
    pfl: Option<usize>,
    pfla: Option<usize>,
    ptl: Option<usize>,
    ptla: Option<usize>,
    permeability: Option<usize>,
    q_across: Option<usize>,
    q_gap_slave: Option<usize>,
    q_gap_master: Option<usize>,
    q_slave: Option<usize>,
    q_master: Option<usize>,
}

impl PoreColumns {
    pub(crate) fn bind(binder: Binder<'_>, plan: &PorePlan, tables: &InteractionTables, choices: &Choices) -> Self {
        let table = tables.permeability().zip(plan.table.as_ref());
        let form = table.map(|(table, planned)| {
            planned.evaluator().cloned().unwrap_or_else(|| Evaluator::new(table, choices.accuracy))
        });
        let table = form.as_ref().map(|form| form.table().clone());
        let sides = |of: fn(Side) -> Column| Some((binder.place(of(Side::Slave))?, binder.place(of(Side::Master))?));
        let length = binder.place(Column::CharacteristicLength);
        let slot = |output| binder.slot(output);
        Self {
            form,
            regime: plan.regime.regime,
            needs: table.as_ref().map(Needs::of).unwrap_or_default(),
            law: PoreLaw {
                permeability: table.map_or(Permeability::Infinite, Permeability::Finite),
                cutoffs: plan.cutoffs,
                boundary: choices.cutoff_boundary,
            },
            variables: plan.variables.iter().map(|source| binder.source(*source)).collect(),
            pressures: sides(Column::PorePressure).filter(|_| plan.pressures.is_some()),
            jump: binder.place(Column::PorePressure(Side::Both)),
            across: binder.place(Column::FlowAcross),
            bulk: sides(Column::BulkPermeability).filter(|_| plan.bulk == Bulk::Columns),
            rate: binder.place(Column::ClearanceRate).filter(|_| plan.rate == Rate::Column),
            characteristic_length: match (plan.characteristic_length, length) {
                (CharacteristicLength::Given(length), _) => Length::Given(length),
                (CharacteristicLength::Column, Some(place)) => Length::Place(place),
                _ => Length::Unknown,
            },
            area: plan.area.and_then(|column| binder.place(column)),
            history: plan.history,
            slots: Slots {
                pfl: slot(Output::Pfl),
                pfla: slot(Output::Pfla),
                ptl: slot(Output::Ptl),
                ptla: slot(Output::Ptla),
                permeability: slot(Output::Permeability),
                q_across: slot(Output::QAcross),
                q_gap_slave: slot(Output::QGapSlave),
                q_gap_master: slot(Output::QGapMaster),
                q_slave: slot(Output::QSlave),
                q_master: slot(Output::QMaster),
            },
            slopes: binder.slopes(|output| match output {
                Output::PermeabilitySlope(along) => {
                    Some(along).filter(|along| axis_of(*along).is_some_and(|axis| axis <= plan.variables.len() + 1))
                }
                _ => None,
            }),
        }
    }

    /// The table of permeabilities and the points at which a part reads it, NaN where a row lacks a coordinate.
    pub(crate) fn points<'a>(&self, part: &'a Part<'_>) -> Option<(&Evaluator, Gathered<'a>)> {
        let form = self.form.as_ref()?;
        let batch = part.batch();
        let pore_pressure = self
            .pressures
            .filter(|_| self.needs.variables.contains(&0))
            .map(|(slave, master)| Cells::of_source(batch, &Source::Sides(slave, master), mean));
        let others = self.variables.iter().enumerate().map(|(index, source)| {
            let source = source.as_ref().filter(|_| self.needs.variables.contains(&(index + 1)));
            source.map(|source| Cells::of_source(batch, source, mean))
        });
        let nowhere = || Cells { values: vec![f64::NAN; part.rows()].into(), present: None };
        let variables = std::iter::once(pore_pressure).chain(others).enumerate().map(|(index, cells)| {
            // A column that the table needs must be present, whatever its contents.
            cells.or_else(|| self.needs.variables.contains(&index).then(nowhere))
        });
        let variables: Vec<Option<Cells<'a>>> = variables.collect();
        let abscissa = self.needs.abscissa.then(|| effective_pressures(part));
        Some((form, Gathered::new(None, part.rows(), &self.needs, abscissa, &variables)))
    }

    /// The permeability of every row by the table, whether it is in force there or not.
    pub(crate) fn permeabilities(&self, part: &Part<'_>) -> TableValues {
        let mut found = TableValues::default();
        if let Some((form, gathered)) = self.points(part).filter(|_| part.rows() > 0) {
            form.evaluate(&gathered.slices(), gathered.count, &mut found);
        }
        found
    }

    /// The slopes of the permeability by the table in every row, one column for each requested slope, whether or not fluid crosses.
    pub(super) fn slope_columns(&self, part: &Part<'_>) -> Vec<Vec<f64>> {
        let points = self.points(part).filter(|_| !self.slopes.is_empty());
        let Some((form, gathered)) = points else { return Vec::new() };
        let (table, columns) = (form.table(), gathered.slices());
        let column = |(_, along): &(usize, Along)| {
            let axes = part.states.iter().map(|state| match (along, state) {
                (Along::Pressure, Some(ContactState::Open)) => None,
                _ => axis_of(*along),
            });
            let mut slopes = vec![f64::NAN; part.rows()];
            table.slopes_in_columns(&columns, axes, |row, slope| slopes[row] = slope);
            slopes
        };
        self.slopes.iter().map(column).collect()
    }

    /// The law in a row; returns its status.
    pub(crate) fn row(
        &self,
        row: Row<'_, '_>,
        found: &TableValues,
        history: Option<&mut PoreHistory>,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> Outcome {
        let jump = self.jump.and_then(|place| row.number(place));
        let sides = self.pressures.and_then(|(slave, master)| Some((row.number(slave)?, row.number(master)?)));
        let is_mean_needed = self.needs.variables.contains(&0);
        let (slave, master) = match (sides, jump) {
            (Some(sides), _) => sides,
            // The difference is enough for a flow that does not depend on the mean.
            (None, Some(_)) if !is_mean_needed => (f64::NAN, f64::NAN),
            _ => return Outcome::Incomplete,
        };
        let Some(clearance) = row.clearance.map(Clearance) else { return Outcome::Incomplete };
        let lacks = |(index, source): (usize, &Option<Source<usize>>)| {
            self.needs.variables.contains(&(index + 1))
                && source.as_ref().and_then(|source| row.fetch(source, mean)).is_none()
        };
        if self.variables.iter().enumerate().any(lacks) {
            return Outcome::Incomplete;
        }
        // While open the table is read at zero pressure (P-34).
        if self.needs.abscissa && row.pressure.is_none() && row.state == ContactState::Closed {
            return Outcome::Incomplete;
        }
        let given_rate = self.rate.and_then(|place| row.number(place)).map(ClearanceRate);
        let mut history = history.zip(row.time);
        let increment = history.as_mut().map(|(history, time)| history.begin(*time, clearance, given_rate));
        let gap = match self.regime {
            Regime::SteadyState => Gap::Steady,
            Regime::Transient => {
                increment.as_ref().map_or(Gap::Changing(given_rate.unwrap_or_default()), |increment| increment.gap)
            }
        };
        if let (Some(given), Some(rate), Regime::Transient) =
            (given_rate, increment.as_ref().and_then(|increment| increment.contradicted), self.regime)
        {
            tally.contradictory_rates.count(row, || {
                format!("the first has a rate of {:?}, and its clearance has changed at {:?}", given.0, rate.0)
            });
        }
        let bulk = self.bulk.and_then(|(slave, master)| {
            Some(BulkPermeabilities { slave: row.number(slave)?, master: row.number(master)? })
        });
        let point = PorePoint {
            clearance,
            pressure: ContactPressure(row.pressure.unwrap_or(f64::NAN)),
            state: row.state,
            slave: PorePressure(slave),
            master: PorePressure(master),
            jump,
            variables: &[],
            characteristic_length: match self.characteristic_length {
                Length::Place(place) => row.number(place),
                Length::Given(length) => Some(length),
                Length::Unknown => None,
            },
            bulk,
            gap,
            multiplier: self.across.and_then(|place| row.number(place)),
        };
        let flow = self.law.flow_with(&point, |_, _, _| FoundValue {
            value: found.values[row.index],
            rest: found.rests.get(row.index).copied(),
            sides: found.sides_of(row.index),
        });
        self.set_slopes(row, point, flow.permeability.is_some(), results);
        let history = history.map(|(history, _)| history).zip(increment);
        self.set_flow(row, &flow, gap, history, results);
        Outcome::Evaluated(status(&flow, row, tally))
    }

    fn set_slopes(&self, row: Row<'_, '_>, point: PorePoint<'_>, has_permeability: bool, results: &mut ResultBatch) {
        if self.slopes.is_empty() {
            return;
        }
        let others = self.variables.iter().map(|source| source.as_ref().and_then(|source| row.fetch(source, mean)));
        let mean_pressure = mean(point.slave.0, point.master.0);
        let variables: Vec<f64> =
            std::iter::once(mean_pressure).chain(others.map(|value| value.unwrap_or(f64::NAN))).collect();
        let mut slopes = vec![0.0; variables.len()];
        let along_pressure = self.law.permeability_slopes(&PorePoint { variables: &variables, ..point }, &mut slopes);
        for (slot, along) in &self.slopes {
            let slope = match axis_of(*along) {
                Some(0) => Some(along_pressure),
                axis => axis.and_then(|axis| slopes.get(axis - 1).copied()),
            };
            // Without a permeability there is no slope either.
            results.set(Some(*slot), row.to, slope.filter(|_| has_permeability));
        }
    }

    fn set_flow(
        &self,
        row: Row<'_, '_>,
        flow: &PoreFlow,
        gap: Gap,
        history: Option<(&mut PoreHistory, PoreIncrement)>,
        results: &mut ResultBatch,
    ) {
        let slots = &self.slots;
        let area = self.area.and_then(|place| row.number(place));
        let leaving = flow.leaving_slave();
        let mut set = |slot, value| results.set(slot, row.to, value);
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
}

/// The axis of the table of permeabilities along which a slope is.
fn axis_of(along: Along) -> Option<usize> {
    match along {
        Along::Pressure => Some(0),
        Along::PorePressure => Some(1),
        Along::Temperature => Some(2),
        Along::FieldVariable(number) => Some(number as usize + 2),
        Along::Clearance | Along::MassFlow => None,
    }
}

/// The pressures at which the table is read: zero while open (P-34), NaN where a row has none.
fn effective_pressures<'a>(part: &'a Part<'_>) -> Cow<'a, [f64]> {
    let pressures = part.pressures();
    if !part.states.contains(&Some(ContactState::Open)) {
        return pressures;
    }
    let states = part.states.iter().zip(&*pressures);
    states.map(|(state, pressure)| if *state == Some(ContactState::Open) { 0.0 } else { *pressure }).collect()
}

fn status(flow: &PoreFlow, row: Row<'_, '_>, tally: &mut InteractionTally) -> Option<Status> {
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
