//! Surfaces: from the rows of *SURFACE to faces and nodes of the mesh.

use super::elements::{Pick, RawFace};
use super::layout::{Entry, Gives};
use super::located::Located;
use super::reader::{Context, Reader};
use super::rows::data_lines;
use super::sections::Section;
use super::selected::{Kind, Selection};
use super::{FaceSurface, MeshNode, MeshSurface, NodeSurface, SurfaceKind};
use crate::deck::items;
use crate::model::Reference;
use crate::number::read_float;
use crate::span::Span;
use inpact_geometry::{ElementSpace, Face, FaceLabel, NodeId, Surface, sheet_shift};
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// The selections of the rows of all surfaces.
#[derive(Debug, Default)]
pub(super) struct Picks {
    pub(super) faces: Vec<Pick>,
    pub(super) nodes: Vec<NodePick>,
}

/// The nodes selected by a row of *SURFACE, TYPE=NODE in one instance.
#[derive(Debug)]
pub(super) struct NodePick {
    pub(super) surface: usize,
    pub(super) instance: usize,
    pub(super) nodes: Selection,
    /// The number, if there is only one.
    pub(super) number: Option<u32>,
    area: Option<f64>,
    span: Span,
}

/// A located surface: its keyword line and its content.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) span: Span,
    pub(super) of_nodes: bool,
}

impl<'deck> Reader<'deck, '_> {
    /// Looks a surface up and reads its rows.
    pub(super) fn pick_surface(
        &mut self,
        surface: usize,
        reference: &Reference,
        picks: &mut Picks,
    ) -> io::Result<Option<Found>> {
        let Some((context, entry)) = self.find_surface(reference) else {
            self.note(
                reference.span,
                format!("the surface `{}` is not defined here, so that its pairs were not read", reference.name),
            );
            return Ok(None);
        };
        let span = entry.span();
        let kind = entry.choice("TYPE").unwrap_or_else(|| "ELEMENT".to_owned());
        let is_made_of_others = entry.parameter("COMBINE").is_some() || entry.parameter("CROP").is_some();
        if !["ELEMENT", "NODE"].contains(&kind.as_str()) || is_made_of_others {
            let what = if is_made_of_others { "combined or cropped".to_owned() } else { format!("of type {kind}") };
            self.note(
                span,
                format!(
                    "surfaces that are {what} are not read, so that the pairs of `{}` were not read",
                    reference.name
                ),
            );
            return Ok(None);
        }
        let mut rows: Vec<(Vec<String>, Span)> = Vec::new();
        data_lines(&mut *self.rows, entry.block, &mut |line, span| {
            rows.push((items(line).map(|item| String::from_utf8_lossy(&line[item]).into_owned()).collect(), span));
        })?;
        let of_nodes = kind == "NODE";
        for (row, span) in rows {
            let first = row.first().map_or("", String::as_str);
            let second = row.get(1).map(String::as_str).filter(|item| !item.is_empty());
            if first.is_empty() {
                self.note(
                    span,
                    "a row of *SURFACE that names neither an element, a node nor a set is not read".to_owned(),
                );
            } else if of_nodes {
                self.pick_nodes(surface, context, (first, second), span, picks)?;
            } else {
                self.pick_faces(surface, context, (first, second), span, picks)?;
            }
        }
        Ok(Some(Found { span, of_nodes }))
    }

    pub(super) fn find_surface(&self, reference: &Reference) -> Option<(Context, Entry<'deck>)> {
        let (context, name) = self.without_prefix(Context::Top, reference.name.clone());
        let mut surfaces = self.chain(context).flat_map(|definitions| definitions.called(Gives::Surface, &name));
        surfaces.next().map(|entry| (context, *entry))
    }

    pub(super) fn pick_faces(
        &mut self,
        surface: usize,
        context: Context,
        (first, second): (&str, Option<&str>),
        span: Span,
        picks: &mut Picks,
    ) -> io::Result<()> {
        let face = match second.map(str::parse::<FaceLabel>) {
            None => None,
            Some(Ok(label)) => Some(label),
            Some(Err(expected)) => {
                self.note(span, format!("{expected}, found `{}`; the row was not read", second.unwrap_or("")));
                return Ok(());
            }
        };
        for (instance, elements) in self.select(Kind::Elements, context, first, span)? {
            // Rows of one surface that select the same face are one selection, of any number of elements.
            let of_surface = picks.faces.iter_mut().rev().take_while(|pick| pick.surface == surface);
            match of_surface.into_iter().find(|pick| pick.instance == instance && pick.face == face) {
                Some(pick) => pick.elements.add_all(&elements),
                None => picks.faces.push(Pick { surface, instance, elements, face, span }),
            }
        }
        Ok(())
    }

    pub(super) fn pick_nodes(
        &mut self,
        surface: usize,
        context: Context,
        (first, second): (&str, Option<&str>),
        span: Span,
        picks: &mut Picks,
    ) -> io::Result<()> {
        let area = second.map(|text| read_float(text.as_bytes()));
        if let Some(Err(_)) = area {
            self.note(span, format!("expected an area, found `{}`, which was not read", second.unwrap_or("")));
        }
        let area = area.and_then(Result::ok);
        for (instance, nodes) in self.select(Kind::Nodes, context, first, span)? {
            picks.nodes.push(NodePick { surface, instance, number: nodes.single(), nodes, area, span });
        }
        Ok(())
    }

    /// Builds a surface from the located parts.
    pub(super) fn surface<'a>(
        &mut self,
        reference: Reference,
        found: Option<Found>,
        faces: &[RawFace],
        node_picks: impl Iterator<Item = (&'a NodePick, &'a Vec<u32>)>,
        located: &Located,
    ) -> io::Result<Option<MeshSurface>> {
        let Some(Found { span, of_nodes }) = found else { return Ok(None) };
        let kind = if of_nodes {
            Some(SurfaceKind::Nodes(self.node_surface(node_picks, located)))
        } else {
            self.face_surface(span, faces, located)?.map(SurfaceKind::Faces)
        };
        Ok(kind.map(|kind| MeshSurface { name: reference.name, span, kind }))
    }

    /// The nodes of selections with the numbers of each.
    fn node_surface<'a>(
        &mut self,
        picks: impl Iterator<Item = (&'a NodePick, &'a Vec<u32>)>,
        located: &Located,
    ) -> NodeSurface {
        let mut areas: BTreeMap<NodeId, Option<f64>> = BTreeMap::new();
        for (pick, labels) in picks {
            let known: Vec<NodeId> = labels.iter().filter_map(|label| located.id(pick.instance, *label)).collect();
            if known.is_empty() {
                self.note(pick.span, "no node of this row was found".to_owned());
            }
            areas.extend(known.into_iter().map(|node| (node, pick.area)));
        }
        let (nodes, areas) = areas.into_iter().unzip();
        NodeSurface { nodes, areas }
    }

    fn face_surface(&mut self, span: Span, faces: &[RawFace], located: &Located) -> io::Result<Option<FaceSurface>> {
        let Some(first) = faces.first() else {
            self.note(span, "no face of this surface was found, so that its pairs were not read".to_owned());
            return Ok(None);
        };
        let space = first.kind.space;
        let mut kept: Vec<&RawFace> = Vec::with_capacity(faces.len());
        // The concatenated nodes of the kept faces.
        let mut nodes_of_kept: Vec<NodeId> = Vec::new();
        let mut without_node: Vec<(Span, String)> = Vec::new();
        let mut of_another_space: Vec<(Span, String)> = Vec::new();
        for face in faces {
            let nodes = || face.nodes().iter().map(|node| located.id(face.instance, *node));
            match nodes().find(Option::is_none) {
                Some(_) => without_node.push((
                    span,
                    format!(
                        "face {} of element {} has a node that was not found{}",
                        face.label,
                        face.element,
                        self.makers(face.instance)
                    ),
                )),
                None if face.kind.space != space => {
                    of_another_space.push((
                        span,
                        format!(
                            "face {} of element {} is in another space than the first of the surface",
                            face.label, face.element
                        ),
                    ));
                }
                None => {
                    kept.push(face);
                    nodes_of_kept.extend(nodes().flatten());
                }
            }
        }
        self.note_first(without_node, "and was left out");
        self.note_first(of_another_space, "and was left out");
        let mut nodes = &nodes_of_kept[..];
        let surface = Surface::new(kept.iter().map(|face| {
            let (of_face, behind) = nodes.split_at(face.shape.nodes());
            nodes = behind;
            Face { shape: face.shape, nodes: of_face }
        }));
        drop(nodes_of_kept);
        let surface = match surface {
            Ok(surface) => surface,
            Err(error) => {
                self.note(span, format!("{error}, so that its pairs were not read"));
                return Ok(None);
            }
        };
        let mut sections: BTreeMap<usize, Vec<Section>> = BTreeMap::new();
        let instances: BTreeSet<usize> =
            kept.iter().filter(|face| face.needs_section()).map(|face| face.instance).collect();
        for instance in instances {
            let of_body = self.sections(instance)?;
            sections.insert(instance, of_body);
        }
        let section = |face: &RawFace| {
            sections.get(&face.instance).and_then(|of_body| of_body.iter().rev().find(|section| section.holds(face)))
        };
        let thickness: Vec<Option<f64>> =
            kept.iter().map(|face| section(face).and_then(|section| section.thickness)).collect();
        let shift = |face: &RawFace| {
            section(face)
                .map_or(0.0, |section| sheet_shift(face.label, section.thickness.unwrap_or(0.0), section.offset))
        };
        let shifts = kept.iter().map(|face| if face.kind.shape.is_sheet() { shift(face) } else { 0.0 }).collect();
        let without_thickness =
            kept.iter().zip(&thickness).filter(|(face, thickness)| face.needs_section() && thickness.is_none()).count();
        if 0 < without_thickness && space != ElementSpace::Axisymmetric {
            self.note(span, format!("no section gives a thickness to {without_thickness} faces of this surface"));
        }
        let element = |face: &RawFace| {
            (MeshNode { instance: self.instances[face.instance].name.clone(), label: face.element }, face.label)
        };
        let elements = kept.iter().map(|face| element(face)).collect();
        Ok(Some(FaceSurface { surface, elements, space, thickness, shifts }))
    }
}
