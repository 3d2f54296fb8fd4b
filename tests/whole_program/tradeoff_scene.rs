//! `inpact tradeoff --scene`: time and error of every solver, in every format, and what is said where there is nothing to measure.

use super::solve::edited;
use crate::program::{Folder, Run, inpact, root};
use serde_json::Value;

/// A Wheatstone bridge of temperature whose branches differ by twenty-four decades, so that no node is in series.
const BRIDGE: &str = "\
deck = \"deck.inp\"
[[node]]
name = \"hot\"
temperature = { fixed = 100.0 }
[[node]]
name = \"a\"
[[node]]
name = \"b\"
[[node]]
name = \"c\"
[[node]]
name = \"cold\"
temperature = { fixed = 20.0 }
[[link]]
nodes = [\"hot\", \"a\"]
thermal = 3.0e12
[[link]]
nodes = [\"hot\", \"b\"]
thermal = 1.0e-12
[[link]]
nodes = [\"a\", \"cold\"]
thermal = 7.0e-3
[[link]]
nodes = [\"b\", \"c\"]
thermal = 5.0e9
[[link]]
nodes = [\"c\", \"cold\"]
thermal = 1.1
[[link]]
nodes = [\"c\", \"hot\"]
thermal = 2.0
[[interface]]
slave = \"a\"
master = \"b\"
area = 1.0
clearance = 0.0
pressure = 0.0
";

const LINEAR: &str = "*SURFACE INTERACTION, NAME=JOINT\n*GAP CONDUCTANCE, PRESSURE\n10., 0.\n10., 1.\n";

/// Rises with the mean temperature.
const NONLINEAR: &str = "*SURFACE INTERACTION, NAME=JOINT\n*GAP CONDUCTANCE, PRESSURE\n10., 0., 0.\n90., 0., 100.\n";

fn bridge(deck: &str) -> Folder {
    Folder::with(&[("deck.inp", deck), ("scene.toml", BRIDGE)])
}

fn tradeoff(folder: &Folder, more: &[&str]) -> Run {
    folder.inpact(&[&["tradeoff", "--scene", "scene.toml", "--rounds", "1"], more].concat())
}

fn json(folder: &Folder, more: &[&str]) -> Value {
    let run = tradeoff(folder, &[&["--format", "json"], more].concat());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    serde_json::from_str(&run.output).expect("JSON")
}

/// The lines of the table by name, without what the processor and the day decide: times, whose order is that of the lines, and last digits of errors.
fn untimed(text: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut table: Vec<String> = Vec::new();
    for line in text.lines() {
        let is_row = ["direct", "mixed", "iterative"]
            .iter()
            .any(|solver| line.get(2..).is_some_and(|of| of.starts_with(solver)));
        if is_row {
            let cells: Vec<&str> = line[2..].split_whitespace().collect();
            let counts = &cells[cells.len() - 4..];
            let times = cells.iter().filter(|cell| cell.contains('.') && !cell.contains('e')).count();
            assert_eq!(times, 4, "{line}");
            let name = cells[..cells.len() - 13].join(" ");
            table.push(format!("{name} TIMES ERRORS {}\n", counts.join(" ")));
        } else {
            lines.push(format!("{line}\n"));
        }
    }
    table.sort();
    lines.extend(table);
    lines.concat()
}

#[test]
fn a_table_for_a_person() {
    let run = tradeoff(&bridge(LINEAR), &[]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    insta::assert_snapshot!(untimed(&run.output));
}

/// Keys of every solver.
const KEYS: [&str; 19] = [
    "solver",
    "tolerance",
    "methods",
    "given_up",
    "seconds",
    "phases",
    "node_error",
    "flow_error",
    "residual",
    "error_estimate",
    "condition",
    "newton_steps",
    "networks",
    "solves",
    "iterations",
    "factor_entries",
    "factor_bytes",
    "pareto",
    "reference",
];

#[test]
fn json_has_every_solver_at_every_tolerance() {
    let document = json(&bridge(LINEAR), &[]);
    assert_eq!(document["schema"], "inpact/tradeoff-solvers/1");
    assert_eq!((&document["procedure"], &document["times"]), (&"steady".into(), &serde_json::json!([0.0])));
    assert_eq!(document["reference"]["solver"], "elimination");
    let solvers = document["solvers"].as_array().expect("solvers");
    let failed = document["failed"].as_array().expect("failures");
    assert_eq!(solvers.len() + failed.len(), 15);
    for name in ["direct", "mixed", "iterative"] {
        for tolerance in [f64::EPSILON / 16.0, 1e-12, 1e-9, 1e-6, 1e-3] {
            let is_it = |of: &&Value| of["solver"] == name && of["tolerance"].as_f64() == Some(tolerance);
            assert_eq!(solvers.iter().chain(failed).filter(is_it).count(), 1, "{name} {tolerance}");
        }
    }
    for solver in solvers {
        let found: Vec<&String> = solver.as_object().expect("an object").keys().collect();
        assert!(found.len() == KEYS.len() && KEYS.iter().all(|key| solver.get(key).is_some()), "{found:?}");
        let tolerance = solver["tolerance"].as_f64().expect("a tolerance");
        for promised in ["residual", "error_estimate"] {
            assert!(solver[promised].as_f64().is_some_and(|number| number <= tolerance), "{promised}: {solver}");
        }
        assert!(solver["condition"].as_f64().is_some_and(|condition| condition > 0.5), "{solver}");
        let is_iterative = solver["solver"] == "iterative";
        assert_eq!(solver["factor_entries"] == 0, is_iterative, "{solver}");
        assert_eq!(solver["iterations"] == 0, !is_iterative, "{solver}");
    }
}

/// The front is that of the times and errors that are printed, the fastest first.
#[test]
fn the_front_is_what_nothing_beats() {
    let document = json(&bridge(LINEAR), &[]);
    let places: Vec<(f64, f64, bool)> = document["solvers"]
        .as_array()
        .expect("solvers")
        .iter()
        .map(|of| {
            let number = |key: &str| of[key].as_f64().expect("a number");
            (number("seconds"), number("node_error"), of["pareto"] == true)
        })
        .collect();
    assert!(places.is_sorted_by(|a, b| a.0 <= b.0));
    for &(time, error, on_front) in &places {
        assert!(time > 0.0);
        let beats = |&(other_time, other_error, _): &(f64, f64, bool)| {
            other_time <= time && other_error <= error && (other_time, other_error) != (time, error)
        };
        assert_eq!(on_front, !places.iter().any(beats), "{time} {error}");
    }
}

#[test]
fn a_table_for_a_spreadsheet_has_the_same() {
    let run = tradeoff(&bridge(LINEAR), &["--format", "csv"]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    let cells = |line: &str| line.split(',').count();
    let mut lines = run.output.lines();
    let header = lines.next().expect("a header");
    assert_eq!(lines.clone().count(), 15);
    assert!(lines.all(|line| cells(line) == cells(header)), "{}", run.output);
}

/// Every sample and the bridge with the usual solver, to all digits that there are.
#[test]
fn direct_is_right_at_any_contrast() {
    let mut scenes: Vec<String> = Vec::new();
    for folder in ["decks/scenes", "decks/scenes/ccx"] {
        for entry in std::fs::read_dir(root().join(folder)).expect("a folder") {
            let path = entry.expect("readable").path();
            let name = path.file_name().expect("a name").to_string_lossy().into_owned();
            if path.extension().is_some_and(|extension| extension == "toml") && name != "inpact.toml" {
                scenes.push(format!("{folder}/{name}"));
            }
        }
    }
    assert!(scenes.len() > 8, "{scenes:?}");
    for scene in &scenes {
        let run = inpact(&["tradeoff", "--scene", scene, "--rounds", "1", "--format", "json"]);
        assert_eq!(run.code, 0, "{scene}: {}", run.errors);
        is_right(&serde_json::from_str(&run.output).expect("JSON"));
    }
    for conductance in ["1e-290", "1e-30", "1.", "1e30", "1e290"] {
        let law = format!(
            "*SURFACE INTERACTION, NAME=JOINT\n*GAP CONDUCTANCE, PRESSURE\n{conductance}, 0.\n{conductance}, 1.\n"
        );
        is_right(&json(&bridge(&law), &[]));
    }
}

/// Direct to the last digit errs by less than 1e-12, compared with another solver.
fn is_right(document: &Value) {
    assert_eq!(document["reference"]["solver"], "elimination", "{document:#}");
    let solvers = document["solvers"].as_array().expect("solvers");
    let direct = solvers.iter().find(|of| of["solver"] == "direct" && of["tolerance"].as_f64() < Some(1e-15));
    let direct = direct.expect("direct to the last digit");
    for error in ["node_error", "flow_error"] {
        assert!(direct[error].as_f64().is_some_and(|error| error < 1e-12), "{direct:#}");
    }
}

#[test]
fn a_nonlinear_scene_is_solved_whole() {
    let document = json(&bridge(NONLINEAR), &[]);
    is_right(&document);
    for solver in document["solvers"].as_array().expect("solvers") {
        assert!(solver["newton_steps"].as_u64() > Some(0), "{solver:#}");
        assert!(solver["networks"].as_u64() > Some(2), "{solver:#}");
    }
}

#[test]
fn of_a_transient_the_start_and_one_increment() {
    let folder = edited("cooling", &[]);
    let run = tradeoff(&folder, &[]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    assert!(
        run.output.contains("a transient: the state at its start and one increment, to time 0.0125;"),
        "{}",
        run.output
    );
    let document = json(&folder, &[]);
    assert_eq!(document["procedure"], "transient");
    assert_eq!(document["times"], serde_json::json!([0.0, 0.0125]));
    is_right(&document);
    // With a tolerance it is the first increment that is tried, and never beyond the end.
    let document = json(&edited("cooling", &[("step = 0.0125", "tolerance = 1e-3\nfirst_step = 0.5")]), &[]);
    assert_eq!(document["times"], serde_json::json!([0.0, 0.5]));
    let document = json(&edited("cooling", &[("step = 0.0125", "step = 5.0")]), &[]);
    assert_eq!(document["times"], serde_json::json!([0.0, 0.6]));
}

/// Larger than the elimination is asked for: then the usual solver is the reference, and the report says what that means.
#[test]
fn a_large_scene_has_another_reference() {
    let mut scene = BRIDGE.to_owned();
    for number in 0..1000 {
        scene += &format!("[[node]]\nname = \"n{number}\"\n[[link]]\nnodes = [\"n{number}\", \"a\"]\nthermal = 1.0\n");
        scene += &format!("[[link]]\nnodes = [\"n{number}\", \"c\"]\nthermal = 2.0\n");
    }
    let folder = Folder::with(&[("deck.inp", LINEAR), ("scene.toml", &scene)]);
    let run = tradeoff(&folder, &[]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    let reference = run.output.lines().find(|line| line.starts_with("reference:"));
    assert_eq!(
        reference,
        Some(
            "reference: direct to the last digit (elimination would be slow on more than 1000 nodes); \
             the errors of direct last digit mean nothing: that is the same solver"
        )
    );
    let document = json(&folder, &[]);
    for solver in document["solvers"].as_array().expect("solvers") {
        let is_usual = solver["solver"] == "direct" && solver["tolerance"].as_f64() < Some(1e-15);
        assert_eq!(solver["reference"], is_usual, "{solver:#}");
    }
}

#[test]
fn where_nothing_is_left_to_a_solver_it_says_so() {
    let run = inpact(&["tradeoff", "--scene", "decks/scenes/four-nodes.toml", "--rounds", "1"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(
        run.output.contains("0 unknowns\n") && run.output.contains("nothing is left to any solver"),
        "{}",
        run.output
    );
}

#[test]
fn the_picture_is_well_formed_and_shows_every_solver() {
    let folder = bridge(LINEAR);
    let run = tradeoff(&folder, &["--plot", "a.svg", "-o", "a.txt"]);
    assert_eq!((run.code, run.output.as_str(), run.errors.as_str()), (0, "", ""));
    let svg = folder.read("a.svg");
    let document = roxmltree::Document::parse(&svg).expect("well-formed XML");
    let texts: Vec<&str> =
        document.descendants().filter(|node| node.tag_name().name() == "text").filter_map(|node| node.text()).collect();
    for wanted in
        ["direct last digit", "mixed 1e-3", "iterative 1e-12", "Pareto front", "time of a solution, ms", "scene.toml"]
    {
        assert!(texts.iter().any(|text| text.contains(wanted)), "{wanted} among {texts:?}");
    }
    // One a solver and a tolerance, and one in the legend.
    assert_eq!(document.descendants().filter(|node| node.tag_name().name() == "circle").count(), 16);
    assert!(folder.read("a.txt").starts_with("scene.toml with deck.inp: 5 nodes"));
}

/// The same findings as `solve` has, with the same exit code, and no report.
#[test]
fn faults_are_reported_as_solve_does() {
    let broken = LINEAR.replace("10., 1.", "10., 0.");
    let cases = [
        (LINEAR, BRIDGE.replace("master = \"b\"", "master = \"bee\"")),
        (LINEAR, BRIDGE.replace("thermal = 1.1", "thermal = -1.1")),
        (LINEAR, BRIDGE.replace("slave =", "interaction = \"JIONT\"\nslave =")),
        (LINEAR, format!("{BRIDGE}[[node]]\nname = \"island\"\ntemperature = {{ source = 3.0 }}\n")),
        (LINEAR, BRIDGE.replace("thermal = 3.0e12", "thermal = inf").replace("thermal = 7.0e-3", "thermal = inf")),
        (LINEAR, BRIDGE.replace("deck.inp", "nothing.inp")),
        (LINEAR, BRIDGE.replace("clearance = 0.0\n", "")),
        (broken.as_str(), BRIDGE.to_owned()),
    ];
    for (deck, scene) in cases {
        assert!(deck != LINEAR || scene != BRIDGE);
        let folder = Folder::with(&[("deck.inp", deck), ("scene.toml", &scene)]);
        for format in [&[][..], &["--format", "json"]] {
            let solve = folder.inpact(&[&["solve", "scene.toml"], format].concat());
            let run = tradeoff(&folder, &[format, &["-o", "a.txt", "--plot", "a.svg"]].concat());
            assert_eq!((run.code, run.output.as_str(), &run.errors), (solve.code, "", &solve.errors), "{scene}");
            assert!(run.code > 0 && !run.errors.is_empty(), "{scene}");
            assert_eq!(folder.names(), ["deck.inp", "scene.toml"]);
        }
    }
}

#[test]
fn wrong_usage_is_refused() {
    let folder = bridge(LINEAR);
    let errors = |arguments: &[&str]| {
        let run = folder.inpact(&[&["tradeoff"], arguments].concat());
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}");
        run.errors
    };
    let both = errors(&["deck.inp", "--nodes", "nodes.csv", "--scene", "scene.toml"]);
    let deck = errors(&["deck.inp", "--scene", "scene.toml"]);
    let neither = errors(&[]);
    insta::assert_snapshot!(format!("{both}\n{deck}\n{neither}"));
    assert!(errors(&["--scene", "scene.toml", "--sample", "5"]).contains("'--sample <ROWS>'"));
    assert!(errors(&["--scene", "nothing.toml"]).contains("cannot read `nothing.toml`"));
    assert!(errors(&["--scene", "scene.toml", "-o", "scene.toml"]).contains("scene.toml"));
    assert_eq!(folder.read("scene.toml"), BRIDGE);
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let folder = bridge(LINEAR);
    let run = folder.inpact_with_input(&["tradeoff", "--scene", "-", "--rounds", "1"], BRIDGE.as_bytes());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    assert!(run.output.starts_with("- with deck.inp"), "{}", run.output);
}
