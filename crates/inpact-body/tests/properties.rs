//! What holds for every body: symmetry, rows that sum to zero, the maximum principle, bounds in order, motions and units that change nothing.

mod common;

use common::{Block, Edges, Meshed, TYPES, read, set};
use inpact_body::{BodyField, Lumped};
use inpact_geometry::Point;
use proptest::prelude::*;

/// A box with four terminals that do not touch.
fn body(type_at: usize, seed: [f64; 3], motion: impl Fn(Point) -> Point + 'static) -> (Meshed, String) {
    let (type_name, shape) = TYPES[type_at];
    let map = move |place: Point| {
        let wave = |k: usize| 0.04 * (7.0 * place[k] + 11.0 * place[(k + 1) % 3] + 20.0 * seed[k]).sin();
        motion([(1.0 + seed[0]) * (place[0] + wave(0)), place[1] + wave(1), (2.0 - seed[2]) * (place[2] + wave(2))])
    };
    let mesh = Block { type_name, shape, cells: [3, 3, 3], edges: Edges::Straight, map: Box::new(map) }.mesh();
    let sets = set("A", &mesh.nodes_where(|place| place[2] == 0.0 && place[0] < 0.4 && place[1] < 0.4))
        + &set("B", &mesh.nodes_where(|place| place[2] == 0.0 && place[0] > 0.6))
        + &set("C", &mesh.nodes_where(|place| place[2] == 1.0))
        + &set("D", &mesh.nodes_where(|place| place[0] == 0.0 && place[1] > 0.6 && 0.3 < place[2] && place[2] < 0.7));
    (mesh, sets)
}

fn lumped(deck: &str) -> Lumped {
    let body = read(deck, &["A", "B", "C", "D"]).expect("a body");
    body.lumped(BodyField::Thermal, None).expect("lumped")
}

const MATERIAL: &str = "*CONDUCTIVITY, TYPE=ANISO\n3., 0.5, 2., 0., -0.25, 1.\n*DENSITY\n2.\n*SPECIFIC HEAT\n5.\n";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn bounds_are_in_order_and_capacities_sum(
        type_at in 0..TYPES.len(),
        seed in prop::array::uniform3(0.0..1.0_f64),
    ) {
        let (mesh, sets) = body(type_at, seed, |point| point);
        let lumped = lumped(&(mesh.deck(MATERIAL) + &sets));
        for (at, terminal) in lumped.terminals.iter().enumerate() {
            prop_assert!(0.0 < terminal.lower && terminal.lower <= terminal.upper, "{terminal:?}");
            prop_assert!(0.0 < terminal.range, "{terminal:?}");
            // The matrix is that of a quadratic form: no terminal conducts more than both that it is between.
            prop_assert_eq!(terminal.upper, lumped.isothermal.to_all(at));
        }
        // As forms too: what any temperatures of the four terminals drive with even flows is no more than with one temperature each.
        for values in [[1.0_f64, -1.0, 0.0, 0.0], [1.0, 2.0, 3.0, -6.0], [0.3, 0.1, -0.7, 0.9]] {
            let form = |conductances: &inpact_body::Conductances| {
                conductances.pairs().map(|(a, b, g)| g * (values[a] - values[b]).powi(2)).sum::<f64>()
            };
            let (even, isothermal) = (form(&lumped.even), form(&lumped.isothermal));
            prop_assert!(0.0 < even && even <= isothermal * (1.0 + 1e-12), "{even} and {isothermal}");
        }
        let capacities = lumped.capacities.iter().map(|capacity| capacity.expect("density and specific heat"));
        let total = lumped.bodies[0].capacity.expect("a capacity");
        prop_assert!((capacities.sum::<f64>() - total).abs() <= 1e-12 * total);
        prop_assert!((total - 10.0 * lumped.bodies[0].volume).abs() <= 1e-12 * total);
    }

    #[test]
    fn the_potential_of_linear_tetrahedra_that_are_nowhere_obtuse_keeps_between_zero_and_one(
        seed in prop::array::uniform3(0.0..1.0_f64),
        sizes in prop::array::uniform3(1.0..5.0_f64),
    ) {
        // The six tetrahedra of a box have no obtuse angle between faces, so that every link conducts.
        let cells = [3, 2, 4];
        let (type_name, shape) = TYPES[0];
        let map = move |place: Point| [0, 1, 2].map(|k| sizes[k] * (place[k] + 0.3 * seed[k] * place[k] * place[k]));
        let mesh = Block { type_name, shape, cells, edges: Edges::Straight, map: Box::new(map) }.mesh();
        let deck = mesh.deck("*CONDUCTIVITY\n1.\n")
            + &set("A", &mesh.nodes_where(|place| place[2] == 0.0 && place[0] < 0.4))
            + &set("B", &mesh.nodes_where(|place| place[2] == 0.0 && place[0] > 0.6))
            + &set("C", &mesh.nodes_where(|place| place[2] == 1.0))
            + &set("D", &mesh.nodes_where(|place| place[0] == 0.0 && place[2] == 0.5));
        let lumped = lumped(&deck);
        prop_assert_eq!(lumped.potentials[0], 0.0);
        prop_assert!(lumped.potentials[1] <= 1.0 + 1e-14, "{:?}", lumped.potentials);
        prop_assert!(lumped.isothermal.pairs().all(|(_, _, conductance)| 0.0 < conductance));
        prop_assert_eq!(lumped.isothermal.negative().count(), 0);
    }

    #[test]
    fn turning_moving_and_sizing_a_body_change_what_they_must(
        type_at in 0..TYPES.len(),
        seed in prop::array::uniform3(0.0..1.0_f64),
        angle in 0.0..6.0_f64,
        size in 0.01..100.0_f64,
    ) {
        let isotropic = "*CONDUCTIVITY\n3.\n*DENSITY\n2.\n*SPECIFIC HEAT\n5.\n";
        let (mesh, sets) = body(type_at, seed, |point| point);
        let before = lumped(&(mesh.deck(isotropic) + &sets));
        let (sin, cos) = angle.sin_cos();
        let (mesh, sets) = body(type_at, seed, move |[x, y, z]| {
            [size * (cos * x - sin * z) + 3.0 * size, size * y - size, size * (sin * x + cos * z)]
        });
        let after = lumped(&(mesh.deck(isotropic) + &sets));
        for (a, b, conductance) in before.isothermal.pairs() {
            let scale = size * before.isothermal.largest();
            prop_assert!((after.isothermal.between(a, b) - size * conductance).abs() <= 1e-11 * scale);
            prop_assert!((after.even.between(a, b) - size * before.even.between(a, b)).abs() <= 1e-11 * scale);
        }
        for (before, after) in before.terminals.iter().zip(&after.terminals) {
            prop_assert!((before.relative() - after.relative()).abs() <= 1e-11);
            prop_assert!((before.range - after.range).abs() <= 1e-10 * before.range);
        }
        let (before, after) = (before.bodies[0].capacity.expect("known"), after.bodies[0].capacity.expect("known"));
        prop_assert!((after - size.powi(3) * before).abs() <= 1e-11 * after);
    }
}

/// Two bodies in one deck are lumped as if each were alone, and a third without a terminal is passed over.
#[test]
fn bodies_that_nothing_connects_are_lumped_by_themselves() {
    let (mesh, sets) = body(4, [0.3, 0.1, 0.8], |point| point);
    let alone = lumped(&(mesh.deck(MATERIAL) + &sets));
    let mut deck = mesh.deck(MATERIAL) + &sets;
    for (at, x) in [(1, 10.0), (2, 20.0)] {
        let number = |node: usize| node + 10_000 * at;
        deck += "*NODE\n";
        for (node, (_, [a, b, c])) in &mesh.nodes {
            deck += &format!("{}, {:?}, {b:?}, {c:?}\n", number(*node), a + x);
        }
        deck += &format!("*ELEMENT, TYPE=C3D8, ELSET=MORE{at}\n");
        for (element, nodes) in (10_000 * at..).zip(&mesh.elements) {
            let nodes: Vec<String> = nodes.iter().map(|node| number(*node).to_string()).collect();
            deck += &format!("{element}, {}\n", nodes.join(", "));
        }
        deck += &format!("*SOLID SECTION, ELSET=MORE{at}, MATERIAL=SOLID\n");
        deck += &set(
            &format!("E{at}"),
            &mesh.nodes_where(|place| place[2] == 0.0).into_iter().map(number).collect::<Vec<_>>(),
        );
        deck += &set(
            &format!("F{at}"),
            &mesh.nodes_where(|place| place[2] == 1.0).into_iter().map(number).collect::<Vec<_>>(),
        );
    }
    let body = read(&deck, &["A", "E1", "B", "C", "F1", "D"]).expect("bodies");
    assert_eq!(body.parts().len(), 3);
    assert!(body.parts()[2].terminals.is_empty());
    let lumped = body.lumped(BodyField::Thermal, None).expect("lumped");
    let places = [0, 2, 3, 5];
    for (a, b, conductance) in alone.isothermal.pairs() {
        let found = lumped.isothermal.between(places[a], places[b]);
        assert!((found - conductance).abs() <= 1e-13 * alone.isothermal.largest(), "{found} for {conductance}");
        let (found, expected) = (lumped.even.between(places[a], places[b]), alone.even.between(a, b));
        assert!((found - expected).abs() <= 1e-12 * alone.isothermal.largest(), "{found} for {expected}");
    }
    assert_eq!(lumped.isothermal.between(0, 1), 0.0);
    assert!(0.0 < lumped.isothermal.between(1, 4));
    assert_eq!(lumped.bodies.len(), 2);
    assert_eq!(lumped.bodies[1].terminals, [1, 4]);
}

/// More unknowns than are factored: conjugate gradients find the same bar.
#[test]
fn a_large_bar_is_solved_by_iterations_and_is_as_exact() {
    let (type_name, shape) = TYPES[4];
    let map = |place: Point| {
        let [x, y, z] = common::distorted(place);
        [x, y, 2.0 * z]
    };
    let mesh = Block { type_name, shape, cells: [24, 24, 36], edges: Edges::Straight, map: Box::new(map) }.mesh();
    let deck = mesh.deck("*CONDUCTIVITY\n6.\n")
        + &set("LOW", &mesh.nodes_where(|place| place[2] == 0.0))
        + &set("HIGH", &mesh.nodes_where(|place| place[2] == 1.0));
    let lumped = read(&deck, &["LOW", "HIGH"]).expect("a body").lumped(BodyField::Thermal, None).expect("lumped");
    assert!(
        matches!(lumped.solutions[0].method, inpact_body::SolutionMethod::Iterations(iterations) if iterations < 400)
    );
    let (isothermal, even) = (lumped.isothermal.between(0, 1), lumped.even.between(0, 1));
    assert!((isothermal - 3.0).abs() < 1e-12 && (even - 3.0).abs() < 1e-12, "{isothermal} {even}");
}
