//! Disjoint sets of nodes (union–find).

/// Disjoint sets of the numbers below some count; initially singletons.
#[derive(Clone, Debug)]
pub(crate) struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    pub(crate) fn new(count: usize) -> Self {
        Self { parent: (0..count).map(index).collect() }
    }

    /// The representative of the set of `member`.
    pub(crate) fn of(&mut self, member: u32) -> u32 {
        let mut at = member;
        while self.parent[at as usize] != at {
            let above = self.parent[self.parent[at as usize] as usize];
            self.parent[at as usize] = above;
            at = above;
        }
        at
    }

    /// Joins the sets of the representatives `into` and `other`; `into` represents the union.
    pub(crate) fn join_roots(&mut self, into: u32, other: u32) {
        self.parent[other as usize] = into;
    }

    /// Joins the sets of two members; the smaller representative stays.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.of(a), self.of(b));
        self.join_roots(a.min(b), a.max(b));
    }
}

/// A count of nodes or links as the index type of networks.
///
/// # Panics
/// Beyond 2³² − 1, which no scene in memory reaches.
pub(crate) fn index(count: usize) -> u32 {
    u32::try_from(count).expect("fewer than 2^32 nodes and links")
}
