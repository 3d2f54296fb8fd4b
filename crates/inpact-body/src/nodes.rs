//! The nodes of each body: values are stored for these only, so that the memory of many bodies grows with their nodes.

use crate::body::Body;
use inpact_geometry::NodeId;

/// The nodes of all bodies that have terminals.
pub(crate) struct NodesOfBodies {
    /// By body, in ascending order.
    nodes: Vec<Vec<u32>>,
    /// The position of each node among those of its body.
    places: Vec<u32>,
}

/// The nodes of a body.
pub(crate) struct NodesOfBody<'a> {
    /// In ascending order.
    pub(crate) nodes: &'a [u32],
    places: &'a [u32],
}

impl NodesOfBodies {
    pub(crate) fn of(body: &Body) -> Self {
        let mut nodes: Vec<Vec<u32>> = vec![Vec::new(); body.parts.len()];
        let mut places = vec![0; body.part_of.len()];
        for ((node, part), place) in (0_u32..).zip(&body.part_of).zip(&mut places) {
            if !body.parts[*part as usize].terminals.is_empty() {
                let of_part = &mut nodes[*part as usize];
                *place = u32::try_from(of_part.len()).expect("nodes are counted in 32 bits");
                of_part.push(node);
            }
        }
        Self { nodes, places }
    }

    /// Those of a body, a position in [`parts`](Body::parts).
    pub(crate) fn body(&self, part: usize) -> NodesOfBody<'_> {
        NodesOfBody { nodes: &self.nodes[part], places: &self.places }
    }
}

impl NodesOfBody<'_> {
    /// The position of a node of the body.
    pub(crate) fn place(&self, node: usize) -> usize {
        self.places[node] as usize
    }

    /// The position of a node of the body.
    pub(crate) fn place_of(&self, node: NodeId) -> usize {
        self.place(node.index())
    }

    /// Values at these nodes, of those at all nodes.
    pub(crate) fn values(&self, of_all: &[f64]) -> Vec<f64> {
        self.nodes.iter().map(|node| of_all[*node as usize]).collect()
    }
}
