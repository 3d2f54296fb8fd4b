//! Flows through infinite conductances: the Lagrange multipliers of the constraint that both ends have one value.
//!
//! All flows through finite conductances are known here; the residual of each node must flow through its infinite ones.
//! Where they form no cycle, that determines their flows. In a cycle it does not; there they share the flow as equal conductances would, however large,
//! and the report says how many there are.

use super::core::{Core, Element, NONE, ROUNDING};
use super::found::CoreFound;
use super::network::LinearNetwork;
use super::sets::{Sets, index};
use super::solution::LinearSolution;
use inpact_evaluation::numbers::DoubleDouble;

/// Computes the flows through the infinite conductances of an otherwise solved network; `solve` solves a network of finite ones.
pub(super) fn find_flows<E>(
    network: &LinearNetwork,
    solution: &mut LinearSolution,
    solve: impl FnOnce(&mut Core) -> Result<CoreFound, E>,
) -> Result<(), E> {
    let (missing, magnitudes) = missing(network, solution);
    let is_infinite = |number: &usize| network.links[*number].conductance == f64::INFINITY;
    let infinite: Vec<usize> = (0..network.links.len()).filter(is_infinite).collect();
    let is_reference = references(network, &infinite, &magnitudes);
    let mut number = vec![NONE; network.nodes()];
    let (mut free, mut sources) = (0, Vec::new());
    for node in infinite.iter().flat_map(|&link| network.links[link].nodes) {
        if number[node as usize] == NONE && !is_reference[node as usize] {
            number[node as usize] = free;
            sources.push(missing[node as usize]);
            free += 1;
        }
    }
    // One known value, at the reference nodes.
    let number_of = |node: u32| if is_reference[node as usize] { free } else { number[node as usize] };
    let element =
        |&link: &usize| Element { ends: network.links[link].nodes.map(number_of), conductance: DoubleDouble::new(1.0) };
    let mut core = Core {
        free,
        known: vec![DoubleDouble::ZERO],
        // The flow between two held nodes is undetermined, and taken as zero.
        elements: infinite.iter().map(element).collect(),
        sources,
    };
    let found = solve(&mut core)?;
    for (place, &link) in infinite.iter().enumerate() {
        solution.flows[link] = found.flows[place];
    }
    solution.report.shared = infinite.len() - free as usize;
    Ok(())
}

/// The net flow into each node except through infinite conductances, zero where it is within rounding; and the sum of the magnitudes.
fn missing(network: &LinearNetwork, solution: &LinearSolution) -> (Vec<DoubleDouble>, Vec<f64>) {
    let mut missing: Vec<DoubleDouble> = network.sources.iter().map(|&source| DoubleDouble::new(source)).collect();
    let mut magnitudes: Vec<f64> = network.sources.iter().map(|source| source.abs()).collect();
    let mut add = |node: u32, flow: DoubleDouble| {
        missing[node as usize] += flow;
        magnitudes[node as usize] += flow.to_f64().abs();
    };
    for (link, &flow) in network.links.iter().zip(&solution.flows) {
        add(link.nodes[0], -flow);
        add(link.nodes[1], flow);
    }
    for (store, &flow) in network.stores.iter().zip(&solution.stored) {
        add(store.node, -flow);
    }
    for (flow, magnitude) in missing.iter_mut().zip(&magnitudes) {
        if flow.to_f64().abs() <= ROUNDING * magnitude {
            *flow = DoubleDouble::ZERO;
        }
    }
    (missing, magnitudes)
}

/// The reference node of each cluster: held nodes, or the one with the largest flows.
///
/// The residual of a cluster within its tolerance ends up there, where it is smallest relative to the flows.
fn references(network: &LinearNetwork, infinite: &[usize], magnitudes: &[f64]) -> Vec<bool> {
    let mut sets = Sets::new(network.nodes());
    for &link in infinite {
        let [a, b] = network.links[link].nodes;
        sets.join(a, b);
    }
    let mut is_reference: Vec<bool> = network.held.iter().map(Option::is_some).collect();
    let mut reference = vec![NONE; network.nodes()];
    for node in 0..index(network.nodes()) {
        let best = &mut reference[sets.of(node) as usize];
        let is_better = |best: u32| {
            let rank = |node: u32| (is_reference[node as usize], magnitudes[node as usize]);
            rank(best) < rank(node)
        };
        if *best == NONE || is_better(*best) {
            *best = node;
        }
    }
    reference.into_iter().filter(|&node| node != NONE).for_each(|node| is_reference[node as usize] = true);
    is_reference
}
