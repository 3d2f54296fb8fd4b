//! The plan of the heat radiated across one interaction.

use crate::law::thermal::planned::{Planned, temperatures};
use crate::law::thermal::tables::ThermalTables;
use crate::nodes::Column;
use crate::plan::TablePlan;
use crate::plan::folding::table_plan;
use crate::plan::planner::Planner;
use crate::plan::reason::Reason;
use crate::plan::source::cell;
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
pub(crate) fn plan_radiation(planner: Planner<'_>, tables: &ThermalTables) -> Planned<RadiationPlan> {
    let law = match &tables.radiation {
        None => return Planned::Absent,
        Some(_) if planner.choices.dialect == Dialect::Calculix => {
            return Planned::LeftOut(Reason::NotInCalculix("has no *GAP RADIATION"));
        }
        Some(Err(fault)) => {
            return Planned::LeftOut(fault.reason());
        }
        Some(Ok(law)) => law,
    };
    let contact = planner.contact();
    let is_known_otherwise = contact.pressure.is_some() || contact.closed.is_some();
    // In contact the view factor is that of zero clearance.
    if !(is_known_otherwise && planner.never(planner.of.open))
        && let Err(missing) = cell(Column::Clearance, |column| planner.presence(column))
    {
        return Planned::LeftOut(Reason::Missing(missing));
    }
    if let Err(missing) = temperatures(planner) {
        return Planned::LeftOut(Reason::Missing(missing));
    }
    Planned::Part(RadiationPlan {
        coefficient: law.coefficient.0,
        absolute_zero: law.absolute_zero,
        table: table_plan(&law.view_factor, |_| Along::Clearance),
    })
}
