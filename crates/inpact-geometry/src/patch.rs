//! A face with its coordinates: a polynomial with eight coefficients, its tangents and its normal.

use crate::face_shape::{MONOMIALS, monomials};
use crate::vector::{add, cross, scale, sub, unit};
use crate::{FaceShape, Point, Vector};

/// A face in space.
///
/// Coordinates are stored relative to the face's centre, so that a mesh far from the origin loses no more digits than its coordinates already have.
///
/// ```
/// use inpact_geometry::{FaceShape, Patch};
/// let square = [[0.0, 0.0, 5.0], [2.0, 0.0, 5.0], [2.0, 2.0, 5.0], [0.0, 2.0, 5.0]];
/// let patch = Patch::new(FaceShape::Quadrilateral4, &square);
/// assert_eq!(patch.point([0.0, 0.0]), [1.0, 1.0, 5.0]);
/// assert_eq!(patch.normal([0.0, 0.0]), Some([0.0, 0.0, 1.0]));
/// ```
#[derive(Clone, Debug)]
pub struct Patch {
    pub(crate) shape: FaceShape,
    pub(crate) origin: Point,
    pub(crate) coefficients: [Vector; MONOMIALS],
}

impl Patch {
    /// The face of a shape with these nodes, in the shape's order.
    ///
    /// # Panics
    ///
    /// The number of nodes is not that of the shape.
    pub fn new(shape: FaceShape, nodes: &[Point]) -> Self {
        assert_eq!(nodes.len(), shape.nodes(), "nodes of a face");
        let corners = &nodes[..shape.corners()];
        let origin = scale(1.0 / corners.len() as f64, corners.iter().fold([0.0; 3], |sum, corner| add(sum, *corner)));
        let mut coefficients = [[0.0; 3]; MONOMIALS];
        for (function, node) in shape.functions().iter().zip(nodes) {
            let node = sub(*node, origin);
            for (coefficient, factor) in coefficients.iter_mut().zip(function) {
                *coefficient = add(*coefficient, scale(*factor, node));
            }
        }
        Self { shape, origin, coefficients }
    }

    /// Its shape.
    pub fn shape(&self) -> FaceShape {
        self.shape
    }

    /// The point at natural coordinates.
    pub fn point(&self, place: [f64; 2]) -> Point {
        add(self.origin, self.relative(place))
    }

    /// The unit normal at natural coordinates; `None` where the face is degenerate there.
    pub fn normal(&self, place: [f64; 2]) -> Option<Vector> {
        unit(self.area_vector(place))
    }

    /// The normal times the area (length, for a line) per unit of the reference face at a point.
    pub(crate) fn area_vector(&self, place: [f64; 2]) -> Vector {
        let [along, across] = self.tangents(place);
        if self.shape.is_line() { [along[1], -along[0], 0.0] } else { cross(along, across) }
    }

    /// The point at natural coordinates, relative to the face's own origin.
    pub(crate) fn relative(&self, place: [f64; 2]) -> Vector {
        let powers = monomials(place);
        self.coefficients
            .iter()
            .zip(powers)
            .fold([0.0; 3], |sum, (coefficient, power)| add(sum, scale(power, *coefficient)))
    }

    /// The derivatives by ξ and by η.
    pub(crate) fn tangents(&self, [x, y]: [f64; 2]) -> [Vector; 2] {
        let c = &self.coefficients;
        let component = |k: usize| {
            [
                c[1][k] + 2.0 * c[3][k] * x + c[4][k] * y + (2.0 * c[6][k] * x + c[7][k] * y) * y,
                c[2][k] + c[4][k] * x + 2.0 * c[5][k] * y + (c[6][k] * x + 2.0 * c[7][k] * y) * x,
            ]
        };
        let [a, b, c] = [component(0), component(1), component(2)];
        [[a[0], b[0], c[0]], [a[1], b[1], c[1]]]
    }

    /// The second derivatives: by ξ twice, by ξ and η, by η twice.
    pub(crate) fn curvatures(&self, [x, y]: [f64; 2]) -> [Vector; 3] {
        let c = &self.coefficients;
        let second = |square: usize, mixed: usize, along: f64| add(scale(2.0, c[square]), scale(2.0 * along, c[mixed]));
        [second(3, 6, y), add(c[4], add(scale(2.0 * x, c[6]), scale(2.0 * y, c[7]))), second(5, 7, x)]
    }
}
