//! The use of each column of the node table.

use super::choices::Choices;
use super::reason::Reason;
use super::surveyed::Survey;
use super::{
    Bulk, CharacteristicLength, ColumnPlan, ColumnRole, GovernedBy, History, InteractionPlan, Rate, Source, TablePlan,
    UserPlan,
};
use crate::nodes::{Column, Part, Selection};
use crate::results::Along;
use inpact_parser::model::Regime;
use std::collections::{HashMap, HashSet};

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
    pub(crate) fn has_user(&self) -> bool {
        self.electrical.as_ref().is_some_and(|law| law.user.is_some())
    }

    /// The columns whose numbers its rows need.
    pub(crate) fn columns_read(&self) -> Vec<Column> {
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
            columns.extend(law.pressures.into_iter().flatten());
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

/// The use of each column, in the order of the header.
pub(crate) fn column_plans(
    survey: &Survey,
    choices: &Choices,
    selection: &Selection,
    interactions: &[InteractionPlan],
) -> Vec<ColumnPlan> {
    let uses = Uses::of(survey, choices, selection, interactions);
    let plans = survey.header.cells.iter().map(|cell| ColumnPlan {
        header: cell.text.clone(),
        column: cell.column,
        role: cell.column.map_or(ColumnRole::NotRead(Reason::UnknownColumn), |column| uses.role(column)),
        range: cell.column.and_then(|column| uses.range(column)),
    });
    plans.collect()
}

/// The union of the columns of all interactions, collected once: a table may have as many columns as a deck has interactions.
struct Uses<'a> {
    survey: &'a Survey,
    choices: &'a Choices,
    /// Minimum and maximum of the finite numbers of each surveyed column.
    ranges: HashMap<Column, Option<(f64, f64)>>,
    selected: HashSet<Column>,
    /// The columns read by any law.
    read: HashSet<Column>,
    /// The value at which tables are folded along a variable: that of the first folded table.
    folds: Vec<(Along, f64)>,
    has_history: bool,
    has_user: bool,
    has_tables: bool,
    has_pore: bool,
    is_pore_steady: bool,
}

impl<'a> Uses<'a> {
    fn of(survey: &'a Survey, choices: &'a Choices, selection: &Selection, interactions: &[InteractionPlan]) -> Self {
        let mut folds: Vec<(Along, f64)> = Vec::new();
        for axis in interactions.iter().flat_map(InteractionPlan::tables).flat_map(|(_, table)| &table.axes) {
            let Some(at) = axis.fold else { continue };
            // There are as many variables as field variables in the deck, at most a thousand.
            if !folds.iter().any(|(along, _)| *along == axis.along) {
                folds.push((axis.along, at));
            }
        }
        let mut pore = interactions.iter().filter_map(|plan| plan.pore.as_deref()).peekable();
        Self {
            survey,
            choices,
            ranges: survey.columns.iter().map(|column| (*column, survey.range(*column))).collect(),
            selected: selection.numbers.iter().copied().collect(),
            read: interactions.iter().flat_map(InteractionPlan::columns_read).collect(),
            folds,
            has_history: interactions.iter().any(|plan| plan.histories.is_some()),
            has_user: interactions.iter().any(InteractionPlan::has_user),
            has_tables: interactions.iter().any(|plan| plan.electrical.is_some() || plan.thermal.is_some()),
            has_pore: pore.peek().is_some(),
            is_pore_steady: pore.all(|law| law.regime.regime == Regime::SteadyState),
        }
    }

    fn range(&self, column: Column) -> Option<(f64, f64)> {
        self.ranges.get(&column).copied().flatten()
    }

    fn role(&self, column: Column) -> ColumnRole {
        let is_read = match column {
            Column::Interaction => self.survey.governed_by == GovernedBy::Column,
            Column::Node => self.has_history || self.has_user,
            _ => self.selected.contains(&column),
        };
        if let (Column::Interaction, GovernedBy::Chosen(_)) = (column, self.survey.governed_by) {
            return ColumnRole::NotRead(Reason::Option("--interaction"));
        }
        match (column.is_key(), is_read) {
            (true, true) => ColumnRole::KeyAndRead,
            (true, false) => ColumnRole::Key,
            (false, true) => ColumnRole::Read,
            (false, false) => ColumnRole::NotRead(self.why_not_read(column)),
        }
    }

    fn why_not_read(&self, column: Column) -> Reason {
        let is_empty = self.ranges.get(&column).is_some_and(Option::is_none);
        let is_one_side = |part| matches!(part, Part::Slave | Part::Master);
        // The column of both sides, where one side is not read.
        let both = match column {
            Column::Temperature(part) if is_one_side(part) => Some(Column::Temperature(Part::Both)),
            Column::FieldVariable(number, part) if is_one_side(part) => Some(Column::FieldVariable(number, Part::Both)),
            Column::Potential(part) if is_one_side(part) => Some(Column::Potential(Part::Both)),
            _ => None,
        };
        match column {
            Column::CharacteristicLength if self.choices.characteristic_length.is_some() => {
                Reason::Option("--char-length")
            }
            _ if is_empty && self.survey.rows > 0 => Reason::Empty,
            _ if let Some(both) = both.filter(|both| self.read.contains(both)) => Reason::GivenBy(both),
            _ if let Some(value) = self.folded_value(column) => Reason::Folded(value),
            Column::Temperature(_) | Column::FieldVariable(..) | Column::MassFlow(_)
                if self.has_tables || self.has_pore =>
            {
                Reason::NoTableDepends
            }
            Column::ClearanceRate | Column::BulkPermeability(_) if self.has_pore && self.is_pore_steady => {
                Reason::SteadyState
            }
            Column::Potential(_) | Column::Area if self.choices.outputs.is_some() => Reason::NotRequested,
            _ => Reason::NotNeeded,
        }
    }

    /// The value for which the tables are folded along the variable of a column.
    fn folded_value(&self, column: Column) -> Option<f64> {
        let along = match column {
            Column::Clearance => Along::Clearance,
            Column::Pressure => Along::Pressure,
            Column::Temperature(_) => Along::Temperature,
            Column::FieldVariable(number, _) => Along::FieldVariable(number),
            Column::PorePressure(_) => Along::PorePressure,
            Column::MassFlow(_) => Along::MassFlow,
            _ => return None,
        };
        self.folds.iter().find(|(folded, _)| *folded == along).map(|(_, value)| *value)
    }
}
