//! The measurements as text, comma-separated values and JSON.

use super::measure::{Entry, Measured};
use super::subjects::Subject;
use crate::commands::solvable::SolvableScene;
use crate::commands::tradeoff::cells::{by_reason, error, line, star};
use crate::text::{counted, csv_text};
use inpact_diagnostics::column_width;
use inpact_network::linear::Phases;
use serde_json::{Value, json};

/// A table for a person.
pub(super) fn text(measured: &Measured, prepared: &SolvableScene) -> String {
    let mut text = format!("{} with {}: {}\n", prepared.name, prepared.deck_name, size(measured, prepared));
    text += &format!("{}; {}\n", what(measured, prepared), how(measured));
    text += &format!("reference: {}\n", reference(measured));
    text += "errors are differences from the reference: of nodes as parts of the range of their field's values, of flows through links and interfaces as parts of the flow; \
             residual, estimate of the error of a flow, condition and entries are those of the last linear problem of each field; \
             * marks the Pareto front of time and errors of nodes\n\n";
    let rows: Vec<[String; 16]> =
        std::iter::once(HEADER.map(str::to_owned)).chain(measured.entries.iter().map(cells)).collect();
    let mut widths = WIDTHS;
    widths[1] = column_width(rows.iter().map(|row| row[1].as_str())).max(widths[1]);
    text.extend(rows.iter().map(|row| line(row, widths, TEXTS)));
    if measured.unknowns == 0 {
        text += "  no unknowns: nodes that only pass on what flows through them are taken out, and nothing is left to any solver\n";
    }
    let mut given_up: Vec<(String, String)> = Vec::new();
    for Entry { subject, found, .. } in &measured.entries {
        for (field, method, why) in &found.given_up {
            given_up.push((name(*subject), format!("{method} was given up for {field}: {why}")));
        }
    }
    for (names, reason) in by_reason(&given_up) {
        text += &format!("  fell back: {}: {reason}\n", names.join(", "));
    }
    let failed: Vec<(String, String)> =
        measured.failed.iter().map(|(subject, reason)| (name(*subject), reason.clone())).collect();
    for (names, reason) in by_reason(&failed) {
        text += &format!("  failed: {}: {reason}\n", names.join(", "));
    }
    text
}

const HEADER: [&str; 16] = [
    "",
    "solver",
    "tolerance",
    "ms",
    "order",
    "factor",
    "solve",
    "nodes",
    "flows",
    "residual",
    "estimate",
    "condition",
    "Newton",
    "solves",
    "CG",
    "entries",
];

/// The least widths of the columns, of which the first are texts.
const WIDTHS: [usize; 16] = [1, 9, 10, 9, 8, 8, 8, 8, 8, 8, 8, 9, 6, 6, 6, 8];
const TEXTS: usize = 3;

fn cells(entry: &Entry) -> [String; 16] {
    let Entry { subject, time, phases, distance, found, on_front, .. } = entry;
    let milliseconds = |seconds: f64| format!("{:.4}", 1e3 * seconds);
    let estimated = |number: Option<f64>| number.map_or("none".to_owned(), error);
    [
        star(*on_front),
        found.methods_text(),
        subject.tolerance_text(),
        milliseconds(*time),
        milliseconds(phases.order),
        milliseconds(phases.factor),
        milliseconds(phases.solve),
        error(distance.values),
        error(distance.flows),
        error(found.residual),
        estimated(found.estimate),
        estimated(found.condition),
        found.newton_steps.to_string(),
        found.work.solves.to_string(),
        found.work.iterations.to_string(),
        found.factor_entries.to_string(),
    ]
}

/// The name of a solver at a tolerance.
pub(super) fn name(subject: Subject) -> String {
    format!("{} {}", subject.method, subject.tolerance_text())
}

fn size(measured: &Measured, prepared: &SolvableScene) -> String {
    let scene = &prepared.scene;
    let counts = [
        (scene.nodes.len(), "node"),
        (scene.links.len(), "link"),
        (scene.interfaces.len(), "interface"),
        (measured.unknowns, "unknown"),
    ];
    counts.map(|(number, what)| counted(number, what)).join(", ")
}

/// The scene and the time up to which it was solved.
pub(super) fn what(measured: &Measured, prepared: &SolvableScene) -> String {
    match measured.reference.states.last() {
        Some(last) if prepared.scene.is_transient() => {
            format!("a transient: the state at its start and one increment, to time {:?}", last.time)
        }
        _ => "a steady state, solved whole".to_owned(),
    }
}

/// The conditions of the measurement.
pub(super) fn how(measured: &Measured) -> String {
    let rounds = if measured.rounds == 1 { "one round" } else { &format!("{} interleaved rounds", measured.rounds) };
    format!("least of {rounds}, one thread, nothing kept from one solution to the next")
}

fn reference(measured: &Measured) -> String {
    let reference = &measured.reference;
    let mut text = format!("{} to the last digit ({})", reference.subject.method, reference.reason);
    let own: Vec<String> =
        measured.entries.iter().filter(|entry| entry.is_reference).map(|entry| name(entry.subject)).collect();
    if !own.is_empty() {
        text += &format!("; the errors of {} mean nothing: that is the same solver", own.join(", "));
    }
    text
}

/// A table for a spreadsheet; what failed has nothing but its reason.
pub(super) fn csv(measured: &Measured) -> String {
    let mut text = "solver,tolerance,methods,seconds,set_up_seconds,order_seconds,factor_seconds,solve_seconds,\
                    node_error,flow_error,residual,error_estimate,condition,newton_steps,networks,solves,iterations,\
                    factor_entries,factor_bytes,pareto,reference,given_up,failed\n"
        .to_owned();
    for Entry { subject, time, phases, distance, is_reference, found, on_front } in &measured.entries {
        let Phases { set_up, order, factor, solve } = *phases;
        let times = [*time, set_up, order, factor, solve, distance.values, distance.flows, found.residual];
        let times = times.map(|number| format!("{number:?}")).join(",");
        let estimates = [found.estimate, found.condition];
        let estimates = estimates.map(|number| number.map_or(String::new(), |number| format!("{number:?}"))).join(",");
        let work = found.work;
        let counts = [
            found.newton_steps,
            work.networks,
            work.solves,
            work.iterations,
            found.factor_entries,
            found.factor_bytes,
            usize::from(*on_front),
            usize::from(*is_reference),
        ];
        let counts = counts.map(|number| number.to_string()).join(",");
        let given_up = found.given_up.iter().map(|(field, method, why)| format!("{field}: {method}: {why}"));
        let given_up = csv_text(&given_up.collect::<Vec<String>>().join("; "));
        let methods = csv_text(&found.methods_text());
        let (solver, tolerance) = (subject.method, subject.tolerance);
        text += &format!("{solver},{tolerance:?},{methods},{times},{estimates},{counts},{given_up},\n");
    }
    for (subject, reason) in &measured.failed {
        let (solver, tolerance) = (subject.method, subject.tolerance);
        text += &format!("{solver},{tolerance:?}{}{}\n", ",".repeat(21), csv_text(reason));
    }
    text
}

/// For another program; a number that is not finite is null.
pub(super) fn json(measured: &Measured, prepared: &SolvableScene) -> String {
    let reference = &measured.reference;
    let scene = &prepared.scene;
    let document = json!({
        "schema": "inpact/tradeoff-solvers/1",
        "scene": prepared.name,
        "deck": prepared.deck_name,
        "procedure": if scene.is_transient() { "transient" } else { "steady" },
        "nodes": scene.nodes.len(),
        "links": scene.links.len(),
        "interfaces": scene.interfaces.len(),
        "unknowns": measured.unknowns,
        "times": reference.states.iter().map(|state| state.time).collect::<Vec<f64>>(),
        "rounds": measured.rounds,
        "reference": {
            "solver": reference.subject.method.to_string(),
            "tolerance": reference.subject.tolerance,
            "reason": reference.reason,
        },
        "solvers": measured.entries.iter().map(entry_json).collect::<Vec<Value>>(),
        "failed": measured.failed.iter().map(|(subject, reason)| {
            json!({ "solver": subject.method.to_string(), "tolerance": subject.tolerance, "reason": reason })
        }).collect::<Vec<Value>>(),
    });
    format!("{document:#}\n")
}

fn entry_json(entry: &Entry) -> Value {
    let Entry { subject, time, phases, distance, is_reference, found, on_front } = entry;
    json!({
        "solver": subject.method.to_string(),
        "tolerance": subject.tolerance,
        "methods": found.methods.iter().map(ToString::to_string).collect::<Vec<String>>(),
        "given_up": found.given_up.iter().map(|(field, method, why)| {
            json!({ "field": field.key(), "solver": method.to_string(), "reason": why })
        }).collect::<Vec<Value>>(),
        "seconds": time,
        "phases": {
            "set_up": phases.set_up,
            "order": phases.order,
            "factor": phases.factor,
            "solve": phases.solve,
        },
        "node_error": distance.values,
        "flow_error": distance.flows,
        "residual": found.residual,
        "error_estimate": found.estimate,
        "condition": found.condition,
        "newton_steps": found.newton_steps,
        "networks": found.work.networks,
        "solves": found.work.solves,
        "iterations": found.work.iterations,
        "factor_entries": found.factor_entries,
        "factor_bytes": found.factor_bytes,
        "pareto": on_front,
        "reference": is_reference,
    })
}

#[cfg(test)]
mod tests {
    use super::super::subjects::{Reference, USUAL};
    use super::*;

    #[test]
    fn what_failed_has_its_reason_in_the_last_column() {
        let reference = Reference { subject: USUAL, reason: String::new(), states: Vec::new() };
        let failed = vec![(USUAL, "no reason, or two".to_owned())];
        let measured = Measured { reference, rounds: 1, entries: Vec::new(), failed, unknowns: 1 };
        let csv = csv(&measured);
        let (header, line) = csv.split_once('\n').expect("a header");
        let before = line.strip_suffix(",\"no reason, or two\"\n").expect("the reason");
        assert!(before.starts_with("direct,1.3877787807814457e-17,"), "{line}");
        assert_eq!(before.split(',').count() + 1, header.split(',').count());
    }
}
