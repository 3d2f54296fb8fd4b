//! What is refused, and what is left out, with its place: nothing is guessed.

mod common;

use common::{Block, Edges, read, set};
use inpact_body::{BodyError, BodyField, Lumped};
use inpact_geometry::ElementShape;

fn bar(material: &str) -> String {
    let mesh = Block {
        type_name: "C3D8",
        shape: ElementShape::Hexahedron8,
        cells: [1, 1, 2],
        edges: Edges::Straight,
        map: Box::new(|point| point),
    }
    .mesh();
    mesh.deck(material)
        + &set("LOW", &mesh.nodes_where(|place| place[2] == 0.0))
        + &set("MIDDLE", &mesh.nodes_where(|place| place[2] == 0.5))
        + &set("HIGH", &mesh.nodes_where(|place| place[2] == 1.0))
        + "*SURFACE, NAME=TOP\n2, S2\n"
}

fn lump(deck: &str, terminals: &[&str], temperature: Option<f64>) -> Result<Lumped, BodyError> {
    read(deck, terminals)?.lumped(BodyField::Thermal, temperature)
}

/// The text of the deck that a fault is about, and the fault.
fn refused(deck: &str, terminals: &[&str]) -> Vec<(String, String)> {
    let error = lump(deck, terminals, None).expect_err("a fault");
    let of = |fault: &inpact_body::BodyFault| {
        let place = fault.span.map_or(String::new(), |span| {
            let range = usize::try_from(span.start).expect("a place")..usize::try_from(span.end).expect("a place");
            deck[range].trim().to_owned()
        });
        (place, fault.message.clone())
    };
    error.faults().iter().map(of).collect()
}

fn assert_refused(deck: &str, terminals: &[&str], place: &str, message: &str) {
    let found = refused(deck, terminals);
    assert_eq!(found, [(place.to_owned(), message.to_owned())]);
}

const STEEL: &str = "*CONDUCTIVITY\n60.\n";

#[test]
fn terminals_that_are_not_there_touch_or_lie_in_no_body() {
    let deck = bar(STEEL);
    assert_refused(
        &deck,
        &["LOW", "TIP"],
        "",
        "the deck has no surface and no node set `TIP`: it has `TOP`, `LOW`, `MIDDLE`, `HIGH`",
    );
    assert_refused(
        &deck,
        &["HIGH", "TOP"],
        "*SURFACE, NAME=TOP",
        "the terminals `HIGH` and `TOP` touch in node 37: no conductance is between them",
    );
    let deck = deck + "*NODE\n901, 0., 0., 9.\n*NSET, NSET=AWAY\n901\n";
    assert_refused(&deck, &["LOW", "AWAY"], "*NSET, NSET=AWAY", "no solid element has a node of `AWAY`");
    let two = bar(STEEL)
        + "*NODE\n801, 5., 0., 0.\n802, 6., 0., 0.\n803, 5., 1., 0.\n804, 5., 0., 1.\n*ELEMENT, TYPE=C3D4, ELSET=MORE\n77, 801, 802, 803, 804\n"
        + "*SOLID SECTION, ELSET=MORE, MATERIAL=SOLID\n*NSET, NSET=BOTH\n1, 801\n";
    assert_refused(
        &two,
        &["BOTH", "HIGH"],
        "*NSET, NSET=BOTH",
        "`BOTH` lies in two bodies: nothing solid connects its nodes 1 and 801",
    );
}

#[test]
fn conductivities_that_depend_on_temperature_are_taken_at_one_that_is_given() {
    let deck = bar("*CONDUCTIVITY\n60., 0.\n40., 100.\n");
    let terminals = ["LOW", "HIGH"];
    assert_refused(
        &deck,
        &terminals,
        "*CONDUCTIVITY",
        "*CONDUCTIVITY of `SOLID` depends on temperature, from 0.0 to 100.0: a body is lumped at one temperature, which must be given",
    );
    for (temperature, expected) in [(-10.0, 60.0), (0.0, 60.0), (25.0, 55.0), (100.0, 40.0), (1e9, 40.0)] {
        let found = lump(&deck, &terminals, Some(temperature)).expect("lumped").isothermal.between(0, 1);
        assert!((found - expected).abs() < 1e-12, "{found} at {temperature}");
    }
    // Rows that say the same are one.
    let constant = lump(&bar("*CONDUCTIVITY\n60., 0.\n60., 100.\n"), &terminals, None).expect("lumped");
    assert!((constant.isothermal.between(0, 1) - 60.0).abs() < 1e-12);
    assert_refused(
        &bar("*CONDUCTIVITY\n60., 100.\n40., 0.\n"),
        &terminals,
        "*CONDUCTIVITY",
        "the temperatures of *CONDUCTIVITY of `SOLID` must ascend: found 0.0 after 100.0",
    );
    assert_refused(
        &bar("*CONDUCTIVITY, DEPENDENCIES=1\n60., 0., 1.\n40., 0., 2.\n"),
        &terminals,
        "*CONDUCTIVITY, DEPENDENCIES=1",
        "*CONDUCTIVITY of `SOLID` depends on field variables, of which nothing is known",
    );
}

#[test]
fn materials_that_do_not_conduct_or_not_in_known_axes() {
    let terminals = ["LOW", "HIGH"];
    assert_refused(
        &bar("*DENSITY\n7800.\n"),
        &terminals,
        "*MATERIAL, NAME=SOLID",
        "the material `SOLID` has no *CONDUCTIVITY: found `C3D8` in a body with terminals",
    );
    assert_refused(
        &bar("*CONDUCTIVITY, TYPE=ORTHO\n60., 0., 60.\n"),
        &terminals,
        "*CONDUCTIVITY, TYPE=ORTHO",
        "*CONDUCTIVITY of `SOLID` must be above 0 in every direction: found 60.0, 0.0, 60.0",
    );
    assert_refused(
        &bar("*CONDUCTIVITY\n60 W\n"),
        &terminals,
        "60 W",
        "expected a number and a temperature in a row of *CONDUCTIVITY, found `60 W`; the option was not read",
    );
    let turned =
        |kind: &str| bar(kind).replace("ELSET=ALL, MATERIAL=SOLID", "ELSET=ALL, MATERIAL=SOLID, ORIENTATION=AXES");
    assert_refused(
        &turned("*CONDUCTIVITY, TYPE=ORTHO\n60., 50., 60.\n"),
        &terminals,
        "*SOLID SECTION, ELSET=ALL, MATERIAL=SOLID, ORIENTATION=AXES",
        "*CONDUCTIVITY of `SOLID` has directions, and the section has the *ORIENTATION `AXES`, which is not read",
    );
    // What conducts alike in all directions has no axes.
    assert!(lump(&turned(STEEL), &terminals, None).is_ok());
    assert_refused(
        &bar(STEEL).replace("MATERIAL=SOLID", "MATERIAL=STEEL"),
        &terminals,
        "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL",
        "the material `STEEL` is not defined",
    );
}

#[test]
fn elements_that_are_incomplete_inside_out_or_without_a_section() {
    let terminals = ["LOW", "HIGH"];
    let deck = bar(STEEL);
    let found = refused(&deck.replace("*SOLID SECTION, ELSET=ALL", "*SOLID SECTION, ELSET=SOME"), &terminals);
    assert!(found.iter().any(|(_, message)| message.starts_with("element 1 has no *SOLID SECTION")), "{found:?}");
    let first = deck.lines().find(|line| line.starts_with("1, 1, ")).expect("an element");
    let mut nodes: Vec<&str> = first.split(", ").collect();
    nodes.swap(1, 5);
    nodes.swap(2, 6);
    nodes.swap(3, 7);
    nodes.swap(4, 8);
    let found = refused(&deck.replace(first, &nodes.join(", ")), &terminals);
    assert_eq!(found[0].0, "*ELEMENT, TYPE=C3D8, ELSET=ALL");
    assert!(found[0].1.starts_with("element 1 of type C3D8: the element is inside out or flat"), "{found:?}");
    let found = refused(&deck.replace(first, "1, 1, 3"), &terminals);
    assert_eq!(found[0].1, "element 1 of type C3D8 has 2 nodes where 8 are due and was not read");
    let found = refused(&(deck + "*ELGEN\n1, 5\n"), &terminals);
    assert_eq!(found[0].1, "*ELGEN is not read, so that nodes or elements would be missing or elsewhere");
}

#[test]
fn what_is_no_part_of_a_body_is_named_with_its_place() {
    let deck = bar(STEEL)
        + "*ELEMENT, TYPE=S4, ELSET=SKIN\n50, 1, 3, 9, 7\n*ELEMENT, TYPE=SPRINGA, ELSET=SPRING\n60, 1, 3\n*TIE, NAME=GLUE\nTOP, TOP\n"
        + "*STEP\n*HEAT TRANSFER, STEADY STATE\n*RADIATE\n1, R1, 20., 0.9\n*END STEP\n";
    let body = read(&deck, &["LOW", "HIGH"]).expect("a body");
    let found: Vec<&str> = body.left_out().iter().map(|note| note.message.as_str()).collect();
    assert_eq!(
        found,
        [
            "elements of type `S4` are not solid, and conduct nothing here",
            "elements of type `SPRINGA` are not solid, and conduct nothing here",
            "*TIE is not read: what it joins conducts nothing here",
            "*RADIATE is not read: no heat leaves by radiation here",
        ]
    );
    let lumped = body.lumped(BodyField::Thermal, None).expect("lumped");
    assert_eq!(lumped.capacities, None);
    assert_eq!(lumped.left_out.len(), 1);
    assert_eq!(
        lumped.left_out[0].message,
        "the material `SOLID` has no *DENSITY, so that bodies have no capacity here"
    );
}

/// A surface and the node set of its nodes are the same terminal; one node of a face has no area.
#[test]
fn terminals_are_surfaces_sets_and_nodes() {
    let deck = bar(STEEL);
    let by_set = lump(&deck, &["LOW", "HIGH"], None).expect("lumped");
    let by_surface = lump(&deck, &["LOW", "top"], None).expect("lumped");
    assert_eq!(by_set.isothermal, by_surface.isothermal);
    for area in [&by_set, &by_surface].map(|lumped| lumped.terminals[1].area.expect("faces")) {
        assert!((area - 1.0).abs() < 1e-15, "{area}");
    }
    let by_node = lump(&deck, &["LOW", "45"], None).expect("lumped");
    assert_eq!((by_node.terminals[1].nodes, by_node.terminals[1].area), (1, None));
    assert_eq!(by_node.terminals[1].range, 0.0);
    // Terminals in the middle of a body part it, so that nothing flows past them.
    let three = lump(&deck, &["LOW", "MIDDLE", "HIGH"], None).expect("lumped");
    assert!((three.isothermal.between(0, 1) - 120.0).abs() < 1e-12);
    assert!(three.isothermal.between(0, 2).abs() < 1e-12);
}
