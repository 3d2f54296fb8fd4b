//! The plan of the heat radiated across one interaction.

use crate::law::thermal::tables::ThermalTables;
use crate::nodes::{Column, Part};
use crate::plan::TablePlan;
use crate::plan::folding::table_plan;
use crate::plan::planner::Planner;
use crate::plan::reason::Reason;
use crate::results::Along;
use inpact_parser::grammar::Dialect;

/// The plan of radiation.
#[derive(Debug, Clone, PartialEq)]
pub struct RadiationPlan {
    /// C, the heat per fourth power of temperature at a view factor of 1.
    pub coefficient: f64,
    /// θ_Z.
    pub absolute_zero: f64,
    /// The view factors.
    pub table: TablePlan,
}

/// Plans radiation, which needs the constants of the deck, the temperatures of both sides, and the clearance of open rows.
pub(crate) fn plan_radiation(planner: Planner<'_>, tables: &ThermalTables) -> Result<Option<RadiationPlan>, Reason> {
    let law = match &tables.radiation {
        None => return Ok(None),
        Some(_) if planner.choices.dialect == Dialect::Calculix => {
            return Err(Reason::NotInCalculix("has no *GAP RADIATION"));
        }
        Some(Err(fault)) => return Err(fault.reason()),
        Some(Ok(law)) => law,
    };
    let contact = planner.contact();
    let is_known_otherwise = contact.pressure.is_some() || contact.closed.is_some();
    // In contact the view factor is that of zero clearance.
    if !(is_known_otherwise && planner.never(planner.of.open)) {
        planner.cell(Column::Clearance)?;
    }
    planner.all_of([Part::Slave, Part::Master].map(Column::Temperature))?;
    Ok(Some(RadiationPlan {
        coefficient: law.coefficient.0,
        absolute_zero: law.absolute_zero,
        table: table_plan(&law.view_factor, |_| Along::Clearance),
    }))
}
