//! Eliminates the parts of a network into which nothing can flow before anything is factored, and recovers their values exactly.
//!
//! A part that is joined to the rest by a single node, or by known values that are all equal, and has no source, has that value everywhere and no flow.
//! Solving for it would give spurious flows from rounding, which refinement can only reduce, some sixteen decades a step, until they underflow.
//!
//! They are found by depth-first search, as articulation points: below a node from which no conductance leads past its parent, all nodes are joined to the rest by the parent alone (Tarjan, SIAM J. Comput. 1 (1972) 146–160).
//! All known values are one node of the search, its root.

use super::core::{Core, NONE};
use super::found::CoreFound;
use super::sets::index;
use inpact_evaluation::numbers::DoubleDouble;

/// The free nodes in such parts, those nearer to the rest first, each with the number whose value it has.
#[derive(Clone, Debug, Default)]
pub(crate) struct DeadEnds {
    /// By free node; `NONE` for those in which something may flow. Empty where there is no such part.
    anchors: Vec<u32>,
}

/// Summary of the subtree of a node in the search.
#[derive(Clone, Copy)]
struct Below {
    /// The earliest node of the search reached by a conductance (low-link).
    earliest: u32,
    has_source: bool,
    known: Known,
}

/// The known values that conductances lead to.
#[derive(Clone, Copy)]
enum Known {
    None,
    /// All of them equal the value of this number.
    One(u32),
    Different,
}

impl DeadEnds {
    /// Finds the parts of a core.
    pub(crate) fn find(core: &Core) -> Self {
        let anchors = Walk::new(core).run();
        Self { anchors: if anchors.iter().all(|&anchor| anchor == NONE) { Vec::new() } else { anchors } }
    }

    /// Whether nothing can flow at a number.
    pub(crate) fn is_dead_end(&self, number: u32) -> bool {
        self.anchors.get(number as usize).is_some_and(|&anchor| anchor != NONE)
    }

    /// The number of nodes in dead ends.
    pub(crate) fn count(&self) -> usize {
        self.anchors.iter().filter(|&&anchor| anchor != NONE).count()
    }

    /// Recovers the nodes: their values, with zero flows.
    pub(super) fn put_back(&self, core: &Core, found: &mut CoreFound) {
        for (node, &anchor) in (0..).zip(&self.anchors).filter(|(_, anchor)| **anchor != NONE) {
            found.values[node as usize] = core.value(&found.values, anchor);
            if let Some(forest) = &mut found.forest {
                forest.attach(node, anchor, DoubleDouble::ZERO);
            }
        }
    }
}

/// Depth-first search over the free nodes of a core, from its known values.
struct Walk<'a> {
    core: &'a Core,
    /// The elements at each free node.
    start: Vec<u32>,
    elements: Vec<u32>,
    /// The nodes in the order of the search, and the number of each in it, from 1; 0 is the root.
    order: Vec<u32>,
    place: Vec<u32>,
    /// The parent of each node in the search; `NONE` for the root.
    above: Vec<u32>,
    below: Vec<Below>,
}

impl<'a> Walk<'a> {
    fn new(core: &'a Core) -> Self {
        let free = core.free as usize;
        let free_ends = || {
            (0..)
                .zip(&core.elements)
                .flat_map(|(number, element)| element.ends.map(|end| (number, end)))
                .filter(|(_, end)| core.is_free(*end))
        };
        let mut start = vec![0_u32; free + 1];
        free_ends().for_each(|(_, end)| start[end as usize] += 1);
        let mut sum = 0;
        for begin in &mut start {
            sum += *begin;
            *begin = sum;
        }
        let mut elements = vec![NONE; sum as usize];
        for (number, end) in free_ends() {
            start[end as usize] -= 1;
            elements[start[end as usize] as usize] = number;
        }
        let nothing = Below { earliest: NONE, has_source: false, known: Known::None };
        Self {
            core,
            start,
            elements,
            order: Vec::with_capacity(free),
            place: vec![0; free],
            above: vec![NONE; free],
            below: vec![nothing; free],
        }
    }

    /// For each free node the number whose value it takes, as nothing can flow between the two.
    fn run(mut self) -> Vec<u32> {
        for element in &self.core.elements {
            let [a, b] = element.ends;
            for node in [a, b] {
                let is_at_root = !self.core.is_free(a) || !self.core.is_free(b);
                if is_at_root && self.core.is_free(node) && self.place[node as usize] == 0 {
                    self.descend(node);
                }
            }
        }
        let mut anchors = vec![NONE; self.core.free as usize];
        for &node in &self.order {
            let above = self.above[node as usize];
            let of_above = if above == NONE { NONE } else { anchors[above as usize] };
            anchors[node as usize] = if of_above == NONE { self.anchor(node) } else { of_above };
        }
        anchors
    }

    /// The number whose value the subtree of a node takes, as it has no source; `NONE` where something may flow.
    fn anchor(&self, node: u32) -> u32 {
        let Below { earliest, has_source, known } = self.below[node as usize];
        let above = self.above[node as usize];
        match known {
            _ if has_source => NONE,
            Known::One(number) if above == NONE => number,
            _ if above == NONE => NONE,
            _ if self.place[above as usize] <= earliest => above,
            _ => NONE,
        }
    }

    /// Searches from a neighbour of the root to all nodes not reached yet.
    fn descend(&mut self, top: u32) {
        self.enter(top, NONE);
        let mut path = vec![(top, self.start[top as usize])];
        while let Some((node, next)) = path.last_mut() {
            let node = *node;
            if *next == self.start[node as usize + 1] {
                path.pop();
                self.leave(node);
                continue;
            }
            let element = &self.core.elements[self.elements[*next as usize] as usize];
            *next += 1;
            let other = if element.ends[0] == node { element.ends[1] } else { element.ends[0] };
            if !self.core.is_free(other) {
                self.meet_known(node, other);
            } else if self.place[other as usize] == 0 {
                self.enter(other, node);
                path.push((other, self.start[other as usize]));
            } else {
                let below = &mut self.below[node as usize];
                below.earliest = below.earliest.min(self.place[other as usize]);
            }
        }
    }

    fn enter(&mut self, node: u32, above: u32) {
        self.order.push(node);
        self.place[node as usize] = index(self.order.len());
        self.above[node as usize] = above;
        self.below[node as usize].has_source = !self.core.sources[node as usize].is_zero();
    }

    /// Merges the summary of a node into that of its parent.
    fn leave(&mut self, node: u32) {
        let above = self.above[node as usize];
        if above == NONE {
            return;
        }
        let of_node = self.below[node as usize];
        let below = &mut self.below[above as usize];
        below.earliest = below.earliest.min(of_node.earliest);
        below.has_source |= of_node.has_source;
        match of_node.known {
            Known::None => {}
            Known::One(number) => self.meet_known(above, number),
            Known::Different => below.known = Known::Different,
        }
    }

    fn meet_known(&mut self, node: u32, number: u32) {
        let value = |number: u32| self.core.known[(number - self.core.free) as usize];
        let below = &mut self.below[node as usize];
        below.earliest = 0;
        below.known = match below.known {
            Known::None => Known::One(number),
            Known::One(other) if value(other) == value(number) => Known::One(other),
            _ => Known::Different,
        };
    }
}
