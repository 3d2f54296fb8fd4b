//! Makes the plan from a deck's model, a survey of a node table and the user's choices.

use super::choices::Choices;
use super::columns::column_plans;
use super::governing::GovernedBy;
use super::planner::{LeftOuts, Planner};
use super::reason::Reason;
use super::requested::keep_requested;
use super::survey::key_columns;
use super::surveyed::Survey;
use super::tables::{BuiltTables, InteractionTables};
use super::{InteractionPlan, Plan};
use crate::law::electrical::plan::{LAW as ELECTRICAL_LAW, plan_electrical};
use crate::law::pore::plan::{LAW as PORE_LAW, plan_pore};
use crate::law::thermal::plan::plan_thermal;
use crate::law::thermal::tables::ThermalTables;
use crate::nodes::{Column, Selection};
use crate::results::Output;
use inpact_parser::model::Model;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Makes the plan of an evaluation.
pub fn make(model: &Model, survey: &Survey, choices: &Choices) -> Plan {
    let mut interactions = Vec::new();
    let mut unused = Vec::new();
    for (index, interaction) in model.interactions.values().enumerate() {
        let of = &survey.interactions[index];
        // Only the columns of a table without rows are known.
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

/// Gives the status of each law a column where some interaction has more than one law, or where it is requested.
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

impl Planner<'_> {
    /// Plans all laws of the interaction.
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
        let electrical = left_out.planned(ELECTRICAL_LAW, electrical);
        let thermal = plan_thermal(self, &built.thermal, electrical.as_ref(), &mut outputs, &mut left_out, &mut notes);
        let pore = plan_pore(self, tables, &mut outputs, &mut left_out, &mut notes);
        let pore = left_out.planned(PORE_LAW, pore);
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
