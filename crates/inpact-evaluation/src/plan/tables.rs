//! The tables of an interaction, compiled to find out which variables their values depend on.

use crate::error::Error;
use crate::law::conductance::pair::TablePair;
use crate::law::thermal::tables::ThermalTables;
use crate::results::Along;
use crate::table::{PiecewiseTable, Tail};
use inpact_parser::model::Interaction;

/// The tables of one interaction; an error where the rows form none.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct InteractionTables {
    /// Electrical conductance.
    pub(crate) electrical: TablePair,
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
        let electrical = interaction.gap_electrical_conductance.as_ref();
        let electrical = electrical.filter(|option| option.user.is_none());
        let permeability = interaction.contact_permeability.as_ref().and_then(|option| option.table.as_ref());
        Self {
            electrical: electrical.map_or_else(TablePair::default, |option| {
                TablePair::of((option.clearance.as_deref(), tail), option.pressure.as_deref())
            }),
            permeability: permeability
                .map(|table| PiecewiseTable::from_rows(&table.values, table.width(), Tail::Constant)),
        }
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
