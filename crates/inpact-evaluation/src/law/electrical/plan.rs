//! The plan of the electrical law of one interaction.

use crate::law::conductance::pair::TablePair;
use crate::law::heat::HeatGeneration;
use crate::law::user::plan::{UserPlan, plan_user};
use crate::nodes::{Column, Part};
use crate::plan::folding::{fold_and_choose, still_read, table_plan};
use crate::plan::law_columns::{want_of_any_law, want_variables};
use crate::plan::output_groups::{ELECTRICAL_FLOWS, SUMS_OF_HEAT};
use crate::plan::planner::{LeftOuts, Planner};
use crate::plan::reason::{Missing, Reason};
use crate::plan::regime::regime;
use crate::plan::source::Source;
use crate::plan::tables::{InteractionTables, electrical_axis};
use crate::plan::{Choices, Derivatives, Dropped, History, RegimeInForce, TablePlan};
use crate::results::{Along, Output};
use crate::table::PiecewiseTable;
use inpact_parser::model::{ElectricalConductance, OptionKind, Procedure};
use std::collections::BTreeSet;

const KEYWORD: &str = OptionKind::GapElectricalConductance.keyword();

/// The plan of the electrical law of an interaction.
#[derive(Debug, Clone, PartialEq)]
pub struct ElectricalPlan {
    /// Steady state or transient, and why.
    pub regime: RegimeInForce,
    /// The tables that rows reach; `None` where a user's routine gives the conductance.
    pub tables: Vec<TablePlan>,
    /// The arguments of a user's routine, where it gives the conductance.
    pub user: Option<UserPlan>,
    /// Conversion of the dissipated energy into heat; `None` where a user subroutine of the interaction switches it off (K-05).
    pub heat: Option<HeatGeneration>,
    /// Sources of average temperature and field variables, in the order of the tables' columns; `None` where no table in use depends on one.
    pub variables: Vec<Option<Source<Column>>>,
    /// The source of the jump of potential.
    pub jump: Option<Source<Column>>,
    /// `area`, where the results need it and it has numbers.
    pub area: Option<Column>,
    /// Whether the rows of a node are a history.
    pub history: History,
}

/// The name of the law where it is left out.
pub(crate) const LAW: &str = "electrical law";

/// Plans the electrical law; an error says why a deck or node table that tells of it has none.
pub(crate) fn plan_electrical(
    planner: Planner<'_>,
    tables: &InteractionTables,
    outputs: &mut BTreeSet<Output>,
    left_out: &mut LeftOuts,
    notes: &mut Vec<String>,
    dropped: &mut Vec<Dropped>,
) -> Result<Option<ElectricalPlan>, Reason> {
    let Some(option) = &planner.interaction.gap_electrical_conductance else {
        let mut potentials = [Part::Both, Part::Slave, Part::Master].map(Column::Potential).into_iter();
        let has_potential = potentials.any(|column| planner.may_have(column));
        return if has_potential { Err(Reason::NoKeyword(KEYWORD)) } else { Ok(None) };
    };
    let mut plan = ElectricalPlan {
        regime: regime(planner.model, planner.choices.regime, Procedure::solves_electrical),
        tables: Vec::new(),
        user: None,
        heat: None,
        variables: Vec::new(),
        jump: None,
        area: None,
        history: History::None,
    };
    if option.user.is_none() {
        plan_tables(planner, (option, &tables.electrical), &mut plan, left_out, dropped)?;
    } else if planner.choices.user_conductance.is_some() {
        // The routine replaces all tables (K-08).
        plan.user = Some(plan_user(planner, notes)?);
    } else {
        return Err(Reason::NeedsUserSubroutine("GAPELECTR"));
    }
    plan.heat = planner.heat_generation();
    if plan.heat.is_none() {
        left_out.push("heat generation", Reason::HeatSwitchedOff);
    }
    outputs.insert(Output::Conductance);
    if planner.choices.derivatives == Derivatives::Given {
        let along = plan.tables.iter().flat_map(|table| &table.axes).filter(|axis| axis.matters).map(|axis| axis.along);
        let of_user = plan.user.as_ref().map(|_| Along::Temperature);
        outputs.extend(along.chain(of_user).map(Output::ConductanceSlope));
    }
    plan_flows(planner, &mut plan, outputs, left_out);
    Ok(Some(plan))
}

/// Plans the tables that rows reach, and the sources of their variables.
fn plan_tables(
    planner: Planner<'_>,
    (option, tables): (&ElectricalConductance, &TablePair),
    plan: &mut ElectricalPlan,
    left_out: &mut LeftOuts,
    dropped: &mut Vec<Dropped>,
) -> Result<(), Reason> {
    if let Some(fault) = tables.fault(KEYWORD) {
        return Err(fault);
    }
    let all: Vec<(Along, &PiecewiseTable)> = tables.tables().collect();
    let mut used = Vec::new();
    for (against, table) in &all {
        match planner.unreached(*against, all.len()) {
            Some(reason) => {
                let what = format!("table against {against}");
                let whole = electrical_table_plan(option, *against, table);
                // No row reads it, so with separate branches it would cost nothing; without them every row reads both.
                dropped.push(Dropped { what: what.clone(), cost: whole.whole_cost(), reason: reason.clone() });
                left_out.push(what, reason);
            }
            None => used.push((*against, *table)),
        }
    }
    let variables = sources(planner, &used)?;
    plan.tables = used.iter().map(|(against, table)| electrical_table_plan(option, *against, table)).collect();
    let may_fold = planner.may_fold(|output| matches!(output, Output::ConductanceSlope(_)));
    for ((_, table), plan) in used.iter().zip(&mut plan.tables) {
        fold_and_choose(planner, table, plan, |along| match along {
            _ if !may_fold => None,
            Along::Clearance => planner.constant_clearance(all.len()),
            Along::Pressure => planner.constant_pressure(),
            _ => planner.constant_of(variables[variable_index(along)?]?),
        });
    }
    plan.variables = still_read(variables, &plan.tables, 1);
    Ok(())
}

/// The sources of the variables of the tables in use, or the missing columns.
fn sources(planner: Planner<'_>, used: &[(Along, &PiecewiseTable)]) -> Result<Vec<Option<Source<Column>>>, Missing> {
    planner.check_contact()?;
    for (against, table) in used {
        planner.check_abscissa(*against, table)?;
    }
    let tables: Vec<&PiecewiseTable> = used.iter().map(|(_, table)| *table).collect();
    planner.sources(&tables, 1, |axis| electrical_axis(Along::Clearance, axis))
}

/// Plans current and heat, their integrals and their products with the area.
fn plan_flows(
    planner: Planner<'_>,
    plan: &mut ElectricalPlan,
    outputs: &mut BTreeSet<Output>,
    left_out: &mut LeftOuts,
) {
    use Output::{Ecd, Ecda, Ecdt, Ecdta, HeatMaster, HeatSlave, Sjd, Sjda, Sjdt, Sjdta, Weight};
    let heat = plan.heat.is_some();
    if heat {
        outputs.insert(Weight);
    }
    let potentials = [Part::Both, Part::Slave, Part::Master].map(Column::Potential);
    match planner.whole_or_sides(potentials) {
        Ok(source) => plan.jump = Some(source),
        Err(missing) => {
            let all = [Ecd, Ecda, Ecdt, Ecdta, Sjd, Sjda, Sjdt, Sjdta, HeatSlave, HeatMaster];
            left_out.push_outputs(if heat { &all } else { &all[..4] }, Reason::Missing(missing));
            return;
        }
    }
    if heat {
        outputs.extend([HeatSlave, HeatMaster]);
    }
    let groups = [[Ecd, Ecda, Ecdt, Ecdta], [Sjd, Sjda, Sjdt, Sjdta]];
    (plan.area, plan.history) = planner.flows(if heat { &groups } else { &groups[..1] }, outputs, left_out);
}

/// The index of a temperature or a field variable among the variables of the law.
fn variable_index(along: Along) -> Option<usize> {
    match along {
        Along::Temperature => Some(0),
        Along::FieldVariable(number) => Some(number as usize),
        Along::Clearance | Along::Pressure | Along::PorePressure | Along::MassFlow => None,
    }
}

fn electrical_table_plan(option: &ElectricalConductance, against: Along, table: &PiecewiseTable) -> TablePlan {
    let rows = if against == Along::Clearance { &option.clearance } else { &option.pressure };
    let ends_in_zero = rows.as_ref().is_some_and(|rows| rows.groups().all(|group| rows.row(group.end - 1)[0] == 0.0));
    TablePlan { ends_in_zero, ..table_plan(table, |axis| electrical_axis(against, axis)) }
}

/// The columns that the electrical law by tables could use.
pub(crate) fn want_electrical(tables: &InteractionTables, choices: &Choices, wanted: &mut BTreeSet<Column>) {
    for (against, table) in tables.electrical.tables() {
        want_of_electrical_law(choices, wanted);
        want_variables(table, |axis| electrical_axis(against, axis), wanted);
    }
}

/// Columns that every electrical law could use, whatever the source of its conductance.
pub(crate) fn want_of_electrical_law(choices: &Choices, wanted: &mut BTreeSet<Column>) {
    want_of_any_law(choices, wanted);
    if choices.asks_for(&ELECTRICAL_FLOWS) || choices.asks_for(&SUMS_OF_HEAT) {
        wanted.extend([Part::Both, Part::Slave, Part::Master].map(Column::Potential));
    }
}
