//! Table values of a part, evaluated by column before the pass over its rows.

use crate::evaluator::TableValues;
use crate::law::conductance::columns::ConductanceColumn;
use crate::law::thermal::columns::ThermalFound;

/// Columns of table values of a part, before the pass over its rows.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub(super) conductances: Option<ConductanceColumn>,
    pub(super) thermal: ThermalFound,
    pub(super) permeabilities: TableValues,
}
