//! Bodies: the solid elements of a deck with their nodes and materials, and the surfaces and node sets that are their terminals.
//!
//! Everything is read once, straight from the rows; of elements only their numbers and the positions of their nodes are kept.

use super::elements::{ElementRows, RawFace};
use super::layout::{Entry, canonical};
use super::materials::BodyMaterial;
use super::nodes::Wanted;
use super::orientations::MaterialAxes;
use super::reader::{Context, Reader};
use super::rows::data_lines;
use super::selected::{Kind, Selection};
use super::surfaces::{Found, Picks};
use super::{MeshNode, MeshNote};
use crate::model::{Name, Reference};
use crate::span::Span;
use inpact_geometry::{
    ElementShape, ElementSpace, ElementType, Face, Integration, NodeId, Point, SolidElement, Surface,
};
use std::collections::HashMap;
use std::io;
use std::ops::Range;

/// The solid elements of a deck, and the terminals of its bodies.
#[derive(Debug, Clone, Default)]
pub struct BodyMesh {
    /// Coordinates of the nodes of solid elements (L), in the assembly.
    pub points: Vec<Point>,
    /// The number of each node in its instance.
    pub labels: Vec<u32>,
    /// The nodes of each instance, and its name; `None` in a deck without.
    pub instances: Vec<(Option<Name>, Range<usize>)>,
    /// The rotated instances, as positions in `instances`.
    pub turned: Vec<usize>,
    /// The elements, by option, instance and section.
    pub elements: Vec<ElementBlock>,
    /// The materials of the deck.
    pub materials: Vec<BodyMaterial>,
    /// The terminals, in the requested order; `None` where the deck has neither a surface nor a node set of the name.
    pub terminals: Vec<Option<MeshTerminal>>,
    /// Names of surfaces and node sets of the deck, in its order.
    pub known: Vec<Name>,
    /// Faults of the deck that would make its bodies wrong.
    pub faults: Vec<MeshNote>,
    /// Elements that are not solids, and options that join nodes otherwise.
    pub left_out: Vec<MeshNote>,
}

/// Elements of one type and section.
#[derive(Debug, Clone)]
pub struct ElementBlock {
    /// The name of the type, as written.
    pub type_name: String,
    /// The shape.
    pub shape: ElementShape,
    /// The integration scheme.
    pub integration: Integration,
    /// The keyword line of *ELEMENT.
    pub span: Span,
    /// The instance, a position in [`BodyMesh::instances`].
    pub instance: usize,
    /// The keyword line of *SOLID SECTION.
    pub section: Span,
    /// The material, a position in [`BodyMesh::materials`]; beyond them where it is not defined.
    pub material: usize,
    /// Its name.
    pub material_name: Name,
    /// The material axes by ORIENTATION of the section.
    pub axes: MaterialAxes,
    /// The numbers of the elements.
    pub labels: Vec<u32>,
    /// The nodes of each element, one after another, as positions in [`BodyMesh::points`].
    pub nodes: Vec<NodeId>,
}

impl ElementBlock {
    /// The nodes of each element, in order.
    pub fn each(&self) -> impl ExactSizeIterator<Item = &[NodeId]> {
        self.nodes.chunks_exact(self.shape.nodes())
    }
}

/// A surface or a node set where a body ends.
#[derive(Debug, Clone)]
pub struct MeshTerminal {
    /// Its name, as requested.
    pub name: Name,
    /// The keyword line that defines it; for a node set defined by *NODE, the *NODE option; empty for a single node.
    pub span: Span,
    /// Its nodes on solid elements, ascending.
    pub nodes: Vec<NodeId>,
    /// The faces of a surface of element faces.
    pub faces: Option<Surface>,
    /// A uniform flow over a part of it, where that is known more precisely than by its faces and nodes.
    pub even: Option<EvenFlow>,
}

/// A flow that is uniformly distributed over an area.
#[derive(Debug, Clone, PartialEq)]
pub struct EvenFlow {
    /// The shares of the nodes of a terminal, in their order; they sum to 1.
    pub shares: Vec<f64>,
    /// The area (L²).
    pub area: f64,
}

impl BodyMesh {
    /// The name of a node.
    pub fn node(&self, node: NodeId) -> MeshNode {
        let instance = self.instances.iter().find(|(_, nodes)| nodes.contains(&node.index()));
        MeshNode { instance: instance.and_then(|(name, _)| name.clone()), label: self.labels[node.index()] }
    }
}

/// A *SOLID SECTION.
struct SolidSection {
    elements: Selection,
    span: Span,
    material: usize,
    material_name: Name,
    axes: MaterialAxes,
}

impl Reader<'_, '_> {
    pub(super) fn read_bodies(mut self, names: &[Name]) -> io::Result<BodyMesh> {
        let mut mesh = BodyMesh { materials: self.read_materials()?, ..BodyMesh::default() };
        for instance in 0..self.instances.len() {
            self.body_elements(instance, &mut mesh)?;
        }
        let mut picks = Picks::default();
        let mut picked = Vec::new();
        for (at, name) in names.iter().enumerate() {
            picked.push(self.pick_terminal(at, name, &mut picks)?);
        }
        for pick in &mut picks.faces {
            pick.elements.labels.sort();
        }
        let faces = self.faces(&picks.faces)?;
        self.place_instances()?;
        let mut of_terminals: Vec<Vec<NodeId>> = vec![Vec::new(); names.len()];
        let mut positions = Vec::new();
        for instance in 0..self.instances.len() {
            positions.push(self.body_nodes(instance, &picks, &mut mesh, &mut of_terminals)?);
        }
        mesh.terminals = names
            .iter()
            .zip(picked)
            .enumerate()
            .map(|(at, (name, picked))| {
                let picked = picked?;
                let nodes = std::mem::take(&mut of_terminals[at]);
                Some(self.terminal(name, &picked, nodes, (at, &faces), &positions))
            })
            .collect();
        mesh.known = self.known_names();
        mesh.left_out.extend(self.layout.beside_elements.iter().map(|(name, entry)| MeshNote {
            span: entry.span(),
            message: match *name {
                "TIE"
                | "EQUATION"
                | "MPC"
                | "COUPLING"
                | "EMBEDDED ELEMENT"
                | "SHELL TO SOLID COUPLING"
                | "RIGID BODY" => format!("*{name} is not read: what it joins conducts nothing here"),
                _ => format!("*{name} is not read: no heat leaves by radiation here"),
            },
        }));
        mesh.faults = self.take_notes();
        Ok(mesh)
    }

    /// Reads the elements of an instance; their nodes are numbers of the deck until [`Self::body_nodes`] finds them.
    fn body_elements(&mut self, instance: usize, mesh: &mut BodyMesh) -> io::Result<()> {
        let sections = self.solid_sections(instance, &mesh.materials)?;
        for (name, span) in self.makers_of(instance) {
            self.note(span, format!("*{name} is not read, so that nodes or elements would be missing or elsewhere"));
        }
        for option in self.entries_of(instance, |definitions| &definitions.elements) {
            if option.parameter("INPUT").is_some() {
                self.note(option.span(), "the elements in a file of their own (INPUT) are not read".to_owned());
            }
            let name = option.parameter("TYPE").unwrap_or("");
            let kind = ElementType::named(name).filter(|kind| kind.space == ElementSpace::Spatial);
            let integration = Integration::of(name);
            let solid = kind.and_then(|kind| SolidElement::new(kind.shape, integration).map(|_| kind.shape));
            let mut left_out = |message: String| mesh.left_out.push(MeshNote { span: option.span(), message });
            if solid == Some(ElementShape::Hexahedron8) && integration == Integration::Reduced {
                left_out(format!(
                    "elements of type `{name}` are integrated over 8 points here, over one by a solver: the flows are others where elements are distorted"
                ));
            }
            match (solid, ElementType::named(name).map(|kind| kind.space)) {
                (Some(shape), _) => self.solid_rows(option, (name, shape, integration), (instance, &sections), mesh)?,
                (None, Some(ElementSpace::Plane | ElementSpace::Planar | ElementSpace::Axisymmetric)) => {
                    left_out(format!(
                        "elements of type `{name}` are plane or axisymmetric, and bodies are solids in space: they conduct nothing here"
                    ));
                }
                (None, _) => left_out(format!("elements of type `{name}` are not solid, and conduct nothing here")),
            }
        }
        Ok(())
    }

    fn solid_rows(
        &mut self,
        option: Entry<'_>,
        (name, shape, integration): (&str, ElementShape, Integration),
        (instance, sections): (usize, &[SolidSection]),
        mesh: &mut BodyMesh,
    ) -> io::Result<()> {
        let key = option.keyword.span;
        let mut rows = ElementRows::new(shape, name);
        // The block of each section that elements of this option have.
        let mut blocks: HashMap<usize, ElementBlock> = HashMap::new();
        let mut without: Vec<(Span, String)> = Vec::new();
        data_lines(&mut *self.rows, option.block, &mut |line, span| {
            let Some((element, nodes)) = rows.take(line, span) else { return };
            // If several sections name an element the last one applies.
            let section = sections.iter().rposition(|section| section.elements.contains(element, key));
            let Some(at) = section else {
                return without.push((span, format!("element {element} has no *SOLID SECTION")));
            };
            let section = &sections[at];
            let block = blocks.entry(at).or_insert_with(|| ElementBlock {
                type_name: name.to_owned(),
                shape,
                integration,
                span: option.span(),
                instance,
                section: section.span,
                material: section.material,
                material_name: section.material_name.clone(),
                axes: section.axes.clone(),
                labels: Vec::new(),
                nodes: Vec::new(),
            });
            block.labels.push(element);
            block.nodes.extend(nodes.iter().map(|node| NodeId(*node)));
        })?;
        self.note_rows(rows, option.span());
        self.note_first(without, "and was left out");
        let mut blocks: Vec<(usize, ElementBlock)> = blocks.into_iter().collect();
        blocks.sort_by_key(|(section, _)| *section);
        mesh.elements.extend(blocks.into_iter().map(|(_, block)| block));
        Ok(())
    }

    fn solid_sections(&mut self, instance: usize, materials: &[BodyMaterial]) -> io::Result<Vec<SolidSection>> {
        let mut sections = Vec::new();
        for entry in self.entries_of(instance, |definitions| &definitions.sections) {
            if canonical(entry.deck.text(entry.keyword.name())) != "SOLIDSECTION" {
                continue;
            }
            let span = entry.span();
            if entry.parameter("COMPOSITE").is_some() {
                self.note(span, "a solid section of layers (COMPOSITE) is not read".to_owned());
                continue;
            }
            let Some(set) = entry.parameter("ELSET") else {
                self.note(span, "*SOLID SECTION has no ELSET, so that it was not read".to_owned());
                continue;
            };
            let selected = self.select(Kind::Elements, Context::Instance(instance), set, span)?;
            let Some(elements) = selected.get(&instance).cloned() else { continue };
            let name = entry.named("MATERIAL").unwrap_or_else(|| Name::new(""));
            let material = materials.iter().position(|material| material.name == name).unwrap_or(materials.len());
            let axes = self.material_axes(instance, entry.named("ORIENTATION"))?;
            sections.push(SolidSection { elements, span, material, material_name: name, axes });
        }
        Ok(sections)
    }

    /// Resolves a terminal: a surface, or else a node set, or else a node number.
    fn pick_terminal(&mut self, at: usize, name: &Name, picks: &mut Picks) -> io::Result<Option<Found>> {
        let reference = Reference { name: name.clone(), span: Span::default() };
        if self.find_surface(&reference).is_some() {
            return self.pick_surface(at, &reference, picks);
        }
        let (context, set) = self.without_prefix(Context::Top, name.clone());
        let (sets, options) = self.definitions_of(Kind::Nodes, context, &set);
        let is_node = sets.is_empty() && options.is_empty() && set.canonical().parse::<u32>().is_ok();
        let span = sets.first().map(Entry::span).or(options.first().copied());
        let Some(span) = span.or(is_node.then(Span::default)) else { return Ok(None) };
        self.pick_nodes(at, context, (set.written(), None), span, picks)?;
        Ok(Some(Found { span, of_nodes: true }))
    }

    /// Finds the nodes of an instance, and maps the node numbers of its elements to positions.
    fn body_nodes(
        &mut self,
        instance: usize,
        picks: &Picks,
        mesh: &mut BodyMesh,
        of_terminals: &mut [Vec<NodeId>],
    ) -> io::Result<Positions> {
        let first = mesh.points.len();
        let name = self.instances[instance].name.clone();
        let blocks = || mesh.elements.iter().filter(|block| block.instance == instance);
        let largest = blocks().flat_map(|block| &block.nodes).max().map_or(0, |node| node.index() + 1);
        let count: usize = blocks().map(|block| block.nodes.len()).sum();
        let numbers = blocks().flat_map(|block| block.nodes.iter().map(|node| node.0));
        let mut wanted = Wanted::new(distinct(numbers, largest, count));
        let here: Vec<_> = picks.nodes.iter().filter(|pick| pick.instance == instance).collect();
        let of_elements = wanted.labels.clone();
        let selections: Vec<&Selection> = here.iter().map(|pick| &pick.nodes).collect();
        let selected = self.read_nodes(instance, &mut wanted, &selections)?;
        let mut positions = Positions::default();
        let mut missing = Vec::new();
        let mut next = of_elements.iter().peekable();
        for (label, point) in wanted.labels.into_iter().zip(wanted.points) {
            // Nodes of sets that are not on solid elements do not belong to a body.
            if next.peek() != Some(&&label) {
                continue;
            }
            next.next();
            match point {
                Some((point, _)) => {
                    positions.labels.push(label);
                    mesh.points.push(point);
                    mesh.labels.push(label);
                }
                None => missing.push(label),
            }
        }
        positions.first = first;
        positions.index();
        if let Some(label) = missing.first() {
            let mut blocks = blocks();
            let span = blocks.find(|block| block.nodes.contains(&NodeId(*label))).map(|block| block.span);
            let more = if 1 < missing.len() { format!(", nor do {} more", missing.len() - 1) } else { String::new() };
            self.note(
                span.unwrap_or_default(),
                format!("node {label} of a solid element has no coordinates in the deck{more}"),
            );
        }
        let placement = self.instances[instance].placement;
        for block in mesh.elements.iter_mut().filter(|block| block.instance == instance) {
            block.axes = std::mem::replace(&mut block.axes, MaterialAxes::Unsaid).placed(&placement);
            for node in &mut block.nodes {
                // A missing node makes the mesh invalid.
                *node = positions.of(node.0).unwrap_or_default();
            }
        }
        for (pick, labels) in here.into_iter().zip(selected) {
            of_terminals[pick.surface].extend(labels.into_iter().filter_map(|label| positions.of(label)));
        }
        if placement.is_turned() {
            mesh.turned.push(instance);
        }
        mesh.instances.push((name, first..mesh.points.len()));
        Ok(positions)
    }

    /// Makes a terminal of what was found.
    fn terminal(
        &mut self,
        name: &Name,
        picked: &Found,
        mut nodes: Vec<NodeId>,
        (at, faces): (usize, &[RawFace]),
        positions: &[Positions],
    ) -> MeshTerminal {
        let mut of_faces: Vec<(&RawFace, Vec<NodeId>)> = Vec::new();
        let mut outside: Vec<(Span, String)> = Vec::new();
        for face in faces.iter().filter(|face| face.surface == at) {
            let found: Option<Vec<NodeId>> =
                face.nodes().iter().map(|node| positions[face.instance].of(*node)).collect();
            match found.filter(|_| face.kind.space == ElementSpace::Spatial) {
                Some(found) => {
                    nodes.extend_from_slice(&found);
                    of_faces.push((face, found));
                }
                None => outside.push((
                    picked.span,
                    format!("face {} of element {} of `{name}` is not a face of a solid", face.label, face.element),
                )),
            }
        }
        self.note_first(outside, "and was left out");
        nodes.sort_unstable();
        nodes.dedup();
        let surface = Surface::new(of_faces.iter().map(|(face, nodes)| Face { shape: face.shape, nodes }));
        let faces = match surface {
            Ok(surface) => (!picked.of_nodes).then_some(surface),
            Err(error) => {
                self.note(picked.span, format!("{error}, so that `{name}` was not read"));
                None
            }
        };
        MeshTerminal { name: name.clone(), span: picked.span, nodes, faces, even: None }
    }
}

/// The positions of the nodes of an instance, by their numbers.
#[derive(Debug, Default)]
struct Positions {
    /// Ascending.
    labels: Vec<u32>,
    /// The position of the first.
    first: usize,
    /// Lookup table by number, where numbers are dense enough: the position + 1 among `labels`; 0 where there is none.
    dense: Vec<u32>,
}

impl Positions {
    fn index(&mut self) {
        let largest = self.labels.last().map_or(0, |label| *label as usize);
        if largest <= 8 * self.labels.len() + 1024 {
            self.dense = vec![0; largest + 1];
            for (at, label) in (1..).zip(&self.labels) {
                self.dense[*label as usize] = at;
            }
        }
    }

    fn of(&self, label: u32) -> Option<NodeId> {
        let at = if self.dense.is_empty() {
            self.labels.binary_search(&label).ok()?
        } else {
            (*self.dense.get(label as usize)? as usize).checked_sub(1)?
        };
        u32::try_from(self.first + at).ok().map(NodeId)
    }
}

/// Sorted distinct numbers; dense ones by a bitmap instead of sorting.
fn distinct(numbers: impl Iterator<Item = u32>, end: usize, count: usize) -> Vec<u32> {
    if 8 * count + 1024 < end {
        return numbers.collect();
    }
    let mut is_there = vec![false; end];
    numbers.for_each(|number| is_there[number as usize] = true);
    (0..).zip(is_there).filter_map(|(number, is_there)| is_there.then_some(number)).collect()
}
