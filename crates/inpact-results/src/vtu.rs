//! Output for ParaView: VTK unstructured grids in XML, `.vtu`, and their time series, `.pvd`.
//!
//! Source: VTK User's Guide, "VTK XML formats".
//! Numbers are written inline in base64, uncompressed, which VTK, ParaView and meshio all read.

mod numbers;
mod read;
mod write;
mod xml;

pub use read::{read_grid, read_vtu};
pub use write::{Moment, write_collection, write_grid};

/// Points, the cells between them, and values at either.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// The points (L); plane models have 0 as third coordinate.
    pub points: Vec<[f64; 3]>,
    /// The faces, one after the other.
    pub cells: Vec<Cell>,
    /// Point data.
    pub point_data: Vec<Array>,
    /// Cell data.
    pub cell_data: Vec<Array>,
    /// Its time (T).
    pub time: Option<f64>,
}

/// A face by its points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Its kind.
    pub kind: CellKind,
    /// Its points, as indices in [`Grid::points`]: corners in order, then the midside nodes.
    pub points: Vec<usize>,
}

impl Cell {
    /// A face of an element, by its number of nodes: 1 a point, 2 and 3 a line in a plane model, 3, 4, 6 and 8 a face in space.
    ///
    /// Any other number is a polygon.
    pub fn face(points: Vec<usize>, space: Space) -> Self {
        let kind = match (points.len(), space) {
            (1, _) => CellKind::Vertex,
            (2, _) => CellKind::Line,
            (3, Space::Plane) => CellKind::QuadraticLine,
            (3, Space::Solid) => CellKind::Triangle,
            (4, _) => CellKind::Quadrilateral,
            (6, _) => CellKind::QuadraticTriangle,
            (8, _) => CellKind::QuadraticQuadrilateral,
            _ => CellKind::Polygon,
        };
        Self { kind, points }
    }
}

/// Space of the faces: lines or areas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Plane and axisymmetric models: faces are lines.
    Plane,
    /// Models in space: faces are areas.
    Solid,
}

/// A kind of cell, by VTK's number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CellKind {
    /// 1.
    Vertex,
    /// 3.
    Line,
    /// 5.
    Triangle,
    /// 7.
    Polygon,
    /// 9.
    Quadrilateral,
    /// 21.
    QuadraticLine,
    /// 22.
    QuadraticTriangle,
    /// 23.
    QuadraticQuadrilateral,
    /// Any other, such as 12 for a hexahedron.
    Other(u8),
}

impl CellKind {
    /// VTK's number.
    pub fn number(self) -> u8 {
        match self {
            Self::Vertex => 1,
            Self::Line => 3,
            Self::Triangle => 5,
            Self::Polygon => 7,
            Self::Quadrilateral => 9,
            Self::QuadraticLine => 21,
            Self::QuadraticTriangle => 22,
            Self::QuadraticQuadrilateral => 23,
            Self::Other(number) => number,
        }
    }

    /// The kind with VTK's number.
    pub fn from_number(number: u8) -> Self {
        match number {
            1 => Self::Vertex,
            3 => Self::Line,
            5 => Self::Triangle,
            7 => Self::Polygon,
            9 => Self::Quadrilateral,
            21 => Self::QuadraticLine,
            22 => Self::QuadraticTriangle,
            23 => Self::QuadraticQuadrilateral,
            other => Self::Other(other),
        }
    }
}

/// A data array with one or more components.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Its name.
    pub name: String,
    /// The number of components; 1 or more.
    pub components: usize,
    /// The values, point by point.
    pub values: Values,
}

impl Array {
    /// One number per point or cell.
    pub fn reals(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), components: 1, values: Values::Reals(values) }
    }

    /// One integer per point or cell, such as the label of a node.
    pub fn integers(name: impl Into<String>, values: Vec<i64>) -> Self {
        Self { name: name.into(), components: 1, values: Values::Integers(values) }
    }
}

/// Numbers of one type.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Floating point: `Float64`, or read from `Float32`.
    Reals(Vec<f64>),
    /// Whole: `Int64`, or read from smaller ones.
    Integers(Vec<i64>),
}

impl Values {
    /// The number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Reals(values) => values.len(),
            Self::Integers(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
