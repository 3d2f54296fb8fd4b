//! `inpact eval` on inputs that once gave a wrong value: what they must give.

use crate::program::{Folder, Run};

/// Evaluates a node table with more arguments.
fn eval(deck: &str, nodes: &str, arguments: &[&str]) -> Run {
    let folder = Folder::with(&[("deck.inp", deck), ("nodes.csv", nodes)]);
    folder.inpact(&[&["eval", "deck.inp", "--nodes", "nodes.csv"], arguments].concat())
}

/// The cells of a column.
fn column(run: &Run, name: &str) -> Vec<String> {
    assert_eq!(run.code, 0, "{}", run.errors);
    let mut lines = run.output.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    let place = header.iter().position(|column| *column == name).unwrap_or_else(|| panic!("{name}: {header:?}"));
    lines.map(|cells| cells[place].to_owned()).collect()
}

/// Its numbers; NaN where there is none.
fn numbers(run: &Run, name: &str) -> Vec<f64> {
    column(run, name).iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()
}

/// Every number is the right one, to so many parts of itself.
fn assert_near(found: &[f64], right: &[f64], part: f64) {
    assert_eq!(found.len(), right.len(), "{found:?}");
    for (found, right) in found.iter().zip(right) {
        assert!((found - right).abs() <= part * right.abs(), "{found:?} for {right:?}");
    }
}

const BOTH_BRANCHES: &str = "*SURFACE INTERACTION, NAME=Weld\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n\
                             *GAP ELECTRICAL CONDUCTANCE, PRESSURE\n50., 0.\n70., 250.\n";

/// HFL itself lies outside the range of f64, as conduction and the heat of the current do; HFLA of a small area does not.
#[test]
fn heat_of_a_small_area_is_finite_where_that_of_a_unit_is_not() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n1.E200, 0.\n1.E200, 1.\n\
                *GAP CONDUCTANCE\n1.E200, 0.\n1.E200, 1.\n";
    let run = eval(deck, "clearance,epot_jump,area,temp_s,temp_m\n0,1e100,1e-150,1e150,0\n0,1e100,0,1e150,0\n", &[]);
    // 1e350 is conducted out of the slave, and half of 1e400 comes in from the current.
    assert_eq!(numbers(&run, "HFL"), [f64::NEG_INFINITY; 2]);
    assert_eq!(numbers(&run, "total_heat_m"), [f64::INFINITY; 2]);
    assert_near(&numbers(&run, "HFLA"), &[-5e249, 0.0], 1e-15);
    assert_near(&numbers(&run, "SJDA"), &[1e250, 0.0], 1e-15);
    assert!(run.errors.contains("HFLA -5") && !run.errors.contains("NaN"), "{}", run.errors);
}

/// No digits are lost between temperatures that are nearly equal; the values are those of exact rationals.
#[test]
fn radiation_keeps_its_digits() {
    let deck = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67E-8\n*SURFACE INTERACTION, NAME=A\n\
                *GAP CONDUCTANCE\n0., 0.\n0., 1.\n*GAP RADIATION\n1., 1.\n1., 0.\n1., 1.\n";
    let nodes = "clearance,temp_s,temp_m\n0.5,100.000001,100\n0.5,100.00000001,100\n0.5,100.0000000001,100\n\
                 0.5,1e-10,0\n0.5,1e-14,0\n";
    let right = [
        1.178_401_776_998_042_4e-5,
        1.178_401_035_480_193_4e-7,
        1.178_422_805_358_648_5e-9,
        4.622_177_985_464_987e-10,
        4.622_177_985_462_449e-14,
    ];
    let run = eval(deck, nodes, &[]);
    assert_near(&numbers(&run, "heat_radiation"), &right, 6.0 * f64::EPSILON);
    assert_near(&numbers(&run, "HFL"), &right, 6.0 * f64::EPSILON);
}

/// O-1: totals are of the rows that have an area and a current.
#[test]
fn totals_are_of_the_rows_that_have_their_numbers() {
    let run = eval(BOTH_BRANCHES, "clearance,pressure,epot_jump,area\n0,0,1,1\n0,0,1,\n0,0,,1\n", &[]);
    assert_eq!(column(&run, "ECDA"), ["50", "", ""]);
    assert!(run.errors.contains("total of 1 row: ECDA 50, SJDA 50\n"), "{}", run.errors);
}

/// O-1: and of those of the latest time.
#[test]
fn totals_are_of_the_latest_time() {
    let nodes =
        "node,time,clearance,pressure,epot_jump,area\n1,0,0,0,1,1\n2,0,0,0,1,1\n1,1,0,0,1,1\n2,2,0,0,1,1\n3,,0,0,1,1\n";
    let run = eval(BOTH_BRANCHES, nodes, &[]);
    assert_eq!(column(&run, "ECDTA"), ["0", "0", "50", "100", ""]);
    assert!(run.errors.contains("total of 1 row at time 2.0: ECDA 50, SJDA 50\n"), "{}", run.errors);
    let json = eval(BOTH_BRANCHES, nodes, &["--format", "json"]);
    assert!(json.errors.contains(r#""totals":{"ECDA":50.0,"SJDA":50.0},"totals_time":2.0"#), "{}", json.errors);
}

#[test]
fn what_a_cell_holds_is_escaped() {
    let run = eval(BOTH_BRANCHES, "clearance,pressure\n\x1b[31mred\x1b[0m,0\n", &[]);
    assert_eq!(run.code, 1, "{}", run.errors);
    assert!(run.errors.contains("D002") && run.errors.contains("[31mred"), "{}", run.errors);
    assert!(!run.errors.contains('\x1b'), "{:?}", run.errors);
}

/// A blank line is no row, of one column either; a missing number is written `""`, as a cell of one column always can be.
#[test]
fn a_blank_line_of_one_column_is_no_row() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 2.\n";
    let run = eval(deck, "clearance\n0\n\n1\n", &[]);
    assert_eq!(column(&run, "conductance"), ["20", "15"]);
    assert!(run.errors.starts_with("2 rows in, 2 rows out"), "{}", run.errors);
    let run = eval(deck, "clearance\n0\n\"\"\n1\n", &[]);
    assert!(run.errors.contains("3 rows in, 3 rows out"), "{}", run.errors);
}

/// Q-5, Q-37: where the cutoff of gap filling is not known, a gap whose given rate is not zero takes up nobody knows what; from there on PTL is not known.
#[test]
fn ptl_is_unknown_from_where_a_cutoff_is() {
    let deck = "*SURFACE INTERACTION, NAME=P\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1.\n1.E-3, 0.\n\
                *STEP\n*SOILS, CONSOLIDATION\n1., 1.\n*END STEP\n";
    let nodes = "node,time,clearance,pressure,por_s,por_m,clearance_rate\n1,0,5.0,0,10,20,0\n1,1,3.0,0,10,20,0\n\
                 1,2,0.2,0,10,20,0\n1,3,0.2,0,10,20,-1\n1,4,0.2,0,10,20,0\n";
    let run = eval(deck, nodes, &[]);
    assert_eq!(column(&run, "PFL"), ["0", "0", "-0.01", "", "-0.01"]);
    assert_eq!(column(&run, "PTL"), ["0", "0", "-0.01", "", ""]);
    assert!(run.errors.contains("without the characteristic element length"), "{}", run.errors);
    // The rate of 0 contradicts a clearance that falls by 2 and by 2.8, and that of −1 one that stays.
    assert!(run.errors.contains("D021") && run.errors.contains("3 rows of `P`"), "{}", run.errors);
    let json = eval(deck, nodes, &["--format", "json"]);
    assert!(json.errors.contains(r#""closing":0,"contradictory_rates":3"#), "{}", json.errors);
}

const SEALED: &str =
    "*SURFACE INTERACTION, NAME=P\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n0., 0.\n";

/// Q-37: what a gap takes up beyond its cutoff it does not give back, so that a closed cycle gives 0.
#[test]
fn a_cycle_across_the_cutoff_makes_no_fluid() {
    let nodes = "node,time,clearance,pressure,por_s,por_m\n1,0,0.7,0,0,0\n1,1,1.1,0,0,0\n1,2,0.7,0,0,0\n\
                 1,3,1.1,0,0,0\n1,4,0.7,0,0,0\n";
    let run = eval(SEALED, nodes, &["--procedure", "transient"]);
    assert_near(&numbers(&run, "PTL"), &[0.0, 0.15, 0.0, 0.15, 0.0], 4.0 * f64::EPSILON);
    assert_near(&numbers(&run, "PFL"), &[0.0, 0.15, -0.15, 0.15, -0.15], 4.0 * f64::EPSILON);
}

/// Q-37: overclosure presses nothing out.
#[test]
fn a_cycle_of_overclosure_moves_the_open_gap_alone() {
    let nodes = "node,time,clearance,pressure,por_s,por_m\n1,0,0.02,0,0,0\n1,1,-0.5,9,0,0\n1,2,-0.9,9,0,0\n\
                 1,3,-0.5,9,0,0\n1,4,0.02,0,0,0\n";
    let run = eval(SEALED, nodes, &["--procedure", "transient"]);
    assert_eq!(column(&run, "PTL"), ["0", "-0.01", "-0.01", "-0.01", "0"]);
    assert_eq!(column(&run, "PFL"), ["0", "-0.01", "0", "0", "0.01"]);
}

/// A deck that is evaluated includes a file, and `-o` names it: nothing is written over what the run has read.
#[test]
fn a_result_never_replaces_a_file_that_the_deck_includes() {
    let nodes = "clearance,pressure,epot_jump\n0.05,0,1\n";
    let deck = "*INCLUDE, INPUT=part.inc\n";
    let folder = Folder::with(&[("deck.inp", deck), ("part.inc", BOTH_BRANCHES), ("nodes.csv", nodes)]);
    for target in ["part.inc", "./part.inc", "deck.inp", "nodes.csv"] {
        let run = folder.inpact(&["eval", "deck.inp", "--nodes", "nodes.csv", "-o", target]);
        assert_eq!(run.code, 2, "{target}: {}", run.errors);
        assert!(run.errors.contains(target.trim_start_matches("./")), "{target}: {}", run.errors);
        let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect("still there");
        assert_eq!((read("part.inc").as_str(), read("deck.inp").as_str()), (BOTH_BRANCHES, deck), "{target}");
        assert_eq!(read("nodes.csv"), nodes, "{target}");
    }
}
