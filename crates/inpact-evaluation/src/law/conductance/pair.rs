//! The tables that the rows of a conductance form, against clearance and against contact pressure.

use super::ConductanceTables;
use crate::error::Error;
use crate::plan::Reason;
use crate::results::Along;
use crate::table::{PiecewiseTable, Tail};
use inpact_parser::model::Table;

/// The tables of a conductance; an error where the rows form none.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct TablePair {
    clearance: Option<Result<PiecewiseTable, Error>>,
    pressure: Option<Result<PiecewiseTable, Error>>,
}

impl TablePair {
    /// Compiles tables; that against clearance is continued as its tail says.
    pub(crate) fn of((clearance, tail): (Option<&Table>, Tail), pressure: Option<&Table>) -> Self {
        Self {
            clearance: clearance.map(|table| build(table, tail)),
            pressure: pressure.map(|table| build(table, Tail::Constant)),
        }
    }

    /// The tables that can be evaluated, with the first of their variables.
    pub(crate) fn tables(&self) -> impl Iterator<Item = (Along, &PiecewiseTable)> {
        let tables = [(Along::Clearance, &self.clearance), (Along::Pressure, &self.pressure)];
        tables.into_iter().filter_map(|(against, table)| Some((against, table.as_ref()?.as_ref().ok()?)))
    }

    /// The conductance of the tables that can be evaluated; `None` where there is none.
    pub(crate) fn conductance(&self) -> Option<ConductanceTables> {
        let table = |against| self.tables().find(|(first, _)| *first == against).map(|(_, table)| table.clone());
        ConductanceTables::of(table(Along::Clearance), table(Along::Pressure))
    }

    /// Why rows below `keyword` give no conductance, or none for some rows of a node table.
    pub(crate) fn fault(&self, keyword: &'static str) -> Option<Reason> {
        let mut tables = [&self.clearance, &self.pressure].into_iter().flatten().peekable();
        if tables.peek().is_none() {
            return Some(Reason::NoRows(keyword));
        }
        tables.find_map(|table| table.as_ref().err().copied()).map(Reason::BrokenTable)
    }
}

fn build(table: &Table, tail: Tail) -> Result<PiecewiseTable, Error> {
    PiecewiseTable::from_rows(&table.values, table.width(), tail)
}
