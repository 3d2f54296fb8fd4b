//! Grouping of rows into histories: the rows of one node under one interaction.
//!
//! Where the rows of each node are contiguous, one history at a time is enough, and memory does not grow with the number of nodes:
//! [`NodeRuns`] detects this in a first pass, [`NodeIndex::by_node`] relies on it.

use std::collections::hash_map::RandomState;
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasher, Hasher};

/// The maximum number of nodes remembered; a table of more nodes must have ascending numbers as labels.
const MOST_REMEMBERED: usize = 1 << 20;

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
/// Blanks around a label are ignored. Memory grows with the number of nodes, not of rows; for tables sorted by node it does not grow.
///
/// Rows sorted by time have the nodes in the same order in every increment, so that the successor of the last node is tried before labels are hashed.
#[derive(Debug, Clone, Default)]
pub struct NodeIndex {
    order: HistoryOrder,
    numbers: Vec<HashMap<Box<[u8]>, usize, LabelHash>>,
    hash: LabelHash,
    met: MetNodes,
    last: usize,
    current: Option<(usize, Vec<u8>)>,
}

/// The nodes by their numbers.
#[derive(Debug, Clone, Default)]
struct MetNodes {
    /// The interaction of each, and the end of its label.
    nodes: Vec<(usize, usize)>,
    /// Their concatenated labels.
    labels: Vec<u8>,
}

impl MetNodes {
    fn is(&self, number: usize, interaction: usize, label: &[u8]) -> bool {
        let Some(&(of, end)) = self.nodes.get(number) else { return false };
        let start = if number == 0 { 0 } else { self.nodes[number - 1].1 };
        of == interaction && self.labels[start..end] == *label
    }

    fn push(&mut self, interaction: usize, label: &[u8]) {
        self.labels.extend_from_slice(label);
        self.nodes.push((interaction, self.labels.len()));
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

    fn finish(&self) -> u64 {
        self.0
    }
}

/// The slot of the history of a row's node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HistorySlot {
    /// The number of the slot; at most the number of slots allocated before.
    pub number: usize,
    /// Whether the row is its node's first, so that the slot is empty or holds another node.
    pub is_first: bool,
}

/// Detects whether the rows of each node are contiguous.
///
/// A table is reported as [`ByNode`](HistoryOrder::ByNode) only if it is; one with very many nodes whose labels are not ascending numbers may be
/// reported as interleaved although it is not. Memory is bounded.
#[derive(Debug, Default)]
pub struct NodeRuns {
    current: Option<(usize, Vec<u8>)>,
    /// Whether the label of every run so far is a greater number than that of the previous run.
    ascends: Ascent,
    /// The hashes of the nodes so far; `None` once there are too many.
    met: Option<HashSet<u64>>,
    hasher: RandomState,
    has_met_again: bool,
    runs: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Ascent {
    #[default]
    NotBegun,
    To(u64),
    No,
}

impl NodeIndex {
    /// An index for a table in which the rows of each node are contiguous.
    pub fn by_node() -> Self {
        Self { order: HistoryOrder::ByNode, ..Self::default() }
    }

    /// The slot for the history of a row's node under interaction number `interaction`.
    ///
    /// For tables sorted by node there is one slot only.
    #[inline]
    pub fn enter(&mut self, interaction: usize, label: &[u8]) -> HistorySlot {
        if self.order == HistoryOrder::ByNode {
            let is_first = begins_run(&mut self.current, interaction, label);
            return HistorySlot { number: 0, is_first };
        }
        let before = self.met.nodes.len();
        let number = self.number(interaction, label);
        HistorySlot { number, is_first: before < self.met.nodes.len() }
    }

    /// The number of a node under interaction number `interaction`; a new node gets the next number.
    #[inline]
    pub fn number(&mut self, interaction: usize, label: &[u8]) -> usize {
        let label = label.trim_ascii();
        let next = if self.last + 1 < self.met.nodes.len() { self.last + 1 } else { 0 };
        self.last = if self.met.is(next, interaction, label) { next } else { self.find(interaction, label) };
        self.last
    }

    fn find(&mut self, interaction: usize, label: &[u8]) -> usize {
        if interaction >= self.numbers.len() {
            let hash = self.hash;
            self.numbers.resize_with(interaction + 1, || HashMap::with_hasher(hash));
        }
        let numbers = &mut self.numbers[interaction];
        if let Some(number) = numbers.get(label) {
            return *number;
        }
        let number = self.met.nodes.len();
        numbers.insert(label.into(), number);
        self.met.push(interaction, label);
        number
    }
}

impl NodeRuns {
    /// No rows yet.
    pub fn new() -> Self {
        Self { met: Some(HashSet::new()), ..Self::default() }
    }

    /// Adds the next row; true when it begins a run of rows of one node.
    #[inline]
    pub fn take(&mut self, interaction: usize, label: &[u8]) -> bool {
        let begins = begins_run(&mut self.current, interaction, label);
        if begins {
            self.begin(interaction, label.trim_ascii());
        }
        begins
    }

    /// The order of the rows so far.
    pub fn order(&self) -> HistoryOrder {
        let is_by_node = self.ascends != Ascent::No || self.met.is_some() && !self.has_met_again;
        if is_by_node { HistoryOrder::ByNode } else { HistoryOrder::Interleaved }
    }

    /// The number of runs; for tables sorted by node it is the number of nodes of all interactions.
    pub fn runs(&self) -> u64 {
        self.runs
    }

    fn begin(&mut self, interaction: usize, label: &[u8]) {
        self.runs += 1;
        self.ascends = match (self.ascends, whole_number(label)) {
            (Ascent::NotBegun, Some(number)) => Ascent::To(number),
            (Ascent::To(last), Some(number)) if last < number => Ascent::To(number),
            _ => Ascent::No,
        };
        if let Some(met) = &mut self.met {
            // Two nodes with the same hash count as a recurring node, which is the safe side.
            self.has_met_again |= !met.insert(self.hasher.hash_one((interaction, label)));
            if self.has_met_again || MOST_REMEMBERED < met.len() {
                self.met = None;
            }
        }
    }
}

/// Whether a row is of another node than the previous row.
#[inline]
fn begins_run(current: &mut Option<(usize, Vec<u8>)>, interaction: usize, label: &[u8]) -> bool {
    let label = label.trim_ascii();
    match current {
        Some((of, text)) if *of == interaction && text == label => false,
        Some((of, text)) => {
            *of = interaction;
            text.clear();
            text.extend_from_slice(label);
            true
        }
        None => {
            *current = Some((interaction, label.to_vec()));
            true
        }
    }
}

/// A label that is a number without leading zeros, so that equal numbers are equal labels.
fn whole_number(label: &[u8]) -> Option<u64> {
    let is_number = label.iter().all(u8::is_ascii_digit) && (label.len() == 1 || label.first() != Some(&b'0'));
    std::str::from_utf8(label).ok().filter(|_| is_number)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn order(labels: &[&str]) -> HistoryOrder {
        let mut runs = NodeRuns::new();
        for label in labels {
            runs.take(0, label.as_bytes());
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
        let many = MOST_REMEMBERED as u64 + 10;
        let mut runs = NodeRuns::new();
        for node in 0..many {
            runs.take(0, node.to_string().as_bytes());
        }
        assert_eq!((runs.order(), runs.runs()), (HistoryOrder::ByNode, many));
        assert!(runs.met.is_none());
        runs.take(0, b"5");
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
                runs.take(*interaction, node.to_string().as_bytes());
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
                let slot = index.enter(node.0, format!(" {} ", node.1).as_bytes());
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
                    let label = node.to_string();
                    let slot = by_node.enter(1, label.as_bytes());
                    prop_assert_eq!(slot.number, 0);
                    let of_all = all.enter(1, label.as_bytes());
                    prop_assert_eq!(of_all, HistorySlot { number: node, is_first: slot.is_first });
                }
            }
        }
    }
}
