//! `inpact compare`: both values of every node, where they differ most, and the tolerance.
//!
//! A `.fil` with outputs of contact is written by the record descriptions of the manual, with values computed here.

use crate::nodes_results::{PRESSED, ccx};
use crate::program::{Folder, Run};
use inpact_results::vtu::{Values, read_grid};

#[path = "../../crates/inpact-results/tests/common/mod.rs"]
mod files;

use files::{Fil, W};

/// A block above a block, 0.25 apart; conductances fall to 0 at a clearance of 1, and the current heats nothing.
const DECK: &str = "\
*NODE
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.
11, 0., 0., 1.25\n12, 1., 0., 1.25\n13, 1., 1., 1.25\n14, 0., 1., 1.25\n15, 0., 0., 2.25\n16, 1., 0., 2.25\n17, 1., 1., 2.25\n18, 0., 1., 2.25
*ELEMENT, TYPE=Q3D8, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=Q3D8, ELSET=UPPER
2, 11, 12, 13, 14, 15, 16, 17, 18
*SURFACE, NAME=M
LOWER, S2
*SURFACE, NAME=S
UPPER, S1
*SURFACE INTERACTION, NAME=I
*GAP CONDUCTANCE
8., 0.
0., 1.
*GAP ELECTRICAL CONDUCTANCE
4., 0.
0., 1.
*GAP HEAT GENERATION
0., 0.5
*CONTACT PAIR, INTERACTION=I
S, M
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL
0.5, 1.
*END STEP
";

/// What a solver would write of it: two increments, the slave at 100 and 2, the master at 20 and 0; of node 13 the heat flux is `odd` times what it should be.
fn job(odd: f64) -> Vec<u8> {
    let mut fil = Fil::default();
    fil.record(1902, &[W::I(1), W::I(2), W::I(3), W::I(0), W::I(0), W::I(0)]);
    fil.end();
    for (increment, time) in [(1_i32, 0.5), (2, 1.0)] {
        fil.begin(1, i64::from(increment), time, time);
        fil.record(1911, &[W::I(1), W::A(""), W::A("")]);
        for node in (1..=8).chain(11..=18) {
            let upper = 10 < node;
            fil.record(
                101,
                &[W::I(node), W::D(0.0), W::D(0.0), W::D(if upper { -0.125 * f64::from(increment) } else { 0.0 })],
            );
            fil.record(201, &[W::I(node), W::D(if upper { 100.0 } else { 20.0 })]);
            fil.record(105, &[W::I(node), W::D(if upper { 2.0 } else { 0.0 })]);
        }
        // Apart by 0.125, then touching.
        let gap = 0.25 - 0.125 * f64::from(increment);
        let (heat, current) = (8.0 * (1.0 - gap) * 80.0, 4.0 * (1.0 - gap) * 2.0);
        // The integral of the current over both increments.
        let charge = if increment == 1 { 0.5 * 3.5 * 2.0 } else { 0.5 * 3.5 * 2.0 + 0.5 * 4.0 * 2.0 };
        fil.record(1503, &[W::I(0), W::A("S"), W::A("M"), W::A("")]);
        for node in 11..=14 {
            fil.record(1504, &[W::I(node), W::I(3)]);
            fil.record(1521, &[W::D(gap), W::D(0.0), W::D(0.0)]);
            fil.record(1528, &[W::D(heat * if node == 13 { odd } else { 1.0 })]);
            fil.record(1541, &[W::D(current)]);
            fil.record(1542, &[W::D(current / 4.0)]);
            fil.record(1543, &[W::D(charge)]);
            // Nothing of the deck has pore fluid.
            fil.record(1545, &[W::D(1.0)]);
        }
        fil.end();
    }
    fil.bytes()
}

fn folder(odd: f64) -> Folder {
    let folder = Folder::with(&[("job.inp", DECK)]);
    std::fs::write(folder.path().join("job.fil"), job(odd)).expect("writable");
    folder
}

fn compare(folder: &Folder, more: &[&str]) -> Run {
    folder.inpact(&[&["compare", "job.inp", "--results", "job.fil"], more].concat())
}

#[test]
fn a_deck_that_means_the_same_to_both_agrees_in_every_output() {
    let folder = folder(1.0);
    let run = compare(&folder, &["--tolerance", "1e-14", "--format", "json"]);
    assert_eq!(run.code, 0, "{}", run.shown());
    let found: serde_json::Value = serde_json::from_str(&run.output).expect("JSON");
    let quantities = found["quantities"].as_array().expect("a list");
    let names: Vec<&str> = quantities.iter().filter_map(|quantity| quantity["name"].as_str()).collect();
    assert_eq!(names, ["clearance", "ECD", "ECDA", "ECDT", "HFL", "PFL"]);
    for quantity in &quantities[..5] {
        assert_eq!((quantity["rows"].as_u64(), quantity["not_computed"].as_u64()), (Some(8), Some(0)), "{quantity}");
        assert!(quantity["largest"]["relative_to_largest"].as_f64().expect("a number") <= 1e-14, "{quantity}");
    }
    assert_eq!((quantities[5]["rows"].as_u64(), quantities[5]["not_computed"].as_u64()), (Some(0), Some(8)));
    // Integrals that begin at the first state are others.
    let run = compare(&folder, &["--history-start", "first-row", "--tolerance", "1e-3"]);
    assert_eq!(run.code, 1, "{}", run.shown());
    assert!(run.output.contains("ECDT"), "{}", run.output);
}

#[test]
fn the_node_that_differs_is_named_and_beyond_the_tolerance() {
    let folder = folder(1.01);
    let run = compare(&folder, &["--tolerance", "1e-3"]);
    assert_eq!(run.code, 1, "{}", run.shown());
    insta::assert_snapshot!(run.output);
    assert_eq!(compare(&folder, &["--tolerance", "0.02"]).code, 0);
    assert_eq!(compare(&folder, &[]).code, 0, "without a tolerance nothing is beyond it");
    let run = compare(&folder, &["-o", "both.csv"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let table = folder.read("both.csv");
    assert_eq!(table.lines().count(), 1 + 6 * 8);
    let row = table.lines().find(|line| line.starts_with("13,1,HFL,640,")).expect("node 13 at the end");
    let cells: Vec<f64> = row.split(',').skip(3).map(|cell| cell.parse().expect("a number")).collect();
    assert!((cells[1] - 646.4).abs() < 1e-9 && (cells[2] + 6.4).abs() < 1e-9 && (cells[3] - 6.4 / 646.4).abs() < 1e-12);
    assert!(table.contains("\n11,0.5,PFL,,1,,\n"), "{table}");
}

#[test]
fn both_values_and_their_difference_are_drawn() {
    let folder = folder(1.01);
    let run = compare(&folder, &["-o", "both.vtu"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let (grid, problem) = read_grid(&std::fs::read(folder.path().join("both-2.vtu")).expect("drawn"));
    assert_eq!(problem, None);
    let values = |name: &str| {
        let array = grid.point_data.iter().find(|array| array.name == name).unwrap_or_else(|| panic!("no `{name}`"));
        let Values::Reals(values) = &array.values else { panic!("`{name}`") };
        values.clone()
    };
    assert_eq!(values("HFL"), [640.0; 4]);
    assert_eq!(values("HFL_solver")[..2], [640.0; 2]);
    let difference = values("HFL_difference");
    assert!((difference[2] + 6.4).abs() < 1e-9 && difference[3] == 0.0, "{difference:?}");
    assert!(folder.names().contains(&"both.pvd".to_owned()));
}

#[test]
fn clearances_beside_those_of_calculix() {
    let Some(folder) = ccx(PRESSED) else { return };
    for (file, tolerance) in [("job.frd", "2e-3"), ("job.dat", "2e-3")] {
        let arguments = ["compare", "job.inp", "--dialect", "calculix", "--results", file, "--tolerance"];
        let run = folder.inpact(&[&arguments[..], &[tolerance]].concat());
        assert_eq!(run.code, 0, "{}", run.shown());
        assert!(run.output.contains("\nclearance  L        3 "), "three nodes touch: {}", run.output);
        assert_eq!(folder.inpact(&[&arguments[..], &["1e-12"]].concat()).code, 1);
    }
}

/// Two cubes pressed together, hot above and cold below: 66.667 go through each, through a conductance of 5 between 66.667 and 53.333.
///
/// They swell sideways, where nothing holds them.
fn heated() -> String {
    let layer = |first: u32, z: f64| {
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].into_iter().zip(first..);
        corners.map(|((x, y), node)| format!("{node}, {x}., {y}., {z:?}\n")).collect::<String>()
    };
    let nodes = [(1, 0.0), (5, 1.0), (11, 1.0), (15, 2.0)].map(|(first, z)| layer(first, z)).concat();
    format!(
        "\
*NODE, NSET=NALL
{nodes}*ELEMENT, TYPE=C3D8, ELSET=EALL
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=NLOW
1, 2, 3, 4
*NSET, NSET=NUP
15, 16, 17, 18
*MATERIAL, NAME=M
*ELASTIC
1000., 0.3
*CONDUCTIVITY
2.
*EXPANSION
1.E-5
*SOLID SECTION, ELSET=EALL, MATERIAL=M
*SURFACE, NAME=UPPER
2, S1
*SURFACE, NAME=LOWER
1, S2
*SURFACE INTERACTION, NAME=I
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
10000.
*GAP CONDUCTANCE
5., 0.
5., 1000.
*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE
UPPER, LOWER
*INITIAL CONDITIONS, TYPE=TEMPERATURE
NALL, 20.
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE
1., 1.
*BOUNDARY
NLOW, 1, 3
NUP, 1, 2
NUP, 3, 3, -0.01
NLOW, 11, 11, 20.
NUP, 11, 11, 100.
*CONTACT PRINT, SLAVE=UPPER, MASTER=LOWER
CF
*SECTION PRINT, SURFACE=UPPER, NAME=ABOVE
FLUX
*SECTION PRINT, SURFACE=LOWER, NAME=BELOW
FLUX
*NODE FILE
U, NT
*EL FILE
HFL
*CONTACT FILE
CDIS, CSTR
*END STEP
"
    )
}

/// Everything that a `.frd` and a `.dat` of ccx say of an interface: clearances and heat at the nodes, area and heat of the pair.
#[test]
fn heat_and_areas_beside_those_of_calculix() {
    let deck = heated();
    let Some(folder) = ccx(&deck) else { return };
    let compare = |more: &[&str]| {
        let arguments = ["compare", "job.inp", "--dialect", "calculix", "--results", "job.frd", "--results", "job.dat"];
        folder.inpact(&[&arguments[..], more].concat())
    };
    // ccx 2.20 writes the flux at nodes as of the iteration before the last: 66.664.
    let run = compare(&["--tolerance", "1e-4", "--format", "json"]);
    assert_eq!(run.code, 0, "{}", run.shown());
    let found: serde_json::Value = serde_json::from_str(&run.output).expect("JSON");
    let quantities: Vec<(&str, &str, u64, f64, f64)> = found["quantities"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|quantity| {
            let text = |name: &str| quantity[name].as_str().expect("a text");
            let value = |name: &str| quantity["largest"][name].as_f64().expect("a number");
            (text("name"), text("unit"), quantity["rows"].as_u64().expect("a count"), value("ours"), value("solver"))
        })
        .collect();
    let expected = [
        ("clearance", "L", 4, -5.75e-4),
        ("total_heat_s", "M T⁻³", 4, -200.0 / 3.0),
        ("area in contact", "L²", 1, 1.0),
        ("heat into slave", "M L² T⁻³", 1, -200.0 / 3.0),
        ("heat into master", "M L² T⁻³", 1, 200.0 / 3.0),
    ];
    assert_eq!(quantities.len(), expected.len(), "{quantities:?}");
    for ((name, unit, rows, ours, solvers), (expected, of, count, value)) in quantities.into_iter().zip(expected) {
        assert_eq!((name, unit, rows), (expected, of, count));
        if name != "clearance" {
            let digits = if name == "total_heat_s" { 1e-4 } else { 1e-5 };
            let close = |found: f64| (found - value).abs() <= digits * value.abs();
            assert!(close(ours) && close(solvers), "{name}: {ours} and {solvers}, expected {value}");
        }
    }
    let run = compare(&[]);
    assert_eq!(run.code, 0, "{}", run.shown());
    for line in [
        "  total_heat_s: HFL of job.frd against the normal of the slave, as taken to its nodes",
        "  area in contact: CAREA of job.dat",
        "  heat into slave: SURFACE_FLUX of job.dat",
    ] {
        assert!(run.output.lines().any(|found| found == line), "{line}: {}", run.output);
    }
    assert!(run.output.contains("pair UPPER on LOWER, time 1"), "{}", run.output);
    // Pictures have points for nodes only, tables have rows for pairs too.
    assert_eq!(compare(&["-o", "both.csv"]).code, 0);
    let table = folder.read("both.csv");
    assert_eq!(table.lines().filter(|line| line.starts_with("UPPER on LOWER,1,")).count(), 3, "{table}");
    assert_eq!(compare(&["-o", "both.vtu"]).code, 0);
    let (grid, _) = read_grid(&std::fs::read(folder.path().join("both.vtu")).expect("drawn"));
    assert!(grid.point_data.iter().any(|array| array.name == "total_heat_s_solver"));
    // A deck that means another conductance gives another heat at the temperatures of the job.
    folder.write("job.inp", &deck.replace("5., 0.\n5., 1000.", "6., 0.\n6., 1000."));
    let run = compare(&["--tolerance", "0.1"]);
    assert_eq!(run.code, 1, "{}", run.shown());
    let beyond: Vec<&str> = run
        .output
        .lines()
        .filter(|line| line.ends_with("beyond the tolerance"))
        .filter_map(|line| line.split("  ").next())
        .collect();
    assert_eq!(beyond, ["total_heat_s", "heat into slave", "heat into master"], "{}", run.output);
}

#[test]
fn what_cannot_be_compared_ends_with_1_or_2() {
    let folder = folder(1.0);
    assert_eq!(folder.inpact(&["compare", "job.inp"]).code, 2);
    assert_eq!(compare(&folder, &["--tolerance", "-1"]).code, 2);
    let run = compare(&folder, &["-o", "job.fil"]);
    assert_eq!((run.code, std::fs::read(folder.path().join("job.fil")).expect("readable") == job(1.0)), (2, true));
    // Temperatures alone are nothing that is computed here.
    folder.write("t.rpt", "               X        NT11_n11\n\n   1.0000000E+00   1.0000000E+00\n\n");
    let run = folder.inpact(&["compare", "job.inp", "--results", "t.rpt"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
    assert!(run.errors.contains("the results say nothing that is computed here"), "{}", run.errors);
}
