//! The thermal law over the rows of a part: conductances and view factors by column, and heat too where there is no history and no extreme number.

mod plain;

use super::{InterfaceHeat, Temperatures, ThermalConductance, conducted_heat_amount};
use crate::history::ThermalHistory;
use crate::law::calculix::CalculixConductance;
use crate::law::conductance::columns::{BranchColumns, ConductanceColumn, Needs, Variable, WantedSlope, in_row};
use crate::law::conductance::{Branch, ContactPoint, SlopeAlong};
use crate::law::contact::ContactState;
use crate::law::friction::columns::FrictionColumns;
use crate::law::heat::HeatAmounts;
use crate::law::radiation::columns::RadiationColumns;
use crate::law::thermal::tables::ThermalTables;
use crate::nodes::Column;
use crate::numbers::Amount;
use crate::plan::{Choices, ConductionPlan, CurrentHeat, History, MassFlow, ThermalPlan};
use crate::results::{Along, Output, ResultBatch, Status};
use crate::rows::{Binder, InteractionTally, Outcome, Part, Row, THERMAL_CONDUCTANCE, contact_status};
use crate::table::Sides;

/// The index of the mass flow rate among the variables.
const MASS_FLOW: usize = 1;

/// The thermal law with the columns it reads and fills.
#[derive(Debug, Clone)]
pub(crate) struct ThermalColumns {
    conduction: Option<Conduction>,
    radiation: Option<RadiationColumns>,
    friction: Option<FrictionColumns>,
    current: CurrentHeat,
    /// Slave and master.
    temperatures: Option<(usize, usize)>,
    jump: Option<usize>,
    area: Option<usize>,
    pub(crate) history: History,
    slots: Slots,
}

/// Conduction with its columns.
#[derive(Debug, Clone)]
struct Conduction {
    source: ConductionSource,
    slopes: Vec<WantedSlope>,
}

/// Sources of the conductance.
#[derive(Debug, Clone)]
enum ConductionSource {
    Tables(BranchColumns),
    Calculix { curves: CalculixConductance, needs: Needs, variables: Vec<Option<Variable>> },
}

/// Indices of the results.
#[derive(Debug, Clone, Copy)]
struct Slots {
    hfl: Option<usize>,
    hfla: Option<usize>,
    htl: Option<usize>,
    htla: Option<usize>,
    sfdr: Option<usize>,
    sfdra: Option<usize>,
    sfdrt: Option<usize>,
    sfdrta: Option<usize>,
    weight: Option<usize>,
    conductance: Option<usize>,
    conduction: Option<usize>,
    radiation: Option<usize>,
    into_slave: Option<usize>,
    into_master: Option<usize>,
}

/// Conductances and view factors of a part, computed by column before the pass over its rows.
#[derive(Debug, Default)]
pub(crate) struct ThermalFound {
    conductances: ConductanceColumn,
    view_factors: Vec<(f64, Sides)>,
}

impl ThermalColumns {
    pub(crate) fn bind(binder: Binder<'_>, plan: &ThermalPlan, tables: &ThermalTables, choices: &Choices) -> Self {
        let place = |column: Column| binder.place(column);
        let radiation = plan.radiation.as_ref().and(tables.radiation.as_ref()).and_then(|law| law.as_ref().ok());
        let slot = |output| binder.slot(output);
        Self {
            conduction: plan.conduction.as_ref().and_then(|of| Conduction::bind(binder, of, tables, choices)),
            radiation: radiation.map(RadiationColumns::new),
            friction: plan.friction.and_then(|friction| FrictionColumns::bind(binder, friction, plan.heat?)),
            current: plan.current,
            temperatures: plan.temperatures.and_then(|[slave, master]| Some((place(slave)?, place(master)?))),
            jump: plan.jump.and_then(place),
            area: plan.area.and_then(place),
            history: plan.history,
            slots: Slots {
                hfl: slot(Output::Hfl),
                hfla: slot(Output::Hfla),
                htl: slot(Output::Htl),
                htla: slot(Output::Htla),
                sfdr: slot(Output::Sfdr),
                sfdra: slot(Output::Sfdra),
                sfdrt: slot(Output::Sfdrt),
                sfdrta: slot(Output::Sfdrta),
                weight: slot(Output::Weight),
                conductance: slot(Output::ThermalConductance),
                conduction: slot(Output::HeatConduction),
                radiation: slot(Output::HeatRadiation),
                into_slave: slot(Output::TotalHeatSlave),
                into_master: slot(Output::TotalHeatMaster),
            },
        }
    }

    /// The tables of the conductance, where tables give it.
    pub(crate) fn tables(&self) -> Option<&BranchColumns> {
        match &self.conduction.as_ref()?.source {
            ConductionSource::Tables(tables) => Some(tables),
            ConductionSource::Calculix { .. } => None,
        }
    }

    /// Whether the heat of the current is part of that of the interface.
    pub(crate) fn takes_heat_of_current(&self) -> bool {
        self.current == CurrentHeat::Generated
    }

    /// The conductances and view factors of a part.
    pub(crate) fn find(&self, part: &Part<'_>) -> ThermalFound {
        ThermalFound {
            conductances: self.conduction.as_ref().map(|of| of.conductances(part)).unwrap_or_default(),
            view_factors: self.radiation.as_ref().map(|of| of.view_factors(part)).unwrap_or_default(),
        }
    }

    /// The law in a row, given the heat of the current there; returns its status.
    pub(crate) fn row(
        &self,
        row: Row<'_, '_>,
        found: &ThermalFound,
        heat_of_current: Option<HeatAmounts>,
        history: Option<&mut ThermalHistory>,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> Outcome {
        let jump = self.jump.and_then(|place| row.number(place));
        let temperatures = self.temperatures.and_then(|(slave, master)| {
            Some(Temperatures { slave: row.number(slave)?, master: row.number(master)?, jump })
        });
        let across = temperatures.or_else(|| jump.map(Temperatures::of_jump));
        let (mut is_beyond, mut gives_something) = (false, false);
        // A part that the plan does not have counts as zero.
        let conduction = match &self.conduction {
            None => Some(Amount::ZERO),
            Some(part) => {
                let conductance = self.conductance_in_row(part, row, &found.conductances, results, tally);
                is_beyond |= conductance.is_some_and(|(.., sides)| !sides.is_within());
                gives_something |= conductance.is_some();
                let both = conductance.zip(across);
                let heat = both.map(|((value, rest, _), sides)| conducted_heat_amount(value, rest, sides));
                results.set(self.slots.conduction, row.to, heat.map(Amount::value));
                heat
            }
        };
        let radiation = match &self.radiation {
            None => Some(Amount::ZERO),
            Some(part) => {
                let radiated = temperatures.and_then(|sides| part.in_row(row, &found.view_factors, sides, tally));
                is_beyond |= radiated.is_some_and(|(_, sides)| !sides.is_within());
                gives_something |= radiated.is_some();
                let heat = radiated.map(|(heat, _)| heat);
                results.set(self.slots.radiation, row.to, heat.map(Amount::value));
                heat
            }
        };
        let friction = self.friction.map_or(Some(HeatAmounts::ZERO), |part| part.in_row(row, tally));
        let current = if self.takes_heat_of_current() { heat_of_current } else { Some(HeatAmounts::ZERO) };
        let all = (|| {
            Some(InterfaceHeat {
                conduction: conduction?,
                radiation: radiation?,
                current: current?,
                friction: friction?,
            })
        })();
        let rubbed = friction.filter(|_| self.friction.is_some());
        gives_something |= rubbed.is_some();
        self.set_flows(row, all.as_ref(), rubbed, history, results);
        if !gives_something {
            return Outcome::Incomplete;
        }
        // Without `HFL` in the plan a missing part does not matter.
        tally.incomplete_heat += u64::from((all.is_none() && self.slots.hfl.is_some()) || friction.is_none());
        Outcome::Evaluated(if is_beyond { Some(Status::BeyondTable) } else { contact_status(row.state) })
    }

    /// The conductance with its slopes, its rounding error where that is known, and along which axes the row lies outside its table; `None` where the row lacks a number for it.
    fn conductance_in_row(
        &self,
        part: &Conduction,
        row: Row<'_, '_>,
        found: &ConductanceColumn,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> Option<(f64, Option<f64>, Sides)> {
        if !found.is_known(row.index) {
            return None;
        }
        let (value, sides) = (found.values[row.index], found.sides_of(row.index));
        results.set(self.slots.conductance, row.to, Some(value));
        part.set_slopes(row, results);
        if !sides.is_within() {
            part.count_sides(row.state, sides, tally);
        }
        Some((value, found.rest(row.index), sides))
    }

    fn set_flows(
        &self,
        row: Row<'_, '_>,
        all: Option<&InterfaceHeat>,
        friction: Option<HeatAmounts>,
        history: Option<&mut ThermalHistory>,
        results: &mut ResultBatch,
    ) {
        let slots = &self.slots;
        let area = self.area.and_then(|place| row.number(place));
        let mut set = |slot, value| results.set(slot, row.to, value);
        let leaving = all.map(InterfaceHeat::leaving_slave);
        set(slots.weight, self.friction.map(|part| part.generation.slave_weight));
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
}

impl Conduction {
    fn bind(binder: Binder<'_>, plan: &ConductionPlan, tables: &ThermalTables, choices: &Choices) -> Option<Self> {
        let mut variables = binder.means(&plan.variables);
        if let Some(of) = plan.mass_flow {
            let place = |column: Option<Column>| binder.place(column?);
            let of = MassFlow { mean: place(of.mean), slave: place(of.slave), master: place(of.master) };
            if let Some(variable) = variables.get_mut(MASS_FLOW) {
                *variable = Some(Variable::MassFlow(of));
            }
        }
        let source = match tables.thermal_conductance()? {
            ThermalConductance::Tables(tables) => {
                ConductionSource::Tables(BranchColumns::new(tables, &plan.tables, choices.accuracy, variables))
            }
            ThermalConductance::Calculix(curves) => {
                ConductionSource::Calculix { needs: Needs::of(curves.rows()), curves, variables }
            }
        };
        let of_conductance = |output| match output {
            Output::ThermalConductanceSlope(along) => Some(along),
            _ => None,
        };
        let slopes = binder.slopes_of_conductance(of_conductance, source.variables().len(), |along| match along {
            Along::Temperature => Some(0),
            Along::MassFlow => Some(MASS_FLOW),
            Along::FieldVariable(number) => Some(number as usize + MASS_FLOW),
            _ => None,
        });
        Some(Self { source, slopes })
    }

    fn conductances(&self, part: &Part<'_>) -> ConductanceColumn {
        let (curves, needs, variables) = match &self.source {
            ConductionSource::Tables(columns) => return columns.evaluate(part, None),
            ConductionSource::Calculix { curves, needs, variables } => (curves, needs, variables),
        };
        let lacks = |row, variable: usize| variables[variable].and_then(|of| of.in_row(row)).is_none();
        ConductanceColumn::of_rows((0..part.rows()).map(|index| {
            let row = part.row(index, index)?;
            let variables = in_row(variables, row);
            let lacks_variable =
                || needs.variables.iter().any(|index| variables[*index].is_nan() && lacks(row, *index));
            if row.state == ContactState::Closed && (needs.abscissa && row.pressure.is_none() || lacks_variable()) {
                return None;
            }
            let found = curves.conductance(&ContactPoint::of_row(row, &variables));
            Some((found.value, found.sides))
        }))
    }

    /// Counts a row that lies outside its table on these sides.
    fn count_sides(&self, state: ContactState, sides: Sides, tally: &mut InteractionTally) {
        match &self.source {
            ConductionSource::Calculix { .. } => tally.beyond_curves += 1,
            ConductionSource::Tables(columns) => {
                let branch = columns.tables.branch_of(state);
                tally.count_sides(THERMAL_CONDUCTANCE + usize::from(branch == Branch::Pressure), sides);
            }
        }
    }

    /// Slopes in every row, one column for each requested slope; meaningless in a row that lacks a number.
    fn slopes(&self, part: &Part<'_>) -> Vec<Vec<f64>> {
        let (curves, variables) = match &self.source {
            ConductionSource::Tables(columns) => return columns.slopes(part, &self.slopes),
            ConductionSource::Calculix { curves, variables, .. } => (curves, variables),
        };
        let mut columns = vec![vec![f64::NAN; part.rows()]; self.slopes.len()];
        if columns.is_empty() {
            return columns;
        }
        for index in 0..part.rows() {
            let Some(row) = part.row(index, index) else { continue };
            let slopes = self.slopes_of_curves(curves, variables, row);
            columns.iter_mut().zip(slopes).for_each(|(column, slope)| column[index] = slope);
        }
        columns
    }

    fn set_slopes(&self, row: Row<'_, '_>, results: &mut ResultBatch) {
        match &self.source {
            ConductionSource::Tables(columns) => columns.set_slopes(row, &self.slopes, results),
            ConductionSource::Calculix { .. } if self.slopes.is_empty() => {}
            ConductionSource::Calculix { curves, variables, .. } => {
                let slopes = self.slopes_of_curves(curves, variables, row);
                for (wanted, slope) in self.slopes.iter().zip(slopes) {
                    results.set(Some(wanted.slot), row.to, Some(slope));
                }
            }
        }
    }

    /// The slopes of CalculiX' curves in a row.
    fn slopes_of_curves(
        &self,
        curves: &CalculixConductance,
        variables: &[Option<Variable>],
        row: Row<'_, '_>,
    ) -> Vec<f64> {
        let variables = in_row(variables, row);
        let mut slopes = vec![0.0; variables.len()];
        let along_contact = curves.slopes(&ContactPoint::of_row(row, &variables), &mut slopes);
        let wanted = self.slopes.iter().map(|wanted| match wanted.along {
            SlopeAlong::Contact(Branch::Pressure) => along_contact.pressure,
            SlopeAlong::Contact(_) => along_contact.clearance,
            SlopeAlong::Variable(place) => slopes[place],
        });
        wanted.collect()
    }
}

impl ConductionSource {
    fn variables(&self) -> &[Option<Variable>] {
        match self {
            Self::Tables(columns) => &columns.variables,
            Self::Calculix { variables, .. } => variables,
        }
    }
}
