//! What the tests of linear networks share: networks in short, and answers as f64.

#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

use inpact_evaluation::numbers::Wide;
use inpact_network::linear::{LAST_DIGIT, LinearFailure, LinearNetwork, LinearSolution, Link, Method, Solver};

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
pub fn solve(network: &LinearNetwork, method: Method) -> Result<LinearSolution, LinearFailure> {
    Solver::new(method, LAST_DIGIT).solve(network)
}

/// The solutions by all methods.
pub fn solutions(network: &LinearNetwork) -> Vec<(Method, LinearSolution)> {
    let solved = |method| (method, solve(network, method).unwrap_or_else(|failure| panic!("{method:?}: {failure:?}")));
    METHODS.map(solved).into()
}

/// The failure of every method, which is the same.
pub fn failure(network: &LinearNetwork) -> LinearFailure {
    let failures = METHODS.map(|method| solve(network, method).expect_err("a network without a solution"));
    assert!(failures.iter().all(|failure| *failure == failures[0]), "{failures:?}");
    failures[0].clone()
}

/// Numbers of 106 bits, rounded.
pub fn rounded(numbers: &[Wide]) -> Vec<f64> {
    numbers.iter().map(|number| number.to_f64()).collect()
}

/// The jumps across all links.
pub fn jumps(network: &LinearNetwork, solution: &LinearSolution) -> Vec<f64> {
    (0..network.links.len()).map(|link| solution.jump(network, link).to_f64()).collect()
}

/// The largest share of its flows that is missing in the balance of a node that is not held, in 106 bits.
pub fn worst_balance(network: &LinearNetwork, solution: &LinearSolution) -> f64 {
    let mut missing: Vec<Wide> = network.sources.iter().map(|&source| Wide::new(source)).collect();
    let mut magnitudes: Vec<f64> = network.sources.iter().map(|source| source.abs()).collect();
    let mut leave = |node: u32, flow: Wide| {
        missing[node as usize] -= flow;
        magnitudes[node as usize] += flow.to_f64().abs();
    };
    for (link, &flow) in network.links.iter().zip(&solution.flows) {
        leave(link.nodes[0], flow);
        leave(link.nodes[1], -flow);
    }
    for (store, &flow) in network.stores.iter().zip(&solution.stored) {
        leave(store.node, flow);
    }
    let free = (0..network.nodes()).filter(|&node| network.held[node].is_none());
    let share = |node: usize| match missing[node].is_zero() {
        true => 0.0,
        false => missing[node].to_f64().abs() / magnitudes[node],
    };
    free.map(share).fold(0.0, f64::max)
}
