//! `inpact.toml` and comments that silence a rule.

use crate::program::Folder;

/// T005 and P001 are errors here, K003 is a note.
const DECK: &str = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECT, PRESSURE
-1., 5.
2., 6.
";

/// Checks a deck; gives severity and code of each finding, sorted.
fn check(folder: &Folder, arguments: &[&str]) -> Vec<String> {
    let run = folder.inpact(&[&["check", "--format", "concise"], arguments].concat());
    assert_ne!(run.code, 2, "{}", run.errors);
    let severity = |line: &str| line.split(' ').nth(1).expect("a severity").to_owned();
    let mut found: Vec<String> = run.output.lines().map(severity).collect();
    found.sort();
    assert_eq!(run.code == 1, found.iter().any(|found| found.starts_with("error")), "{found:?}");
    found
}

#[test]
fn the_configuration_is_found_upward_from_the_deck() {
    let folder = Folder::with(&[("a/b/d.inp", DECK)]);
    let defaults = ["error[P001]", "error[T005]", "note[K003]"];
    assert_eq!(check(&folder, &["a/b/d.inp"]), defaults);
    folder.write("inpact.toml", "[rules]\nT005 = \"warning\"\nP001 = \"off\"\nK003 = \"error\"\n");
    assert_eq!(check(&folder, &["a/b/d.inp"]), ["error[K003]", "warning[T005]"]);
    // The nearest counts, alone.
    folder.write("a/inpact.toml", "[rules]\nT005 = \"note\"\n");
    assert_eq!(check(&folder, &["a/b/d.inp"]), ["error[P001]", "note[K003]", "note[T005]"]);
    folder.write("d.inp", DECK);
    assert_eq!(check(&folder, &["d.inp"]), ["error[K003]", "warning[T005]"]);
    assert_eq!(check(&folder, &["--isolated", "a/b/d.inp"]), defaults);
    assert_eq!(check(&folder, &["--config", "a/inpact.toml", "d.inp"]), ["error[P001]", "note[K003]", "note[T005]"]);
}

#[test]
fn a_deck_from_standard_input_takes_the_configuration_of_the_current_folder() {
    let folder = Folder::with(&[("inpact.toml", "[rules]\nT005 = \"off\"\nP001 = \"off\"\n")]);
    let run = folder.inpact_with_input(&["check", "--format", "concise", "-"], DECK.as_bytes());
    assert_eq!(run.code, 0, "{}", run.output);
    assert!(run.output.starts_with("-:2:2: note[K003]"), "{}", run.output);
}

#[test]
fn decks_in_different_folders_follow_their_own_configuration() {
    let folder = Folder::with(&[
        ("a/d.inp", DECK),
        ("a/inpact.toml", "[rules]\nT005 = \"off\"\nP001 = \"off\"\nK003 = \"off\"\n"),
        ("b/d.inp", DECK),
    ]);
    let run = folder.inpact(&["check", "--format", "concise", "a/d.inp", "b/d.inp"]);
    assert!(run.output.lines().all(|line| line.starts_with("b/d.inp:")), "{}", run.output);
    assert_eq!(run.output.lines().count(), 3);
}

#[test]
fn rules_are_ignored_for_some_paths() {
    let folder = Folder::with(&[
        ("legacy/old/d.inp", DECK),
        ("new/d.inp", DECK),
        ("inpact.toml", "[[ignore]]\npaths = [\"legacy/**\"]\nrules = [\"T005\", \"P001\"]\n"),
    ]);
    let all = ["error[P001]", "error[T005]", "note[K003]"];
    assert_eq!(check(&folder, &["legacy/old/d.inp"]), ["note[K003]"]);
    assert_eq!(check(&folder, &["new/d.inp"]), all);
    // Paths are relative to the configuration, wherever it is named from.
    let absolute = folder.path().join("legacy/old/d.inp");
    assert_eq!(check(&folder, &[absolute.to_str().expect("UTF-8")]), ["note[K003]"]);
    assert_eq!(check(&folder, &["--config", "inpact.toml", "legacy/old/d.inp"]), ["note[K003]"]);
    assert_eq!(check(&folder, &["--config", "./inpact.toml", "new/d.inp"]), all);
}

#[test]
fn a_path_that_is_ignored_may_be_an_included_file() {
    let folder = Folder::with(&[
        ("d.inp", "*INCLUDE, INPUT=parts/a.inp\n"),
        ("parts/a.inp", DECK),
        ("inpact.toml", "[[ignore]]\npaths = [\"parts/*.inp\"]\nrules = [\"T005\", \"P001\", \"K003\"]\n"),
    ]);
    assert_eq!(check(&folder, &["d.inp"]), Vec::<String>::new());
}

#[test]
fn dialect_release_and_includes_are_configured() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY, CONSTRAINT METHOD=DIRECT, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n1., 0.\n";
    let folder = Folder::with(&[("d.inp", deck), ("inpact.toml", "release = \"6.14\"\n")]);
    assert_eq!(check(&folder, &["d.inp"]), ["error[K015]"]);
    assert_eq!(check(&folder, &["--release", "2017", "d.inp"]), Vec::<String>::new(), "arguments count more");
    folder.write("inpact.toml", "dialect = \"calculix\"\n");
    assert_eq!(check(&folder, &["d.inp"]), ["warning[K001]"]);
    assert_eq!(check(&folder, &["--dialect", "abaqus", "d.inp"]), Vec::<String>::new());
    folder.write("d.inp", "*INCLUDE, INPUT=a.inp\n");
    folder.write("shared/a.inp", "*INCLUDE, INPUT=b.inp\n");
    folder.write("shared/deep/b.inp", DECK);
    folder.write("inpact.toml", "include-dirs = [\"shared\", \"shared/deep\"]\n");
    assert_eq!(check(&folder, &["d.inp"]).len(), 3);
    folder.write("shared/a.inp", "*INCLUDE, INPUT=deep/b.inp\n");
    folder.write("inpact.toml", "include-dirs = [\"shared\"]\nrelative-to = \"including-file\"\n");
    assert_eq!(check(&folder, &["d.inp"]).len(), 3);
}

#[test]
fn a_configuration_that_says_what_it_cannot_say_is_refused() {
    let cases = [
        ("colour = 1", "unknown field `colour`"),
        ("[rules]\nT999 = \"off\"", "there is no rule `T999`"),
        ("[rules]\nT001 = \"loud\"", "unknown variant `loud`"),
        ("release = \"1999\"", "`1999` is no release"),
        ("dialect = \"nastran\"", "unknown variant `nastran`"),
        ("[[ignore]]\npaths = [\"[\"]\nrules = [\"T001\"]", "`ignore.paths`"),
        ("[[ignore]]\npaths = [\"x\"]\nrules = [\"Q001\"]", "there is no rule `Q001`"),
        ("[[ignore]]\npath = [\"x\"]\nrules = []", "unknown field `path`"),
        ("rules = [", "TOML parse error"),
    ];
    for (text, message) in cases {
        let folder = Folder::with(&[("d.inp", DECK), ("mine.toml", text)]);
        let run = folder.inpact(&["check", "--config", "mine.toml", "d.inp"]);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{text}: {}", run.errors);
        assert!(run.errors.contains(message) && run.errors.contains("`mine.toml`"), "{text}: {}", run.errors);
        assert!(!run.errors.contains("nothing to report"), "{text}: {}", run.errors);
        folder.write("inpact.toml", text);
        for command in [&["check", "d.inp"][..], &["json", "d.inp"], &["fmt", "--check", "d.inp"]] {
            let run = folder.inpact(command);
            assert_eq!(run.code, 2, "{command:?} {text}: {}", run.errors);
            assert!(run.errors.contains("inpact.toml"), "{}", run.errors);
        }
    }
}

#[test]
fn a_configuration_that_is_not_there_and_one_too_many() {
    let folder = Folder::with(&[("d.inp", DECK)]);
    let run = folder.inpact(&["check", "--config", "nothing.toml", "d.inp"]);
    assert_eq!(run.code, 2);
    assert!(run.errors.contains("cannot read `nothing.toml`"), "{}", run.errors);
    assert_eq!(folder.inpact(&["check", "--config", "nothing.toml", "--isolated", "d.inp"]).code, 2);
}

#[test]
fn a_comment_silences_a_rule_for_the_next_block() {
    let table = |first: &str| format!("{first}*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 5.\n2., 6.\n");
    let ignore = "** inpact: ignore T005 -- measured from 5 on\n";
    let deck = format!("*SURFACE INTERACTION, NAME=A\n{}*SURFACE INTERACTION, NAME=B\n{}", table(ignore), table(""));
    let folder = Folder::with(&[("d.inp", &deck)]);
    let run = folder.inpact(&["check", "--format", "concise", "d.inp"]);
    assert_eq!(run.output, "d.inp:8:5: error[T005] pressure table starts at 5, above 0\n", "only of the next block");
}

#[test]
fn s_018_a_comment_that_silences_nothing_is_reported() {
    let deck = "*SURFACE INTERACTION, NAME=A\n** inpact: ignore T005, T001 -- neither\n\
                *GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0.\n2., 6.\n** inpact: ignore Z001\n** inpact: hush\n\
                *GAP HEAT GENERATION\n1., .5\n** inpact is a word that may stand in a comment\n";
    let folder = Folder::with(&[("d.inp", deck)]);
    let run = folder.inpact(&["check", "--format", "concise", "d.inp"]);
    let places: Vec<&str> = run.output.lines().filter_map(|line| line.split(" S").next()?.split(' ').next()).collect();
    assert_eq!(places, ["d.inp:2:19:", "d.inp:2:25:", "d.inp:6:19:", "d.inp:7:1:"], "{}", run.output);
    assert!(run.output.lines().all(|line| line.contains("warning[S018]")), "{}", run.output);
    assert_eq!(run.code, 0);
}

const PLAIN: &str = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n";
const NODES: &str = "node,clearance,area\n1,0.05,nan\n";
const EVAL: &[&str] = &["eval", "a.inp", "--nodes", "data/n.csv", "-o", "r.csv"];

/// Rules of node tables are configured as those of decks are.
#[test]
fn rules_about_data_have_the_severity_of_the_configuration() {
    let folder = Folder::with(&[("a.inp", PLAIN), ("data/n.csv", NODES)]);
    let said = || {
        let run = folder.inpact(EVAL);
        let written = folder.path().join("r.csv").exists();
        if written {
            std::fs::remove_file(folder.path().join("r.csv")).expect("a file that is there");
        }
        let found = run
            .errors
            .lines()
            .find(|line| line.contains("[D003]"))
            .map(|line| line.split(' ').nth(1).map(str::to_owned));
        (run.code, written, found.flatten().unwrap_or_default())
    };
    let expected = |code, written, found: &str| (code, written, found.to_owned());
    assert_eq!(said(), expected(0, true, "warning[D003]"));
    folder.write("inpact.toml", "[rules]\nD003 = \"off\"\n");
    assert_eq!(said(), expected(0, true, ""));
    folder.write("inpact.toml", "[rules]\nD003 = \"note\"\n");
    assert_eq!(said(), expected(0, true, "note[D003]"));
    folder.write("inpact.toml", "[rules]\nD003 = \"error\"\n");
    assert_eq!(said(), expected(1, false, "error[D003]"));
    folder.write("inpact.toml", "[[ignore]]\npaths = [\"data/*.csv\"]\nrules = [\"D003\"]\n");
    assert_eq!(said(), expected(0, true, ""));
    folder.write("inpact.toml", "[[ignore]]\npaths = [\"other/*.csv\"]\nrules = [\"D003\"]\n");
    assert_eq!(said(), expected(0, true, "warning[D003]"));
}

/// A finding made only after all rows were evaluated leaves no result either where it is made an error.
#[test]
fn a_note_about_rows_beyond_a_table_that_is_made_an_error_leaves_no_result() {
    let folder = Folder::with(&[("a.inp", PLAIN), ("data/n.csv", "node,clearance\n1,0.5\n")]);
    folder.write("inpact.toml", "[rules]\nD007 = \"error\"\n");
    let run = folder.inpact(EVAL);
    assert_eq!(run.code, 1, "{}", run.errors);
    assert!(run.errors.contains("error[D007]") && run.errors.contains("no result is written"), "{}", run.errors);
    assert!(!folder.path().join("r.csv").exists());
}

/// Nothing can be evaluated with a cell that is no number, whatever a configuration says.
#[test]
fn errors_of_data_cannot_be_configured_away() {
    for text in ["[rules]\nD002 = \"warning\"\n", "[[ignore]]\npaths = [\"*\"]\nrules = [\"D002\"]\n"] {
        let folder = Folder::with(&[("a.inp", PLAIN), ("data/n.csv", NODES), ("inpact.toml", text)]);
        let run = folder.inpact(EVAL);
        assert_eq!(run.code, 2, "{}", run.errors);
        assert!(run.errors.contains("`D002` (malformed-cell) is always an error"), "{}", run.errors);
    }
}

#[test]
fn findings_of_data_are_printed_for_github() {
    let folder = Folder::with(&[("a.inp", PLAIN), ("data/n.csv", NODES)]);
    let eval = folder.inpact(&[EVAL, &["--format", "github"]].concat());
    let plan = folder.inpact(&["plan", "a.inp", "--nodes", "data/n.csv", "--findings", "github"]);
    for run in [eval, plan] {
        assert_eq!(run.code, 0, "{}", run.errors);
        assert!(run.errors.contains("::warning file=data/n.csv,line=2"), "{}", run.errors);
        assert!(run.errors.contains("title=D003 non-finite::"), "{}", run.errors);
    }
}
