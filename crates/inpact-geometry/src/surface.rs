//! The topology of a surface: its faces and their neighbours, without coordinates.

use crate::{Error, ErrorKind, FaceId, FaceShape, NodeId};

/// One face, by its nodes in the order of its shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face<'a> {
    /// Its shape.
    pub shape: FaceShape,
    /// Its nodes: corners first.
    pub nodes: &'a [NodeId],
}

/// The topology of a surface: faces by their nodes, and the faces around each node.
///
/// ```
/// use inpact_geometry::{Face, FaceId, FaceShape, NodeId, Surface};
/// let nodes = [0, 1, 2, 3, 4, 5].map(NodeId);
/// let [a, b, c, d, e, f] = nodes;
/// let strip = Surface::new([[a, b, c, d], [b, e, f, c]].iter().map(|nodes| Face { shape: FaceShape::Quadrilateral4, nodes }))?;
/// assert_eq!(strip.nodes(), nodes);
/// assert_eq!(strip.faces_at(b), [FaceId(0), FaceId(1)]);
/// assert_eq!(strip.across(FaceId(0), 1), Some(FaceId(1)));
/// assert_eq!(strip.across(FaceId(0), 0), None);
/// # Ok::<(), inpact_geometry::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Surface {
    shapes: Vec<FaceShape>,
    /// The first node of each face in `connectivity`, and the end of the last one's.
    starts: Vec<u32>,
    connectivity: Vec<NodeId>,
    /// All nodes, ascending.
    nodes: Vec<NodeId>,
    /// The first face of each node in `around`, and the end of the last one's.
    around_starts: Vec<u32>,
    around: Vec<FaceId>,
}

impl Surface {
    /// A surface of these faces, numbered in this order.
    ///
    /// # Errors
    ///
    /// A face does not have its shape's number of nodes, lines and areas are mixed, or there are more than 2³² faces or nodes of faces.
    pub fn new<'a>(faces: impl IntoIterator<Item = Face<'a>>) -> Result<Self, Error> {
        let mut surface = Self { starts: vec![0], ..Self::default() };
        for Face { shape, nodes } in faces {
            if nodes.len() != shape.nodes() {
                return Err(ErrorKind::NodesOfFace { expected: shape.nodes(), found: nodes.len() }.into());
            }
            if surface.shapes.first().is_some_and(|first| first.is_line() != shape.is_line()) {
                return Err(ErrorKind::MixedDimensions.into());
            }
            surface.shapes.push(shape);
            surface.connectivity.extend_from_slice(nodes);
            surface.starts.push(u32::try_from(surface.connectivity.len()).map_err(|_| ErrorKind::TooLarge)?);
        }
        surface.gather();
        Ok(surface)
    }

    /// Finds the nodes and the faces around each.
    fn gather(&mut self) {
        let mut pairs: Vec<(NodeId, FaceId)> = Vec::with_capacity(self.connectivity.len());
        for face in self.faces() {
            pairs.extend(self.face(face).nodes.iter().map(|node| (*node, face)));
        }
        pairs.sort_unstable();
        // A collapsed face has a node twice, but is listed once around it.
        pairs.dedup();
        for (node, face) in pairs {
            if self.nodes.last() != Some(&node) {
                self.nodes.push(node);
                self.around_starts.push(position(self.around.len()));
            }
            self.around.push(face);
        }
        self.around_starts.push(position(self.around.len()));
    }

    /// The number of faces.
    pub fn len(&self) -> usize {
        self.shapes.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// Whether its faces are lines, of a plane or axisymmetric mesh.
    pub fn is_line(&self) -> bool {
        self.shapes.first().is_some_and(|shape| shape.is_line())
    }

    /// The faces, ascending.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..position(self.shapes.len())).map(FaceId)
    }

    /// A face of it.
    ///
    /// # Panics
    ///
    /// It has no such face.
    pub fn face(&self, face: FaceId) -> Face<'_> {
        let i = face.index();
        Face { shape: self.shapes[i], nodes: &self.connectivity[self.starts[i] as usize..self.starts[i + 1] as usize] }
    }

    /// Its nodes, ascending, each once.
    pub fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    /// The index of a node in [`Surface::nodes`].
    pub fn position_of(&self, node: NodeId) -> Option<usize> {
        self.nodes.binary_search(&node).ok()
    }

    /// The faces that have this node, ascending.
    pub fn faces_at(&self, node: NodeId) -> &[FaceId] {
        match self.position_of(node) {
            Some(i) => &self.around[self.around_starts[i] as usize..self.around_starts[i + 1] as usize],
            None => &[],
        }
    }

    /// The face on the other side of a face's edge (the first, where several meet there), `None` where the surface ends.
    ///
    /// Edge i goes from corner i to the next; a segment's edge i is its end i.
    pub fn across(&self, face: FaceId, edge: usize) -> Option<FaceId> {
        let Face { shape, nodes } = self.face(face);
        let from = nodes[edge];
        if shape.is_line() {
            return self.faces_at(from).iter().copied().find(|other| *other != face);
        }
        let to = nodes[(edge + 1) % shape.corners()];
        self.faces_at(from).iter().copied().find(|other| *other != face && self.has_edge(*other, from, to))
    }

    fn has_edge(&self, face: FaceId, a: NodeId, b: NodeId) -> bool {
        let Face { shape, nodes } = self.face(face);
        let n = shape.corners();
        (0..n).any(|i| [[a, b], [b, a]].contains(&[nodes[i], nodes[(i + 1) % n]]))
    }
}

/// A position, which was checked to fit when the surface was built.
fn position(index: usize) -> u32 {
    u32::try_from(index).expect("no more than nodes of faces, which were counted in 32 bits")
}
