//! Bodies: connected components of solid elements, and their terminals.

use crate::error::{BodyFault, Error};
use crate::material::BodyField;
use crate::rules::UNUSABLE_TERMINAL;
use inpact_geometry::NodeId;
use inpact_parser::deck::Deck;
use inpact_parser::grammar::Grammar;
use inpact_parser::mesh::{self, BodyMesh, ElementBlock, MeshNote, MeshTerminal, RowBytes};
use inpact_parser::model::Name;
use inpact_parser::span::Span;
use std::io;

/// The maximum number of names in a message.
const MAX_NAMES: usize = 12;

/// The bodies of a deck with their terminals.
#[derive(Debug, Clone)]
pub struct Body {
    pub(crate) mesh: BodyMesh,
    pub(crate) terminals: Vec<MeshTerminal>,
    pub(crate) parts: Vec<BodyPart>,
    /// The part of each node.
    pub(crate) part_of: Vec<u32>,
}

/// A body: a connected component of nodes and elements.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BodyPart {
    /// The number of its nodes.
    pub nodes: usize,
    /// The number of its elements.
    pub elements: usize,
    /// Its terminals, as positions among all.
    pub terminals: Vec<usize>,
    /// The first of its nodes.
    pub first: NodeId,
}

impl Body {
    /// Reads the bodies of a deck with these surfaces and node sets as terminals.
    ///
    /// A prefix before a dot is the name of an instance; a surface takes precedence over a node set of the same name, and a number is a node.
    /// A terminal lies in one body.
    ///
    /// # Errors
    ///
    /// Bytes that cannot be read; in the inner result, an [`Error`] where the deck has faults, a terminal is not defined, has no node of a solid element, lies in two bodies, or
    /// shares a node with another.
    pub fn read(
        deck: &Deck,
        grammar: &Grammar,
        terminals: &[Name],
        rows: &mut dyn RowBytes,
    ) -> io::Result<Result<Self, Error>> {
        Ok(Self::of(mesh::read_bodies(deck, grammar, terminals, rows)?, terminals))
    }

    /// The bodies of a mesh, which was read with the names of these terminals.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read).
    pub fn of(mesh: BodyMesh, names: &[Name]) -> Result<Self, Error> {
        let (body, faults) = Self::sound(mesh, names)?;
        Error::unless_none(faults)?;
        Ok(body)
    }

    /// The same without the bodies that have faults of their own, and these faults; a terminal without a solid has no node and belongs to no body.
    ///
    /// # Errors
    ///
    /// Faults that concern all bodies: the mesh cannot be read, or a terminal is not defined.
    pub fn sound(mut mesh: BodyMesh, names: &[Name]) -> Result<(Self, Vec<BodyFault>), Error> {
        let mut faults: Vec<BodyFault> = std::mem::take(&mut mesh.faults).into_iter().map(BodyFault::from).collect();
        let (mut terminals, mut alone) = (Vec::new(), Vec::new());
        for (name, terminal) in names.iter().zip(std::mem::take(&mut mesh.terminals)) {
            match terminal {
                Some(terminal) if !terminal.nodes.is_empty() => terminals.push(terminal),
                Some(terminal) => {
                    let message = format!("no solid element has a node of `{name}`");
                    let span = Some(terminal.span).filter(|span| *span != Span::default());
                    alone.push(BodyFault { rule: &UNUSABLE_TERMINAL, span, message, bodies: Vec::new() });
                    terminals.push(terminal);
                }
                None => faults.push(BodyFault {
                    rule: &UNUSABLE_TERMINAL,
                    span: None,
                    message: undefined(name, &mesh.known),
                    bodies: Vec::new(),
                }),
            }
        }
        Error::unless_none(faults)?;
        if mesh.points.is_empty() {
            return Err(without_solid(&mesh));
        }
        let (part_of, mut parts) = parts(&mesh);
        let mut faults = alone;
        faults.extend(touching(&mesh, &terminals, &part_of));
        for (at, terminal) in terminals.iter().enumerate() {
            let Some(first) = terminal.nodes.first() else { continue };
            let part = part_of[first.index()];
            parts[part as usize].terminals.push(at);
            if let Some(other) = terminal.nodes.iter().find(|node| part_of[node.index()] != part) {
                let message = format!(
                    "`{}` lies in two bodies: nothing solid connects its nodes {} and {}",
                    terminal.name,
                    mesh.node(*first),
                    mesh.node(*other)
                );
                let bodies = terminal.nodes.iter().map(|node| part_of[node.index()]).collect();
                faults.push(BodyFault::at(&UNUSABLE_TERMINAL, terminal.span, message).of(bodies));
            }
        }
        let mut body = Self { mesh, terminals, parts, part_of };
        for fault in &faults {
            body.leave_out(&fault.bodies);
        }
        Ok((body, faults))
    }

    /// Removes the terminals of some bodies, which are then skipped.
    pub fn leave_out(&mut self, bodies: &[u32]) {
        for body in bodies {
            self.parts[*body as usize].terminals.clear();
        }
    }

    /// The bodies, with and without terminals, in the order of their first nodes.
    pub fn parts(&self) -> &[BodyPart] {
        &self.parts
    }

    /// The terminals, in the requested order.
    pub fn terminals(&self) -> &[MeshTerminal] {
        &self.terminals
    }

    /// Nodes, elements and materials.
    pub fn mesh(&self) -> &BodyMesh {
        &self.mesh
    }

    /// Parts of the deck that do not belong to its bodies, with their places: elements that are not solid, options that join nodes otherwise.
    pub fn left_out(&self) -> &[MeshNote] {
        &self.mesh.left_out
    }

    /// The fields for which a material of the bodies with terminals has a conductivity.
    pub fn fields(&self) -> Vec<BodyField> {
        let blocks = self.blocks();
        let materials = || blocks.iter().filter_map(|block| self.mesh.materials.get(block.material));
        let conducts = |field: &BodyField| materials().any(|material| field.of(material).is_some());
        [BodyField::Electrical, BodyField::Thermal].into_iter().filter(conducts).collect()
    }

    /// The blocks with an element in a body that has a terminal.
    pub(crate) fn blocks(&self) -> Vec<&ElementBlock> {
        self.mesh.elements.iter().filter(|block| block.each().any(|nodes| self.has_terminal(nodes))).collect()
    }

    /// The bodies with a terminal that have an element of a block.
    pub(crate) fn bodies_of(&self, block: &ElementBlock) -> Vec<u32> {
        block.each().filter(|nodes| self.has_terminal(nodes)).map(|nodes| self.body_of(nodes)).collect()
    }

    /// Whether an element is of a body with a terminal; others are skipped.
    pub(crate) fn has_terminal(&self, nodes: &[NodeId]) -> bool {
        !self.parts[self.body_of(nodes) as usize].terminals.is_empty()
    }

    /// The body of an element.
    pub(crate) fn body_of(&self, nodes: &[NodeId]) -> u32 {
        self.part_of[nodes[0].index()]
    }
}

fn undefined(name: &Name, known: &[Name]) -> String {
    if known.is_empty() {
        return format!("the deck has no surface and no node set `{name}`, nor any other");
    }
    let shown: Vec<String> = known.iter().take(MAX_NAMES).map(|name| format!("`{name}`")).collect();
    let more = known.len() - shown.len();
    let more = if more == 0 { String::new() } else { format!(" and {more} more") };
    format!("the deck has no surface and no node set `{name}`: it has {}{more}", shown.join(", "))
}

/// The elements of a deck other than solids, each with its place.
fn without_solid(mesh: &BodyMesh) -> Error {
    let of_elements = mesh.left_out.iter().filter(|note| note.message.starts_with("elements of type"));
    let faults: Vec<BodyFault> = of_elements.cloned().map(BodyFault::from).collect();
    match Error::unless_none(faults) {
        Err(error) => error,
        Ok(()) => Error::without_place("the deck has no solid element".to_owned()),
    }
}

/// The part of each node, and the parts.
fn parts(mesh: &BodyMesh) -> (Vec<u32>, Vec<BodyPart>) {
    let mut parent: Vec<u32> = (0..).take(mesh.points.len()).collect();
    for nodes in mesh.elements.iter().flat_map(ElementBlock::each) {
        let first = root(&mut parent, nodes[0].0);
        for node in &nodes[1..] {
            let other = root(&mut parent, node.0);
            // The lower number is the root, so that parts come in the order of their first nodes.
            let (low, high) = (parent[first as usize].min(other), parent[first as usize].max(other));
            parent[high as usize] = low;
            parent[first as usize] = low;
        }
    }
    let mut number = vec![u32::MAX; parent.len()];
    let mut part_of = vec![0; parent.len()];
    let mut parts: Vec<BodyPart> = Vec::new();
    for node in (0..).take(parent.len()) {
        let top = root(&mut parent, node) as usize;
        if number[top] == u32::MAX {
            number[top] = u32::try_from(parts.len()).unwrap_or(u32::MAX);
            parts.push(BodyPart { nodes: 0, elements: 0, terminals: Vec::new(), first: NodeId(node) });
        }
        part_of[node as usize] = number[top];
        parts[number[top] as usize].nodes += 1;
    }
    for nodes in mesh.elements.iter().flat_map(ElementBlock::each) {
        parts[part_of[nodes[0].index()] as usize].elements += 1;
    }
    (part_of, parts)
}

fn root(parent: &mut [u32], node: u32) -> u32 {
    let mut top = node;
    while parent[top as usize] != top {
        // Path halving.
        parent[top as usize] = parent[parent[top as usize] as usize];
        top = parent[top as usize];
    }
    top
}

/// Terminals that share nodes, each pair once.
fn touching(mesh: &BodyMesh, terminals: &[MeshTerminal], part_of: &[u32]) -> Vec<BodyFault> {
    let mut owner: Vec<Option<usize>> = vec![None; mesh.points.len()];
    let mut faults = Vec::new();
    let mut known: Vec<(usize, usize)> = Vec::new();
    for (at, terminal) in terminals.iter().enumerate() {
        for node in &terminal.nodes {
            let Some(other) = owner[node.index()].replace(at) else { continue };
            if other != at && !known.contains(&(other, at)) {
                known.push((other, at));
                let message = format!(
                    "the terminals `{}` and `{}` touch in node {}: no conductance is between them",
                    terminals[other].name,
                    terminal.name,
                    mesh.node(*node)
                );
                let bodies = vec![part_of[node.index()]];
                faults.push(BodyFault::at(&UNUSABLE_TERMINAL, terminal.span, message).of(bodies));
            }
        }
    }
    faults
}
