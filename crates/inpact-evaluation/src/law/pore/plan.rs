//! The plan of the pore fluid law of one interaction.

use crate::law::pore::Cutoffs;
use crate::nodes::{Column, Part};
use crate::plan::folding::{fold_and_choose, still_read, table_plan};
use crate::plan::law_columns::{want_of_any_law, want_variables};
use crate::plan::planner::{LeftOuts, Planner};
use crate::plan::reason::{Missing, Reason};
use crate::plan::regime::regime;
use crate::plan::source::Source;
use crate::plan::tables::{InteractionTables, matters, pore_axis};
use crate::plan::{Choices, Derivatives, History, RegimeInForce, TablePlan};
use crate::results::{Along, Output};
use crate::table::PiecewiseTable;
use inpact_parser::model::{Interaction, Model, Procedure, Regime};
use std::collections::BTreeSet;

/// The plan of the pore fluid law of an interaction.
#[derive(Debug, Clone, PartialEq)]
pub struct PorePlan {
    /// Steady state or transient, and why.
    pub regime: RegimeInForce,
    /// The table of permeabilities; `None` for an infinite permeability.
    pub table: Option<TablePlan>,
    /// The cutoffs of the deck.
    pub cutoffs: Cutoffs,
    /// Pore pressures of slave and master, where they have numbers.
    pub pressures: Option<[Column; 2]>,
    /// Sources of average temperature and field variables, in the order of the table's columns; `None` where it does not depend on one.
    pub variables: Vec<Option<Source<Column>>>,
    /// `por_jump`, where it has numbers: it is used instead of the difference of the pore pressures.
    pub jump: Option<Column>,
    /// `q_across`, where it has numbers and the permeability is infinite: the flow from a solution of the equations in which it is an unknown.
    pub across: Option<Column>,
    /// The source of the characteristic element length.
    pub characteristic_length: CharacteristicLength,
    /// Where the rate of the clearance comes from.
    pub rate: Rate,
    /// Whether `perm_s` and `perm_m` share the fluid of the gap between the sides.
    pub bulk: Bulk,
    /// `area`, where the results need it and it has numbers.
    pub area: Option<Column>,
    /// Whether the rows of a node are a history.
    pub history: History,
}

/// Where the characteristic element length comes from (P-20, Q-5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CharacteristicLength {
    /// The deck gives both cutoffs, or it is not needed.
    NotNeeded,
    /// `char_length`.
    Column,
    /// One number for all rows.
    Given(f64),
    /// None: open rows have no result that depends on it.
    Unknown,
}

/// Where the rate of the clearance comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rate {
    /// Steady state: the gap does not change (P-13).
    NotNeeded,
    /// `clearance_rate`, and the history where a cell is empty.
    Column,
    /// The node's history alone.
    History,
    /// None: the gap is taken as constant.
    Unknown,
}

/// Whether bulk permeabilities share the fluid of the gap between the sides (P-42).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bulk {
    /// They do, where a row has both.
    Columns,
    /// Either side takes half.
    Halves,
}

/// The name of the law where it is left out.
pub(crate) const LAW: &str = "pore fluid law";

impl Cutoffs {
    /// The cutoffs that an interaction gives.
    pub(crate) fn of(interaction: &Interaction) -> Self {
        interaction.contact_permeability.as_ref().map_or_else(Self::default, |option| Self {
            flow_across: option.cutoff_flow_across,
            gap_fill: option.cutoff_gap_fill,
        })
    }
}

/// Plans the pore fluid law; an error says why a deck or node table that tells of it has none.
pub(crate) fn plan_pore(
    planner: Planner<'_>,
    tables: &InteractionTables,
    outputs: &mut BTreeSet<Output>,
    left_out: &mut LeftOuts,
    notes: &mut Vec<String>,
) -> Result<Option<PorePlan>, Reason> {
    let option = planner.interaction.contact_permeability.as_ref();
    let sides = [Part::Slave, Part::Master].map(Column::PorePressure);
    if option.is_none() && !planner.model.procedures.iter().any(Procedure::solves_pore_pressure) {
        let has_sides = sides.into_iter().all(|column| planner.may_have(column));
        return if has_sides { Err(Reason::NoPoreAnalysis) } else { Ok(None) };
    }
    let jump = planner.cell(Column::PorePressure(Part::Both)).ok();
    let pressures = planner.all_of(sides);
    let has_sides = pressures.is_ok();
    // The table may depend on their mean; the flow across needs only their difference.
    let needs_sides = jump.is_none() || tables.permeability().is_some_and(|table| matters(table, 1));
    if let Err(missing) = pressures
        && needs_sides
    {
        return Err(match missing.columns[..] {
            [missing] => Reason::OneSided { missing },
            _ if jump.is_none() => missing.or(Column::PorePressure(Part::Both)).into(),
            _ => missing.into(),
        });
    }
    if let Some(error) = tables.permeability_error() {
        return Err(Reason::BrokenTable(error));
    }
    let table = tables.permeability();
    let variables = sources(planner, table)?;
    let cutoffs = Cutoffs::of(planner.interaction);
    let regime = regime(planner.model, planner.choices.regime, Procedure::solves_pore_pressure);
    let is_transient = regime.regime == Regime::Transient;
    let mut table_plan = table.map(|table| table_plan(table, pore_axis));
    let may_fold = planner.may_fold(|output| matches!(output, Output::PermeabilitySlope(_)));
    if let (Some(table), Some(plan)) = (table, &mut table_plan) {
        fold_and_choose(planner, table, plan, |along| match along {
            _ if !may_fold => None,
            Along::Pressure => planner.constant_permeability_pressure(),
            Along::PorePressure => planner.constant_pore_pressure(),
            Along::Temperature => planner.constant_of((*variables.first()?)?),
            Along::FieldVariable(number) => planner.constant_of((*variables.get(number as usize)?)?),
            Along::Clearance | Along::MassFlow => None,
        });
    }
    let variables = still_read(variables, table_plan.as_slice(), 2);
    let mut plan = PorePlan {
        table: table_plan,
        cutoffs,
        variables,
        pressures: has_sides.then_some(sides),
        jump: jump.filter(|_| table.is_some() || !has_sides),
        across: planner.cell(Column::FlowAcross).ok().filter(|_| table.is_none()),
        characteristic_length: characteristic_length(planner, cutoffs, is_transient),
        rate: if is_transient { rate(planner) } else { Rate::NotNeeded },
        bulk: bulk(planner, table.is_some() && is_transient),
        area: None,
        history: History::None,
        regime,
    };
    plan_flows(planner, &mut plan, outputs, left_out);
    add_notes(planner, &plan, notes);
    Ok(Some(plan))
}

/// The sources of the variables of the table, or the missing columns.
fn sources(planner: Planner<'_>, table: Option<&PiecewiseTable>) -> Result<Vec<Option<Source<Column>>>, Missing> {
    planner.cell(Column::Clearance)?;
    let Some(table) = table else { return Ok(Vec::new()) };
    // While open the table is read at zero pressure (P-34).
    if matters(table, 0) && !planner.never(planner.of.closed) {
        planner.cell(Column::Pressure)?;
    }
    planner.sources(&[table], 2, pore_axis)
}

fn characteristic_length(planner: Planner<'_>, cutoffs: Cutoffs, is_transient: bool) -> CharacteristicLength {
    let is_needed = cutoffs.flow_across.is_none() || (cutoffs.gap_fill.is_none() && is_transient);
    match planner.choices.characteristic_length {
        _ if !is_needed => CharacteristicLength::NotNeeded,
        Some(length) => CharacteristicLength::Given(length),
        None if planner.presence(Column::CharacteristicLength).has_numbers() => CharacteristicLength::Column,
        None => CharacteristicLength::Unknown,
    }
}

fn rate(planner: Planner<'_>) -> Rate {
    if planner.presence(Column::ClearanceRate).has_numbers() {
        Rate::Column
    } else if planner.history().is_ok() {
        Rate::History
    } else {
        Rate::Unknown
    }
}

fn bulk(planner: Planner<'_>, is_of_use: bool) -> Bulk {
    let sides = [Part::Slave, Part::Master].map(Column::BulkPermeability);
    if is_of_use && planner.all_of(sides).is_ok() { Bulk::Columns } else { Bulk::Halves }
}

/// Plans the flows, their integrals and their products with the area.
fn plan_flows(planner: Planner<'_>, plan: &mut PorePlan, outputs: &mut BTreeSet<Output>, left_out: &mut LeftOuts) {
    use Output::{Permeability, Pfl, Pfla, Ptl, Ptla, QAcross, QGapMaster, QGapSlave, QMaster, QSlave};
    outputs.extend([QAcross, QGapSlave, QGapMaster, QSlave, QMaster]);
    match &plan.table {
        Some(table) => {
            outputs.insert(Permeability);
            if planner.choices.derivatives == Derivatives::Given {
                let along = table.axes.iter().filter(|axis| axis.matters);
                outputs.extend(along.map(|axis| Output::PermeabilitySlope(axis.along)));
            }
        }
        None => left_out.push_outputs(&[Permeability], Reason::InfinitePermeability),
    }
    (plan.area, plan.history) = planner.flows(&[[Pfl, Pfla, Ptl, Ptla]], outputs, left_out);
}

fn add_notes(planner: Planner<'_>, plan: &PorePlan, notes: &mut Vec<String>) {
    if plan.characteristic_length == CharacteristicLength::Unknown && planner.of.above_zero > 0 {
        let rows = planner.of.above_zero;
        let rows = if rows == 1 { "1 row".to_owned() } else { format!("{rows} rows") };
        notes.push(format!(
            "{rows} with a clearance above zero may lack results: a cutoff is left to the characteristic element \
             length; give `char_length` or `--char-length`"
        ));
    }
    if plan.rate == Rate::Unknown {
        notes.push(
            "the gap is taken as unchanging: there is no `clearance_rate`, and without `node` and `time` no history"
                .to_owned(),
        );
    }
}

/// The columns that the pore fluid law could use.
pub(crate) fn want_pore(
    model: &Model,
    interaction: &Interaction,
    tables: &InteractionTables,
    choices: &Choices,
    wanted: &mut BTreeSet<Column>,
) {
    let option = interaction.contact_permeability.as_ref();
    if option.is_none() && !model.procedures.iter().any(Procedure::solves_pore_pressure) {
        return;
    }
    want_of_any_law(choices, wanted);
    wanted.extend([Part::Slave, Part::Master, Part::Both].map(Column::PorePressure));
    wanted.insert(Column::FlowAcross);
    if let Some(table) = tables.permeability() {
        want_variables(table, pore_axis, wanted);
    }
    let cutoffs = option.map(|option| (option.cutoff_flow_across, option.cutoff_gap_fill));
    if !matches!(cutoffs, Some((Some(_), Some(_)))) && choices.characteristic_length.is_none() {
        wanted.insert(Column::CharacteristicLength);
    }
    if regime(model, choices.regime, Procedure::solves_pore_pressure).regime == Regime::Transient {
        wanted.insert(Column::ClearanceRate);
        wanted.extend([Part::Slave, Part::Master].map(Column::BulkPermeability));
    }
}
