//! Bodies beside CalculiX: a heat transfer step with held terminals, whose heat flows are the conductances, to every digit that it prints.
//!
//! Without ccx the comparison does nothing and says so; where `INPACT_REQUIRE_CCX` is set, as in the gate, it fails instead.

mod common;

use common::{Block, Edges, read_as, set};
use inpact_body::BodyField;
use inpact_geometry::{ElementShape, Point};
use inpact_parser::grammar::Dialect;
use std::collections::BTreeMap;
use std::io::Write;
use std::process::Command;

/// The heat that flows in at the nodes of each set, as it is printed; `None` without ccx.
fn heat_flows(deck: &str) -> Option<BTreeMap<String, String>> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("body.inp"), deck).expect("written");
    let output = match Command::new("ccx").arg("body").current_dir(folder.path()).output() {
        Ok(output) => output,
        Err(error) => {
            assert!(std::env::var_os("INPACT_REQUIRE_CCX").is_none(), "ccx: {error}");
            let _ = writeln!(std::io::stderr(), "SKIPPED, nothing was compared with CalculiX: ccx: {error}");
            return None;
        }
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    let dat = std::fs::read_to_string(folder.path().join("body.dat")).expect("printed");
    let mut flows = BTreeMap::new();
    let mut lines = dat.lines().map(str::trim).filter(|line| !line.is_empty());
    while let Some(line) = lines.next() {
        if let Some((_, rest)) = line.split_once("for set ") {
            let set = rest.split_whitespace().next().expect("a set").to_owned();
            flows.insert(set, lines.next().expect("a total").to_owned());
        }
    }
    Some(flows)
}

/// Within half a unit of the seventh digit, which is the last that is printed, and of rounding in the sum that it is.
fn assert_printed(found: f64, printed: &str, largest: f64, what: &str) {
    let value: f64 = printed.parse().expect("a number");
    let (_, exponent) = printed.split_once('E').expect("an exponent");
    let unit = 10.0_f64.powi(exponent.parse::<i32>().expect("an exponent") - 6);
    assert!((found - value).abs() <= 0.5 * unit + 1e-13 * largest, "{what}: {found} for {printed}");
}

/// An L of curved and distorted elements with three terminals, of which two are parts of one face.
fn map([x, y, z]: Point) -> Point {
    let bent = 0.6 * x;
    let radius = 2.0 + z + 0.15 * (3.0 * x + 2.0 * y).sin();
    [radius * bent.sin(), 1.3 * y + 0.2 * x * z + 0.05 * (9.0 * z).sin() * y, radius * bent.cos() + 0.3 * y * y]
}

fn terminals(mesh: &common::Meshed) -> [(&'static str, Vec<usize>); 3] {
    [
        ("LOW", mesh.nodes_where(|place| place[0] == 0.0 && place[1] <= 0.5)),
        ("HIGH", mesh.nodes_where(|place| place[0] == 1.0)),
        ("TOP", mesh.nodes_where(|place| place[2] == 1.0 && 0.25 <= place[0] && place[0] <= 0.75)),
    ]
}

fn compare(type_name: &'static str, shape: ElementShape, material: &str) {
    // Second-order elements are curved, as their map has them.
    let mesh = Block { type_name, shape, cells: [4, 2, 2], edges: Edges::Curved, map: Box::new(map) }.mesh();
    let terminals = terminals(&mesh);
    let sets: String = terminals.iter().map(|(name, nodes)| set(name, nodes)).collect();
    let deck = mesh.deck(material) + &sets;
    compare_deck(&deck, &mesh, type_name);
}

/// The same of a deck of that mesh.
fn compare_deck(deck: &str, mesh: &common::Meshed, type_name: &str) {
    let names: Vec<&str> = terminals(mesh).iter().map(|(name, _)| *name).collect();
    let lumped =
        read_as(Dialect::Calculix, deck, &names).expect("a body").lumped(BodyField::Thermal, None).expect("lumped");
    for (hot, name) in names.iter().enumerate() {
        let held: String =
            names.iter().enumerate().map(|(at, name)| format!("{name}, 11, 11, {}.\n", u8::from(at == hot))).collect();
        let printed: String =
            names.iter().map(|name| format!("*NODE PRINT, NSET={name}, TOTALS=ONLY\nRFL\n")).collect();
        let all = set("EVERY", &mesh.nodes.keys().copied().collect::<Vec<_>>());
        let job = format!(
            "{deck}{all}*INITIAL CONDITIONS, TYPE=TEMPERATURE\nEVERY, 0.\n*STEP\n*HEAT TRANSFER, STEADY STATE\n1., 1.\n*BOUNDARY\n{held}{printed}*END STEP\n"
        );
        let Some(flows) = heat_flows(&job) else { return };
        assert_eq!(flows.len(), 3, "{flows:?}");
        let largest = lumped.isothermal.to_all(hot);
        for (at, other) in names.iter().enumerate() {
            let found = if at == hot { largest } else { -lumped.isothermal.between(hot, at) };
            assert_printed(found, &flows[*other], largest, &format!("{type_name}: {name} hot, at {other}"));
        }
    }
}

const ISOTROPIC: &str = "*CONDUCTIVITY\n37.\n";

#[test]
fn bricks_of_eight_nodes_to_every_digit() {
    compare("C3D8", ElementShape::Hexahedron8, ISOTROPIC);
}

#[test]
fn bricks_of_twenty_nodes_to_every_digit() {
    compare("C3D20", ElementShape::Hexahedron20, ISOTROPIC);
    compare("C3D20R", ElementShape::Hexahedron20, ISOTROPIC);
}

#[test]
fn tetrahedra_to_every_digit() {
    compare("C3D4", ElementShape::Tetrahedron4, ISOTROPIC);
    compare("C3D10", ElementShape::Tetrahedron10, ISOTROPIC);
}

#[test]
fn wedges_to_every_digit() {
    compare("C3D6", ElementShape::Wedge6, ISOTROPIC);
    compare("C3D15", ElementShape::Wedge15, ISOTROPIC);
}

#[test]
fn conductivities_with_directions_to_every_digit() {
    compare("C3D8", ElementShape::Hexahedron8, "*CONDUCTIVITY, TYPE=ORTHO\n12., 37., 5.\n");
    // In the order that CalculiX has: 11, 22, 33, 12, 13, 23.
    compare("C3D20", ElementShape::Hexahedron20, "*CONDUCTIVITY, TYPE=ANISO\n12., 37., 5., 2., -1., 0.5\n");
}

/// *ORIENTATION by points, and turned about each of its axes.
#[test]
fn axes_of_a_section_to_every_digit() {
    let mesh = Block {
        type_name: "C3D8",
        shape: ElementShape::Hexahedron8,
        cells: [3, 2, 2],
        edges: Edges::Curved,
        map: Box::new(map),
    }
    .mesh();
    let sets: String = terminals(&mesh).iter().map(|(name, nodes)| set(name, nodes)).collect();
    for turn in ["", "1, 20.\n", "2, -35.\n", "3, 50.\n"] {
        for material in
            ["*CONDUCTIVITY, TYPE=ORTHO\n12., 37., 5.\n", "*CONDUCTIVITY, TYPE=ANISO\n12., 37., 5., 2., -1., 0.5\n"]
        {
            let orientation = format!("*ORIENTATION, NAME=AXES\n1., 2., 0.5, -1., 1., 0.3\n{turn}");
            let deck = mesh.deck(material).replace(
                "*SOLID SECTION, ELSET=ALL, MATERIAL=SOLID\n",
                &format!("{orientation}*SOLID SECTION, ELSET=ALL, MATERIAL=SOLID, ORIENTATION=AXES\n"),
            ) + &sets;
            compare_deck(&deck, &mesh, &format!("turned by `{}`", turn.trim()));
        }
    }
}

/// The reduced brick of eight nodes has one point in CalculiX, whose patterns of temperature nothing opposes: a uniform flow is the same, and in distorted elements its
/// temperatures leave those that are held, which no body does.
#[test]
fn the_reduced_brick_of_eight_nodes_has_eight_points_here() {
    let block = |map: fn(Point) -> Point| {
        Block {
            type_name: "C3D8R",
            shape: ElementShape::Hexahedron8,
            cells: [4, 2, 2],
            edges: Edges::Straight,
            map: Box::new(map),
        }
        .mesh()
    };
    let job = |mesh: &common::Meshed, sets: &[(&str, Vec<usize>)]| {
        let deck = mesh.deck(ISOTROPIC) + &sets.iter().map(|(name, nodes)| set(name, nodes)).collect::<String>();
        let all = set("EVERY", &mesh.nodes.keys().copied().collect::<Vec<_>>());
        let held: String = sets
            .iter()
            .enumerate()
            .map(|(at, (name, _))| format!("{name}, 11, 11, {}.\n", u8::from(at == 0)))
            .collect();
        let printed: String =
            sets.iter().map(|(name, _)| format!("*NODE PRINT, NSET={name}, TOTALS=ONLY\nRFL\n")).collect();
        let step = format!(
            "{all}*INITIAL CONDITIONS, TYPE=TEMPERATURE\nEVERY, 0.\n*STEP\n*HEAT TRANSFER, STEADY STATE\n1., 1.\n*BOUNDARY\n{held}{printed}*END STEP\n"
        );
        (deck.clone(), deck + &step)
    };
    let straight = block(|[x, y, z]| [3.0 * x, 1.3 * y, z]);
    let ends = [
        ("LOW", straight.nodes_where(|place| place[0] == 0.0)),
        ("HIGH", straight.nodes_where(|place| place[0] == 1.0)),
    ];
    let between = |deck: &str, names: &[&str]| {
        let body = read_as(Dialect::Calculix, deck, names).expect("a body");
        let said = body.left_out().iter().any(|note| note.message.contains("integrated over 8 points here, over one"));
        assert!(said, "{:?}", body.left_out());
        body.lumped(BodyField::Thermal, None).expect("lumped").isothermal
    };
    // Temperatures are linear, and one point integrates them exactly.
    let (deck, whole) = job(&straight, &ends);
    let Some(flows) = heat_flows(&whole) else { return };
    let found = between(&deck, &["LOW", "HIGH"]).between(0, 1);
    assert_printed(found, &flows["LOW"], found, "uniform");
    let curved = block(map);
    let sets = terminals(&curved);
    let (deck, whole) = job(&curved, &sets);
    let flows = heat_flows(&whole).expect("ccx ran before");
    let found = between(&deck, &["LOW", "HIGH", "TOP"]).to_all(0);
    let of_ccx: f64 = flows["LOW"].parse().expect("a number");
    assert!(of_ccx < 0.9 * found && 0.7 * found < of_ccx, "{of_ccx} and {found}");
}
