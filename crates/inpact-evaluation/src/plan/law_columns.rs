//! Columns shared by several laws.

use super::choices::Choices;
use super::output_groups::{OF_AREA, is_of_history};
use super::tables::matters;
use crate::nodes::{Column, Part};
use crate::results::Along;
use crate::table::PiecewiseTable;
use std::collections::BTreeSet;

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

/// The columns of a temperature or a field variable: both sides together, slave, master.
pub(crate) fn columns_of(along: Along) -> Option<[Column; 3]> {
    let parts = [Part::Both, Part::Slave, Part::Master];
    match along {
        Along::Temperature => Some(parts.map(Column::Temperature)),
        Along::MassFlow => Some(parts.map(Column::MassFlow)),
        Along::FieldVariable(number) => Some(parts.map(|part| Column::FieldVariable(number, part))),
        Along::Clearance | Along::Pressure | Along::PorePressure => None,
    }
}
