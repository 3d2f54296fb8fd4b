//! A contact pair in a state: the projection of each slave node, and the effect of ADJUST and small sliding on it.

use crate::Error;
use crate::state::State;
use crate::summary::PairSummary;
use inpact_geometry::{ContactNode, ErrorKind, NodeId, Point, Projection, Vector};
use inpact_parser::mesh::{AreasOf, Mesh, MeshPair, Sliding, SurfaceKind};
use std::borrow::Cow;

/// A pair with its initial state.
pub(crate) struct Pair<'a> {
    pub(crate) of: &'a MeshPair,
    /// Its position in [`Mesh::pairs`].
    pub(crate) index: usize,
    pub(crate) start: Vec<ContactNode>,
    /// The names of the rows of its nodes.
    pub(crate) names: Vec<String>,
    pub(crate) summary: PairSummary,
    thickness: f64,
    /// The displacements of ADJUST, applied at the start only.
    adjusted: Vec<(NodeId, Vector)>,
}

impl<'a> Pair<'a> {
    /// The pair at the beginning; `names` names its slave nodes.
    pub(crate) fn new(
        mesh: &'a Mesh,
        index: usize,
        thickness: f64,
        summary: PairSummary,
        names: impl FnMut(&ContactNode) -> String,
    ) -> Result<Self, Error> {
        let of = &mesh.pairs[index];
        let start = mesh.contact(of, thickness);
        let start = start.and_then(|start| Ok((start, adjusted(mesh, of, thickness)?)));
        let (start, adjusted) =
            start.map_err(|error| Error::geometry(&summary.slave, &summary.master, None, reason(mesh, &error)))?;
        let names = start.iter().map(names).collect();
        Ok(Self { of, index, start, names, summary, thickness, adjusted })
    }

    /// Whether the areas of its nodes are those of the start in every state.
    pub(crate) fn keeps_areas(&self) -> bool {
        self.of.sliding == Sliding::Small || self.of.areas_of == AreasOf::Start
    }

    /// The geometry in a state.
    pub(crate) fn contact(&self, mesh: &Mesh, state: &State) -> Result<Cow<'_, [ContactNode]>, Error> {
        let Some(moved) = &state.displacements else { return Ok(Cow::Borrowed(&self.start)) };
        let moved = &moved.vectors;
        if self.of.sliding == Sliding::Small {
            return Ok(Cow::Owned(self.slid(mesh, moved)));
        }
        let mut points: Vec<Point> = mesh.points.iter().zip(moved).map(|(point, moved)| add(*point, *moved)).collect();
        for (node, offset) in &self.adjusted {
            points[node.index()] = add(points[node.index()], *offset);
        }
        let contact = mesh.contact_at(&points, &without_start(self.of), self.thickness);
        let mut contact = contact.map_err(|error| {
            Error::geometry(&self.summary.slave, &self.summary.master, state.moment.time, reason(mesh, &error))
        })?;
        if self.of.areas_of == AreasOf::Start {
            for (node, start) in contact.iter_mut().zip(&self.start) {
                node.area = start.area;
            }
        }
        Ok(Cow::Owned(contact))
    }

    /// Small sliding: the initial projections and areas are kept.
    fn slid(&self, mesh: &Mesh, moved: &[Vector]) -> Vec<ContactNode> {
        let mut contact = self.start.clone();
        for node in &mut contact {
            let Some(across) = &mut node.across else { continue };
            let of_slave = moved[node.node.index()];
            let of_master = interpolated(mesh, self.of, across, |node| Some(moved[node.index()]));
            let along = of_master
                .map_or(f64::NAN, |of_master| (0..3).map(|k| (of_slave[k] - of_master[k]) * across.normal[k]).sum());
            across.clearance += along;
        }
        contact
    }
}

/// The displacements of slave nodes onto the master by ADJUST (L).
fn adjusted(mesh: &Mesh, pair: &MeshPair, thickness: f64) -> Result<Vec<(NodeId, Vector)>, inpact_geometry::Error> {
    let (Some(within), None) = (pair.adjust, pair.clearance) else { return Ok(Vec::new()) };
    let contact = mesh.contact(&without_start(pair), thickness)?;
    let way = |node: ContactNode| {
        let across = node.across.filter(|across| across.clearance <= within)?;
        Some((node.node, across.normal.map(|component| -across.clearance * component)))
    };
    Ok(contact.into_iter().filter_map(way).collect())
}

/// The pair without options that apply at the start only.
fn without_start(pair: &MeshPair) -> MeshPair {
    MeshPair { adjust: None, clearance: None, ..pair.clone() }
}

fn add(point: Point, way: Vector) -> Point {
    [0, 1, 2].map(|k| point[k] + way[k])
}

/// The projection of a slave node, where it projects.
pub(crate) fn across(node: &ContactNode) -> Option<&Projection> {
    node.across.as_ref().filter(|across| across.projects)
}

/// A field of the master at the projected point; `None` where a node with a weight has no value.
pub(crate) fn interpolated<const N: usize>(
    mesh: &Mesh,
    pair: &MeshPair,
    across: &Projection,
    value: impl Fn(NodeId) -> Option<[f64; N]>,
) -> Option<[f64; N]> {
    let SurfaceKind::Faces(master) = &mesh.surfaces[pair.master].kind else { return None };
    let face = master.surface.face(across.face);
    let mut sum = [0.0; N];
    let nodes: Vec<(NodeId, f64)> =
        face.nodes.iter().copied().zip(across.weights(face.shape)).filter(|(_, weight)| *weight != 0.0).collect();
    let first = value(nodes.first()?.0)?;
    // By differences from one node, so that a constant field is reproduced exactly.
    for (node, weight) in nodes {
        let value = value(node)?;
        for k in 0..N {
            sum[k] += weight * (value[k] - first[k]);
        }
    }
    for k in 0..N {
        sum[k] += first[k];
    }
    Some(sum)
}

/// The fault of a geometry, with the nodes by their names.
fn reason(mesh: &Mesh, error: &inpact_geometry::Error) -> String {
    let name = |node: &NodeId| mesh.nodes.get(node.index()).map_or_else(String::new, ToString::to_string);
    match error.kind() {
        ErrorKind::Coordinate { node, coordinate } => {
            format!("node {} has the coordinate {coordinate:?}, whose square is no finite number", name(node))
        }
        ErrorKind::Radius { node, radius } => {
            format!("node {} of an axisymmetric surface has the radius {radius:?}, which is negative", name(node))
        }
        other => other.to_string(),
    }
}
