//! The spanning forest from known values to free nodes, with the jump along each branch: it determines the jump across a link whose flow does not.
//!
//! No flow determines the jump across a link that conducts nothing, or so little that the flow is below the range of f64,
//! and the difference of two values of 100 has lost a jump of 1e-40.
//! The jumps along the forest and along the eliminated parts have all their digits; the jump is their sum along the path from one node to the other.

use super::core::{Core, NONE, ROUNDING};
use inpact_evaluation::numbers::DoubleDouble;

/// The parent of each free node of a core, and the jump from there.
#[derive(Clone, Debug)]
pub(super) struct SpanningForest {
    /// The parent of each free node: the number of a free node or of a known value.
    parents: Vec<u32>,
    steps: Vec<DoubleDouble>,
    /// The depth of each node: 1 next to a known value.
    depths: Vec<u32>,
    /// The nearest ancestor of each node whose value differs from its parent's.
    representatives: Vec<u32>,
}

impl SpanningForest {
    pub(super) fn new(core: &Core) -> Self {
        let nodes = core.free as usize;
        Self {
            parents: vec![NONE; nodes],
            steps: vec![DoubleDouble::ZERO; nodes],
            depths: vec![0; nodes],
            representatives: vec![NONE; nodes],
        }
    }

    /// Attaches a node to a known value or to a node attached before; its value differs from that by `step`.
    pub(super) fn attach(&mut self, node: u32, parent: u32, step: DoubleDouble) {
        self.representatives[node as usize] = if step.is_zero() { self.representative(parent) } else { node };
        self.depths[node as usize] = self.depth(parent) + 1;
        self.parents[node as usize] = parent;
        self.steps[node as usize] = step;
    }

    /// The jump from the second to the first of two numbers; `None` where it is within rounding.
    pub(super) fn jump(&self, core: &Core, ends: [u32; 2]) -> DoubleDouble {
        let [mut first, mut second] = ends.map(|end| self.representative(end));
        let (mut jump, mut parts) = (DoubleDouble::ZERO, 0.0);
        let mut add = |step: DoubleDouble| {
            jump += step;
            parts += step.to_f64().abs();
        };
        while first != second && (core.is_free(first) || core.is_free(second)) {
            if self.depth(second) <= self.depth(first) {
                add(self.steps[first as usize]);
                first = self.representative(self.parents[first as usize]);
            } else {
                add(-self.steps[second as usize]);
                second = self.representative(self.parents[second as usize]);
            }
        }
        if first != second {
            let known = |number: u32| core.known[(number - core.free) as usize];
            add(known(first));
            add(-known(second));
        }
        if jump.to_f64().abs() <= ROUNDING * parts { DoubleDouble::ZERO } else { jump }
    }

    /// Zero for a known value.
    fn depth(&self, number: u32) -> u32 {
        self.depths.get(number as usize).copied().unwrap_or(0)
    }

    fn representative(&self, number: u32) -> u32 {
        self.representatives.get(number as usize).copied().unwrap_or(number)
    }
}
