//! The geometry of contact surfaces and of conduction in solids: faces of elements, areas and normals of nodes, the closest point on the other surface,
//! element matrices.
//!
//! Numbers in, numbers out: independent of decks, laws and files. Nodes and faces are positions in arrays ([`NodeId`], [`FaceId`]).
//! Lengths have the unit of the coordinates (L), areas its square (L²); weights, normals and places on faces have none.
//!
//! Topology is separate from coordinates:
//!
//! | | symbolic: which | numeric: where |
//! |---|---|---|
//! | elements | [`ElementType`], [`ElementShape`], [`FaceLabel`], [`FreeFaces`], [`Integration`] | [`SolidElement`] |
//! | faces | [`FaceShape`] | [`Patch`] |
//! | surfaces | [`Surface`] | [`Placed`], [`node_areas`], [`node_normals`] |
//! | pairs | | [`Master`], [`Projection`], [`sheet_shift`], [`contact_nodes`] |
//!
//! ```
//! use inpact_geometry::{DEFAULT_EXTENSION, Extent, Face, FaceShape, Master, node_areas, node_normals, NodeId, Placed, Shares, Surface};
//!
//! // A slave square of side 1 hovers 0.1 above a master square of side 3.
//! let points = [
//!     [0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 3.0, 0.0], [0.0, 3.0, 0.0],
//!     [1.0, 1.0, 0.1], [1.0, 2.0, 0.1], [2.0, 2.0, 0.1], [2.0, 1.0, 0.1],
//! ];
//! let square = |first: u32| Surface::new([Face {
//!     shape: FaceShape::Quadrilateral4,
//!     nodes: &[0, 1, 2, 3].map(|i| NodeId(first + i)),
//! }]);
//! let (master, slave) = (square(0)?, square(4)?);
//! let slave = Placed::new(&slave, &points)?;
//! let master = Master::new(Placed::new(&master, &points)?);
//!
//! let areas = node_areas(&slave, Shares::Equal, Extent::Spatial)?;
//! areas.iter().for_each(|area| assert!((area - 0.25).abs() < 1e-15));
//! assert_eq!(node_normals(&slave)[0], Some([0.0, 0.0, -1.0]));
//! let across = master.project(points[4], DEFAULT_EXTENSION).expect("a face");
//! assert_eq!((across.clearance, across.projects), (0.1, true));
//! # Ok::<(), inpact_geometry::Error>(())
//! ```

mod ids;
mod vector;

mod element;
mod element_type;
mod face_shape;
mod free_faces;

mod patch;
mod quadrature;
mod surface;

mod coordinates;

mod area;
mod closest;
mod conduction;
mod normal;
mod overlap;
mod pair;
mod projection;
mod search;
mod sheet;
mod solid;
mod spread;

mod error;

pub use area::{Extent, Shares, face_areas, node_areas, shape_function_areas};
pub use closest::Closest;
pub use conduction::{Conductivity, SolidElement, SolidIntegrals};
pub use coordinates::Placed;
pub use element::{ElementShape, FaceLabel, LocalFace};
pub use element_type::{ElementSpace, ElementType};
pub use error::{Error, ErrorKind};
pub use face_shape::{FaceShape, MAX_NODES};
pub use free_faces::FreeFaces;
pub use ids::{FaceId, NodeId};
pub use normal::node_normals;
pub use overlap::{Overlap, overlap};
pub use pair::{ContactNode, PairOptions, contact_nodes};
pub use patch::Patch;
pub use projection::{DEFAULT_EXTENSION, Projection};
pub use search::Master;
pub use sheet::{node_shifts, sheet_shift};
pub use solid::{Integration, MAX_SOLID_NODES};
pub use surface::{Face, Surface};
pub use vector::{Point, Vector};
