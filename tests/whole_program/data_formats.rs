//! Findings in data in every output format of findings: with their place, and as one document where the format is one.

use crate::program::{Folder, Run};
use serde_json::Value;

const DECK: &str = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n0., 1.\n";

/// A cell behind a character that UTF-8, UTF-16 and people count differently.
const NODES: &str = "node,clearance\n\u{1F600},nan\n2,0\n";

const SCENE: &str = "deck = \"a.inp\"\n[[node]]\nname = \"a\"\npotential = { fixed = 1.0 }\n[[node_file]]\nfile = \"n.csv\"\n\
                     [[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = -1.0\nclearance = 0.0\n";

fn sarif(run: &Run) -> Value {
    let log: Value = serde_json::from_str(&run.errors).unwrap_or_else(|error| panic!("{error}: {}", run.errors));
    assert_eq!((&log["version"], &log["runs"][0]["columnKind"]), (&"2.1.0".into(), &"unicodeCodePoints".into()));
    log["runs"][0].clone()
}

fn result<'a>(run: &'a Value, code: &str) -> &'a Value {
    let results = run["results"].as_array().expect("results");
    let found = results.iter().find(|result| result["ruleId"] == code).unwrap_or_else(|| panic!("no {code}: {run}"));
    let rule =
        &run["tool"]["driver"]["rules"][usize::try_from(found["ruleIndex"].as_u64().expect("a rule")).expect("small")];
    assert_eq!(rule["id"], code);
    found
}

#[test]
fn sarif_of_a_node_table_is_one_document_with_the_cell_and_the_summary() {
    let folder = Folder::with(&[("a.inp", DECK), ("n.csv", NODES)]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv", "--format", "sarif"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let log = sarif(&run);
    let place = &result(&log, "D003")["locations"][0]["physicalLocation"];
    assert_eq!(place["artifactLocation"]["uri"], "n.csv");
    let region = &place["region"];
    let expected =
        [("startLine", 2), ("startColumn", 3), ("endLine", 2), ("endColumn", 6), ("byteOffset", 20), ("byteLength", 3)];
    for (key, value) in expected {
        assert_eq!(region[key], value, "{key}: {region}");
    }
    let invocation = &log["invocations"][0];
    assert_eq!(invocation["executionSuccessful"], true);
    let notes = invocation["toolExecutionNotifications"].to_string();
    assert!(notes.contains("2 rows in, 2 rows out"), "{notes}");
}

#[test]
fn sarif_of_a_scene_names_the_files_beside_it_from_here() {
    let folder = Folder::with(&[("s/a.inp", DECK), ("s/scene.toml", SCENE), ("s/n.csv", "node,area\nb,1\n")]);
    let run = folder.inpact(&["solve", "s/scene.toml", "--findings", "sarif"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
    let log = sarif(&run);
    let key = &result(&log, "D014")["locations"][0]["physicalLocation"];
    assert_eq!(key["artifactLocation"]["uri"], "s/scene.toml");
    assert_eq!((&key["region"]["startLine"], &key["region"]["startColumn"]), (&10.into(), &8.into()));
    let header = &result(&log, "D002")["locations"][0]["physicalLocation"];
    assert_eq!(header["artifactLocation"]["uri"], "s/n.csv");
    assert_eq!((&header["region"]["startLine"], &header["region"]["startColumn"]), (&1.into(), &6.into()));
}

/// What ends a run is in the document, and nothing stands below it.
#[test]
fn sarif_of_a_run_that_cannot_go_on_says_why() {
    let folder = Folder::with(&[("a.inp", DECK), ("n.csv", "node\n1\n")]);
    for (arguments, code, why) in [
        (["eval", "a.inp", "--nodes", "none.csv", "--format", "sarif"], 2, "cannot read `none.csv`"),
        (["eval", "a.inp", "--nodes", "n.csv", "--format", "sarif"], 1, "nothing of `a.inp` can be evaluated"),
    ] {
        let run = folder.inpact(&arguments);
        assert_eq!(run.code, code, "{}", run.errors);
        let invocation = &sarif(&run)["invocations"][0];
        assert_eq!(invocation["executionSuccessful"], false);
        assert!(invocation["toolExecutionNotifications"].to_string().contains(why), "{invocation}");
    }
}

/// A table from a stream is read once, and its lines are shown all the same; those of a Parquet file have none.
#[test]
fn the_full_format_shows_the_cell_also_of_a_stream() {
    let folder = Folder::with(&[("a.inp", DECK)]);
    let run = folder.inpact_with_input(&["plan", "a.inp", "--nodes", "-", "--findings", "full"], NODES.as_bytes());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(
        run.errors.contains("╭─[-:2:") && run.errors.contains("\u{1F600},nan") && run.errors.contains("───"),
        "{}",
        run.errors
    );
}
