//! The methods beside each other on grids, what their reports say, and what a solver keeps from one solution to the next.

mod linear_support;

use inpact_network::linear::{LAST_DIGIT, LinearNetwork, Link, Method, Reused, Solver, Symbolic};
use linear_support::{Balanced, METHODS, jumps, network, rounded, solutions, solve, worst_balance};

/// A grid whose links are as irregular as 7-digit fractions make them, and an interface across it; two sides are held.
fn grid([nx, ny, nz]: [u32; 3], contrast: f64) -> LinearNetwork {
    let free = nx * ny * nz;
    let number = |x: u32, y: u32, z: u32| x + nx * (y + ny * z);
    let mut links = Vec::new();
    for z in 0..nz {
        for y in 0..ny {
            for x in 0..nx {
                let here = number(x, y, z);
                let mut join = |there: u32, factor: f64| {
                    let irregular = f64::from((here * 7919 + there * 104_729) % 1009) / 1009.0;
                    links.push((here, there, (0.5 + irregular) * factor));
                };
                if x + 1 < nx {
                    join(number(x + 1, y, z), if x + 1 == nx / 2 { contrast } else { 1.0 });
                }
                if y + 1 < ny {
                    join(number(x, y + 1, z), 1.0);
                }
                if z + 1 < nz {
                    join(number(x, y, z + 1), 1.0);
                }
                if x == 0 {
                    join(free, 1.0);
                }
                if x + 1 == nx {
                    join(free + 1, 1.0);
                }
            }
        }
    }
    let nodes = free as usize + 2;
    network(nodes, &[(nodes - 2, 100.0), (nodes - 1, 50.0)], &links)
}

/// The largest relative distance of two lists of numbers.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let relative = |(a, b): (&f64, &f64)| if a == b { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()) };
    a.iter().zip(b).map(relative).fold(0.0, f64::max)
}

/// In two dimensions and in three, whatever the interface conducts: the same values and flows by all four methods, none of them by way of another.
#[test]
fn the_methods_agree() {
    for size in [[12, 9, 1], [6, 5, 5]] {
        for contrast in [0.0, 1e-30, 1.0, 1e8, 1e100, f64::INFINITY] {
            let network = grid(size, contrast);
            let found = solutions(&network);
            let (_, reference) = &found[0];
            for (method, solution) in &found {
                assert_eq!((solution.report.method, &solution.report.given_up), (*method, &vec![]), "{contrast}");
                for (of, other) in [(&solution.values, &reference.values), (&solution.flows, &reference.flows)] {
                    let distance = distance(&rounded(of), &rounded(other));
                    assert!(distance <= f64::EPSILON, "{method:?} {size:?} {contrast}: {distance}");
                }
                let missing = worst_balance(&network, solution, Balanced::Nodes);
                assert!(missing <= f64::EPSILON, "{method:?} {size:?} {contrast}: {missing}");
            }
        }
    }
}

/// A grid without corners that are taken out has as many unknowns as free nodes.
#[test]
fn the_report_says_what_was_solved_and_how_well() {
    let grid = grid([8, 7, 1], 1.0);
    for (method, solution) in solutions(&grid) {
        let report = &solution.report;
        assert_eq!((report.method, report.unknowns, report.taken_out), (method, 56, 0), "{method:?}");
        assert_eq!((report.merged, report.shared, report.levels), (0, 0, 1), "{method:?}");
        assert_eq!(report.given_up, [], "{method:?}");
        assert!(report.quality.residual <= LAST_DIGIT.max(f64::EPSILON), "{method:?}: {report:?}");
        let has_factor = matches!(method, Method::Direct | Method::Mixed);
        assert_eq!(report.ordering.is_some(), has_factor, "{method:?}");
        // At least the lower triangle of the matrix: 56 of the diagonal, 7 · 7 and 8 · 6 links.
        assert_eq!(report.factor_entries >= 56 + 49 + 48, has_factor, "{method:?}: {report:?}");
        assert_eq!(report.iterations > 0, method == Method::Iterative, "{method:?}: {report:?}");
        if method != Method::Elimination {
            assert!(report.quality.error <= LAST_DIGIT && report.quality.solves >= 2, "{method:?}: {report:?}");
            // The extreme eigenvalues of such a grid are some 8 and some (π / 8)² / 2.
            assert!((10.0..1e4).contains(&report.quality.condition), "{method:?}: {report:?}");
        }
    }
}

/// Where strengths fall into levels, unknowns are jumps from other unknowns.
#[test]
fn the_report_counts_levels_and_jumps() {
    let report = solve(&grid([8, 7, 1], 1e100), Method::Direct).expect("a solution").report;
    assert_eq!((report.unknowns, report.levels), (56, 2));
    // One of the two sides of each strong link.
    assert_eq!(report.relative, 7);
    let report = solve(&grid([8, 7, 1], f64::INFINITY), Method::Direct).expect("a solution").report;
    assert_eq!((report.unknowns, report.merged, report.levels), (49, 7, 1));
}

/// State kept by a solver changes nothing for the next network: other values, other conductances, other links.
#[test]
fn a_solver_that_was_used_before_gives_what_a_new_one_gives() {
    let first = grid([9, 6, 1], 1e6);
    let mut values = first.clone();
    values.held[55] = Some(-3.0);
    values.sources[20] = 1.5;
    let mut conductances = values.clone();
    conductances.links[30].conductance *= 3.0;
    let mut levels = conductances.clone();
    levels.links[31].conductance = 1e40;
    let mut links = levels.clone();
    links.links.push(Link { nodes: [3, 40], conductance: 0.3 });
    let mut reversed = links.clone();
    reversed.links.reverse();
    let smaller = grid([3, 3, 1], 1.0);
    for method in METHODS {
        let mut solver = Solver::new(method, LAST_DIGIT);
        for (number, network) in [&first, &first, &values, &conductances, &levels, &links, &reversed, &smaller, &first]
            .into_iter()
            .enumerate()
        {
            let kept = solver.solve(network).expect("a solution");
            let new = solve(network, method).expect("a solution");
            assert_eq!((&kept.values, &kept.flows), (&new.values, &new.flows), "{method:?}, network {number}");
            assert_eq!(jumps(network, &kept), jumps(network, &new), "{method:?}, network {number}");
            assert_eq!(kept.report.quality, new.report.quality, "{method:?}, network {number}");
        }
    }
}

/// After a network that has no solution the next one has its own.
#[test]
fn a_failure_changes_nothing_kept() {
    let grid = grid([5, 5, 1], 1.0);
    let mut floating = grid.clone();
    floating.held.fill(None);
    let mut beyond = grid.clone();
    beyond.sources[3] = f64::MAX;
    beyond.sources[4] = f64::MAX;
    for method in METHODS {
        let mut solver = Solver::new(method, LAST_DIGIT);
        for failing in [&floating, &beyond] {
            assert!(solver.solve(failing).is_err(), "{method:?}");
            let after = solver.solve(&grid).expect("a solution");
            let new = solve(&grid, method).expect("a solution");
            assert_eq!((after.values, after.flows), (new.values, new.flows), "{method:?}");
        }
    }
}

/// A solver with a larger tolerance has balances within it.
#[test]
fn the_tolerance_is_kept() {
    let grid = grid([10, 10, 1], 1e3);
    let exact = solve(&grid, Method::Direct).expect("a solution");
    for tolerance in [1e-2, 1e-6, 1e-12] {
        for method in METHODS {
            let solution = Solver::new(method, tolerance).solve(&grid).expect("a solution");
            let quality = solution.report.quality;
            assert!(quality.residual <= tolerance && quality.error <= tolerance, "{method:?}: {quality:?}");
            let missing = worst_balance(&grid, &solution, Balanced::Nodes);
            assert!(missing <= tolerance, "{method:?} within {tolerance}: {missing}");
            let distance = distance(&rounded(&solution.flows), &rounded(&exact.flows));
            assert!(distance <= tolerance, "{method:?} within {tolerance}: {distance}");
        }
    }
}

/// A square grid of unit conductances, held at one corner and fed at the opposite one.
fn square(side: u32) -> LinearNetwork {
    let mut network = LinearNetwork::of_nodes((side * side) as usize);
    for row in 0..side {
        for column in 0..side {
            let ends = [(row, column + 1), (row + 1, column)];
            let ends = ends.into_iter().filter(|(row, column)| *row < side && *column < side);
            let link = |(r, c)| Link { nodes: [side * row + column, side * r + c], conductance: 1.0 };
            network.links.extend(ends.map(link));
        }
    }
    network.held[0] = Some(0.0);
    network.sources[(side * side - 1) as usize] = 1.0;
    network
}

/// Another solver of the same graph orders nothing, the next right-hand side factors nothing, and both give the same digits as one that does.
#[test]
fn one_order_serves_many_networks_of_a_graph() {
    let mut network = square(20);
    let symbolic = Symbolic::of(&network).expect("it has a solution");
    let mut solver = symbolic.solver(Method::Direct, LAST_DIGIT);
    for (source, reused) in [(1.0, Reused::Order), (2.0, Reused::Factor), (3.0, Reused::Factor)] {
        network.sources[399] = source;
        let solution = solver.solve(&network).expect("it has a solution");
        let anew = Solver::new(Method::Direct, LAST_DIGIT).solve(&network).expect("it has a solution");
        assert_eq!((solution.report.reused, anew.report.reused), (reused, Reused::Nothing));
        assert_eq!((&solution.values, &solution.flows), (&anew.values, &anew.flows));
        assert_eq!(solution.report.factor_entries, symbolic.factor_entries());
        assert!(solution.report.phases.order == 0.0);
    }
    network.links.iter_mut().for_each(|link| link.conductance *= 1.5);
    let solution = symbolic.solver(Method::Mixed, LAST_DIGIT).solve(&network).expect("it has a solution");
    assert_eq!(solution.report.reused, Reused::Order);
    // Another graph is analysed anew.
    let other = symbolic.solver(Method::Direct, LAST_DIGIT).solve(&square(10)).expect("it has a solution");
    assert_eq!(other.report.reused, Reused::Nothing);
}
