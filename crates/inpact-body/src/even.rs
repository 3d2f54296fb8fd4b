//! The shares of a terminal's nodes in a uniformly distributed flow: ∫ N dA / A.
//!
//! A node set has the free faces all of whose nodes are in it. Where nodes are on none of these, or there is no face at all (a line, a point), every node has the same share.

use crate::body::Body;
use inpact_geometry::{Face, FreeFaces, NodeId, Placed, Surface, shape_function_areas};
use inpact_parser::mesh::MeshTerminal;

/// The shares of the nodes of each terminal, in their order.
pub(crate) struct Even {
    pub(crate) shares: Vec<f64>,
    /// The area (L²); `None` where shares are by node.
    pub(crate) area: Option<f64>,
}

pub(crate) fn even(body: &Body, terminal: &MeshTerminal) -> Even {
    if let Some(even) = &terminal.even {
        return Even { shares: even.shares.clone(), area: Some(even.area) };
    }
    let of_set = if terminal.faces.is_none() { faces_of_set(body, &terminal.nodes) } else { None };
    let by_area = terminal.faces.as_ref().or(of_set.as_ref()).and_then(|faces| by_area(body, terminal, faces));
    by_area.unwrap_or_else(|| {
        let count = terminal.nodes.len();
        Even { shares: vec![1.0 / count as f64; count], area: None }
    })
}

fn by_area(body: &Body, terminal: &MeshTerminal, faces: &Surface) -> Option<Even> {
    if faces.nodes() != terminal.nodes {
        return None;
    }
    let placed = Placed::new(faces, &body.mesh.points).ok()?;
    let areas = shape_function_areas(&placed).ok()?;
    let area: f64 = areas.iter().sum();
    (0.0 < area).then(|| Even { shares: areas.iter().map(|of_node| of_node / area).collect(), area: Some(area) })
}

/// The free faces of solid elements that have no other nodes than these.
fn faces_of_set(body: &Body, nodes: &[NodeId]) -> Option<Surface> {
    let mut is_in = vec![false; body.mesh.points.len()];
    for node in nodes {
        is_in[node.index()] = true;
    }
    let mut free = FreeFaces::new();
    for (number, block) in (0_u64..).zip(&body.mesh.elements) {
        for (element, of_element) in (0_u64..).zip(block.each()) {
            if 3 <= of_element.iter().filter(|node| is_in[node.index()]).count() {
                free.add(number << 32 | element, block.shape, of_element);
            }
        }
    }
    let mut found: Vec<(_, Vec<NodeId>)> = Vec::new();
    for (number, label) in free.finish() {
        let block = &body.mesh.elements[usize::try_from(number >> 32).ok()?];
        let element = usize::try_from(number & u64::from(u32::MAX)).ok()?;
        let of_element = &block.nodes[element * block.shape.nodes()..][..block.shape.nodes()];
        let face = block.shape.face(label)?;
        let of_face: Vec<NodeId> = face.nodes.iter().map(|local| of_element[usize::from(*local)]).collect();
        if of_face.iter().all(|node| is_in[node.index()]) {
            found.push((face.shape, of_face));
        }
    }
    Surface::new(found.iter().map(|(shape, nodes)| Face { shape: *shape, nodes })).ok()
}
