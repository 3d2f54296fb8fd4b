//! *INCLUDE and *PARAMETER: where files are looked for, how findings name them, and what JSON keeps of them.

use crate::program::{Folder, inpact, inpact_with_input, root};
use serde_json::Value;

const MAIN: &str = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
*INCLUDE, INPUT=sub/rows.inp
*INCLUDE, INPUT=sub/more.inp
*GAP HEAT GENERATION
1., 2.
";

/// A deck whose second included file includes a third, `deep/b.inp`, which stands beside it.
fn scene() -> Folder {
    Folder::with(&[
        ("main.inp", MAIN),
        ("sub/rows.inp", "1., 0.\n3., 2.\n2., 1.\n"),
        ("sub/more.inp", "*SURFACE INTERACTION, NAME=B\n*INCLUDE, INPUT=deep/b.inp\n"),
        ("sub/deep/b.inp", "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n-1., 0.\n"),
    ])
}

const IN_MAIN: &str = "main.inp:6:5: error[P003] heat share 2 lies outside of 0 to 1";
const IN_ROWS: &str =
    "sub/rows.inp:3:5: error[T001] contact pressure 1 falls below 2 of the row before (included at main.inp:3)";
const IN_B: &str = "sub/deep/b.inp:2:1: error[P001] electrical conductance -1 is negative (included at sub/more.inp:2) (included at main.inp:4)";

/// Checks `main.inp`; gives the findings, a line each.
fn concise(folder: &Folder, options: &[&str]) -> Vec<String> {
    let run = folder.inpact(&[&["check", "--format", "concise", "main.inp"], options].concat());
    assert_eq!(run.code, 1, "{}", run.errors);
    run.output.lines().map(str::to_owned).collect()
}

#[test]
fn names_are_relative_to_the_deck() {
    let found = concise(&scene(), &[]);
    assert_eq!(found.len(), 3, "{found:#?}");
    // The rest is still checked.
    assert!(found.contains(&IN_MAIN.to_owned()) && found.contains(&IN_ROWS.to_owned()), "{found:#?}");
    let missing = found.iter().find(|line| line.contains("S012")).expect("S012");
    assert!(missing.starts_with("sub/more.inp:2:17: error[S012] `deep/b.inp`"), "{missing}");
    assert!(
        missing.contains("--relative-to including-file") && missing.ends_with("(included at main.inp:4)"),
        "{missing}"
    );
}

#[test]
fn names_are_relative_to_the_deck_wherever_the_program_runs() {
    let folder = scene();
    let deck = folder.path().join("main.inp");
    let run = inpact(&["check", "--format", "concise", deck.to_str().expect("UTF-8")]);
    assert_eq!(run.output.matches("error[T001]").count(), 1, "{}", run.output);
}

#[test]
fn another_folder_or_the_including_file_can_be_what_names_are_relative_to() {
    for options in [
        &["--relative-to", "including-file"][..],
        &["--include-dir", "sub"],
        &["--include-dir", "no", "--include-dir", "sub"],
    ] {
        let mut found = concise(&scene(), options);
        if options[0] == "--relative-to" {
            // `main.inp` includes from its own folder, so its names are the same.
            assert!(!found.iter().any(|line| line.contains("S012")), "{found:#?}");
        }
        found.sort();
        assert_eq!(found, [IN_MAIN, IN_B, IN_ROWS], "{options:?}");
    }
}

#[test]
fn the_chain_of_includes_in_every_format() {
    let folder = scene();
    let check = |format| folder.inpact(&["check", "--include-dir", "sub", "--format", format, "main.inp"]).output;
    insta::assert_snapshot!("included_full", check("full"));
    let records: Vec<Value> = check("json").lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let chain_of = |code: &str| {
        let record = records.iter().find(|record| record["code"] == code).expect("a finding");
        (record["file"].clone(), record.get("included_at").cloned())
    };
    assert_eq!(chain_of("P003"), ("main.inp".into(), None));
    assert_eq!(chain_of("T001"), ("sub/rows.inp".into(), Some(serde_json::json!(["main.inp:3"]))));
    assert_eq!(chain_of("P001"), ("sub/deep/b.inp".into(), Some(serde_json::json!(["sub/more.inp:2", "main.inp:4"]))));
    assert!(check("github").contains("::error file=sub/deep/b.inp,line=2,col=1,"));
}

#[test]
fn a_file_that_includes_itself_is_said_once() {
    let folder = Folder::with(&[
        ("main.inp", "*INCLUDE, INPUT=b.inp\n*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n"),
        ("b.inp", "*INCLUDE, INPUT=./main.inp\n"),
    ]);
    let found = concise(&folder, &[]);
    assert_eq!(found.iter().filter(|line| line.contains("error[S013]")).count(), 1, "{found:#?}");
    assert!(found.iter().any(|line| line.starts_with("main.inp:3:1: error[T009]")), "{found:#?}");
}

#[test]
fn more_than_five_levels_are_too_deep() {
    let folder = Folder::with(&[("main.inp", "*INCLUDE, INPUT=1.inp\n")]);
    for level in 1..=5 {
        folder.write(&format!("{level}.inp"), &format!("*INCLUDE, INPUT={}.inp\n", level + 1));
    }
    folder.write("6.inp", "*NODE\n1, 0.\n");
    let found = concise(&folder, &[]);
    assert_eq!(found.len(), 1, "{found:#?}");
    assert!(found[0].starts_with("5.inp:1:17: error[S013]"), "{found:#?}");
    folder.write("5.inp", "*NODE\n1, 0.\n");
    let run = folder.inpact(&["check", "main.inp"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "five levels are allowed (S-52): {}", run.errors);
}

#[test]
fn a_deck_from_standard_input_includes_from_the_current_folder() {
    let run = scene().inpact_with_input(&["check", "--format", "concise", "-"], MAIN.as_bytes());
    assert!(run.output.contains("sub/rows.inp:3:5: error[T001]"), "{}", run.output);
    assert!(run.output.contains("(included at -:3)"), "{}", run.output);
}

#[test]
fn the_syntax_view_keeps_every_file_and_gives_every_file_back() {
    let folder = scene();
    let run = folder.inpact(&["json", "--view", "syntax", "--include-dir", "sub", "main.inp", "-o", "deck.json"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let document: Value = serde_json::from_str(&folder.read("deck.json")).expect("JSON");
    let sources: Vec<&str> =
        document["files"].as_array().expect("files").iter().filter_map(|file| file["source"].as_str()).collect();
    assert_eq!(sources, ["main.inp", "sub/rows.inp", "sub/more.inp", "sub/deep/b.inp"]);
    let run = folder.inpact(&["inp", "deck.json", "--into", "again"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    for source in sources {
        assert_eq!(folder.read(&format!("again/{source}")), folder.read(source), "{source}");
    }
    // One stream or file cannot hold them all.
    for arguments in [&["inp", "deck.json"][..], &["inp", "deck.json", "-o", "one.inp"]] {
        let run = folder.inpact(arguments);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}");
        assert!(run.errors.contains("--into"), "{}", run.errors);
    }
    assert!(!folder.names().contains(&"one.inp".to_owned()));
}

#[test]
fn no_file_is_written_outside_the_folder() {
    let folder = scene();
    folder.inpact(&["json", "--view", "syntax", "--include-dir", "sub", "main.inp", "-o", "deck.json"]);
    let json = folder.read("deck.json");
    for name in ["../escaped.inp", "sub/../../escaped.inp", "/escaped-from-inpact.inp"] {
        let run =
            folder.inpact_with_input(&["inp", "-", "--into", "again"], json.replace("sub/deep/b.inp", name).as_bytes());
        assert_ne!(run.code, 0, "{name}");
        assert!(run.errors.contains(name), "{}", run.errors);
        assert!(!folder.path().parent().expect("a parent").join("escaped.inp").exists());
        assert!(!std::path::Path::new("/escaped-from-inpact.inp").exists());
    }
}

#[test]
fn symbols_stand_in_the_json_with_their_values_and_come_back_as_symbols() {
    let json = inpact(&["json", "decks/fragments/parameters.inp"]);
    let document: Value = serde_json::from_str(&json.output).expect("JSON");
    let interaction = &document["interactions"]["CALIBRATED"];
    let rows = &interaction["gap_electrical_conductance"]["pressure"]["rows"];
    let closed = 1.0 / (5.0e-6 * 0.05f64.powi(2));
    assert_eq!(rows[1][0], serde_json::json!({"text": "<closed>", "value": closed}));
    // Defined below its use (S-61).
    assert_eq!(rows[1][1], serde_json::json!({"text": "<preload>", "value": 1.2e7}));
    let back = inpact_with_input(&["inp", "-"], json.output.as_bytes());
    assert_eq!(back.code, 0, "{}", back.errors);
    assert!(back.output.contains("<closed>, <preload>"), "{}", back.output);
    assert!(back.output.contains("closed = 1/(resistance*overlap)"), "{}", back.output);
    let lossless = inpact(&["json", "--view", "syntax", "decks/fragments/parameters.inp"]);
    let back = inpact_with_input(&["inp", "-"], lossless.output.as_bytes());
    let deck = std::fs::read_to_string(root().join("decks/fragments/parameters.inp")).expect("readable");
    assert_eq!(back.output, deck);
}

#[test]
fn a_08_integers_divide_as_integers() {
    let deck = "*PARAMETER\nsg = 5/4\n*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n<sg>, 0.\n";
    let folder = Folder::with(&[("a.inp", deck), ("n.csv", "node,clearance,pressure\n1,0,1\n")]);
    let run = folder.inpact(&["eval", "--release", "2022", "a.inp", "--nodes", "n.csv"]);
    assert_eq!(run.output, "node,WEIGHT,conductance,status\n1,0.5,1,closed\n", "{}", run.errors);
}

#[test]
fn what_is_wrong_with_parameters_is_said() {
    let deck = "*PARAMETER\na = 1 +\nb = nowhere*2\nc = 9**9**9**9**9\n*SURFACE INTERACTION, NAME=A\n\
                *GAP ELECTRICAL CONDUCTANCE, PRESSURE\n<d>, 0.\n";
    let found = concise(&Folder::with(&[("main.inp", deck)]), &[]);
    for (place, code) in [("2:", "S016"), ("3:", "S016"), ("4:", "S016"), ("7:", "S015")] {
        let is_meant = |line: &&String| line.starts_with(&format!("main.inp:{place}")) && line.contains(code);
        assert!(found.iter().any(|line| is_meant(&line)), "{place} {code}: {found:#?}");
    }
}
