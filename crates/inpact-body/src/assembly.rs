//! The matrix of a body: ∫ ∇N·k·∇N dV of all its elements, by the links between nodes.

use crate::body::Body;
use crate::error::BodyFault;
use crate::nodes::NodesOfBody;
use crate::rules::UNUSABLE_MESH;
use inpact_geometry::{Conductivity, SolidElement};
use inpact_parser::mesh::ElementBlock;

/// A symmetric matrix whose rows sum to zero: its entries below the diagonal, row by row, and the diagonal.
#[derive(Debug)]
pub(crate) struct Matrix {
    pub(crate) starts: Vec<usize>,
    pub(crate) columns: Vec<u32>,
    pub(crate) values: Vec<f64>,
    pub(crate) diagonal: Vec<f64>,
}

/// The capacities of the elements at each node.
#[derive(Debug)]
pub(crate) struct Held {
    /// ∫ N dV (L³).
    pub(crate) volumes: Vec<f64>,
    /// ∫ ρ c N dV, heat per temperature (M L² T⁻² θ⁻¹).
    pub(crate) capacities: Vec<f64>,
}

impl Matrix {
    /// Which nodes the elements of a body link.
    pub(crate) fn pattern(blocks: &[&ElementBlock], nodes: usize) -> Self {
        // The elements around each node, by block and position.
        let mut around_starts = vec![0_usize; nodes + 1];
        for block in blocks {
            block.nodes.iter().for_each(|node| around_starts[node.index() + 1] += 1);
        }
        for node in 0..nodes {
            around_starts[node + 1] += around_starts[node];
        }
        let mut next = around_starts.clone();
        let mut around = vec![(0_u32, 0_u32); around_starts[nodes]];
        for (number, block) in (0..).zip(blocks) {
            for (element, of_element) in (0..).zip(block.each()) {
                for node in of_element {
                    around[next[node.index()]] = (number, element);
                    next[node.index()] += 1;
                }
            }
        }
        drop(next);
        let mut starts = Vec::with_capacity(nodes + 1);
        let mut columns: Vec<u32> = Vec::new();
        // The last row in which each node occurred.
        let mut met = vec![u32::MAX; nodes];
        for (row, ends) in (0_u32..).zip(around_starts.windows(2)) {
            let start = columns.len();
            starts.push(start);
            for &(block, element) in &around[ends[0]..ends[1]] {
                let block = blocks[block as usize];
                let count = block.shape.nodes();
                for node in &block.nodes[element as usize * count..][..count] {
                    if node.0 < row && std::mem::replace(&mut met[node.index()], row) != row {
                        columns.push(node.0);
                    }
                }
            }
            columns[start..].sort_unstable();
        }
        starts.push(columns.len());
        let values = vec![0.0; columns.len()];
        Self { starts, columns, values, diagonal: vec![0.0; nodes] }
    }

    fn add(&mut self, a: u32, b: u32, value: f64) {
        if a == b {
            self.diagonal[a as usize] += value;
            return;
        }
        let (row, column) = (a.max(b) as usize, a.min(b));
        let range = self.starts[row]..self.starts[row + 1];
        if let Ok(at) = self.columns[range.clone()].binary_search(&column) {
            self.values[range.start + at] += value;
        }
    }

    /// Adds the elements of a block.
    ///
    /// # Errors
    ///
    /// The first element that is inside out or flat.
    pub(crate) fn add_block(
        &mut self,
        body: &Body,
        block: &ElementBlock,
        conductivity: &Conductivity,
    ) -> Result<(), BodyFault> {
        let element = solid(block);
        let mut integrals = element.integrals();
        let mut places = Vec::with_capacity(element.nodes());
        for (label, nodes) in block.labels.iter().zip(block.each()).filter(|(_, nodes)| body.has_terminal(nodes)) {
            places.clear();
            places.extend(nodes.iter().map(|node| body.mesh.points[node.index()]));
            element
                .conduct(&places, conductivity, &mut integrals)
                .map_err(|error| inverted(block, *label, &error).of(vec![body.body_of(nodes)]))?;
            for (a, node) in nodes.iter().enumerate() {
                self.add(node.0, node.0, integrals.conductance(a, a));
                for (b, other) in nodes[..a].iter().enumerate() {
                    let value = integrals.conductance(a, b);
                    // An element that has a node twice has the link of the node with itself on both sides of the diagonal.
                    let times = if node == other { 2.0 } else { 1.0 };
                    self.add(node.0, other.0, times * value);
                }
            }
        }
        Ok(())
    }

    /// The flow out of each node at these values, link by link, without cancellation where values are alike.
    pub(crate) fn flows(&self, values: &[f64]) -> Vec<f64> {
        let mut flows = vec![0.0; values.len()];
        for row in 0..values.len() {
            let mut sum = 0.0;
            for at in self.starts[row]..self.starts[row + 1] {
                let column = self.columns[at] as usize;
                let flow = -self.values[at] * (values[row] - values[column]);
                sum += flow;
                flows[column] -= flow;
            }
            flows[row] += sum;
        }
        flows
    }

    /// a(x, y) = ∫ ∇x·k·∇y dV for all pairs of some fields of a body, x before or the same as y, each pair at row · count + column.
    ///
    /// For fields with an error in their solution the error here is a product of two errors.
    pub(crate) fn energies(&self, nodes: &NodesOfBody<'_>, fields: &[&[f64]]) -> Vec<f64> {
        let count = fields.len();
        let mut sums = vec![Sum::default(); count * count];
        let mut of_row = vec![0.0; count * count];
        let mut apart = vec![0.0; count];
        for (place, row) in nodes.nodes.iter().map(|row| *row as usize).enumerate() {
            of_row.fill(0.0);
            for at in self.starts[row]..self.starts[row + 1] {
                // An element is of one body.
                let other = nodes.place(self.columns[at] as usize);
                for (apart, field) in apart.iter_mut().zip(fields) {
                    *apart = field[place] - field[other];
                }
                for (i, x) in apart.iter().enumerate() {
                    let flow = -self.values[at] * x;
                    for (sum, y) in of_row[i * count + i..(i + 1) * count].iter_mut().zip(&apart[i..]) {
                        *sum += flow * y;
                    }
                }
            }
            sums.iter_mut().zip(&of_row).for_each(|(sum, value)| sum.add(*value));
        }
        sums.into_iter().map(Sum::value).collect()
    }
}

/// A compensated sum (A. Neumaier, Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen, 1974).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    pub(crate) fn add(&mut self, value: f64) {
        let sum = self.sum + value;
        let (large, small) = if value.abs() <= self.sum.abs() { (self.sum, value) } else { (value, self.sum) };
        self.lost += (large - sum) + small;
        self.sum = sum;
    }

    pub(crate) fn value(self) -> f64 {
        self.sum + self.lost
    }
}

impl Held {
    /// Capacities at nodes of the elements of some blocks, each with its heat per volume and temperature.
    ///
    /// # Errors
    ///
    /// The first element that is inside out or flat.
    pub(crate) fn of(body: &Body, blocks: &[(&ElementBlock, f64)]) -> Result<Self, BodyFault> {
        let nodes = body.mesh.points.len();
        let mut held = Self { volumes: vec![0.0; nodes], capacities: vec![0.0; nodes] };
        for (block, heat) in blocks {
            let element = solid(block);
            let mut integrals = element.integrals();
            let mut places = Vec::with_capacity(element.nodes());
            for (label, nodes) in block.labels.iter().zip(block.each()).filter(|(_, nodes)| body.has_terminal(nodes)) {
                places.clear();
                places.extend(nodes.iter().map(|node| body.mesh.points[node.index()]));
                element
                    .hold(&places, &mut integrals)
                    .map_err(|error| inverted(block, *label, &error).of(vec![body.body_of(nodes)]))?;
                for (node, volume) in nodes.iter().zip(integrals.volumes()) {
                    held.volumes[node.index()] += volume;
                    held.capacities[node.index()] += heat * volume;
                }
            }
        }
        Ok(held)
    }
}

fn solid(block: &ElementBlock) -> SolidElement {
    SolidElement::new(block.shape, block.integration).expect("blocks are of solid elements")
}

fn inverted(block: &ElementBlock, label: u32, error: &inpact_geometry::Error) -> BodyFault {
    BodyFault::at(&UNUSABLE_MESH, block.span, format!("element {label} of type {}: {error}", block.type_name))
}
