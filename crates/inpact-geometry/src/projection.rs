//! Projection of a point onto the master surface: clearance, face, weights.
//!
//! The closest point of the master's faces decides.
//! Inside a face, and at an edge or corner where faces meet, the point lies on the master's normal (at an edge or corner: on one of the directions between the
//! normals of the faces that meet), and the clearance is the distance, positive on the side that the normals point to.
//! Beyond the outer edge of the master the clearance is measured along the normal of the nearest face, and `overhang` is the distance of the point from that normal.

use crate::closest::Closest;
use crate::normal::{longest_edge, node_normal};
use crate::search::Master;
use crate::spread;
use crate::vector::{add, dot, norm, scale, sub, unit};
use crate::{FaceId, FaceShape, NodeId, Point, Vector};

/// The distance from an edge, in ξ and η, within which a closest point is on it.
const ON_EDGE: f64 = 1e-12;

/// The maximum distance beyond the outer edge of the master at which a point still projects onto it, as a fraction of the longest edge of the nearest face: the length by which Abaqus
/// extends the edges of a master surface, unless *CONTACT PAIR, EXTENSION ZONE gives another.
pub const DEFAULT_EXTENSION: f64 = 0.1;

/// Projection of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Projection {
    /// The face of the master that is closest.
    pub face: FaceId,
    /// The point in the face's natural coordinates ξ and η.
    pub place: [f64; 2],
    /// The point in space (L).
    pub point: Point,
    /// The distance to it (L), never negative.
    pub distance: f64,
    /// The distance along the master's normal (L): positive where open, negative where the point is inside the master.
    pub clearance: f64,
    /// The master's unit normal there; zero where its faces have none.
    pub normal: Vector,
    /// The distance of the point beyond the master's outer edge (L); 0 within.
    pub overhang: f64,
    /// Whether the point projects onto the master: the overhang is at most the extension times the longest edge of the face.
    pub projects: bool,
}

impl Projection {
    /// The interpolation weights of the nodes of a face at this point, in the face's order. They sum to 1, to rounding.
    pub fn weights(&self, shape: FaceShape) -> Vec<f64> {
        shape.weights(self.place)
    }
}

impl Master<'_> {
    /// The projection of a point; `None` where the master has no face or a coordinate of the point is not finite. `extension` is a fraction of an edge, by default [`DEFAULT_EXTENSION`].
    ///
    /// ```
    /// use inpact_geometry::{DEFAULT_EXTENSION, Face, FaceShape, Master, NodeId, Placed, Surface};
    /// let nodes = [0, 1, 2, 3].map(NodeId);
    /// let surface = Surface::new([Face { shape: FaceShape::Quadrilateral4, nodes: &nodes }])?;
    /// let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    /// let master = Master::new(Placed::new(&surface, &points)?);
    /// let above = master.project([0.5, 0.5, 0.25], DEFAULT_EXTENSION).expect("a face");
    /// assert_eq!((above.clearance, above.projects), (0.25, true));
    /// assert_eq!(above.weights(FaceShape::Quadrilateral4), [0.25; 4]);
    /// let beside = master.project([1.5, 0.5, -0.25], DEFAULT_EXTENSION).expect("a face");
    /// assert_eq!((beside.clearance, beside.overhang, beside.projects), (-0.25, 0.5, false));
    /// # Ok::<(), inpact_geometry::Error>(())
    /// ```
    pub fn project(&self, point: Point, extension: f64) -> Option<Projection> {
        let (face, closest) = self.closest(point)?;
        let Closest { place, point: on_master, distance } = closest;
        let away = sub(point, on_master);
        let shape = self.placed().surface().face(face).shape;
        let (rough, outer) = match Spot::of(shape, place) {
            Spot::Inside => (self.placed().patch(face).normal(place), false),
            Spot::Edge(edge) => self.at_edge(face, edge, place, on_master),
            Spot::Corner(corner) => self.at_corner(face, corner),
        };
        let rough = rough.unwrap_or([0.0; 3]);
        let along = dot(away, rough);
        let (clearance, normal, overhang) = if outer {
            (along, rough, norm(sub(away, scale(along, rough))))
        } else {
            // Below the rounding of coordinates, the direction between the two is meaningless.
            let direction = unit(away).filter(|_| 1e-9 * longest_edge(self.placed(), face) < distance);
            let side = if along < 0.0 { -1.0 } else { 1.0 };
            (side * distance, direction.map_or(rough, |direction| scale(side, direction)), 0.0)
        };
        let projects = overhang <= extension * longest_edge(self.placed(), face);
        Some(Projection { face, place, point: on_master, distance, clearance, normal, overhang, projects })
    }

    /// The same for many points, on all threads where feature `threads` is on; the results do not depend on their number.
    pub fn project_all(&self, points: &[Point], extension: f64) -> Vec<Option<Projection>> {
        spread::map(points, |point| self.project(*point, extension))
    }

    /// The sum of the normals of both faces at an edge, and whether the edge is an outer one.
    fn at_edge(&self, face: FaceId, edge: usize, place: [f64; 2], point: Point) -> (Option<Vector>, bool) {
        let own = self.placed().patch(face).normal(place);
        let Some(other) = self.placed().surface().across(face, edge) else { return (own, true) };
        let other = self.placed().patch(other);
        let across = other.normal(other.closest(point).place);
        let both = match (own, across) {
            (Some(own), Some(across)) => unit(add(own, across)),
            (own, across) => own.or(across),
        };
        (both, false)
    }

    /// The averaged normal at a corner, and whether the surface ends there.
    fn at_corner(&self, face: FaceId, corner: usize) -> (Option<Vector>, bool) {
        let surface = self.placed().surface();
        let node = surface.face(face).nodes[corner];
        (node_normal(self.placed(), node), surface.faces_at(node).iter().any(|around| self.ends_at(*around, node)))
    }

    /// Whether an edge of the face at the node is an outer one.
    fn ends_at(&self, face: FaceId, node: NodeId) -> bool {
        let surface = self.placed().surface();
        let nodes = surface.face(face).nodes;
        let n = surface.face(face).shape.corners();
        let is_line = surface.is_line();
        let touches = |edge: usize| nodes[edge] == node || (!is_line && nodes[(edge + 1) % n] == node);
        // An edge with equal ends is collapsed: it has no neighbour, and is not an outer edge.
        let folded = |edge: usize| !is_line && nodes[edge] == nodes[(edge + 1) % n];
        (0..n).any(|edge| touches(edge) && !folded(edge) && surface.across(face, edge).is_none())
    }
}

/// The part of a face that contains a point: inside, edge or corner.
enum Spot {
    Inside,
    Edge(usize),
    Corner(usize),
}

impl Spot {
    fn of(shape: FaceShape, [x, y]: [f64; 2]) -> Self {
        // The distance of each edge, in the order of edges.
        let edges: &[f64] = match shape.corners() {
            2 => &[1.0 + x, 1.0 - x],
            3 => &[y, 1.0 - x - y, x],
            _ => &[1.0 + y, 1.0 - x, 1.0 - y, 1.0 + x],
        };
        let on: Vec<usize> = (0..edges.len()).filter(|edge| edges[*edge] <= ON_EDGE).collect();
        match on[..] {
            [] => Self::Inside,
            [edge] => Self::Edge(edge),
            // A corner lies between the previous edge and the edge of its own number.
            [first, second] => Self::Corner(if first == 0 && second + 1 == edges.len() { 0 } else { second }),
            _ => unreachable!("a place on three edges"),
        }
    }
}
