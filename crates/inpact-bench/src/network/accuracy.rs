//! The page on the accuracy of the solvers at all contrasts: docs/network.md.

use super::exact::{self, Exact, relative_error};
use super::grid::Grid;
use super::plain;
use super::random_networks::{Kind, Sources, network};
use inpact_evaluation::numbers::DoubleDouble;
use inpact_network::linear::{LAST_DIGIT, LinearNetwork, LinearSolution, Link, Method, Solver};
use std::fmt::Write as _;

/// The largest relative errors over some networks.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Worst {
    /// Of a node's value; infinite where a network was not solved.
    pub value: f64,
    /// Of the jump across a link.
    pub jump: f64,
    /// Of the flow through a link.
    pub flow: f64,
    /// The number of networks.
    pub networks: u32,
    /// The number of them rejected because a value or a flow is beyond the range of f64; one rejected otherwise is an infinite error.
    pub refused: u32,
    /// The maximum number of corrections.
    pub solves: usize,
}

impl Worst {
    /// The largest of the three.
    pub fn largest(self) -> f64 {
        self.value.max(self.jump).max(self.flow)
    }
}

/// Solves random networks of one kind, seed after seed, and compares them with their exact solutions.
pub fn worst(kind: Kind, seeds: std::ops::Range<u64>, methods: &[Method]) -> Vec<Worst> {
    let mut worst = vec![Worst::default(); methods.len()];
    for seed in seeds {
        let network = network(kind, seed);
        let exact = exact::solve(&network);
        for (worst, &method) in worst.iter_mut().zip(methods) {
            worst.networks += 1;
            match Solver::new(method, LAST_DIGIT).solve(&network) {
                Ok(solution) => worst.take(&network, &solution, &exact),
                Err(_) if exact.is_beyond_range() => worst.refused += 1,
                Err(_) => worst.value = f64::INFINITY,
            }
        }
    }
    worst
}

impl Worst {
    fn take(&mut self, network: &LinearNetwork, solution: &LinearSolution, exact: &Exact) {
        for (value, exact) in solution.values.iter().zip(&exact.values) {
            self.value = self.value.max(relative_error(value.to_f64(), exact));
        }
        for (link, jump) in exact.jumps.iter().enumerate() {
            let is_in_range = exact.flows[link].as_ref().is_none_or(|flow| !flow.is_below_range());
            if !is_in_range && network.links[link].conductance > 0.0 {
                continue;
            }
            self.jump = self.jump.max(relative_error(solution.jump(network, link).to_f64(), jump));
        }
        for (flow, exact) in solution.flows.iter().zip(&exact.flows) {
            if let Some(exact) = exact {
                self.flow = self.flow.max(relative_error(flow.to_f64(), exact));
            }
        }
        self.solves = self.solves.max(solution.report.quality.solves);
    }
}

/// The methods of the table, in its order.
const METHODS: [Method; 3] = [Method::Direct, Method::Mixed, Method::Iterative];

/// The page.
pub fn page() -> String {
    let mut page = String::from(INTRODUCTION);
    page += "\n## Random networks against exact rationals\n\n";
    page += RANDOM;
    page += "\n| nodes | decades | sources | networks | direct: potential | jump | flow | corrections | mixed: worst | corrections | iterative: worst | corrections |\n";
    page += "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (nodes, count) in [(5, 400), (12, 150), (25, 30), (50, 8)] {
        for decades in [0.0, 3.0, 10.0, 30.0, 100.0, 300.0] {
            for sources in [Sources::None, Sources::Some] {
                let found = worst(Kind { nodes, decades, sources }, 0..count, &METHODS);
                let sources = if sources == Sources::Some { "yes" } else { "no" };
                let _ = write!(page, "| {nodes} | ±{decades} | {sources} | {count} |");
                for (worst, method) in found.into_iter().zip(METHODS) {
                    let Worst { value, jump, flow, solves, refused, .. } = worst;
                    let errors = if method == Method::Direct {
                        format!("{} | {} | {}", short(value), short(jump), short(flow))
                    } else {
                        short(worst.largest())
                    };
                    let refused = if refused > 0 { format!(", {refused} refused") } else { String::new() };
                    let _ = write!(page, " {errors} | {solves}{refused} |");
                }
                page += "\n";
            }
        }
    }
    page += "\n## One interface of any conductance\n\n";
    page += GRIDS;
    page += "\n| grid | interface | plain assembly: potentials | flows | direct: potentials | flows | corrections: direct | mixed | iterative | conjugate gradients |\n";
    page += "|---|---|---|---|---|---|---|---|---|---|\n";
    for (size, name) in [([100, 100, 1], "100 × 100"), ([10, 10, 10], "10 × 10 × 10")] {
        for contrast in CONTRASTS {
            page += &grid_line(Grid { size, contrast }, name);
        }
    }
    page
}

const CONTRASTS: [f64; 12] = [0.0, 1e-300, 1e-100, 1e-20, 1e-6, 1.0, 1e4, 1e8, 1e15, 1e100, 1e300, f64::INFINITY];

fn grid_line(grid: Grid, name: &str) -> String {
    let network = grid.network();
    let solve = |method| Solver::new(method, LAST_DIGIT).solve(&network);
    let contrast = match grid.contrast {
        0.0 => "0".to_owned(),
        f64::INFINITY => "∞".to_owned(),
        contrast => format!("{contrast:e}"),
    };
    let (Ok(direct), Ok(mixed), Ok(iterative), Ok(other)) =
        (solve(Method::Direct), solve(Method::Mixed), solve(Method::Iterative), solve(Method::Elimination))
    else {
        return format!("| {name} | {contrast} | not solved | | | | | | | |\n");
    };
    let solves = |solution: &LinearSolution| {
        let given_up = if solution.report.given_up.is_empty() { "" } else { " (after falling back)" };
        format!("{}{given_up}", solution.report.quality.solves)
    };
    let plain = plain_errors(&network, &other);
    let (values, flows) = difference(&direct, &other);
    format!(
        "| {name} | {contrast} | {plain} | {} | {} | {} | {} | {} | {} |\n",
        short(values),
        short(flows),
        solves(&direct),
        solves(&mixed),
        solves(&iterative),
        iterative.report.iterations
    )
}

/// The largest relative errors of potentials and of flows that plain assembly makes, as two cells.
fn plain_errors(network: &LinearNetwork, exact: &LinearSolution) -> String {
    let is_assembled = network.links.iter().all(|link| link.conductance.is_finite());
    let Some(mut values) = plain::values(network).filter(|_| is_assembled) else {
        return if is_assembled { "no factor | " } else { "not possible | " }.to_owned();
    };
    values.extend(network.held.iter().copied().flatten());
    let flow = |link: &Link| link.conductance * (values[link.nodes[0] as usize] - values[link.nodes[1] as usize]);
    let of_values = largest_difference(values.iter().copied(), &exact.values);
    let of_flows = largest_difference(network.links.iter().map(flow), &exact.flows);
    format!("{} | {}", short(of_values), short(of_flows))
}

/// The largest relative differences of values and flows.
fn difference(a: &LinearSolution, b: &LinearSolution) -> (f64, f64) {
    let of = |a: &[DoubleDouble], b: &[DoubleDouble]| largest_difference(a.iter().map(|number| number.to_f64()), b);
    (of(&a.values, &b.values), of(&a.flows, &b.flows))
}

/// The largest relative difference of some numbers from the expected ones.
fn largest_difference(numbers: impl Iterator<Item = f64>, exact: &[DoubleDouble]) -> f64 {
    let exact = exact.iter().map(|number| number.to_f64());
    let relative = |(a, b): (f64, f64)| if a == b { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()) };
    numbers.zip(exact).map(relative).fold(0.0, f64::max)
}

/// An error in two digits.
fn short(error: f64) -> String {
    if error == 0.0 { "0".to_owned() } else { format!("{error:.1e}") }
}

const INTRODUCTION: &str = "# How exact the network solvers are

This page is written by `cargo run --release -p inpact-bench -- network` from the library that `inpact solve` is made of.
Errors are relative; half a unit in the last place of f64 is 1.1e-16.
The methods of the solvers are described in the heads of `crates/inpact-network/src/linear/relative.rs` and `refinement.rs`.
";

const RANDOM: &str = "Each network is a tree with as many links more; every conductance is drawn by itself from the whole range of ± so many decades, one link in twelve is infinite, one in twelve conducts nothing.
Two nodes are held, at 100 and 50; with sources a third of the nodes has one, as large as one of its conductances leads away at a difference of up to 100.
Each potential, each jump across a link and each flow is compared with the exact rational solution; the worst of all networks of a line is given.
Numbers below 1e-289, where f64 begins to run out of digits, may be off by as much, and the jumps of such flows are not compared.
A network is refused where a potential or a flow is beyond 1.8e308.
";

const GRIDS: &str = "A grid of conductances between 0.5 and 2 with one interface plane, whose conductances are larger by the factor given, and ends held at 100 and 50.
Plain assembly is one matrix of all nodes and one Cholesky factor by `faer`, as most programs do it, flows from differences of potentials: the strong conductances round the others away, until a pivot is not above zero.
It and the direct solver are compared, node by node and link by link, with elimination without subtraction in 106 bits, which shares nothing with the direct solver but the taking out of nodes in series; elimination is too slow for larger grids.
Corrections are the solves of the refinement until the last digit is reached; all methods end with the same digits.
";
