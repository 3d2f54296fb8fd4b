//! The areas of a surface's nodes.
//!
//! Two methods, by the discretisation of the contact pair:
//!
//! - node to surface: each face distributes its area to its nodes in equal shares (as CalculiX's areas of slave nodes, to every printed digit);
//! - surface to surface: a node of a first-order face has ∫ N dA, the integral of its shape function.
//!
//! On second-order faces ∫ N dA is negative or zero at corners (−A/12 on a flat eight-node face, 0 on a six-node one), which cannot serve as an area that a current
//! flows through. There the diagonal ∫ N² dA is scaled to the area of the face instead (E. Hinton, T. Rock, O. C. Zienkiewicz, A note on mass lumping and
//! related processes in the finite element method, Earthquake Eng. Struct. Dyn. 4, 1976): always positive, the same total, and on a straight segment with its
//! node in the middle the same as ∫ N ds. How Abaqus distributes the area of second-order faces is not documented.

use crate::coordinates::Placed;
use crate::face_shape::{MAX_NODES, evaluate, monomials};
use crate::quadrature::rule;
use crate::vector::norm;
use crate::{Error, ErrorKind, Face, FaceId};

/// Sharing of a face's area among its nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shares {
    /// Equal shares: NODE TO SURFACE.
    Equal,
    /// By the shape functions: SURFACE TO SURFACE.
    ShapeFunctions,
}

/// The extent of a line face out of the plane, by which its length becomes an area.
#[derive(Clone, Copy, Debug)]
pub enum Extent<'a> {
    /// Faces are areas in space.
    Spatial,
    /// Faces are lines of a plane mesh, with one thickness (L) per face.
    Plane(&'a [f64]),
    /// Faces are lines of an axisymmetric mesh, whose axis is x = 0: 2πx times the length.
    Axisymmetric,
}

/// The area (L²) of each node of the surface, in the order of [`Surface::nodes`](crate::Surface::nodes).
///
/// Their sum is the area of the surface.
///
/// ```
/// use inpact_geometry::{Extent, Face, FaceShape, node_areas, NodeId, Placed, Shares, Surface};
/// let nodes = [0, 1, 2].map(NodeId);
/// let surface = Surface::new([Face { shape: FaceShape::Segment3, nodes: &nodes }])?;
/// let points = [[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
/// let placed = Placed::new(&surface, &points)?;
/// let areas = node_areas(&placed, Shares::ShapeFunctions, Extent::Plane(&[0.5]))?;
/// areas.iter().zip([0.5, 0.5, 2.0]).for_each(|(area, expected)| assert!((area - expected).abs() < 1e-14));
/// # Ok::<(), inpact_geometry::Error>(())
/// ```
///
/// # Errors
///
/// The extent does not suit the faces, there is not one thickness per face, or a radius is negative.
pub fn node_areas(placed: &Placed<'_>, shares: Shares, extent: Extent<'_>) -> Result<Vec<f64>, Error> {
    sum_over_faces(placed, extent, |parts, face| parts.shares(face, shares))
}

/// The area (L²) of each face.
///
/// # Errors
///
/// As [`node_areas`].
pub fn face_areas(placed: &Placed<'_>, extent: Extent<'_>) -> Result<Vec<f64>, Error> {
    suits(placed, extent)?;
    Ok(placed.surface().faces().map(|face| face_parts(placed, face, extent).area).collect())
}

/// ∫ N dA (L²) of each node of a surface of areas, in the order of [`Surface::nodes`](crate::Surface::nodes): the share of each in a uniformly distributed flow.
///
/// On second-order faces corners have negative or zero ones; the sum is the area.
///
/// # Errors
///
/// The faces are lines.
pub fn shape_function_areas(placed: &Placed<'_>) -> Result<Vec<f64>, Error> {
    sum_over_faces(placed, Extent::Spatial, |parts, _| parts.functions)
}

/// The sums over the faces of what each gives its nodes, in the order of [`Surface::nodes`](crate::Surface::nodes).
fn sum_over_faces(
    placed: &Placed<'_>,
    extent: Extent<'_>,
    of_nodes: impl Fn(&Parts, Face<'_>) -> [f64; MAX_NODES],
) -> Result<Vec<f64>, Error> {
    suits(placed, extent)?;
    let surface = placed.surface();
    let mut areas = vec![0.0; surface.nodes().len()];
    for id in surface.faces() {
        let face = surface.face(id);
        for (node, area) in face.nodes.iter().zip(of_nodes(&face_parts(placed, id, extent), face)) {
            if let Some(i) = surface.position_of(*node) {
                areas[i] += area;
            }
        }
    }
    Ok(areas)
}

/// Rejects extents that do not suit the faces.
fn suits(placed: &Placed<'_>, extent: Extent<'_>) -> Result<(), Error> {
    let surface = placed.surface();
    if !surface.is_empty() && surface.is_line() == matches!(extent, Extent::Spatial) {
        return Err(ErrorKind::Extent.into());
    }
    match extent {
        Extent::Plane(thickness) if thickness.len() != surface.len() => {
            Err(ErrorKind::Values { what: "thickness", expected: surface.len(), found: thickness.len() }.into())
        }
        Extent::Axisymmetric => {
            let negative = surface
                .nodes()
                .iter()
                .map(|node| (*node, placed.points()[node.index()][0]))
                .find(|(_, radius)| *radius < 0.0);
            negative.map_or(Ok(()), |(node, radius)| Err(ErrorKind::Radius { node, radius }.into()))
        }
        _ => Ok(()),
    }
}

/// Integrals over a face: 1, each shape function and its square.
struct Parts {
    area: f64,
    functions: [f64; MAX_NODES],
    squares: [f64; MAX_NODES],
}

fn face_parts(placed: &Placed<'_>, id: FaceId, extent: Extent<'_>) -> Parts {
    let patch = placed.patch(id);
    let shape = patch.shape();
    let mut parts = Parts { area: 0.0, functions: [0.0; MAX_NODES], squares: [0.0; MAX_NODES] };
    for point in rule(shape) {
        let measure = match extent {
            Extent::Spatial => 1.0,
            Extent::Plane(thickness) => thickness[id.index()],
            Extent::Axisymmetric => 2.0 * std::f64::consts::PI * patch.point(point.place)[0],
        };
        let weight = point.weight * norm(patch.area_vector(point.place)) * measure;
        parts.area += weight;
        let powers = monomials(point.place);
        for (i, function) in shape.functions().iter().enumerate() {
            let value = evaluate(function, &powers);
            parts.functions[i] += weight * value;
            parts.squares[i] += weight * value * value;
        }
    }
    parts
}

impl Parts {
    fn shares(&self, face: Face<'_>, shares: Shares) -> [f64; MAX_NODES] {
        let n = face.nodes.len();
        match shares {
            Shares::Equal => [self.area / n as f64; MAX_NODES],
            Shares::ShapeFunctions if face.shape.is_second_order() => {
                let sum: f64 = self.squares[..n].iter().sum();
                self.squares.map(|square| if 0.0 < sum { self.area * (square / sum) } else { 0.0 })
            }
            Shares::ShapeFunctions => self.functions,
        }
    }
}
