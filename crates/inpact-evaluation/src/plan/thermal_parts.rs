//! The parts of the thermal law of one interaction, each planned by itself: conduction, radiation, friction.

use super::electrical::table_plan;
use super::folding::fold_and_choose;
use super::make::{LeftOuts, Planner};
use super::reason::{Missing, Reason};
use super::source::{cell, whole_or_sides};
use super::tables::matters;
use super::thermal::{Planned, tells_of_friction, temperatures};
use super::thermal_tables::{ConductanceRows, ThermalTables, thermal_axis};
use super::wanted::columns_of;
use super::{AxisPlan, ConductionPlan, FrictionPlan, MassFlow, RadiationPlan, SlipRateSource};
use crate::law::heat::HeatGeneration;
use crate::nodes::Column;
use crate::results::{Along, Output};
use crate::table::PiecewiseTable;
use inpact_parser::grammar::Dialect;

/// Plans conduction: its law by *GAP CONDUCTANCE in either dialect, and the columns it reads.
pub(super) fn plan_conduction(
    planner: Planner<'_>,
    tables: &ThermalTables,
    left_out: &mut LeftOuts,
) -> Planned<ConductionPlan> {
    let error = match &tables.conductance {
        None => return Planned::Absent,
        Some(ConductanceRows::User) => Some(Reason::NeedsUserSubroutine("GAPCON")),
        Some(ConductanceRows::Nothing) => Some(Reason::NoRows("GAP CONDUCTANCE")),
        Some(ConductanceRows::Tables { clearance, pressure }) => {
            let mut errors = [clearance, pressure].into_iter().flatten().filter_map(|table| table.as_ref().err());
            errors.next().copied().map(Reason::BrokenTable)
        }
        Some(ConductanceRows::Calculix(curves)) => curves.as_ref().err().copied().map(Reason::BrokenCurves),
    };
    match error {
        Some(reason) => Planned::LeftOut(reason),
        None => Planned::of(conduction_of_tables(planner, tables, left_out).map_err(Reason::Missing)),
    }
}

fn conduction_of_tables(
    planner: Planner<'_>,
    tables: &ThermalTables,
    left_out: &mut LeftOuts,
) -> Result<ConductionPlan, Missing> {
    let presence = |column| planner.presence(column);
    let contact = planner.contact();
    if contact.clearance.is_none() && contact.pressure.is_none() && contact.closed.is_none() {
        cell(Column::Clearance, presence)?;
    }
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
            (_, Some(columns)) => Some(whole_or_sides(columns, presence)?),
        });
    }
    let tables = used.iter().map(|(against, table)| table_plan(table, |axis| thermal_axis(*against, axis)));
    let mut plan = ConductionPlan { dialect: planner.choices.dialect, tables: tables.collect(), variables, mass_flow };
    // The curves of CalculiX are no plain table, and are evaluated as they are.
    if plan.dialect == Dialect::Abaqus {
        let tables: Vec<&PiecewiseTable> = used.iter().map(|(_, table)| *table).collect();
        fold_conduction(planner, (&tables, all.len()), &mut plan);
    }
    Ok(plan)
}

/// Folds the tables in use, of `count` that there are, along what is the same in every row, and chooses their forms; what no table reads any more is left out.
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
    let is_read = |axis: usize| plan.tables.iter().any(|table| table.axes.get(axis).is_some_and(AxisPlan::is_read));
    let sources = plan.variables.iter().enumerate();
    plan.variables = sources.map(|(index, source)| source.filter(|_| is_read(index + 1))).collect();
}

/// One column is enough: the mean, or the rate of one side.
fn mass_flow_source(planner: Planner<'_>, [mean, slave, master]: [Column; 3]) -> Result<MassFlow<Column>, Missing> {
    let found = |column| Some(column).filter(|column| planner.presence(*column).has_numbers());
    let source = MassFlow { mean: found(mean), slave: found(slave), master: found(master) };
    if source == (MassFlow { mean: None, slave: None, master: None }) {
        cell(mean, |column| planner.presence(column))?;
    }
    Ok(source)
}

/// Plans radiation, which needs the constants of the deck, the temperatures of both sides, and the clearance of open rows.
pub(super) fn plan_radiation(planner: Planner<'_>, tables: &ThermalTables) -> Planned<RadiationPlan> {
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
    let told_otherwise = contact.pressure.is_some() || contact.closed.is_some();
    // In contact the view factor is that of zero clearance.
    if !(told_otherwise && planner.never(planner.of.open))
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

/// Plans friction: where the deck tells of it and `shear` and `slip_rate` have numbers, or the deck gives the speed (K-38).
pub(super) fn plan_friction(
    planner: Planner<'_>,
    heat: Option<HeatGeneration>,
    left_out: &mut LeftOuts,
) -> Planned<FrictionPlan> {
    const SWITCHED_OFF: &str = "heat generation";
    let columns = [Column::Shear, Column::SlipRate];
    let is_there = |column: &Column| planner.may_have(*column);
    if !tells_of_friction(planner.interaction) {
        let is_described = columns.iter().all(is_there);
        return if is_described { Planned::LeftOut(Reason::NoKeyword("FRICTION")) } else { Planned::Absent };
    }
    let given_speed = planner
        .interaction
        .gap_heat_generation
        .as_deref()
        .and_then(inpact_parser::model::HeatGeneration::given_slip_rate);
    let has_option = |keyword: &str| planner.interaction.other.iter().any(|option| option.keyword == keyword);
    // A deck without heat has friction too, and says nothing of its heat.
    let is_thermal = planner.interaction.gap_heat_generation.is_some()
        || ["GAP CONDUCTANCE", "GAP RADIATION"].into_iter().any(has_option);
    let is_reported = columns.iter().any(is_there) || (is_thermal && has_option("FRICTION"));
    if !is_reported {
        return Planned::Absent;
    }
    if heat.is_none() {
        if !left_out.0.iter().any(|left_out| left_out.what == SWITCHED_OFF) {
            left_out.push(SWITCHED_OFF, Reason::HeatSwitchedOff);
        }
        return Planned::Absent;
    }
    if planner.choices.dialect == Dialect::Calculix && planner.interaction.gap_heat_generation.is_none() {
        return Planned::LeftOut(Reason::NotInCalculix("generates heat with *GAP HEAT GENERATION only"));
    }
    let needed: Vec<Column> = if given_speed.is_some() { vec![Column::Shear] } else { columns.to_vec() };
    let lacking: Vec<Column> = needed.into_iter().filter(|column| !planner.presence(*column).has_numbers()).collect();
    if !lacking.is_empty() {
        let are_empty = lacking.iter().all(|column| planner.survey.columns.contains(column));
        let missing = if are_empty { Missing::empty(lacking) } else { Missing::absent(lacking) };
        return Planned::LeftOut(Reason::Missing(missing));
    }
    let contact = planner.contact();
    if contact.clearance.is_none() && contact.pressure.is_none() && contact.closed.is_none() {
        return Planned::LeftOut(Reason::Missing(Missing::absent(vec![Column::Clearance])));
    }
    Planned::Part(FrictionPlan {
        dialect: planner.choices.dialect,
        shear: Column::Shear,
        slip_rate: given_speed.map_or(SlipRateSource::Column, SlipRateSource::Given),
    })
}
