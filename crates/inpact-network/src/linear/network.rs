//! A linear network as given: nodes, conductances between them, held values and sources.

use inpact_evaluation::numbers::DoubleDouble;

/// Nodes joined by conductances that do not depend on the solution.
///
/// One field: potential, temperature or pore pressure, and its flow: current, heat or volume of fluid per time.
/// Units are those of the scene; conductances are flow per difference of the field.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinearNetwork {
    /// The value of each held node, `None` for unknowns; as many as there are nodes.
    pub held: Vec<Option<f64>>,
    /// The source of each node, W, A or L³/T; at a held node it adds to the node's supply.
    pub sources: Vec<f64>,
    /// The conductances.
    pub links: Vec<Link>,
    /// Capacities of nodes over a time increment.
    pub stores: Vec<Store>,
}

/// A conductance between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The nodes; the flow through a link is positive from the first to the second.
    pub nodes: [u32; 2],
    /// Flow per difference: 0 for none, infinite where both nodes have one value.
    pub conductance: f64,
}

/// Storage of a node in a time increment by backward Euler: conductance × (its value − its previous value).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Store {
    /// The node.
    pub node: u32,
    /// Capacity per length of the increment; finite.
    pub conductance: f64,
    /// The node's value at the start of the increment.
    pub before: DoubleDouble,
}

impl LinearNetwork {
    /// A network with this number of nodes, none of them held, and without links.
    pub fn of_nodes(nodes: usize) -> Self {
        Self { held: vec![None; nodes], sources: vec![0.0; nodes], ..Self::default() }
    }

    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        self.held.len()
    }
}
