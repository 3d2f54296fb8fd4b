//! A plan of outputs that are requested by name: laws, histories and columns that serve no other output are dropped.

use super::choices::Choices;
use super::cost::KEEP_HISTORY;
use super::dropped::Dropped;
use super::outline::cost_of;
use super::output_groups::{
    ELECTRICAL_FLOWS, ELECTRICAL_HEAT, OF_AREA, OF_FRICTION, OF_TIME, SUMS_OF_HEAT, is_of_electrical, is_of_pore,
    is_of_thermal,
};
use super::reason::{LeftOut, Reason};
use super::{
    ContactColumns, CurrentHeat, ElectricalPlan, History, InteractionPlan, Plan, PorePlan, Rate, TablePlan, ThermalPlan,
};
use crate::law::contact::ContactState;
use crate::law::electrical::plan::LAW as ELECTRICAL_LAW;
use crate::law::pore::plan::LAW as PORE_LAW;
use crate::law::thermal::plan::LAW as THERMAL_LAW;
use crate::nodes::{Findings, MISSING_COLUMN, Place};
use crate::results::{Along, Output};
use inpact_parser::model::Regime;

/// Drops the parts of the plan of an interaction that no requested output needs.
pub(crate) fn keep_requested(plan: &mut InteractionPlan, choices: &Choices) {
    if let Some(requested) = &choices.outputs {
        let dropped: Vec<Output> = plan.outputs.iter().copied().filter(|output| !requested.contains(output)).collect();
        plan.outputs.retain(|output| requested.contains(output));
        // Parts left out for another reason and not requested need no report.
        plan.left_out
            .retain(|left| left.outputs.is_empty() || left.outputs.iter().any(|output| requested.contains(output)));
        let has_status = plan.outputs.contains(&Output::Status);
        let has = |wanted: &[Output]| plan.outputs.iter().any(|output| wanted.contains(output));
        let needs_current = has(&SUMS_OF_HEAT) && plan.generates_by_current();
        let needs_thermal = plan.outputs.iter().any(is_of_thermal) || has(&OF_FRICTION);
        if plan.electrical.is_some() && !has_status && !needs_current && !plan.outputs.iter().any(is_of_electrical) {
            let cost = plan.electrical.iter().flat_map(|law| &law.tables).map(TablePlan::whole_cost).sum();
            plan.electrical = None;
            drop_law(plan, ELECTRICAL_LAW, cost);
        }
        if plan.thermal.is_some() && !has_status && !needs_thermal {
            let conduction = plan.thermal.iter().flat_map(|law| &law.conduction);
            let cost = conduction.flat_map(|part| &part.tables).map(TablePlan::whole_cost).sum();
            plan.thermal = None;
            drop_law(plan, THERMAL_LAW, cost);
        }
        if plan.pore.is_some() && !has_status && !plan.outputs.iter().any(is_of_pore) {
            let cost = plan.pore.iter().flat_map(|law| &law.table).map(TablePlan::whole_cost).sum();
            plan.pore = None;
            drop_law(plan, PORE_LAW, cost);
        }
        let names: Vec<String> = dropped.iter().map(|output| format!("`{output}`")).collect();
        if !names.is_empty() {
            plan.dropped.push(Dropped::not_requested(&names.join(", "), cost_of(&dropped)));
            plan.left_out.push(LeftOut { what: names.join(", "), outputs: dropped, reason: Reason::NotRequested });
        }
    }
    let outputs = plan.outputs.clone();
    let has = |wanted: &[Output]| outputs.iter().any(|output| wanted.contains(output));
    let needs_current = has(&SUMS_OF_HEAT) && plan.generates_by_current();
    if let Some(law) = &mut plan.electrical {
        drop_from_electrical(law, needs_current, has);
    }
    if let Some(law) = &mut plan.thermal {
        drop_from_thermal(law, &outputs);
    }
    if let Some(law) = &mut plan.pore {
        drop_from_pore(law, has);
    }
    if !plan.has_history() && plan.histories.take().is_some() {
        plan.dropped.push(Dropped::not_requested("histories", KEEP_HISTORY));
    }
    drop_contact_columns(plan);
}

impl InteractionPlan {
    /// Whether a current generates heat that the sum of all heat needs.
    fn generates_by_current(&self) -> bool {
        self.thermal.as_ref().is_some_and(|law| law.current == CurrentHeat::Generated)
    }

    /// Whether some law keeps a history of each node.
    pub(crate) fn has_history(&self) -> bool {
        let electrical = self.electrical.as_ref().map(|law| law.history);
        let thermal = self.thermal.as_ref().map(|law| law.history);
        let pore = self.pore.as_ref().map(|law| law.history);
        [electrical, thermal, pore].contains(&Some(History::ByTime))
    }
}

/// Drops what no output needs; the sum of all heat may need the heat of the current.
fn drop_from_electrical(law: &mut ElectricalPlan, needs_current: bool, has: impl Fn(&[Output]) -> bool) {
    if !has(&ELECTRICAL_FLOWS) && !needs_current {
        law.jump = None;
    }
    if !has(&OF_AREA) {
        law.area = None;
    }
    // The heat of a transient increment depends on the jump before it (H-08).
    let needs_start = law.regime.regime == Regime::Transient && (has(&ELECTRICAL_HEAT) || needs_current);
    if !has(&OF_TIME) && !needs_start {
        law.history = History::None;
    }
}

fn drop_from_thermal(law: &mut ThermalPlan, outputs: &[Output]) {
    let has = |wanted: &[Output]| outputs.iter().any(|output| wanted.contains(output));
    let has_slope = outputs.iter().any(|output| matches!(output, Output::ThermalConductanceSlope(_)));
    let has_sum = has(&SUMS_OF_HEAT);
    if !has(&OF_AREA) {
        law.area = None;
    }
    if !has(&OF_TIME) {
        law.history = History::None;
    }
    if !has_sum {
        law.current = CurrentHeat::None;
    }
    // The status of a row says where it lies outside any table.
    if has(&[Output::Status, Output::ThermalStatus]) {
        return;
    }
    if !has_sum && !has(&[Output::ThermalConductance, Output::HeatConduction]) && !has_slope {
        law.conduction = None;
    }
    if !has_sum && !has(&[Output::HeatConduction, Output::HeatRadiation]) {
        law.temperatures = None;
        law.jump = None;
    }
    if !has_sum && !has(&[Output::HeatRadiation]) {
        law.radiation = None;
    }
    if !has_sum && !has(&OF_FRICTION) {
        law.friction = None;
    }
}

/// Records that no requested output needs a law.
fn drop_law(plan: &mut InteractionPlan, law: &str, cost: f64) {
    plan.dropped.push(Dropped::not_requested(law, cost));
    plan.left_out.push(LeftOut::law(law, Reason::NotRequested));
}

fn drop_from_pore(law: &mut PorePlan, has: impl Fn(&[Output]) -> bool) {
    if !has(&OF_AREA) {
        law.area = None;
    }
    // A cell without a rate takes it from the history.
    let needs_rate = matches!(law.rate, Rate::History | Rate::Column);
    if !has(&OF_TIME) && !needs_rate {
        law.history = History::None;
    }
}

/// Contact that is the same in every row needs no column; then only the tables need clearance or pressure.
fn drop_contact_columns(plan: &mut InteractionPlan) {
    if plan.rows == 0 || plan.pore.is_some() || (plan.electrical.is_none() && plan.thermal.is_none()) {
        return;
    }
    let state = if plan.closed == plan.rows {
        ContactState::Closed
    } else if plan.open == plan.rows {
        ContactState::Open
    } else {
        return;
    };
    let conduction = plan.thermal.iter().filter_map(|law| law.conduction.as_ref()).flat_map(|law| &law.tables);
    let radiation = plan.thermal.iter().filter_map(|law| Some(&law.radiation.as_ref()?.table));
    let radiation = radiation.filter(|_| state == ContactState::Open);
    let tables = plan.electrical.iter().flat_map(|law| &law.tables).chain(conduction).chain(radiation);
    let needs = |along: Along| tables.clone().any(|table| table.against == along && table.axes[0].is_read());
    plan.contact = ContactColumns {
        clearance: plan.contact.clearance.filter(|_| needs(Along::Clearance)),
        pressure: plan.contact.pressure.filter(|_| needs(Along::Pressure)),
        closed: None,
        state: Some(state),
    };
}

impl Plan {
    /// Reports each output that is requested by name and that no interaction gives (D001).
    pub fn report_unavailable(&self, choices: &Choices, findings: &mut Findings) {
        for output in choices.outputs.iter().flatten().filter(|output| !self.outputs.contains(output)) {
            let left_out = || self.interactions.iter().flat_map(|interaction| &interaction.left_out);
            let by_name = left_out().find(|left| left.outputs.contains(output));
            let by_law = || {
                let laws: &[&str] = match output {
                    output if is_of_pore(output) => &[PORE_LAW],
                    output if is_of_thermal(output) => &["heat conduction", "heat radiation", "heat of friction"],
                    _ => &[ELECTRICAL_LAW],
                };
                left_out().find(|left| laws.contains(&left.what.as_str()))
            };
            let message = match by_name.or_else(by_law) {
                Some(left) => format!("`{output}` is asked for and cannot be given: {}", left.reason),
                None => format!("`{output}` is asked for, and no law of the deck gives it on these rows"),
            };
            let help = "`inpact plan` without `--outputs` lists what there is, and what is missing for the rest";
            findings.report(&MISSING_COLUMN, Place::default(), message, help);
        }
    }
}
