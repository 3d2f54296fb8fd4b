//! `inpact scene`: decks become scenes with no number typed but pressures and shear; what they cannot become is named with its line.
//!
//! Without ccx the comparisons do nothing and say so; where `INPACT_REQUIRE_CCX` is set, as in the gate, they fail instead.

use super::solve::{Solved, close, solve_in};
use crate::nodes_results::ccx;
use crate::program::{Folder, Run, root};
use std::fmt::Write;

pub(crate) const CALCULIX: [&str; 2] = ["--dialect", "calculix"];

/// Makes the scene of `job.inp`.
pub(crate) fn made(folder: &Folder, options: &[&str]) -> Run {
    let run = folder.inpact(&[&["scene", "job.inp", "-o", "s.toml"], options].concat());
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    run
}

/// Types what only the user knows, at every joint.
pub(crate) fn type_in(folder: &Folder, keys: &str) {
    let scene = folder.read("s.toml");
    folder.write("s.toml", &scene.replace("[[interface]]\n", &format!("[[interface]]\n{keys}\n")));
}

/// The share that the scene says its heat may be off by.
pub(crate) fn measure(run: &Run) -> f64 {
    let line =
        run.errors.lines().find_map(|line| line.split_once("between held nodes: off by at most ")).expect("a measure");
    line.1.split(' ').next().expect("a number").parse::<f64>().expect("a number") / 100.0
}

/// The heat that is supplied at a node.
pub(crate) fn supply(folder: &Folder, node: &str) -> f64 {
    let run = folder.inpact(&["solve", "s.toml", "--format", "json", "--dialect", "calculix"]);
    assert_eq!(run.code, 0, "{}{}", run.errors, folder.read("s.toml"));
    let document: serde_json::Value = serde_json::from_str(&run.output).expect("JSON");
    document["balance"]["temperature"]["supplies"][node].as_f64().expect("a supply")
}

/// The heat that ccx supplies at a set, as it prints it at the end.
pub(crate) fn printed(folder: &Folder, set: &str) -> String {
    let dat = folder.read("job.dat");
    let last = dat.rsplit_once(&format!("total heat generation for set {set}")).expect("the total").1;
    last.lines().nth(2).expect("a number").trim().to_owned()
}

/// Within one unit of the seventh digit, which is the last that ccx prints.
fn to_the_last_digit(found: f64, printed: &str) {
    let value: f64 = printed.parse().expect("a number");
    let (_, exponent) = printed.split_once('E').expect("an exponent");
    let unit = 10.0_f64.powi(exponent.parse::<i32>().expect("an exponent") - 6);
    assert!((found - value).abs() <= unit, "{found} for {printed}");
}

/// The samples beside CalculiX: what the hand-made scenes give, from the deck.
#[test]
fn the_samples_become_scenes() {
    for (name, typed, bottom) in [
        ("thermal-series", "pressure = 1.6e6", -40_560.0 / 307.0),
        ("thermal-curves", "pressure = 1.0e6", 172.182_799_103_193),
        ("thermal-friction", "pressure = 8.0e5\nshear = 2.8e5", -1_586_205.0 / 1_577.0),
    ] {
        let deck = std::fs::read_to_string(root().join(format!("decks/scenes/ccx/{name}.inp"))).expect("readable");
        let folder = Folder::with(&[("job.inp", &deck), ("inpact.toml", "dialect = \"calculix\"\n")]);
        let run = made(&folder, &[]);
        assert!(run.errors.contains("missing") && run.errors.contains("[D018]"), "{}", run.errors);
        assert!(!run.errors.contains("not taken over"), "{}", run.errors);
        assert!(measure(&run) < 1e-12, "{}", run.errors);
        let refused = folder.inpact(&["solve", "s.toml"]);
        assert!(refused.code == 1 && refused.errors.contains("error[D018]"), "{}", refused.errors);
        type_in(&folder, typed);
        close(supply(&folder, "NBOT"), bottom);
    }
}

/// The head says what the scene stands on, and the same command makes the same scene.
#[test]
fn the_head_says_what_the_scene_stands_on() {
    let deck = std::fs::read_to_string(root().join("decks/scenes/ccx/thermal-series.inp")).expect("readable");
    let folder = Folder::with(&[("job.inp", &deck)]);
    made(&folder, &CALCULIX);
    let scene = folder.read("s.toml");
    insta::assert_snapshot!(rounded(&scene));
    made(&folder, &CALCULIX);
    assert_eq!(folder.read("s.toml"), scene);
    let printed = folder.inpact(&["scene", "job.inp", "--dialect", "calculix"]);
    assert_eq!(printed.output, scene);
}

/// The text with six digits behind the point of every number that has one: the last digits of a solution are those of a machine.
fn rounded(text: &str) -> String {
    let word = |word: &str| match word.parse::<f64>() {
        Ok(number) if word.contains(['.', 'e']) => format!("{number:.6}"),
        _ => word.to_owned(),
    };
    text.lines().map(|line| line.split(' ').map(word).collect::<Vec<_>>().join(" ") + "\n").collect()
}

/// Two unit cubes, the upper one pushed into the lower one by a pressure, as they were run with CalculiX for the scenes `series` and `friction`.
fn cubes(pressure: f64, laws: &str, held: &str) -> String {
    let below = Block { first: 1000, name: "A", low: 0.0, high: 1.0, conductivity: 50.0, at: [0.0; 2] };
    let above = Block { first: 2000, name: "B", low: 1.0, high: 2.0, conductivity: 50.0, at: [0.0; 2] };
    let mut deck = String::new();
    for of in [&below, &above] {
        let text = block(of, "C3D8", Shape::Straight, (1, 1.0));
        deck += &(text.clone() + &all_nodes(&text, of.name));
    }
    deck += "*SURFACE INTERACTION, NAME=JOINT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E7\n";
    deck += laws;
    deck += "*CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE\nSLB, SHA\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 293.\n";
    let down = -pressure / 1e7;
    deck + &format!(
        "*STEP, INC=100\n{STEADY}*BOUNDARY\nEAN, 1, 3, 0.\nEBN, 1, 2, 0.\nEBN, 3, 3, {down:?}\n{held}\
         *NODE PRINT, NSET=EAN, TOTALS=ONLY\nRFL\n*NODE PRINT, NSET=EBN, TOTALS=ONLY\nRFL\n*END STEP\n"
    )
}

const BY_PRESSURE: &str = "*GAP CONDUCTANCE\n100., 0.\n200., 500.\n400., 1000.\n1000., 5000.\n";

/// The run of `series.toml`: three conductances in series.
#[test]
fn two_cubes_in_series() {
    let Some(folder) = ccx(&cubes(1000.0, BY_PRESSURE, "LA, 11, 11, 293.\nHB, 11, 11, 393.\n")) else { return };
    made(&folder, &CALCULIX);
    type_in(&folder, "pressure = 1000.0");
    close(supply(&folder, "HB"), 40_000.0 / 17.0);
    to_the_last_digit(supply(&folder, "HB"), &printed(&folder, "EBN"));
}

/// The faces held, as all nodes of either cube are: the heat is that of the joint.
#[test]
fn two_cubes_at_other_pressures() {
    for pressure in [250.0, 750.0, 3000.0] {
        let Some(folder) = ccx(&cubes(pressure, BY_PRESSURE, "EAN, 11, 11, 293.\nEBN, 11, 11, 393.\n")) else {
            return;
        };
        made(&folder, &CALCULIX);
        type_in(&folder, &format!("pressure = {pressure:?}"));
        to_the_last_digit(supply(&folder, "SLB"), &printed(&folder, "EBN"));
    }
}

/// The run of `friction.toml`: 1200 of heat, a quarter of it into the upper face; pressure and shear are those that ccx prints of the joint.
#[test]
fn two_cubes_that_rub() {
    let laws = "*FRICTION\n0.5, 1.E9\n*GAP CONDUCTANCE\n100., 0.\n100., 5000.\n*GAP HEAT GENERATION\n0.8, 0.25, 3.\n";
    // A move of 1.E-6 to the side is twice what slips.
    let held = "EBN, 1, 1, 1.E-6\nLA, 11, 11, 300.\nHB, 11, 11, 300.\n\
                *NODE PRINT, NSET=LA, TOTALS=ONLY\nRFL\n*NODE PRINT, NSET=HB, TOTALS=ONLY\nRFL\n*CONTACT PRINT\nCSTR\n";
    let deck = cubes(1000.0, laws, held);
    let folder = Folder::with(&[("job.inp", &deck)]);
    made(&folder, &CALCULIX);
    type_in(&folder, "pressure = 1000.0\nshear = 500.0");
    close(supply(&folder, "HB"), -540.0);
    close(supply(&folder, "LA"), -660.0);
    let Some(folder) = ccx(&deck) else { return };
    let dat = folder.read("job.dat");
    let stresses = dat.split_once("contact stress").expect("contact stresses").1.lines().skip(2);
    let stresses: Vec<[f64; 3]> = stresses
        .take_while(|line| !line.trim().is_empty())
        .map(|line| {
            let cells: Vec<f64> = line.split_whitespace().skip(2).map(|cell| cell.parse().expect("a number")).collect();
            [cells[0], cells[1], cells[2]]
        })
        .collect();
    assert!(
        !stresses.is_empty()
            && stresses.iter().all(|stress| (0..3).all(|at| (stress[at] - stresses[0][at]).abs() < 1e-9)),
        "{stresses:?}"
    );
    let [pressure, along, across] = stresses[0];
    made(&folder, &CALCULIX);
    type_in(&folder, &format!("pressure = {pressure:?}\nshear = {:?}", along.hypot(across)));
    for set in ["HB", "LA"] {
        to_the_last_digit(supply(&folder, set), &printed(&folder, set));
    }
    // Over all nodes of a cube ccx counts the heat of friction at its face as supplied, 300 of it: no more than that leaves through the joint.
    to_the_last_digit(supply(&folder, "HB") + 300.0, &printed(&folder, "EBN"));
}

/// A block of one element type between z = low and high, on nodes from `first`; its ends are level, its sides may be crooked in between.
pub(crate) struct Block {
    pub(crate) first: u32,
    pub(crate) name: &'static str,
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) conductivity: f64,
    /// Where its corner is.
    pub(crate) at: [f64; 2],
}

/// Moves of nodes between the ends of a block.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    Straight,
    Distorted,
}

/// The nodes and elements of a block of 2 by 2 by 2 cells of a size, each a brick or six tetrahedra, of the first or second order.
pub(crate) fn block(of: &Block, kind: &str, shape: Shape, (cells, side): (u32, f64)) -> String {
    let second = ["C3D20", "C3D10"].contains(&kind);
    // A grid of twice as many nodes as the cells have holds the nodes in the middle of edges and faces.
    let n = 2 * cells + 1;
    let levels = 5;
    let label = |i: u32, j: u32, k: u32| of.first + i + n * (j + n * k);
    let mut used = std::collections::BTreeSet::new();
    let mut elements = String::new();
    let mut number = of.first;
    for (i, j, k) in (0..2).flat_map(|k| (0..cells).flat_map(move |j| (0..cells).map(move |i| (2 * i, 2 * j, 2 * k)))) {
        let corner = |bits: [u32; 3]| [i + 2 * bits[0], j + 2 * bits[1], k + 2 * bits[2]];
        let cube = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]].map(corner);
        let middle = |a: [u32; 3], b: [u32; 3]| [0, 1, 2].map(|at| a[at].midpoint(b[at]));
        let rows: Vec<Vec<[u32; 3]>> = if kind.starts_with("C3D8") || kind == "C3D20" {
            let edges =
                [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)];
            let middles = edges.map(|(a, b)| middle(cube[a], cube[b]));
            vec![cube.into_iter().chain(middles.into_iter().filter(|_| second)).collect()]
        } else {
            let tetrahedra = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]];
            let edges = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)];
            tetrahedra
                .iter()
                .map(|corners| {
                    let corners = corners.map(|at| cube[at]);
                    let middles = edges.map(|(a, b)| middle(corners[a], corners[b]));
                    corners.into_iter().chain(middles.into_iter().filter(|_| second)).collect()
                })
                .collect()
        };
        for row in rows {
            let nodes: Vec<u32> = row.iter().map(|[i, j, k]| label(*i, *j, *k)).collect();
            used.extend(row);
            let texts: Vec<String> = std::iter::once(number).chain(nodes).map(|label| label.to_string()).collect();
            elements += &(texts.chunks(10).map(|line| line.join(", ")).collect::<Vec<_>>().join(",\n") + "\n");
            number += 1;
        }
    }
    let mut text = String::from("*NODE, NSET=NALL\n");
    for [i, j, k] in &used {
        let [x, y, z] = [(i, n - 1), (j, n - 1), (k, levels - 1)].map(|(at, of)| f64::from(*at) / f64::from(of));
        // Corners in the middle of the block go elsewhere; level ends and straight sides stay what they are.
        let bend = if shape == Shape::Distorted && *k == 2 { 0.12 * (1.0 + x - 2.0 * y * y) } else { 0.0 };
        let z = of.low + (of.high - of.low) * (z + bend);
        writeln!(text, "{}, {:?}, {:?}, {z:?}", label(*i, *j, *k), of.at[0] + side * x, of.at[1] + side * y)
            .expect("a text");
    }
    let set = |name: &str, level: u32| {
        let labels = used.iter().filter(|[.., k]| *k == level).map(|[i, j, k]| format!("{},\n", label(*i, *j, *k)));
        format!("*NSET, NSET={name}\n{}", labels.collect::<String>())
    };
    let name = of.name;
    text += &format!("*ELEMENT, TYPE={kind}, ELSET=E{name}\n{elements}");
    text += &(set(&format!("L{name}"), 0) + &set(&format!("H{name}"), levels - 1));
    // Surfaces are of the faces at either end, by the elements there.
    let bottom: Vec<String> = face_rows(kind, of.first, cells, 0);
    let top: Vec<String> = face_rows(kind, of.first, cells, 1);
    text += &format!("*SURFACE, NAME=SL{name}\n{}\n*SURFACE, NAME=SH{name}\n{}\n", bottom.join("\n"), top.join("\n"));
    text + &format!(
        "*MATERIAL, NAME=M{name}\n*ELASTIC\n2.E11, 0.\n*DENSITY\n2000.\n*SPECIFIC HEAT\n500.\n*CONDUCTIVITY\n{:?}\n*SOLID SECTION, ELSET=E{name}, MATERIAL=M{name}\n",
        of.conductivity
    )
}

/// The faces of a block at its lower or upper end.
fn face_rows(kind: &str, first: u32, cells: u32, layer: u32) -> Vec<String> {
    let bricks = kind.starts_with("C3D8") || kind == "C3D20";
    let of_layer = cells * cells;
    let each = if bricks { 1 } else { 6 };
    (0..of_layer)
        .flat_map(|cell| {
            let element = first + (layer * of_layer + cell) * each;
            match (bricks, layer) {
                (true, 0) => vec![format!("{element}, S1")],
                (true, _) => vec![format!("{element}, S2")],
                // Of the six tetrahedra two have a face below, by corners 1 to 3, and two one above, by corners 2 to 4.
                (false, 0) => vec![format!("{element}, S1"), format!("{}, S1", element + 1)],
                (false, _) => vec![format!("{}, S3", element + 3), format!("{}, S3", element + 4)],
            }
        })
        .collect()
}

/// Blocks on each other, pressed by rigid moves: every joint has the pressure 1.E12 times the overclosure.
fn stack(kind: &str, shape: Shape, count: usize, procedure: &str) -> String {
    let conductivities = [40.0, 90.0, 15.0];
    let names = ["A", "B", "C"];
    let mut deck = String::new();
    for (at, name) in names.iter().enumerate().take(count) {
        let low = 0.02 * f64::from(u32::try_from(at).expect("few"));
        let of = Block {
            first: 1000 * u32::try_from(at + 1).expect("few"),
            name,
            low,
            high: low + 0.02,
            conductivity: conductivities[at],
            at: [0.0; 2],
        };
        deck += &block(&of, kind, shape, (2, 0.03));
    }
    deck += "*SURFACE INTERACTION, NAME=JOINT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E12\n*GAP CONDUCTANCE\n2000., 0.\n6000., 1.E6\n";
    for at in 1..count {
        let pair = format!("SL{}, SH{}\n", names[at], names[at - 1]);
        deck += &format!("*CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE\n{pair}");
    }
    deck += "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n*STEP, INC=1000\n";
    deck += procedure;
    deck += "*BOUNDARY\n";
    for (at, name) in names.iter().enumerate().take(count) {
        let down = -0.5e-6 * f64::from(u32::try_from(at).expect("few"));
        deck += &format!("E{name}N, 1, 2, 0.\nE{name}N, 3, 3, {down:?}\n");
    }
    let top = names[count - 1];
    deck += &format!(
        "LA, 11, 11, 20.\nH{top}, 11, 11, 120.\n*NODE PRINT, NSET=LA, TOTALS=ONLY\nRFL\n*NODE PRINT, NSET=H{top}, TOTALS=ONLY\nRFL\n*END STEP\n"
    );
    // All nodes of a block, for the rigid moves.
    for name in &names[..count] {
        deck = deck.replace(
            &format!("*ELEMENT, TYPE={kind}, ELSET=E{name}\n"),
            &format!("{}*ELEMENT, TYPE={kind}, ELSET=E{name}\n", all_nodes(&deck, name)),
        );
    }
    deck
}

/// A set of the nodes of a block.
pub(crate) fn all_nodes(deck: &str, name: &str) -> String {
    let before = deck.split_once(&format!("ELSET=E{name}\n")).expect("the block").0;
    let rows = before.rsplit_once("*NODE, NSET=NALL\n").expect("its nodes").1;
    let labels = rows.lines().take_while(|line| !line.starts_with('*')).filter_map(|line| line.split(',').next());
    format!("*NSET, NSET=E{name}N\n{}", labels.map(|label| format!("{label},\n")).collect::<String>())
}

pub(crate) const STEADY: &str = "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE\n1., 1.\n";

/// Compares the heat at the top with ccx, to its last digit, for a stack of blocks; gives the folder.
fn compare(kind: &str, shape: Shape, count: usize) {
    let Some(folder) = ccx(&stack(kind, shape, count, STEADY)) else { return };
    let run = made(&folder, &CALCULIX);
    assert!(measure(&run) < 1e-9, "{}", run.errors);
    type_in(&folder, "pressure = 5.0e5");
    let top = ["HA", "HB", "HC"][count - 1];
    to_the_last_digit(supply(&folder, top), &printed(&folder, top));
}

#[test]
fn two_blocks_of_bricks() {
    compare("C3D8", Shape::Straight, 2);
}

#[test]
fn three_blocks_of_distorted_bricks() {
    compare("C3D8", Shape::Distorted, 3);
}

#[test]
fn two_blocks_of_bricks_of_the_second_order() {
    compare("C3D20", Shape::Straight, 2);
}

#[test]
fn three_blocks_of_tetrahedra() {
    compare("C3D4", Shape::Distorted, 3);
}

#[test]
fn two_blocks_of_tetrahedra_of_the_second_order() {
    compare("C3D10", Shape::Straight, 2);
}

/// A step in which every block is at one temperature: what it conducts is so much more than the joint that only the joint and the capacities count.
#[test]
fn a_transient_of_two_blocks() {
    let transient = "*COUPLED TEMPERATURE-DISPLACEMENT, DIRECT\n2., 20.\n";
    let deck = stack("C3D8", Shape::Straight, 2, transient).replace("*CONDUCTIVITY\n40.0", "*CONDUCTIVITY\n4.E8");
    let deck = deck.replace("*CONDUCTIVITY\n90.0", "*CONDUCTIVITY\n9.E8").replace("LA, 11, 11, 20.\n", "");
    let deck = deck.replace("RFL\n*END STEP", "RFL\n*NODE PRINT, NSET=LA\nNT\n*END STEP");
    let Some(folder) = ccx(&deck) else { return };
    made(&folder, &CALCULIX);
    let scene = folder.read("s.toml");
    assert!(scene.contains("procedure = \"transient\"") && scene.contains("step = 2.0"), "{scene}");
    type_in(&folder, "pressure = 5.0e5");
    let Solved { nodes, .. } = solve_in(&folder, "s.toml", &CALCULIX);
    let dat = folder.read("job.dat");
    let blocks: Vec<&str> = dat.split("temperatures for set LA").skip(1).collect();
    let course = nodes.course(&["SHA"], "temperature");
    assert_eq!((blocks.len(), course.len()), (10, 11), "{dat}");
    for (block, found) in blocks.iter().zip(&course[1..]) {
        let printed = block.lines().nth(2).and_then(|line| line.split_whitespace().last()).expect("a temperature");
        to_the_last_digit(*found, printed);
    }
}

/// What cannot be taken over is named, each with its line, and nothing takes its place.
#[test]
fn what_cannot_be_taken_over_is_named_with_its_line() {
    let deck = std::fs::read_to_string(root().join("decks/scenes/ccx/thermal-series.inp")).expect("readable");
    let deck = deck
        .replacen("*CONDUCTIVITY\n", "*CONDUCTIVITY\n45, 20.\n60, 100.\n*CONDUCTIVITY_REST\n", 1)
        .replace("*CONDUCTIVITY_REST\n45\n", "")
        .replace(
            "*SURFACE INTERACTION",
            "*ELEMENT, TYPE=S4, ELSET=SHELL\n900, 101, 102, 105, 104\n*SHELL SECTION, ELSET=SHELL, MATERIAL=MLOW\n0.001\n*ELEMENT, TYPE=SPRINGA, ELSET=SPRING\n901, 101, 201\n*SPRING, ELSET=SPRING\n\n10.\n*TIE, NAME=GLUE\nSUP, SLOW\n*SURFACE INTERACTION",
        )
        .replace("*BOUNDARY\n", "*RADIATE\nEUP, R2, 20., 0.8\n*BOUNDARY\n");
    let folder = Folder::with(&[("job.inp", &deck)]);
    let run = made(&folder, &CALCULIX);
    let scene = folder.read("s.toml");
    let line = |text: &str| deck.lines().position(|line| line == text).expect("the line") + 1;
    for (text, said) in [
        ("*CONDUCTIVITY", "CONDUCTIVITY"),
        ("*ELEMENT, TYPE=S4, ELSET=SHELL", "S4"),
        ("*SHELL SECTION, ELSET=SHELL, MATERIAL=MLOW", "*SHELL SECTION is not taken over"),
        ("*ELEMENT, TYPE=SPRINGA, ELSET=SPRING", "SPRINGA"),
        ("*SPRING, ELSET=SPRING", "*SPRING is not taken over"),
        ("*TIE, NAME=GLUE", "*TIE"),
        ("*RADIATE", "*RADIATE"),
    ] {
        let place = format!("job.inp:{}: ", line(text));
        for listed in [&run.errors, &scene] {
            let named = listed.lines().any(|line| line.contains(&place) && line.contains(said));
            assert!(named, "{place}{said}\n{listed}");
        }
    }
    // The other body has its link.
    assert_eq!(scene.matches("[[link]]").count(), 1, "{scene}");
    assert!(scene.contains("nodes = [\"SUP\", \"NTOP\"]"), "{scene}");
    // At a temperature the conductivity is a number.
    made(&folder, &["--dialect", "calculix", "--temperature", "60"]);
    assert_eq!(folder.read("s.toml").matches("[[link]]").count(), 2, "{}", folder.read("s.toml"));
}

/// A fault of one body, and a part that touches a joint, leave out the links of that body; the others have theirs.
#[test]
fn a_fault_leaves_out_the_links_of_its_body_alone() {
    let whole = stack("C3D8", Shape::Straight, 3, STEADY);
    let conducts = |scene: &str, a: &str, b: &str| scene.contains(&format!("nodes = [\"{a}\", \"{b}\"]\n"));
    let varies = whole.replace("*CONDUCTIVITY\n90.0", "*CONDUCTIVITY\n90.0, 0.\n80.0, 100.");
    // A part of an edge of the middle block that is held, of which one node is of a joint.
    let edge: String = whole
        .split_once("*NSET, NSET=EBN\n")
        .and_then(|(_, rest)| rest.split_once('*'))
        .map(|(rows, _)| rows.lines().take(2).map(|row| format!("{row}\n")).collect())
        .expect("the nodes of the middle block");
    let touches = whole
        .replace("*SURFACE INTERACTION", &format!("*NSET, NSET=EDGE\n{edge}*SURFACE INTERACTION"))
        .replace("*BOUNDARY\n", "*BOUNDARY\nEDGE, 11, 11, 50.\n");
    let undefined = whole.replace("MATERIAL=MB\n", "MATERIAL=NONE\n");
    for (deck, said) in [
        (
            varies,
            "*CONDUCTIVITY of `MB` depends on temperature, from 0.0 to 100.0: a body is lumped at one temperature, which must be given: the thermal links of its body are left out",
        ),
        (touches, "`EDGE` of *BOUNDARY shares some of its nodes with"),
        (undefined, "the material `NONE` is not defined: the thermal links of its body are left out"),
    ] {
        let folder = Folder::with(&[("job.inp", &deck)]);
        let run = made(&folder, &CALCULIX);
        let scene = folder.read("s.toml");
        assert!(
            run.errors.lines().any(|line| line.contains("job.inp:") && line.contains(said)),
            "{said}\n{}",
            run.errors
        );
        for (a, b) in [("LA", "SHA"), ("SLC", "HC")] {
            assert!(conducts(&scene, a, b) || conducts(&scene, b, a), "{a} and {b}: {scene}");
        }
        let is_whole = said.starts_with("`EDGE`");
        assert_eq!(conducts(&scene, "SLB", "SHB") || conducts(&scene, "SHB", "SLB"), is_whole, "{scene}");
    }
}

/// Two bars and a joint between them, a current of 18 A from the upper end to the ground; `joule` are the options of the materials on the heat of the current.
fn electrical(joule: [&str; 2]) -> Folder {
    let below = Block { first: 1000, name: "A", low: 0.0, high: 0.02, conductivity: 40.0, at: [0.0; 2] };
    let above = Block { first: 2000, name: "B", low: 0.02, high: 0.05, conductivity: 90.0, at: [0.0; 2] };
    let block = |of: &Block, electrical: f64, joule: &str| {
        let text = block(of, "C3D8", Shape::Distorted, (2, 0.03)).replace("TYPE=C3D8", "TYPE=DC3D8E");
        text.replace("*CONDUCTIVITY", &format!("{joule}*ELECTRICAL CONDUCTIVITY\n{electrical:?}\n*CONDUCTIVITY"))
    };
    let deck = format!(
        "{}{}*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n2.E6, 0.\n1.E5, 0.001\n*GAP CONDUCTANCE\n3000., 0.\n100., 0.001\n\
         *CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE\nSLB, SHA\n*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n1., 1.\n\
         *BOUNDARY\nLA, 9, 9, 0.\nLA, 11, 11, 20.\nHB, 11, 11, 20.\n*CECURRENT\nHB, 9, 2.\n*END STEP\n",
        block(&below, 5e6, joule[0]),
        block(&above, 1e6, joule[1])
    );
    Folder::with(&[("job.inp", &deck)])
}

/// Solves the scene of [`electrical`], whose bars turn these shares of what they dissipate into heat.
fn solves_as(folder: &Folder, shares: [f64; 2]) {
    let Solved { nodes, .. } = solve_in(folder, "s.toml", &[]);
    let area = 9e-4;
    // Nine nodes at the top, 2 A each.
    let current = 9.0 * 2.0;
    let [lower, joint, upper] =
        [5e6 * area / 0.02, 2e6 * area, 1e6 * area / 0.03].map(|conductance| current / conductance);
    let potential = |node: &str| nodes.number(&[node], "potential");
    let about = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-9, "{found} for {expected}");
    about(potential("SHA"), lower);
    about(potential("SLB"), lower + joint);
    about(potential("HB"), lower + joint + upper);
    // Half of what the joint dissipates warms either face, as does half of the heat of the bar at it; through 1.8, 2.7 and 2.7 W/K it leaves at both ends.
    let [at_lower, at_upper] =
        [(shares[0], lower), (shares[1], upper)].map(|(share, jump)| 0.5 * current * (joint + share * jump));
    let [below, between, above] = [40.0 * area / 0.02, 3000.0 * area, 90.0 * area / 0.03];
    let determinant = (below + between) * (above + between) - between * between;
    let warmer = |node: &str| nodes.number(&[node], "temperature") - 20.0;
    about(warmer("SHA"), (at_lower * (above + between) + at_upper * between) / determinant);
    about(warmer("SLB"), (at_upper * (below + between) + at_lower * between) / determinant);
    let checked = folder.inpact(&["check", "s.toml"]);
    assert_eq!((checked.code, checked.output.as_str()), (0, ""), "{}", checked.errors);
}

/// A deck of electrical conduction becomes a scene with nothing typed.
#[test]
fn an_electrical_scene_from_a_deck() {
    let folder = electrical(["*JOULE HEAT FRACTION\n0.\n"; 2]);
    let run = made(&folder, &[]);
    assert!(!run.errors.contains("missing") && !run.errors.contains("heat of its current"), "{}", run.errors);
    assert!(!folder.read("s.toml").contains("joule_heat_fraction"), "{}", folder.read("s.toml"));
    solves_as(&folder, [0.0; 2]);
}

/// *JOULE HEAT FRACTION of each bar: in an even current half of its heat leaves at either end, exactly.
#[test]
fn the_current_heats_the_bodies() {
    let folder = electrical(["*JOULE HEAT FRACTION\n0.5\n", "*JOULE HEAT FRACTION\n1.\n"]);
    let run = made(&folder, &[]);
    assert!(!run.errors.contains("missing") && !run.errors.contains("not taken over"), "{}", run.errors);
    assert!(run.errors.contains("the body of `SHA`, `LA`: half of the heat of its current"), "{}", run.errors);
    assert!(run.errors.contains(", beside where in bodies the current makes its heat"), "{}", run.errors);
    solves_as(&folder, [0.5, 1.0]);
}

/// What a deck does not say of the heat of the current, or a link cannot have, is said and not made up.
#[test]
fn heat_of_the_current_that_is_not_taken_over() {
    let folder = electrical(["", "*JOULE HEAT FRACTION\n1000.\n"]);
    let run = made(&folder, &[]);
    assert!(
        run.errors.contains("the current makes no heat in the body of `SHA`, `LA`: `MA` has no *JOULE HEAT FRACTION"),
        "{}",
        run.errors
    );
    let line = 1 + folder.read("job.inp").lines().position(|line| line == "*JOULE HEAT FRACTION").expect("there");
    let why = format!("job.inp:{line}: expected *JOULE HEAT FRACTION of `MB` from 0 to 1, found 1000.0");
    assert!(run.errors.contains(&why), "{}", run.errors);
    solves_as(&folder, [0.0; 2]);
}

/// A deck of several steps has to be told which, and none is written over the deck.
#[test]
fn wrong_usage() {
    let deck = std::fs::read_to_string(root().join("decks/scenes/ccx/thermal-series.inp")).expect("readable");
    let step = deck.split_once("*STEP").expect("a step").1.to_owned();
    let folder = Folder::with(&[("job.inp", &format!("{deck}*STEP{step}")), ("none.inp", "*NODE\n1, 0.\n")]);
    let run = folder.inpact(&["scene", "job.inp", "--dialect", "calculix"]);
    assert!(run.code == 2 && run.errors.contains("the deck has 2 steps: name the one"), "{}", run.errors);
    let run = folder.inpact(&["scene", "job.inp", "--step", "3", "--dialect", "calculix"]);
    assert!(run.code == 2 && run.errors.contains("`--step 3`: the deck has 2 steps"), "{}", run.errors);
    assert_eq!(folder.inpact(&["scene", "job.inp", "--step", "2", "--dialect", "calculix"]).code, 0);
    assert_eq!(folder.inpact(&["scene", "job.inp", "--step", "1", "-o", "job.inp"]).code, 2);
    let run = folder.inpact(&["scene", "none.inp"]);
    assert!(run.code == 1 && run.errors.contains("has no contact pair"), "{}", run.errors);
}

/// The three-element deck of a public training course: no number of its scene is typed.
#[test]
fn lesson_004() {
    let beside = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/corpus");
    let corpus = std::env::var_os("INPACT_CORPUS").map_or(beside, std::path::PathBuf::from);
    let path = corpus.join("Batmanabcdefg+AbaqusTraining/004_Lesson/abaqus_input_files/Lesson004.inp");
    let Ok(deck) = std::fs::read_to_string(&path) else {
        let _ = std::io::Write::write_all(&mut std::io::stderr(), b"SKIPPED, the corpus is not there\n");
        return;
    };
    let folder = Folder::with(&[("job.inp", &deck)]);
    let run = made(&folder, &[]);
    assert!(!run.errors.contains("missing"), "{}", run.errors);
    let Solved { nodes, .. } = solve_in(&folder, "s.toml", &[]);
    // A flux of 10 on a face of 1 by 0.5: 5 through two blocks of 1 by 0.5 by 0.5 and a joint of 1E6 per area, from 500.
    let face = nodes.number(&["BOT_BLOCK_TopSurf"], "temperature");
    close(face, 500.0 + 5.0);
    let upper = nodes.number(&["TOP_BLOCK_BotSurf"], "temperature");
    close(upper, face + 10.0 / 1e6);
    close(nodes.number(&["TOP_BLOCK_TopSurf"], "temperature"), upper + 5.0);
}
