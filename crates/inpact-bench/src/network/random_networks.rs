//! Random networks of all contrasts.

use crate::random::Random;
use inpact_network::linear::{LinearNetwork, Link};

/// Properties of a random network.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// The number of nodes; the first and the last are held, at 100 and 50.
    pub nodes: u32,
    /// Conductances are spread over 10^-decades to 10^decades.
    pub decades: f64,
    /// Sources of fluid or current at some nodes.
    pub sources: Sources,
}

/// Sources of a network.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sources {
    /// Nothing.
    None,
    /// At a third of the nodes, up to the flow through one of its conductances at a difference of 100.
    Some,
}

/// A random network of a kind and a seed: a tree with as many further links, one in twelve of them infinite and one in twelve without conductance.
pub fn network(kind: Kind, seed: u64) -> LinearNetwork {
    let Kind { nodes, decades, sources } = kind;
    let mut random = Random::of_item(seed, u64::from(nodes));
    let mut network = LinearNetwork::of_nodes(nodes as usize);
    network.held[0] = Some(100.0);
    network.held[nodes as usize - 1] = Some(50.0);
    let conductance = |random: &mut Random| 10.0_f64.powf(random.between(-decades, decades)) * random.between(0.5, 1.5);
    let below = |random: &mut Random, count: u32| u32::try_from(random.whole(0, u64::from(count) - 1)).unwrap_or(0);
    for node in 1..nodes {
        let other = below(&mut random, node);
        network.links.push(Link { nodes: [other, node], conductance: conductance(&mut random) });
    }
    for _ in 0..nodes {
        let [a, b] = [(); 2].map(|()| below(&mut random, nodes));
        let is_held = |node: u32| network.held[node as usize].is_some();
        let conductance = match random.whole(0, 11) {
            // The two held nodes must not be merged.
            0 if !is_held(a) && !is_held(b) => f64::INFINITY,
            1 => 0.0,
            _ => conductance(&mut random),
        };
        if a != b {
            network.links.push(Link { nodes: [a, b], conductance });
        }
    }
    if sources == Sources::Some {
        for link in 0..nodes as usize - 1 {
            if random.unit() < 0.3 {
                let Link { nodes, conductance } = network.links[link];
                network.sources[nodes[1] as usize] = conductance * random.between(-100.0, 100.0);
            }
        }
    }
    network
}
