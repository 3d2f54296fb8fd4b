//! The network solvers on random networks of all contrasts against their exact solutions.
//!
//! `docs/network.md` has the same over more networks, from an optimised build.

use inpact_bench::network::accuracy::worst;
use inpact_bench::network::exact::{self, Exact, Fraction, relative_error};
use inpact_bench::network::random_networks::{Kind, Sources, network};
use inpact_network::linear::{LAST_DIGIT, Method, Solver};

const METHODS: [Method; 3] = [Method::Direct, Method::Mixed, Method::Iterative];

/// The spread of conductances, in decades to either side of one.
const DECADES: [f64; 6] = [0.0, 3.0, 10.0, 30.0, 100.0, 300.0];

/// Four times what a number has lost that is rounded once, which is what is found.
const LAST_DIGITS: f64 = 2.0 * f64::EPSILON;

/// Every potential, jump and flow by every method, in networks of so many nodes; what drives them is within the range of f64.
fn is_exact(nodes: u32, seeds: u64) {
    for decades in DECADES {
        for sources in [Sources::None, Sources::Some] {
            if sources == Sources::Some && decades > 100.0 {
                continue;
            }
            let kind = Kind { nodes, decades, sources };
            for (worst, method) in worst(kind, 0..seeds, &METHODS).into_iter().zip(METHODS) {
                assert_eq!((u64::from(worst.networks), worst.refused), (seeds, 0), "{kind:?} {method:?}");
                assert!(worst.largest() <= LAST_DIGITS, "{kind:?} {method:?}: {worst:?}");
            }
        }
    }
}

#[test]
fn networks_of_3_nodes_are_exact() {
    is_exact(3, 100);
}

#[test]
fn networks_of_5_nodes_are_exact() {
    is_exact(5, 60);
}

#[test]
fn networks_of_12_nodes_are_exact() {
    is_exact(12, 15);
}

#[test]
fn networks_of_25_nodes_are_exact() {
    is_exact(25, 4);
}

#[test]
fn networks_of_50_nodes_are_exact() {
    is_exact(50, 1);
}

/// Whether one of the numbers of a solution is half the largest f64 or more.
fn is_beyond_range(exact: &Exact) -> bool {
    // The error of the largest f64 is one where the number is far larger, and far more than one where it is smaller.
    let is_beyond = |number: &Fraction| [f64::MAX, f64::MIN].iter().any(|&most| relative_error(most, number) <= 1.0);
    exact.values.iter().chain(exact.flows.iter().flatten()).any(is_beyond)
}

/// A source of 1e300 at the end of a conductance of 1e-300 makes a potential that no f64 holds: that is refused, and nothing else is.
#[test]
fn what_is_refused_is_beyond_the_range_of_f64() {
    for (nodes, seeds) in [(3, 200), (4, 200), (6, 200), (8, 100)] {
        let kind = Kind { nodes, decades: 300.0, sources: Sources::Some };
        let mut refused = 0;
        for seed in 0..seeds {
            let found = worst(kind, seed..seed + 1, &METHODS);
            if found.iter().all(|worst| worst.refused == 0) {
                for worst in found {
                    // No jump: that of a flow which is none may have a flow below the range of f64.
                    assert!(worst.value.max(worst.flow) <= LAST_DIGITS, "{kind:?} {seed}: {worst:?}");
                }
                continue;
            }
            assert!(is_beyond_range(&exact::solve(&network(kind, seed))), "{kind:?} {seed}: {found:?}");
            refused += 1;
        }
        assert!(refused > 0 || nodes == 3, "{kind:?}: a test of what is refused");
    }
}

/// The reference is exact as well.
#[test]
fn elimination_is_exact() {
    for (nodes, seeds) in [(5, 60), (12, 15), (25, 2)] {
        for decades in [0.0, 3.0, 10.0] {
            let kind = Kind { nodes, decades, sources: Sources::None };
            let found = worst(kind, 0..seeds, &[Method::Elimination])[0];
            assert_eq!(found.refused, 0, "{kind:?}");
            // Jumps that no flow tells are differences of its values.
            assert!(found.value.max(found.flow) <= LAST_DIGITS, "{kind:?}: {found:?}");
        }
    }
}

/// A looser tolerance may accept less than the last digit: the estimate of the error is not below the error itself.
#[test]
fn a_looser_tolerance_is_kept() {
    for tolerance in [1e-3, 1e-8] {
        for seed in 0..20 {
            let network = network(Kind { nodes: 25, decades: 3.0, sources: Sources::None }, seed);
            let exact = exact::solve(&network);
            for method in METHODS {
                let solution = Solver::new(method, tolerance).solve(&network).expect("a network with a solution");
                for (flow, exact) in solution.flows.iter().zip(&exact.flows) {
                    let error = exact.as_ref().map_or(0.0, |exact| relative_error(flow.to_f64(), exact));
                    assert!(error <= tolerance, "{method:?} of {seed} within {tolerance}: {error}");
                }
                let quality = solution.report.quality;
                assert!(quality.error <= tolerance && quality.residual <= tolerance, "{method:?}: {quality:?}");
            }
        }
    }
}

/// A solver that is content with less says so, and has solved for fewer corrections.
#[test]
fn a_looser_tolerance_takes_fewer_corrections() {
    let network = network(Kind { nodes: 50, decades: 3.0, sources: Sources::Some }, 1);
    for method in [Method::Mixed, Method::Iterative] {
        let solves = |tolerance| {
            Solver::new(method, tolerance).solve(&network).expect("a network with a solution").report.quality.solves
        };
        assert!(solves(1e-3) < solves(LAST_DIGIT), "{method:?}: {} and {}", solves(1e-3), solves(LAST_DIGIT));
    }
}
