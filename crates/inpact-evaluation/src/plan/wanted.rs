//! The columns of a node table that some law of a deck could use, before its rows are known.

use super::choices::Choices;
use super::governing::GovernedBy;
use super::tables::InteractionTables;
use crate::law::electrical::plan::{want_electrical, want_of_electrical_law};
use crate::law::pore::plan::want_pore;
use crate::law::thermal::plan::want_thermal;
use crate::law::thermal::tables::ThermalTables;
use crate::law::user::plan::want_user;
use crate::nodes::{Column, Header};
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
    // Of two cells with the same meaning the first is used.
    let is_first = |(index, column): &(usize, Column)| header.position(*column) == Some(*index);
    let columns = header.cells.iter().enumerate().filter_map(|(index, cell)| Some((index, cell.column?)));
    columns.filter(is_first).map(|(_, column)| column).filter(|column| wanted.contains(column)).collect()
}
