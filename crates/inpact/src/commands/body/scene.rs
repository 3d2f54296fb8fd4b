//! Bodies as parts of a scene: its nodes with their capacities, and links between them.

use super::Found;
use super::text::short;
use crate::commands::joule_heat::JOULE_HEAT_FRACTION;
use crate::text::{csv, number_text, toml_text};
use inpact_body::{BodyField, Lumped};
use std::collections::BTreeSet;

/// A pair of terminals that conduct, and the conductance of each field.
struct Link {
    nodes: [usize; 2],
    conductances: Vec<f64>,
}

/// The negative conductances, which a network cannot have.
pub(super) fn negative(found: &Found<'_>) -> Vec<String> {
    let name = |at: usize| found.body.terminals()[at].name.written();
    let of_field = |lumped: &Lumped| {
        let field = lumped.field;
        let message = |(a, b, conductance): (usize, usize, f64)| {
            let conductance = short(conductance);
            format!(
                "the {field} conductance of `{}` and `{}` is {conductance}, below zero, which no link of a scene is: the mesh is too coarse between them",
                name(a),
                name(b)
            )
        };
        lumped.isothermal.negative().map(message).collect::<Vec<_>>()
    };
    found.lumped.iter().flat_map(of_field).collect()
}

/// The links, each pair once.
fn conducting(found: &Found<'_>) -> Vec<Link> {
    let within = |lumped: &Lumped| lumped.isothermal.within_bodies().map(|(a, b, _)| [a, b]).collect::<Vec<_>>();
    let all: BTreeSet<[usize; 2]> = found.lumped.iter().flat_map(within).collect();
    // Negative values here are rounding.
    let of = |[a, b]: [usize; 2]| Link {
        nodes: [a, b],
        conductances: found.lumped.iter().map(|lumped| lumped.isothermal.between(a, b).max(0.0)).collect(),
    };
    all.into_iter().map(of).filter(|link| link.conductances.iter().any(|conductance| 0.0 < *conductance)).collect()
}

pub(super) fn links(found: &Found<'_>) -> Vec<u8> {
    let fields = found.lumped.iter().map(|lumped| lumped.field.to_string());
    let heat = found.heats.is_any().then(|| JOULE_HEAT_FRACTION.to_owned());
    let header = ["node_1", "node_2"].map(str::to_owned).into_iter().chain(fields).chain(heat.clone());
    let rows = conducting(found).into_iter().map(|link| {
        let names = link.nodes.iter().map(|at| found.body.terminals()[*at].name.written().to_owned());
        let numbers = link.conductances.iter().map(|conductance| number_text(*conductance));
        let heat = heat.as_ref().map(|_| number_text(found.heats.share(link.nodes[0]).unwrap_or(0.0)));
        names.chain(numbers).chain(heat).collect()
    });
    csv(std::iter::once(header.collect()).chain(rows))
}

/// Nodes and links of a scene.
pub(super) fn rows(found: &Found<'_>) -> String {
    let quoted = |at: usize| toml_text(found.body.terminals()[at].name.written());
    let mut text = String::new();
    for at in 0..found.body.terminals().len() {
        text += &format!("[[node]]\nname = {}\n", quoted(at));
        for lumped in &found.lumped {
            text += &of_node(lumped, at);
        }
        text.push('\n');
    }
    for link in conducting(found) {
        let [a, b] = link.nodes;
        text += &format!("[[link]]\nnodes = [{}, {}]\n", quoted(a), quoted(b));
        for (lumped, conductance) in found.lumped.iter().zip(&link.conductances) {
            text += &format!("{} = {}\n", lumped.field, toml_number(*conductance));
        }
        if let Some(share) = found.heats.share(a) {
            text += &format!("{JOULE_HEAT_FRACTION} = {}\n", toml_number(share));
        }
        text.push('\n');
    }
    text.trim_end().to_owned() + "\n"
}

fn of_node(lumped: &Lumped, at: usize) -> String {
    match (lumped.field, lumped.capacities[at]) {
        (BodyField::Electrical, _) => "potential = {}\n".to_owned(),
        (BodyField::Thermal, None) => "temperature = {}\n".to_owned(),
        (BodyField::Thermal, Some(capacity)) => {
            format!("temperature = {{ capacity = {} }}\n", toml_number(capacity))
        }
    }
}

/// A number in TOML that round-trips.
fn toml_number(value: f64) -> String {
    format!("{value:?}")
}
