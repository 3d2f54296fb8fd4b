//! The reduced network after infinite conductances have merged their nodes: free nodes, known values, finite conductances.

use super::network::LinearNetwork;
use super::sets::{Sets, index};
use crate::error::{Error, ErrorKind};
use inpact_evaluation::numbers::DoubleDouble;

/// The index for no node, element or unknown.
pub(crate) const NONE: u32 = u32::MAX;

/// Relative rounding error of a few double-double operations.
pub(crate) const ROUNDING: f64 = 1.0 / (1_u128 << 100) as f64;

/// Conductances among free nodes and known values.
#[derive(Clone, Debug, Default)]
pub(crate) struct Core {
    /// The number of free nodes: numbers below it are free nodes, numbers from it on known values.
    pub(crate) free: u32,
    /// The known values.
    pub(crate) known: Vec<DoubleDouble>,
    /// The conductances; finite, and positive except those that may change.
    pub(crate) elements: Vec<Element>,
    /// Net flow into each free node from sources, W, A or L³/T, one entry a node.
    pub(crate) sources: Vec<DoubleDouble>,
}

/// A conductance between two numbers of a core.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element {
    pub(crate) ends: [u32; 2],
    pub(crate) conductance: DoubleDouble,
}

/// The index in the core of each node, link and store of a network.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origins {
    /// The number in the core of each node: nodes of one value have one number.
    pub(crate) number: Vec<u32>,
    /// The element of each link; `NONE` where it conducts nothing or joins nodes of one value.
    pub(crate) of_link: Vec<u32>,
    /// The element of each store; `NONE` where it stores nothing.
    pub(crate) of_store: Vec<u32>,
    /// The number of nodes that share the number of another.
    pub(crate) merged: usize,
}

impl Core {
    /// The network with the nodes of every infinite conductance merged; zero conductances are dropped unless they must stay.
    ///
    /// # Errors
    /// [`ErrorKind::Contradiction`] where such nodes are held at different values.
    pub(crate) fn merged(network: &LinearNetwork, stays: &dyn Fn(usize) -> bool) -> Result<(Self, Origins), Error> {
        let Clusters { number, held, merged } = clusters(network)?;
        let free = index(held.iter().filter(|held| held.is_none()).count());
        // Free nodes first, then known values, each in the order of the network.
        let (mut next_free, mut next_known) = (0, free);
        let places: Vec<u32> = held
            .iter()
            .map(|held| {
                let next = if held.is_none() { &mut next_free } else { &mut next_known };
                *next += 1;
                *next - 1
            })
            .collect();
        let number: Vec<u32> = number.into_iter().map(|cluster| places[cluster as usize]).collect();
        let mut core = Self {
            free,
            known: held.into_iter().flatten().map(DoubleDouble::new).collect(),
            elements: Vec::with_capacity(network.links.len() + network.stores.len()),
            sources: vec![DoubleDouble::ZERO; free as usize],
        };
        for (node, &source) in network.sources.iter().enumerate() {
            if let Some(sum) = core.sources.get_mut(number[node] as usize) {
                *sum += DoubleDouble::new(source);
            }
        }
        let mut of_link = vec![NONE; network.links.len()];
        for (number_of_link, (place, link)) in of_link.iter_mut().zip(&network.links).enumerate() {
            let ends = link.nodes.map(|node| number[node as usize]);
            let conducts = link.conductance > 0.0 || stays(number_of_link);
            if conducts && link.conductance.is_finite() && ends[0] != ends[1] {
                *place = core.push(ends, link.conductance);
            }
        }
        let mut of_store = vec![NONE; network.stores.len()];
        for (place, store) in of_store.iter_mut().zip(&network.stores) {
            if store.conductance > 0.0 {
                let before = core.free + index(core.known.len());
                core.known.push(store.before);
                *place = core.push([number[store.node as usize], before], store.conductance);
            }
        }
        Ok((core, Origins { number, of_link, of_store, merged }))
    }

    fn push(&mut self, ends: [u32; 2], conductance: f64) -> u32 {
        self.elements.push(Element { ends, conductance: DoubleDouble::new(conductance) });
        index(self.elements.len() - 1)
    }

    /// Whether a number is that of a free node.
    pub(crate) fn is_free(&self, number: u32) -> bool {
        number < self.free
    }

    /// The value of a number: for a free node from `values`, otherwise known.
    pub(crate) fn value(&self, values: &[DoubleDouble], number: u32) -> DoubleDouble {
        if self.is_free(number) { values[number as usize] } else { self.known[(number - self.free) as usize] }
    }
}

/// Nodes of one value.
struct Clusters {
    /// The cluster of each node.
    number: Vec<u32>,
    /// The held value of each cluster.
    held: Vec<Option<f64>>,
    /// The number of nodes that share the cluster of another.
    merged: usize,
}

fn clusters(network: &LinearNetwork) -> Result<Clusters, Error> {
    let infinite = || network.links.iter().filter(|link| link.conductance == f64::INFINITY);
    if infinite().next().is_none() {
        let number = (0..index(network.nodes())).collect();
        return Ok(Clusters { number, held: network.held.clone(), merged: 0 });
    }
    let mut sets = Sets::new(network.nodes());
    infinite().for_each(|link| sets.join(link.nodes[0], link.nodes[1]));
    let mut number = vec![NONE; network.nodes()];
    let mut held: Vec<Option<f64>> = Vec::new();
    let mut holder = Vec::new();
    for node in 0..index(network.nodes()) {
        let root = sets.of(node);
        if number[root as usize] == NONE {
            number[root as usize] = index(held.len());
            held.push(None);
            holder.push(node);
        }
        let cluster = number[root as usize];
        number[node as usize] = cluster;
        let Some(value) = network.held[node as usize] else { continue };
        match held[cluster as usize].replace(value) {
            Some(other) if other != value => {
                let (nodes, values) = ([holder[cluster as usize], node], [other, value]);
                return Err(ErrorKind::Contradiction { nodes, values }.into());
            }
            _ => holder[cluster as usize] = node,
        }
    }
    let merged = network.nodes() - held.len();
    Ok(Clusters { number, held, merged })
}
