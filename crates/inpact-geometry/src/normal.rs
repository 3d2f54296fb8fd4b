//! Averaged normals of a surface at its nodes.
//!
//! The normals of the faces around a node are weighted by the angle that each face has there (G. Thürmer, C. A. Wüthrich, Computing vertex normals from
//! polygonal facets, J. Graphics Tools 3, 1998), so that cutting a face in two changes nothing, and so that the sign of the distance from a corner is right
//! (J. A. Bærentzen, H. Aanæs, Signed distance computation using the angle weighted pseudonormal, IEEE Trans. Vis. Comput. Graph. 11, 2005).
//! Lines have no angle: theirs is the plain average.

use crate::coordinates::Placed;
use crate::vector::{add, cross, dot, norm, scale, sub, unit};
use crate::{FaceShape, NodeId, Vector};

/// The averaged unit normal at each node of the surface, in the order of [`Surface::nodes`](crate::Surface::nodes); `None` where faces have no area or their
/// normals cancel.
pub fn node_normals(placed: &Placed<'_>) -> Vec<Option<Vector>> {
    placed.surface().nodes().iter().map(|node| node_normal(placed, *node)).collect()
}

/// The averaged unit normal at one node.
pub(crate) fn node_normal(placed: &Placed<'_>, node: NodeId) -> Option<Vector> {
    let surface = placed.surface();
    let mut sum = [0.0; 3];
    for id in surface.faces_at(node) {
        let face = surface.face(*id);
        let patch = placed.patch(*id);
        for local in (0..face.nodes.len()).filter(|local| face.nodes[*local] == node) {
            let place = place_of(face.shape, local);
            let Some(normal) = patch.normal(place) else { continue };
            sum = add(sum, scale(angle(face.shape, local, patch.tangents(place)), normal));
        }
    }
    unit(sum)
}

/// The natural coordinates of a shape's node.
pub(crate) fn place_of(shape: FaceShape, local: usize) -> [f64; 2] {
    let corners = shape.corner_places();
    if let Some(place) = corners.get(local) {
        return *place;
    }
    let edge = local - corners.len();
    let (a, b) = (corners[edge], corners[(edge + 1) % corners.len()]);
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

/// The angle of a face at one of its nodes.
fn angle(shape: FaceShape, local: usize, [along, across]: [Vector; 2]) -> f64 {
    if shape.is_line() {
        return 1.0;
    }
    let corners = shape.corner_places();
    if corners.len() <= local {
        return std::f64::consts::PI;
    }
    let n = corners.len();
    let towards = |other: usize| {
        let (from, to) = (corners[local], corners[other]);
        add(scale(to[0] - from[0], along), scale(to[1] - from[1], across))
    };
    let (next, before) = (towards((local + 1) % n), towards((local + n - 1) % n));
    norm(cross(next, before)).atan2(dot(next, before))
}

/// The longest of a face's edges, from corner to corner (L).
pub(crate) fn longest_edge(placed: &Placed<'_>, id: crate::FaceId) -> f64 {
    let face = placed.surface().face(id);
    let corner = |i: usize| placed.points()[face.nodes[i % face.shape.corners()].index()];
    (0..face.shape.corners()).map(|i| norm(sub(corner(i + 1), corner(i)))).fold(0.0, f64::max)
}
