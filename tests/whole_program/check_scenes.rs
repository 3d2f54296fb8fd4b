//! `inpact check` of scenes: what `solve` finds in them, in every format, without solving them.

use crate::folders::git;
use crate::program::{Folder, Run, inpact, inpact_with_input, root};
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

const DECK: &str = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n0., 1.\n";

/// A key, a node, a number and an interaction that are wrong, in the scene and in a table beside it.
const WRONG: &str = "deck = \"a.inp\"\n[[node]]\nname = \"a\"\npotential = { fixd = 1.0 }\n[[node_file]]\nfile = \"n.csv\"\n\
                     [[link]]\nnodes = [\"a\", \"nowhere\"]\nelectrical = 1.0\n\
                     [[interface]]\ninteraction = \"B\"\nslave = \"a\"\nmaster = \"b\"\narea = -1.0\nclearance = 0.0\n";

const RIGHT: &str = "deck = \"a.inp\"\n[[node]]\nname = \"a\"\npotential = { fixed = 1.0 }\n[[node]]\nname = \"b\"\npotential = { fixed = 0.0 }\n\
                     [[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\nclearance = 0.0\n";

fn wrong() -> Folder {
    Folder::with(&[("a.inp", DECK), ("s.toml", WRONG), ("n.csv", "node,potential_fixed\nb,one\n")])
}

fn check(folder: &Folder, arguments: &[&str]) -> Run {
    folder.inpact(&[&["check"], arguments].concat())
}

#[test]
fn the_samples_have_nothing_to_report() {
    let mut scenes = Vec::new();
    for folder in ["decks/scenes", "decks/scenes/ccx"] {
        let entries = std::fs::read_dir(root().join(folder)).expect("samples");
        let names = entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned());
        let is_scene = |name: &String| {
            let extension = std::path::Path::new(name).extension();
            extension.is_some_and(|extension| extension == "toml") && name != "inpact.toml"
        };
        scenes.extend(names.filter(is_scene).map(|name| format!("{folder}/{name}")));
    }
    assert!(10 <= scenes.len(), "{scenes:?}");
    for scene in &scenes {
        let run = inpact(&["check", scene]);
        assert_eq!((run.code, run.output.as_str()), (0, ""), "{scene}: {}", run.errors);
        assert!(run.errors.ends_with("1 scene: nothing to report\n"), "{scene}: {}", run.errors);
    }
}

#[test]
fn everything_wrong_in_one_pass() {
    let folder = wrong();
    insta::assert_snapshot!(check(&folder, &["s.toml", "--format", "concise"]).shown());
    insta::assert_snapshot!(check(&folder, &["s.toml"]).shown());
    insta::assert_snapshot!(check(&folder, &["s.toml", "--format", "json"]).shown());
    insta::assert_snapshot!(check(&folder, &["s.toml", "--format", "github"]).shown());
    insta::assert_snapshot!(check(&folder, &["s.toml", "--statistics"]).shown());
}

/// Line for line what `solve` says, in each format that has lines.
#[test]
fn the_findings_are_those_of_solve() {
    let floating =
        RIGHT.replace("potential = { fixed = 1.0 }\n", "").replace("potential = { fixed = 0.0 }\n", "potential = {}\n");
    // Beyond the end of the table nothing is conducted.
    let open = RIGHT
        .replace("potential = { fixed = 0.0 }\n", "potential = {}\n")
        .replace("clearance = 0.0", "clearance = 2.0");
    let lacking = RIGHT.replace("clearance = 0.0\n", "");
    let apart = RIGHT.to_owned() + "[[link]]\nnodes = [\"a\", \"b\"]\nelectrical = inf\n";
    let of_deck = DECK.replace("20., 0.\n0., 1.\n", "20., 1.\n0., 0.\n");
    for (deck, scene, code) in [
        (DECK, WRONG, "D011"),
        (DECK, &floating, "D016"),
        (DECK, &open, "D016"),
        (DECK, &apart, "D017"),
        (DECK, &lacking, "D018"),
        (&of_deck, RIGHT, "T001"),
    ] {
        let folder = Folder::with(&[("a.inp", deck), ("s.toml", scene), ("n.csv", "node,potential_fixed\nb,one\n")]);
        for format in ["concise", "full", "json", "github"] {
            let solved = folder.inpact(&["solve", "s.toml", "--findings", format]);
            let checked = check(&folder, &["s.toml", "--format", format]);
            assert_eq!(checked.code, 1, "{}", checked.errors);
            assert_eq!((solved.code, solved.errors.as_str()), (1, checked.output.as_str()), "{format}");
            assert!(checked.output.contains(code), "{code}: {}", checked.output);
        }
    }
}

/// Findings in the scene, a table and the deck are one SARIF document.
#[test]
fn sarif_of_scene_table_and_deck() {
    let folder = wrong();
    folder.write("b.inp", &DECK.replace("20., 0.\n0., 1.\n", "20., 1.\n0., 0.\n"));
    folder.write("t.toml", &RIGHT.replace("a.inp", "b.inp"));
    let run = check(&folder, &["s.toml", "t.toml", "--format", "sarif"]);
    let log: Value = serde_json::from_str(&run.output).unwrap_or_else(|error| panic!("{error}: {}", run.output));
    let results = log["runs"][0]["results"].as_array().expect("results");
    let file = |result: &Value| {
        result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].as_str().unwrap_or_default().to_owned()
    };
    for expected in ["s.toml", "b.inp", "n.csv"] {
        assert!(results.iter().any(|result| file(result) == expected), "{expected}: {}", run.output);
    }
}

#[test]
fn a_scene_is_known_by_its_name_or_its_beginning() {
    let folder = wrong();
    folder.write("job.scene", RIGHT);
    let said = |run: &Run| run.errors.clone();
    assert_eq!(said(&check(&folder, &["job.scene"])), "1 scene: nothing to report\n");
    assert_eq!(said(&check(&folder, &["job.scene", "a.inp"])), "1 deck and 1 scene: nothing to report\n");
    let run = folder.inpact_with_input(&["check", "-"], RIGHT.as_bytes());
    assert_eq!((run.code, said(&run).as_str()), (0, "1 scene: nothing to report\n"));
    let run = folder.inpact_with_input(&["check", "-", "--format", "concise"], WRONG.as_bytes());
    assert!(run.code == 1 && run.output.starts_with("-:"), "{}", run.output);
    let run = inpact_with_input(&["check", "-"], b"*HEADING\nA\n");
    assert_eq!(said(&run), "1 deck: nothing to report\n");
    // No deck and no scene either.
    let run =
        inpact_with_input(&["check", "-", "--format", "concise"], b"version https://git-lfs.github.com/spec/v1\n");
    assert!(run.output.contains("error[S011]"), "{}", run.output);
    folder.write("empty.toml", "");
    let run = check(&folder, &["empty.toml", "--format", "concise"]);
    assert!(run.code == 1 && run.output.contains("error[D011]"), "{}", run.output);
    assert_eq!(check(&folder, &["missing.toml"]).code, 2);
}

/// In a folder decks are checked, and what the configuration adds; a deck of a scene is judged as a deck all the same.
#[test]
fn scenes_are_named_and_folders_have_decks() {
    let folder = wrong();
    assert_eq!(check(&folder, &["."]).errors, "1 deck: nothing to report\n");
    let both = check(&folder, &[".", "s.toml", "--format", "concise"]);
    assert!(both.errors.starts_with("1 deck and 1 scene: "), "{}", both.errors);
    folder.write("inpact.toml", "include = [\"**/*.toml\"]\n");
    let run = check(&folder, &[".", "--format", "concise"]);
    assert!(run.errors.starts_with("1 deck and 1 scene: "), "{}", run.errors);
    assert!(run.output.contains("./s.toml:4"), "{}", run.output);
    // The severities of the configuration hold.
    folder.write("s.toml", &(RIGHT.to_owned() + "[[node_file]]\nfile = \"n.csv\"\n"));
    folder.write("n.csv", "node,potential_fixd\nc,1\n");
    let run = check(&folder, &["s.toml", "--format", "concise"]);
    let code = run.output.split_once('[').expect("a finding").1[..4].to_owned();
    folder.write("inpact.toml", &format!("[rules]\n{code} = \"error\"\n"));
    assert_eq!(check(&folder, &["s.toml"]).code, 1, "{}", run.output);
}

/// A scene is not mended, nor its deck unless that is named; afterwards it is judged with the deck as it is.
#[test]
fn fixing_mends_decks_that_are_named() {
    let blank = DECK.replace("20., 0.\n", "20., 0.\n\n");
    let folder = Folder::with(&[("a.inp", &blank), ("s.toml", RIGHT)]);
    let found = check(&folder, &["s.toml", "--format", "concise"]);
    assert!(found.output.contains("[S010]"), "{}", found.output);
    let statistics = check(&folder, &["s.toml", "--statistics"]);
    assert!(!statistics.output.contains("[*]") && !statistics.errors.contains("[*]"), "{}", statistics.output);
    let run = check(&folder, &["s.toml", "--fix", "--format", "concise"]);
    assert_eq!((folder.read("a.inp"), run.output), (blank, found.output));
    assert!(run.errors.contains("is mended by `inpact check --fix a.inp`"), "{}", run.errors);
    assert!(check(&folder, &["s.toml", "--diff"]).output.is_empty());
    let run = check(&folder, &["s.toml", "a.inp", "--fix"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    assert_eq!((folder.read("a.inp").as_str(), folder.read("s.toml").as_str()), (DECK, RIGHT));
}

/// What the scene is made from is never a target.
#[test]
fn nothing_is_written_over_what_a_scene_is_made_from() {
    let folder = wrong();
    for target in ["s.toml", "a.inp", "n.csv"] {
        let before = folder.read(target);
        let run = check(&folder, &["s.toml", "-o", target]);
        assert_eq!((run.code, folder.read(target)), (2, before), "{target}: {}", run.errors);
    }
}

/// Options of the laws count, as they do for `solve`.
#[test]
fn laws_of_scenes() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, USER\n";
    let folder = Folder::with(&[("a.inp", deck), ("s.toml", RIGHT)]);
    let run = check(&folder, &["s.toml", "--format", "concise"]);
    assert!(run.code == 1 && run.output.contains("[D018]"), "{}", run.output);
    let run = check(&folder, &["s.toml", "--user-library", "none.so"]);
    assert!(run.code == 2 && run.errors.contains("none.so"), "{}", run.errors);
}

/// A branch changes a scene where it changes the scene itself, its deck or a table of it.
#[test]
fn scenes_that_a_branch_changes() {
    let folder =
        Folder::with(&[("a.inp", DECK), ("s.toml", &(RIGHT.to_owned() + "[[node_file]]\nfile = \"n.csv\"\n"))]);
    folder.write("n.csv", "node,potential_fixed\nc,1\n");
    for arguments in [&["init", "-q"][..], &["add", "."], &["commit", "-qm", "first"], &["checkout", "-qb", "work"]] {
        git(folder.path(), arguments);
    }
    let since = || check(&folder, &["--since", "main", "s.toml"]).errors;
    assert_eq!(since(), "0 decks: nothing to report\n");
    for (name, text) in [("n.csv", "node,potential_fixed\nc,2\n"), ("a.inp", &format!("{DECK}** more\n"))] {
        folder.write(name, text);
        assert_eq!(since(), "1 scene: nothing to report\n", "{name}");
        git(folder.path(), &["checkout", "-q", "."]);
    }
}

/// A scene is checked again when its deck or a table of it changes.
#[test]
fn a_watched_scene_and_its_files() {
    let folder =
        Folder::with(&[("a.inp", DECK), ("s.toml", &(RIGHT.to_owned() + "[[node_file]]\nfile = \"n.csv\"\n"))]);
    folder.write("n.csv", "node,potential_fixed\nc,1\n");
    let arguments = ["check", "--watch", "--format", "concise", "s.toml"];
    let mut program = crate::program::command(folder.path(), &arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("started");
    let mut errors = BufReader::new(program.stderr.take().expect("a pipe"));
    let mut line = || {
        let mut line = String::new();
        errors.read_line(&mut line).expect("readable");
        line
    };
    assert_eq!(line(), "1 scene: nothing to report\n");
    assert_eq!(line(), "watching for changes; Ctrl-C ends it\n");
    folder.write("n.csv", "node,potential_fixed\nc,one\n");
    assert!(line().starts_with("1 scene: 1 error"));
    folder.write("n.csv", "node,potential_fixed\nc,1\n");
    assert_eq!(line(), "1 scene: nothing to report\n");
    folder.write("a.inp", &DECK.replace("20., 0.\n0., 1.\n", "20., 1.\n0., 0.\n"));
    assert!(line().starts_with("1 scene: "));
    program.kill().expect("killed");
    program.wait().expect("ended");
}
