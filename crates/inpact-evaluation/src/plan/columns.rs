//! What becomes of each column of the node table.

use super::choices::Choices;
use super::reason::Reason;
use super::survey::Survey;
use super::{
    Bulk, CharacteristicLength, ColumnPlan, ColumnRole, GovernedBy, History, InteractionPlan, Rate, Source, TablePlan,
    UserPlan,
};
use crate::nodes::{Column, Part, Selection};
use crate::results::Along;
use inpact_parser::model::Regime;

impl InteractionPlan {
    /// The tables in use, each with the name of its values.
    pub fn tables(&self) -> impl Iterator<Item = (&'static str, &TablePlan)> {
        let named = |name| move |table| (name, table);
        let electrical = self.electrical.iter().flat_map(|law| &law.tables).map(named("conductance"));
        let thermal = self.thermal.iter();
        let conduction = thermal.clone().flat_map(|law| &law.conduction).flat_map(|part| &part.tables);
        let radiation = thermal.flat_map(|law| &law.radiation).map(|part| &part.table);
        let pore = self.pore.iter().filter_map(|law| law.table.as_ref());
        electrical
            .chain(conduction.map(named("thermal conductance")))
            .chain(radiation.map(named("view factor")))
            .chain(pore.map(named("permeability")))
    }

    /// Whether a user's routine gives the conductance.
    pub(super) fn has_user(&self) -> bool {
        self.electrical.as_ref().is_some_and(|law| law.user.is_some())
    }

    /// The columns whose numbers its rows need.
    pub(super) fn columns_read(&self) -> Vec<Column> {
        let mut columns = Vec::new();
        if self.electrical.is_none() && self.thermal.is_none() && self.pore.is_none() {
            return columns;
        }
        let contact = self.contact;
        columns.extend([contact.clearance, contact.pressure, contact.closed].into_iter().flatten());
        let mut take = |sources: &[Option<Source<Column>>]| {
            columns.extend(sources.iter().flatten().flat_map(Source::cells));
        };
        let mut is_history = false;
        let mut area = None;
        if let Some(law) = &self.electrical {
            take(&law.variables);
            take(&[law.jump]);
            is_history |= law.history == History::ByTime;
            area = area.or(law.area);
        }
        if let Some(law) = &self.thermal {
            columns.extend(law.columns());
            is_history |= law.history == History::ByTime;
            area = area.or(law.area);
        }
        if let Some(law) = &self.pore {
            columns.extend(law.variables.iter().flatten().flat_map(Source::cells));
            columns.extend([Part::Slave, Part::Master].map(Column::PorePressure));
            columns.extend([law.jump, law.across].into_iter().flatten());
            if law.bulk == Bulk::Columns {
                columns.extend([Part::Slave, Part::Master].map(Column::BulkPermeability));
            }
            if law.rate == Rate::Column {
                columns.push(Column::ClearanceRate);
            }
            if law.characteristic_length == CharacteristicLength::Column {
                columns.push(Column::CharacteristicLength);
            }
            is_history |= law.history == History::ByTime;
            area = area.or(law.area);
        }
        let users = self.electrical.iter().filter_map(|law| law.user.as_ref());
        columns.extend(users.flat_map(UserPlan::columns));
        columns.extend(area);
        columns.extend(is_history.then_some(Column::Time));
        columns
    }
}

/// What becomes of each column, in the order of the header.
pub(super) fn column_plans(
    survey: &Survey,
    choices: &Choices,
    selection: &Selection,
    interactions: &[InteractionPlan],
) -> Vec<ColumnPlan> {
    let plans = survey.header.cells.iter().map(|cell| ColumnPlan {
        header: cell.text.clone(),
        column: cell.column,
        role: cell.column.map_or(ColumnRole::NotRead(Reason::UnknownColumn), |column| {
            role(column, survey, choices, selection, interactions)
        }),
        range: cell.column.and_then(|column| survey.range(column)),
    });
    plans.collect()
}

fn role(
    column: Column,
    survey: &Survey,
    choices: &Choices,
    selection: &Selection,
    interactions: &[InteractionPlan],
) -> ColumnRole {
    let has_history = interactions.iter().any(|plan| plan.histories.is_some());
    let is_read = match column {
        Column::Interaction => survey.governed_by == GovernedBy::Column,
        Column::Node => has_history || interactions.iter().any(InteractionPlan::has_user),
        _ => selection.number(column).is_some(),
    };
    match (column.is_key(), is_read) {
        (true, true) => ColumnRole::KeyAndRead,
        (true, false) => ColumnRole::Key,
        (false, true) => ColumnRole::Read,
        (false, false) => ColumnRole::NotRead(why_not_read(column, survey, choices, interactions)),
    }
}

fn why_not_read(column: Column, survey: &Survey, choices: &Choices, interactions: &[InteractionPlan]) -> Reason {
    let is_empty = survey.columns.contains(&column) && survey.range(column).is_none();
    let has_tables = interactions.iter().any(|plan| plan.electrical.is_some() || plan.thermal.is_some());
    let pore = || interactions.iter().filter_map(|plan| plan.pore.as_ref());
    match column {
        Column::CharacteristicLength if choices.characteristic_length.is_some() => Reason::Option("--char-length"),
        _ if is_empty && survey.rows > 0 => Reason::Empty,
        Column::Temperature(Part::Slave | Part::Master)
            if is_read_whole(Column::Temperature(Part::Both), interactions) =>
        {
            Reason::GivenBy(Column::Temperature(Part::Both))
        }
        Column::FieldVariable(number, Part::Slave | Part::Master)
            if is_read_whole(Column::FieldVariable(number, Part::Both), interactions) =>
        {
            Reason::GivenBy(Column::FieldVariable(number, Part::Both))
        }
        Column::Potential(Part::Slave | Part::Master) if is_read_whole(Column::Potential(Part::Both), interactions) => {
            Reason::GivenBy(Column::Potential(Part::Both))
        }
        _ if let Some(value) = folded_value(column, interactions) => Reason::Folded(value),
        Column::Temperature(_) | Column::FieldVariable(..) | Column::MassFlow(_)
            if has_tables || pore().next().is_some() =>
        {
            Reason::NoTableDepends
        }
        Column::ClearanceRate | Column::BulkPermeability(_)
            if pore().next().is_some() && pore().all(|law| law.regime.regime == Regime::SteadyState) =>
        {
            Reason::SteadyState
        }
        Column::Potential(_) | Column::Area if choices.outputs.is_some() => Reason::NotAsked,
        _ => Reason::NotNeeded,
    }
}

/// The value for which the tables are folded along the variable of a column.
fn folded_value(column: Column, interactions: &[InteractionPlan]) -> Option<f64> {
    let along = match column {
        Column::Clearance => Along::Clearance,
        Column::Pressure => Along::Pressure,
        Column::Temperature(_) => Along::Temperature,
        Column::FieldVariable(number, _) => Along::FieldVariable(number),
        Column::PorePressure(_) => Along::PorePressure,
        Column::MassFlow(_) => Along::MassFlow,
        _ => return None,
    };
    let tables = interactions.iter().flat_map(InteractionPlan::tables);
    tables.flat_map(|(_, table)| &table.axes).filter(|axis| axis.along == along).find_map(|axis| axis.fold)
}

/// Whether the column that stands for both sides is read.
fn is_read_whole(column: Column, interactions: &[InteractionPlan]) -> bool {
    interactions.iter().any(|plan| plan.columns_read().contains(&column))
}
