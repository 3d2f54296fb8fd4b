//! The plan of the heat conducted across one interaction.

use crate::law::thermal::tables::{ThermalTables, thermal_axis};
use crate::nodes::Column;
use crate::plan::TablePlan;
use crate::plan::folding::{fold_and_choose, still_read, table_plan};
use crate::plan::law_columns::columns_of;
use crate::plan::planner::{LeftOuts, Planner};
use crate::plan::reason::{Missing, Reason};
use crate::plan::source::Source;
use crate::plan::tables::matters;
use crate::results::{Along, Output};
use crate::table::PiecewiseTable;
use inpact_parser::grammar::Dialect;

/// The plan of conduction.
#[derive(Debug, Clone, PartialEq)]
pub struct ConductionPlan {
    /// The dialect of the law.
    pub dialect: Dialect,
    /// The tables that rows reach.
    pub tables: Vec<TablePlan>,
    /// Sources of mean temperature and field variables, in the order of the tables' columns; `None` where no table in use depends on one, and for the mass flow rate.
    pub variables: Vec<Option<Source<Column>>>,
    /// The source of the mean mass flow rate, if a table in use depends on it.
    pub mass_flow: Option<MassFlow<Column>>,
}

/// Sources of the mean of the magnitudes of the mass flow rates, in terms of `C` as in [`Source`]; at least one is present.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MassFlow<C> {
    /// The mean itself, which takes precedence where its cell has a number.
    pub mean: Option<C>,
    /// The rate of the slave; a side without one counts as at rest (K-32).
    pub slave: Option<C>,
    /// The rate of the master.
    pub master: Option<C>,
}

/// Plans conduction: its law by *GAP CONDUCTANCE in either dialect, and the columns it reads.
pub(crate) fn plan_conduction(
    planner: Planner<'_>,
    tables: &ThermalTables,
    left_out: &mut LeftOuts,
) -> Result<Option<ConductionPlan>, Reason> {
    let Some(rows) = &tables.conductance else { return Ok(None) };
    if let Some(fault) = rows.fault() {
        return Err(fault);
    }
    planner.check_contact()?;
    let all = tables.conductance_tables();
    let mut used: Vec<(Along, &PiecewiseTable)> = Vec::new();
    for (against, table) in &all {
        match planner.unreached(*against, all.len()) {
            Some(reason) => left_out.push(format!("table of thermal conductance against {against}"), reason),
            None => used.push((*against, *table)),
        }
    }
    for (against, table) in &used {
        planner.check_abscissa(*against, table)?;
    }
    let count = used.iter().map(|(_, table)| table.axis_count()).max().unwrap_or(1);
    let mut variables = Vec::new();
    let mut mass_flow = None;
    for axis in 1..count {
        let is_needed = used.iter().any(|(_, table)| matters(table, axis));
        let along = thermal_axis(Along::Clearance, axis);
        let columns = columns_of(along).filter(|_| is_needed);
        variables.push(match (along, columns) {
            (_, None) => None,
            (Along::MassFlow, Some(columns)) => {
                mass_flow = Some(mass_flow_source(planner, columns)?);
                None
            }
            (_, Some(columns)) => Some(planner.whole_or_sides(columns)?),
        });
    }
    let tables = used.iter().map(|(against, table)| table_plan(table, |axis| thermal_axis(*against, axis)));
    let mut plan = ConductionPlan { dialect: planner.choices.dialect, tables: tables.collect(), variables, mass_flow };
    // The curves of CalculiX are not a plain table, and are not folded.
    if plan.dialect == Dialect::Abaqus {
        let tables: Vec<&PiecewiseTable> = used.iter().map(|(_, table)| *table).collect();
        fold_conduction(planner, (&tables, all.len()), &mut plan);
    }
    Ok(Some(plan))
}

/// Folds the tables in use, of `count` that there are, along variables that are constant, and chooses their methods; variables that no table reads any more are left out.
fn fold_conduction(planner: Planner<'_>, (tables, count): (&[&PiecewiseTable], usize), plan: &mut ConductionPlan) {
    let may_fold = planner.may_fold(|output| matches!(output, Output::ThermalConductanceSlope(_)));
    let variables = &plan.variables;
    for (table, of_table) in tables.iter().zip(&mut plan.tables) {
        fold_and_choose(planner, table, of_table, |along| match along {
            _ if !may_fold => None,
            Along::Clearance => planner.constant_clearance(count),
            Along::Pressure => planner.constant_pressure(),
            Along::Temperature => planner.constant_of((*variables.first()?)?),
            Along::FieldVariable(number) => planner.constant_of((*variables.get(number as usize + 1)?)?),
            Along::MassFlow | Along::PorePressure => None,
        });
    }
    plan.variables = still_read(std::mem::take(&mut plan.variables), &plan.tables, 1);
}

/// One column is enough: the mean, or the rate of one side.
fn mass_flow_source(planner: Planner<'_>, [mean, slave, master]: [Column; 3]) -> Result<MassFlow<Column>, Missing> {
    let found = |column| Some(column).filter(|column| planner.presence(*column).has_numbers());
    let source = MassFlow { mean: found(mean), slave: found(slave), master: found(master) };
    if source == (MassFlow { mean: None, slave: None, master: None }) {
        planner.cell(mean)?;
    }
    Ok(source)
}
