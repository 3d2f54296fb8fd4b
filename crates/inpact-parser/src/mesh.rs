//! The mesh around the contact pairs of a deck: faces and nodes of their surfaces, at their places in the assembly.
//!
//! A deck of gigabytes has few faces that meet others.
//! The scan says where rows stand without reading them ([`Deck`]); [`read`] then reads the rows of surfaces, of the sets that they name, of the elements in these,
//! and of the nodes of the faces that were found: each once, straight from the bytes, and keeps only what surfaces need.
//! Where bytes come from is the caller's ([`RowBytes`]).
//! Temperatures, pore pressures and field variables that *INITIAL CONDITIONS gives these nodes are read with them.
//!
//! Nothing is guessed: what a surface or a pair asks for and what is not read here is named in [`Mesh::notes`], with its place.
//!
//! Not read, and named where it matters: nodes and elements made by *NGEN, *NFILL, *NCOPY, *NMAP, *ELGEN, *ELCOPY and *SYSTEM, rows in files of their own (INPUT
//! on *NODE and *ELEMENT), surfaces that are neither of elements nor of nodes, COMBINE, self-contact, and the surfaces that general contact finds by itself.

mod elements;
mod initial;
mod labels;
mod layout;
mod nodes;
mod pairs;
mod place;
mod reader;
mod rows;
mod sections;
mod selection;
mod surfaces;

pub use initial::{InitialField, InitialQuantity};
pub use pairs::{MeshPair, Sliding};
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
    /// Where the nodes are (L), instances at their places.
    pub points: Vec<Point>,
    /// What the nodes are called, in the same order.
    pub nodes: Vec<MeshNode>,
    /// The surfaces that pairs name.
    pub surfaces: Vec<MeshSurface>,
    /// The pairs, in the order of the deck.
    pub pairs: Vec<MeshPair>,
    /// What *INITIAL CONDITIONS says of the nodes, each quantity once.
    pub initial: Vec<InitialField>,
    /// The names of the steps of the deck, in its order: results may say in which one they are by its name.
    pub steps: Vec<Option<Name>>,
    /// What was not read, or was read with something assumed.
    pub notes: Vec<MeshNote>,
}

/// What a node or an element is called: its number, and the instance that it is in.
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
    /// What it is made of.
    pub kind: SurfaceKind,
}

/// What a surface is made of.
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
    /// Which face of which element each is.
    pub elements: Vec<(MeshNode, FaceLabel)>,
    /// The space the elements are in; the same for all.
    pub space: ElementSpace,
    /// The thickness of plane elements and of sheets (L), from their section; `None` where no section says one.
    pub thickness: Vec<Option<f64>>,
    /// How far the side of a sheet lies from its nodes, along its normal (L); 0 for solids.
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
    /// Where it stands.
    pub span: Span,
    /// What it is, for a person.
    pub message: String,
}

/// Reads the mesh around the contact pairs of a model.
///
/// # Errors
///
/// Where bytes cannot be read. What is wrong with the deck is in [`Mesh::notes`].
pub fn read(deck: &Deck, grammar: &Grammar, model: &Model, rows: &mut dyn RowBytes) -> io::Result<Mesh> {
    reader::Reader::new(deck, grammar, rows).read(model)
}
