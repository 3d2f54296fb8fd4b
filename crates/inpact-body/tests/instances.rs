//! Bodies in instances: where a part stands, and how it is turned, changes nothing of what it conducts and holds.

mod common;

use common::{Block, Edges, distorted, read, set};
use inpact_body::{BodyField, Lumped};
use inpact_geometry::{ElementShape, Point};

/// A part of a distorted block with three terminals; `section` follows its *SOLID SECTION, `before` comes in front of it.
fn part(section: &str, before: &str) -> String {
    let map = |place: Point| {
        let [x, y, z] = distorted(place);
        [2.0 * x, 0.5 * y, 3.0 * z]
    };
    let mesh = Block {
        type_name: "C3D8",
        shape: ElementShape::Hexahedron8,
        cells: [2, 2, 3],
        edges: Edges::Straight,
        map: Box::new(map),
    }
    .mesh();
    // Materials are of the model.
    let deck = mesh.deck("");
    let of_part = deck.split_once("*MATERIAL").expect("the material").0;
    let plain = "*SOLID SECTION, ELSET=ALL, MATERIAL=SOLID";
    of_part.replace(plain, &format!("{before}{plain}{section}"))
        + &set("LOW", &mesh.nodes_where(|place| place[2] == 0.0))
        + &set("HIGH", &mesh.nodes_where(|place| place[2] == 1.0))
        + &set("SIDE", &mesh.nodes_where(|place| place[0] == 1.0 && 0.2 < place[2] && place[2] < 0.5))
}

fn assembly(part: &str, instances: &[(&str, &str)], material: &str) -> String {
    let placed: String = instances
        .iter()
        .map(|(name, rows)| format!("*INSTANCE, NAME={name}, PART=BLOCK\n{rows}*END INSTANCE\n"))
        .collect();
    format!(
        "*PART, NAME=BLOCK\n{part}*END PART\n*ASSEMBLY, NAME=WHOLE\n{placed}*END ASSEMBLY\n*MATERIAL, NAME=SOLID\n{material}"
    )
}

fn lumped(deck: &str, terminals: &[&str]) -> Lumped {
    read(deck, terminals).expect("a body").lumped(BodyField::Thermal, None).expect("lumped")
}

fn assert_same(a: &Lumped, b: &Lumped, what: &str) {
    let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-11 * a.abs().max(b.abs()), "{what}: {a} and {b}");
    for ((_, _, a), (_, _, b)) in a.isothermal.pairs().zip(b.isothermal.pairs()) {
        close(a, b);
    }
    for ((_, _, a), (_, _, b)) in a.even.pairs().zip(b.even.pairs()) {
        close(a, b);
    }
    for (a, b) in a.capacities.iter().zip(&b.capacities) {
        close(a.expect("known"), b.expect("known"));
    }
    for (a, b) in a.terminals.iter().zip(&b.terminals) {
        // Where a flow is even its range is rounding.
        assert!((a.range - b.range).abs() < 1e-11, "{what}: {} and {}", a.range, b.range);
        assert_eq!((a.area.is_some(), a.nodes), (b.area.is_some(), b.nodes));
    }
}

const ISOTROPIC: &str = "*CONDUCTIVITY\n40.\n*DENSITY\n7800.\n*SPECIFIC HEAT\n500.\n";
const ORTHOTROPIC: &str = "*CONDUCTIVITY, TYPE=ORTHO\n12., 37., 5.\n*DENSITY\n7800.\n*SPECIFIC HEAT\n500.\n";

/// A translation, and one with a turn about an axis that is none of the coordinates.
const MOVED: &str = "10., -2., 0.5\n";
const TURNED: &str = "10., -2., 0.5\n1., 1., 1., 2., -1., 4., 47.\n";

#[test]
fn a_rigid_motion_changes_nothing() {
    let deck = |rows: &str| assembly(&part("", ""), &[("I", rows)], ISOTROPIC);
    let names = ["I.LOW", "I.HIGH", "I.SIDE"];
    let at_origin = lumped(&deck(""), &names);
    // As without parts.
    let flat = format!("{}*MATERIAL, NAME=SOLID\n{ISOTROPIC}", part("", ""));
    assert_same(&at_origin, &lumped(&flat, &["LOW", "HIGH", "SIDE"]), "without parts");
    for rows in [MOVED, TURNED] {
        assert_same(&at_origin, &lumped(&deck(rows), &names), rows);
    }
}

/// The axes of a part turn with it, as *ORIENTATION in a part does.
#[test]
fn axes_turn_with_their_part() {
    let axes = "*ORIENTATION, NAME=AXES\n1., 2., 0.5, -1., 1., 0.3\n2, 25.\n";
    let deck = |rows: &str| assembly(&part(", ORIENTATION=AXES", axes), &[("I", rows)], ORTHOTROPIC);
    let names = ["I.LOW", "I.HIGH", "I.SIDE"];
    let at_origin = lumped(&deck(""), &names);
    for rows in [MOVED, TURNED] {
        assert_same(&at_origin, &lumped(&deck(rows), &names), rows);
    }
    // Other axes conduct otherwise.
    let other = axes.replace("2, 25.", "2, 75.");
    let other = lumped(&assembly(&part(", ORIENTATION=AXES", &other), &[("I", "")], ORTHOTROPIC), &names);
    assert!((other.isothermal.between(0, 1) / at_origin.isothermal.between(0, 1) - 1.0).abs() > 0.01);
}

/// Without *ORIENTATION it is not said whether directions turn with the part.
#[test]
fn directions_without_axes_in_a_turned_part_are_refused() {
    let deck = |rows: &str| assembly(&part("", ""), &[("I", rows)], ORTHOTROPIC);
    let names = ["I.LOW", "I.HIGH"];
    assert_same(&lumped(&deck(""), &names), &lumped(&deck(MOVED), &names), "moved");
    let error = read(&deck(TURNED), &names).expect("a body").lumped(BodyField::Thermal, None).expect_err("refused");
    let [fault] = error.faults() else { panic!("{error}") };
    assert!(fault.message.contains("stands turned in the assembly: without *ORIENTATION"), "{error}");
    assert!(fault.span.is_some());
}

/// Two instances are two bodies, alike, and nothing is between them.
#[test]
fn instances_are_bodies_of_their_own() {
    let deck = assembly(&part("", ""), &[("ONE", MOVED), ("TWO", TURNED)], ISOTROPIC);
    let found = lumped(&deck, &["ONE.LOW", "ONE.HIGH", "TWO.LOW", "TWO.HIGH"]);
    assert_eq!(found.bodies.len(), 2);
    let [one, two, across] = [(0, 1), (2, 3), (0, 2)].map(|(a, b)| found.isothermal.between(a, b));
    assert!(0.0 < one && across == 0.0, "{one} and {across}");
    assert!((one - two).abs() <= 1e-11 * one, "{one} and {two}");
}
