//! From a deck's model, a survey of a node table and the user's choices to the plan.

use super::choices::{Choices, Derivatives};
use super::columns::column_plans;
use super::governing::GovernedBy;
use super::reason::{LeftOut, Missing, Reason};
use super::requested::keep_requested;
use super::source::{Presence, cell};
use super::survey::{InteractionSurvey, Survey, key_columns};
use super::tables::{BuiltTables, InteractionTables, matters};
use super::{ContactColumns, InteractionPlan, Plan};
use crate::law::electrical::plan::plan_electrical;
use crate::law::heat::HeatGeneration;
use crate::law::pore::plan::plan_pore;
use crate::law::thermal::plan::plan_thermal;
use crate::law::thermal::tables::ThermalTables;
use crate::nodes::{Column, Selection};
use crate::results::{Along, Output};
use crate::table::PiecewiseTable;
use inpact_parser::model::{Interaction, Model};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Decides what an evaluation does.
pub fn make(model: &Model, survey: &Survey, choices: &Choices) -> Plan {
    let mut interactions = Vec::new();
    let mut unused = Vec::new();
    for (index, interaction) in model.interactions.values().enumerate() {
        let of = &survey.interactions[index];
        // Of a table without rows nothing can be told but its columns.
        let is_candidate = match survey.governed_by {
            GovernedBy::Chosen(chosen) | GovernedBy::TheOnlyOne(chosen) => chosen == index,
            GovernedBy::Column => survey.rows == 0,
        };
        if of.rows > 0 || is_candidate {
            let planner = Planner { model, interaction, index, of, survey, choices };
            interactions.push(planner.plan());
        } else {
            unused.push(interaction.name.clone());
        }
    }
    give_status_by_law(&mut interactions, choices);
    for plan in &mut interactions {
        keep_requested(plan, choices);
    }
    let outputs: BTreeSet<Output> = interactions.iter().flat_map(|plan| plan.outputs.iter().copied()).collect();
    let selection = selection(survey, &interactions);
    Plan {
        rows: survey.rows,
        governed_by: survey.governed_by,
        order: survey.order,
        columns: column_plans(survey, choices, &selection, &interactions),
        interactions,
        unused,
        selection,
        outputs: outputs.into_iter().collect(),
    }
}

/// Gives the status of each law a column where some interaction has more than one law, or where it is asked for.
fn give_status_by_law(interactions: &mut [InteractionPlan], choices: &Choices) {
    let laws = |plan: &InteractionPlan| {
        let laws = [
            (plan.electrical.is_some(), Output::ElectricalStatus),
            (plan.thermal.is_some(), Output::ThermalStatus),
            (plan.pore.is_some(), Output::PoreStatus),
        ];
        laws.into_iter().filter(|(is_there, _)| *is_there).map(|(_, output)| output).collect::<Vec<_>>()
    };
    let are_several = interactions.iter().any(|plan| laws(plan).len() > 1);
    let is_named = |output: &Output| choices.outputs.as_ref().is_some_and(|requested| requested.contains(output));
    for plan in interactions {
        let given = laws(plan).into_iter().filter(|output| are_several || is_named(output));
        let with_status = plan.outputs.iter().copied().chain(given).collect::<BTreeSet<Output>>();
        plan.outputs = with_status.into_iter().collect();
    }
}

/// Sources of the plan of one interaction.
#[derive(Clone, Copy)]
pub(crate) struct Planner<'a> {
    pub(crate) model: &'a Model,
    pub(crate) interaction: &'a Interaction,
    pub(crate) index: usize,
    pub(crate) of: &'a InteractionSurvey,
    pub(crate) survey: &'a Survey,
    pub(crate) choices: &'a Choices,
}

/// Parts left out while a law is planned, by reason.
#[derive(Debug, Default)]
pub(crate) struct LeftOuts(pub(crate) Vec<LeftOut>);

impl LeftOuts {
    /// Leaves something out that has words of its own.
    pub(crate) fn push(&mut self, what: impl Into<String>, reason: Reason) {
        self.0.push(LeftOut { what: what.into(), outputs: Vec::new(), reason });
    }

    /// Leaves outputs out; those left out for one reason stand together.
    pub(crate) fn push_outputs(&mut self, outputs: &[Output], reason: Reason) {
        let names: Vec<String> = outputs.iter().map(|output| format!("`{output}`")).collect();
        self.0.push(LeftOut { what: names.join(", "), outputs: outputs.to_vec(), reason });
    }
}

impl Planner<'_> {
    fn plan(self) -> InteractionPlan {
        let built = BuiltTables {
            flow: InteractionTables::of(self.interaction, self.choices.clearance_tail),
            thermal: ThermalTables::of(self.model, self.interaction, self.choices.dialect),
        };
        let tables = &built.flow;
        let mut left_out = LeftOuts::default();
        let mut notes = Vec::new();
        let mut outputs = BTreeSet::new();
        let mut dropped = Vec::new();
        let electrical = plan_electrical(self, tables, &mut outputs, &mut left_out, &mut notes, &mut dropped);
        let thermal = plan_thermal(self, &built.thermal, electrical.as_ref(), &mut outputs, &mut left_out, &mut notes);
        let pore = plan_pore(self, tables, &mut outputs, &mut left_out, &mut notes);
        if !outputs.is_empty() {
            outputs.insert(Output::Status);
        }
        for option in &self.interaction.other {
            if matches!(&*option.keyword, "GAP DIFFUSIVITY" | "GAP CONVECTION") {
                let what = format!("*{}", option.keyword);
                if !left_out.0.iter().any(|left_out| left_out.what == what) {
                    left_out.push(what, Reason::NotEvaluated);
                }
            }
        }
        let undetermined = self.of.rows - self.of.closed - self.of.open;
        if undetermined > 0 && (electrical.is_some() || thermal.is_some() || pore.is_some()) {
            let rows = if undetermined == 1 { "1 row".to_owned() } else { format!("{undetermined} rows") };
            notes.push(format!(
                "{rows} from which contact cannot be told: `closed` empty, and `clearance` too or one of them NaN"
            ));
        }
        let mut plan = InteractionPlan {
            name: self.interaction.name.clone(),
            index: self.index,
            rows: self.of.rows,
            closed: self.of.closed,
            open: self.of.open,
            histories: None,
            contact: self.contact(),
            electrical: electrical.map(Box::new),
            thermal: thermal.map(Box::new),
            pore: pore.map(Box::new),
            tables: Arc::new(built),
            outputs: outputs.into_iter().collect(),
            left_out: left_out.0,
            dropped,
            notes,
        };
        plan.histories = self.of.histories.filter(|_| plan.has_history());
        plan
    }

    /// Whether tables may be folded: slopes along every axis are those of the whole table, and a folded table is rounded once more than the reference allows.
    pub(crate) fn may_fold(self, is_slope: impl Fn(&Output) -> bool) -> bool {
        if !self.choices.accuracy.allows_folding() {
            return false;
        }
        let requested = self.choices.outputs.as_ref();
        self.choices.derivatives == Derivatives::LeftOut
            || requested.is_some_and(|requested| !requested.iter().any(is_slope))
    }

    pub(crate) fn presence(self, column: Column) -> Presence {
        self.survey.presence(self.index, column)
    }

    /// Whether a column has numbers in the rows of the interaction, or may have: one that no law could use was not read.
    pub(crate) fn may_have(self, column: Column) -> bool {
        let was_read = self.survey.columns.contains(&column);
        if was_read { self.presence(column).has_numbers() } else { self.survey.header.has(column) }
    }

    /// The columns that tell contact, as far as they have numbers.
    pub(crate) fn contact(self) -> ContactColumns {
        let found = |column| Some(column).filter(|column| self.presence(*column).has_numbers());
        ContactColumns {
            clearance: found(Column::Clearance),
            pressure: found(Column::Pressure),
            closed: found(Column::Closed),
            state: None,
        }
    }

    /// `area`.
    pub(crate) fn area(self) -> Result<Column, Missing> {
        cell(Column::Area, |column| self.presence(column))
    }

    /// Whether the rows of a node are a history: `node` and `time` are there.
    pub(crate) fn history(self) -> Result<(), Missing> {
        let header = &self.survey.header;
        let columns: Vec<Column> =
            [Column::Node, Column::Time].into_iter().filter(|column| !header.has(*column)).collect();
        if !columns.is_empty() {
            return Err(Missing::absent(columns));
        }
        cell(Column::Time, |column| self.presence(column)).map(drop)
    }

    /// Refuses a table whose first variable some row needs and none has: a closed row needs no clearance.
    pub(crate) fn check_abscissa(self, against: Along, table: &PiecewiseTable) -> Result<(), Missing> {
        let is_clearance = against == Along::Clearance;
        if !matters(table, 0) || (is_clearance && self.never(self.of.open)) {
            return Ok(());
        }
        let column = if is_clearance { Column::Clearance } else { Column::Pressure };
        cell(column, |column| self.presence(column)).map(drop)
    }

    /// Why no row reads the table against clearance or pressure, one of `count` tables of a conductance.
    pub(crate) fn unreached(self, against: Along, count: usize) -> Option<Reason> {
        match against {
            Along::Pressure if self.never(self.of.closed) => Some(Reason::NoRowClosed),
            // The table against clearance holds for closed rows too when it is the only one (section 4.2).
            Along::Clearance if count == 2 && self.never(self.of.open) => Some(Reason::NoRowOpen),
            _ => None,
        }
    }

    /// Conversion of dissipated energy into heat; `None` where it is switched off (K-05).
    pub(crate) fn heat_generation(self) -> Option<HeatGeneration> {
        generation_of(self.interaction)
    }

    /// Whether no row is closed, or none open; unknown for a table without rows.
    pub(crate) fn never(self, count: u64) -> bool {
        self.survey.rows > 0 && count == 0 && self.of.closed + self.of.open == self.of.rows
    }
}

/// Conversion of the energy dissipated in an interaction into heat; `None` where a user subroutine switches that off (K-05).
pub(crate) fn generation_of(interaction: &Interaction) -> Option<HeatGeneration> {
    if interaction.has_parameter("USER") {
        return None;
    }
    let given = interaction.gap_heat_generation.as_ref();
    Some(given.map_or_else(HeatGeneration::default, |given| HeatGeneration {
        fraction: given.fraction,
        slave_weight: given.slave_weight,
    }))
}

/// The columns an evaluation reads: the texts of the result's key columns, the numbers that some law needs.
fn selection(survey: &Survey, interactions: &[InteractionPlan]) -> Selection {
    let mut wanted: BTreeSet<Column> = BTreeSet::new();
    for plan in interactions {
        wanted.extend(plan.columns_read());
    }
    Selection {
        labels: key_columns(&survey.header),
        numbers: survey.columns.iter().copied().filter(|column| wanted.contains(column)).collect(),
    }
}
