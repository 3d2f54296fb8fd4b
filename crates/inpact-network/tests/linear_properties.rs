//! Properties of every linear network.

mod linear_support;

use inpact_evaluation::numbers::DoubleDouble;
use inpact_network::ErrorKind;
use inpact_network::linear::{LAST_DIGIT, LinearNetwork, LinearSolution, Link, Method, Store};
use linear_support::{Balanced, METHODS, rounded, solve, worst_balance};
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};
use proptest::prelude::*;

/// The methods but the reference, which refuses what is far from one.
const SOLVERS: [Method; 3] = [Method::Direct, Method::Mixed, Method::Iterative];

/// A connected network of 2 to 9 nodes: a tree of conductances within so many decades of one, more of them between any two nodes, some zero or infinite.
/// One node is held, or two; a third of the nodes has a source, and every node a store, so that something flows everywhere.
fn networks(decades: f64) -> impl Strategy<Value = LinearNetwork> {
    let conductance =
        move || (-decades..=decades, 1.0..10.0).prop_map(|(exponent, digits)| 10_f64.powf(exponent) * digits);
    let of_any_kind = prop_oneof![6 => conductance(), 1 => Just(0.0), 1 => Just(f64::INFINITY)];
    let pair = || (any::<prop::sample::Index>(), any::<prop::sample::Index>());
    let value = || -100.0..100.0;
    (2_usize..10)
        .prop_flat_map(move |nodes| {
            (
                prop::collection::vec((any::<prop::sample::Index>(), conductance()), nodes - 1),
                prop::collection::vec((pair(), of_any_kind.clone()), 0..10),
                (value(), prop::option::of((any::<prop::sample::Index>(), value()))),
                prop::collection::vec(prop::option::weighted(0.3, value()), nodes),
                prop::collection::vec((conductance(), value()), nodes),
            )
        })
        .prop_map(|(tree, more, held, sources, stores)| {
            let nodes = tree.len() + 1;
            let mut network = LinearNetwork::of_nodes(nodes);
            let number = |node: usize| u32::try_from(node).expect("few nodes");
            for (node, (other, conductance)) in (1..).zip(tree) {
                network.links.push(Link { nodes: [number(other.index(node)), number(node)], conductance });
            }
            for ((a, b), conductance) in more {
                let [a, b] = [a, b].map(|node| number(node.index(nodes)));
                if a != b {
                    network.links.push(Link { nodes: [a, b], conductance });
                }
            }
            network.held[0] = Some(held.0);
            if let Some((node, value)) = held.1 {
                network.held[node.index(nodes)] = Some(value);
            }
            network.sources = sources.into_iter().map(Option::unwrap_or_default).collect();
            for (node, (conductance, before)) in (0..).zip(stores) {
                network.stores.push(Store { node, conductance, before: DoubleDouble::new(before) });
            }
            network
        })
}

/// The solution of such a network; `None` where two held nodes have become one.
fn solved(network: &LinearNetwork, method: Method) -> Result<Option<LinearSolution>, TestCaseError> {
    match solve(network, method) {
        Ok(solution) => Ok(Some(solution)),
        Err(error) => {
            let ErrorKind::Contradiction { nodes, values } = error.kind() else {
                return Err(TestCaseError::fail(format!("{method:?}: {error}")));
            };
            prop_assert_eq!(nodes.map(|node| network.held[node as usize]), values.map(Some));
            prop_assert!(values[0] != values[1]);
            Ok(None)
        }
    }
}

/// The least and the greatest of what is held or was stored.
fn range(network: &LinearNetwork) -> [f64; 2] {
    let stored = network.stores.iter().map(|store| store.before.to_f64());
    let known = network.held.iter().flatten().copied().chain(stored);
    known.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], value| [least.min(value), greatest.max(value)])
}

fn is_balanced(network: &LinearNetwork) -> Result<(), TestCaseError> {
    for method in SOLVERS {
        let Some(solution) = solved(network, method)? else { return Ok(()) };
        let missing = worst_balance(network, &solution, Balanced::Clusters);
        // The tolerance is that of the equations of jumps, of which a node's balance is a difference: what is promised is the last digit of f64.
        prop_assert!(missing <= 0.5 * f64::EPSILON, "{:?}: {}", method, missing);
        for (link, flow) in network.links.iter().zip(&solution.flows) {
            let [a, b] = link.nodes.map(|node| solution.values[node as usize].to_f64());
            // The sign of a flow is that of the jump, where values determine it.
            prop_assert!(
                link.conductance.is_infinite() || a == b || (a > b) == (flow.to_f64() > 0.0) || flow.is_zero()
            );
            prop_assert!(!link.conductance.is_infinite() || a == b, "{:?}", link);
        }
    }
    Ok(())
}

fn exactly(number: f64) -> BigRational {
    BigRational::from_float(number).expect("finite")
}

/// A number of 106 bits in all its digits.
fn all_digits(number: DoubleDouble) -> BigRational {
    let high = number.to_f64();
    exactly(high) + exactly((number - DoubleDouble::new(high)).to_f64())
}

/// The flow through each link in exact rationals, by elimination; infinite conductances are not known here.
fn exact_flows(network: &LinearNetwork) -> Vec<BigRational> {
    let nodes = network.nodes();
    let mut rows = vec![vec![BigRational::zero(); nodes + 1]; nodes];
    for link in &network.links {
        let [a, b] = link.nodes.map(|node| node as usize);
        let conductance = exactly(link.conductance);
        for (from, to) in [(a, b), (b, a)] {
            rows[from][from] += &conductance;
            rows[from][to] -= &conductance;
        }
    }
    for store in &network.stores {
        let (node, conductance) = (store.node as usize, exactly(store.conductance));
        rows[node][nodes] += &conductance * all_digits(store.before);
        rows[node][node] += conductance;
    }
    for (node, row) in rows.iter_mut().enumerate() {
        row[nodes] += exactly(network.sources[node]);
        if let Some(value) = network.held[node] {
            row.fill(BigRational::zero());
            row[node] = exactly(1.0);
            row[nodes] = exactly(value);
        }
    }
    for pivot in 0..nodes {
        let row = rows[pivot].clone();
        for (_, of_other) in rows.iter_mut().enumerate().filter(|(other, _)| *other != pivot) {
            let factor = &of_other[pivot] / &row[pivot];
            of_other.iter_mut().zip(&row).for_each(|(to, from)| *to -= &factor * from);
        }
    }
    let value = |node: u32| &rows[node as usize][nodes] / &rows[node as usize][node as usize];
    network.links.iter().map(|link| exactly(link.conductance) * (value(link.nodes[0]) - value(link.nodes[1]))).collect()
}

proptest! {
    #[test]
    fn what_flows_into_a_node_flows_out_of_it(network in networks(3.0)) {
        is_balanced(&network)?;
    }

    #[test]
    fn the_same_at_any_contrast(network in networks(60.0)) {
        is_balanced(&network)?;
    }

    /// Not even by the last digit.
    #[test]
    fn without_sources_no_value_is_beyond_those_that_are_known(
        network in prop_oneof![networks(3.0), networks(100.0)]
    ) {
        let network = LinearNetwork { sources: vec![0.0; network.nodes()], ..network };
        let [least, greatest] = range(&network);
        for method in SOLVERS {
            let Some(solution) = solved(&network, method)? else { return Ok(()) };
            for value in rounded(&solution.values) {
                prop_assert!((least..=greatest).contains(&value), "{:?}: {}", method, value);
            }
        }
    }

    /// A last digit that is a tie may be rounded either way by iterations.
    #[test]
    fn the_direction_of_links_is_but_a_sign(
        network in prop_oneof![networks(3.0), networks(100.0)],
        directions in prop::collection::vec(any::<bool>(), 20),
    ) {
        let mut turned = network.clone();
        for (link, _) in turned.links.iter_mut().zip(&directions).filter(|(_, turn)| **turn) {
            link.nodes.reverse();
        }
        let values = network.held.iter().flatten().copied().chain(network.stores.iter().map(|store| store.before.to_f64()));
        let largest = values.map(f64::abs).fold(0.0, f64::max);
        for method in SOLVERS {
            let Some(solution) = solved(&network, method)? else { return Ok(()) };
            let other = solved(&turned, method)?.expect("a network with a solution");
            let is_same = |a: f64, b: f64, scale: f64| match method {
                Method::Direct => a == b,
                _ => (a - b).abs() <= f64::EPSILON * scale,
            };
            for (a, b) in rounded(&solution.values).into_iter().zip(rounded(&other.values)) {
                prop_assert!(is_same(a, b, a.abs().max(largest)), "{:?}: {} and {}", method, a, b);
            }
            for (link, turn) in directions.iter().take(network.links.len()).enumerate() {
                if network.links[link].conductance.is_infinite() {
                    continue;
                }
                let sign = if *turn { -1.0 } else { 1.0 };
                let [a, b] = [&solution, &other].map(|solution| solution.flows[link].to_f64());
                prop_assert!(is_same(a, sign * b, a.abs()), "{:?}, flows: {} and {}", method, a, b);
                let [a, b] = [(&network, &solution), (&turned, &other)].map(|(of, at)| at.jump(of, link).to_f64());
                prop_assert!(is_same(a, sign * b, a.abs()), "{:?}, jumps: {} and {}", method, a, b);
            }
        }
    }

    /// In units four times as large the same digits come out; an odd power of two would round square roots otherwise.
    #[test]
    fn the_unit_of_conductances_changes_no_value(network in networks(6.0), exponent in -150..150) {
        let factor = 4_f64.powi(exponent);
        let mut scaled = network.clone();
        scaled.links.iter_mut().for_each(|link| link.conductance *= factor);
        scaled.stores.iter_mut().for_each(|store| store.conductance *= factor);
        scaled.sources.iter_mut().for_each(|source| *source *= factor);
        for method in SOLVERS {
            let Some(solution) = solved(&network, method)? else { return Ok(()) };
            let other = solved(&scaled, method)?.expect("a network with a solution");
            prop_assert_eq!(rounded(&solution.values), rounded(&other.values), "{:?}", method);
            for (flow, other) in rounded(&solution.flows).into_iter().zip(rounded(&other.flows)) {
                // Of a flow that is none something below the range of f64 may be left.
                let is_none = flow.abs() <= 1e-300 && other.abs() <= 1e-300;
                prop_assert!(is_none || flow * factor == other, "{:?}: {} and {}", method, flow * factor, other);
            }
        }
    }

    /// Reciprocity: one node at a value of one sends into another at zero the flow that it would receive from there.
    #[test]
    fn a_network_is_the_same_from_both_sides(network in networks(30.0)) {
        if network.nodes() < 3 {
            return Ok(());
        }
        let mut network = network;
        // An infinite conductance to the third node, at zero, would keep back what comes.
        network.links.iter_mut().for_each(|link| link.conductance = link.conductance.min(1e3));
        let last = network.nodes() - 1;
        let sent = |from: usize, into: usize, method: Method| -> Result<Option<f64>, TestCaseError> {
            let mut network = network.clone();
            network.held.fill(None);
            network.held[1] = Some(0.0);
            network.held[into] = Some(0.0);
            network.held[from] = Some(1.0);
            network.sources.fill(0.0);
            network.stores.iter_mut().for_each(|store| store.before = DoubleDouble::ZERO);
            let Some(solution) = solved(&network, method)? else { return Ok(None) };
            let into_node = |(link, flow): (&Link, &DoubleDouble)| match link.nodes.map(|node| node as usize) {
                [_, second] if second == into => *flow,
                [first, _] if first == into => -*flow,
                _ => DoubleDouble::ZERO,
            };
            Ok(Some(network.links.iter().zip(&solution.flows).map(into_node).sum::<DoubleDouble>().to_f64()))
        };
        for method in SOLVERS {
            let (Some(there), Some(back)) = (sent(0, last, method)?, sent(last, 0, method)?) else { return Ok(()) };
            prop_assert!((there - back).abs() <= 2.0 * f64::EPSILON * there.abs(), "{:?}: {} and {}", method, there, back);
        }
    }
}

/// Any f64, those that are special more often.
fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => any::<u64>().prop_map(f64::from_bits),
        2 => 1e-3..1e3,
        1 => prop::sample::select(&[0.0, -0.0, 1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324][..]),
    ]
}

/// Conductances that are none now and then.
fn any_conductance() -> impl Strategy<Value = f64> {
    prop_oneof![5 => any_number().prop_map(f64::abs), 1 => any_number()]
}

/// Conductances of stores, whose flows are finite.
fn stored() -> impl Strategy<Value = f64> {
    any_conductance().prop_map(|conductance| if conductance <= 1e300 { conductance } else { 1.0 })
}

fn any_network() -> impl Strategy<Value = LinearNetwork> {
    (0_u32..8).prop_flat_map(|nodes| {
        let node = || 0..nodes.max(1);
        let some = if nodes == 0 { 0 } else { 14 };
        (
            prop::collection::vec(prop::option::weighted(0.3, any_number()), nodes as usize),
            prop::collection::vec(prop_oneof![2 => Just(0.0), 1 => any_number()], nodes as usize),
            prop::collection::vec(((node(), node()), any_conductance()), 0..=some),
            prop::collection::vec((node(), stored(), -1e3..1e3), 0..=some / 5),
        )
            .prop_map(|(held, sources, links, stores)| LinearNetwork {
                held,
                sources,
                links: links.into_iter().map(|((a, b), conductance)| Link { nodes: [a, b], conductance }).collect(),
                stores: stores
                    .into_iter()
                    .map(|(node, conductance, before)| Store { node, conductance, before: DoubleDouble::new(before) })
                    .collect(),
            })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Whatever a network is made of, there is a solution in numbers or a reason why there is none.
    #[test]
    fn no_network_makes_a_panic(network in any_network()) {
        for method in METHODS {
            if let Ok(solution) = solve(&network, method) {
                prop_assert_eq!(solution.values.len(), network.nodes());
                prop_assert_eq!(solution.flows.len(), network.links.len());
                prop_assert_eq!(solution.stored.len(), network.stores.len());
                // Infinite flows outside may be infinite within an infinite conductance.
                let finite = network.links.iter().zip(&solution.flows).filter(|(link, _)| link.conductance.is_finite());
                let mut all = solution.values.iter().chain(finite.map(|(_, flow)| flow));
                prop_assert!(all.all(|number| number.to_f64().is_finite()), "{:?}: {:?}", method, solution);
                for (value, held) in solution.values.iter().zip(&network.held) {
                    prop_assert!(held.is_none_or(|held| held == value.to_f64()), "{:?}: {:?}", method, solution);
                }
            }
        }
    }
}

proptest! {
    // Exact rationals of thirty decades take their time.
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// What `mixed` says of its error is a bound, before flows are rounded to f64; the others give an estimate, which is of the right order.
    /// What is far below the last digit of f64 counts as nothing.
    #[test]
    fn an_estimated_error_is_no_less_than_the_error(network in prop_oneof![networks(3.0), networks(30.0)]) {
        const NOTHING: f64 = 1e-3 * LAST_DIGIT;
        let network = LinearNetwork { links: network.links.into_iter().filter(|link| link.conductance.is_finite()).collect(), ..network };
        let exact = exact_flows(&network);
        for method in SOLVERS {
            let Some(solution) = solved(&network, method)? else { return Ok(()) };
            let factor = if method == Method::Mixed { 1.0 } else { 30.0 };
            let error = factor * solution.report.quality.error;
            for (flow, exact) in solution.flows.iter().zip(&exact) {
                let off = all_digits(*flow) - exact;
                let off = if off.is_zero() { 0.0 } else { (off / exact).to_f64().expect("in range").abs() };
                prop_assert!(off <= error.max(NOTHING), "{:?}: {} where {} is said", method, off, error);
            }
        }
    }
}
