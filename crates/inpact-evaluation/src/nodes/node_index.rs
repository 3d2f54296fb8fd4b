//! Grouping of rows into histories: the rows of one node under one interaction.
//!
//! Where the rows of each node are contiguous, one history at a time is enough, and memory does not grow with the number of nodes:
//! [`NodeRuns`] detects this in a first pass, [`NodeIndex::by_node`] relies on it.

use super::node_label::NodeLabel;
use std::collections::hash_map::RandomState;
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasher, Hasher};

/// The maximum number of nodes remembered; a table of more nodes must have ascending numbers as labels.
const MAX_REMEMBERED: usize = 1 << 20;

/// The order of the rows by node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HistoryOrder {
    /// All rows of a node under one interaction are contiguous.
    ByNode,
    /// In any order: sorted by time, for example.
    #[default]
    Interleaved,
}

/// Numbers the nodes of each interaction in the order of first occurrence.
///
/// Memory grows with the number of nodes, not of rows; for tables sorted by node it does not grow.
///
/// Rows sorted by time have the nodes in the same order in every increment, so that the successor of the last node is tried before labels are hashed.
#[derive(Debug, Clone, Default)]
pub(crate) struct NodeIndex {
    order: HistoryOrder,
    interactions: Vec<NodesOfInteraction>,
    hash: LabelHash,
    met: MetNodes,
    last: usize,
    current: Option<Node>,
}

/// The numbers of the nodes of an interaction by their labels.
#[derive(Debug, Clone)]
struct NodesOfInteraction {
    by_number: HashMap<i64, usize, LabelHash>,
    by_text: HashMap<Box<[u8]>, usize, LabelHash>,
}

/// The nodes by their numbers.
#[derive(Debug, Clone, Default)]
struct MetNodes {
    nodes: Vec<(usize, MetLabel)>,
    /// The labels that are texts, one after the other.
    texts: Vec<u8>,
}

#[derive(Debug, Clone, Copy)]
enum MetLabel {
    Number(i64),
    /// It stands there among the texts.
    Text(usize, usize),
}

impl MetNodes {
    #[inline]
    fn is(&self, number: usize, interaction: usize, label: NodeLabel<'_>) -> bool {
        match (self.nodes.get(number), label) {
            (Some((of, MetLabel::Number(met))), NodeLabel::Number(label)) => *of == interaction && *met == label,
            (Some((of, MetLabel::Text(start, end))), NodeLabel::Text(label)) => {
                *of == interaction && self.texts[*start..*end] == *label
            }
            _ => false,
        }
    }

    fn push(&mut self, interaction: usize, label: NodeLabel<'_>) {
        let label = match label {
            NodeLabel::Number(number) => MetLabel::Number(number),
            NodeLabel::Text(text) => {
                let start = self.texts.len();
                self.texts.extend_from_slice(text);
                MetLabel::Text(start, self.texts.len())
            }
        };
        self.nodes.push((interaction, label));
    }
}

/// A node whose rows stand together.
#[derive(Debug, Clone)]
struct Node {
    interaction: usize,
    /// `None` where the label is a text.
    number: Option<i64>,
    text: Vec<u8>,
}

impl Node {
    /// Whether a row is of another node than the row before, which is the current one from now on.
    #[inline]
    fn begins(current: &mut Option<Self>, interaction: usize, label: NodeLabel<'_>) -> bool {
        let (number, text) = match label {
            NodeLabel::Number(number) => (Some(number), &[][..]),
            NodeLabel::Text(text) => (None, text),
        };
        if let Some(node) = current
            && (node.interaction, node.number) == (interaction, number)
            && (number.is_some() || node.text == text)
        {
            return false;
        }
        let node = current.get_or_insert_with(|| Self { interaction, number, text: Vec::new() });
        (node.interaction, node.number) = (interaction, number);
        node.text.clear();
        node.text.extend_from_slice(text);
        true
    }
}

/// Hashes labels, which are short, eight bytes at a time; a random key prevents crafted collisions.
#[derive(Debug, Clone, Copy)]
struct LabelHash {
    key: u64,
}

/// The state of [`LabelHash`] for a label.
struct LabelHasher(u64);

impl Default for LabelHash {
    fn default() -> Self {
        Self { key: RandomState::new().hash_one(0_u8) }
    }
}

impl BuildHasher for LabelHash {
    type Hasher = LabelHasher;

    fn build_hasher(&self) -> LabelHasher {
        LabelHasher(self.key)
    }
}

impl LabelHasher {
    /// Two rounds of the finaliser of splitmix64.
    fn mix(&mut self, word: u64) {
        let mixed = (self.0 ^ word).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 32)).wrapping_mul(0x94D0_49BB_1331_11EB);
        self.0 = mixed ^ (mixed >> 29);
    }
}

impl Hasher for LabelHasher {
    fn write(&mut self, bytes: &[u8]) {
        let (words, rest) = bytes.as_chunks();
        for word in words {
            self.mix(u64::from_le_bytes(*word));
        }
        let last = rest.iter().fold(rest.len() as u64, |last, byte| last << 8 | u64::from(*byte));
        self.mix(last);
    }

    fn write_usize(&mut self, length: usize) {
        self.mix(length as u64);
    }

    fn write_i64(&mut self, number: i64) {
        self.mix(number.cast_unsigned());
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

/// The slot of the history of a row's node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct HistorySlot {
    /// The number of the slot; at most the number of slots allocated before.
    pub(crate) number: usize,
    /// Whether the row is its node's first, so that the slot is empty or holds another node.
    pub(crate) is_first: bool,
}

/// Detects whether the rows of each node are contiguous.
///
/// A table is reported as [`ByNode`](HistoryOrder::ByNode) only if it is; one with very many nodes whose labels are not ascending numbers may be
/// reported as interleaved although it is not. Memory is bounded.
#[derive(Debug, Default)]
pub(crate) struct NodeRuns {
    current: Option<Node>,
    /// Whether every run so far had a label that is a greater number than that of the run before.
    ascends: Ascent,
    /// The hashes of the nodes so far; `None` once there are too many.
    met: Option<HashSet<u64>>,
    hasher: RandomState,
    has_met_again: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Ascent {
    #[default]
    NotBegun,
    To(i64),
    No,
}

impl NodeIndex {
    /// An index for a table in which the rows of each node are contiguous.
    pub(crate) fn by_node() -> Self {
        Self { order: HistoryOrder::ByNode, ..Self::default() }
    }

    /// The slot for the history of a row's node under interaction number `interaction`.
    ///
    /// For tables sorted by node there is one slot only.
    #[inline]
    pub(crate) fn enter(&mut self, interaction: usize, label: NodeLabel<'_>) -> HistorySlot {
        if self.order == HistoryOrder::ByNode {
            let is_first = Node::begins(&mut self.current, interaction, label);
            return HistorySlot { number: 0, is_first };
        }
        let before = self.met.nodes.len();
        let next = if self.last + 1 < before { self.last + 1 } else { 0 };
        self.last = if self.met.is(next, interaction, label) { next } else { self.find(interaction, label) };
        HistorySlot { number: self.last, is_first: before < self.met.nodes.len() }
    }

    /// The number of a node; a new node gets the next number.
    fn find(&mut self, interaction: usize, label: NodeLabel<'_>) -> usize {
        if self.interactions.len() <= interaction {
            let hash = self.hash;
            self.interactions.resize_with(interaction + 1, || NodesOfInteraction {
                by_number: HashMap::with_hasher(hash),
                by_text: HashMap::with_hasher(hash),
            });
        }
        let nodes = &mut self.interactions[interaction];
        let next = self.met.nodes.len();
        let number = match label {
            NodeLabel::Number(label) => *nodes.by_number.entry(label).or_insert(next),
            NodeLabel::Text(text) => match nodes.by_text.get(text) {
                Some(number) => *number,
                None => *nodes.by_text.entry(text.into()).or_insert(next),
            },
        };
        if number == next {
            self.met.push(interaction, label);
        }
        number
    }
}

impl NodeRuns {
    /// No rows yet.
    pub(crate) fn new() -> Self {
        Self { met: Some(HashSet::new()), ..Self::default() }
    }

    /// Adds the next row; true when it begins a run of rows of one node.
    #[inline]
    pub(crate) fn take(&mut self, interaction: usize, label: NodeLabel<'_>) -> bool {
        let begins = Node::begins(&mut self.current, interaction, label);
        if begins {
            self.begin(interaction, label);
        }
        begins
    }

    /// The order of the rows so far.
    pub(crate) fn order(&self) -> HistoryOrder {
        let is_by_node = self.ascends != Ascent::No || self.met.is_some() && !self.has_met_again;
        if is_by_node { HistoryOrder::ByNode } else { HistoryOrder::Interleaved }
    }

    fn begin(&mut self, interaction: usize, label: NodeLabel<'_>) {
        self.ascends = match (self.ascends, label) {
            (Ascent::NotBegun, NodeLabel::Number(number)) => Ascent::To(number),
            (Ascent::To(last), NodeLabel::Number(number)) if last < number => Ascent::To(number),
            _ => Ascent::No,
        };
        if let Some(met) = &mut self.met {
            // Two nodes with the same hash count as a recurring node, which is the safe side.
            self.has_met_again |= !met.insert(self.hasher.hash_one((interaction, label)));
            if self.has_met_again || MAX_REMEMBERED < met.len() {
                self.met = None;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn order(labels: &[&str]) -> HistoryOrder {
        let mut runs = NodeRuns::new();
        for label in labels {
            runs.take(0, NodeLabel::of_text(label.as_bytes()));
        }
        runs.order()
    }

    #[test]
    fn rows_of_a_node_stand_together_or_not() {
        assert_eq!(order(&[]), HistoryOrder::ByNode);
        assert_eq!(order(&["1", "1", " 1 ", "2", "10"]), HistoryOrder::ByNode);
        assert_eq!(order(&["b", "b", "a", "c"]), HistoryOrder::ByNode);
        assert_eq!(order(&["2", "1", "01"]), HistoryOrder::ByNode);
        assert_eq!(order(&["1", "2", "1"]), HistoryOrder::Interleaved);
        assert_eq!(order(&["a", "b", "b", "a"]), HistoryOrder::Interleaved);
    }

    #[test]
    fn many_nodes_must_ascend() {
        let many = i64::try_from(MAX_REMEMBERED).expect("a million") + 10;
        let mut runs = NodeRuns::new();
        for node in 0..many {
            runs.take(0, NodeLabel::Number(node));
        }
        assert_eq!(runs.order(), HistoryOrder::ByNode);
        assert!(runs.met.is_none());
        runs.take(0, NodeLabel::Number(5));
        assert_eq!(runs.order(), HistoryOrder::Interleaved);
    }

    proptest! {
        #[test]
        fn a_table_is_by_node_when_no_node_comes_again(rows in prop::collection::vec((0..2_usize, 0..5_u8), 0..12)) {
            let mut runs = NodeRuns::new();
            let mut changes = rows.clone();
            changes.dedup();
            let nodes: HashSet<(usize, u8)> = rows.iter().copied().collect();
            for (interaction, node) in &rows {
                runs.take(*interaction, NodeLabel::Number(i64::from(*node)));
            }
            let expected = if nodes.len() == changes.len() { HistoryOrder::ByNode } else { HistoryOrder::Interleaved };
            prop_assert_eq!(runs.order(), expected);
        }

        /// In any order of the rows, a node has one number, and each new node the next one.
        #[test]
        fn nodes_are_numbered_as_they_are_met(rows in prop::collection::vec((0..3_usize, 0..6_u8), 0..60)) {
            let mut index = NodeIndex::default();
            let mut met: Vec<(usize, u8)> = Vec::new();
            for node in rows {
                let known = met.iter().position(|known| *known == node);
                let text = [format!(" {} ", node.1), format!(" n{} ", node.1)][usize::from(node.1 % 2)].clone();
                let slot = index.enter(node.0, NodeLabel::of_text(text.as_bytes()));
                let number = known.unwrap_or(met.len());
                prop_assert_eq!(slot, HistorySlot { number, is_first: known.is_none() });
                if known.is_none() {
                    met.push(node);
                }
            }
        }

        #[test]
        fn slots_by_node_begin_where_slots_of_all_nodes_do(lengths in prop::collection::vec(1..4_usize, 0..9)) {
            let (mut all, mut by_node) = (NodeIndex::default(), NodeIndex::by_node());
            for (node, length) in lengths.iter().enumerate() {
                for _ in 0..*length {
                    let text = if node % 2 == 0 { node.to_string() } else { format!("n{node}") };
                    let slot = by_node.enter(1, NodeLabel::of_text(text.as_bytes()));
                    prop_assert_eq!(slot.number, 0);
                    let of_all = all.enter(1, NodeLabel::of_text(text.as_bytes()));
                    prop_assert_eq!(of_all, HistorySlot { number: node, is_first: slot.is_first });
                }
            }
        }
    }
}
