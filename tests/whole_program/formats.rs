//! The formats for other programs, `explain`, `completions` and `man`.

use crate::program::{Folder, command, inpact, root, run};
use serde_json::Value;

const FAULTY: &str = "decks/faulty/first-mistakes.inp";

fn sarif(folder: &Folder, decks: &[&str]) -> Value {
    let run = folder.inpact(&[&["check", "--format", "sarif"], decks].concat());
    serde_json::from_str(&run.output).expect("JSON")
}

/// Rule and fingerprint of each result.
fn fingerprints(log: &Value) -> Vec<(String, String)> {
    let results = log["runs"][0]["results"].as_array().expect("results");
    let of = |result: &Value| {
        let print = result["partialFingerprints"].as_object().expect("fingerprints").values().next().expect("one");
        (result["ruleId"].as_str().expect("an id").to_owned(), print.as_str().expect("text").to_owned())
    };
    results.iter().map(of).collect()
}

#[test]
fn github() {
    insta::assert_snapshot!(inpact(&["check", "--format", "github", FAULTY]).shown());
}

#[test]
fn github_escapes_what_would_end_a_command() {
    let folder = Folder::with(&[("a,b:50%.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n")]);
    let run = folder.inpact(&["check", "--format", "github", "a,b:50%.inp"]);
    assert!(run.output.starts_with("::error file=a%2Cb%3A50%25.inp,line=2,col=1,"), "{}", run.output);
    assert!(run.output.lines().all(|line| line.starts_with("::")), "{}", run.output);
}

#[test]
fn sarif_says_what_the_standard_asks_for() {
    let run = inpact(&["check", "--format", "sarif", FAULTY]);
    assert_eq!(run.code, 1);
    let log: Value = serde_json::from_str(&run.output).expect("JSON");
    assert_eq!(log["version"], "2.1.0");
    assert!(log["$schema"].as_str().is_some_and(|schema| schema.contains("sarif-2.1.0")));
    let part = &log["runs"][0];
    assert_eq!(part["tool"]["driver"]["name"], "inpact");
    let rules = part["tool"]["driver"]["rules"].as_array().expect("rules");
    let text = std::fs::read_to_string(root().join(FAULTY)).expect("readable");
    let lines: Vec<&str> = text.lines().collect();
    let found: Vec<String> = part["results"]
        .as_array()
        .expect("results")
        .iter()
        .map(|result| {
            let id = result["ruleId"].as_str().expect("an id");
            let index = usize::try_from(result["ruleIndex"].as_u64().expect("an index")).expect("small");
            assert_eq!(rules[index]["id"], id);
            assert!(["error", "warning", "note"].contains(&result["level"].as_str().expect("a level")));
            assert!(!result["message"]["text"].as_str().expect("a message").is_empty());
            let place = &result["locations"][0]["physicalLocation"];
            assert_eq!(place["artifactLocation"]["uri"], FAULTY);
            let number = |name: &str| usize::try_from(place["region"][name].as_u64().expect(name)).expect("small");
            let start = number("byteOffset");
            let marked = &text[start..start + number("byteLength")];
            assert!(lines[number("startLine") - 1][number("startColumn") - 1..].starts_with(marked), "{id}");
            format!("{id} {marked}")
        })
        .collect();
    let expected = ["K004 PRESURE", "P001 -1.0E6", "T001 1.0E7", "T004 1.0E-6", "S006 1.5-6", "R001 BUSBARS"];
    assert_eq!(found, expected);
}

#[test]
fn sarif_of_clean_and_of_many_decks() {
    let clean = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0.\n2., 1.\n";
    let folder =
        Folder::with(&[("clean.inp", clean), ("a.inp", &clean.replace("1., 0.", "-1., 0.")), ("b.inp", "*FOO\n")]);
    assert_eq!(sarif(&folder, &["clean.inp"])["runs"][0]["results"], serde_json::json!([]));
    let log = sarif(&folder, &["a.inp", "clean.inp", "b.inp", "clean.inp"]);
    let codes: Vec<String> = fingerprints(&log).into_iter().map(|(code, _)| code).collect();
    assert_eq!(codes, ["P001", "K001"]);
    // Also when one of them cannot be read.
    let log = sarif(&folder, &["nothing.inp", "b.inp", "nothing.inp"]);
    assert_eq!(fingerprints(&log).len(), 1);
}

#[test]
fn fingerprints_outlive_lines_inserted_above_and_tell_findings_apart() {
    let text = std::fs::read_to_string(root().join(FAULTY)).expect("readable");
    let folder = Folder::with(&[("d.inp", &text)]);
    let before = fingerprints(&sarif(&folder, &["d.inp"]));
    folder.write("d.inp", &format!("** a comment\n*PREPRINT, ECHO=NO\n** another\n{text}"));
    assert_eq!(fingerprints(&sarif(&folder, &["d.inp"])), before);
    // The same fault twice is two findings.
    let one = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n-1., 0.\n";
    let twice = &format!("*SURFACE INTERACTION, NAME=A\n{one}*SURFACE INTERACTION, NAME=B\n{one}");
    folder.write("d.inp", twice);
    let mut prints = fingerprints(&sarif(&folder, &["d.inp"]));
    let count = prints.len();
    assert_eq!(count, 2, "{prints:?}");
    prints.sort();
    prints.dedup();
    assert_eq!(prints.len(), count, "{prints:?}");
}

#[test]
fn statistics() {
    let decks = [FAULTY, "decks/fragments/user.inp"];
    let run = inpact(&[&["check", "--statistics"], &decks[..]].concat());
    assert_eq!(run.code, 1);
    insta::assert_snapshot!(run.shown());
    let run = inpact(&[&["check", "--statistics", "--format", "json"], &decks[..]].concat());
    let found: Value = serde_json::from_str(&run.output).expect("JSON");
    insta::assert_snapshot!(run.output);
    // As many as are printed without it.
    let all = inpact(&[&["check", "--format", "json"], &decks[..]].concat()).output.lines().count();
    let counts = found.as_array().expect("a list").iter().map(|rule| rule["count"].as_u64().expect("a number"));
    assert_eq!(counts.sum::<u64>(), all as u64);
    let folder = Folder::with(&[("clean.inp", "*HEADING\n")]);
    assert_eq!(folder.inpact(&["check", "--statistics", "--format", "json", "clean.inp"]).output, "[]\n");
    // What can be mended is marked.
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP COND\n1., 0.\n0., 1.\n*CONTACT PAIR, INTERACTION=B\nS, M\n";
    folder.write("short.inp", deck);
    let run = folder.inpact(&["check", "--statistics", "short.inp"]);
    assert!(run.output.contains("K003  [*] abbreviated-keyword"), "{}", run.output);
    assert!(run.output.contains("R001  [ ] undefined-interaction"), "{}", run.output);
    assert!(run.errors.contains("[*] `--fix` mends 1 finding"), "{}", run.errors);
}

#[test]
fn exit_zero_and_quiet() {
    let run = inpact(&["check", "--exit-zero", "--quiet", "--format", "concise", FAULTY]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    assert_eq!(run.output.lines().count(), 6);
    // A failure is no finding.
    let run = inpact(&["check", "--exit-zero", "--quiet", "no-such-deck.inp"]);
    assert_eq!(run.code, 2);
    assert!(run.errors.contains("cannot read `no-such-deck.inp`"), "{}", run.errors);
}

#[test]
fn colours_are_for_terminals_and_who_asks_for_them() {
    let coloured = |variables: &[(&str, &str)]| {
        let mut command = command(&root(), &["check", FAULTY]);
        command.env_remove("NO_COLOR").envs(variables.iter().copied());
        run(command, b"").output.contains('\u{1b}')
    };
    assert!(!coloured(&[]), "a pipe is no terminal");
    assert!(coloured(&[("CLICOLOR_FORCE", "1")]));
    assert!(!coloured(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]));
}

#[test]
fn a_rule_is_explained_by_code_or_name() {
    let page = inpact(&["explain", "T001"]);
    assert_eq!(page.code, 0);
    insta::assert_snapshot!(page.output);
    for name in ["t001", "not-ascending"] {
        assert_eq!(inpact(&["explain", name]).output, page.output, "{name}");
    }
}

#[test]
fn a_keyword_is_explained_however_it_is_spelt() {
    let page = inpact(&["explain", "GAP ELECTRICAL CONDUCTANCE"]);
    assert_eq!(page.code, 0);
    insta::assert_snapshot!(page.output);
    for names in [&["gap", "electrical", "conductance"][..], &["*Gap Electrical Conductance"], &["GAPE"], &["gap elec"]]
    {
        assert_eq!(inpact(&[&["explain"], names].concat()).output, page.output, "{names:?}");
    }
}

#[test]
fn what_cannot_be_explained_ends_with_2_and_a_suggestion() {
    let cases = [
        ("GAP ELECTRICAL CONDUCTNCE", "*GAP ELECTRICAL CONDUCTANCE"),
        ("not-ascendin", "`not-ascending`"),
        ("T0001", "`T001`"),
        ("zzzzzzzz", "`inpact explain --all`"),
        ("*NODE", "*NODE"),
    ];
    for (what, suggestion) in cases {
        let run = inpact(&["explain", what]);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{what}");
        assert!(run.errors.contains(suggestion), "{what}: {}", run.errors);
    }
    assert_eq!(inpact(&["explain"]).code, 2);
    assert_eq!(inpact(&["explain", "--all", "T001"]).code, 2);
}

#[test]
fn every_page_as_markdown() {
    let run = inpact(&["explain", "--all", "--format", "markdown"]);
    assert_eq!(run.code, 0);
    let mut is_code = false;
    let mut titles = Vec::new();
    for line in run.output.lines() {
        if line.starts_with("```") {
            is_code = !is_code;
        } else if let (false, Some(title)) = (is_code, line.strip_prefix("# ")) {
            titles.push(title.to_owned());
        }
    }
    assert!(!is_code, "every block of code ends");
    let rules = titles.iter().filter(|title| !title.starts_with('*'));
    let codes: Vec<&str> = rules.filter_map(|title| title.split(' ').next()).collect();
    assert!(codes.is_sorted(), "{codes:?}");
    for code in ["S001", "K001", "T001", "R001", "C001", "P001"] {
        assert!(codes.contains(&code), "{code}");
    }
    assert!(titles.iter().any(|title| title.starts_with("*GAP ELECTRICAL CONDUCTANCE")), "{titles:?}");
    let unique: std::collections::BTreeSet<&String> = titles.iter().collect();
    assert_eq!(unique.len(), titles.len());
}

#[test]
fn completions_and_manual_page() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let run = inpact(&["completions", shell]);
        assert_eq!(run.code, 0, "{}", run.errors);
        for word in ["inpact", "check", "explain", "fmt", "eval"] {
            assert!(run.output.contains(word), "{shell}: {word}");
        }
    }
    assert_eq!(inpact(&["completions", "cobol"]).code, 2);
    let run = inpact(&["man"]);
    assert_eq!(run.code, 0);
    assert!(run.output.contains(".TH inpact 1") && run.output.contains("inpact\\-check"), "{}", run.output);
}
