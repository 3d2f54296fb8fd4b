//! Linear networks with answers that are known: by hand or by symmetry.

mod linear_support;

use inpact_evaluation::numbers::DoubleDouble;
use inpact_network::ErrorKind;
use inpact_network::linear::{LAST_DIGIT, LinearNetwork, Link, Method, MethodFailure, Store};
use linear_support::{METHODS, failure, jumps, network, rounded, solutions, solve};
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// Relative rounding error of a few double-double operations.
const ROUNDING: f64 = 1.0 / (1_u128 << 100) as f64;

/// Resistances of a half, a third and a sixth are one.
#[test]
fn conductances_in_series() {
    let chain = network(4, &[(0, 12.0), (3, 0.0)], &[(0, 1, 2.0), (2, 1, 3.0), (2, 3, 6.0)]);
    for (method, solution) in solutions(&chain) {
        assert_eq!(rounded(&solution.values), [12.0, 6.0, 2.0, 0.0], "{method:?}");
        assert_eq!(rounded(&solution.flows), [12.0, -12.0, 12.0], "{method:?}");
        assert_eq!(jumps(&chain, &solution), [6.0, -4.0, 2.0], "{method:?}");
        assert_eq!((solution.report.taken_out, solution.report.unknowns), (2, 0), "{method:?}");
    }
}

#[test]
fn conductances_side_by_side() {
    let beam = network(2, &[(0, 10.0), (1, 4.0)], &[(0, 1, 1.0), (1, 0, 2.0), (0, 1, 3.5), (0, 1, 0.0)]);
    for (method, solution) in solutions(&beam) {
        assert_eq!(rounded(&solution.flows), [6.0, -12.0, 21.0, 0.0], "{method:?}");
        assert_eq!(jumps(&beam, &solution), [6.0, -6.0, 6.0, 6.0], "{method:?}");
    }
    let joined = network(3, &[(0, 10.0), (2, 4.0)], &[(0, 1, 1.0), (1, 0, 2.0), (1, 2, 3.0)]);
    for (method, solution) in solutions(&joined) {
        assert_eq!(rounded(&solution.values), [10.0, 7.0, 4.0], "{method:?}");
        assert_eq!(rounded(&solution.flows), [3.0, -6.0, 9.0], "{method:?}");
    }
}

/// A bridge between the middles of two arms; the other arm divides as the first one does.
fn bridge(across: f64, last: f64) -> LinearNetwork {
    let arms = [(0, 1, 1.0), (1, 3, 2.0), (0, 2, 3.0), (2, 3, last)];
    network(4, &[(0, 9.0), (3, 0.0)], &[&arms[..], &[(1, 2, across)]].concat())
}

#[test]
fn nothing_flows_through_a_balanced_bridge() {
    for across in [0.0, 1e-300, 1e-9, 1.0, 5.0, 1e9, 1e300, f64::INFINITY] {
        for (method, solution) in solutions(&bridge(across, 6.0)) {
            assert_eq!(rounded(&solution.values), [9.0, 3.0, 3.0, 0.0], "{across} {method:?}");
            let (flows, jump) = (rounded(&solution.flows), jumps(&bridge(across, 6.0), &solution)[4]);
            assert_eq!(flows[..4], [6.0, 6.0, 18.0, 18.0], "{across} {method:?}");
            // Of a strong bridge what the tolerance leaves of the arms' balance.
            let nothing = LAST_DIGIT * 6.0;
            assert!(jump.abs() <= nothing && flows[4].abs() <= nothing, "{across} {method:?}: {jump} {flows:?}");
            if matches!(method, Method::Direct | Method::Iterative) && across < 1e9 {
                assert_eq!((flows[4], jump), (0.0, 0.0), "{across} {method:?}");
            }
        }
    }
}

/// A balance that is off by the last digit of f64 is a jump as small, between values near 3: it is as exact as those are in 106 bits.
#[test]
fn a_bridge_that_is_off_by_the_last_digit() {
    let exact = |value: f64| BigRational::from_float(value).expect("finite");
    for across in [1e-9, 1.0, 1e9] {
        let last = 6.0_f64.next_up();
        // Nodes 1 and 2: (3 + c) x - c y = 9 and (3 + l + c) y - c x = 27.
        let [c, l] = [across, last].map(exact);
        let (a, d) = (exact(3.0) + &c, exact(3.0) + l + &c);
        let determinant = &a * &d - &c * &c;
        let [x, y] = [exact(9.0) * &d + exact(27.0) * &c, exact(27.0) * &a + exact(9.0) * &c];
        let jump = ((x - y) / determinant).to_f64().expect("in range");
        assert!(0.0 < jump && jump < 1e-15, "{jump}");
        for (method, solution) in solutions(&bridge(across, last)) {
            let found = jumps(&bridge(across, last), &solution)[4];
            assert!((found - jump).abs() <= ROUNDING * 3.0, "{across} {method:?}: {found} and {jump}");
            assert_eq!(found * across, solution.flows[4].to_f64(), "{across} {method:?}");
            if method != Method::Elimination {
                // The rounding error is reported.
                let error = solution.report.quality.error;
                assert!((found - jump).abs() <= jump * error && error < 1e-10, "{across} {method:?}: {error}");
            }
        }
    }
}

/// The flow of each link follows from the values next to it: 100 and 0 are held, so that the main nodes are at 50.
#[test]
fn all_magnitudes_in_one_network() {
    let links = [
        (0, 2, 1.0),
        (2, 1, 1.0),
        // Another node of the same value, from which next to nothing flows.
        (2, 3, f64::INFINITY),
        (3, 1, 1e-300),
        // A node at the hot end.
        (0, 4, 1e300),
        (4, 1, 1e-300),
        // A short cut, and one that is cut.
        (0, 1, 1e300),
        (0, 1, 0.0),
        // A dead end after next to nothing.
        (2, 5, 1e-300),
    ];
    let all = network(6, &[(0, 100.0), (1, 0.0)], &links);
    for method in [Method::Direct, Method::Mixed, Method::Iterative] {
        let solution = solve(&all, method).expect("a solution");
        assert_eq!(rounded(&solution.values), [100.0, 0.0, 50.0, 50.0, 100.0, 50.0], "{method:?}");
        let flows = [50.0, 50.0, 50.0 * 1e-300, 50.0 * 1e-300, 1e-298, 1e-298, 1e302, 0.0, 0.0];
        for (link, (found, flow)) in rounded(&solution.flows).into_iter().zip(flows).enumerate() {
            assert!((found - flow).abs() <= f64::EPSILON * flow, "{method:?}, link {link}: {found:e} and {flow:e}");
        }
        let jumps = jumps(&all, &solution);
        assert_eq!((jumps[2], jumps[6], jumps[7], jumps[8]), (0.0, 100.0, 100.0, 0.0), "{method:?}");
        assert_eq!(solution.report.merged, 1, "{method:?}");
    }
}

/// Kirchhoff's laws do not determine the flows of infinite conductances in a ring; they share it as equal ones would.
#[test]
fn a_ring_of_infinite_conductances_shares_its_flow() {
    let infinite = f64::INFINITY;
    let ring = network(4, &[(3, 0.0)], &[(0, 1, infinite), (0, 2, infinite), (2, 1, infinite), (1, 3, 1.0)]);
    let ring = LinearNetwork { sources: vec![3.0, 0.0, 0.0, 0.0], ..ring };
    for (method, solution) in solutions(&ring) {
        assert_eq!(rounded(&solution.values), [3.0, 3.0, 3.0, 0.0], "{method:?}");
        assert_eq!(rounded(&solution.flows), [2.0, 1.0, 1.0, 3.0], "{method:?}");
        assert_eq!(jumps(&ring, &solution), [0.0, 0.0, 0.0, 3.0], "{method:?}");
        assert_eq!((solution.report.merged, solution.report.shared), (2, 1), "{method:?}");
    }
    let pair = network(3, &[(0, 8.0), (2, 0.0)], &[(0, 1, infinite), (1, 0, infinite), (1, 2, 0.5)]);
    for (method, solution) in solutions(&pair) {
        assert_eq!(rounded(&solution.flows), [2.0, -2.0, 4.0], "{method:?}");
        assert_eq!((solution.report.merged, solution.report.shared), (1, 1), "{method:?}");
    }
}

/// Without a ring all flows are determined.
#[test]
fn a_tree_of_infinite_conductances() {
    let infinite = f64::INFINITY;
    let links = [(0, 1, infinite), (1, 2, infinite), (3, 1, infinite), (2, 4, 1.0), (4, 3, 3.0)];
    let tree = network(5, &[(0, 5.0), (4, 1.0)], &links);
    for (method, solution) in solutions(&tree) {
        assert_eq!(rounded(&solution.flows), [16.0, 4.0, -12.0, 4.0, -12.0], "{method:?}");
        assert_eq!((solution.report.merged, solution.report.shared), (3, 0), "{method:?}");
    }
}

#[test]
fn nodes_that_are_one_may_be_held_at_one_value() {
    let infinite = f64::INFINITY;
    for [first, last] in [[7.0, 7.0], [0.0, -0.0]] {
        let held = network(4, &[(0, first), (2, last)], &[(0, 1, infinite), (1, 2, infinite), (1, 3, 1.0)]);
        for (method, solution) in solutions(&held) {
            assert_eq!(rounded(&solution.values), [first; 4], "{method:?}");
            assert_eq!(rounded(&solution.flows), [0.0; 3], "{method:?}");
        }
    }
}

#[test]
fn nodes_that_are_one_cannot_be_held_at_two_values() {
    let infinite = f64::INFINITY;
    let links = [(0, 1, infinite), (3, 1, infinite), (3, 4, infinite), (2, 4, 1.0)];
    let held = [(0, 7.0), (2, 1.0), (4, 7.0_f64.next_up())];
    let contradiction = ErrorKind::Contradiction { nodes: [0, 4], values: [7.0, 7.0_f64.next_up()] };
    assert_eq!(*failure(&network(5, &held, &links)).kind(), contradiction);
    // As soon as one conductance is finite, however large, it is a network as any other.
    let links = [(0, 1, infinite), (3, 1, 1e300), (3, 4, infinite), (2, 4, 1.0)];
    assert!(solve(&network(5, &held, &links), Method::Direct).is_ok());
}

#[test]
fn what_floats_is_named_body_by_body() {
    let links = [(0, 1, 1.0), (2, 3, 1e-300), (3, 6, f64::INFINITY), (1, 2, 0.0), (4, 7, 0.0)];
    let floating_parts =
        |parts: &[&[u32]]| ErrorKind::Floating { components: parts.iter().map(|part| part.to_vec()).collect() };
    let mut floating = network(8, &[(0, 1.0)], &links);
    assert_eq!(*failure(&floating).kind(), floating_parts(&[&[2, 3, 6], &[4], &[5], &[7]]));
    // A source is no level; a store is one, but not if it takes up nothing.
    floating.sources[4] = 1.0;
    floating.stores.push(Store { node: 6, conductance: 1e-300, before: DoubleDouble::new(3.0) });
    floating.stores.push(Store { node: 5, conductance: 0.0, before: DoubleDouble::new(3.0) });
    assert_eq!(*failure(&floating).kind(), floating_parts(&[&[4], &[5], &[7]]));
    floating.held[5] = Some(0.0);
    floating.links.extend([Link { nodes: [7, 4], conductance: 1e300 }, Link { nodes: [4, 0], conductance: 2.0 }]);
    for (method, solution) in solutions(&floating) {
        assert_eq!(rounded(&solution.values), [1.0, 1.0, 3.0, 3.0, 1.5, 0.0, 3.0, 1.5], "{method:?}");
    }
}

#[test]
fn no_nodes_are_solved_and_no_links_too() {
    for (_, solution) in solutions(&LinearNetwork::of_nodes(0)) {
        assert!(solution.values.is_empty() && solution.flows.is_empty());
    }
    for (_, solution) in solutions(&network(2, &[(0, 1.0), (1, -2.0)], &[])) {
        assert_eq!(rounded(&solution.values), [1.0, -2.0]);
    }
}

/// Two of the smallest conductances in series are below the range of f64, and still join their ends.
#[test]
fn the_smallest_conductances_in_series() {
    let least = f64::from_bits(1);
    let chain = network(4, &[(0, 100.0), (3, 40.0)], &[(0, 1, least), (1, 2, least), (2, 3, least)]);
    for method in [Method::Direct, Method::Mixed, Method::Iterative] {
        let solution = solve(&chain, method).unwrap_or_else(|failure| panic!("{method:?}: {failure}"));
        let values = rounded(&solution.values);
        assert!(values.windows(2).all(|pair| pair[1] <= pair[0]), "{method:?}: {values:?}");
    }
}

/// A dead end has the value of its anchor, whatever it is made of, and nothing flows into it.
#[test]
fn blind_ends() {
    for conductance in [1e-300, 1.0, 1e300, f64::INFINITY] {
        let links = [(0, 1, 1.0), (1, 2, 2.0), (1, 3, conductance), (3, 4, 0.7), (3, 5, conductance)];
        let ends = network(6, &[(0, 9.0), (2, 0.0)], &links);
        for (method, solution) in solutions(&ends) {
            assert_eq!(rounded(&solution.values), [9.0, 3.0, 0.0, 3.0, 3.0, 3.0], "{conductance} {method:?}");
            assert_eq!(rounded(&solution.flows), [6.0, 6.0, 0.0, 0.0, 0.0], "{conductance} {method:?}");
        }
    }
    let mut driven = network(3, &[(0, 1.0)], &[(0, 1, 0.5), (2, 1, 0.25)]);
    driven.sources[2] = 2.0;
    for (method, solution) in solutions(&driven) {
        assert_eq!(rounded(&solution.values), [1.0, 5.0, 13.0], "{method:?}");
        assert_eq!(rounded(&solution.flows), [-2.0, 2.0], "{method:?}");
    }
}

/// A square of links beyond the node through which all flows is a dead end as well.
#[test]
fn blind_squares() {
    for [a, b, c, d] in [[1.0, 1.0, 1.0, 1.0], [0.3, 7.0, 0.02, 1.5], [1e-3, 1e3, 2.0, 0.7]] {
        let square = [(1, 3, a), (3, 4, b), (4, 5, c), (5, 1, d), (3, 5, 0.4)];
        let links = [&[(0, 1, 2.0), (1, 2, 6.0)][..], &square].concat();
        for (method, solution) in solutions(&network(6, &[(0, 9.0), (2, 1.0)], &links)) {
            assert_eq!(rounded(&solution.values), [9.0, 3.0, 1.0, 3.0, 3.0, 3.0], "{method:?}");
            let flows = rounded(&solution.flows);
            assert_eq!(flows, [12.0, 12.0, 0.0, 0.0, 0.0, 0.0, 0.0], "{method:?}");
            assert_eq!(solution.report.dead_ends, 3, "{method:?}");
        }
    }
}

/// A mesh of conductances over many decades that is joined to one node, or to two that are held alike, is at one value.
#[test]
fn blind_meshes() {
    let width = 6;
    for seed in 0_u32..40 {
        let number = |x: u32, y: u32| 3 + x + width * y;
        let conductance = |a: u32, b: u32| {
            let irregular = f64::from((a * 7919 + b * 104_729 + seed * 15_485_863) % 1009) / 1009.0;
            10_f64.powf(6.0 * irregular - 3.0)
        };
        let neighbours = |x: u32, y: u32| [(x + 1, y), (x, y + 1)].into_iter().filter(|&(x, y)| x < width && y < width);
        let mesh = (0..width).flat_map(|x| {
            (0..width).flat_map(move |y| neighbours(x, y).map(move |(u, v)| (number(x, y), number(u, v))))
        });
        let mesh: Vec<_> = mesh.map(|(a, b)| (a, b, conductance(a, b))).collect();
        // By two corners on the node of a source, by one between two held nodes, by two on nodes that are held alike.
        let by_two = [(1, number(0, 0), 0.3), (1, number(5, 5), 7.0)];
        let appendages = [
            ([&[(0, 1, 0.011), (1, 2, 0.5)][..], &by_two].concat(), 5.0, 20.0),
            (vec![(0, 1, 0.7), (1, 2, 3.0), (1, number(0, 0), 1e3)], 0.0, 100.0),
            (vec![(0, number(0, 0), 0.7), (2, number(5, 5), 3.0)], 0.0, 20.0),
        ];
        for (links, source, held) in appendages {
            let mut blind = network(3 + 36, &[(0, 20.0), (2, held)], &[&links[..], &mesh].concat());
            blind.sources[1] = source;
            if links.len() == 2 {
                blind.held[1] = Some(0.0);
            }
            for (method, solution) in solutions(&blind) {
                let own = solution.values[links[links.len() - 1].0 as usize];
                assert!(solution.values[3..].iter().all(|value| *value == own), "{seed} {method:?}");
                assert!(rounded(&solution.flows[links.len()..]).iter().all(|&flow| flow == 0.0), "{seed} {method:?}");
                assert!(solution.report.quality.error <= 1e-16, "{seed} {method:?}: {:?}", solution.report.quality);
            }
        }
    }
}

/// The flow through the only infinite conductance of a node is what its others bring, however little that is beside what flows at the other end.
#[test]
fn a_small_flow_through_an_infinite_conductance() {
    let links = [(0, 1, 1e-9), (0, 2, 35_583_037.823_590_47), (3, 2, 12_345.678), (1, 2, f64::INFINITY)];
    let mut joined = network(4, &[(0, -71.857_166_259_812_84), (3, 5.0)], &links);
    joined.sources[2] = 87.913_866_667_360_14;
    for (method, solution) in solutions(&joined) {
        assert_eq!(solution.flows[3].to_f64(), solution.flows[0].to_f64(), "{method:?}");
    }
}

/// The supply of a held node takes up its source.
#[test]
fn a_source_at_a_held_node_changes_nothing() {
    let quiet = network(3, &[(0, 4.0), (2, 1.0)], &[(0, 1, 1.0), (1, 2, 2.0)]);
    let mut driven = quiet.clone();
    driven.sources[0] = 1e6;
    for method in METHODS {
        let [quiet, driven] = [&quiet, &driven].map(|network| solve(network, method).expect("a solution"));
        assert_eq!((quiet.values, quiet.flows), (driven.values, driven.flows), "{method:?}");
    }
}

/// 2 (x - 10) + 3 x = 0.
#[test]
fn a_store_gives_what_flows() {
    let mut room = network(2, &[(1, 0.0)], &[(0, 1, 3.0)]);
    room.stores.push(Store { node: 0, conductance: 2.0, before: DoubleDouble::new(10.0) });
    for (method, solution) in solutions(&room) {
        assert_eq!(rounded(&solution.values), [4.0, 0.0], "{method:?}");
        assert_eq!(rounded(&solution.stored), [-12.0], "{method:?}");
        assert_eq!(rounded(&solution.flows), [12.0], "{method:?}");
    }
}

/// Two bodies that nothing else holds keep what they have together: 3 · 20 + 1 · 60 in 4.
#[test]
fn stores_hold_a_level_of_their_own() {
    for conductance in [1e300, f64::INFINITY] {
        let mut stores = network(2, &[], &[(1, 0, conductance)]);
        stores.stores.push(Store { node: 0, conductance: 3.0, before: DoubleDouble::new(20.0) });
        stores.stores.push(Store { node: 1, conductance: 1.0, before: DoubleDouble::new(60.0) });
        for (method, solution) in solutions(&stores) {
            assert_eq!(rounded(&solution.values), [30.0, 30.0], "{conductance} {method:?}");
            assert_eq!(rounded(&solution.stored), [30.0, -30.0], "{conductance} {method:?}");
            assert_eq!(rounded(&solution.flows), [30.0], "{conductance} {method:?}");
        }
    }
}

/// A node that has all digits of 106 bits from the increment before gives them on.
#[test]
fn what_was_before_counts_with_all_its_digits() {
    let before = DoubleDouble::new(1.0) + DoubleDouble::new(1e-20);
    let mut room = network(2, &[(1, 1.0)], &[(0, 1, 1.0)]);
    room.stores.push(Store { node: 0, conductance: 1.0, before });
    for (method, solution) in solutions(&room) {
        assert_eq!(solution.values[0], DoubleDouble::new(1.0) + DoubleDouble::new(0.5e-20), "{method:?}");
        assert!((solution.flows[0].to_f64() - 0.5e-20).abs() <= 1e-30, "{method:?}: {:?}", solution.flows);
    }
}

/// Numbers beyond f64 are refused, and no method answers otherwise.
#[test]
fn numbers_beyond_the_range_are_refused() {
    let overflows = |network: &LinearNetwork| {
        for method in METHODS {
            let failure = solve(network, method).expect_err("beyond the range");
            let ErrorKind::NotSolved { tried } = failure.kind() else { panic!("{failure:?}") };
            assert_eq!(tried.last().map(|(_, why)| *why), Some(MethodFailure::Overflow), "{method:?}: {tried:?}");
        }
    };
    // A potential.
    let mut lone = network(2, &[(1, 0.0)], &[(0, 1, 1e-300)]);
    lone.sources[0] = 1e300;
    overflows(&lone);
    // A flow.
    overflows(&network(2, &[(0, 1e200), (1, 0.0)], &[(0, 1, 1e200)]));
    // A sum of flows that is not beyond the range each.
    let mut sum = network(4, &[(0, 0.0)], &[(0, 1, 1.0), (1, 2, 1.0), (1, 3, 1.0)]);
    (sum.sources[2], sum.sources[3]) = (1.7e308, 1.7e308);
    overflows(&sum);
    // The same, of a node that is made one.
    let mut one = network(3, &[(0, 0.0)], &[(0, 1, 1.0), (1, 2, f64::INFINITY)]);
    (one.sources[1], one.sources[2]) = (1.7e308, 1.7e308);
    overflows(&one);
    // The flow through an infinite conductance, and that into a store.
    let ring = [(0, 1, f64::INFINITY), (1, 2, f64::INFINITY)];
    let mut through = network(3, &[(0, 0.0)], &ring);
    (through.sources[1], through.sources[2]) = (1.7e308, 1.7e308);
    overflows(&through);
    let mut stored = network(1, &[(0, 0.0)], &[]);
    stored.stores.push(Store { node: 0, conductance: 1e200, before: DoubleDouble::new(1e200) });
    overflows(&stored);
}

/// Conductances at the lower end of f64 make a factor in f32 overflow and nothing else: half of the flow goes either way, and the one in f64 finds it.
#[test]
fn what_only_a_rough_factor_overflows_is_solved() {
    let (weak, value) = (f64::from_bits(2), 1e70);
    let mut triangle = network(3, &[(0, 0.0)], &[(0, 1, weak), (0, 2, weak), (1, 2, 1e-129)]);
    triangle.sources[1] = 2.0 * value * weak;
    let half = value * weak;
    for (method, solution) in solutions(&triangle) {
        assert_eq!(rounded(&solution.values), [0.0, value, value], "{method:?}");
        assert_eq!(rounded(&solution.flows), [-half, -half, half], "{method:?}");
        if method == Method::Mixed {
            assert_eq!(solution.report.given_up, [(Method::Mixed, MethodFailure::Overflow)]);
        }
    }
}
