//! Names of rows: a history is the rows of one name under one interaction, so that a name must be unique among the rows of a time.

use inpact_geometry::NodeId;
use inpact_parser::mesh::{Mesh, MeshPair};
use inpact_parser::model::Name;
use std::collections::HashSet;

/// The names given so far.
#[derive(Debug, Default)]
pub(crate) struct Names {
    taken: HashSet<(Name, NodeId)>,
    /// The number of rows renamed, as another row of the same node has the name.
    pub(crate) renamed: u64,
}

impl Names {
    /// The name of a slave node's rows: `12`, or `PLATE-1.12`; with its master behind it, `12:TOP`, where an earlier pair under the same interaction has the node.
    pub(crate) fn give(&mut self, mesh: &Mesh, pair: &MeshPair, interaction: &Name, node: NodeId) -> String {
        let name = mesh.nodes[node.index()].to_string();
        if self.taken.insert((interaction.clone(), node)) {
            return name;
        }
        self.renamed += 1;
        format!("{name}:{}", mesh.surfaces[pair.master].name.written())
    }
}

/// The name of the point of a master across from a slave node: `12@TOP`, where `12` is the node.
pub(crate) fn across_name(slave: &str, master: &str) -> String {
    format!("{slave}@{master}")
}
