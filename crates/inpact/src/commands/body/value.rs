//! Conductances and capacities as JSON.

use super::Found;
use inpact_body::{BodySummary, Conductances, Lumped, Solution, SolutionMethod};
use serde_json::{Map, Value, json};

/// Everything that was found.
pub(super) fn value(found: &Found<'_>) -> Value {
    let names: Vec<&str> = found.body.terminals().iter().map(|terminal| terminal.name.written()).collect();
    let fields: Map<String, Value> =
        found.lumped.iter().map(|lumped| (lumped.field.to_string(), of_field(&names, lumped))).collect();
    json!({
        "schema": "inpact/body/1",
        "source": found.deck,
        "temperature": found.temperature,
        "terminals": names,
        "fields": fields,
    })
}

fn of_field(names: &[&str], lumped: &Lumped) -> Value {
    let terminals = lumped.terminals.iter().enumerate().map(|(at, terminal)| {
        json!({
            "name": terminal.name.written(),
            "nodes": terminal.nodes,
            "area": terminal.area,
            "body": terminal.body,
            "upper": terminal.upper,
            "lower": terminal.lower,
            "relative": terminal.relative(),
            "range": terminal.range,
            "capacity": lumped.capacities.as_ref().map(|capacities| capacities[at]),
        })
    });
    let body = |body: &BodySummary| {
        json!({
            "terminals": body.terminals.iter().map(|at| names[*at]).collect::<Vec<_>>(),
            "nodes": body.nodes,
            "elements": body.elements,
            "volume": body.volume,
            "capacity": body.capacity,
        })
    };
    let [isothermal, even] = &lumped.solutions;
    json!({
        "isothermal": pairs(names, &lumped.isothermal),
        "even": pairs(names, &lumped.even),
        "terminals": terminals.collect::<Vec<_>>(),
        "bodies": lumped.bodies.iter().map(body).collect::<Vec<_>>(),
        "potentials": lumped.potentials,
        "solutions": { "isothermal": solution(isothermal), "even": solution(even) },
    })
}

fn pairs(names: &[&str], conductances: &Conductances) -> Vec<Value> {
    let pair = |(a, b, conductance): (usize, usize, f64)| json!({ "terminals": [names[a], names[b]], "conductance": conductance });
    conductances.pairs().map(pair).collect()
}

fn solution(solution: &Solution) -> Value {
    let (method, count) = match solution.method {
        SolutionMethod::Factor(entries) => ("factor_entries", entries),
        SolutionMethod::Iterations(iterations) => ("iterations", iterations),
    };
    json!({
        "unknowns": solution.unknowns,
        "matrix_entries": solution.entries,
        "imbalance": solution.imbalance,
        method: count,
    })
}
