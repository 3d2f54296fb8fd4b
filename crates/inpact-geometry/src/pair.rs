//! A contact pair: area, normal and clearance of every slave node in one call.

use crate::area::{Extent, Shares, node_areas};
use crate::coordinates::Placed;
use crate::normal::node_normals;
use crate::projection::Projection;
use crate::search::Master;
use crate::sheet::node_shifts;
use crate::{Error, ErrorKind, NodeId, Point, Vector};

/// Options of the geometry of a pair.
#[derive(Clone, Copy, Debug)]
pub struct PairOptions<'a> {
    /// Sharing of a slave face's area among its nodes.
    pub shares: Shares,
    /// The out-of-plane extent of a slave face.
    pub extent: Extent<'a>,
    /// The distance of each slave face from its nodes along its normal (L), by face; empty where all are solids.
    pub slave_shifts: &'a [f64],
    /// The same of the master.
    pub master_shifts: &'a [f64],
    /// The maximum distance of a node beyond the master's outer edge, as a fraction of an edge.
    pub extension: f64,
}

/// Contact geometry of one slave node.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactNode {
    /// The node.
    pub node: NodeId,
    /// Its area (L²).
    pub area: f64,
    /// The averaged unit normal of the slave there; `None` where there is none.
    pub normal: Option<Vector>,
    /// The projection onto the master; `None` where the master has no face. The thickness of shells is subtracted from the clearance (not from the distance).
    pub across: Option<Projection>,
}

/// The geometry of a pair, in the order of the slave's [`Surface::nodes`](crate::Surface::nodes).
///
/// ```
/// use inpact_geometry::{contact_nodes, DEFAULT_EXTENSION, Extent, Face, FaceShape, Master, NodeId, PairOptions, Placed, Shares, Surface};
/// // A line above a line twice as long, in a plate 0.5 thick.
/// let points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 0.25, 0.0], [1.5, 0.25, 0.0]];
/// let line = |from: u32, to: u32| Surface::new([Face { shape: FaceShape::Segment2, nodes: &[NodeId(from), NodeId(to)] }]);
/// let (slave, master) = (line(2, 3)?, line(1, 0)?);
/// let options = PairOptions {
///     shares: Shares::Equal,
///     extent: Extent::Plane(&[0.5]),
///     slave_shifts: &[],
///     master_shifts: &[],
///     extension: DEFAULT_EXTENSION,
/// };
/// let found = contact_nodes(&Placed::new(&slave, &points)?, &Master::new(Placed::new(&master, &points)?), &options)?;
/// assert!((found[0].area - 0.25).abs() < 1e-15);
/// assert_eq!(found[0].normal, Some([0.0, -1.0, 0.0]));
/// assert_eq!(found[0].across.as_ref().map(|across| across.clearance), Some(0.25));
/// # Ok::<(), inpact_geometry::Error>(())
/// ```
///
/// # Errors
///
/// As [`node_areas`]; and where there is not one shift per face.
pub fn contact_nodes(
    slave: &Placed<'_>,
    master: &Master<'_>,
    options: &PairOptions<'_>,
) -> Result<Vec<ContactNode>, Error> {
    let nodes = slave.surface().nodes();
    let areas = node_areas(slave, options.shares, options.extent)?;
    let points: Vec<Point> = nodes.iter().map(|node| slave.points()[node.index()]).collect();
    let shifts = if options.slave_shifts.is_empty() {
        vec![0.0; nodes.len()]
    } else {
        node_shifts(slave.surface(), options.slave_shifts)?
    };
    let faces = master.placed().surface().len();
    if !options.master_shifts.is_empty() && options.master_shifts.len() != faces {
        return Err(ErrorKind::Values { what: "shift", expected: faces, found: options.master_shifts.len() }.into());
    }
    let normals = node_normals(slave);
    let across = master.project_all(&points, options.extension);
    let node = |(i, across): (usize, Option<Projection>)| {
        let across = across.map(|across| {
            let of_master = options.master_shifts.get(across.face.index()).copied().unwrap_or(0.0);
            Projection { clearance: across.clearance - (shifts[i] + of_master), ..across }
        });
        ContactNode { node: nodes[i], area: areas[i], normal: normals[i], across }
    };
    Ok(across.into_iter().enumerate().map(node).collect())
}
