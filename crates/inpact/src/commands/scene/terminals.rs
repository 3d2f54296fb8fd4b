//! Where the bodies of a deck end: the surfaces of its contact pairs, and the sets and surfaces with conditions.

use crate::commands::meshed::MeshedDeck;
use crate::terminals::nodes_of;
use inpact_contact::Interfaces;
use inpact_geometry::{ContactNode, NodeId, Surface};
use inpact_parser::mesh::{BodyMesh, ConditionKind, Mesh, MeshNote, MeshPair, SurfaceKind};
use inpact_parser::model::Name;
use std::collections::{BTreeSet, HashSet};

/// A part of the mesh that is one node of the scene.
pub(super) struct Terminal {
    pub(super) name: Name,
    pub(super) nodes: BTreeSet<NodeId>,
}

/// The terminals of a deck; parts that cannot be one are noted.
///
/// A set within a terminal is none of its own: its conditions are those of the terminal. A set that shares only some nodes with one cannot be one, since no
/// conductance is between what touches.
pub(super) fn terminals(meshed: &MeshedDeck, interfaces: &Interfaces, notes: &mut Vec<MeshNote>) -> Vec<Terminal> {
    let mesh = &meshed.mesh;
    let mut found: Vec<Terminal> = Vec::new();
    for pair in &interfaces.pairs {
        let of_mesh = mesh.pairs.iter().filter(|of| of.span == pair.span);
        let is_named = |of: &&MeshPair| {
            [(of.slave, &pair.slave), (of.master, &pair.master)]
                .iter()
                .all(|(surface, name)| mesh.surfaces[*surface].name == **name)
        };
        let Some(of) = of_mesh.into_iter().find(is_named) else { continue };
        for (name, nodes) in [(&pair.slave, met(mesh, of)), (&pair.master, met(mesh, &turned(of)))] {
            // A surface of several pairs is one terminal, of all that any of them meets.
            if let Some(known) = found.iter_mut().find(|known| known.name == *name) {
                known.nodes.extend(nodes);
                continue;
            }
            let note = |other: &Name| format!("the contact surface `{name}` shares nodes with `{other}`");
            add(&mut found, name, nodes, (pair.span, &note), notes);
        }
    }
    // Sets before what is in them.
    let mut conditions: Vec<_> =
        meshed.conditions.conditions.iter().filter(|condition| condition.on.is_some()).collect();
    conditions
        .sort_by_key(|condition| std::cmp::Reverse(condition.on.map_or(0, |surface| nodes_of(mesh, surface).len())));
    for condition in conditions {
        let Some(surface) = condition.on else { continue };
        let is_of_faces = matches!(condition.kind, ConditionKind::FlowPerArea(_) | ConditionKind::Film { .. });
        // Faces of an element set have no name that a terminal could be named by.
        if is_of_faces && ["DFLUX", "FILM"].contains(&condition.keyword) {
            continue;
        }
        let name = &mesh.surfaces[surface].name;
        let note = |other: &Name| {
            format!(
                "`{name}` of *{} shares some of its nodes with `{other}`, so that it is no terminal of its own",
                condition.keyword
            )
        };
        add(&mut found, name, nodes_of(mesh, surface), (condition.span, &note), notes);
    }
    found
}

/// How far beside the other surface a node may be that it meets, as a share of an edge: what rounding makes of an edge.
const ON_EDGE: f64 = 1e-6;

/// The slave nodes of a pair that have the master across from them: heat crosses there and nowhere else.
fn met(mesh: &Mesh, pair: &MeshPair) -> BTreeSet<NodeId> {
    let all = || nodes_of(mesh, pair.slave);
    let SurfaceKind::Faces(_) = mesh.surfaces[pair.master].kind else { return all() };
    let strict = MeshPair { extension: ON_EDGE, ..pair.clone() };
    let Ok(contact) = mesh.contact(&strict, 1.0) else { return all() };
    let is_across = |node: &ContactNode| node.across.as_ref().is_some_and(|across| across.projects);
    let met: BTreeSet<NodeId> = contact.iter().filter(|node| is_across(node)).map(|node| node.node).collect();
    if met.is_empty() { all() } else { met }
}

/// The pair seen from its master.
fn turned(pair: &MeshPair) -> MeshPair {
    MeshPair { slave: pair.master, master: pair.slave, adjust: None, clearance: None, ..pair.clone() }
}

/// Leaves of the terminals of a body mesh what was found of them here: of a contact surface the part that meets the other.
pub(super) fn restrict(bodies: &mut BodyMesh, mesh: &Mesh, terminals: &[Terminal]) {
    let mut restricted = std::mem::take(&mut bodies.terminals);
    for (terminal, of) in terminals.iter().zip(&mut restricted) {
        let Some(of) = of else { continue };
        let kept: HashSet<String> = terminal.nodes.iter().map(|node| mesh.nodes[node.index()].to_string()).collect();
        let before = of.nodes.len();
        let is_kept: HashSet<NodeId> =
            of.nodes.iter().copied().filter(|node| kept.contains(&bodies.node(*node).to_string())).collect();
        of.nodes.retain(|node| is_kept.contains(node));
        if of.nodes.len() < before {
            of.faces = of.faces.take().and_then(|surface| {
                let whole = surface.faces().map(|face| surface.face(face));
                let whole = whole.filter(|face| face.nodes.iter().all(|node| is_kept.contains(node)));
                Surface::new(whole).ok().filter(|surface| !surface.is_empty())
            });
        }
    }
    bodies.terminals = restricted;
}

fn add(
    found: &mut Vec<Terminal>,
    name: &Name,
    nodes: BTreeSet<NodeId>,
    (span, note): (inpact_parser::span::Span, &dyn Fn(&Name) -> String),
    notes: &mut Vec<MeshNote>,
) {
    if nodes.is_empty() || found.iter().any(|known| nodes.is_subset(&known.nodes)) {
        return;
    }
    match found.iter().find(|known| !known.nodes.is_disjoint(&nodes)) {
        Some(known) => notes.push(MeshNote { span, message: note(&known.name) }),
        None => found.push(Terminal { name: name.clone(), nodes }),
    }
}
