//! The content of sets: numbers and whole options, in each instance.

use super::labels::Labels;
use crate::span::Span;
use std::collections::BTreeMap;

/// Kinds of sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    Elements,
    Nodes,
}

/// Numbers, and whole options whose rows are all selected.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Selection {
    pub(super) labels: Labels,
    /// The keyword lines of *NODE or *ELEMENT options.
    pub(super) options: Vec<Span>,
}

impl Selection {
    pub(super) fn add_all(&mut self, other: &Self) {
        self.labels.add_all(&other.labels);
        self.options.extend_from_slice(&other.options);
    }

    /// The number, if there is only one.
    pub(super) fn single(&self) -> Option<u32> {
        self.labels.single().filter(|_| self.options.is_empty())
    }

    /// Whether it has the number in the rows of this option.
    pub(super) fn contains(&self, label: u32, option: Span) -> bool {
        self.options.contains(&option) || self.labels.contains(label)
    }

    /// Whether it can contain rows of this option.
    pub(super) fn may_touch(&self, option: Span) -> bool {
        !self.labels.is_empty() || self.options.contains(&option)
    }
}

/// Selections of a set in each instance.
pub(super) type Selected = BTreeMap<usize, Selection>;
