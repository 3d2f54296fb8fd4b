//! The tables of an interaction, compiled to find out which variables their values depend on.

use crate::error::Error;
use crate::law::conductance::ConductanceTables;
use crate::law::thermal::tables::ThermalTables;
use crate::results::Along;
use crate::table::{PiecewiseTable, Tail};
use inpact_parser::model::{Interaction, Table};

/// The tables of one interaction; an error where the rows form none.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct InteractionTables {
    /// Electrical conductance against clearance.
    pub(crate) clearance: Option<Result<PiecewiseTable, Error>>,
    /// Electrical conductance against contact pressure.
    pub(crate) pressure: Option<Result<PiecewiseTable, Error>>,
    /// Permeability.
    pub(crate) permeability: Option<Result<PiecewiseTable, Error>>,
}

/// All tables of an interaction, built once for its plan and its laws.
#[derive(Debug, PartialEq)]
pub(crate) struct BuiltTables {
    /// Of electrical conductance and permeability.
    pub(crate) flow: InteractionTables,
    /// Of heat.
    pub(crate) thermal: ThermalTables,
}

impl InteractionTables {
    /// Compiles the tables of an interaction; `tail` is that of the table against clearance.
    pub(crate) fn of(interaction: &Interaction, tail: Tail) -> Self {
        let build = |table: &Table, tail| PiecewiseTable::from_rows(&table.values, table.width(), tail);
        let electrical = interaction.gap_electrical_conductance.as_ref();
        let electrical = electrical.filter(|option| option.user.is_none());
        let permeability = interaction.contact_permeability.as_ref().and_then(|option| option.table.as_ref());
        Self {
            clearance: electrical.and_then(|option| option.clearance.as_deref()).map(|table| build(table, tail)),
            pressure: electrical
                .and_then(|option| option.pressure.as_deref())
                .map(|table| build(table, Tail::Constant)),
            permeability: permeability.map(|table| build(table, Tail::Constant)),
        }
    }

    /// The electrical tables that can be evaluated, with the first of their variables.
    pub(crate) fn electrical(&self) -> impl Iterator<Item = (Along, &PiecewiseTable)> {
        let tables = [(Along::Clearance, &self.clearance), (Along::Pressure, &self.pressure)];
        tables.into_iter().filter_map(|(against, table)| Some((against, table.as_ref()?.as_ref().ok()?)))
    }

    /// The electrical conductance of the tables that can be evaluated; `None` where there is none.
    pub(crate) fn electrical_tables(&self) -> Option<ConductanceTables> {
        let table = |against| self.electrical().find(|(first, _)| *first == against).map(|(_, table)| table.clone());
        ConductanceTables::of(table(Along::Clearance), table(Along::Pressure))
    }

    /// The fault of an electrical table.
    pub(crate) fn electrical_error(&self) -> Option<Error> {
        [&self.clearance, &self.pressure].into_iter().flatten().find_map(|table| table.as_ref().err().copied())
    }

    /// The fault of the permeability table.
    pub(crate) fn permeability_error(&self) -> Option<Error> {
        self.permeability.as_ref()?.as_ref().err().copied()
    }

    /// The permeability table, when it can be evaluated.
    pub(crate) fn permeability(&self) -> Option<&PiecewiseTable> {
        self.permeability.as_ref()?.as_ref().ok()
    }
}

/// The variable of axis `axis` of a conductance table (T-03).
pub(crate) fn electrical_axis(against: Along, axis: usize) -> Along {
    match axis {
        0 => against,
        1 => Along::Temperature,
        _ => Along::field_variable(axis - 2),
    }
}

/// The variable of axis `axis` of a permeability table (T-03).
pub(crate) fn pore_axis(axis: usize) -> Along {
    match axis {
        0 => Along::Pressure,
        1 => Along::PorePressure,
        2 => Along::Temperature,
        _ => Along::field_variable(axis - 3),
    }
}

/// Whether a table's value depends on axis `axis`.
pub(crate) fn matters(table: &PiecewiseTable, axis: usize) -> bool {
    table.axes().get(axis).is_some_and(crate::table::AxisSummary::matters)
}
