//! What is refused, and what is left out, with its place: nothing is guessed.

mod common;

use common::{Block, Edges, read, set};
use inpact_body::{Body, BodyFault, BodyField, Error, Lumped};
use inpact_geometry::ElementShape;
use inpact_parser::deck::scan;
use inpact_parser::grammar::Grammar;
use inpact_parser::mesh::{KeptRows, read_bodies};
use inpact_parser::model::Name;

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

fn lump(deck: &str, terminals: &[&str], temperature: Option<f64>) -> Result<Lumped, Error> {
    read(deck, terminals)?.lumped(BodyField::Thermal, temperature)
}

/// The bodies without those that have faults, and these.
fn sound(deck: &str, terminals: &[&str]) -> (Body, Vec<BodyFault>) {
    let deck = scan("body.inp", deck.as_bytes(), Grammar::builtin());
    let names: Vec<Name> = terminals.iter().map(|name| Name::new(name)).collect();
    let mesh = read_bodies(&deck, Grammar::builtin(), &names, &mut KeptRows(&deck)).expect("rows in memory");
    Body::sound(mesh, &names).expect("some body")
}

/// The text of the deck that a fault is about, and the fault.
fn refused(deck: &str, terminals: &[&str]) -> Vec<(String, String)> {
    let error = lump(deck, terminals, None).expect_err("a fault");
    let of = |fault: &inpact_body::BodyFault| {
        let place = fault.span.map_or(String::new(), |span| {
            let range = usize::try_from(span.start()).expect("a place")..usize::try_from(span.end()).expect("a place");
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
    for (orientation, why) in [
        ("", "is not defined"),
        (
            "*ORIENTATION, NAME=AXES, SYSTEM=CYLINDRICAL\n0., 0., 0., 0., 0., 1.\n",
            "has SYSTEM=CYLINDRICAL, which is not read",
        ),
        ("*ORIENTATION, NAME=AXES, DEFINITION=NODES\n1, 2\n", "has DEFINITION=NODES, which is not read"),
        (
            "*ORIENTATION, NAME=AXES\n1., 0., 0., 2., 0., 0.\n",
            "is not understood: expected 6 numbers, and 3 of the origin, whose points do not lie on a line, then at most an axis 1 to 3 and an angle",
        ),
    ] {
        assert_refused(
            &(turned("*CONDUCTIVITY, TYPE=ORTHO\n60., 50., 60.\n") + orientation),
            &terminals,
            "*SOLID SECTION, ELSET=ALL, MATERIAL=SOLID, ORIENTATION=AXES",
            &format!("*CONDUCTIVITY of `SOLID` has directions, and the *ORIENTATION `AXES` of its section {why}"),
        );
    }
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

/// Plane and axisymmetric models have no solid in space: each option of elements is named, and nothing is lumped.
#[test]
fn plane_and_axisymmetric_models_are_refused_with_their_lines() {
    for name in ["CPE4", "CPE4T", "CPS4", "DC2D4", "CAX4", "DCAX4", "CAX4T"] {
        let deck = format!(
            "*NODE, NSET=ALL\n1, 1., 0.\n2, 3., 0.\n3, 3., 2.\n4, 1., 2.\n*ELEMENT, TYPE={name}, ELSET=FLAT\n1, 1, 2, 3, 4\n\
             *NSET, NSET=IN\n1, 4\n*NSET, NSET=OUT\n2, 3\n*SOLID SECTION, ELSET=FLAT, MATERIAL=SOLID\n*MATERIAL, NAME=SOLID\n{STEEL}"
        );
        assert_refused(
            &deck,
            &["IN", "OUT"],
            &format!("*ELEMENT, TYPE={name}, ELSET=FLAT"),
            &format!(
                "elements of type `{name}` are plane or axisymmetric, and bodies are solids in space: they conduct nothing here"
            ),
        );
    }
}

/// Faults of one body leave it out, and the others are what they are.
#[test]
fn a_fault_is_of_the_body_that_has_it() {
    let second = "*NODE\n801, 5., 0., 0.\n802, 6., 0., 0.\n803, 5., 1., 0.\n804, 5., 0., 1.\n*ELEMENT, TYPE=C3D4, ELSET=MORE\n77, 801, 802, 803, 804\n\
                  *NSET, NSET=A\n801\n*NSET, NSET=B\n802\n*NSET, NSET=B2\n802, 803\n*SOLID SECTION, ELSET=MORE, MATERIAL=";
    let alone = lump(&bar(STEEL), &["LOW", "HIGH"], None).expect("lumped").isothermal.between(0, 1);
    for (material, terminals, said) in [
        ("NONE\n", ["A", "B"], "the material `NONE` is not defined"),
        (
            "DEAD\n*MATERIAL, NAME=DEAD\n*DENSITY\n1.\n",
            ["A", "B"],
            "the material `DEAD` has no *CONDUCTIVITY: found `C3D4` in a body with terminals",
        ),
        ("SOLID\n", ["B", "B2"], "the terminals `B` and `B2` touch in node 802: no conductance is between them"),
    ] {
        let deck = bar(STEEL) + second + material;
        let names = ["LOW", "HIGH", terminals[0], terminals[1]];
        assert_eq!(refused(&deck, &names).iter().map(|(_, message)| message.as_str()).collect::<Vec<_>>(), [said]);
        let (mut body, mut faults) = sound(&deck, &names);
        if faults.is_empty() {
            faults = body.lumped(BodyField::Thermal, None).expect_err("a fault").faults().to_vec();
            for fault in &faults {
                body.leave_out(&fault.bodies);
            }
        }
        assert_eq!((faults.len(), faults[0].bodies.as_slice(), faults[0].message.as_str()), (1, &[1][..], said));
        let lumped = body.lumped(BodyField::Thermal, None).expect("the sound body");
        assert_eq!(lumped.isothermal.between(0, 1).to_bits(), alone.to_bits());
        assert_eq!(lumped.isothermal.between(2, 3), 0.0);
        assert_eq!(
            lumped.terminals.iter().map(|terminal| terminal.body).collect::<Vec<_>>(),
            [Some(0), Some(0), None, None]
        );
    }
    // A terminal without a solid is of no body.
    let deck = bar(STEEL) + "*NODE\n901, 0., 0., 9.\n*NSET, NSET=AWAY\n901\n";
    let (body, faults) = sound(&deck, &["LOW", "AWAY", "HIGH"]);
    assert_eq!(
        faults.iter().map(|fault| fault.message.as_str()).collect::<Vec<_>>(),
        ["no solid element has a node of `AWAY`"]
    );
    assert_eq!(
        body.lumped(BodyField::Thermal, None).expect("lumped").isothermal.between(0, 2).to_bits(),
        alone.to_bits()
    );
}

/// What is not known of one material is not known of its bodies, and of no other.
#[test]
fn capacities_are_those_of_each_body() {
    let second = "*NODE\n801, 5., 0., 0.\n802, 6., 0., 0.\n803, 5., 1., 0.\n804, 5., 0., 1.\n*ELEMENT, TYPE=C3D4, ELSET=MORE\n77, 801, 802, 803, 804\n\
                  *NSET, NSET=A\n801\n*SOLID SECTION, ELSET=MORE, MATERIAL=LIGHT\n*MATERIAL, NAME=LIGHT\n*CONDUCTIVITY\n1.\n";
    let deck = bar("*CONDUCTIVITY\n60.\n*DENSITY\n2.\n*SPECIFIC HEAT\n3.\n") + second;
    let lumped = lump(&deck, &["LOW", "HIGH", "A"], None).expect("lumped");
    assert_eq!(lumped.left_out.len(), 1, "{:?}", lumped.left_out);
    let total = lumped.bodies[0].capacity.expect("known");
    let of_terminals: Vec<Option<f64>> = lumped.capacities;
    assert!((of_terminals[0].expect("known") + of_terminals[1].expect("known") - total).abs() < 1e-12 * total);
    assert_eq!((of_terminals[2], lumped.bodies[1].capacity), (None, None));
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
    assert_eq!(lumped.capacities, [None, None]);
    assert_eq!(lumped.left_out.len(), 1);
    assert_eq!(
        lumped.left_out[0].message,
        "the material `SOLID` has no *DENSITY, so that its bodies have no capacity here"
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
