//! The plan of the electrical law of one interaction.

use crate::law::heat::HeatGeneration;
use crate::law::user::plan::{UserPlan, plan_user};
use crate::nodes::{Column, Part};
use crate::plan::folding::{fold_and_choose, table_plan};
use crate::plan::law_columns::{columns_of, want_of_any_law, want_variables};
use crate::plan::output_groups::{ELECTRICAL_FLOWS, SUMS_OF_HEAT};
use crate::plan::planner::{LeftOuts, Planner};
use crate::plan::reason::{Missing, Reason};
use crate::plan::regime::regime;
use crate::plan::source::{Source, whole_or_sides};
use crate::plan::tables::{InteractionTables, electrical_axis, matters};
use crate::plan::{AxisPlan, Choices, Derivatives, Dropped, History, RegimeInForce, TablePlan};
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

/// Plans the electrical law; `None` after reporting why there is none.
pub(crate) fn plan_electrical(
    planner: Planner<'_>,
    tables: &InteractionTables,
    outputs: &mut BTreeSet<Output>,
    left_out: &mut LeftOuts,
    notes: &mut Vec<String>,
    dropped: &mut Vec<Dropped>,
) -> Option<ElectricalPlan> {
    let Some(option) = &planner.interaction.gap_electrical_conductance else {
        let potentials = [Part::Both, Part::Slave, Part::Master].map(Column::Potential);
        if potentials.into_iter().any(|column| planner.may_have(column)) {
            left_out.push(LAW, Reason::NoKeyword(KEYWORD));
        }
        return None;
    };
    if option.user.is_some() {
        if planner.choices.user_conductance.is_none() {
            left_out.push(LAW, Reason::NeedsUserSubroutine("GAPELECTR"));
            return None;
        }
        return match plan_user(planner, notes) {
            Ok(user) => Some(plan_with_user(planner, user, outputs, left_out)),
            Err(missing) => {
                left_out.push(LAW, Reason::Missing(missing));
                None
            }
        };
    }
    if let Some(error) = tables.electrical_error() {
        left_out.push(LAW, Reason::BrokenTable(error));
        return None;
    }
    let all: Vec<(Along, &PiecewiseTable)> = tables.electrical().collect();
    if all.is_empty() {
        left_out.push(LAW, Reason::NoRows(KEYWORD));
        return None;
    }
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
    let variables = match sources(planner, &used) {
        Ok(variables) => variables,
        Err(missing) => {
            left_out.push(LAW, Reason::Missing(missing));
            return None;
        }
    };
    let heat = heat(planner, left_out);
    let mut tables: Vec<TablePlan> =
        used.iter().map(|(against, table)| electrical_table_plan(option, *against, table)).collect();
    let may_fold = planner.may_fold(|output| matches!(output, Output::ConductanceSlope(_)));
    for ((_, table), plan) in used.iter().zip(&mut tables) {
        fold_and_choose(planner, table, plan, |along| match along {
            _ if !may_fold => None,
            Along::Clearance => planner.constant_clearance(all.len()),
            Along::Pressure => planner.constant_pressure(),
            _ => planner.constant_of(variables[variable_index(along)?]?),
        });
    }
    let is_read = |axis: usize| tables.iter().any(|table| table.axes.get(axis).is_some_and(AxisPlan::is_read));
    let variables = variables.into_iter().enumerate();
    let variables = variables.map(|(index, source)| source.filter(|_| is_read(index + 1))).collect();
    let mut plan = ElectricalPlan {
        regime: regime(planner.model, planner.choices.regime, Procedure::solves_electrical),
        tables,
        user: None,
        heat,
        variables,
        jump: None,
        area: None,
        history: History::None,
    };
    outputs.insert(Output::Conductance);
    if planner.choices.derivatives == Derivatives::Given {
        let along = plan.tables.iter().flat_map(|table| &table.axes).filter(|axis| axis.matters);
        outputs.extend(along.map(|axis| Output::ConductanceSlope(axis.along)));
    }
    plan_flows(planner, &mut plan, outputs, left_out);
    Some(plan)
}

/// Plans the law with the conductance of a user's routine, which replaces all tables (K-08).
fn plan_with_user(
    planner: Planner<'_>,
    user: UserPlan,
    outputs: &mut BTreeSet<Output>,
    left_out: &mut LeftOuts,
) -> ElectricalPlan {
    let mut plan = ElectricalPlan {
        regime: regime(planner.model, planner.choices.regime, Procedure::solves_electrical),
        tables: Vec::new(),
        user: Some(user),
        heat: heat(planner, left_out),
        variables: Vec::new(),
        jump: None,
        area: None,
        history: History::None,
    };
    outputs.insert(Output::Conductance);
    if planner.choices.derivatives == Derivatives::Given {
        outputs.insert(Output::ConductanceSlope(Along::Temperature));
    }
    plan_flows(planner, &mut plan, outputs, left_out);
    plan
}

/// The sources of the variables of the tables in use, or the missing columns.
fn sources(planner: Planner<'_>, used: &[(Along, &PiecewiseTable)]) -> Result<Vec<Option<Source<Column>>>, Missing> {
    let presence = |column| planner.presence(column);
    let contact = planner.contact();
    if contact.clearance.is_none() && contact.pressure.is_none() && contact.closed.is_none() {
        return Err(crate::plan::source::cell(Column::Clearance, presence).expect_err("it has no numbers"));
    }
    for (against, table) in used {
        planner.check_abscissa(*against, table)?;
    }
    let count = used.iter().map(|(_, table)| table.axis_count()).max().unwrap_or(1);
    let sources = (1..count).map(|axis| {
        let is_needed = used.iter().any(|(_, table)| matters(table, axis));
        let columns = columns_of(electrical_axis(Along::Clearance, axis)).filter(|_| is_needed);
        columns.map(|columns| whole_or_sides(columns, presence)).transpose()
    });
    sources.collect()
}

/// Shares of the heat; `None` where it is switched off (K-05).
fn heat(planner: Planner<'_>, left_out: &mut LeftOuts) -> Option<HeatGeneration> {
    let heat = planner.heat_generation();
    if heat.is_none() {
        left_out.push("heat generation", Reason::HeatSwitchedOff);
    }
    heat
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
    let wanted = |of: &[Output]| -> Vec<Output> {
        of.iter().copied().filter(|output| heat || matches!(output, Ecd | Ecda | Ecdt | Ecdta)).collect()
    };
    outputs.extend(wanted(&[Weight]));
    let potentials = [Part::Both, Part::Slave, Part::Master].map(Column::Potential);
    match whole_or_sides(potentials, |column| planner.presence(column)) {
        Ok(source) => plan.jump = Some(source),
        Err(missing) => {
            let all = [Ecd, Ecda, Ecdt, Ecdta, Sjd, Sjda, Sjdt, Sjdta, HeatSlave, HeatMaster];
            left_out.push_outputs(&wanted(&all), Reason::Missing(missing));
            return;
        }
    }
    outputs.extend(wanted(&[Ecd, Sjd, HeatSlave, HeatMaster]));
    let area = planner.area();
    match &area {
        Ok(column) => {
            plan.area = Some(*column);
            outputs.extend(wanted(&[Ecda, Sjda]));
        }
        Err(missing) => {
            left_out.push_outputs(&wanted(&[Ecda, Ecdta, Sjda, Sjdta]), Reason::Missing(missing.clone()));
        }
    }
    match planner.history() {
        Ok(()) => {
            plan.history = History::ByTime;
            outputs.extend(wanted(&[Ecdt, Sjdt]));
            if area.is_ok() {
                outputs.extend(wanted(&[Ecdta, Sjdta]));
            }
        }
        Err(missing) => {
            let without_area = [Ecdt, Sjdt];
            let with_area = [Ecdt, Ecdta, Sjdt, Sjdta];
            let lost: &[Output] = if area.is_ok() { &with_area } else { &without_area };
            left_out.push_outputs(&wanted(lost), Reason::Missing(missing));
        }
    }
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
    for (against, table) in tables.electrical() {
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
