//! `eval`, `plan` and `tradeoff` on rows that are made of the deck's mesh and of what its job wrote: the same as by way of a node table.

use crate::nodes_results::{PRESSED, ccx};
use crate::program::{Folder, Run, inpact};

const WELD: &str = "decks/weld-mesh/weld-mesh.inp";

/// A text without the time the run took.
fn timeless(text: &str) -> String {
    let line = |line: &str| match line.rsplit_once(", ") {
        Some((rest, time)) if rest.contains(" rows out") && time.ends_with(" s") => format!("{rest}, TIME\n"),
        _ => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

fn both_ways(folder: &Folder, results: &[&str], more: &[&str]) -> [Run; 2] {
    let mut of_results: Vec<&str> = Vec::new();
    for file in results {
        of_results.extend(["--results", file]);
    }
    let made = folder.inpact(&[&["nodes", "job.inp", "-o", "n.csv"], of_results.as_slice(), dialect()].concat());
    assert_eq!(made.code, 0, "{}", made.errors);
    let by_table = folder.inpact(&[&["eval", "job.inp", "--nodes", "n.csv"], more, dialect()].concat());
    let at_once = folder.inpact(&[&["eval", "job.inp"], of_results.as_slice(), more, dialect()].concat());
    [by_table, at_once]
}

fn dialect() -> &'static [&'static str] {
    &["--dialect", "calculix"]
}

#[test]
fn the_rows_of_results_are_evaluated_in_one_go_with_the_same_bytes() {
    let Some(folder) = ccx(PRESSED) else { return };
    for more in [&[][..], &["--threads", "1"], &["--accuracy", "reference", "--derivatives"], &["--outputs", "HTLA"]] {
        for results in [&["job.frd"][..], &["job.dat"], &["job.dat", "job.frd"]] {
            let [by_table, at_once] = both_ways(&folder, results, more);
            assert_eq!(at_once.code, 0, "{}", at_once.errors);
            assert_eq!(at_once.output, by_table.output, "{results:?} {more:?}");
            assert_eq!(at_once.output.lines().count(), 9);
        }
    }
    // All there is to know of the rows is said too.
    let run = folder.inpact(&["eval", "job.inp", "--results", "job.frd", "--dialect", "calculix"]);
    for said in [
        "8 rows in, 8 rows out",
        "rows of the mesh of job.inp with job.frd:",
        "clearance: COPEN of job.frd in 3, mesh moved by U of job.frd in 5 rows",
        "job.frd: note: not read: elements (1)",
    ] {
        assert!(run.errors.contains(said), "{said}: {}", run.errors);
    }
    let run = folder.inpact(&["eval", "job.inp", "--results", "job.frd", "--dialect", "calculix", "--format", "json"]);
    let lines: Vec<serde_json::Value> =
        run.errors.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines.last().expect("the last line")["nodes"]["results"][0]["used_states"], 2, "{}", run.errors);
}

#[test]
fn a_deck_with_a_mesh_is_evaluated_as_it_begins() {
    let deck = std::fs::read_to_string(crate::program::root().join(WELD)).expect("the sample");
    let folder = Folder::with(&[("job.inp", &deck)]);
    let nodes = folder.inpact(&["nodes", "job.inp", "-o", "n.csv"]);
    assert_eq!(nodes.code, 0, "{}", nodes.errors);
    let by_table = folder.inpact(&["eval", "job.inp", "--nodes", "n.csv"]);
    let at_once = folder.inpact(&["eval", "job.inp"]);
    assert_eq!((at_once.code, &at_once.output), (0, &by_table.output), "{}", at_once.errors);
    insta::assert_snapshot!(timeless(&at_once.errors));
    // The deck may come from a stream.
    assert_eq!(folder.inpact_with_input(&["eval", "-"], deck.as_bytes()).output, at_once.output);
    let to_file = folder.inpact(&["eval", "job.inp", "-o", "result.parquet"]);
    assert_eq!(to_file.code, 0, "{}", to_file.errors);
}

#[test]
fn plan_shows_what_is_read_of_the_results() {
    let Some(folder) = ccx(PRESSED) else { return };
    let run = folder.inpact(&["plan", "job.inp", "--results", "job.frd", "--dialect", "calculix"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.starts_with("plan for job.inp on mesh of job.inp with job.frd: 8 rows;"), "{}", run.output);
    let run = folder.inpact(&["plan", "job.inp", "--results", "job.frd", "--dialect", "calculix", "--format", "json"]);
    let plan: serde_json::Value = serde_json::from_str(&run.output).expect("JSON");
    assert_eq!((plan["rows"].as_u64(), plan["nodes"].as_str()), (Some(8), Some("mesh of job.inp with job.frd")));
    let headers: Vec<&str> =
        plan["columns"].as_array().expect("columns").iter().filter_map(|column| column["header"].as_str()).collect();
    assert_eq!(headers[..5], ["node", "interaction", "time", "clearance", "pressure"]);
}

#[test]
fn tradeoff_measures_on_the_mesh() {
    let run = inpact(&["tradeoff", WELD, "--rounds", "1"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("mesh of decks/weld-mesh/weld-mesh.inp"), "{}", run.output);
}

#[test]
fn decks_without_a_mesh_need_a_node_table() {
    let folder = Folder::with(&[("a.inp", "*SURFACE INTERACTION, NAME=I\n*GAP CONDUCTANCE\n1., 0.\n0., 1.\n")]);
    for command in ["eval", "plan", "tradeoff"] {
        let run = folder.inpact(&[command, "a.inp"]);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{}", run.errors);
        assert!(run.errors.contains("expected a node table (`--nodes FILE`)"), "{}", run.errors);
    }
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv", "--results", "job.frd"]);
    assert_eq!(run.code, 2, "{}", run.errors);
}

#[test]
fn a_state_without_a_geometry_ends_with_1() {
    let Some(folder) = ccx(PRESSED) else { return };
    // A displacement beyond all numbers whose squares are some.
    let frd = folder.read("job.frd");
    let (head, rest) = frd.split_once(" -4  DISP").expect("displacements");
    let at = rest.find(" -1        11").expect("node 11");
    let broken = format!("{head} -4  DISP{}{}{}", &rest[..at + 13], " 1.0000E+300", &rest[at + 25..]);
    folder.write("far.frd", &broken);
    for command in ["eval", "nodes"] {
        let run = folder.inpact(&[command, "job.inp", "--results", "far.frd", "--dialect", "calculix", "-o", "o.csv"]);
        assert_eq!(run.code, 1, "{}", run.errors);
        assert!(run.errors.contains("has no geometry at time 1.0: node 11 has the coordinate 1e300"), "{}", run.errors);
        assert!(!folder.names().contains(&"o.csv".to_owned()));
    }
    // Nothing is written over a result file.
    let run = folder.inpact(&["eval", "job.inp", "--results", "job.frd", "--dialect", "calculix", "-o", "job.frd"]);
    assert_eq!((run.code, folder.read("job.frd") == frd), (2, true), "{}", run.errors);
}
