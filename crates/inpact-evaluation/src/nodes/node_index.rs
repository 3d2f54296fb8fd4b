//! Which rows belong to one history: the rows of one node under one interaction.

use std::collections::HashMap;

/// Numbers the nodes of each interaction in the order they are first met.
///
/// Blanks around a label do not count. Memory grows with the number of nodes, not of rows.
#[derive(Debug, Clone, Default)]
pub struct NodeIndex {
    numbers: Vec<HashMap<Box<[u8]>, usize>>,
    count: usize,
}

impl NodeIndex {
    /// The number of a node under interaction number `interaction`; a new node gets the next number.
    #[inline]
    pub fn number(&mut self, interaction: usize, label: &[u8]) -> usize {
        if interaction >= self.numbers.len() {
            self.numbers.resize_with(interaction + 1, HashMap::new);
        }
        let label = label.trim_ascii();
        let numbers = &mut self.numbers[interaction];
        if let Some(number) = numbers.get(label) {
            return *number;
        }
        let number = self.count;
        numbers.insert(label.into(), number);
        self.count += 1;
        number
    }

    /// How many nodes interaction number `interaction` has.
    pub fn count_of(&self, interaction: usize) -> usize {
        self.numbers.get(interaction).map_or(0, HashMap::len)
    }
}
