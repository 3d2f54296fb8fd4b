//! The free faces of a mesh: those that occur once.

use crate::{ElementShape, FaceLabel, NodeId};
use std::collections::HashMap;
use std::collections::hash_map::{Entry, RandomState};
use std::hash::{BuildHasher, Hash, Hasher};

/// Collects elements and drops each face once a second element has it: memory grows with the front between processed and pending elements,
/// which has the size of a surface where neighbours are close in order.
///
/// A face of three elements, which no valid mesh has, counts as free, of one of the three.
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
    recent: Recent,
    /// Faces pending for long.
    older: HashMap<Corners, Owner, Mixing>,
}

/// The corners of a face, ascending; faces with fewer than four end with the largest number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Corners([u32; 4]);

impl Corners {
    /// An invalid key: the corners of a face differ.
    const NONE: Self = Self([0; 4]);

    /// The distinct corners; `None` where so many coincide that the face is degenerate.
    fn of(mut nodes: [u32; 4], count: usize) -> Option<Self> {
        nodes.sort_unstable();
        let [a, b, c, d] = nodes;
        // Most faces have three or four distinct corners, and the largest number is not a node.
        let differ = if count == 4 { c < d } else { d == u32::MAX };
        if 3 <= count && a < b && b < c && differ {
            return Some(Self(nodes));
        }
        let mut kept = [u32::MAX; 4];
        let mut found = 0;
        for corner in &nodes[..count] {
            if found == 0 || kept[found - 1] != *corner {
                kept[found] = *corner;
                found += 1;
            }
        }
        (count.min(3) <= found).then_some(Self(kept))
    }
}

/// The element of a face, and its label there; without a label it is not requested.
#[derive(Debug, Clone, Copy)]
struct Owner {
    element: u64,
    label: Option<FaceLabel>,
}

/// A face without a second element so far.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    corners: Corners,
    owner: Owner,
}

/// The associativity of the cache of recent faces.
const WAYS: usize = 4;
/// The minimum and maximum number of cache sets, powers of two; the maximum takes 8 MiB.
const FEWEST_PLACES: usize = 1 << 6;
const MAX_PLACES: usize = 1 << 16;

/// A cache of recent faces. Neighbours are mostly close in order and number, so most faces are matched here, within the processor's cache.
///
/// The set of a face follows from its smallest node: elements with close numbers use close sets. Where a set is full, the oldest face is evicted.
/// It may be evicted before the second element comes, so that the same face is here and among the older ones; [`FreeFaces::finish`] matches them.
#[derive(Debug, Default)]
struct Recent {
    /// In each set the newest first; entries without corners are empty.
    places: Vec<[Waiting; WAYS]>,
    /// The number of evictions since the last resize.
    left: usize,
}

impl Recent {
    const NOBODY: Waiting = Waiting { corners: Corners::NONE, owner: Owner { element: 0, label: None } };

    /// Removes the face if it is present, otherwise inserts it; returns the evicted one.
    fn meet(&mut self, new: Waiting) -> Option<Waiting> {
        if self.places.is_empty() {
            self.places = vec![[Self::NOBODY; WAYS]; FEWEST_PLACES];
        }
        let at = self.place(new.corners);
        let place = &mut self.places[at];
        let mut free = WAYS - 1;
        for (way, waiting) in place.iter_mut().enumerate() {
            if waiting.corners == new.corners {
                *waiting = Self::NOBODY;
                return None;
            }
            if waiting.corners == Corners::NONE {
                free = way;
            }
        }
        let oldest = place[free];
        place.copy_within(..free, 1);
        place[0] = new;
        (oldest.corners != Corners::NONE).then_some(oldest)
    }

    fn place(&self, Corners([a, b, c, _]): Corners) -> usize {
        let spread = b.wrapping_add(c).wrapping_mul(0x9E37_79B9) >> 29;
        (a ^ spread) as usize & (self.places.len() - 1)
    }

    /// Whether a larger cache would keep more faces.
    fn is_crowded(&self) -> bool {
        self.places.len() < MAX_PLACES && self.places.len() < self.left
    }

    fn faces(self) -> impl Iterator<Item = Waiting> {
        self.places.into_iter().flatten().filter(|waiting| waiting.corners != Corners::NONE)
    }
}

impl Hash for Corners {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let Self([a, b, c, d]) = *self;
        state.write_u64(u64::from(a) << 32 | u64::from(b));
        state.write_u64(u64::from(c) << 32 | u64::from(d));
    }
}

/// A fast multiplicative hash for millions of faces, with a random seed against crafted collisions.
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

    /// Adds an element, by the caller's number, whose free faces are requested. Shells are left out: both of their sides are free.
    pub fn add(&mut self, element: u64, shape: ElementShape, nodes: &[NodeId]) {
        self.meet(shape, nodes, Some(element));
    }

    /// Adds an element whose own faces are not requested, but which may cover requested ones.
    pub fn cover(&mut self, shape: ElementShape, nodes: &[NodeId]) {
        self.meet(shape, nodes, None);
    }

    fn meet(&mut self, shape: ElementShape, nodes: &[NodeId], element: Option<u64>) {
        if shape.is_sheet() {
            return;
        }
        for face in shape.faces() {
            let count = face.shape.corners();
            let mut corners = [u32::MAX; 4];
            for (corner, local) in corners.iter_mut().zip(&face.nodes[..count]) {
                *corner = nodes[usize::from(*local)].0;
            }
            let Some(corners) = Corners::of(corners, count) else { continue };
            let owner = Owner { element: element.unwrap_or(0), label: element.map(|_| face.label) };
            self.take(Waiting { corners, owner });
        }
    }

    fn take(&mut self, face: Waiting) {
        let Some(oldest) = self.recent.meet(face) else { return };
        Self::toggle(&mut self.older, oldest);
        self.recent.left += 1;
        if self.recent.is_crowded() {
            let places = vec![[Recent::NOBODY; WAYS]; 4 * self.recent.places.len()];
            let crowded = std::mem::replace(&mut self.recent, Recent { places, left: 0 });
            crowded.faces().for_each(|face| self.take(face));
        }
    }

    fn toggle(older: &mut HashMap<Corners, Owner, Mixing>, face: Waiting) {
        match older.entry(face.corners) {
            Entry::Occupied(met) => drop(met.remove()),
            Entry::Vacant(new) => drop(new.insert(face.owner)),
        }
    }

    /// The requested faces that no other element has, by element and label.
    pub fn finish(self) -> Vec<(u64, FaceLabel)> {
        let Self { recent, mut older } = self;
        recent.faces().for_each(|face| Self::toggle(&mut older, face));
        let wanted = |owner: Owner| owner.label.map(|label| (owner.element, label));
        let mut faces: Vec<(u64, FaceLabel)> = older.into_values().filter_map(wanted).collect();
        faces.sort_unstable();
        faces
    }
}
