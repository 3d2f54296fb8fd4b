//! Maps labels of a result file to nodes of the mesh.
//!
//! In a deck without instances labels are those of the deck; the coordinates in the file confirm them where it has any.
//! A deck with instances has a label several times, and Abaqus renumbers its nodes: there coordinates identify them, else the instance that a report names, else the
//! slave surface of the pair that a value belongs to.
//! Coincident nodes, of which touching surfaces with matching meshes have many, are distinguished by the surfaces of the file.

use crate::Error;
use inpact_geometry::{NodeId, Point};
use inpact_parser::mesh::{Mesh, SurfaceKind};
use inpact_results::{Field, Format, Frame, Region, Results, Rows};
use std::collections::{BTreeSet, HashMap, HashSet};
use std::fmt;

/// Methods of matching the nodes of a file with the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MatchedBy {
    /// By their labels.
    Labels,
    /// By instance and label.
    InstancesAndLabels,
    /// By their coordinates.
    Coordinates,
}

impl fmt::Display for MatchedBy {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Labels => "labels",
            Self::InstancesAndLabels => "instances and labels",
            Self::Coordinates => "coordinates",
        })
    }
}

/// The nodes of a mesh by the labels of a file.
#[derive(Debug)]
pub(super) enum NodeMap {
    /// A label is a node.
    Labels(HashMap<i64, NodeId>, MatchedBy),
    /// A label is a node of an instance.
    Instances {
        instances: Vec<(String, HashMap<i64, NodeId>)>,
        /// The labels of the slave nodes of each pair; `None` for a label that several of its nodes have.
        slaves: Vec<HashMap<i64, Option<NodeId>>>,
    },
}

impl NodeMap {
    /// The reading of the labels of a file, with notes on it; an error where its nodes are not those of the mesh.
    ///
    /// `surfaces` is called where coincident nodes must be distinguished.
    pub(super) fn new<E: From<Error>>(
        mesh: &Mesh,
        results: &Results,
        surfaces: impl FnOnce() -> Result<FileSurfaces, E>,
        failed: impl Fn(String) -> Error,
    ) -> Result<(Self, Vec<String>), E> {
        let instances = mesh.nodes.iter().any(|node| node.instance.is_some());
        let coordinates = results.coordinates.as_ref().and_then(|field| Places::of(field, results.format, mesh));
        let by_label = || by_labels(mesh.nodes.iter().map(|node| i64::from(node.label)));
        match coordinates {
            None if instances => Ok((Self::of_instances(mesh), Vec::new())),
            None => Ok((Self::Labels(by_label(), MatchedBy::Labels), Vec::new())),
            Some(places) if instances => {
                let (nodes, notes) = places.nodes(surfaces)?;
                if nodes.is_empty() {
                    let message = "none of its nodes is at the place of a node of a contact surface: it is of another mesh, or of a deformed one";
                    return Err(failed(message.to_owned()).into());
                }
                Ok((Self::Labels(nodes, MatchedBy::Coordinates), notes))
            }
            Some(places) => {
                let labels = by_label();
                let Some(contradiction) = places.contradiction(&labels) else {
                    return Ok((Self::Labels(labels, MatchedBy::Labels), Vec::new()));
                };
                let (nodes, mut notes) = places.nodes(surfaces)?;
                // Some nodes of another mesh may coincide with nodes of this one.
                if 2 * nodes.len() < mesh.nodes.len() {
                    let (found, all) = (nodes.len(), mesh.nodes.len());
                    let message = format!(
                        "{contradiction}, and only {found} of {all} nodes of contact surfaces are at the place of one of its nodes: it is of another mesh"
                    );
                    return Err(failed(message).into());
                }
                notes.insert(0, format!("{contradiction}: nodes are found by their coordinates"));
                Ok((Self::Labels(nodes, MatchedBy::Coordinates), notes))
            }
        }
    }

    fn of_instances(mesh: &Mesh) -> Self {
        let mut instances: Vec<(String, HashMap<i64, NodeId>)> = Vec::new();
        for (id, node) in ids().zip(&mesh.nodes) {
            let name = node.instance.as_ref().map_or_else(String::new, |name| plain(name.canonical()));
            let at = instances.iter().rposition(|(known, _)| *known == name).unwrap_or_else(|| {
                instances.push((name, HashMap::new()));
                instances.len() - 1
            });
            instances[at].1.insert(i64::from(node.label), id);
        }
        let slaves = mesh.pairs.iter().map(|pair| {
            let mut labels = HashMap::new();
            for node in nodes_of(&mesh.surfaces[pair.slave].kind) {
                let label = i64::from(mesh.nodes[node.index()].label);
                labels.entry(label).and_modify(|known| *known = None).or_insert(Some(node));
            }
            labels
        });
        let slaves = slaves.collect();
        Self::Instances { instances, slaves }
    }

    /// The node of a label in a region, for a value of this pair; `None` where it is none of a contact surface, or could be several.
    pub(super) fn node(&self, region: &Region, pair: Option<usize>, label: i64) -> Option<NodeId> {
        match self {
            Self::Labels(nodes, _) => nodes.get(&label).copied(),
            Self::Instances { instances, slaves } => {
                let named = region.set.as_ref().and_then(|set| {
                    let set = plain(set);
                    instances.iter().find(|(name, _)| ends_with_name(&set, name))
                });
                if let Some((_, nodes)) = named {
                    return nodes.get(&label).copied();
                }
                if let [(_, only)] = instances.as_slice() {
                    return only.get(&label).copied();
                }
                slaves.get(pair?)?.get(&label).copied().flatten()
            }
        }
    }

    pub(super) fn matched_by(&self) -> MatchedBy {
        match self {
            Self::Labels(_, by) => *by,
            Self::Instances { .. } => MatchedBy::InstancesAndLabels,
        }
    }

    /// Notes the number of nodes of contact surfaces without values in a file.
    pub(super) fn without(&self, mesh: &Mesh, used: &BTreeSet<NodeId>) -> Option<String> {
        let mut without = ids().take(mesh.nodes.len()).filter(|node| !used.contains(node));
        let first = &mesh.nodes[without.next()?.index()];
        let (count, all) = (1 + without.count(), mesh.nodes.len());
        let hint = match self {
            Self::Instances { instances, .. } if 1 < instances.len() => {
                "; labels are distinguished by the instance that a report names, or by coordinates in the file"
            }
            _ => "",
        };
        Some(format!("nothing is said of {count} of {all} nodes of contact surfaces, the first of them {first}{hint}"))
    }
}

/// The numbers of the nodes of a mesh, in their order.
fn ids() -> impl Iterator<Item = NodeId> {
    (0..=u32::MAX).map(NodeId)
}

fn by_labels(labels: impl Iterator<Item = i64>) -> HashMap<i64, NodeId> {
    labels.zip(ids()).collect()
}

/// A name in the spelling of result files.
pub(super) fn plain(name: &str) -> String {
    name.to_ascii_uppercase().replace('.', "_").replace('"', "")
}

/// Whether a name in a result file is a name of the deck, alone or with the assembly and the instance before it; both as [`plain`] writes them.
pub(super) fn ends_with_name(file: &str, deck: &str) -> bool {
    file.strip_suffix(deck).is_some_and(|before| before.is_empty() || before.ends_with('_'))
}

/// The nodes of a surface.
pub(super) fn nodes_of(kind: &SurfaceKind) -> Vec<NodeId> {
    match kind {
        SurfaceKind::Faces(faces) => faces.surface.nodes().to_vec(),
        SurfaceKind::Nodes(nodes) => nodes.nodes.clone(),
    }
}

/// The positions of the nodes of a file, compared with a mesh.
struct Places<'a> {
    mesh: &'a Mesh,
    labels: &'a [i64],
    points: Vec<Point>,
    /// The relative difference of coordinates because of their digits.
    relative: f64,
    /// The same whatever its size (L).
    absolute: f64,
}

impl<'a> Places<'a> {
    fn of(field: &'a Field, format: Format, mesh: &'a Mesh) -> Option<Self> {
        let labels = field.rows.nodes().filter(|labels| !labels.is_empty())?;
        let component = |at: usize| field.columns.get(at).map(|column| column.values.as_slice());
        let [x, y, z] = [0, 1, 2].map(component);
        let of = |values: Option<&[f64]>, row: usize| {
            let value = values.and_then(|values| values.get(row)).copied().unwrap_or(0.0);
            if value.is_nan() { 0.0 } else { value }
        };
        let points = (0..labels.len()).map(|row| [x, y, z].map(|values| of(values, row))).collect();
        // Six digits in .frd, single precision in pictures.
        let relative = match format {
            Format::Frd => 1e-5,
            Format::Vtu => 1e-6,
            _ => 1e-12,
        };
        let extent = mesh.points.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
        Some(Self { mesh, labels, points, relative, absolute: 1e-9 * extent })
    }

    fn tolerance(&self, value: f64) -> f64 {
        self.relative * value.abs() + self.absolute
    }

    fn is_at(&self, point: Point, other: Point) -> bool {
        (0..3).all(|k| (point[k] - other[k]).abs() <= self.tolerance(point[k]))
    }

    /// The reason why the labels are not those of the mesh: a node with other coordinates in the file.
    fn contradiction(&self, nodes: &HashMap<i64, NodeId>) -> Option<String> {
        // Nodes moved by ADJUST are not at their coordinates in the deck.
        let adjusted = self.mesh.pairs.iter().filter(|pair| pair.adjust.is_some());
        let adjusted: HashSet<NodeId> =
            adjusted.flat_map(|pair| nodes_of(&self.mesh.surfaces[pair.slave].kind)).collect();
        let mut found = 0;
        for (label, place) in self.labels.iter().zip(&self.points) {
            let Some(node) = nodes.get(label) else { continue };
            let point = self.mesh.points[node.index()];
            found += 1;
            if !self.is_at(point, *place) && !adjusted.contains(node) {
                return Some(format!("node {label} is at {} there and at {} in the deck", shown(*place), shown(point)));
            }
        }
        (found == 0).then(|| "none of its labels is that of a node of a contact surface".to_owned())
    }

    /// The nodes of the mesh by label, and those that could not be distinguished.
    fn nodes<E>(
        &self,
        surfaces: impl FnOnce() -> Result<FileSurfaces, E>,
    ) -> Result<(HashMap<i64, NodeId>, Vec<String>), E> {
        let mut candidates = self.candidates();
        let are_several = candidates.iter().any(|labels| 1 < labels.len());
        let surfaces = if are_several { surfaces()? } else { FileSurfaces::default() };
        let of_mesh = surfaces_of_nodes(self.mesh);
        for (node, labels) in candidates.iter_mut().enumerate().filter(|(_, labels)| 1 < labels.len()) {
            let on_surface: Vec<i64> =
                labels.iter().copied().filter(|label| surfaces.has(&of_mesh[node], *label)).collect();
            if !on_surface.is_empty() {
                *labels = on_surface;
            }
        }
        // The unique label of a node is excluded for others.
        loop {
            let certain: HashSet<i64> =
                candidates.iter().filter(|labels| labels.len() == 1).map(|labels| labels[0]).collect();
            let mut changed = false;
            for labels in candidates.iter_mut().filter(|labels| 1 < labels.len()) {
                let before = labels.len();
                labels.retain(|label| !certain.contains(label));
                changed |= labels.len() != before;
            }
            if !changed {
                break;
            }
        }
        let mut nodes: HashMap<i64, Option<NodeId>> = HashMap::new();
        for (id, labels) in ids().zip(&candidates) {
            if let [label] = labels.as_slice() {
                nodes.entry(*label).and_modify(|known| *known = None).or_insert(Some(id));
            }
        }
        let shared = nodes.values().filter(|node| node.is_none()).count();
        let several = candidates.iter().filter(|labels| 1 < labels.len()).count();
        let mut notes = Vec::new();
        if 0 < shared + several {
            let first = candidates.iter().position(|labels| match labels.as_slice() {
                [label] => nodes.get(label).is_some_and(Option::is_none),
                labels => 1 < labels.len(),
            });
            let first = first.map_or_else(String::new, |node| self.mesh.nodes[node].to_string());
            notes.push(format!(
                "nodes at one place could not be distinguished, the first of them {first}: their values are not used (surfaces in the file distinguish them: *CONTACT FILE)"
            ));
        }
        Ok((nodes.into_iter().filter_map(|(label, node)| Some((label, node?))).collect(), notes))
    }

    /// For each node of the mesh the labels of the file at its place.
    fn candidates(&self) -> Vec<Vec<i64>> {
        let largest = self.mesh.points.iter().flatten().fold(0.0, |most: f64, value| most.max(self.tolerance(*value)));
        // Wide enough that few points are near the boundary of their cell.
        let width = if 0.0 < largest { 16.0 * largest } else { 1.0 };
        let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
        for (node, point) in self.mesh.points.iter().enumerate() {
            cells.entry(point.map(|value| cell(value, width))).or_default().push(node);
        }
        let mut candidates = vec![Vec::new(); self.mesh.points.len()];
        for (label, point) in self.labels.iter().zip(&self.points) {
            let [x, y, z] = point.map(|value| {
                let reach = 2.0 * self.tolerance(value);
                cell(value - reach, width)..=cell(value + reach, width)
            });
            for i in x {
                for j in y.clone() {
                    for k in z.clone() {
                        for node in cells.get(&[i, j, k]).into_iter().flatten() {
                            if self.is_at(self.mesh.points[*node], *point) && !candidates[*node].contains(label) {
                                candidates[*node].push(*label);
                            }
                        }
                    }
                }
            }
        }
        candidates
    }
}

#[expect(clippy::cast_possible_truncation, reason = "what is out of range is far from everything")]
fn cell(value: f64, width: f64) -> i64 {
    (value / width).floor() as i64
}

fn shown([x, y, z]: Point) -> String {
    format!("({x}, {y}, {z})")
}

/// The names of the surfaces that each node of the mesh is on.
fn surfaces_of_nodes(mesh: &Mesh) -> Vec<Vec<String>> {
    let mut names = vec![Vec::new(); mesh.nodes.len()];
    for surface in &mesh.surfaces {
        for node in nodes_of(&surface.kind) {
            names[node.index()].push(plain(surface.name.canonical()));
        }
    }
    names
}

/// The surfaces of a file by the labels of their nodes.
#[derive(Debug, Default)]
pub(super) struct FileSurfaces(HashMap<String, HashSet<i64>>);

impl FileSurfaces {
    /// The surfaces that a file gives by their faces.
    pub(super) fn of(results: &Results) -> Self {
        let mut surfaces = Self::default();
        for surface in &results.surfaces {
            let labels = surface.faces.iter().flat_map(|face| face.nodes.iter().copied());
            surfaces.0.entry(plain(&surface.name)).or_default().extend(labels);
        }
        surfaces
    }

    /// Adds the nodes at which a state has contact values.
    pub(super) fn take(&mut self, frame: &Frame) {
        for field in &frame.fields {
            if let (Some(slave), Rows::Nodes(labels)) = (&field.region.slave, &field.rows) {
                self.0.entry(plain(slave)).or_default().extend(labels);
            }
        }
    }

    /// Whether a label is on a surface of one of these names.
    fn has(&self, names: &[String], label: i64) -> bool {
        self.0.iter().any(|(file, labels)| {
            labels.contains(&label)
                && names.iter().any(|name| {
                    file == name || file.strip_suffix(name.as_str()).is_some_and(|before| before.ends_with('_'))
                })
        })
    }
}
