//! Nodes and faces by their positions in the arrays of the caller, never by labels of a deck.

/// A node: its position in the caller's array of points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u32);

impl NodeId {
    /// The position as an index.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A face: its position in its [`Surface`](crate::Surface).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FaceId(pub u32);

impl FaceId {
    /// The position as an index.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}
