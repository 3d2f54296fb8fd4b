//! The shapes of faces: nodes, edges, shape functions.
//!
//! Every shape function of every shape is a sum of the eight monomials 1, ξ, η, ξ², ξη, η², ξ²η, ξη² (Zienkiewicz and Taylor, The Finite Element Method,
//! chapter on shape functions), so that one table per shape defines them, and a face is a polynomial with eight coefficients.

/// The maximum number of nodes of a face.
pub const MAX_NODES: usize = 8;

/// The number of monomials.
pub(crate) const MONOMIALS: usize = 8;

/// The shape of a face.
///
/// Corners come first, counter-clockwise seen from the side that the normal points to; then the midside nodes, the first between
/// the first two corners. The normal of a segment from a to b lies to the right of it: (b − a) rotated clockwise by 90°, in the xy plane.
///
/// Natural coordinates on a segment are −1 ≤ ξ ≤ 1, on a triangle 0 ≤ ξ, 0 ≤ η, ξ + η ≤ 1, on a quadrilateral −1 ≤ ξ ≤ 1, −1 ≤ η ≤ 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FaceShape {
    /// Two ends.
    Segment2,
    /// Two ends and the middle.
    Segment3,
    /// Three corners: flat.
    Triangle3,
    /// Three corners and three middles.
    Triangle6,
    /// Four corners: bilinear.
    Quadrilateral4,
    /// Four corners and four middles: the serendipity face.
    Quadrilateral8,
}

impl FaceShape {
    /// The number of nodes.
    pub fn nodes(self) -> usize {
        self.functions().len()
    }

    /// The number of its corners (ends, for a segment).
    pub fn corners(self) -> usize {
        match self {
            Self::Segment2 | Self::Segment3 => 2,
            Self::Triangle3 | Self::Triangle6 => 3,
            Self::Quadrilateral4 | Self::Quadrilateral8 => 4,
        }
    }

    /// Whether it is a line, in a plane or axisymmetric mesh, rather than an area in space.
    pub fn is_line(self) -> bool {
        self.corners() == 2
    }

    /// Whether it has midside nodes.
    pub fn is_second_order(self) -> bool {
        self.corners() < self.nodes()
    }

    /// The natural coordinates of its corners.
    pub fn corner_places(self) -> &'static [[f64; 2]] {
        match self.corners() {
            2 => &[[-1.0, 0.0], [1.0, 0.0]],
            3 => &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            _ => &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
        }
    }

    /// Its centre, in ξ and η.
    pub fn middle(self) -> [f64; 2] {
        if self.corners() == 3 { [1.0 / 3.0, 1.0 / 3.0] } else { [0.0, 0.0] }
    }

    /// The shape functions at a point: the weights of the nodes, which sum to 1 (to rounding).
    ///
    /// ```
    /// use inpact_geometry::FaceShape;
    /// assert_eq!(FaceShape::Quadrilateral4.weights([0.0, 0.0]), [0.25; 4]);
    /// assert_eq!(FaceShape::Segment3.weights([0.0, 0.0]), [0.0, 0.0, 1.0]);
    /// ```
    pub fn weights(self, place: [f64; 2]) -> Vec<f64> {
        let powers = monomials(place);
        self.functions().iter().map(|function| evaluate(function, &powers)).collect()
    }

    /// One shape function a row: the coefficients of the monomials.
    pub(crate) fn functions(self) -> &'static [[f64; MONOMIALS]] {
        match self {
            Self::Segment2 => &SEGMENT_2,
            Self::Segment3 => &SEGMENT_3,
            Self::Triangle3 => &TRIANGLE_3,
            Self::Triangle6 => &TRIANGLE_6,
            Self::Quadrilateral4 => &QUADRILATERAL_4,
            Self::Quadrilateral8 => &QUADRILATERAL_8,
        }
    }
}

/// 1, ξ, η, ξ², ξη, η², ξ²η, ξη².
pub(crate) fn monomials([x, y]: [f64; 2]) -> [f64; MONOMIALS] {
    [1.0, x, y, x * x, x * y, y * y, x * x * y, x * y * y]
}

pub(crate) fn evaluate(function: &[f64; MONOMIALS], powers: &[f64; MONOMIALS]) -> f64 {
    function.iter().zip(powers).map(|(a, b)| a * b).sum()
}

const SEGMENT_2: [[f64; MONOMIALS]; 2] =
    [[0.5, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]];

const SEGMENT_3: [[f64; MONOMIALS]; 3] = [
    [0.0, -0.5, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.5, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0],
];

const TRIANGLE_3: [[f64; MONOMIALS]; 3] = [
    [1.0, -1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
];

const TRIANGLE_6: [[f64; MONOMIALS]; 6] = [
    [1.0, -3.0, -3.0, 2.0, 4.0, 2.0, 0.0, 0.0],
    [0.0, -1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, -1.0, 0.0, 0.0, 2.0, 0.0, 0.0],
    [0.0, 4.0, 0.0, -4.0, -4.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 4.0, 0.0, -4.0, -4.0, 0.0, 0.0],
];

const QUADRILATERAL_4: [[f64; MONOMIALS]; 4] = [
    [0.25, -0.25, -0.25, 0.0, 0.25, 0.0, 0.0, 0.0],
    [0.25, 0.25, -0.25, 0.0, -0.25, 0.0, 0.0, 0.0],
    [0.25, 0.25, 0.25, 0.0, 0.25, 0.0, 0.0, 0.0],
    [0.25, -0.25, 0.25, 0.0, -0.25, 0.0, 0.0, 0.0],
];

/// The corner at (a, b): (−1 + ξ² + η² + ab ξη + b ξ²η + a ξη²) / 4.
const QUADRILATERAL_8: [[f64; MONOMIALS]; 8] = [
    [-0.25, 0.0, 0.0, 0.25, 0.25, 0.25, -0.25, -0.25],
    [-0.25, 0.0, 0.0, 0.25, -0.25, 0.25, -0.25, 0.25],
    [-0.25, 0.0, 0.0, 0.25, 0.25, 0.25, 0.25, 0.25],
    [-0.25, 0.0, 0.0, 0.25, -0.25, 0.25, 0.25, -0.25],
    [0.5, 0.0, -0.5, -0.5, 0.0, 0.0, 0.5, 0.0],
    [0.5, 0.5, 0.0, 0.0, 0.0, -0.5, 0.0, -0.5],
    [0.5, 0.0, 0.5, -0.5, 0.0, 0.0, -0.5, 0.0],
    [0.5, -0.5, 0.0, 0.0, 0.0, -0.5, 0.0, 0.5],
];
