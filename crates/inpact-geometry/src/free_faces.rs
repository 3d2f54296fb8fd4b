//! The free faces of a mesh: those that occur once.

use crate::{ElementShape, FaceLabel, NodeId};
use std::collections::HashMap;

/// Gathers elements and forgets each face as soon as a second element has it: memory follows the front between the elements that came and those that did not,
/// which is that of a surface where neighbours come soon after each other.
///
/// A face that three elements have, which no valid mesh has, counts as free.
///
/// ```
/// use inpact_geometry::{ElementShape, FreeFaces, NodeId};
/// let mut free = FreeFaces::new();
/// free.add(7, ElementShape::Quadrilateral4, &[0, 1, 2, 3].map(NodeId));
/// free.add(8, ElementShape::Quadrilateral4, &[1, 4, 5, 2].map(NodeId));
/// let faces: Vec<String> = free.finish().iter().map(|(element, label)| format!("{element}.{label}")).collect();
/// assert_eq!(faces, ["7.S1", "7.S3", "7.S4", "8.S1", "8.S2", "8.S3"]);
/// ```
#[derive(Debug, Default)]
pub struct FreeFaces {
    /// By the corners, ascending; faces with fewer than four end with the largest number.
    open: HashMap<[u32; 4], Option<(u32, FaceLabel)>>,
}

impl FreeFaces {
    /// No elements.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an element, by the caller's number, whose free faces are wanted. Sheets are left out: both of their sides are free.
    pub fn add(&mut self, element: u32, shape: ElementShape, nodes: &[NodeId]) {
        self.meet(shape, nodes, Some(element));
    }

    /// Adds an element whose own faces are not wanted, but which may cover wanted ones.
    pub fn cover(&mut self, shape: ElementShape, nodes: &[NodeId]) {
        self.meet(shape, nodes, None);
    }

    fn meet(&mut self, shape: ElementShape, nodes: &[NodeId], element: Option<u32>) {
        if shape.is_sheet() {
            return;
        }
        for face in shape.faces() {
            let mut key = [u32::MAX; 4];
            for (key, local) in key.iter_mut().zip(&face.nodes[..face.shape.corners()]) {
                *key = nodes[usize::from(*local)].0;
            }
            key.sort_unstable();
            let Some(key) = distinct(key, face.shape.corners()) else { continue };
            if self.open.remove(&key).is_none() {
                self.open.insert(key, element.map(|element| (element, face.label)));
            }
        }
    }

    /// The wanted faces that no other element has, by element and label.
    pub fn finish(self) -> Vec<(u32, FaceLabel)> {
        let mut faces: Vec<(u32, FaceLabel)> = self.open.into_values().flatten().collect();
        faces.sort_unstable();
        faces
    }
}

/// The corners, each once; `None` where so many coincide that the face has no area.
fn distinct(sorted: [u32; 4], corners: usize) -> Option<[u32; 4]> {
    let mut key = [u32::MAX; 4];
    let mut found = 0;
    for corner in &sorted[..corners] {
        if found == 0 || key[found - 1] != *corner {
            key[found] = *corner;
            found += 1;
        }
    }
    (corners.min(3) <= found).then_some(key)
}
