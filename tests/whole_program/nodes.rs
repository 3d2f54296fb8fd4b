//! `inpact nodes`: node tables from the mesh of a deck, what is said of them, and that `eval` takes them as they are.

use crate::program::{Folder, Run, inpact, inpact_with_input};

pub(crate) const WELD: &str = "decks/weld-mesh/weld-mesh.inp";

/// Two unit cubes that share a mesh, the upper one 0.25 above the lower and half a side beside it.
pub(crate) const CUBES: &str = "\
*NODE
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.
5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.
11, .5, 0., 1.25\n12, 1.5, 0., 1.25\n13, 1.5, 1., 1.25\n14, .5, 1., 1.25
15, .5, 0., 2.25\n16, 1.5, 0., 2.25\n17, 1.5, 1., 2.25\n18, .5, 1., 2.25
*ELEMENT, TYPE=C3D8, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=UPPER
2, 11, 12, 13, 14, 15, 16, 17, 18
*SURFACE, NAME=MASTER
LOWER, S2
*SURFACE, NAME=SLAVE
UPPER, S1
*SURFACE INTERACTION, NAME=GAP
*GAP CONDUCTANCE
10., 0.
0., 1.
*CONTACT PAIR, INTERACTION=GAP
SLAVE, MASTER
";

/// Standard error without the time the run took.
fn timeless(run: &Run) -> String {
    let line = |line: &str| match line.split_once(" rows, ") {
        Some((rows, rest)) if rest.ends_with(" s") => format!("{rows} rows, TIME\n"),
        _ => format!("{line}\n"),
    };
    format!(
        "exit code {}\n{}--- standard error\n{}",
        run.code,
        run.output,
        run.errors.lines().map(line).collect::<String>()
    )
}

fn of(deck: &str) -> Run {
    Folder::with(&[("a.inp", deck)]).inpact(&["nodes", "a.inp"])
}

#[test]
fn the_table_of_the_weld_mesh() {
    insta::assert_snapshot!(timeless(&inpact(&["nodes", WELD])));
}

#[test]
fn eval_takes_the_table_as_it_is_in_every_format() {
    let table = inpact(&["nodes", WELD]);
    assert_eq!(table.code, 0, "{}", table.errors);
    let eval = inpact_with_input(&["eval", WELD, "--nodes", "-"], table.output.as_bytes());
    assert_eq!(eval.code, 0, "{}", eval.errors);
    assert_eq!(eval.output.lines().count(), 26);
    insta::assert_snapshot!(eval.output);
    let deck = std::fs::read_to_string(crate::program::root().join(WELD)).expect("the sample");
    for name in ["n.csv", "n.parquet", "n.arrow"] {
        let folder = Folder::with(&[("a.inp", &deck)]);
        let made = folder.inpact(&["nodes", "a.inp", "-o", name]);
        assert_eq!((made.code, made.output.as_str()), (0, ""), "{}", made.errors);
        assert_eq!(folder.inpact(&["eval", "a.inp", "--nodes", name]).output, eval.output, "{name}");
    }
    // From a stream the deck cannot be read twice: it is kept.
    assert_eq!(inpact_with_input(&["nodes", "-"], deck.as_bytes()).output, table.output);
}

#[test]
fn a_node_without_a_master_face_has_no_clearance_and_is_named() {
    let run = of(CUBES);
    let rows = "node,interaction,clearance,area\n11,GAP,0.25,0.2499999999999999\n12,GAP,,0.2499999999999999\n13,GAP,,0.2499999999999999\n14,GAP,0.25,0.2499999999999999\n";
    assert_eq!((run.code, run.output.as_str()), (0, rows), "{}", run.errors);
    let note = "a.inp:30:1: note: 2 slave nodes of `SLAVE`, the first of them 12, have no face of `MASTER` across: their clearances are left empty";
    assert!(run.errors.contains(note), "{}", run.errors);
    for said in [
        "4 slave nodes, area 0.9999999999999996;",
        "0 closed, 2 open, 2 without a master face",
        "area: equal shares, node to surface",
    ] {
        assert!(run.errors.contains(said), "{said}: {}", run.errors);
    }
}

#[test]
fn initial_conditions_by_node_and_set_fill_temperatures_and_the_last_one_counts() {
    let initial =
        "*NSET, NSET=TOPS\n5, 6, 7, 8\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nTOPS, 20.\n6, 60.\n7, 60.\n11, 5.\n";
    let run = of(&format!("{CUBES}{initial}*INITIAL CONDITIONS, TYPE=FIELD, VARIABLE=2\nTOPS, 1.\n14, 3.\n"));
    // Node 11 lies above the middle between 20 and 60; nothing is made up for node 14.
    let rows = "node,interaction,clearance,area,temp_s,temp_m,fv2_s,fv2_m\n11,GAP,0.25,0.2499999999999999,5,40,,1\n12,GAP,,0.2499999999999999,,,,\n\
                13,GAP,,0.2499999999999999,,,,\n14,GAP,0.25,0.2499999999999999,,40,3,1\n";
    assert_eq!((run.code, run.output.as_str()), (0, rows), "{}", run.errors);
    assert!(run.errors.contains("temp_s: *INITIAL CONDITIONS, empty in 3 rows"), "{}", run.errors);
}

#[test]
fn initial_conditions_that_are_not_read_are_named_with_their_line() {
    let initial = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n11, 5.\n12, warm\nNOWHERE, 1.\n*INITIAL CONDITIONS, TYPE=TEMPERATURE, FILE=before.odb\n";
    let run = of(&format!("{CUBES}{initial}"));
    for said in [
        "a.inp:34:1: note: the initial condition of `12`, which is no single number, was not read",
        "a.inp:35:1: note: the node set `NOWHERE` is not defined here",
        "a.inp:36:1: note: initial conditions with FILE are not read",
    ] {
        assert!(run.errors.contains(said), "{said}: {}", run.errors);
    }
    assert_eq!(run.code, 0);
}

#[test]
fn decks_without_a_table_end_with_1_and_say_why() {
    let without_mesh = CUBES.split_once("*SURFACE,").expect("surfaces").1;
    let cases = [
        ("*HEADING\nnothing\n".to_owned(), "`a.inp` has no contact pair: expected *CONTACT PAIR"),
        (format!("*SURFACE,{without_mesh}"), "error: "),
        (CUBES.replace("SLAVE, MASTER", "SLAVE, ELSEWHERE"), "no contact pair of `a.inp` has both of its surfaces"),
        (CUBES.replace(", INTERACTION=GAP", ""), "names no interaction: its nodes are left out"),
        (CUBES.replace("11, .5, 0., 1.25", "11, 1e300, 0., 1.25"), "node 11 has the coordinate"),
    ];
    for (deck, message) in cases {
        let run = of(&deck);
        assert_eq!((run.code, run.output.as_str()), (1, ""), "{message}: {}", run.errors);
        assert!(run.errors.contains(message), "{message}: {}", run.errors);
    }
    assert_eq!(inpact(&["nodes", "decks/no-such-deck.inp"]).code, 2);
}

#[test]
fn nothing_is_written_over_the_deck() {
    let folder = Folder::with(&[("a.inp", CUBES)]);
    let run = folder.inpact(&["nodes", "a.inp", "-o", "a.inp"]);
    assert_eq!((run.code, folder.read("a.inp").as_str()), (2, CUBES), "{}", run.errors);
}

#[test]
fn notes_and_summary_as_json_are_a_line_each() {
    let folder = Folder::with(&[("a.inp", CUBES)]);
    let run = folder.inpact(&["nodes", "a.inp", "--format", "json"]);
    let lines: Vec<serde_json::Value> =
        run.errors.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!((lines[0]["severity"].as_str(), lines[0]["line"].as_u64()), (Some("note"), Some(30)));
    assert_eq!(lines[1]["summary"]["pairs"][0]["without_master"], 2);
}

#[test]
fn a_deck_cut_anywhere_ends_with_0_or_1() {
    for end in (0..CUBES.len()).step_by(23) {
        let run = of(&CUBES[..end]);
        assert!(run.code == 0 || run.code == 1, "cut at {end}: {}", run.shown());
    }
}
