//! The unknowns in relative form: no large conductance is ever added to a small one.
//!
//! Where a conductance is far stronger than its surroundings, the two nodes it joins have nearly one value, and the equation of either says little else.
//! In plain assembly the sum of both equations, which is what the surroundings act on, is lost to rounding.
//! Here the second node's unknown is its *jump* from the first: the strong conductance is in the equation of the jump alone,
//! and the first node's equation is the balance of both, in which the strong conductance does not occur.
//!
//! For any mixture of strengths: conductances are grouped into levels of strength (`strength.rs`), and a spanning forest of the strongest ones joins every free node to a known value,
//! level by level, so that the path between two nodes uses no weaker level than necessary. Nodes that the levels down to some strength join are a cluster; its top node in the forest represents it.
//! A node's unknown is its jump from the top of the cluster into which its own conductance in the forest leads, and its equation is the balance of all nodes below it.
//! With one level every jump is from a known value, which is plain assembly.
//!
//! The matrix of the jumps, each scaled by the strength of its level, has entries of at most about 1 whatever the strengths, computed without cancellation:
//! its condition number depends on the shape of the network and on the width of a level, not on the contrast.
//!
//! Source: relative displacements across an interface as unknowns of their own, J. Ghaboussi, E. L. Wilson and J. Isenberg, Finite element for rock joints and interfaces,
//! J. Soil Mech. Found. Div. ASCE 99 (1973) 833–848, there for joints marked by the user; here for every conductance by its strength.
//!
//! The largest relative errors of a potential and of a flow in a grid of 100 × 100 nodes with one interface, whose conductances are larger than the others by the factor given (docs/network.md, which
//! also has those of random networks):
//!
//! | factor | plain assembly, one factor: potential | flow | here, refined: potential | flow |
//! |---|---|---|---|---|
//! | 1e-300 | 4.6e-14 | 1 | 0 | 0 |
//! | 1e-20 | 4.6e-14 | 1 | 0 | 0 |
//! | 1 | 1.8e-14 | 2.5e-9 | 0 | 0 |
//! | 1e8 | 1.5e-7 | 6.7e-3 | 0 | 0 |
//! | 1e15 and above | no pivot above zero | | 0 | 0 |
//!
//! The solution is *stored* as the jump along each conductance of the forest, so that a flow of 1e-100 beside one of 1 has all its digits.

use super::core::{Core, Element, NONE};
use super::sets::{Sets, index};
use super::strength::Levels;
use inpact_evaluation::numbers::DoubleDouble;

/// The unknowns of a core: one for each remaining free node.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    /// The unknown of each free node; `NONE` for eliminated nodes.
    pub(crate) of_node: Vec<u32>,
    /// The node of each unknown.
    pub(crate) nodes: Vec<u32>,
    /// The unknowns, parents before children.
    pub(crate) order: Vec<u32>,
    /// The element of the forest between each unknown and its parent.
    pub(crate) branches: Vec<u32>,
    /// The parent of each unknown in the forest; `NONE` for a known value.
    pub(crate) parents: Vec<u32>,
    /// The level of that element.
    pub(crate) levels: Vec<u16>,
    /// The unknown at the top of its cluster, from which its jump is counted; `NONE` for a known value.
    pub(crate) tops: Vec<u32>,
    /// The known value at the root of its tree; a number of the core.
    pub(crate) bases: Vec<u32>,
    /// For each level an even exponent s: unknowns and jumps are stored times 2^s, so that they have the magnitude of flows.
    pub(crate) scales: Vec<i32>,
}

impl Form {
    /// Chooses the unknowns of the remaining nodes and elements.
    pub(crate) fn choose(core: &Core, is_there: &[bool], is_free: &[bool]) -> Self {
        let conducts = |(number, element): &(usize, &Element)| is_there[*number] && element.conductance.to_f64() > 0.0;
        let there = || core.elements.iter().enumerate().filter(conducts);
        let levels = Levels::of(there().map(|(_, element)| element));
        let mut of_node = vec![NONE; core.free as usize];
        let mut nodes = Vec::new();
        for (node, place) in of_node.iter_mut().enumerate().filter(|(node, _)| is_free[*node]) {
            *place = index(nodes.len());
            nodes.push(index(node));
        }
        let mut by_level: Vec<Vec<u32>> = vec![Vec::new(); levels.count()];
        for (number, element) in there() {
            by_level[levels.of_element(element) as usize].push(index(number));
        }
        let count = nodes.len();
        let mut form = Self {
            of_node,
            nodes,
            order: Vec::with_capacity(count),
            branches: vec![NONE; count],
            parents: vec![NONE; count],
            levels: vec![0; count],
            tops: vec![NONE; count],
            bases: vec![NONE; count],
            scales: levels.scales(),
        };
        let forest = form.forest(core, &by_level);
        form.orient(core, &levels, &forest);
        form.find_tops();
        form
    }

    /// The number of unknowns.
    pub(crate) fn count(&self) -> usize {
        self.nodes.len()
    }

    /// The number of unknowns that are jumps from another unknown.
    pub(crate) fn relative(&self) -> usize {
        self.tops.iter().filter(|top| **top != NONE).count()
    }

    /// The scaling exponent of unknown `unknown` and its jump in the forest.
    #[inline]
    pub(crate) fn scale(&self, unknown: u32) -> i32 {
        self.scales[self.levels[unknown as usize] as usize]
    }

    /// The unknowns at the ends of an element; `NONE` for a known value.
    #[inline]
    pub(crate) fn ends(&self, core: &Core, element: &Element) -> [u32; 2] {
        element.ends.map(|end| if core.is_free(end) { self.of_node[end as usize] } else { NONE })
    }

    /// The known value that a number of the core is relative to; for a known value itself.
    #[inline]
    pub(crate) fn base_of(&self, core: &Core, number: u32) -> DoubleDouble {
        let base = if core.is_free(number) { self.bases[self.of_node[number as usize] as usize] } else { number };
        core.known[(base - core.free) as usize]
    }

    /// Calls `take` with each unknown in the difference between two, and the sign with which it counts in first − second.
    #[inline]
    pub(crate) fn on_way(&self, [mut first, mut second]: [u32; 2], mut take: impl FnMut(u32, f64)) {
        // Levels ascend on the path to a known value, so both paths meet at the lowest common ancestor.
        while first != second {
            let level = |unknown: u32| if unknown == NONE { u16::MAX } else { self.levels[unknown as usize] };
            let (of_first, of_second) = (level(first), level(second));
            if of_first <= of_second && first != NONE {
                take(first, 1.0);
                first = self.tops[first as usize];
            }
            if of_second <= of_first && second != NONE {
                take(second, -1.0);
                second = self.tops[second as usize];
            }
        }
    }

    /// The elements of a forest that joins every unknown to a known value, from the strongest level on.
    fn forest(&self, core: &Core, by_level: &[Vec<u32>]) -> Vec<u32> {
        // All known values are one set: a tree needs no path between them.
        let known = index(self.count());
        let mut sets = Sets::new(self.count() + 1);
        let mut forest = Vec::with_capacity(self.count());
        for elements in by_level {
            for &number in elements {
                let ends = self.ends(core, &core.elements[number as usize]);
                let [a, b] = ends.map(|end| sets.of(end.min(known)));
                if a != b {
                    sets.join_roots(a.min(b), a.max(b));
                    forest.push(number);
                }
            }
        }
        forest
    }

    /// Links every unknown to the next one towards a known value.
    fn orient(&mut self, core: &Core, levels: &Levels, forest: &[u32]) {
        let mut start = vec![0_u32; self.count() + 1];
        let ends: Vec<[u32; 2]> =
            forest.iter().map(|&number| self.ends(core, &core.elements[number as usize])).collect();
        for end in ends.iter().flatten().filter(|end| **end != NONE) {
            start[*end as usize + 1] += 1;
        }
        for unknown in 0..self.count() {
            start[unknown + 1] += start[unknown];
        }
        let mut next = start.clone();
        let mut branches = vec![0_u32; start[self.count()] as usize];
        for (branch, ends) in ends.iter().enumerate() {
            for &end in ends.iter().filter(|end| **end != NONE) {
                branches[next[end as usize] as usize] = index(branch);
                next[end as usize] += 1;
            }
        }
        for (branch, ends) in ends.iter().enumerate() {
            let (unknown, known_end) = match *ends {
                [NONE, unknown] => (unknown, 0),
                [unknown, NONE] => (unknown, 1),
                _ => continue,
            };
            self.branches[unknown as usize] = forest[branch];
            self.bases[unknown as usize] = core.elements[forest[branch] as usize].ends[known_end];
            self.order.push(unknown);
        }
        let mut done = 0;
        while let Some(&unknown) = self.order.get(done) {
            done += 1;
            for place in start[unknown as usize]..start[unknown as usize + 1] {
                let branch = branches[place as usize] as usize;
                let [a, b] = ends[branch];
                let other = if a == unknown { b } else { a };
                if other == NONE || self.branches[other as usize] != NONE {
                    continue;
                }
                self.branches[other as usize] = forest[branch];
                self.parents[other as usize] = unknown;
                self.bases[other as usize] = self.bases[unknown as usize];
                self.order.push(other);
            }
        }
        for (level, &number) in self.levels.iter_mut().zip(&self.branches) {
            *level = levels.of_element(&core.elements[number as usize]);
        }
    }

    /// Finds the top of each unknown's cluster: up the forest as long as elements are at least as strong as its own.
    fn find_tops(&mut self) {
        for &unknown in &self.order {
            let level = self.levels[unknown as usize];
            let mut top = self.parents[unknown as usize];
            while top != NONE && self.levels[top as usize] <= level {
                top = self.tops[top as usize];
            }
            self.tops[unknown as usize] = top;
        }
    }
}
