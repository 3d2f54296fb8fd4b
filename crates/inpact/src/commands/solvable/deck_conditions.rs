//! Conditions that a scene takes from its deck, at the nodes that represent a set or a surface.

use crate::commands::meshed::MeshedDeck;
use crate::failure::Failure;
use crate::terminals::{Film, StepTime, Taker, nodes_of};
use inpact_diagnostics::{Findings, Place};
use inpact_network::scene::{
    CONDITION_LEFT_OUT, ConditionsOfDeck, Field, NOT_ONE_CONDITION, NodePart, PartKind, Scene, SceneLink, UNKNOWN_PART,
};
use inpact_parser::mesh::Target;
use inpact_parser::model::{Reference, Regime};
use inpact_parser::span::{SourceId, Span};
use std::collections::BTreeSet;

/// The parts of the deck that nodes of a scene represent.
pub(super) fn targets(scene: &Scene) -> Vec<Target> {
    let target = |part: &NodePart| {
        let reference = Reference { name: part.name.clone(), span: Span::new(SourceId::ROOT, 0, 0) };
        match part.kind {
            PartKind::Set => Target::Nodes(reference),
            PartKind::Surface => Target::Surface(reference),
        }
    };
    scene.parts.values().map(target).collect()
}

/// The step whose conditions hold; reports an ambiguous one.
pub(crate) fn step(wanted: ConditionsOfDeck, steps: usize, findings: &mut Findings) -> Option<usize> {
    let message = match (wanted.step, steps) {
        (Some(step), _) if step <= steps => return Some(step),
        (None, 1) => return Some(1),
        (Some(step), 0 | 1) => {
            format!("`conditions.step` is {step}, and the deck has {}", if steps == 0 { "no step" } else { "1 step" })
        }
        (Some(step), _) => format!("`conditions.step` is {step}, and the deck has {steps} steps"),
        (None, 0) => "the deck has no step to take conditions from".to_owned(),
        (None, _) => format!("the deck has {steps} steps, and the scene does not say which it takes conditions from"),
    };
    let help = "give `step` under [conditions], from 1";
    findings.report(&UNKNOWN_PART, Place::of_line(wanted.line), message, help);
    None
}

/// Adds the conditions of the deck to a scene; reports those that cannot be added.
pub(super) fn take(
    scene: &mut Scene,
    meshed: &MeshedDeck,
    places: &[Option<usize>],
    findings: &mut Findings,
) -> Result<(), Failure> {
    let regime = if scene.is_transient() { Regime::Transient } else { Regime::SteadyState };
    let conditions = &meshed.conditions;
    let mut taker = Taker::new(&meshed.mesh, conditions, StepTime::of(&meshed.read.model, conditions.step, regime));
    let at = |span: Span| meshed.line_of(span);
    let parts: Vec<(u32, NodePart)> = scene.parts.iter().map(|(node, part)| (*node, part.clone())).collect();
    let mut seen: BTreeSet<(bool, &str)> = BTreeSet::new();
    for ((node, part), place) in parts.iter().zip(places) {
        let here = Place::of_line(part.line);
        let what = match part.kind {
            PartKind::Set => "node set",
            PartKind::Surface => "surface",
        };
        let nodes = place.map(|surface| nodes_of(&meshed.mesh, surface)).unwrap_or_default();
        if nodes.is_empty() {
            let message = format!("the deck has no {what} `{}` with a node in it", part.name);
            findings.report(&UNKNOWN_PART, here, message, "name a set of *NSET or a surface of *SURFACE");
            continue;
        }
        if !seen.insert((part.kind == PartKind::Set, part.name.canonical())) {
            let message = format!("two nodes stand for the {what} `{}`", part.name);
            findings.report(&NOT_ONE_CONDITION, here, message, "let one node stand for it");
            continue;
        }
        let stated = taker.take(&nodes);
        let name = scene.nodes[*node as usize].clone();
        for (field, span, why) in &stated.faults {
            if says(scene, *field, *node) {
                continue;
            }
            let message = format!("the {field} of `{name}`: {why} ({})", at(*span)?);
            let help = format!(
                "name a part on which there is one condition, or give `{}` of the node in the scene",
                field.key()
            );
            findings.report(&NOT_ONE_CONDITION, here.clone(), message, help);
        }
        for field in Field::ALL {
            let index = field.index();
            // The scene's own values of a field at a node take precedence.
            if says(scene, field, *node) {
                continue;
            }
            let conditions = &mut scene.conditions[index];
            if let Some(initial) = stated.initial[index] {
                conditions.initial.entry(*node).or_insert(initial);
            }
            match (&stated.fixed[index], &stated.source[index]) {
                // A held node absorbs any flow.
                (Some(fixed), _) => drop(conditions.fixed.insert(*node, fixed.clone())),
                (None, Some(source)) => drop(conditions.sources.insert(*node, source.clone())),
                (None, None) => {}
            }
        }
        for film in stated.films {
            add_film(scene, *node, film);
        }
    }
    let help = "add a node for it, or give what it means in the scene";
    for (span, message) in taker.left_out() {
        findings.report(&CONDITION_LEFT_OUT, Place::default(), format!("{message} ({})", at(span)?), help);
    }
    for note in &conditions.not_taken {
        let message = format!("{} ({})", note.message, at(note.span)?);
        findings.report(&CONDITION_LEFT_OUT, Place::default(), message, "give what it means in the scene");
    }
    Ok(())
}

/// Whether the scene itself gives a fixed value or source of a field at a node.
fn says(scene: &Scene, field: Field, node: u32) -> bool {
    let conditions = scene.conditions(field);
    conditions.fixed.contains_key(&node) || conditions.sources.contains_key(&node)
}

/// A film is a link to a node that is held at the temperature of its sink.
fn add_film(scene: &mut Scene, node: u32, film: Film) {
    let Film { conductance, sink } = film;
    let base = format!("{} film", scene.nodes[node as usize]);
    let names = std::iter::once(base.clone()).chain((2_u32..).map(|number| format!("{base} {number}")));
    let Some(name) = names.into_iter().find(|name| !scene.nodes.contains(name)) else { return };
    let Ok(number) = u32::try_from(scene.nodes.len()) else { return };
    scene.nodes.push(name);
    scene.conditions[Field::Temperature.index()].fixed.insert(number, sink);
    let mut conductances = [0.0; 3];
    conductances[Field::Temperature.index()] = conductance;
    scene.links.push(SceneLink { nodes: [node, number], conductances, joule_heat_fraction: 0.0 });
}
