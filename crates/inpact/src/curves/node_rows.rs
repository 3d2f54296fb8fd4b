//! Rows of a node table on the curves of a law: the positions of the nodes, and how many of them lie outside the table.

use super::Side;
use crate::text::counted;

/// The rows of a node table that a law of an interaction governs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NodeRows {
    /// The number of rows, while open and while closed.
    pub count: [u64; 2],
    /// The number of them beyond the rows of the table along any variable, while open and while closed.
    pub beyond: [u64; 2],
    /// An evenly spaced sample of them.
    pub sample: Vec<NodeSample>,
}

/// A row of a node table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeSample {
    /// On which side of contact.
    pub side: Side,
    /// Clearance or contact pressure.
    pub x: f64,
    /// The law's value there, at the row's own temperature and field variables.
    pub y: f64,
}

impl NodeRows {
    /// The number of rows on both sides.
    pub fn total(&self) -> u64 {
        self.count[0] + self.count[1]
    }

    /// In one line: `256 rows: 224 closed, 32 open; 36 beyond the table (14.1 %)`.
    pub fn summary(&self) -> String {
        let (open, closed) = (self.count[0], self.count[1]);
        let beyond = self.beyond[0] + self.beyond[1];
        let rows = counted(self.total(), "row");
        let share = 100.0 * beyond as f64 / self.total().max(1) as f64;
        format!("{rows}: {closed} closed, {open} open; {beyond} beyond the table ({share:.1} %)")
    }
}
