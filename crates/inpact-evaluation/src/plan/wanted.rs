//! The columns of a node table that some law of a deck could use, before its rows are known.

use super::choices::Choices;
use super::governing::GovernedBy;
use super::requested::{OF_AREA, is_of_history};
use super::tables::{InteractionTables, matters};
use crate::law::electrical::plan::{want_electrical, want_of_electrical_law};
use crate::law::pore::plan::want_pore;
use crate::law::thermal::plan::want_thermal;
use crate::law::thermal::tables::ThermalTables;
use crate::law::user::plan::want_user;
use crate::nodes::{Column, Header, Part};
use crate::results::Along;
use crate::table::PiecewiseTable;
use inpact_parser::model::Model;
use std::collections::BTreeSet;

/// The columns of numbers, in the order of the header.
pub(crate) fn wanted_columns(
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

/// Columns of contact, area and time, as far as the requested outputs need them.
pub(crate) fn want_of_any_law(choices: &Choices, wanted: &mut BTreeSet<Column>) {
    wanted.extend([Column::Clearance, Column::Pressure, Column::Closed]);
    if choices.asks_for(&OF_AREA) {
        wanted.insert(Column::Area);
    }
    if choices.asks_where(is_of_history) {
        wanted.insert(Column::Time);
    }
}

/// The columns of temperatures and field variables that a table's value depends on.
pub(crate) fn want_variables(table: &PiecewiseTable, along: impl Fn(usize) -> Along, wanted: &mut BTreeSet<Column>) {
    for axis in (0..table.axis_count()).filter(|axis| matters(table, *axis)) {
        wanted.extend(columns_of(along(axis)).into_iter().flatten());
    }
}

/// The columns that a temperature or a field variable may come from: both sides together, slave, master.
pub(crate) fn columns_of(along: Along) -> Option<[Column; 3]> {
    let parts = [Part::Both, Part::Slave, Part::Master];
    match along {
        Along::Temperature => Some(parts.map(Column::Temperature)),
        Along::MassFlow => Some(parts.map(Column::MassFlow)),
        Along::FieldVariable(number) => Some(parts.map(|part| Column::FieldVariable(number, part))),
        Along::Clearance | Along::Pressure | Along::PorePressure => None,
    }
}
