//! The free faces of a mesh: those that occur once.

use crate::{ElementShape, FaceLabel, NodeId};
use std::collections::HashMap;
use std::collections::hash_map::{Entry, RandomState};
use std::hash::{BuildHasher, Hash, Hasher};

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
    open: HashMap<Corners, Option<(u64, FaceLabel)>, Mixing>,
}

/// The corners of a face, ascending; faces with fewer than four end with the largest number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Corners([u32; 4]);

impl Hash for Corners {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let Self([a, b, c, d]) = *self;
        state.write_u64(u64::from(a) << 32 | u64::from(b));
        state.write_u64(u64::from(c) << 32 | u64::from(d));
    }
}

/// Makes hashes of a few multiplications, which millions of faces need; the seed is by chance, so that no deck can be made to collide.
#[derive(Debug, Clone, Copy)]
struct Mixing(u64);

impl Default for Mixing {
    fn default() -> Self {
        Self(RandomState::new().build_hasher().finish())
    }
}

impl BuildHasher for Mixing {
    type Hasher = Mix;

    fn build_hasher(&self) -> Mix {
        Mix(self.0)
    }
}

/// The hash so far: each word is folded in by a product of 128 bits, whose halves are joined (as foldhash and wyhash do).
struct Mix(u64);

impl Hasher for Mix {
    fn write_u64(&mut self, word: u64) {
        let product = u128::from(self.0 ^ word) * u128::from(0x9E37_79B9_7F4A_7C15_u64);
        #[expect(clippy::cast_possible_truncation, reason = "its lower half")]
        let low = product as u64;
        self.0 = low ^ (product >> 64) as u64;
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u64(u64::from(*byte));
        }
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

impl FreeFaces {
    /// No elements.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an element, by the caller's number, whose free faces are wanted. Sheets are left out: both of their sides are free.
    pub fn add(&mut self, element: u64, shape: ElementShape, nodes: &[NodeId]) {
        self.meet(shape, nodes, Some(element));
    }

    /// Adds an element whose own faces are not wanted, but which may cover wanted ones.
    pub fn cover(&mut self, shape: ElementShape, nodes: &[NodeId]) {
        self.meet(shape, nodes, None);
    }

    fn meet(&mut self, shape: ElementShape, nodes: &[NodeId], element: Option<u64>) {
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
            match self.open.entry(Corners(key)) {
                Entry::Occupied(met) => drop(met.remove()),
                Entry::Vacant(new) => drop(new.insert(element.map(|element| (element, face.label)))),
            }
        }
    }

    /// The wanted faces that no other element has, by element and label.
    pub fn finish(self) -> Vec<(u64, FaceLabel)> {
        let mut faces: Vec<(u64, FaceLabel)> = self.open.into_values().flatten().collect();
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
