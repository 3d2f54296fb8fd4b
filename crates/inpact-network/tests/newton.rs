//! Scenes whose conductances depend on what is solved for, with answers in closed form, from wherever their solution begins.

mod scene_support;
mod seeded;

use inpact_network::Equations;
use inpact_network::linear::{LAST_DIGIT, Method};
use inpact_network::scene::Field;
use scene_support::{model_of, problem, scene};
use seeded::{Random, Spread};
use std::fmt::Write as _;

/// The steady temperature or potential of a node.
fn solve(deck: &str, text: &str, of: &[(Field, u32)]) -> Vec<f64> {
    let (model, scene) = (model_of(deck), scene(text));
    let (problem, findings) = problem(&scene, &model);
    let problem = problem.unwrap_or_else(|| panic!("{findings:?}"));
    let state = Equations::new(&problem, Method::Direct, LAST_DIGIT)
        .steady()
        .unwrap_or_else(|failure| panic!("{failure:?}: {deck}{text}"));
    of.iter().map(|&(field, node)| state.value(&problem, field, node).expect("a field that is solved")).collect()
}

/// First guesses: near, or far away.
const STARTS: [Option<f64>; 6] = [None, Some(0.0), Some(350.0), Some(-1e4), Some(1e6), Some(1e12)];

fn initial(start: Option<f64>) -> String {
    start.map_or(String::new(), |start| format!("[initial]\ntemperature = {start:?}\n"))
}

/// Heat through a body of conductance g to a face s, and through an interface whose conductance is a + b θ̄ to a held face m:
/// g (h - s) = (a + b (s + m) / 2) (s - m), so that b/2 s² + (a + g) s = g h + a m + b/2 m².
#[test]
fn a_thermal_conductance_linear_in_temperature_makes_a_quadratic() {
    let mut random = Random::of(7, Spread::Moderate);
    for _ in 0..40 {
        let [a, g] = [(); 2].map(|()| random.magnitude());
        let b = random.between(0.001, 0.2);
        let [h, m] = [random.between(0.0, 400.0), random.between(0.0, 400.0)];
        let deck = format!(
            "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE\n{a:?}, 0., 0.\n{a:?}, 1., 0.\n{0:?}, 0., 1000.\n{0:?}, 1., 1000.\n",
            a + 1000.0 * b
        );
        // The slope that the deck has, after a sum that was rounded.
        let b = (a + 1000.0 * b - a) / 1000.0;
        let right = g * h + a * m + 0.5 * b * m * m;
        let exact = 2.0 * right / ((a + g) + ((a + g).powi(2) + 2.0 * b * right).sqrt());
        for start in STARTS {
            let text = format!(
                "deck = \"a\"\n{}[[node]]\nname = \"h\"\ntemperature = {{ fixed = {h:?} }}\n[[node]]\nname = \"s\"\n\
                 [[node]]\nname = \"m\"\ntemperature = {{ fixed = {m:?} }}\n[[link]]\nnodes = [\"h\", \"s\"]\nthermal = {g:?}\n\
                 [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclearance = 0.5\n",
                initial(start)
            );
            let found = solve(&deck, &text, &[(Field::Temperature, 1)])[0];
            assert!((found - exact).abs() <= 1e-12 * exact, "{start:?}: {found} and {exact}\n{deck}{text}");
        }
    }
}

/// A voltage v across an interface that conducts less as it warms by x: v² (c - d x) = g x, where g leads to the room.
#[test]
fn a_voltage_across_a_conductance_that_falls_with_temperature() {
    let mut random = Random::of(8, Spread::Moderate);
    for _ in 0..40 {
        let (c, v, g) = (random.magnitude(), random.between(0.1, 5.0), random.magnitude());
        // It has fallen to a thousandth at 1000 above the room.
        let d = c * 0.999 / 1000.0;
        let exact = 20.0 + v * v * c / (g + v * v * d);
        let deck = format!(
            "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n{c:?}, 0., 20.\n{c:?}, 1., 20.\n{0:?}, 0., 1020.\n{0:?}, 1., 1020.\n\
             *GAP HEAT GENERATION\n1., 0.5\n",
            c - 1000.0 * d
        );
        for start in STARTS {
            let text = format!(
                "deck = \"a\"\n{}[[node]]\nname = \"s\"\npotential = {{ fixed = {v:?} }}\n[[node]]\nname = \"m\"\npotential = {{ fixed = 0.0 }}\n\
                 [[node]]\nname = \"room\"\ntemperature = {{ fixed = 20.0 }}\n\
                 [[link]]\nnodes = [\"s\", \"room\"]\nthermal = {1:?}\n[[link]]\nnodes = [\"m\", \"room\"]\nthermal = {1:?}\n\
                 [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclosed = true\npressure = 0.5\n",
                initial(start),
                0.5 * g
            );
            let found = solve(&deck, &text, &[(Field::Temperature, 0), (Field::Temperature, 1)]);
            for face in found {
                assert!((face - exact).abs() <= 1e-11 * exact, "{start:?}: {face} and {exact}\n{deck}{text}");
            }
        }
    }
}

/// Two interfaces in series, both at rows of their tables where slopes change: 20 flow through conductances of 2 and 4 at the mean
/// temperatures of 80 and 40, from 85 to 75 and from 42.5 to 37.5, with bodies of 20/15, 20/32.5 and 20/17.5 before, between and behind them.
#[test]
fn two_interfaces_at_rows_of_their_tables() {
    for [below, above] in [[1.0, 9.0], [0.5, 2.0], [2.0, 0.5]] {
        let deck = format!(
            "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n{below:?}, 0., 0.\n{below:?}, 1., 0.\n2., 0., 80.\n2., 1., 80.\n{above:?}, 0., 200.\n{above:?}, 1., 200.\n\
             *SURFACE INTERACTION, NAME=B\n*GAP CONDUCTANCE, PRESSURE\n{above:?}, 0., 0.\n{above:?}, 1., 0.\n4., 0., 40.\n4., 1., 40.\n{below:?}, 0., 200.\n{below:?}, 1., 200.\n"
        );
        let mut text = String::new();
        for name in ["a", "b", "c", "d"] {
            let _ = writeln!(text, "[[node]]\nname = \"{name}\"");
        }
        for (name, value) in [("hot", 100.0), ("cold", 20.0)] {
            let _ = writeln!(text, "[[node]]\nname = \"{name}\"\ntemperature = {{ fixed = {value:?} }}");
        }
        for (nodes, fall) in [(["hot", "a"], 15.0), (["b", "c"], 32.5), (["d", "cold"], 17.5)] {
            let _ = writeln!(text, "[[link]]\nnodes = {nodes:?}\nthermal = {:?}", 20.0 / fall);
        }
        for (name, slave, master) in [("A", "a", "b"), ("B", "d", "c")] {
            let _ = writeln!(
                text,
                "[[interface]]\ninteraction = \"{name}\"\nslave = \"{slave}\"\nmaster = \"{master}\"\narea = 1.0\nclosed = true\npressure = 0.25"
            );
        }
        for start in STARTS {
            let text = format!("deck = \"a\"\n{}{text}", initial(start));
            let found = solve(&deck, &text, &[0, 1, 2, 3].map(|node| (Field::Temperature, node)));
            for (found, exact) in found.into_iter().zip([85.0, 75.0, 42.5, 37.5]) {
                assert!((found - exact).abs() <= 1e-12 * exact, "{below} {above} {start:?}: {found} and {exact}");
            }
        }
    }
}

/// A current through an interface that conducts a thousand times as well once it is warm, beside a node that hardly loses heat: the warmer it is the less heat there is,
/// so that there is one mean temperature, which halving an interval finds.
#[test]
fn a_current_through_a_conductance_that_rises_within_two_degrees() {
    const TABLE: [[f64; 2]; 3] = [[74.713, 0.27], [140.062, 24.717], [142.059, 318.42]];
    let [room, cooling, current, area] = [3.358, -11.853, 0.811, 0.029];
    let [fraction, slave_share] = [0.934, 0.456];
    let conductance = |mean: f64| {
        let on = |[[t, c], [u, d]]: [[f64; 2]; 2]| c + (d - c) * (mean - t) / (u - t);
        match TABLE {
            [first, ..] if mean <= first[0] => first[1],
            [first, second, _] if mean <= second[0] => on([first, second]),
            [_, second, third] if mean <= third[0] => on([second, third]),
            [.., third] => third[1],
        }
    };
    let means_to = |mean: f64| {
        let heat = fraction * current * current / (area * conductance(mean));
        let of_slave = room + slave_share * heat / 0.863;
        let of_master = room + (cooling + (1.0 - slave_share) * heat) / 0.002;
        0.5 * (of_slave + of_master)
    };
    let [mut low, mut high] = [0.0, 200.0];
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        *(if means_to(middle) > middle { &mut low } else { &mut high }) = middle;
    }
    let mut deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n".to_owned();
    for [temperature, conductance] in TABLE {
        let _ = writeln!(deck, "{conductance:?}, 0., {temperature:?}");
    }
    let _ = writeln!(deck, "*GAP HEAT GENERATION\n{fraction:?}, {slave_share:?}");
    for start in STARTS {
        let text = format!(
            "deck = \"a\"\n{}[[node]]\nname = \"room\"\ntemperature = {{ fixed = {room:?} }}\n\
             [[node]]\nname = \"m\"\npotential = {{ fixed = 0.0 }}\ntemperature = {{ source = {cooling:?} }}\n\
             [[node]]\nname = \"s\"\npotential = {{ source = {current:?} }}\n\
             [[link]]\nnodes = [\"m\", \"room\"]\nthermal = 0.002\n[[link]]\nnodes = [\"s\", \"room\"]\nthermal = 0.863\n\
             [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = {area:?}\nclosed = true\npressure = 0.0\n",
            initial(start)
        );
        let found = solve(&deck, &text, &[(Field::Temperature, 1), (Field::Temperature, 2)]);
        let mean = 0.5 * (found[0] + found[1]);
        assert!((mean - low).abs() <= 1e-9 * low, "{start:?}: {mean} and {low}");
    }
}
