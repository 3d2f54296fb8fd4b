//! Connected components of a network. One without a held value and without a capacity is singular, and is found before anything is factored.

use super::network::LinearNetwork;
use super::sets::{Sets, index};
use crate::error::{Error, ErrorKind};
use std::collections::BTreeMap;

/// Rejects a network with floating components.
///
/// # Errors
/// [`ErrorKind::Floating`] with the nodes of each such body, in ascending order.
pub(crate) fn refuse_floating(network: &LinearNetwork) -> Result<(), Error> {
    let mut sets = Sets::new(network.nodes());
    for link in network.links.iter().filter(|link| link.conductance > 0.0) {
        sets.join(link.nodes[0], link.nodes[1]);
    }
    let mut is_held = vec![false; network.nodes()];
    for (node, held) in network.held.iter().enumerate() {
        is_held[sets.of(index(node)) as usize] |= held.is_some();
    }
    for store in network.stores.iter().filter(|store| store.conductance > 0.0) {
        is_held[sets.of(store.node) as usize] = true;
    }
    let mut floating: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for node in 0..index(network.nodes()) {
        let body = sets.of(node);
        if !is_held[body as usize] {
            floating.entry(body).or_default().push(node);
        }
    }
    if floating.is_empty() {
        return Ok(());
    }
    Err(ErrorKind::Floating { components: floating.into_values().collect() }.into())
}
