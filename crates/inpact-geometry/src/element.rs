//! Elements by their shape: the nodes of each face.
//!
//! Numbers of faces and nodes are those of the Abaqus Elements Guide: "Three-dimensional solid element library", "Two-dimensional solid element library",
//! "Axisymmetric solid element library", "Three-dimensional conventional shell element library", "Axisymmetric shell element library" and "Rigid element library",
//! under "Element-based loading" and "Node ordering and face numbering on elements".
//! There the nodes of a solid's face are clockwise seen from outside; here they are counterclockwise, so that normals point out of
//! solids, and out of shells on the side that the face is.

use crate::{Error, ErrorKind, FaceShape};
use std::fmt;
use std::str::FromStr;

/// A face of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FaceLabel {
    /// A face of a solid, or an edge of a plane element, by number from 1.
    Numbered(u8),
    /// The side of a shell that its normal points to.
    Positive,
    /// The other side.
    Negative,
}

impl fmt::Display for FaceLabel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Numbered(number) => write!(f, "S{number}"),
            Self::Positive => f.write_str("SPOS"),
            Self::Negative => f.write_str("SNEG"),
        }
    }
}

impl FromStr for FaceLabel {
    type Err = Error;

    /// `S1` to `S6`, `SPOS`, `SNEG`, in any case.
    fn from_str(text: &str) -> Result<Self, Error> {
        let text = text.to_ascii_uppercase();
        match text.as_bytes() {
            [b'S', digit @ b'1'..=b'6'] => Ok(Self::Numbered(digit - b'0')),
            b"SPOS" => Ok(Self::Positive),
            b"SNEG" => Ok(Self::Negative),
            _ => Err(ErrorKind::FaceLabel.into()),
        }
    }
}

/// A face of an element: its label, its shape, and its nodes as indices into the element's nodes (from 0), in the order of the shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LocalFace {
    /// Its label.
    pub label: FaceLabel,
    /// Its shape.
    pub shape: FaceShape,
    /// The element's nodes, from 0.
    pub nodes: &'static [u8],
}

/// The shape of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ElementShape {
    /// Four corners.
    Tetrahedron4,
    /// Four corners, six middles.
    Tetrahedron10,
    /// Six corners.
    Wedge6,
    /// Six corners, nine middles.
    Wedge15,
    /// Eight corners.
    Hexahedron8,
    /// Eight corners, twelve middles.
    Hexahedron20,
    /// A triangle of a plane or axisymmetric mesh.
    Triangle3,
    /// The same of the second order.
    Triangle6,
    /// A quadrilateral of a plane or axisymmetric mesh.
    Quadrilateral4,
    /// The same of the second order.
    Quadrilateral8,
    /// A triangular shell, membrane or rigid face.
    Shell3,
    /// The same of the second order.
    Shell6,
    /// A shell, membrane or rigid face with four corners.
    Shell4,
    /// The same of the second order.
    Shell8,
    /// A shell or rigid line of a plane or axisymmetric mesh.
    Line2,
    /// The same of the second order; its second node is the one in the middle.
    Line3,
}

impl ElementShape {
    /// The number of nodes.
    pub fn nodes(self) -> usize {
        match self {
            Self::Line2 => 2,
            Self::Triangle3 | Self::Shell3 | Self::Line3 => 3,
            Self::Tetrahedron4 | Self::Quadrilateral4 | Self::Shell4 => 4,
            Self::Wedge6 | Self::Triangle6 | Self::Shell6 => 6,
            Self::Hexahedron8 | Self::Quadrilateral8 | Self::Shell8 => 8,
            Self::Tetrahedron10 => 10,
            Self::Wedge15 => 15,
            Self::Hexahedron20 => 20,
        }
    }

    /// Whether its faces are the two sides of a shell or membrane.
    pub fn is_sheet(self) -> bool {
        matches!(self, Self::Shell3 | Self::Shell6 | Self::Shell4 | Self::Shell8 | Self::Line2 | Self::Line3)
    }

    /// Its faces.
    ///
    /// ```
    /// use inpact_geometry::{ElementShape, FaceLabel};
    /// let top = ElementShape::Hexahedron8.faces().iter().find(|face| face.label == FaceLabel::Numbered(2)).expect("a face");
    /// assert_eq!(top.nodes, [4, 5, 6, 7]);
    /// ```
    pub fn faces(self) -> &'static [LocalFace] {
        match self {
            Self::Tetrahedron4 => &TETRAHEDRON_4,
            Self::Tetrahedron10 => &TETRAHEDRON_10,
            Self::Wedge6 => &WEDGE_6,
            Self::Wedge15 => &WEDGE_15,
            Self::Hexahedron8 => &HEXAHEDRON_8,
            Self::Hexahedron20 => &HEXAHEDRON_20,
            Self::Triangle3 => &TRIANGLE_3,
            Self::Triangle6 => &TRIANGLE_6,
            Self::Quadrilateral4 => &QUADRILATERAL_4,
            Self::Quadrilateral8 => &QUADRILATERAL_8,
            Self::Shell3 => &SHELL_3,
            Self::Shell6 => &SHELL_6,
            Self::Shell4 => &SHELL_4,
            Self::Shell8 => &SHELL_8,
            Self::Line2 => &LINE_2,
            Self::Line3 => &LINE_3,
        }
    }

    /// Its face of this name.
    pub fn face(self, label: FaceLabel) -> Option<&'static LocalFace> {
        self.faces().iter().find(|face| face.label == label)
    }
}

const fn numbered(number: u8, nodes: &'static [u8], shape: FaceShape) -> LocalFace {
    LocalFace { label: FaceLabel::Numbered(number), shape, nodes }
}

const fn sides(positive: &'static [u8], negative: &'static [u8], shape: FaceShape) -> [LocalFace; 2] {
    [
        LocalFace { label: FaceLabel::Positive, shape, nodes: positive },
        LocalFace { label: FaceLabel::Negative, shape, nodes: negative },
    ]
}

use FaceShape::{Quadrilateral4, Quadrilateral8, Segment2, Segment3, Triangle3, Triangle6};

static TETRAHEDRON_4: [LocalFace; 4] = [
    numbered(1, &[0, 2, 1], Triangle3),
    numbered(2, &[0, 1, 3], Triangle3),
    numbered(3, &[1, 2, 3], Triangle3),
    numbered(4, &[2, 0, 3], Triangle3),
];

static TETRAHEDRON_10: [LocalFace; 4] = [
    numbered(1, &[0, 2, 1, 6, 5, 4], Triangle6),
    numbered(2, &[0, 1, 3, 4, 8, 7], Triangle6),
    numbered(3, &[1, 2, 3, 5, 9, 8], Triangle6),
    numbered(4, &[2, 0, 3, 6, 7, 9], Triangle6),
];

static WEDGE_6: [LocalFace; 5] = [
    numbered(1, &[0, 2, 1], Triangle3),
    numbered(2, &[3, 4, 5], Triangle3),
    numbered(3, &[0, 1, 4, 3], Quadrilateral4),
    numbered(4, &[1, 2, 5, 4], Quadrilateral4),
    numbered(5, &[2, 0, 3, 5], Quadrilateral4),
];

static WEDGE_15: [LocalFace; 5] = [
    numbered(1, &[0, 2, 1, 8, 7, 6], Triangle6),
    numbered(2, &[3, 4, 5, 9, 10, 11], Triangle6),
    numbered(3, &[0, 1, 4, 3, 6, 13, 9, 12], Quadrilateral8),
    numbered(4, &[1, 2, 5, 4, 7, 14, 10, 13], Quadrilateral8),
    numbered(5, &[2, 0, 3, 5, 8, 12, 11, 14], Quadrilateral8),
];

static HEXAHEDRON_8: [LocalFace; 6] = [
    numbered(1, &[0, 3, 2, 1], Quadrilateral4),
    numbered(2, &[4, 5, 6, 7], Quadrilateral4),
    numbered(3, &[0, 1, 5, 4], Quadrilateral4),
    numbered(4, &[1, 2, 6, 5], Quadrilateral4),
    numbered(5, &[2, 3, 7, 6], Quadrilateral4),
    numbered(6, &[3, 0, 4, 7], Quadrilateral4),
];

static HEXAHEDRON_20: [LocalFace; 6] = [
    numbered(1, &[0, 3, 2, 1, 11, 10, 9, 8], Quadrilateral8),
    numbered(2, &[4, 5, 6, 7, 12, 13, 14, 15], Quadrilateral8),
    numbered(3, &[0, 1, 5, 4, 8, 17, 12, 16], Quadrilateral8),
    numbered(4, &[1, 2, 6, 5, 9, 18, 13, 17], Quadrilateral8),
    numbered(5, &[2, 3, 7, 6, 10, 19, 14, 18], Quadrilateral8),
    numbered(6, &[3, 0, 4, 7, 11, 16, 15, 19], Quadrilateral8),
];

static TRIANGLE_3: [LocalFace; 3] =
    [numbered(1, &[0, 1], Segment2), numbered(2, &[1, 2], Segment2), numbered(3, &[2, 0], Segment2)];

static TRIANGLE_6: [LocalFace; 3] =
    [numbered(1, &[0, 1, 3], Segment3), numbered(2, &[1, 2, 4], Segment3), numbered(3, &[2, 0, 5], Segment3)];

static QUADRILATERAL_4: [LocalFace; 4] = [
    numbered(1, &[0, 1], Segment2),
    numbered(2, &[1, 2], Segment2),
    numbered(3, &[2, 3], Segment2),
    numbered(4, &[3, 0], Segment2),
];

static QUADRILATERAL_8: [LocalFace; 4] = [
    numbered(1, &[0, 1, 4], Segment3),
    numbered(2, &[1, 2, 5], Segment3),
    numbered(3, &[2, 3, 6], Segment3),
    numbered(4, &[3, 0, 7], Segment3),
];

static SHELL_3: [LocalFace; 2] = sides(&[0, 1, 2], &[0, 2, 1], Triangle3);
static SHELL_6: [LocalFace; 2] = sides(&[0, 1, 2, 3, 4, 5], &[0, 2, 1, 5, 4, 3], Triangle6);
static SHELL_4: [LocalFace; 2] = sides(&[0, 1, 2, 3], &[0, 3, 2, 1], Quadrilateral4);
static SHELL_8: [LocalFace; 2] = sides(&[0, 1, 2, 3, 4, 5, 6, 7], &[0, 3, 2, 1, 7, 6, 5, 4], Quadrilateral8);
/// The normal of a line element is its direction turned counter-clockwise by 90°; that of a segment is turned clockwise.
static LINE_2: [LocalFace; 2] = sides(&[1, 0], &[0, 1], Segment2);
static LINE_3: [LocalFace; 2] = sides(&[2, 0, 1], &[0, 2, 1], Segment3);
