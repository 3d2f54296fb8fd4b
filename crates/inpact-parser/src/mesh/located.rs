//! The located nodes of surfaces.

use super::MeshNode;
use super::nodes::Wanted;
use crate::model::Name;
use crate::span::Span;
use inpact_geometry::NodeId;
use std::collections::HashMap;
use std::ops::Range;

/// The located nodes, numbered.
#[derive(Debug, Default)]
pub(super) struct Located {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) nodes: Vec<MeshNode>,
    ids: HashMap<(usize, u32), NodeId>,
    /// The keyword line of the *NODE option of each.
    pub(super) options: Vec<Span>,
    /// The nodes of each instance.
    pub(super) of_instances: Vec<Range<usize>>,
    /// The numbers of the nodes of each selection.
    pub(super) of_picks: Vec<Vec<u32>>,
}

impl Located {
    pub(super) fn add(&mut self, instance: usize, name: Option<&Name>, wanted: Wanted) {
        let first = self.points.len();
        for (label, point) in wanted.labels.into_iter().zip(wanted.points) {
            let Some((point, option)) = point else { continue };
            let Ok(id) = u32::try_from(self.points.len()) else { continue };
            self.ids.insert((instance, label), NodeId(id));
            self.points.push(point);
            self.options.push(option);
            self.nodes.push(MeshNode { instance: name.cloned(), label });
        }
        self.of_instances.push(first..self.points.len());
    }

    /// The number of nodes.
    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The number of a node in its instance.
    pub(super) fn label(&self, node: usize) -> u32 {
        self.nodes[node].label
    }

    pub(super) fn id(&self, instance: usize, label: u32) -> Option<NodeId> {
        self.ids.get(&(instance, label)).copied()
    }
}
