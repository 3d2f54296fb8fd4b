//! Summary of a solution: fields, methods and balances.

use crate::text::counted;
use inpact_network::linear::{LinearReport, Method, Ordering, Quality};
use inpact_network::scene::Field;
use inpact_network::transient::TransientReport;
use inpact_network::{FieldBalance, Problem, StageReport, State};
use serde_json::{Map, Value, json};
use std::time::Duration;

/// A solution, and what it took.
pub(super) struct Summary<'a> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) state: &'a State,
    pub(super) report: &'a TransientReport,
    pub(super) name: &'a str,
    pub(super) time: Duration,
}

impl Summary<'_> {
    /// Lines for a person.
    pub(super) fn text(&self) -> Vec<String> {
        let scene = self.problem.scene();
        let (nodes, links, interfaces) = (scene.nodes.len(), scene.links.len(), scene.interfaces.len());
        let mut lines = vec![format!(
            "{}: {}, {}, {}, {:.3} s",
            self.name,
            counted(nodes, "node"),
            counted(links, "link"),
            counted(interfaces, "interface"),
            self.time.as_secs_f64()
        )];
        if scene.is_transient() {
            let TransientReport { increments, taken_back, local_error, passed_over, integral_error } = self.report;
            lines.push(format!(
                "  {}, {taken_back} taken back, largest estimated local error {local_error:.1e} of the range",
                counted(*increments, "increment")
            ));
            if let Some(error) = integral_error {
                lines.push(format!("  time integrals of interfaces: estimated error {error:.1e} of their size"));
            }
            if *passed_over > 0 {
                lines.push(format!(
                    "  {} of time courses inside increments, passed over: a shorter `step` would tell, or `tolerance`",
                    counted(*passed_over, "point")
                ));
            }
        }
        for stage in &self.state.reports {
            lines.extend(stage_lines(stage));
        }
        for field in self.problem.solved_fields() {
            if let Some(balance) = self.state.balance(self.problem, field) {
                lines.push(balance_line(field, &balance, scene.is_transient()));
            }
        }
        lines.extend(self.problem.left_out.iter().map(|left_out| format!("  left out: {left_out}")));
        lines
    }

    /// The same for another program.
    pub(super) fn json(&self) -> Value {
        let scene = self.problem.scene();
        let stages = self.state.reports.iter().map(|stage| {
            let fields = stage.fields.iter().zip(&stage.linear).map(|(field, linear)| linear_json(*field, linear));
            json!({
                "newton_steps": stage.iterations,
                "inconsistency": stage.inconsistency,
                "fields": fields.collect::<Vec<Value>>(),
            })
        });
        json!({
            "scene": self.name,
            "nodes": scene.nodes.len(),
            "links": scene.links.len(),
            "interfaces": scene.interfaces.len(),
            "increments": self.report.increments,
            "increments_taken_back": self.report.taken_back,
            "local_error": self.report.local_error,
            "integral_error": self.report.integral_error,
            "points_passed_over": self.report.passed_over,
            "stages": stages.collect::<Vec<Value>>(),
            "balance": balances(self.problem, self.state),
            "left_out": self.problem.left_out,
            "seconds": self.time.as_secs_f64(),
        })
    }
}

/// The relative error of rounding to f64.
const HALF_A_DIGIT: f64 = 0.5 * f64::EPSILON;

fn stage_lines(stage: &StageReport) -> Vec<String> {
    let mut lines = Vec::new();
    if stage.iterations > 0 || stage.inconsistency > 0.0 {
        let fields: Vec<String> = stage.fields.iter().map(ToString::to_string).collect();
        lines.push(format!(
            "  {}: {} of Newton's, conductances right to {:.1e}",
            fields.join(" and "),
            counted(stage.iterations, "step"),
            stage.inconsistency
        ));
    }
    for (field, linear) in stage.fields.iter().zip(&stage.linear) {
        lines.push(format!("  {field}: {}", linear_text(linear)));
        for (method, why) in &linear.given_up {
            lines.push(format!("    {method} was given up: {why}"));
        }
        if linear.tolerance.max(HALF_A_DIGIT) < linear.quality.error {
            lines.push("    rounding leaves flows less exact where larger ones nearly cancel in them".to_owned());
        }
        if linear.shared > 0 {
            lines.push(format!(
                "    {} in rings, whose flows the equations do not tell apart: they share as equal ones would",
                counted(linear.shared, "infinite conductance")
            ));
        }
    }
    lines
}

fn linear_text(linear: &LinearReport) -> String {
    let mut parts = vec![counted(linear.unknowns, "unknown")];
    if linear.relative > 0 {
        parts.push(format!("{} of them jumps, in {}", linear.relative, counted(linear.levels, "level")));
    }
    if linear.merged > 0 {
        parts.push(format!("{} merged", counted(linear.merged, "node")));
    }
    if linear.taken_out > 0 {
        parts.push(format!("{} taken out", counted(linear.taken_out, "node")));
    }
    if linear.dead_ends > 0 {
        parts.push(format!("{} without flow", counted(linear.dead_ends, "node")));
    }
    let method = match (linear.method, linear.ordering) {
        (_, _) if linear.unknowns == 0 => "nothing to factor".to_owned(),
        (Method::Iterative, _) => format!("iterative, {}", counted(linear.iterations, "iteration")),
        (method, Some(Ordering::NestedDissection)) => format!("{method}, nested dissection"),
        (method, _) => method.to_string(),
    };
    let Quality { solves, residual, error, condition } = linear.quality;
    let quality = match (linear.unknowns, linear.method) {
        (0, _) => String::new(),
        (_, Method::Elimination) => format!(", residual {residual:.1e}"),
        _ => format!(
            ", {}, residual {residual:.1e}, estimated error {error:.1e}, condition {condition:.1e}",
            counted(solves, "solve")
        ),
    };
    format!("{}; {method}{quality}", parts.join(", "))
}

fn linear_json(field: Field, linear: &LinearReport) -> Value {
    json!({
        "field": field.key(),
        "unknowns": linear.unknowns,
        "relative": linear.relative,
        "levels": linear.levels,
        "merged": linear.merged,
        "taken_out": linear.taken_out,
        "still": linear.dead_ends,
        "shared": linear.shared,
        "solver": linear.method.to_string(),
        "ordering": linear.ordering.map(|ordering| match ordering {
            Ordering::MinimumDegree => "minimum degree",
            Ordering::NestedDissection => "nested dissection",
        }),
        "factor_entries": linear.factor_entries,
        "iterations": linear.iterations,
        "solves": linear.quality.solves,
        "residual": linear.quality.residual,
        "error": linear.quality.error,
        "condition": linear.quality.condition,
        "given_up": linear.given_up.iter().map(|(method, why)| {
            json!({ "solver": method.to_string(), "reason": why.to_string() })
        }).collect::<Vec<Value>>(),
    })
}

fn balance_line(field: Field, balance: &FieldBalance, is_transient: bool) -> String {
    let FieldBalance { supplied, withdrawn, generated, stored, missing, turnover } = *balance;
    let at_end = if is_transient { " at the end" } else { "" };
    let stored = if is_transient { format!(", {stored:?} stored") } else { String::new() };
    let share = if turnover > 0.0 { missing.abs() / turnover } else { 0.0 };
    let flow = field.flow_name();
    format!(
        "  {flow}{at_end}: {supplied:?} in and {withdrawn:?} out at fixed values, {generated:?} generated{stored}; \
         {share:.1e} of the turnover is missing"
    )
}

/// The balance of each solved field.
pub(super) fn balances(problem: &Problem<'_>, state: &State) -> Value {
    let mut balances = Map::new();
    for field in problem.solved_fields() {
        let Some(balance) = state.balance(problem, field) else { continue };
        let supplies = state.supplies(problem, field);
        let supplies =
            supplies.iter().map(|(node, supply)| (problem.scene().nodes[*node as usize].clone(), json!(supply)));
        let of_field = json!({
            "supplied": balance.supplied,
            "withdrawn": balance.withdrawn,
            "generated": balance.generated,
            "stored": balance.stored,
            "missing": balance.missing,
            "turnover": balance.turnover,
            "supplies": supplies.collect::<Map<String, Value>>(),
        });
        balances.insert(field.key().to_owned(), of_field);
    }
    Value::Object(balances)
}
