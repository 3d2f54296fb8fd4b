//! `inpact solve` on scenes and decks with something wrong: what is said, exit codes, and that nothing half right is written.

use crate::program::{Folder, Run};

const DECK: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP CONDUCTANCE, PRESSURE
10., 0.
10., 1.
";

const BROKEN: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP CONDUCTANCE, PRESSURE
10., 1.
5., 0.
";

/// Two held ends and a node between them.
const SCENE: &str = "\
deck = \"deck.inp\"
[[node]]
name = \"hot\"
temperature = { fixed = 100.0 }
[[node]]
name = \"middle\"
[[node]]
name = \"cold\"
temperature = { fixed = 20.0 }
[[link]]
nodes = [\"hot\", \"middle\"]
thermal = 1.0
[[interface]]
interaction = \"JOINT\"
slave = \"middle\"
master = \"cold\"
area = 0.5
clearance = 0.0
pressure = 0.0
";

const CASES: [(&str, &str, &str); 20] = [
    // The text of the scene, its replacement, and a part of the message.
    (
        "nodes = [\"hot\", \"middle\"]",
        "nodes = [\"hot2\", \"middle\"]",
        "the scene defines no node `hot2` (is `hot` meant?",
    ),
    (
        "nodes = [\"hot\", \"middle\"]",
        "nodes = [\"hot\", \"midle\"]",
        "the scene defines no node `midle` (is `middle` meant?",
    ),
    ("master = \"cold\"", "master = \"clod\"", "is `cold` meant?"),
    ("thermal = 1.0", "thremal = 1.0", "there is no key `thremal` here (is `thermal` meant?"),
    ("temperature = { fixed = 20.0 }", "temperature = 20.0", "expected a table such as { fixed = 1.0 }, found `20.0`"),
    (
        "[\"hot\", \"middle\"]",
        "[\"hot\", \"middle\", \"cold\"]",
        "expected the names of two nodes such as [\"a\", \"b\"], found ",
    ),
    ("fixed = 20.0", "fixt = 20.0", "there is no key `fixt` here"),
    ("thermal = 1.0", "thermal = -1.0", "`thermal` of the link of `hot` and `middle` is -1.0"),
    ("thermal = 1.0", "thermal = nan", "`thermal` of the link of `hot` and `middle` is nan"),
    ("thermal = 1.0\n", "", "the link of `hot` and `middle` conducts nothing"),
    ("area = 0.5\n", "", "`area` is missing"),
    ("\"JOINT\"", "\"JIONT\"", "the deck defines no interaction `JIONT`"),
    ("fixed = 20.0", "fixed = 20.0, source = 1.0", "the temperature of `cold` has `fixed` and `source`"),
    (
        "fixed = 20.0",
        "fixed = [[0.0, 20.0], [0.0, 30.0]]",
        "the times of `fixed` of `temperature` of `cold` do not ascend",
    ),
    (
        "fixed = 20.0",
        "fixed = \"warm\"",
        "expected a number, or points of time and value such as [[0.0, 20.0], [1.0, 80.0]], found `\"warm\"`",
    ),
    ("name = \"middle\"", "name = \"middle\"\n[[node]]\nname = \"middle\"", "node `middle` is defined twice"),
    ("[[link]]", "[time]\nend = 1.0\nstep = 0.5\n[[link]]", "a steady state has no `time`"),
    ("deck = \"deck.inp\"", "deck = \"deck.inp\"\nprocedure = \"transient\"", "a transient needs `time`"),
    ("deck = \"deck.inp\"", "deck = \"deck.inp\"\nprocedure = \"static\"", "`static` is none of `steady`, `transient`"),
    ("deck = \"deck.inp\"\n", "", "`deck` is missing"),
];

fn changed(from: &str, to: &str) -> String {
    assert!(SCENE.contains(from), "{from}");
    SCENE.replacen(from, to, 1)
}

fn solve(deck: &str, scene: &str) -> Run {
    let folder = Folder::with(&[("deck.inp", deck), ("scene.toml", scene)]);
    folder.inpact(&["solve", "scene.toml"])
}

/// All that is no TOML in one run, with what is wrong in the rest; nothing is said of what the lines taken out would have said.
#[test]
fn every_line_that_is_no_toml_is_told_in_one_run() {
    let scene = SCENE
        .replace("deck = \"deck.inp\"", "deck = \"deck.inp\"\n[initial]\ntemperature = 1.0.0")
        .replace("area = 0.5", "area")
        .replace("thermal = 1.0", "thermal = warm")
        .replace("fixed = 20.0", "fixt = 20.0");
    let run = solve(DECK, &scene);
    assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
    let messages: Vec<&str> =
        run.errors.lines().filter_map(|line| line.split_once("[D011] ")).map(|(_, said)| said).collect();
    let expected = [
        "expected a number, found `1.0.0`",
        "there is no key `fixt` here (the keys here are `fixed`, `source`, `capacity`, `initial`)",
        "expected a number, found `warm`",
        "expected a key with `=` and its value, found `area`",
    ];
    assert_eq!(messages, expected, "{}", run.errors);
}

/// A scene that has nothing to solve says so.
#[test]
fn a_scene_without_nodes_is_refused() {
    let run = solve(DECK, "deck = \"deck.inp\"\n");
    assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
    assert!(
        run.errors.contains("error[D011] the scene has no nodes, so that there is nothing to solve"),
        "{}",
        run.errors
    );
}

#[test]
fn the_scene_itself_is_right() {
    let run = solve(DECK, SCENE);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("middle,,33.3333333333333"), "{}", run.output);
}

#[test]
fn errors_in_the_scene_end_with_1_and_nothing_is_written() {
    let mut shown = String::new();
    for (from, to, message) in CASES {
        let run = solve(DECK, &changed(from, to));
        assert_eq!((run.code, run.output.as_str()), (1, ""), "{to}: {}", run.errors);
        assert!(run.errors.contains(message), "{to}: {}", run.errors);
        let change = |text: &str| text.replace('\n', " / ");
        shown += &format!("{} -> {}\n{}\n", change(from), change(to), run.errors);
    }
    insta::assert_snapshot!(shown);
}

/// Three scenes that are well written, and have no solution.
const NO_SOLUTION: [(&str, &str, &str); 3] = [
    ("area = 0.5\nclearance = 0.0", "area = 0.5\nclearance = 1.0", "nothing"),
    (
        "thermal = 1.0",
        "thermal = inf\n[[link]]\nnodes = [\"middle\", \"cold\"]\nthermal = inf",
        "the temperature of `hot` is fixed at 100.0 and that of `cold` at 20.0, and infinite conductances make them one",
    ),
    (
        "[[link]]",
        "[[node]]\nname = \"island\"\ntemperature = { source = 3.0 }\n[[node]]\nname = \"island-2\"\n[[link]]\nnodes = [\"island\", \"island-2\"]\nthermal = 1.0\n[[link]]",
        "nothing holds the temperature of `island`, `island-2`",
    ),
];

#[test]
fn a_scene_without_a_solution_ends_with_1() {
    let mut shown = String::new();
    for (from, to, message) in &NO_SOLUTION[1..] {
        let run = solve(DECK, &changed(from, to));
        assert_eq!(run.code, 1, "{}", run.errors);
        assert!(run.errors.contains(message), "{to}: {}", run.errors);
        shown += &run.errors;
    }
    insta::assert_snapshot!(shown);
}

#[test]
fn where_there_is_no_solution_nothing_is_written() {
    for (from, to, _) in &NO_SOLUTION[1..] {
        let folder = Folder::with(&[("deck.inp", DECK), ("scene.toml", &changed(from, to)), ("nodes.csv", "old\n")]);
        assert_eq!(folder.inpact(&["solve", "scene.toml"]).output, "", "{to}");
        let run = folder.inpact(&[
            "solve",
            "scene.toml",
            "-o",
            "nodes.csv",
            "--interfaces",
            "interfaces.csv",
            "--links=links.csv",
        ]);
        assert_eq!((run.code, folder.read("nodes.csv").as_str()), (1, "old\n"), "{to}");
        assert_eq!(folder.names(), ["deck.inp", "nodes.csv", "scene.toml"], "{to}");
    }
}

#[test]
fn an_area_is_above_zero_and_the_message_says_so() {
    for area in ["0.0", "-0.5"] {
        let run = solve(DECK, &changed("area = 0.5", &format!("area = {area}")));
        assert_eq!((run.code, run.output.as_str()), (1, ""));
        let place = format!("scene.toml:17: error[D014] `area` of the interface of `middle` and `cold` is {area}");
        assert!(run.errors.starts_with(&place) && run.errors.contains("above zero"), "{}", run.errors);
    }
}

/// The default of both cutoffs of pore fluid is a length that no deck holds (P-20); a closed gap needs none.
#[test]
fn the_characteristic_length_is_required_where_it_counts() {
    let deck = "*SURFACE INTERACTION, NAME=JOINT\n*CONTACT PERMEABILITY\n2., 0.\n";
    let scene = SCENE.replace("temperature", "pore_pressure").replace("thermal", "hydraulic");
    let open = scene.replace("clearance = 0.0", "clearance = 0.5");
    assert_eq!(solve(deck, &scene).code, 0);
    let run = solve(deck, &open);
    assert_eq!(run.code, 1, "{}", run.errors);
    insta::assert_snapshot!(run.errors);
    for (length, middle) in [(1.0, "60"), (0.5, "60"), (0.25, "100")] {
        let run = solve(deck, &open.replace("area", &format!("char_length = {length:?}\narea")));
        assert!(run.output.contains(&format!("middle,,,{middle}\n")), "{length}: {} {}", run.output, run.errors);
    }
}

/// Pressure 0 and no clearance: it may be open as well as closed, so that its conductance is not known. `eval` asks for the clearance, too.
#[test]
fn whether_it_is_closed_has_to_be_known() {
    let unknown = changed("clearance = 0.0\n", "");
    let run = solve(DECK, &unknown);
    assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
    assert!(run.errors.contains("lacks `clearance`"), "{}", run.errors);
    for known in ["closed = true\npressure = 0.0", "pressure = 0.5"] {
        let run = solve(DECK, &unknown.replace("pressure = 0.0", known));
        assert_eq!(run.code, 0, "{}", run.errors);
        assert!(run.output.contains("middle,,33.3333333333333"), "{known}: {}", run.output);
    }
}

/// An open gap of no conductance is no obstacle for what has another way.
#[test]
fn an_open_gap_parts_the_bodies() {
    let (from, to, _) = NO_SOLUTION[0];
    let run = solve(DECK, &changed(from, to));
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("middle,,100,\n"), "{}", run.output);
}

#[test]
fn an_interaction_has_to_be_named_where_there_are_two() {
    let two = format!("{DECK}*SURFACE INTERACTION, NAME=OTHER\n");
    let unnamed = changed("interaction = \"JOINT\"\n", "");
    assert_eq!(solve(DECK, &unnamed).code, 0);
    let run = solve(&two, &unnamed);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    insta::assert_snapshot!(run.errors);
}

#[test]
fn every_mistake_of_the_scene_is_reported_at_once() {
    let scene = changed("thermal = 1.0", "thermal = -1.0").replace("master = \"cold\"", "master = \"clod\"");
    let run = solve(DECK, &scene.replace("area = 0.5", "area = -0.5"));
    for message in ["scene.toml:12: error[D014]", "scene.toml:16: error[D013]", "scene.toml:17: error[D014]"] {
        assert!(run.errors.contains(message), "{message}: {}", run.errors);
    }
}

#[test]
fn a_deck_with_errors_is_not_solved() {
    let run = solve(BROKEN, SCENE);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    assert!(run.errors.contains("deck.inp:4:5: error[T001]"), "{}", run.errors);
    insta::assert_snapshot!(run.errors);
}

#[test]
fn what_cannot_be_read_and_wrong_usage_end_with_2() {
    let folder = Folder::with(&[
        ("deck.inp", DECK),
        ("scene.toml", SCENE),
        ("no-deck.toml", &changed("deck.inp", "nothing.inp")),
    ]);
    let cases: [&[&str]; 6] = [
        &["solve"],
        &["solve", "nothing.toml"],
        &["solve", "no-deck.toml"],
        &["solve", "scene.toml", "--solver", "jacobi"],
        &["solve", "scene.toml", "--dialect", "fortran"],
        &["solve", "scene.toml", "-o", "nowhere/nodes.csv"],
    ];
    for arguments in cases {
        let run = folder.inpact(arguments);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}: {}", run.errors);
        assert!(!run.errors.is_empty(), "{arguments:?}");
    }
    let errors = |arguments: &[&str]| folder.inpact(arguments).errors;
    assert!(errors(&["solve", "nothing.toml"]).contains("cannot read `nothing.toml`"));
    assert!(errors(&["solve", "no-deck.toml"]).contains("cannot read `nothing.inp`"));
}

/// Refusals of the scene file hold for tables; their messages have the line and the remedy.
#[test]
fn errors_in_tables_end_with_1() {
    let tables = [
        ("node_file", "node,temperature_fixed,temperature_source\nfar,1,2\nhot,,\n"),
        (
            "link_file",
            "node_1,node_2,thermal,joule_heat_fraction\nhot,midle,1,\nhot,cold,1,5\nhot,hot,1,\nhot,cold,,\n",
        ),
        ("interface_file", "slave,master,area,clearance\nhot,cold,1,nan\nhot,cold,,0\nhot,clod,1,0\nhot,hot,1,0\n"),
        ("interface_file", "slave,master,area,fv4294967295\nhot,cold,1,1\n"),
    ];
    let mut shown = String::new();
    for (kind, table) in tables {
        let scene = format!("{SCENE}[[{kind}]]\nfile = \"table.csv\"\n");
        let folder = Folder::with(&[("deck.inp", DECK), ("scene.toml", &scene), ("table.csv", table)]);
        let run = folder.inpact(&["solve", "scene.toml"]);
        assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
        shown += &run.errors;
    }
    insta::assert_snapshot!(shown);
}

#[test]
fn a_table_beside_the_scene_that_is_not_there_ends_with_2() {
    for kind in ["node_file", "link_file", "interface_file"] {
        let scene = format!("{SCENE}[[{kind}]]\nfile = \"nothing.csv\"\n");
        let run = solve(DECK, &scene);
        assert!(run.errors.contains("nothing.csv"), "{}", run.errors);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{}", run.errors);
    }
}
