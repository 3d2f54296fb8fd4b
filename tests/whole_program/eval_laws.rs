//! The test vectors of the semantics, from deck and node table to result.

use crate::program::Folder;

/// Evaluates `deck` on `nodes`; gives the columns asked for, a row a line.
fn eval(deck: &str, nodes: &str, options: &[&str], columns: &[&str]) -> Vec<String> {
    let folder = Folder::with(&[("deck.inp", deck), ("nodes.csv", nodes)]);
    let run = folder.inpact(&[&["eval", "deck.inp", "--nodes", "nodes.csv"], options].concat());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert_eq!(run.output.lines().count(), nodes.lines().count(), "rows in, rows out");
    assert!(!run.output.contains("inf"), "{}", run.output);
    let mut lines = run.output.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    let place = |name: &&str| {
        header.iter().position(|column| column == name).unwrap_or_else(|| panic!("no `{name}` in {header:?}"))
    };
    let places: Vec<usize> = columns.iter().map(place).collect();
    lines.map(|cells| places.iter().map(|place| cells[*place]).collect::<Vec<_>>().join(" ")).collect()
}

const CLEARANCE: &str = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECTRICAL CONDUCTANCE
20., 0.
10., 0.1
";

#[test]
fn a_10_clearance_only() {
    let nodes = "node,clearance\n1,-1e-3\n2,0\n3,.05\n4,.1\n5,.2\n";
    let rows = eval(CLEARANCE, nodes, &[], &["conductance", "status"]);
    assert_eq!(rows, ["20 closed", "20 closed", "15 open", "10 open", "10 beyond_table"]);
    let rows = eval(CLEARANCE, nodes, &["--clearance-tail", "zero"], &["conductance", "status"]);
    assert_eq!(rows, ["20 closed", "20 closed", "15 open", "10 open", "0 beyond_table"]);
}

#[test]
fn slopes_are_right_hand_at_a_knot_and_0_outside() {
    let nodes = "node,clearance\n1,-1e-3\n2,0\n3,.05\n4,.1\n5,.2\n";
    let rows = eval(CLEARANCE, nodes, &["--derivatives"], &["dconductance_dclearance"]);
    assert_eq!(rows, ["0", "-100", "-100", "0", "0"]);
}

const BOTH: &str = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECTRICAL CONDUCTANCE
20., 0.
10., 0.1
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
50., 0.
65., 100.
70., 250.
";

#[test]
fn a_11_both_branches() {
    let nodes = "node,clearance,pressure\n1,0,0\n2,0,-5\n3,1e-9,0\n4,.05,0\n5,0,100\n6,0,175\n7,0,400\n";
    let rows = eval(BOTH, nodes, &[], &["conductance"]);
    let open: f64 = rows[2].parse().expect("a number");
    assert!(open < 20.0 && open > 19.999, "20 from below, not {open}");
    assert_eq!([&rows[..2], &rows[3..]].concat(), ["50", "50", "15", "65", "67.5", "70"]);
}

#[test]
fn t_22_a_pressure_closes_the_gap_unless_the_table_says_otherwise() {
    let nodes = "node,clearance,pressure,closed\n1,.05,100,\n2,.05,100,1\n3,.05,100,0\n4,0,0,0\n";
    let rows = eval(BOTH, nodes, &[], &["conductance", "status"]);
    assert_eq!(rows, ["65 closed", "65 closed", "15 open", "20 open"]);
}

#[test]
fn a_12_pressure_only() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n50., 0.\n65., 100.\n";
    let nodes = "node,clearance,pressure\n1,1e-9,0\n2,0,50\n3,0,1e6\n";
    assert_eq!(eval(deck, nodes, &[], &["conductance"]), ["0", "57.5", "65"]);
}

#[test]
fn a_13_two_temperatures_ragged() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n\
                10., 0., 300.\n6., 1., 300.\n2., 2., 300.\n20., 0., 400.\n10., 4., 400.\n";
    let nodes = "node,clearance,temp_s,temp_m\n1,2,300,400\n2,3,330,370\n";
    assert_eq!(eval(deck, nodes, &[], &["conductance"]), ["8.5", "7.25"]);
    assert_eq!(eval(deck, nodes, &["--clearance-tail", "zero"], &["conductance"]), ["8.5", "6.25"]);
    let averaged = "node,clearance,temp\n1,2,350\n2,3,350\n";
    assert_eq!(eval(deck, averaged, &[], &["conductance"]), ["8.5", "7.25"]);
}

#[test]
fn a_20_current_and_heat_into_each_side() {
    let deck =
        "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n10., 0.\n*GAP HEAT GENERATION\n.5, .25\n";
    let nodes = "node,clearance,pressure,epot_s,epot_m,area\n1,0,0,3,1,2\n";
    let columns = ["ECD", "ECDA", "SJD", "SJDA", "WEIGHT", "heat_s", "heat_m"];
    assert_eq!(eval(deck, nodes, &["--procedure", "steady"], &columns), ["20 40 20 40 0.25 5 15"]);
}

#[test]
fn a_21_transient_heat_is_the_average_of_the_increment() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n3., 0.\n";
    let nodes = "node,time,clearance,pressure,epot_s,epot_m\n1,10,0,0,2,0\n1,12,0,0,5,0\n";
    let columns = ["ECD", "SJD", "ECDT", "SJDT"];
    // The first row has its own difference at its start (C-25), and its integrals are 0.
    let rows = eval(deck, nodes, &["--procedure", "transient"], &columns);
    assert_eq!(rows, ["6 12 0 0", "15 39 30 78"]);
}

#[test]
fn a_22_finite_permeability() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY\n1.E-3, 0.\n";
    let nodes = "node,clearance,pressure,por_s,por_m,clearance_rate\n1,0,0,10,30,0\n";
    for procedure in ["steady", "transient"] {
        let rows = eval(deck, nodes, &["--procedure", procedure], &["q_across", "q_s", "q_m", "PFL"]);
        assert_eq!(rows, ["0.02 0.02 -0.02 -0.02"]);
    }
}

#[test]
fn a_23_a_closing_gap_gives_its_fluid_to_both_sides() {
    // Slightly open: what is closed has no gap to give fluid from.
    let nodes = "node,clearance,pressure,por_s,por_m,clearance_rate,perm_s,perm_m\n1,0.1,0,10,10,-2e-3,3,1\n";
    let infinite = "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n";
    let columns = ["q_gap_s", "q_gap_m"];
    assert_eq!(eval(infinite, nodes, &["--procedure", "transient"], &columns), ["0.001 0.001"]);
    assert_eq!(eval(infinite, nodes, &["--procedure", "steady"], &columns), ["0 0"]);
    let finite = format!("{infinite}1.E-3, 0.\n");
    let columns = ["q_across", "q_gap_s", "q_gap_m", "PFL"];
    assert_eq!(eval(&finite, nodes, &["--procedure", "transient"], &columns), ["0 0.0015 0.0005 -0.0015"]);
}

#[test]
fn p_30_an_infinite_permeability_is_a_constraint_and_no_number() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n";
    let nodes = "node,clearance,pressure,por_s,por_m\n1,0,5,10,30\n2,1,0,10,30\n3,2,0,10,30\n";
    let rows = eval(deck, nodes, &[], &["node", "q_across", "q_s", "q_m", "PFL", "status"]);
    assert_eq!(rows, ["1     constrained", "2     constrained", "3 0 0 0 0 cutoff"]);
}

#[test]
fn a_24_cutoff_of_flow_across() {
    let deck = |cutoff: &str| format!("*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY{cutoff}\n1., 0.\n3., 10.\n");
    let nodes = "node,clearance,pressure,por_s,por_m\n1,.5,0,0,1\n";
    let columns = ["permeability", "q_across", "status"];
    let of = |cutoff: &str, options: &[&str]| eval(&deck(cutoff), nodes, options, &columns);
    assert_eq!(of(", CUTOFF FLOW ACROSS=.4", &[]), ["0 0 cutoff"]);
    assert_eq!(of(", CUTOFF FLOW ACROSS=.5", &[]), ["1 1 open"]);
    assert_eq!(of(", CUTOFF FLOW ACROSS=.5", &["--cutoff-boundary", "exclusive"]), ["0 0 cutoff"]);
    // Without a cutoff it is the characteristic element length, which must be known (P-20).
    assert_eq!(of("", &[]), ["  open"]);
    assert_eq!(of("", &["--char-length", "0.5"]), ["1 1 open"]);
    assert_eq!(of("", &["--char-length", "0.4"]), ["0 0 cutoff"]);
    let nodes = "node,clearance,pressure,por_s,por_m,char_length\n1,.5,0,0,1,.4\n2,.5,0,0,1,.5\n";
    assert_eq!(eval(&deck(""), nodes, &[], &columns), ["0 0 cutoff", "1 1 open"]);
}

#[test]
fn a_24_the_missing_length_is_said() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY\n1., 0.\n";
    let folder = Folder::with(&[("d.inp", deck), ("n.csv", "node,clearance,pressure,por_s,por_m\n1,.5,0,0,1\n")]);
    let run = folder.inpact(&["eval", "d.inp", "--nodes", "n.csv"]);
    assert!(run.errors.contains("1 row without the characteristic element length"), "{}", run.errors);
}

#[test]
fn a_25_cutoff_of_gap_filling() {
    let deck =
        "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=.1\n1., 0.\n";
    let nodes = "node,clearance,pressure,por_s,por_m,clearance_rate\n1,.5,0,0,1,-1\n2,.1,0,0,1,-1\n";
    let rows = eval(deck, nodes, &["--procedure", "transient"], &["q_across", "q_gap_s", "q_gap_m"]);
    assert_eq!(rows, ["1 0 0", "1 0.5 0.5"]);
}

#[test]
fn a_history_gives_the_rate_of_the_clearance_and_the_time_integrals() {
    let deck =
        "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n1., 0.\n";
    // Two nodes, row by row in turn: each has a history of its own.
    let nodes = "node,time,clearance,pressure,por_s,por_m,area\n\
                 1,0,.5,0,0,1,2\n2,0,.5,0,0,0,2\n1,2,.25,0,0,1,2\n2,2,1,0,0,0,2\n";
    let columns = ["node", "q_across", "q_gap_s", "PFL", "PTL", "PTLA"];
    let rows = eval(deck, nodes, &["--procedure", "transient"], &columns);
    assert_eq!(rows, ["1 1 0 -1 0 0", "2 0 0 0 0 0", "1 1 0.0625 -1.0625 -2.125 -4.25", "2 0 -0.125 0.125 0.25 0.5"]);
}

#[test]
fn a_field_variable_is_the_average_of_both_sides() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1\n\
                1., 0., , 1.\n2., 10., , 1.\n3., 0., , 2.\n4., 10., , 2.\n";
    let columns = ["conductance", "dconductance_dpressure", "dconductance_dfv1"];
    let sides = "node,clearance,pressure,fv1_s,fv1_m\n1,0,5,1,2\n";
    assert_eq!(eval(deck, sides, &["--derivatives"], &columns), ["2.5 0.1 2"]);
    let average = "node,clearance,pressure,fv1\n1,0,5,1.5\n";
    assert_eq!(eval(deck, average, &["--derivatives"], &columns), ["2.5 0.1 2"]);
}
