//! Series reduction: nodes that only pass on their flow are eliminated before anything is factored, and recovered exactly.
//!
//! A free node with two conductances g₁ and g₂ and no source is replaced by one conductance g₁g₂/(g₁+g₂).
//! A free node with one conductance sends its source through that.
//! So the slave node between a body's link and an interface of constant conductance is not an unknown, and a chain of links has none at all.
//! Sums and quotients of positive numbers do not cancel, and they are computed in 106 bits, so that a chain of any length is as accurate as one link.
//! Where the single conductance would underflow the node stays.
//! A node with two conductances *and* a source stays: distributing its source to its neighbours would give cancelling flows far larger than the actual ones.

use super::core::{Core, Element, NONE};
use super::dead_ends::DeadEnds;
use super::found::{CoreFound, SMALL};
use super::sets::index;
use super::spanning_forest::SpanningForest;
use inpact_evaluation::numbers::DoubleDouble;

/// The eliminated nodes, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series {
    steps: Vec<Step>,
    /// The remaining elements, including new ones.
    pub(crate) is_there: Vec<bool>,
    /// Whether a free node remains.
    pub(crate) is_free: Vec<bool>,
}

/// An eliminated node.
#[derive(Clone, Copy, Debug)]
struct Step {
    node: u32,
    source: DoubleDouble,
    /// The conductances it had; the second is `NONE` at the end of a chain.
    elements: [u32; 2],
    /// The element that replaces them, from the far end of the first to that of the second; `NONE` where both lead to one node.
    made: u32,
}

impl Series {
    /// Eliminates dead ends from a core, and every free node with one or two conductances, except those that must stay.
    pub(crate) fn take_out(core: &mut Core, dead_ends: &DeadEnds, stays: &dyn Fn(u32) -> bool) -> Self {
        let is_dead_end = |&end: &u32| dead_ends.is_dead_end(end);
        let mut series = Self {
            steps: Vec::new(),
            is_there: core.elements.iter().map(|element| !element.ends.iter().any(is_dead_end)).collect(),
            is_free: (0..core.free).map(|node| !dead_ends.is_dead_end(node)).collect(),
        };
        let mut degrees = vec![0_u32; core.free as usize];
        let there = core.elements.iter().zip(&series.is_there).filter_map(|(of, is_there)| is_there.then_some(of));
        for end in there.flat_map(|element| element.ends) {
            if let Some(degree) = degrees.get_mut(end as usize) {
                *degree += 1;
            }
        }
        let is_due = |(node, degree): (u32, &u32)| (1..=2).contains(degree) && !stays(node);
        if (0..).zip(&degrees).any(is_due) {
            Walk {
                incident: Incident::of(core, &series.is_there, &degrees),
                degrees,
                core,
                series: &mut series,
                stays,
            }
            .run();
        }
        series
    }

    /// The number of eliminated nodes.
    pub(crate) fn count(&self) -> usize {
        self.steps.len()
    }

    /// Recovers the nodes: their values, and the flow from the first to the second end of each element.
    pub(super) fn put_back(&self, core: &Core, found: &mut CoreFound) {
        let CoreFound { values, flows, forest } = found;
        for step in self.steps.iter().rev() {
            let Step { node, source, elements, made } = *step;
            let through = if made == NONE { DoubleDouble::ZERO } else { flows[made as usize] };
            let leaving = match elements {
                [first, NONE] => [(first, source), (NONE, DoubleDouble::ZERO)],
                [first, second] => [(first, -through), (second, through)],
            };
            for (element, leaving) in leaving.into_iter().filter(|(element, _)| *element != NONE) {
                let is_from_node = core.elements[element as usize].ends[0] == node;
                flows[element as usize] = if is_from_node { leaving } else { -leaving };
            }
            let (strongest, leaving) = match leaving {
                [first, (NONE, _)] => first,
                [first, second] if strength(core, first.0) >= strength(core, second.0) => first,
                [_, second] => second,
            };
            let other = far_end(core, strongest, node);
            let step = match forest {
                Some(forest) if made != NONE && through.to_f64().abs() <= SMALL => {
                    step_of_two(core, forest, elements.map(|element| (element, far_end(core, element, node))))
                }
                _ => leaving / core.elements[strongest as usize].conductance,
            };
            values[node as usize] = core.value(values, other) + step;
            if let Some(forest) = forest {
                forest.attach(node, other, step);
            }
        }
    }
}

/// The difference between a node in series and the far end of its stronger element, relative to the jump between both far ends: for flows so small that their quotient is inexact.
fn step_of_two(core: &Core, forest: &SpanningForest, [first, second]: [(u32, u32); 2]) -> DoubleDouble {
    let conductance = |element: u32| core.elements[element as usize].conductance;
    let (weaker, stronger) =
        if strength(core, second.0) <= strength(core, first.0) { (second, first) } else { (first, second) };
    let ratio = conductance(weaker.0) / conductance(stronger.0);
    forest.jump(core, [weaker.1, stronger.1]) * (ratio / (DoubleDouble::new(1.0) + ratio))
}

fn far_end(core: &Core, element: u32, node: u32) -> u32 {
    let ends = core.elements[element as usize].ends;
    if ends[0] == node { ends[1] } else { ends[0] }
}

fn strength(core: &Core, element: u32) -> f64 {
    core.elements[element as usize].conductance.to_f64()
}

/// The conductance of two in series: the quotient of the smaller and the larger does not overflow.
fn in_series(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    let (smaller, larger) = if a.to_f64() <= b.to_f64() { (a, b) } else { (b, a) };
    smaller / (DoubleDouble::new(1.0) + smaller / larger)
}

/// The elements at each free node, as they were before any was replaced.
struct Incident {
    start: Vec<u32>,
    elements: Vec<u32>,
    /// The element that replaced each; `NONE` for remaining ones.
    replaced_by: Vec<u32>,
}

impl Incident {
    fn of(core: &Core, is_there: &[bool], degrees: &[u32]) -> Self {
        let mut start = Vec::with_capacity(degrees.len() + 1);
        let mut sum = 0;
        start.push(0);
        start.extend(degrees.iter().map(|degree| {
            sum += degree;
            sum
        }));
        let mut next: Vec<u32> = start[..degrees.len()].to_vec();
        let mut elements = vec![NONE; sum as usize];
        for (number, element) in core.elements.iter().enumerate().filter(|(number, _)| is_there[*number]) {
            for end in element.ends {
                if let Some(next) = next.get_mut(end as usize) {
                    elements[*next as usize] = index(number);
                    *next += 1;
                }
            }
        }
        Self { start, elements, replaced_by: vec![NONE; core.elements.len()] }
    }

    /// The current elements at a node.
    fn at(&mut self, node: u32, is_there: &[bool]) -> Vec<u32> {
        let range = self.start[node as usize] as usize..self.start[node as usize + 1] as usize;
        let now = range.map(|place| self.now(self.elements[place]));
        now.collect::<Vec<u32>>().into_iter().filter(|&element| is_there[element as usize]).collect()
    }

    /// The element at the end of a chain of replacements.
    fn now(&mut self, mut element: u32) -> u32 {
        while self.replaced_by[element as usize] != NONE {
            let next = self.replaced_by[element as usize];
            let after = self.replaced_by[next as usize];
            if after != NONE {
                self.replaced_by[element as usize] = after;
            }
            element = next;
        }
        element
    }
}

/// A walk over the nodes that can be eliminated.
struct Walk<'a> {
    core: &'a mut Core,
    series: &'a mut Series,
    incident: Incident,
    degrees: Vec<u32>,
    stays: &'a dyn Fn(u32) -> bool,
}

impl Walk<'_> {
    fn run(mut self) {
        for start in 0..self.core.free {
            let mut waiting = vec![start];
            while let Some(node) = waiting.pop() {
                let is_there = self.series.is_free[node as usize] && !(self.stays)(node);
                if is_there && (1..=2).contains(&self.degrees[node as usize]) {
                    waiting.extend(self.take(node).into_iter().filter(|&end| self.core.is_free(end)));
                }
            }
        }
    }

    /// Eliminates a node; returns the numbers at the far ends of its elements.
    fn take(&mut self, node: u32) -> Vec<u32> {
        let elements = self.incident.at(node, &self.series.is_there);
        let far = |element: u32| far_end(self.core, element, node);
        let source = self.core.sources[node as usize];
        if let [first, second] = *elements.as_slice() {
            let [a, b] = [first, second].map(|element| self.core.elements[element as usize].conductance);
            // A conductance that underflows would split the network.
            let is_lost = in_series(a, b).is_zero() && !a.is_zero() && !b.is_zero();
            if is_lost || !source.is_zero() {
                return Vec::new();
            }
        }
        self.series.is_free[node as usize] = false;
        for &element in &elements {
            self.series.is_there[element as usize] = false;
        }
        match *elements.as_slice() {
            [only] => {
                let end = far(only);
                self.add_source(end, source);
                self.lower_degree(end, 1);
                self.series.steps.push(Step { node, source, elements: [only, NONE], made: NONE });
                vec![end]
            }
            [first, second] => {
                let ends = [far(first), far(second)];
                let made = if ends[0] == ends[1] {
                    self.lower_degree(ends[0], 2);
                    NONE
                } else {
                    self.make(ends, [first, second])
                };
                self.series.steps.push(Step { node, source, elements: [first, second], made });
                ends.to_vec()
            }
            _ => Vec::new(),
        }
    }

    fn make(&mut self, ends: [u32; 2], elements: [u32; 2]) -> u32 {
        let [first, second] = elements.map(|element| self.core.elements[element as usize].conductance);
        let made = index(self.core.elements.len());
        self.core.elements.push(Element { ends, conductance: in_series(first, second) });
        self.series.is_there.push(true);
        self.incident.replaced_by.push(NONE);
        for element in elements {
            self.incident.replaced_by[element as usize] = made;
        }
        made
    }

    fn add_source(&mut self, end: u32, source: DoubleDouble) {
        if let Some(sum) = self.core.sources.get_mut(end as usize) {
            *sum += source;
        }
    }

    fn lower_degree(&mut self, end: u32, by: u32) {
        if let Some(degree) = self.degrees.get_mut(end as usize) {
            *degree -= by;
        }
    }
}
