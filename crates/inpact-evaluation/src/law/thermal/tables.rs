//! The thermal tables of an interaction: *GAP CONDUCTANCE in either dialect, *GAP RADIATION.

use crate::error::Error;
use crate::law::calculix::CalculixConductance;
use crate::law::conductance::pair::TablePair;
use crate::law::radiation::{Emissivities, RadiationCoefficient, RadiationLaw};
use crate::law::thermal::ThermalConductance;
use crate::plan::reason::Reason;
use crate::results::Along;
use crate::table::{PiecewiseTable, Tail};
use inpact_parser::grammar::Dialect;
use inpact_parser::model::{GapConductance, GapRadiation, Interaction, Model, OptionKind};

/// The laws of heat in the rows of an interaction; an error where they form no table.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct ThermalTables {
    /// *GAP CONDUCTANCE; `None` where the interaction has none.
    pub(crate) conductance: Option<ConductanceRows>,
    /// *GAP RADIATION; `None` where the interaction has none.
    pub(crate) radiation: Option<Result<RadiationLaw, RadiationFault>>,
}

/// Forms of *GAP CONDUCTANCE.
#[derive(Debug, PartialEq)]
pub(crate) enum ConductanceRows {
    /// The conductance is that of a user subroutine.
    User,
    /// The tables of Abaqus; none where there are no rows, in either dialect.
    Tables(TablePair),
    /// The curves of CalculiX.
    Calculix(Result<CalculixConductance, Error>),
}

/// Reasons why *GAP RADIATION gives no law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum RadiationFault {
    /// The constant of that name is not given (T-42).
    NoConstant(&'static str),
    /// The first row does not have two emissivities from 0 to 1.
    BadEmissivities,
    /// The further rows form no table of view factors.
    BrokenTable(Error),
    /// There are no rows.
    NoRows,
}

impl ConductanceRows {
    /// Why there is no law.
    pub(crate) fn fault(&self) -> Option<Reason> {
        match self {
            Self::User => Some(Reason::NeedsUserSubroutine("GAPCON")),
            Self::Tables(tables) => tables.fault(OptionKind::GapConductance.keyword()),
            Self::Calculix(curves) => curves.as_ref().err().copied().map(Reason::BrokenCurves),
        }
    }
}

impl RadiationFault {
    /// Why there is no law.
    pub(crate) fn reason(self) -> Reason {
        match self {
            Self::NoConstant(name) => Reason::NoConstant(name),
            Self::BadEmissivities => Reason::BadEmissivities,
            Self::BrokenTable(error) => Reason::BrokenTable(error),
            Self::NoRows => Reason::NoRows(OptionKind::GapRadiation.keyword()),
        }
    }
}

impl ThermalTables {
    /// Compiles the tables of an interaction.
    pub(crate) fn of(model: &Model, interaction: &Interaction, dialect: Dialect) -> Self {
        let radiation = interaction.gap_radiation();
        Self {
            conductance: interaction.gap_conductance().map(|given| conductance(&given, dialect)),
            radiation: radiation.map(|given| radiation_law(&given, model)),
        }
    }

    /// The tables of conductance that can be evaluated, with the first of their variables.
    pub(crate) fn conductance_tables(&self) -> Vec<(Along, &PiecewiseTable)> {
        match &self.conductance {
            Some(ConductanceRows::Tables(tables)) => tables.tables().collect(),
            Some(ConductanceRows::Calculix(Ok(curves))) => vec![(Along::Pressure, curves.rows())],
            _ => Vec::new(),
        }
    }

    /// The law of conductance, where all its tables can be evaluated.
    pub(crate) fn thermal_conductance(&self) -> Option<ThermalConductance> {
        match self.conductance.as_ref()? {
            ConductanceRows::User => None,
            ConductanceRows::Calculix(curves) => Some(ThermalConductance::Calculix(curves.as_ref().ok()?.clone())),
            ConductanceRows::Tables(tables) => tables.conductance().map(ThermalConductance::Tables),
        }
    }
}

fn conductance(given: &GapConductance<'_>, dialect: Dialect) -> ConductanceRows {
    if !given.users.is_empty() {
        return ConductanceRows::User;
    }
    if dialect == Dialect::Calculix {
        // Of two tables the later one is in force.
        let curves = given.tables.last().filter(|table| table.width() == CalculixConductance::WIDTH);
        let curves = curves.map(|table| CalculixConductance::from_rows(&table.values));
        return curves.map_or_else(|| ConductanceRows::Tables(TablePair::default()), ConductanceRows::Calculix);
    }
    // Beyond the last clearance nothing is conducted, whatever the choice for current (K-31, Q-1).
    ConductanceRows::Tables(TablePair::of((given.clearance(), Tail::Zero), given.pressure()))
}

/// The law of the rows: the emissivities, then view factors and clearances (2.6).
fn radiation_law(given: &GapRadiation<'_>, model: &Model) -> Result<RadiationLaw, RadiationFault> {
    let constants = model.constants;
    let absolute_zero = constants.absolute_zero.ok_or(RadiationFault::NoConstant("ABSOLUTE ZERO"))?;
    let stefan_boltzmann = constants.stefan_boltzmann.ok_or(RadiationFault::NoConstant("STEFAN BOLTZMANN"))?;
    let ([slave, master], rows) = given.rows(&model.parameters).ok_or(RadiationFault::NoRows)?;
    let emissivities = Emissivities { slave, master };
    let coefficient =
        RadiationCoefficient::new(stefan_boltzmann, emissivities).ok_or(RadiationFault::BadEmissivities)?;
    let view_factor =
        PiecewiseTable::from_rows(rows.as_flattened(), 2, Tail::Zero).map_err(RadiationFault::BrokenTable)?;
    Ok(RadiationLaw { coefficient, absolute_zero, view_factor })
}

/// The variable of axis `axis` of a thermal conductance (T-03).
pub(crate) fn thermal_axis(against: Along, axis: usize) -> Along {
    match axis {
        0 => against,
        1 => Along::Temperature,
        2 => Along::MassFlow,
        _ => Along::field_variable(axis - 3),
    }
}
