//! The laws of one surface interaction as functions of plain inputs, for use without a node table: a solver evaluates them point by point.
//!
//! An interaction of a deck is interpreted by the same code as for a plan; here nothing is folded, as the points are not yet known.

use crate::law::conductance::ConductanceTables;
use crate::law::electrical::plan::LAW as ELECTRICAL_LAW;
use crate::law::friction::plan::{given_slip_rate, tells_of_friction};
use crate::law::heat::HeatGeneration;
use crate::law::pore::plan::LAW as PORE_LAW;
use crate::law::pore::{Cutoffs, Permeability, PoreLaw};
use crate::law::radiation::RadiationLaw;
use crate::law::thermal::ThermalConductance;
use crate::law::thermal::tables::{RadiationFault, ThermalTables};
use crate::law::user::plan::user_names;
use crate::law::user::{UserLaw, UserNames};
use crate::plan::{Choices, InteractionTables, LeftOut, Reason, generation_of};
use inpact_parser::grammar::Dialect;
use inpact_parser::model::{Interaction, Model, OptionKind, Procedure};

/// The laws of an interaction; a law that it does not have, or that cannot be evaluated, is `None`.
#[derive(Debug, Clone)]
pub struct InterfaceLaws {
    /// Electrical conductance.
    pub electrical: Option<ElectricalSource>,
    /// Conversion of dissipated energy into heat; `None` where a user subroutine of the interaction switches it off (K-05).
    pub heat_generation: Option<HeatGeneration>,
    /// Thermal conductance.
    pub thermal: Option<ThermalConductance>,
    /// Radiation across the gap.
    pub radiation: Option<RadiationLaw>,
    /// Whether the deck defines friction, which generates heat where shear stress and slip rate are known.
    pub friction: Option<FrictionSource>,
    /// Pore fluid across the interface and into its gap; without *CONTACT PERMEABILITY the permeability is infinite (P-03).
    pub pore: Option<PoreLaw>,
    /// Whether the deck has pore fluid: by *CONTACT PERMEABILITY, or by a procedure that solves for it.
    pub tells_of_pore: bool,
    /// The parts that cannot be evaluated, with their flow and the reason.
    pub left_out: Vec<(FlowOf, LeftOut)>,
}

/// Flows across an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlowOf {
    /// Electric current.
    Charge,
    /// Heat.
    Heat,
    /// Pore fluid.
    PoreFluid,
}

/// Sources of an electrical conductance.
#[derive(Debug, Clone)]
pub enum ElectricalSource {
    /// Tables of the deck; axis 1 is the mean temperature, the field variables follow.
    Tables(Box<ConductanceTables>),
    /// A routine of the user's, and the names it is called with.
    User(UserLaw, Box<UserNames>),
}

/// Inputs of the heat of friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionSource {
    /// The slip rate that the deck gives (K-38, CalculiX).
    pub slip_rate: Option<f64>,
    /// CalculiX uses the magnitudes of shear and slip rate.
    pub takes_magnitudes: bool,
}

impl InterfaceLaws {
    /// The laws of an interaction of `model`.
    pub fn of(model: &Model, interaction: &Interaction, choices: &Choices) -> Self {
        let mut left_out = Vec::new();
        let tables = InteractionTables::of(interaction, choices.clearance_tail);
        let thermal_tables = ThermalTables::of(model, interaction, choices.dialect);
        Self {
            electrical: electrical(model, interaction, &tables, choices, &mut left_out),
            heat_generation: generation_of(interaction),
            thermal: thermal(&thermal_tables, &mut left_out),
            radiation: radiation(&thermal_tables, choices.dialect, &mut left_out),
            friction: tells_of_friction(interaction).then(|| FrictionSource {
                slip_rate: given_slip_rate(interaction),
                takes_magnitudes: choices.dialect == Dialect::Calculix,
            }),
            pore: pore(interaction, &tables, choices, &mut left_out),
            tells_of_pore: interaction.contact_permeability.is_some()
                || model.procedures.iter().any(Procedure::solves_pore_pressure),
            left_out,
        }
    }
}

fn electrical(
    model: &Model,
    interaction: &Interaction,
    tables: &InteractionTables,
    choices: &Choices,
    left_out: &mut Vec<(FlowOf, LeftOut)>,
) -> Option<ElectricalSource> {
    let option = interaction.gap_electrical_conductance.as_ref()?;
    let mut refuse = |reason| {
        left_out.push((FlowOf::Charge, LeftOut::law(ELECTRICAL_LAW, reason)));
        None
    };
    if option.user.is_some() {
        return match &choices.user_conductance {
            Some(law) => {
                let names = user_names(model, &interaction.name, &mut Vec::new());
                Some(ElectricalSource::User(law.clone(), Box::new(names)))
            }
            None => refuse(Reason::NeedsUserSubroutine("GAPELECTR")),
        };
    }
    match tables.electrical.fault(OptionKind::GapElectricalConductance.keyword()) {
        Some(reason) => refuse(reason),
        None => tables.electrical.conductance().map(|tables| ElectricalSource::Tables(Box::new(tables))),
    }
}

fn thermal(tables: &ThermalTables, left_out: &mut Vec<(FlowOf, LeftOut)>) -> Option<ThermalConductance> {
    let Some(reason) = tables.conductance.as_ref()?.fault() else { return tables.thermal_conductance() };
    left_out.push((FlowOf::Heat, LeftOut::law("heat conduction", reason)));
    None
}

fn radiation(tables: &ThermalTables, dialect: Dialect, left_out: &mut Vec<(FlowOf, LeftOut)>) -> Option<RadiationLaw> {
    let reason = match tables.radiation.as_ref()? {
        _ if dialect == Dialect::Calculix => Reason::NotInCalculix("has no *GAP RADIATION"),
        Ok(law) => return Some(law.clone()),
        Err(fault) => RadiationFault::reason(*fault),
    };
    left_out.push((FlowOf::Heat, LeftOut::law("heat radiation", reason)));
    None
}

fn pore(
    interaction: &Interaction,
    tables: &InteractionTables,
    choices: &Choices,
    left_out: &mut Vec<(FlowOf, LeftOut)>,
) -> Option<PoreLaw> {
    if let Some(error) = tables.permeability_error() {
        left_out.push((FlowOf::PoreFluid, LeftOut::law(PORE_LAW, Reason::BrokenTable(error))));
        return None;
    }
    Some(PoreLaw {
        permeability: tables.permeability().cloned().map_or(Permeability::Infinite, Permeability::Finite),
        cutoffs: Cutoffs::of(interaction),
        boundary: choices.cutoff_boundary,
    })
}
