//! The mesh around the contact pairs of a deck: faces and nodes of their surfaces, at their places in the assembly.
//!
//! A deck of gigabytes has few faces that meet others.
//! The scan gives the places of rows without reading them ([`Deck`]); [`read`] then reads the rows of surfaces, of the sets that they name, of the elements in these,
//! and of the nodes of the faces that were found: each once, straight from the bytes, and keeps only what surfaces need.
//! The bytes come from the caller ([`RowBytes`]).
//! Temperatures, pore pressures and field variables that *INITIAL CONDITIONS gives these nodes are read with them.
//!
//! [`read_bodies`] reads the solid elements of a deck instead, with their nodes and materials, and the surfaces and node sets where they end.
//!
//! Nothing is guessed: the parts of a surface or a pair that are not read here are named in [`Mesh::notes`], with its place.
//!
//! Not read, and named where it matters: nodes and elements made by *NGEN, *NFILL, *NCOPY, *NMAP, *ELGEN, *ELCOPY and *SYSTEM, rows in files of their own (INPUT
//! on *NODE and *ELEMENT), surfaces that are neither of elements nor of nodes, COMBINE, self-contact, and the surfaces that general contact finds by itself.

mod amplitudes;
mod bodies;
mod condition_keywords;
mod conditions;
mod elements;
mod initial;
mod labels;
mod layout;
mod located;
mod materials;
mod nodes;
mod orientations;
mod pairs;
mod place;
mod placement;
mod reader;
mod reading;
mod rows;
mod sections;
mod selected;
mod selection;
mod surfaces;

pub use amplitudes::{Amplitude, AmplitudeTime, AmplitudeValue};
pub use bodies::{BodyMesh, ElementBlock, EvenFlow, MeshTerminal};
pub use conditions::{Condition, ConditionField, ConditionKind, DeckConditions, Target};
pub use initial::{InitialField, InitialQuantity};
pub use materials::{BodyMaterial, MaterialProperty, TensorKind};
pub use orientations::MaterialAxes;
pub use pairs::{AreasOf, MeshPair, Sliding};
pub use place::position;
pub use rows::{KeptRows, RowBytes, SeekableRows};

use crate::deck::Deck;
use crate::grammar::Grammar;
use crate::model::{Model, Name};
use crate::span::Span;
use inpact_geometry::{ElementSpace, FaceLabel, NodeId, Point, Surface};
use std::io;

/// The surfaces of all contact pairs, their nodes and the pairs themselves.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// Coordinates of the nodes (L), instances at their places.
    pub points: Vec<Point>,
    /// The names of the nodes, in the same order.
    pub nodes: Vec<MeshNode>,
    /// The surfaces that pairs name.
    pub surfaces: Vec<MeshSurface>,
    /// The pairs, in the order of the deck.
    pub pairs: Vec<MeshPair>,
    /// Values of *INITIAL CONDITIONS at the nodes, each quantity once.
    pub initial: Vec<InitialField>,
    /// The names of the steps of the deck, in its order: results may say in which one they are by its name.
    pub steps: Vec<Option<Name>>,
    /// Parts that were not read, or were read with an assumption.
    pub notes: Vec<MeshNote>,
}

/// The name of a node or an element: its number, and its instance.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeshNode {
    /// The instance; `None` in a deck without.
    pub instance: Option<Name>,
    /// The number.
    pub label: u32,
}

impl std::fmt::Display for MeshNode {
    /// `12`, or `PLATE-1.12`.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.instance {
            Some(instance) => write!(formatter, "{instance}.{}", self.label),
            None => write!(formatter, "{}", self.label),
        }
    }
}

/// A surface of the deck.
#[derive(Debug, Clone)]
pub struct MeshSurface {
    /// Its name, as the pair writes it.
    pub name: Name,
    /// Its keyword line.
    pub span: Span,
    /// Its kind.
    pub kind: SurfaceKind,
}

/// Kinds of surfaces.
#[derive(Debug, Clone)]
pub enum SurfaceKind {
    /// Faces of elements.
    Faces(FaceSurface),
    /// Nodes alone.
    Nodes(NodeSurface),
}

/// A surface of element faces; everything is in the order of its faces.
#[derive(Debug, Clone)]
pub struct FaceSurface {
    /// The faces, by nodes of the mesh.
    pub surface: Surface,
    /// The element and face of each.
    pub elements: Vec<(MeshNode, FaceLabel)>,
    /// The space the elements are in; the same for all.
    pub space: ElementSpace,
    /// The thickness of plane elements and of sheets (L), from their section; `None` where no section says one.
    pub thickness: Vec<Option<f64>>,
    /// The distance of the side of a sheet from its nodes, along its normal (L); 0 for solids.
    pub shifts: Vec<f64>,
}

/// A surface of nodes.
#[derive(Debug, Clone)]
pub struct NodeSurface {
    /// The nodes.
    pub nodes: Vec<NodeId>,
    /// The area that *SURFACE gives each (L²).
    pub areas: Vec<Option<f64>>,
}

/// Something of the deck that was not read, or was read with something assumed.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct MeshNote {
    /// Its place.
    pub span: Span,
    /// The note, for users.
    pub message: String,
}

/// Reads the mesh around the contact pairs of a model.
///
/// # Errors
///
/// Bytes that cannot be read. Problems of the deck are in [`Mesh::notes`].
pub fn read(deck: &Deck, grammar: &Grammar, model: &Model, rows: &mut dyn RowBytes) -> io::Result<Mesh> {
    Ok(reader::Reader::new(deck, grammar, rows).read(model, &[])?.0)
}

/// Reads the mesh around the contact pairs of a model, the targets given, and the conditions that hold in a step with what they are on.
///
/// Gives the positions of the targets in [`Mesh::surfaces`], `None` where nothing of one was found: nodes of a set are a surface of nodes.
///
/// # Errors
///
/// Bytes that cannot be read. Problems of the deck are in [`Mesh::notes`] and [`DeckConditions::not_taken`].
pub fn read_with_conditions(
    deck: &Deck,
    grammar: &Grammar,
    model: &Model,
    rows: &mut dyn RowBytes,
    (targets, step): (&[Target], usize),
) -> io::Result<(Mesh, Vec<Option<usize>>, DeckConditions)> {
    let mut reader = reader::Reader::new(deck, grammar, rows);
    let (mut conditions, theirs) = reader.conditions(step, grammar.dialect())?;
    let all: Vec<Target> = targets.iter().chain(&theirs).cloned().collect();
    let (mesh, mut places) = reader.read(model, &all)?;
    let of_conditions = places.split_off(targets.len());
    for condition in &mut conditions.conditions {
        condition.on = condition.on.and_then(|target| of_conditions[target]);
    }
    Ok((mesh, places, conditions))
}

/// Reads the solid elements of a deck, their materials, and the surfaces and node sets of these names.
///
/// # Errors
///
/// Bytes that cannot be read. Problems of the deck are in [`BodyMesh::faults`] and [`BodyMesh::left_out`].
pub fn read_bodies(
    deck: &Deck,
    grammar: &Grammar,
    terminals: &[Name],
    rows: &mut dyn RowBytes,
) -> io::Result<BodyMesh> {
    reader::Reader::new(deck, grammar, rows).read_bodies(terminals)
}
