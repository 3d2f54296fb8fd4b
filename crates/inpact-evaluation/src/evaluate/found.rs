//! Table values of a part, evaluated by column before the pass over its rows.

use crate::evaluator::TableValues;
use crate::law::conductance::columns::ConductanceColumn;
use crate::law::thermal::columns::ThermalFound;

/// Results of a part in columns, before its rows are gone through.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub(super) conductances: Option<ConductanceColumn>,
    pub(super) thermal: ThermalFound,
    pub(super) permeabilities: TableValues,
}
