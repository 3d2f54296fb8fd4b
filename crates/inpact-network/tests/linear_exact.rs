//! Random networks against their exact solutions.

mod exact;

use exact::{relative_error, solve as exactly, to_f64};
use inpact_network::linear::{LAST_DIGIT, LinearNetwork, LinearSolution, Link, Method, Solver};
fn solve(network: &LinearNetwork) -> Result<LinearSolution, inpact_network::linear::LinearFailure> {
    let m = match std::env::var("METHOD").as_deref() {
        Ok("mixed") => Method::Mixed,
        Ok("iterative") => Method::Iterative,
        Ok("elimination") => Method::Elimination,
        _ => Method::Direct,
    };
    Solver::new(m, LAST_DIGIT).solve(network)
}

/// A small generator, so that a case is told by its seed.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn below(&mut self, n: u32) -> u32 {
        (self.next() % u64::from(n)) as u32
    }
}

fn random_network(seed: u64, nodes: u32, decades: f64) -> LinearNetwork {
    let mut random = Random(seed);
    let mut network = LinearNetwork::of_nodes(nodes as usize);
    network.held[0] = Some(100.0);
    network.held[nodes as usize - 1] = Some(50.0);
    let conductance = |random: &mut Random| 10_f64.powf((2.0 * random.unit() - 1.0) * decades) * (0.5 + random.unit());
    for node in 1..nodes {
        let other = random.below(node);
        let conductance = conductance(&mut random);
        network.links.push(Link { nodes: [other, node], conductance });
    }
    for _ in 0..nodes {
        let (a, b) = (random.below(nodes), random.below(nodes));
        if a != b {
            let conductance = conductance(&mut random);
            network.links.push(Link { nodes: [a, b], conductance });
        }
    }
    if seed % 2 == 0 {
        for node in 0..nodes as usize {
            if random.unit() < 0.3 {
                network.sources[node] = (random.unit() - 0.5) * conductance(&mut random).min(1e200);
            }
        }
    }
    network
}

#[test]
fn probe() {
    for (nodes, cases) in [(4, 300), (8, 200), (16, 60), (30, 10), (50, 2)] {
        for decades in [0.0, 3.0, 8.0, 20.0, 100.0, 300.0] {
            let mut worst = (0.0_f64, 0, 0.0, String::new());
            let mut worst_flow = (0.0_f64, 0, 0.0, String::new());
            for seed in 0..cases {
                let network = random_network(seed, nodes, decades);
                let exact = exactly(&network);
                let Ok(solution) = std::panic::catch_unwind(|| solve(&network).expect("solvable")) else {
                    println!("panic {nodes} {decades} {seed}");
                    continue;
                };
                for (value, exact) in solution.values.iter().zip(&exact.values) {
                    let error = relative_error(value.to_f64(), exact);
                    if error > worst.0 {
                        worst = (error, seed, to_f64(exact), format!("{:?}", solution.report));
                    }
                }
                for (value, exact) in solution.flows.iter().zip(&exact.flows) {
                    let error = relative_error(value.to_f64(), exact);
                    if error > worst_flow.0 {
                        worst_flow = (error, seed, to_f64(exact), format!("{:?}", solution.report));
                    }
                }
            }
            println!("{nodes} 1e{decades}: {worst:?} flows {worst_flow:?}");
        }
    }
}

#[test]
fn one() {
    let Ok(spec) = std::env::var("ONE") else { return };
    let parts: Vec<f64> = spec.split(',').map(|p| p.parse().unwrap()).collect();
    let network = random_network(parts[2] as u64, parts[0] as u32, parts[1]);
    println!("{network:#?}");
    let exact = exactly(&network);
    let solution = solve(&network);
    let solution = solution.unwrap();
    println!("{:?}", solution.report);
    for ((value, exact), link) in solution.flows.iter().zip(&exact.flows).zip(&network.links) {
        println!(
            "{:?} {:e} flow {:e} exact {:e} error {:e}",
            link.nodes,
            link.conductance,
            value.to_f64(),
            to_f64(exact),
            relative_error(value.to_f64(), exact)
        );
    }
}
