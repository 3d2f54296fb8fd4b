//! A surface with coordinates: its faces, validated once.

use crate::patch::Patch;
use crate::{Error, ErrorKind, FaceId, Point, Surface};

/// Squares of larger coordinates are not finite, or their sums are not.
const LARGEST: f64 = 1e150;

/// A surface with the points of its nodes, all present and finite.
///
/// ```
/// use inpact_geometry::{Error, ErrorKind, Face, FaceShape, NodeId, Placed, Surface};
/// let nodes = [0, 1].map(NodeId);
/// let surface = Surface::new([Face { shape: FaceShape::Segment2, nodes: &nodes }])?;
/// let points = [[0.0, 0.0, 0.0]];
/// assert_eq!(Placed::new(&surface, &points).err(), Some(ErrorKind::NoPoint { node: NodeId(1), points: 1 }.into()));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    surface: &'a Surface,
    points: &'a [Point],
}

impl<'a> Placed<'a> {
    /// The surface whose node i is at `points[i]`.
    ///
    /// # Errors
    ///
    /// A node has no point, or the square of a coordinate is not finite.
    pub fn new(surface: &'a Surface, points: &'a [Point]) -> Result<Self, Error> {
        for node in surface.nodes() {
            let point = points.get(node.index()).ok_or(ErrorKind::NoPoint { node: *node, points: points.len() })?;
            finite(*point).map_err(|coordinate| ErrorKind::Coordinate { node: *node, coordinate })?;
        }
        Ok(Self { surface, points })
    }

    /// The surface.
    pub fn surface(&self) -> &'a Surface {
        self.surface
    }

    /// The points of all nodes, not only of the surface's.
    pub fn points(&self) -> &'a [Point] {
        self.points
    }

    /// One face with its coordinates.
    pub fn patch(&self, face: FaceId) -> Patch {
        let face = self.surface.face(face);
        let mut points = [[0.0; 3]; crate::face_shape::MAX_NODES];
        for (point, node) in points.iter_mut().zip(face.nodes) {
            *point = self.points[node.index()];
        }
        Patch::new(face.shape, &points[..face.nodes.len()])
    }
}

/// The first coordinate that is too large, infinite or NaN.
pub(crate) fn finite(point: Point) -> Result<(), f64> {
    point.into_iter().try_for_each(|x| if (-LARGEST..=LARGEST).contains(&x) { Ok(()) } else { Err(x) })
}
