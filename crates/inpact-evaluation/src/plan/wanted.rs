//! The columns of a node table that some law of a deck could use, before its rows are known.

use super::asked::{ELECTRICAL_FLOWS, OF_AREA, SUMS_OF_HEAT, is_of_history};
use super::choices::Choices;
use super::governing::GovernedBy;
use super::regime::regime;
use super::tables::{InteractionTables, electrical_axis, matters, pore_axis};
use super::thermal::tells_of_friction;
use super::thermal_tables::{ThermalTables, thermal_axis};
use super::user::want_user;
use crate::nodes::{Column, Header, Part};
use crate::results::Along;
use crate::table::PiecewiseTable;
use inpact_parser::model::{Interaction, Model, Procedure, Regime};
use std::collections::BTreeSet;

/// The columns of numbers, in the order of the header.
pub(super) fn wanted_columns(
    model: &Model,
    governed_by: GovernedBy,
    choices: &Choices,
    header: &Header,
) -> Vec<Column> {
    let candidates = match governed_by {
        GovernedBy::Chosen(index) | GovernedBy::TheOnlyOne(index) => index..index + 1,
        GovernedBy::Column => 0..model.interactions.len(),
    };
    let mut wanted = BTreeSet::new();
    let mut has_user = false;
    for interaction in model.interactions.values().skip(candidates.start).take(candidates.len()) {
        let tables = InteractionTables::of(interaction, choices.clearance_tail);
        want_electrical(&tables, choices, &mut wanted);
        want_thermal(interaction, &ThermalTables::of(model, interaction, choices.dialect), choices, &mut wanted);
        let electrical = interaction.gap_electrical_conductance.as_ref();
        has_user |= choices.user_conductance.is_some() && electrical.is_some_and(|option| option.user.is_some());
        want_pore(model, interaction, &tables, choices, &mut wanted);
    }
    if has_user {
        want_of_electrical_law(choices, &mut wanted);
        want_user(header, &mut wanted);
    }
    // Of two cells that mean the same the first counts.
    let is_first = |(index, column): &(usize, Column)| header.position(*column) == Some(*index);
    let columns = header.cells.iter().enumerate().filter_map(|(index, cell)| Some((index, cell.column?)));
    columns.filter(is_first).map(|(_, column)| column).filter(|column| wanted.contains(column)).collect()
}

/// What tells contact, area and time, as far as the outputs asked for need them.
fn want_of_any_law(choices: &Choices, wanted: &mut BTreeSet<Column>) {
    wanted.extend([Column::Clearance, Column::Pressure, Column::Closed]);
    if choices.asks_for(&OF_AREA) {
        wanted.insert(Column::Area);
    }
    if choices.asks_where(is_of_history) {
        wanted.insert(Column::Time);
    }
}

/// What every electrical law could use, whatever gives its conductance.
fn want_of_electrical_law(choices: &Choices, wanted: &mut BTreeSet<Column>) {
    want_of_any_law(choices, wanted);
    if choices.asks_for(&ELECTRICAL_FLOWS) || choices.asks_for(&SUMS_OF_HEAT) {
        wanted.extend([Part::Both, Part::Slave, Part::Master].map(Column::Potential));
    }
}

fn want_electrical(tables: &InteractionTables, choices: &Choices, wanted: &mut BTreeSet<Column>) {
    for (against, table) in tables.electrical() {
        want_of_electrical_law(choices, wanted);
        want_variables(table, |axis| electrical_axis(against, axis), wanted);
    }
}

fn want_thermal(interaction: &Interaction, tables: &ThermalTables, choices: &Choices, wanted: &mut BTreeSet<Column>) {
    let of_conductance = tables.conductance_tables();
    if !of_conductance.is_empty() || tables.radiation.is_some() {
        want_of_any_law(choices, wanted);
        wanted.extend([Part::Slave, Part::Master].map(Column::Temperature));
        wanted.insert(Column::TemperatureJump);
    }
    for (against, table) in of_conductance {
        want_variables(table, |axis| thermal_axis(against, axis), wanted);
    }
    if tells_of_friction(interaction) {
        want_of_any_law(choices, wanted);
        wanted.extend([Column::Shear, Column::SlipRate]);
    }
}

fn want_pore(
    model: &Model,
    interaction: &Interaction,
    tables: &InteractionTables,
    choices: &Choices,
    wanted: &mut BTreeSet<Column>,
) {
    let option = interaction.contact_permeability.as_ref();
    if option.is_none() && !model.procedures.iter().any(Procedure::solves_pore_pressure) {
        return;
    }
    want_of_any_law(choices, wanted);
    wanted.extend([Part::Slave, Part::Master, Part::Both].map(Column::PorePressure));
    wanted.insert(Column::FlowAcross);
    if let Some(table) = tables.permeability() {
        want_variables(table, pore_axis, wanted);
    }
    let cutoffs = option.map(|option| (option.cutoff_flow_across, option.cutoff_gap_fill));
    if !matches!(cutoffs, Some((Some(_), Some(_)))) && choices.characteristic_length.is_none() {
        wanted.insert(Column::CharacteristicLength);
    }
    if regime(model, choices.regime, Procedure::solves_pore_pressure).regime == Regime::Transient {
        wanted.insert(Column::ClearanceRate);
        wanted.extend([Part::Slave, Part::Master].map(Column::BulkPermeability));
    }
}

/// The columns of temperatures and field variables that a table's value depends on.
fn want_variables(table: &PiecewiseTable, along: impl Fn(usize) -> Along, wanted: &mut BTreeSet<Column>) {
    for axis in (0..table.axis_count()).filter(|axis| matters(table, *axis)) {
        wanted.extend(columns_of(along(axis)).into_iter().flatten());
    }
}

/// The columns that a temperature or a field variable may come from: both sides together, slave, master.
pub(super) fn columns_of(along: Along) -> Option<[Column; 3]> {
    let parts = [Part::Both, Part::Slave, Part::Master];
    match along {
        Along::Temperature => Some(parts.map(Column::Temperature)),
        Along::MassFlow => Some(parts.map(Column::MassFlow)),
        Along::FieldVariable(number) => Some(parts.map(|part| Column::FieldVariable(number, part))),
        Along::Clearance | Along::Pressure | Along::PorePressure => None,
    }
}
