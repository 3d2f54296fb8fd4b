//! Reasons why a method is not used for a table.

use std::fmt;

/// The maximum number of axes of a grid. Each doubles the number of nodes in a value.
pub(super) const MAX_AXES: usize = 4;

/// The most nodes of a grid: 256 KiB, which stays in the second-level cache.
pub(super) const MAX_NODES: usize = 1 << 15;

/// The most vertices of the refinement of table and grid.
pub(super) const MAX_VERTICES: usize = 1 << 20;

/// The reason why a method is not possible for a table, or was not chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refusal {
    /// The table is constant: there is nothing to speed up.
    Constant,
    /// The value depends on more axes than grids are made for.
    TooManyAxes(usize),
    /// A number so large that a sum could overflow.
    TooLarge(f64),
    /// The number of cells for a unit of an axis is outside the range of f64.
    Slope(f64),
    /// A table of one axis is never resampled: it would gain no time and lose the knots.
    OneAxis,
    /// A grid with no cells along an axis, or for another number of axes.
    Cells,
    /// A grid with this number of nodes would not fit into the cache.
    TooManyNodes(usize),
    /// The refinement of table and grid has too many vertices for its error to be computed.
    TooManyVertices(usize),
    /// The error bound, here as a part of the largest value or pointwise, is above the tolerance.
    Bound {
        /// The bound.
        bound: f64,
        /// The requested one.
        tolerance: f64,
    },
    /// Within the tolerance, but another method is cheaper.
    Slower,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant => write!(f, "the value depends on no axis"),
            Self::TooManyAxes(count) => write!(f, "the value depends on {count} axes, more than {MAX_AXES}"),
            Self::TooLarge(value) => write!(f, "{value:e} is too large to be added up"),
            Self::Slope(slope) => write!(f, "{slope:e} cells for a unit of an axis are outside the range of f64"),
            Self::OneAxis => write!(f, "a table of one axis gains nothing by resampling"),
            Self::Cells => write!(f, "the grid needs cells along each axis the value depends on"),
            Self::TooManyNodes(count) => {
                write!(f, "a grid of {count} nodes would not stay in cache, as {MAX_NODES} do")
            }
            Self::TooManyVertices(count) => {
                write!(f, "its error would have to be computed at {count} vertices, more than {MAX_VERTICES}")
            }
            Self::Bound { bound, tolerance } => write!(f, "its bound, {bound:.1e}, is above {tolerance:.1e}"),
            Self::Slower => write!(f, "another method within the tolerance is cheaper"),
        }
    }
}
