//! Scenes whose conductances depend on what is solved for: balances that are added up here, and answers in closed form.

mod scene_support;

use inpact_network::linear::{LAST_DIGIT, Method};
use inpact_network::scene::{Conditions, Course, Field, Procedure, Scene, SceneInterface, SceneLink};
use inpact_network::{Equations, Problem, SolveFailure, State};
use inpact_parser::model::Name;
use scene_support::{model_of, problem, scene};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Random numbers, the same in every run (splitmix64).
struct Random {
    state: u64,
    spread: Spread,
}

/// Over how many decades conductances and areas go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Spread {
    /// Three.
    Moderate,
    /// Seven.
    Wide,
}

impl Random {
    fn of(seed: u64, spread: Spread) -> Self {
        Self { state: seed, spread }
    }

    fn unit(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number of few digits, as decks have them.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        ((low + (high - low) * self.unit()) * 1000.0).round() / 1000.0
    }

    /// A number from 0.03 to 30, or from 0.001 to 10000.
    fn magnitude(&mut self) -> f64 {
        let exponent = match self.spread {
            Spread::Moderate => self.between(-1.5, 1.5),
            Spread::Wide => self.between(-3.0, 4.0),
        };
        (10_f64.powf(exponent) * 1000.0).round() / 1000.0
    }

    fn below(&mut self, limit: u32) -> u32 {
        // Truncated towards zero, as is meant.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let number = (self.unit() * f64::from(limit)) as u32;
        number
    }

    fn is(&mut self, share: f64) -> bool {
        self.unit() < share
    }
}

/// A table over a first variable, clearance or pressure, from 0 on, and the mean temperature.
struct Table {
    firsts: [f64; 2],
    temperatures: [f64; 3],
    /// By temperature, then by the first variable.
    values: [[f64; 2]; 3],
}

impl Table {
    fn random(random: &mut Random) -> Self {
        let start = random.between(0.0, 100.0);
        let middle = start + random.between(1.0, 100.0);
        Self {
            firsts: [0.0, random.between(0.1, 2.0)],
            temperatures: [start, middle, middle + random.between(1.0, 100.0)],
            values: [(); 3].map(|()| [(); 2].map(|()| random.magnitude())),
        }
    }

    fn rows(&self) -> String {
        let mut rows = String::new();
        for (temperature, values) in self.temperatures.iter().zip(&self.values) {
            for (first, value) in self.firsts.iter().zip(values) {
                let _ = writeln!(rows, "{value:?}, {first:?}, {temperature:?}");
            }
        }
        rows
    }

    /// Linear between rows, constant outside.
    fn at(&self, first: f64, temperature: f64) -> f64 {
        let between = |x: f64, [a, b]: [f64; 2], [from, to]: [f64; 2]| {
            let part = ((x - a) / (b - a)).clamp(0.0, 1.0);
            from * (1.0 - part) + to * part
        };
        let of_group = |group: usize| between(first, self.firsts, self.values[group]);
        let [start, middle, end] = self.temperatures;
        if temperature < middle {
            between(temperature, [start, middle], [of_group(0), of_group(1)])
        } else {
            between(temperature, [middle, end], [of_group(1), of_group(2)])
        }
    }
}

/// An interaction of random laws: conductances of an open gap and of a closed one, and the heat of currents.
struct Joint {
    electrical: [Table; 2],
    thermal: [Table; 2],
    fraction: f64,
    slave_weight: f64,
}

impl Joint {
    fn random(random: &mut Random) -> Self {
        Self {
            electrical: [(); 2].map(|()| Table::random(random)),
            thermal: [(); 2].map(|()| Table::random(random)),
            fraction: random.between(0.0, 1.0),
            slave_weight: random.between(0.0, 1.0),
        }
    }

    fn deck(&self, name: &str) -> String {
        let mut deck = format!("*SURFACE INTERACTION, NAME={name}\n");
        for (keyword, tables) in
            [("*GAP ELECTRICAL CONDUCTANCE", &self.electrical), ("*GAP CONDUCTANCE", &self.thermal)]
        {
            let _ = write!(deck, "{keyword}\n{}{keyword}, PRESSURE\n{}", tables[0].rows(), tables[1].rows());
        }
        let _ = writeln!(deck, "*GAP HEAT GENERATION\n{:?}, {:?}", self.fraction, self.slave_weight);
        deck
    }

    /// What an interface conducts per area of a field, at a mean temperature.
    fn conductance(&self, field: Field, row: &SceneInterface, temperature: f64) -> f64 {
        let [open, closed] = if field == Field::Potential { &self.electrical } else { &self.thermal };
        let at = |course: &Option<Course>| course.as_ref().map_or(0.0, |course| course.at(0.0));
        match row.closed {
            Some(true) => closed.at(at(&row.pressure), temperature),
            // Beyond its last row a thermal table of clearance is zero.
            _ if field == Field::Temperature && at(&row.clearance) > open.firsts[1] => 0.0,
            _ => open.at(at(&row.clearance), temperature),
        }
    }
}

/// Bodies of one to three nodes, in a room that cools them, joined by interfaces; a current goes through all of it.
fn random_scene(random: &mut Random) -> Scene {
    let mut scene = Scene {
        deck: "deck.inp".to_owned(),
        procedure: Procedure::Steady,
        initial_temperature: random.is(0.5).then(|| random.between(-100.0, 500.0)),
        initial_pore_pressure: None,
        nodes: vec!["room".to_owned(), "ground".to_owned(), "drive".to_owned()],
        node_lines: BTreeMap::new(),
        conditions: std::array::from_fn(|_| Conditions::default()),
        links: Vec::new(),
        interfaces: Vec::new(),
    };
    let link = |nodes, electrical, thermal, joule_heat_fraction| SceneLink {
        nodes,
        conductances: [electrical, thermal, 0.0],
        joule_heat_fraction,
    };
    let [potential, temperature, _] = &mut scene.conditions;
    temperature.fixed.insert(0, Course::constant(random.between(0.0, 40.0)));
    potential.fixed.insert(1, Course::constant(0.0));
    if random.is(0.5) {
        potential.fixed.insert(2, Course::constant(random.between(-3.0, 3.0)));
    } else {
        potential.sources.insert(2, Course::constant(random.between(-3.0, 3.0)));
    }
    for _ in 0..random.below(6) {
        let node = u32::try_from(scene.nodes.len()).expect("few nodes");
        scene.nodes.push(format!("n{node}"));
    }
    let nodes = u32::try_from(scene.nodes.len()).expect("few nodes");
    for node in 1..nodes {
        scene.links.push(link([node, 0], 0.0, random.magnitude(), 0.0));
        if random.is(0.3) {
            scene.conditions[1].sources.insert(node, Course::constant(random.between(-20.0, 40.0)));
        }
    }
    let join = |scene: &mut Scene, a: u32, b: u32, random: &mut Random| {
        if random.is(0.4) {
            let share = random.between(0.0, 1.0);
            scene.links.push(link([a, b], random.magnitude(), random.magnitude(), share));
            return;
        }
        let closed = random.is(0.6);
        scene.interfaces.push(SceneInterface {
            interaction: Some(Name::new(if random.is(0.5) { "ONE" } else { "TWO" })),
            slave: a,
            master: b,
            area: random.magnitude(),
            clearance: Some(Course::constant(if closed { 0.0 } else { random.between(0.001, 2.5) })),
            pressure: Some(Course::constant(if closed { random.between(0.0, 2.5) } else { 0.0 })),
            closed: Some(closed),
            field_variables: Vec::new(),
            temperature: None,
            mass_flow: None,
            shear: None,
            slip_rate: None,
            clearance_rate: None,
            characteristic_length: None,
            bulk_permeabilities: [None; 2],
            place: (1, None),
        });
    };
    for node in 2..nodes {
        let other = 1 + random.below(node - 1);
        join(&mut scene, node, other, random);
    }
    for _ in 0..random.below(4) {
        let [a, b] = [(); 2].map(|()| 1 + random.below(nodes - 1));
        if a != b {
            join(&mut scene, a, b, random);
        }
    }
    scene
}

/// What leaves each node of a field, less what flows in, and the magnitudes of all of it: from what is printed, by hand.
fn balance(problem: &Problem<'_>, state: &State, field: Field, joints: &[Joint; 2]) -> Vec<(f64, f64)> {
    let scene = problem.scene();
    let mut nodes = vec![(0.0, 0.0); scene.nodes.len()];
    let mut leave = |node: u32, flow: f64| {
        nodes[node as usize].0 += flow;
        nodes[node as usize].1 += flow.abs();
    };
    for (node, source) in &scene.conditions(field).sources {
        leave(*node, -source.at(0.0));
    }
    for (number, link) in (0..).zip(&scene.links) {
        if let Some(flow) = state.link_flow(problem, field, number) {
            leave(link.nodes[0], flow);
            leave(link.nodes[1], -flow);
        }
        if let Some(current) =
            state.link_flow(problem, Field::Potential, number).filter(|_| field == Field::Temperature)
        {
            let heat = link.joule_heat_fraction * current * current / link.conductances[0];
            link.nodes.into_iter().for_each(|node| leave(node, -0.5 * heat));
        }
    }
    for (number, row) in (0..).zip(&scene.interfaces) {
        let flow = state.row_flow(problem, field, number).expect("a law of both fields");
        leave(row.slave, flow);
        leave(row.master, -flow);
        if field == Field::Temperature {
            let [current, jump] = [
                state.row_flow(problem, Field::Potential, number).expect("a law"),
                state.row_jump(problem, Field::Potential, number).expect("a law"),
            ];
            let joint = joint_of(row, joints);
            leave(row.slave, -joint.fraction * joint.slave_weight * current * jump);
            leave(row.master, -joint.fraction * (1.0 - joint.slave_weight) * current * jump);
        }
    }
    nodes
}

fn joint_of<'a>(row: &SceneInterface, joints: &'a [Joint; 2]) -> &'a Joint {
    &joints[usize::from(row.interaction == Some(Name::new("TWO")))]
}

/// Nodes balance, and every interface conducts what its table says at the mean temperature that was found.
fn is_solved(problem: &Problem<'_>, state: &State, joints: &[Joint; 2], seed: u64) {
    let scene = problem.scene();
    for field in [Field::Potential, Field::Temperature] {
        let nodes = balance(problem, state, field, joints);
        // Of the largest flow nothing is left in 106 bits.
        let nothing = nodes.iter().map(|(_, magnitude)| *magnitude).fold(0.0, f64::max) / (1_u128 << 100) as f64;
        for ((node, (missing, magnitude)), name) in (0..).zip(nodes).zip(&scene.nodes) {
            let is_held = scene.conditions(field).fixed.contains_key(&node);
            assert!(
                is_held || missing.abs() <= (1e-12 * magnitude).max(nothing),
                "seed {seed}, {field} of {name}: {missing} of {magnitude}"
            );
        }
        let balance = state.balance(problem, field).expect("a field that is solved");
        assert!(balance.missing.abs() <= 1e-12 * balance.turnover, "seed {seed}, {field}: {balance:?}");
        for (number, row) in (0..).zip(&scene.interfaces) {
            let value = |field, node| state.value(problem, field, node).expect("every node carries both fields");
            let mean = 0.5 * (value(Field::Temperature, row.slave) + value(Field::Temperature, row.master));
            let conductance = joint_of(row, joints).conductance(field, row, mean) * row.area;
            let flow = state.row_flow(problem, field, number).expect("a law of both fields");
            let jump = state.row_jump(problem, field, number).expect("a law of both fields");
            assert!(
                (flow - conductance * jump).abs() <= (1e-9 * flow.abs()).max(nothing),
                "seed {seed}, {field} of row {number}: {flow} and {conductance} times {jump}"
            );
            let apart = value(field, row.slave) - value(field, row.master);
            let largest = value(field, row.slave).abs().max(value(field, row.master).abs());
            assert!((jump - apart).abs() <= 4.0 * f64::EPSILON * largest, "seed {seed}: {jump} and {apart}");
        }
    }
}

/// Whatever is reported as solved is so. These all are; not all scenes can be, with conductances over many decades within a few degrees.
#[test]
fn random_scenes_balance() {
    const SCENES: u64 = 1000;
    let mut coupled = 0;
    for seed in 0..SCENES {
        let mut random = Random::of(seed, Spread::Moderate);
        let joints = [(); 2].map(|()| Joint::random(&mut random));
        let model = model_of(&(joints[0].deck("ONE") + &joints[1].deck("TWO")));
        let scene = random_scene(&mut random);
        let (problem, findings) = problem(&scene, &model);
        let problem = problem.unwrap_or_else(|| panic!("seed {seed}: {findings:?}"));
        let solved = Equations::new(&problem, Method::Direct, LAST_DIGIT).steady();
        let state = solved.unwrap_or_else(|failure| panic!("seed {seed}: {failure:?}"));
        is_solved(&problem, &state, &joints, seed);
        coupled += usize::from(state.reports.iter().any(|stage| stage.fields.len() == 2 && stage.iterations > 1));
    }
    assert!(coupled >= 300, "{coupled} of {SCENES} are of both fields together");
}

/// With conductances over seven decades within some degrees not every scene is solved, but none is said to be that is not.
#[test]
fn steep_scenes_balance_where_they_are_solved() {
    const SCENES: u64 = 250;
    let mut solved = 0;
    for seed in 0..SCENES {
        let mut random = Random::of(seed, Spread::Wide);
        let joints = [(); 2].map(|()| Joint::random(&mut random));
        let model = model_of(&(joints[0].deck("ONE") + &joints[1].deck("TWO")));
        let scene = random_scene(&mut random);
        let (problem, findings) = problem(&scene, &model);
        let problem = problem.unwrap_or_else(|| panic!("seed {seed}: {findings:?}"));
        match Equations::new(&problem, Method::Direct, LAST_DIGIT).steady() {
            Ok(state) => is_solved(&problem, &state, &joints, seed),
            Err(SolveFailure::NotConverged { .. }) => continue,
            Err(failure) => panic!("seed {seed}: {failure:?}"),
        }
        solved += 1;
    }
    assert!(solved >= SCENES * 95 / 100, "{solved} of {SCENES}");
}

/// The methods solve one set of equations.
#[test]
fn the_methods_find_the_same_state() {
    for seed in 0..40 {
        let mut random = Random::of(seed, Spread::Moderate);
        let joints = [(); 2].map(|()| Joint::random(&mut random));
        let model = model_of(&(joints[0].deck("ONE") + &joints[1].deck("TWO")));
        let scene = random_scene(&mut random);
        let (problem, _) = problem(&scene, &model);
        let problem = problem.expect("a scene that is right");
        let solve = |method| Equations::new(&problem, method, LAST_DIGIT).steady();
        let Ok(direct) = solve(Method::Direct) else { continue };
        for method in [Method::Mixed, Method::Iterative] {
            let state = solve(method).unwrap_or_else(|failure| panic!("seed {seed} {method:?}: {failure:?}"));
            for node in 0..u32::try_from(scene.nodes.len()).expect("few nodes") {
                let [a, b] = [&direct, &state]
                    .map(|state| state.value(&problem, Field::Temperature, node).expect("every node has one"));
                assert!((a - b).abs() <= 1e-9 * a.abs().max(1.0), "seed {seed} {method:?}: {a} and {b}");
            }
        }
    }
}

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

/// Where solutions begin: anywhere near, or far away.
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

/// Two interfaces one behind the other, both at rows of their tables where slopes change: 20 flow through conductances of 2 and 4 at the mean
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
