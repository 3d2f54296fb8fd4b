//! The error type of this crate: meshes without geometry.

use crate::NodeId;

/// A mesh or a pair of surfaces without a geometry.
///
/// ```
/// use inpact_geometry::{ErrorKind, Face, FaceShape, NodeId, Surface};
///
/// let face = Face { shape: FaceShape::Triangle3, nodes: &[NodeId(0), NodeId(1)] };
/// let error = Surface::new([face]).unwrap_err();
/// assert_eq!(error.kind(), &ErrorKind::NodesOfFace { expected: 3, found: 2 });
/// assert_eq!(error.to_string(), "expected 3 nodes of a face, found 2");
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(transparent)]
pub struct Error(#[from] ErrorKind);

impl Error {
    /// The reason, with the values concerned.
    pub fn kind(&self) -> &ErrorKind {
        &self.0
    }
}

/// Reasons why a geometry cannot be found, with the values concerned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A face has another number of nodes than its shape.
    #[error("expected {expected} nodes of a face, found {found}")]
    NodesOfFace {
        /// The number of nodes of the shape.
        expected: usize,
        /// The number of nodes given.
        found: usize,
    },
    /// Segments and areas in one surface.
    #[error("a surface has both faces that are lines and faces that are areas")]
    MixedDimensions,
    /// More faces or nodes than can be numbered.
    #[error("a surface has more than {} faces or nodes of faces", u32::MAX)]
    TooLarge,
    /// A face refers to a node without a point.
    #[error("node {} has no point: there are {points} points", node.0)]
    NoPoint {
        /// The node.
        node: NodeId,
        /// The number of points.
        points: usize,
    },
    /// A coordinate is not a number, infinite, or so large that its square is infinite.
    #[error("node {} has the coordinate {coordinate:?}, whose square is no finite number", node.0)]
    Coordinate {
        /// The node.
        node: NodeId,
        /// The coordinate.
        coordinate: f64,
    },
    /// A node of an axisymmetric surface is left of the axis.
    #[error("node {} of an axisymmetric surface has the radius {radius:?}, which is negative", node.0)]
    Radius {
        /// The node.
        node: NodeId,
        /// Its first coordinate.
        radius: f64,
    },
    /// Faces that are lines were declared as areas, or vice versa.
    #[error("faces that are lines need a thickness or an axis, and faces that are areas have neither")]
    Extent,
    /// Another number of values than of faces or nodes.
    #[error("expected {expected} values of `{what}`, found {found}")]
    Values {
        /// The name of the values.
        what: &'static str,
        /// The number needed.
        expected: usize,
        /// The number given.
        found: usize,
    },
    /// A text names no face.
    #[error("expected a face: `S1` to `S6`, `SPOS` or `SNEG`")]
    FaceLabel,
    /// A solid element is inverted or flat.
    #[error(
        "the element is inside out or flat: expected a Jacobian determinant above 0 at its integration points, found {determinant:?}"
    )]
    Inverted {
        /// The determinant at the first such point (L³).
        determinant: f64,
    },
}
