//! Subtraction-free (GTH) elimination, accurate entry by entry: the reference, and the last resort.
//!
//! A node with conductances g_j to its neighbours, S = Σ g_j, is replaced by conductances g_i g_j / S between each two of them (star–mesh transformation),
//! and its source by shares g_j / S of it. Only positive numbers are added, multiplied and divided, so that no conductance loses digits, whatever their contrast.
//!
//! Differences are computed without subtracting values, too: the difference of node and neighbour i is Σ_j (g_j / S) (x_j − x_i) + b / S,
//! in which all x_j − x_i are differences between neighbours, computed before. Terms of opposite sign cancel only as far as the problem is ill-conditioned.
//! In 106 bits that leaves all digits of f64 except in contrived cases.
//!
//! It costs the operations of a simple sparse factorisation in an arithmetic some fifteen times as slow, and the memory of the filled network a second time for the differences.
//! Source: Grassmann, Taksar and Heyman, Operations Research 33 (1985) 1107–1116; Peña, ETNA 18 (2004) 198–208.

use super::core::{Core, Element};
use super::report::MethodFailure;
use super::sets::index;
use inpact_evaluation::numbers::DoubleDouble;
use std::collections::HashMap;

/// Above this number of distinct known values the filled network is too dense.
const MAX_KNOWN: usize = 256;

/// The maximum fill-in of an elimination.
pub(super) const MAX_FILLED: usize = 20_000_000;

/// Result of an elimination: the values of the free nodes, and the flow through each element that is there.
#[derive(Debug)]
pub(crate) struct Eliminated {
    pub(crate) values: Vec<DoubleDouble>,
    pub(crate) flows: Vec<DoubleDouble>,
}

/// An eliminated node.
struct Step {
    node: u32,
    /// Its neighbours at that time and the conductances to them.
    star: Vec<(u32, DoubleDouble)>,
    sum: DoubleDouble,
    source: DoubleDouble,
}

/// Eliminates every remaining free node, with at most `most_filled` additional conductances.
///
/// # Errors
/// It would take too much memory.
pub(super) fn eliminate(
    core: &Core,
    is_there: &[bool],
    is_free: &[bool],
    most_filled: usize,
) -> Result<Eliminated, MethodFailure> {
    let (terminal_of, terminals) = terminals(core);
    if terminals.len() > MAX_KNOWN {
        return Err(MethodFailure::TooManyHeld { found: terminals.len(), most: MAX_KNOWN });
    }
    let number = |end: u32| if core.is_free(end) { end } else { terminal_of[(end - core.free) as usize] };
    let mut stars: Vec<HashMap<u32, DoubleDouble>> = vec![HashMap::new(); core.free as usize];
    for element in core.elements.iter().zip(is_there).filter_map(|(element, there)| there.then_some(element)) {
        let [a, b] = element.ends.map(number);
        for (here, there) in [(a, b), (b, a)] {
            if core.is_free(here) && here != there {
                *stars[here as usize].entry(there).or_default() += element.conductance;
            }
        }
    }
    let steps = forward(core, stars, is_free, most_filled).ok_or(MethodFailure::TooLarge { most: most_filled })?;
    let differences = backward(core, &steps, &terminals);
    let mut values = vec![DoubleDouble::ZERO; core.free as usize];
    for Step { node, star, .. } in steps.iter().rev() {
        // From the nearest neighbour, so that a small jump is added to a known value.
        let nearest = star.iter().max_by(|a, b| a.1.to_f64().total_cmp(&b.1.to_f64()));
        let Some(&(neighbour, _)) = nearest else { continue };
        let base = if core.is_free(neighbour) {
            values[neighbour as usize]
        } else {
            terminals[(neighbour - core.free) as usize]
        };
        values[*node as usize] = base + difference(&differences, *node, neighbour);
    }
    let flow = |(element, there): (&Element, &bool)| {
        let [a, b] = element.ends.map(number);
        if *there && a != b {
            difference_of(core, &differences, &terminals, a, b) * element.conductance
        } else {
            DoubleDouble::ZERO
        }
    };
    let flows = core.elements.iter().zip(is_there).map(flow).collect();
    Ok(Eliminated { values, flows })
}

/// The number of each known value, after the free nodes, and the distinct values.
fn terminals(core: &Core) -> (Vec<u32>, Vec<DoubleDouble>) {
    let mut terminals: Vec<DoubleDouble> = Vec::new();
    let mut places: HashMap<[u64; 2], u32> = HashMap::new();
    let place_of = |value: &DoubleDouble| {
        let (high, low) = value.parts();
        *places.entry([high + 0.0, low + 0.0].map(f64::to_bits)).or_insert_with(|| {
            terminals.push(*value);
            core.free + index(terminals.len() - 1)
        })
    };
    (core.known.iter().map(place_of).collect(), terminals)
}

/// Eliminates the nodes in minimum degree order.
///
/// `None` where the fill-in exceeds `most_filled` conductances.
fn forward(
    core: &Core,
    mut stars: Vec<HashMap<u32, DoubleDouble>>,
    is_free: &[bool],
    most_filled: usize,
) -> Option<Vec<Step>> {
    let mut sources = core.sources.clone();
    let mut by_degree: std::collections::BTreeSet<(usize, u32)> =
        (0..core.free).filter(|&node| is_free[node as usize]).map(|node| (stars[node as usize].len(), node)).collect();
    let (mut steps, mut filled) = (Vec::with_capacity(by_degree.len()), 0);
    while let Some((_, node)) = by_degree.pop_first() {
        let mut star: Vec<(u32, DoubleDouble)> = std::mem::take(&mut stars[node as usize]).into_iter().collect();
        // Sums must not depend on the order of a hash table.
        star.sort_unstable_by_key(|(neighbour, _)| *neighbour);
        let sum: DoubleDouble = star.iter().map(|(_, conductance)| *conductance).sum();
        filled += star.len() * star.len();
        if filled > most_filled {
            return None;
        }
        let source = sources[node as usize];
        for &(neighbour, conductance) in star.iter().filter(|(neighbour, _)| core.is_free(*neighbour)) {
            let share = conductance / sum;
            by_degree.remove(&(stars[neighbour as usize].len(), neighbour));
            sources[neighbour as usize] += source * share;
            let of_neighbour = &mut stars[neighbour as usize];
            of_neighbour.remove(&node);
            for &(other, conductance) in star.iter().filter(|(other, _)| *other != neighbour) {
                *of_neighbour.entry(other).or_default() += conductance * share;
            }
            by_degree.insert((of_neighbour.len(), neighbour));
        }
        steps.push(Step { node, star, sum, source });
    }
    Some(steps)
}

/// The differences node − neighbour of the filled network, the last eliminated node first.
fn backward(core: &Core, steps: &[Step], terminals: &[DoubleDouble]) -> HashMap<[u32; 2], DoubleDouble> {
    let mut differences = HashMap::new();
    for Step { node, star, sum, source } in steps.iter().rev() {
        let rise = *source / *sum;
        for &(neighbour, _) in star {
            let others = star.iter().filter(|(other, _)| *other != neighbour).map(|&(other, conductance)| {
                difference_of(core, &differences, terminals, other, neighbour) * (conductance / *sum)
            });
            let difference = others.sum::<DoubleDouble>() + rise;
            differences.insert([*node, neighbour], difference);
        }
    }
    differences
}

/// The difference of two numbers of the filled network that are neighbours, or both known.
fn difference_of(
    core: &Core,
    differences: &HashMap<[u32; 2], DoubleDouble>,
    terminals: &[DoubleDouble],
    a: u32,
    b: u32,
) -> DoubleDouble {
    let value = |number: u32| terminals[(number - core.free) as usize];
    match (core.is_free(a), core.is_free(b)) {
        (false, false) => value(a) - value(b),
        _ => difference(differences, a, b),
    }
}

fn difference(differences: &HashMap<[u32; 2], DoubleDouble>, a: u32, b: u32) -> DoubleDouble {
    match differences.get(&[a, b]) {
        Some(difference) => *difference,
        None => -differences.get(&[b, a]).copied().unwrap_or_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::network::{LinearNetwork, Link};
    use super::{Core, MethodFailure, eliminate};

    /// A node among held ones, with `held` distinct values.
    fn star(held: u32) -> Core {
        let mut network = LinearNetwork::of_nodes(held as usize + 1);
        for node in 1..=held {
            network.links.push(Link { nodes: [0, node], conductance: 1.0 });
            network.held[node as usize] = Some(f64::from(node));
        }
        Core::merged(&network, &|_| false).expect("a core").0
    }

    #[test]
    fn an_elimination_goes_no_further_than_it_may() {
        let core = star(3);
        let all = |count: usize| vec![true; count];
        let found = |most| eliminate(&core, &all(core.elements.len()), &all(core.free as usize), most);
        assert!((found(9).expect("as much as it may").values[0].to_f64() - 2.0).abs() < 1e-15);
        let refusal = found(8).expect_err("too much");
        assert_eq!(refusal, MethodFailure::TooLarge { most: 8 });
        let message = "it would need room for more than 8 conductances between nodes that are not neighbours";
        assert_eq!(refusal.to_string(), message);
    }

    #[test]
    fn too_many_held_values_are_counted() {
        let core = star(257);
        let refusal = eliminate(&core, &vec![true; core.elements.len()], &[true], usize::MAX).expect_err("too many");
        assert_eq!(refusal.to_string(), "257 different values are held, and it takes no more than 256");
    }
}
