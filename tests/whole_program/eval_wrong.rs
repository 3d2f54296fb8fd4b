//! `inpact eval` on node tables and decks with something wrong: D001 to D008, exit codes, and that nothing half right is written.

use crate::program::{Folder, Run};

const DECK: &str = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECTRICAL CONDUCTANCE
20., 0.
10., 0.1
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
50., 0.
65., 100.
";

/// Evaluates `DECK` on a node table into `result.csv`; gives what was said and what was written.
fn eval(nodes: &str) -> (Run, Option<String>) {
    let folder = Folder::with(&[("a.inp", DECK), ("n.csv", nodes)]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv", "-o", "result.csv"]);
    assert_eq!(run.output, "");
    let written = folder.path().join("result.csv").exists().then(|| folder.read("result.csv"));
    let expected: &[&str] = if written.is_some() { &["a.inp", "n.csv", "result.csv"] } else { &["a.inp", "n.csv"] };
    assert_eq!(folder.names(), expected, "no unfinished file is left");
    (run, written)
}

#[test]
fn errors_in_the_data_end_with_1_and_nothing_is_written() {
    let cases = [
        ("D001", "node\n1\n", "`clearance` is missing"),
        ("D001", "node,clearance\n1,0\n", "`pressure` is missing"),
        ("D001", "", "the node table is empty"),
        ("D002", "node,clearance,pressure\n1,0,0\n2,x,0\n", "n.csv:3: error[D002] `clearance` of row 2 is `x`"),
        ("D002", "node,clearance,pressure\n1,0,1.5-3\n", "`pressure` of row 1 is `1.5-3`"),
        ("D002", "node,clearance,pressure\n1,0\n", "row 1 has 2 cells"),
        ("D002", "node,clearance,pressure\n1,0,0,0\n", "row 1 has 4 cells"),
        ("D002", "node,clearance,pressure,closed\n1,0,0,2\n", "neither 0 nor 1"),
        ("D004", "node,interaction,clearance,pressure\n1,B,0,0\n", "`interaction` of row 1 is `B`"),
        ("D005", "node,clearance,pressure,Clearance\n1,0,0,0\n", "column `clearance` stands twice"),
        ("D005", "node,clearance,cpress,pressure\n1,0,0,0\n", "both mean `pressure`"),
        ("D006", "node,time,clearance,pressure\n1,0,0,0\n2,5,0,0\n1,0,0,0\n", "`time` of node `1`"),
        ("D006", "node,time,clearance,pressure\n1,2,0,0\n1,1,0,0\n", "`time` of node `1`"),
        ("D008", "node,clearance,pressure,area\n1,0,0,-1\n", "`area` of row 1"),
    ];
    for (code, nodes, message) in cases {
        let (run, written) = eval(nodes);
        assert_eq!((run.code, written), (1, None), "{nodes}: {}", run.errors);
        assert!(run.errors.contains(&format!("error[{code}]")), "{nodes}: {}", run.errors);
        assert!(run.errors.contains(message), "{nodes}: {}", run.errors);
    }
}

#[test]
fn a_malformed_cell_in_the_last_of_many_rows_leaves_no_result() {
    let rows: String = (0..20_000).map(|node| format!("{node},0,1\n")).collect();
    let (run, written) = eval(&format!("node,clearance,pressure\n{rows}20000,0,one\n"));
    assert_eq!((run.code, written), (1, None));
    assert!(run.errors.contains("n.csv:20002: error[D002] `pressure` of row 20001 is `one`"), "{}", run.errors);
}

#[test]
fn every_malformed_cell_is_named_in_one_run() {
    let (run, _) = eval("node,clearance,pressure\n1,x,0\n2,0,y\n3,0,0\n4,z,0\n");
    for place in ["n.csv:2:", "n.csv:3:", "n.csv:5:"] {
        assert!(run.errors.contains(place), "{place}: {}", run.errors);
    }
}

#[test]
fn a_result_that_was_there_outlives_a_run_that_fails() {
    let folder =
        Folder::with(&[("a.inp", DECK), ("n.csv", "node,clearance,pressure\n1,x,0\n"), ("result.csv", "old\n")]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv", "-o", "result.csv"]);
    assert_eq!((run.code, folder.read("result.csv").as_str()), (1, "old\n"));
}

#[test]
fn d003_and_d007_are_reported_and_the_rest_is_written() {
    let (run, written) = eval("node,clearance,pressure\n1,nan,0\n2,0,inf\n3,0,50\n4,0,400\n5,.2,0\n");
    let expected = "node,WEIGHT,conductance,status\n1,0.5,NaN,\n2,0.5,65,beyond_table\n3,0.5,57.5,closed\n\
                    4,0.5,65,beyond_table\n5,0.5,10,beyond_table\n";
    assert_eq!((run.code, written.as_deref()), (0, Some(expected)), "{}", run.errors);
    assert_eq!(run.errors.matches("warning[D003]").count(), 2, "{}", run.errors);
    assert!(run.errors.contains("note[D007] 2 rows lie above the last `pressure`"), "{}", run.errors);
    // Beyond the last clearance the manual contradicts itself, which is worth more than a note.
    assert!(run.errors.contains("warning[D007] 1 row lies above the last `clearance`"), "{}", run.errors);
}

#[test]
fn an_empty_cell_is_no_number_and_no_error() {
    let (run, written) = eval("node,clearance,pressure\n1,0,50\n2,,50\n3,0,\n");
    let expected = "node,WEIGHT,conductance,status\n1,0.5,57.5,closed\n";
    assert_eq!(run.code, 0, "{}", run.errors);
    let written = written.expect("a result");
    assert_eq!(written.lines().count(), 4, "{written}");
    assert!(written.starts_with(expected), "{written}");
}

#[test]
fn an_interaction_that_is_not_chosen_or_not_there() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n10., 0.\n\
                *SURFACE INTERACTION, NAME=B\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n20., 0.\n";
    let folder = Folder::with(&[("two.inp", deck), ("n.csv", "node,clearance,pressure\n1,0,1\n")]);
    let run = folder.inpact(&["eval", "two.inp", "--nodes", "n.csv"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    assert!(run.errors.contains("error[D001] column `interaction` is missing"), "{}", run.errors);
    let run = folder.inpact(&["eval", "two.inp", "--nodes", "n.csv", "--interaction", "C"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    assert!(run.errors.contains("error[D004]") && run.errors.contains("`A`, `B`"), "{}", run.errors);
}

#[test]
fn a_deck_with_errors_in_what_is_evaluated_is_not_evaluated() {
    let deck = DECK.replace("65., 100.", "65., -100.");
    let folder = Folder::with(&[("a.inp", &deck), ("n.csv", "node,clearance,pressure\n1,0,1\n")]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    assert!(run.errors.contains("a.inp:7:6: error[T001]"), "{}", run.errors);
}

#[test]
fn a_law_of_a_user_subroutine_cannot_be_evaluated() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, USER\n";
    let folder = Folder::with(&[("a.inp", deck), ("n.csv", "node,clearance,pressure\n1,0,1\n")]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    assert!(run.errors.contains("needs user subroutine GAPELECTR"), "{}", run.errors);
    // Another law of the same interaction can.
    folder.write(
        "a.inp",
        &format!("{deck}*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n1.E-3, 0.\n"),
    );
    folder.write("n.csv", "node,clearance,pressure,por_s,por_m\n1,0,1,10,30\n");
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("q_across") && !run.output.contains("ECD"), "{}", run.output);
}

#[test]
fn a_deck_without_interactions_is_said() {
    let folder = Folder::with(&[("a.inp", "*NODE\n1, 0., 0.\n"), ("n.csv", "node,clearance,pressure\n1,0,1\n")]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    assert!(run.errors.contains("`a.inp` defines no *SURFACE INTERACTION"), "{}", run.errors);
}
