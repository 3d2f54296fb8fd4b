//! The terminals of the bodies of a deck: the surfaces of its contact pairs, and the sets and surfaces with conditions.

use crate::commands::meshed::MeshedDeck;
use crate::terminals::nodes_of;
use inpact_contact::Interfaces;
use inpact_geometry::{ContactNode, Master, NodeId, Placed, Surface, overlap};
use inpact_parser::mesh::{BodyMesh, ConditionKind, EvenFlow, Mesh, MeshNote, MeshPair, SurfaceKind};
use inpact_parser::model::Name;
use inpact_parser::span::Span;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// A part of the mesh that is one node of the scene.
pub(super) struct Terminal {
    pub(super) name: Name,
    pub(super) nodes: BTreeSet<NodeId>,
    /// For a contact surface, the part opposite the other one.
    meets: Meets,
}

/// Where a contact surface meets the other one of its pair.
enum Meets {
    /// Not a contact surface, or unknown: its own faces are used.
    Unsaid,
    /// This area, with ∫ N dA at its nodes.
    Over(BTreeMap<NodeId, f64>, f64),
    /// It is opposite several, each with its own flow.
    Several,
}

impl Terminal {
    /// The area opposite the other surface of its only pair.
    pub(super) fn area(&self) -> Option<f64> {
        if let Meets::Over(_, area) = &self.meets { Some(*area) } else { None }
    }

    pub(super) fn meets_several(&self) -> bool {
        matches!(self.meets, Meets::Several)
    }
}

/// The terminals of a deck, with notes on parts that cannot be one.
///
/// A set within a terminal is not a separate one: its conditions are those of the terminal. A set that shares only some nodes with one cannot be a terminal, since no
/// conductance is defined between touching terminals.
pub(super) fn terminals(meshed: &MeshedDeck, interfaces: &Interfaces, notes: &mut Vec<MeshNote>) -> Vec<Terminal> {
    let mesh = &meshed.mesh;
    let mut found = Found::default();
    let mut by_line: BTreeMap<Span, Vec<&MeshPair>> = BTreeMap::new();
    for pair in &mesh.pairs {
        by_line.entry(pair.span).or_default().push(pair);
    }
    for pair in &interfaces.pairs {
        let of_mesh = by_line.get(&pair.span).map_or(&[][..], Vec::as_slice).iter().copied();
        let is_named = |of: &&MeshPair| {
            [(of.slave, &pair.slave), (of.master, &pair.master)]
                .iter()
                .all(|(surface, name)| mesh.surfaces[*surface].name == **name)
        };
        let Some(of) = of_mesh.clone().find(is_named) else { continue };
        for (name, of) in [(&pair.slave, of.clone()), (&pair.master, turned(of))] {
            let (mut nodes, mut meets) = met(mesh, &of);
            // A surface of several pairs is one terminal, the union of its opposite parts.
            if found.extend(name, &nodes) {
                continue;
            }
            // Where faces extend beyond the other surface into another terminal, only the opposite nodes remain.
            if found.sharing(&nodes).is_some() {
                (nodes, meets) = (strictly_across(mesh, &of), Meets::Unsaid);
            }
            let note = |other: &Name| format!("the contact surface `{name}` shares nodes with `{other}`");
            found.add(Terminal { name: name.clone(), nodes, meets }, (pair.span, &note), notes);
        }
    }
    // Sets before their subsets.
    let mut conditions: Vec<_> =
        meshed.conditions.conditions.iter().filter(|condition| condition.on.is_some()).collect();
    conditions
        .sort_by_key(|condition| std::cmp::Reverse(condition.on.map_or(0, |surface| nodes_of(mesh, surface).len())));
    for condition in conditions {
        let Some(surface) = condition.on else { continue };
        let is_of_faces = matches!(condition.kind, ConditionKind::FlowPerArea(_) | ConditionKind::Film { .. });
        // Faces of an element set have no name for a terminal.
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
        let terminal = Terminal { name: name.clone(), nodes: nodes_of(mesh, surface), meets: Meets::Unsaid };
        found.add(terminal, (condition.span, &note), notes);
    }
    found.terminals
}

/// The terminals so far, by their names and by their nodes.
#[derive(Default)]
struct Found {
    terminals: Vec<Terminal>,
    by_name: HashMap<Name, usize>,
    /// The terminals of each node, in ascending order.
    at: HashMap<NodeId, Vec<usize>>,
}

impl Found {
    /// Adds nodes to a terminal that is opposite a further surface, where there is one of this name.
    fn extend(&mut self, name: &Name, nodes: &BTreeSet<NodeId>) -> bool {
        let Some(&number) = self.by_name.get(name) else { return false };
        let known = &mut self.terminals[number];
        known.meets = Meets::Several;
        for node in nodes.iter().filter(|node| known.nodes.insert(**node)) {
            let at = self.at.entry(*node).or_default();
            at.insert(at.partition_point(|other| *other < number), number);
        }
        true
    }

    /// The first terminal that has some of these nodes.
    fn sharing(&self, nodes: &BTreeSet<NodeId>) -> Option<&Terminal> {
        let first = nodes.iter().filter_map(|node| self.at.get(node)?.first()).min()?;
        Some(&self.terminals[*first])
    }

    fn has_within(&self, nodes: &BTreeSet<NodeId>) -> bool {
        let of_first = nodes.first().and_then(|node| self.at.get(node));
        of_first.is_some_and(|numbers| numbers.iter().any(|number| nodes.is_subset(&self.terminals[*number].nodes)))
    }

    fn add(&mut self, terminal: Terminal, (span, note): (Span, &dyn Fn(&Name) -> String), notes: &mut Vec<MeshNote>) {
        if terminal.nodes.is_empty() || self.has_within(&terminal.nodes) {
            return;
        }
        if let Some(known) = self.sharing(&terminal.nodes) {
            notes.push(MeshNote { span, message: note(&known.name) });
            return;
        }
        let number = self.terminals.len();
        for node in &terminal.nodes {
            self.at.entry(*node).or_default().push(number);
        }
        self.by_name.entry(terminal.name.clone()).or_insert(number);
        self.terminals.push(terminal);
    }
}

/// The tolerance for a node at the edge of the other surface, as a fraction of an edge, for rounding.
const ON_EDGE: f64 = 1e-6;

/// The nodes of the slave faces of a pair that are at least partly opposite the master, and the distribution of a uniform flow over them.
///
/// If all of them are isothermal so is every point that heat crosses, so no true joint conducts more.
fn met(mesh: &Mesh, pair: &MeshPair) -> (BTreeSet<NodeId>, Meets) {
    let unsaid = || (strictly_across(mesh, pair), Meets::Unsaid);
    let (SurfaceKind::Faces(slave), SurfaceKind::Faces(master)) =
        (&mesh.surfaces[pair.slave].kind, &mesh.surfaces[pair.master].kind)
    else {
        return unsaid();
    };
    let (slave, master) = (Placed::new(&slave.surface, &mesh.points), Placed::new(&master.surface, &mesh.points));
    let (Ok(slave), Ok(master)) = (slave, master) else { return unsaid() };
    let Ok(found) = overlap(&slave, &Master::new(master)) else { return unsaid() };
    if found.area <= 0.0 {
        return unsaid();
    }
    let surface = slave.surface();
    let faces = surface.faces().zip(&found.faces).filter(|(_, has_some)| **has_some).map(|(face, _)| face);
    let nodes: BTreeSet<NodeId> = faces.flat_map(|face| surface.face(face).nodes).copied().collect();
    let shares = surface.nodes().iter().copied().zip(found.shares).filter(|(node, _)| nodes.contains(node)).collect();
    (nodes, Meets::Over(shares, found.area))
}

/// The slave nodes of a pair that are opposite the master.
fn strictly_across(mesh: &Mesh, pair: &MeshPair) -> BTreeSet<NodeId> {
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

/// Restricts the terminals of a body mesh to those found here: for a contact surface the part opposite the other.
pub(super) fn restrict(bodies: &mut BodyMesh, mesh: &Mesh, terminals: &[Terminal]) {
    let mut restricted = std::mem::take(&mut bodies.terminals);
    for (terminal, of) in terminals.iter().zip(&mut restricted) {
        let Some(of) = of else { continue };
        if let Meets::Over(shares, area) = &terminal.meets {
            let by_name: HashMap<String, f64> =
                shares.iter().map(|(node, share)| (mesh.nodes[node.index()].to_string(), share / area)).collect();
            of.nodes.retain(|node| by_name.contains_key(&bodies.node(*node).to_string()));
            let shares = of.nodes.iter().map(|node| by_name[&bodies.node(*node).to_string()]).collect();
            of.even = Some(EvenFlow { shares, area: *area });
            continue;
        }
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
