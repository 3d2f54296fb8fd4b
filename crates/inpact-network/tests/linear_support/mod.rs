//! Common helpers of the tests of linear networks: networks in short, and answers as f64.

#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

use inpact_evaluation::numbers::DoubleDouble;
use inpact_network::Error;
use inpact_network::linear::{LAST_DIGIT, LinearNetwork, LinearSolution, Link, Method, Solver};

/// Every method, the reference included.
pub const METHODS: [Method; 4] = [Method::Direct, Method::Mixed, Method::Iterative, Method::Elimination];

/// A network with these nodes held, and links of two nodes and a conductance.
pub fn network(nodes: usize, held: &[(usize, f64)], links: &[(u32, u32, f64)]) -> LinearNetwork {
    let mut network = LinearNetwork::of_nodes(nodes);
    for &(node, value) in held {
        network.held[node] = Some(value);
    }
    network.links.extend(links.iter().map(|&(a, b, conductance)| Link { nodes: [a, b], conductance }));
    network
}

/// The solution by one method, to the last digit.
pub fn solve(network: &LinearNetwork, method: Method) -> Result<LinearSolution, Error> {
    Solver::new(method, LAST_DIGIT).solve(network)
}

/// The solutions by all methods.
pub fn solutions(network: &LinearNetwork) -> Vec<(Method, LinearSolution)> {
    let solved = |method| (method, solve(network, method).unwrap_or_else(|failure| panic!("{method:?}: {failure:?}")));
    METHODS.map(solved).into()
}

/// The failure of every method, which is the same.
pub fn failure(network: &LinearNetwork) -> Error {
    let failures = METHODS.map(|method| solve(network, method).expect_err("a network without a solution"));
    assert!(failures.iter().all(|failure| *failure == failures[0]), "{failures:?}");
    failures[0].clone()
}

/// Numbers of 106 bits, rounded.
pub fn rounded(numbers: &[DoubleDouble]) -> Vec<f64> {
    numbers.iter().map(|number| number.to_f64()).collect()
}

/// The jumps across all links.
pub fn jumps(network: &LinearNetwork, solution: &LinearSolution) -> Vec<f64> {
    (0..network.links.len()).map(|link| solution.jump(network, link).to_f64()).collect()
}

/// The balances to check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Balanced {
    /// Every node.
    Nodes,
    /// All nodes together that infinite conductances make one.
    Clusters,
}

/// The largest share of its flows that is missing in a balance without a held node, in 106 bits.
///
/// The rounding error of the largest flow of the network counts as nothing.
pub fn worst_balance(network: &LinearNetwork, solution: &LinearSolution, what: Balanced) -> f64 {
    let cluster = clusters(network, what);
    let mut missing = vec![DoubleDouble::ZERO; network.nodes()];
    let mut magnitudes = vec![0.0; network.nodes()];
    let mut leave = |node: u32, flow: DoubleDouble| {
        missing[cluster[node as usize]] -= flow;
        magnitudes[cluster[node as usize]] += flow.to_f64().abs();
    };
    for (node, &source) in (0..).zip(&network.sources) {
        leave(node, -DoubleDouble::new(source));
    }
    for (link, &flow) in network.links.iter().zip(&solution.flows) {
        let [a, b] = link.nodes;
        if what == Balanced::Nodes || link.conductance.is_finite() {
            leave(a, flow);
            leave(b, -flow);
        }
    }
    for (store, &flow) in network.stores.iter().zip(&solution.stored) {
        leave(store.node, flow);
    }
    let nothing = magnitudes.iter().copied().fold(0.0, f64::max) / (1_u128 << 100) as f64;
    let mut is_held = vec![false; network.nodes()];
    network.held.iter().zip(&cluster).for_each(|(held, &cluster)| is_held[cluster] |= held.is_some());
    let free = (0..network.nodes()).filter(|&node| !is_held[node]);
    let share = |node: usize| match missing[node].to_f64().abs() {
        missing if missing <= nothing => 0.0,
        missing => missing / magnitudes[node],
    };
    free.map(share).fold(0.0, f64::max)
}

/// The first node of those that have to balance together with each node.
fn clusters(network: &LinearNetwork, what: Balanced) -> Vec<usize> {
    let mut cluster: Vec<usize> = (0..network.nodes()).collect();
    let is_one = |link: &&Link| what == Balanced::Clusters && link.conductance == f64::INFINITY;
    for _ in 0..network.nodes() {
        for link in network.links.iter().filter(is_one) {
            let [a, b] = link.nodes.map(|node| node as usize);
            let first = cluster[a].min(cluster[b]);
            (cluster[a], cluster[b]) = (first, first);
        }
    }
    cluster
}
