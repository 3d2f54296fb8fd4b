//! The thermal law compiled: its parts, and where its rows have what they need.

use super::{Compiler, Needs, numbers};
use crate::accuracy::Wanted;
use crate::evaluator::{Evaluator, FoundValue};
use crate::law::conductance::{Branch, Conductance, ConductanceTables, ContactPoint};
use crate::law::contact::ContactState;
use crate::law::friction::SlipRate;
use crate::law::heat::HeatGeneration;
use crate::law::radiation::RadiationLaw;
use crate::law::thermal::ThermalConductance;
use crate::nodes::Column;
use crate::plan::{
    ConductionPlan, CurrentHeat, History, MassFlow, SlipRateSource, Source, TablePlan, ThermalPlan, ThermalTables,
};
use crate::results::{Along, Output};
use inpact_parser::grammar::Dialect;

/// The thermal law with its places.
#[derive(Debug, Clone)]
pub(crate) struct CompiledThermal {
    pub(crate) conduction: Option<CompiledConduction>,
    pub(crate) radiation: Option<CompiledRadiation>,
    pub(crate) friction: Option<CompiledFriction>,
    pub(crate) current: CurrentHeat,
    /// Slave and master.
    pub(crate) temperatures: Option<(usize, usize)>,
    pub(crate) jump: Option<usize>,
    pub(crate) area: Option<usize>,
    pub(crate) history: History,
    pub(crate) slots: ThermalSlots,
}

/// Conduction with its places.
#[derive(Debug, Clone)]
pub(crate) struct CompiledConduction {
    pub(crate) conductance: ThermalConductance,
    /// The table against clearance as it is evaluated.
    clearance_form: Option<Evaluator>,
    /// The table against contact pressure as it is evaluated.
    pressure_form: Option<Evaluator>,
    /// What the table against clearance needs.
    clearance: Needs,
    /// What the table against contact pressure, or the curves of CalculiX need.
    pressure: Needs,
    /// Mean temperature, nothing for the mass flow rate, field variables.
    pub(crate) variables: Vec<Option<Source<usize>>>,
    pub(crate) mass_flow: Option<MassFlow<usize>>,
    pub(crate) slopes: Vec<(usize, Along)>,
}

/// The place of the mass flow rate among the variables.
pub(crate) const MASS_FLOW: usize = 1;

/// Radiation; it needs the clearance of open rows.
#[derive(Debug, Clone)]
pub(crate) struct CompiledRadiation {
    pub(crate) law: RadiationLaw,
}

/// Friction with its places.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CompiledFriction {
    pub(crate) shear: usize,
    pub(crate) slip_rate: Speed,
    pub(crate) generation: HeatGeneration,
    /// CalculiX takes shear and slip rate by their magnitudes.
    pub(crate) dialect: Dialect,
}

/// Where the slip rate comes from.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Speed {
    Place(usize),
    Given(SlipRate),
}

slots! {
    /// Where the results of the thermal law go.
    ThermalSlots {
        hfl: Hfl, hfla: Hfla, htl: Htl, htla: Htla, sfdr: Sfdr, sfdra: Sfdra, sfdrt: Sfdrt, sfdrta: Sfdrta,
        weight: Weight, conductance: ThermalConductance, conduction: HeatConduction, radiation: HeatRadiation,
        into_slave: TotalHeatSlave, into_master: TotalHeatMaster,
    }
}

impl Compiler<'_> {
    pub(super) fn thermal(self, plan: &ThermalPlan, tables: &ThermalTables, accuracy: Wanted) -> CompiledThermal {
        let place = |column: Column| self.place(column);
        let conduction = plan.conduction.as_ref().and_then(|conduction| self.conduction(conduction, tables, accuracy));
        let radiation = plan.radiation.as_ref().and(tables.radiation.as_ref()).and_then(|law| law.as_ref().ok());
        let friction = plan.friction.and_then(|friction| {
            let slip_rate = match friction.slip_rate {
                SlipRateSource::Column => Speed::Place(place(Column::SlipRate)?),
                SlipRateSource::Given(speed) => Speed::Given(SlipRate(speed)),
            };
            Some(CompiledFriction {
                dialect: friction.dialect,
                shear: place(friction.shear)?,
                slip_rate,
                generation: plan.heat?,
            })
        });
        CompiledThermal {
            conduction,
            radiation: radiation.map(|law| CompiledRadiation { law: law.clone() }),
            friction,
            current: plan.current,
            temperatures: plan.temperatures.and_then(|[slave, master]| Some((place(slave)?, place(master)?))),
            jump: plan.jump.and_then(place),
            area: plan.area.and_then(place),
            history: plan.history,
            slots: ThermalSlots::new(|output| self.slot(output)),
        }
    }

    fn conduction(self, plan: &ConductionPlan, tables: &ThermalTables, accuracy: Wanted) -> Option<CompiledConduction> {
        let planned = |branch| {
            let against = if branch == Branch::Pressure { Along::Pressure } else { Along::Clearance };
            plan.tables.iter().find(|planned| planned.against == against)
        };
        let conductance = match tables.thermal_conductance()? {
            ThermalConductance::Tables(tables) => ThermalConductance::Tables(tables.map(|branch, table| {
                let evaluator = planned(branch).and_then(TablePlan::evaluator);
                evaluator.map_or(table, |evaluator| evaluator.table().clone())
            })),
            curves @ ThermalConductance::Calculix(_) => curves,
        };
        let table_of = |branch| match &conductance {
            ThermalConductance::Tables(tables) => tables.table(branch),
            ThermalConductance::Calculix(curves) => Some(curves.rows()).filter(|_| branch == Branch::Pressure),
        };
        let needs = |branch| table_of(branch).map(Needs::of).unwrap_or_default();
        let form = |branch| match &conductance {
            ThermalConductance::Tables(tables) => {
                let table = tables.table(branch)?;
                let evaluator = planned(branch).and_then(TablePlan::evaluator).cloned();
                Some(evaluator.unwrap_or_else(|| Evaluator::new(table, accuracy)))
            }
            ThermalConductance::Calculix(_) => None,
        };
        let slopes = numbers(self.plan).filter_map(|output| match output {
            Output::ThermalConductanceSlope(along) => Some((self.slot(output)?, along)),
            _ => None,
        });
        let place = |column: Option<Column>| self.place(column?);
        Some(CompiledConduction {
            clearance_form: form(Branch::Clearance),
            pressure_form: form(Branch::Pressure),
            clearance: needs(Branch::Clearance),
            pressure: needs(Branch::Pressure),
            conductance,
            variables: self.sources(&plan.variables),
            mass_flow: plan.mass_flow.map(|of| MassFlow {
                mean: place(of.mean),
                slave: place(of.slave),
                master: place(of.master),
            }),
            slopes: slopes.collect(),
        })
    }
}

impl CompiledConduction {
    /// The conductance at a point as its tables are evaluated, and what rounding took away from it where that is known.
    pub(crate) fn conductance_at(&self, point: &ContactPoint<'_>) -> (Conductance, Option<f64>) {
        let ThermalConductance::Tables(tables) = &self.conductance else {
            return (self.conductance.conductance(point), None);
        };
        let (branch, found) = tables.found_with(point, |branch, table, first, others| {
            let form = if branch == Branch::Pressure { &self.pressure_form } else { &self.clearance_form };
            form.as_ref().map_or_else(
                || {
                    let (value, sides) = table.value_and_sides_at(first, others);
                    FoundValue { value, rest: None, sides }
                },
                |form| form.value_at(first, others),
            )
        });
        (Conductance { value: found.value, branch, sides: found.sides }, found.rest)
    }

    /// The table against this variable as it is evaluated; the curves of CalculiX have none.
    pub(crate) fn form(&self, against: Along) -> Option<&Evaluator> {
        if against == Along::Pressure { self.pressure_form.as_ref() } else { self.clearance_form.as_ref() }
    }

    /// What a row in this state needs; `None` where no table is in force.
    pub(crate) fn needs(&self, state: ContactState) -> Option<(Along, &Needs)> {
        let tables = match &self.conductance {
            ThermalConductance::Tables(tables) => tables,
            ThermalConductance::Calculix(_) => {
                return (state == ContactState::Closed).then_some((Along::Pressure, &self.pressure));
            }
        };
        match (tables, state) {
            (ConductanceTables::Clearance(_), _) | (ConductanceTables::Both { .. }, ContactState::Open) => {
                Some((Along::Clearance, &self.clearance))
            }
            (ConductanceTables::Pressure(_) | ConductanceTables::Both { .. }, ContactState::Closed) => {
                Some((Along::Pressure, &self.pressure))
            }
            _ => None,
        }
    }
}
