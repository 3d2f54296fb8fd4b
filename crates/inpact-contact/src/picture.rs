//! The slave surfaces of all pairs, to be drawn: one point per row of a state, in the order of the rows.

use crate::pair::Pair;
use crate::state::State;
use inpact_geometry::{NodeId, Point};
use inpact_parser::mesh::{Mesh, SurfaceKind};
use inpact_results::vtu::{Array, Cell, Grid, Space};
use std::collections::HashMap;

/// The slave surfaces of the pairs that have rows.
#[derive(Debug, Clone, Default)]
pub struct SlaveFaces {
    nodes: Vec<NodeId>,
    /// The names of the rows of the points.
    names: Vec<String>,
    /// The pairs of the points, by their positions among those of the mesh.
    of_mesh: Vec<usize>,
    /// Where the points are in the undeformed mesh (L).
    points: Vec<Point>,
    cells: Vec<Cell>,
    /// The labels of the nodes, and the pair of each point, counted from 1.
    labels: Vec<i64>,
    pairs: Vec<i64>,
    /// The labels of the elements of the cells, 0 for single nodes, and their pairs.
    elements: Vec<i64>,
    pairs_of_cells: Vec<i64>,
}

impl SlaveFaces {
    pub(crate) fn of(mesh: &Mesh, pairs: &[Pair<'_>]) -> Self {
        let mut faces = Self::default();
        for (number, pair) in (1..).zip(pairs) {
            let first = faces.nodes.len();
            let mut places: HashMap<NodeId, usize> = HashMap::new();
            faces.names.extend(pair.names.iter().cloned());
            for (at, node) in pair.start.iter().map(|node| node.node).enumerate() {
                faces.of_mesh.push(pair.index);
                places.insert(node, first + at);
                faces.nodes.push(node);
                faces.points.push(mesh.points[node.index()]);
                faces.labels.push(i64::from(mesh.nodes[node.index()].label));
                faces.pairs.push(number);
            }
            match &mesh.surfaces[pair.of.slave].kind {
                SurfaceKind::Faces(slave) => {
                    for (face, (element, _)) in slave.surface.faces().zip(&slave.elements) {
                        let face = slave.surface.face(face);
                        let points: Option<Vec<usize>> =
                            face.nodes.iter().map(|node| places.get(node).copied()).collect();
                        let Some(points) = points else { continue };
                        let space = if face.shape.is_line() { Space::Plane } else { Space::Solid };
                        faces.cells.push(Cell::face(points, space));
                        faces.elements.push(i64::from(element.label));
                        faces.pairs_of_cells.push(number);
                    }
                }
                SurfaceKind::Nodes(_) => {
                    for point in first..faces.nodes.len() {
                        faces.cells.push(Cell::face(vec![point], Space::Solid));
                        faces.elements.push(0);
                        faces.pairs_of_cells.push(number);
                    }
                }
            }
        }
        faces
    }

    /// The number of points: that of the rows of a state.
    pub fn points(&self) -> usize {
        self.nodes.len()
    }

    /// The rows of a state in order: the position of the pair among those of the mesh, the node, and the name of the row.
    pub fn rows(&self) -> impl Iterator<Item = (usize, NodeId, &str)> {
        let of_nodes = self.of_mesh.iter().zip(&self.nodes);
        of_nodes.zip(&self.names).map(|((&pair, &node), name)| (pair, node, name.as_str()))
    }

    /// The surfaces in a state, displaced, with columns as point data.
    ///
    /// In addition, points have the labels of their nodes, `node`, and the number of their pair, `pair`; cells have `element` and `pair`.
    pub fn grid(&self, state: &State, columns: Vec<Array>) -> Grid {
        let moved = state.displacements.as_ref().map(|moved| &moved.vectors);
        let place = |(node, point): (&NodeId, &Point)| {
            let way = moved.map_or([0.0; 3], |moved| moved[node.index()]);
            [0, 1, 2].map(|k| point[k] + way[k])
        };
        let mut point_data =
            vec![Array::integers("node", self.labels.clone()), Array::integers("pair", self.pairs.clone())];
        point_data.extend(columns);
        Grid {
            points: self.nodes.iter().zip(&self.points).map(place).collect(),
            cells: self.cells.clone(),
            point_data,
            cell_data: vec![
                Array::integers("element", self.elements.clone()),
                Array::integers("pair", self.pairs_of_cells.clone()),
            ],
            time: state.moment.time,
        }
    }
}
