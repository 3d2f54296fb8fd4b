//! Reads public decks: each comes back byte for byte, and none makes the check panic or hang.
//!
//! What `check` says of them, rule by rule, is a section of `docs/reliability.md`, which `INPACT_UPDATE=1` writes anew.
//!
//! The decks are no part of the project. The folder is taken from `INPACT_CORPUS`, or from `../shared/corpus` beside the
//! repository; where neither is there the test says so and checks nothing.

#[allow(dead_code, reason = "shared with the whole-program tests, which use all of it")]
#[path = "whole_program/program.rs"]
mod program;

use inpact_parser::deck::{Keep, ScanOptions, Scanner, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::span::SourceId;
use inpact_parser::{json, model};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};

#[expect(clippy::print_stderr, reason = "whoever runs the tests must learn that there was nothing to read")]
fn corpus() -> Vec<PathBuf> {
    fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
        let Ok(entries) = std::fs::read_dir(folder) else { return };
        for path in entries.flatten().map(|entry| entry.path()) {
            if path.is_dir() { collect(&path, files) } else { files.push(path) }
        }
    }
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/corpus");
    let folder = std::env::var_os("INPACT_CORPUS").map_or(beside, PathBuf::from);
    let mut files = Vec::new();
    collect(&folder, &mut files);
    if files.is_empty() {
        eprintln!("no corpus at `{}`: set INPACT_CORPUS to a folder of decks", folder.display());
    }
    files
}

#[test]
fn every_file_comes_back_byte_for_byte() {
    for path in corpus() {
        let bytes = std::fs::read(&path).expect("readable");
        let deck = scan("x", &bytes, Grammar::builtin());
        assert!(deck.print(SourceId::ROOT) == bytes, "{}", path.display());
    }
}

#[test]
fn every_file_is_checked() {
    let grammar = Grammar::builtin();
    for path in corpus() {
        let bytes = std::fs::read(&path).expect("readable");
        let findings = |keep| {
            let mut scanner = Scanner::new("x", ScanOptions { grammar, keep });
            bytes.chunks(4096).for_each(|piece| scanner.push(piece));
            let deck = scanner.finish();
            let (model, problems) = model::read(&deck, grammar);
            let found = inpact_validation::check(&deck, grammar, &model, &problems);
            (found, deck.lacks_rows())
        };
        let (found, _) = findings(Keep::Interpreted);
        let (by_ends, lacks) = findings(Keep::Ends);
        assert!(lacks || by_ends == found, "{}", path.display());
        for found in found {
            let length = bytes.len() as u64;
            assert!(found.primary.span.end() <= length, "{}: {}", path.display(), found.message);
            let lines = bytes.iter().filter(|byte| matches!(byte, b'\n' | b'\r')).count() as u64 + 1;
            assert!(found.primary.position.line <= lines, "{}: {}", path.display(), found.message);
        }
    }
}

#[test]
fn every_file_comes_back_from_json() {
    let grammar = Grammar::builtin();
    for path in corpus() {
        let bytes = std::fs::read(&path).expect("readable");
        let text = json::syntax::write(&scan("x", &bytes, grammar), grammar);
        let files = json::syntax::read(&text, grammar).expect("our own JSON");
        assert!(files == [("x".to_owned(), bytes)], "{}", path.display());
    }
}

/// The dialects with their names, and whether a deck was written for each by the folder that it is from.
const DIALECTS: [(&str, &str); 2] = [("abaqus", "Abaqus"), ("calculix", "CalculiX")];

fn dialect_of(path: &Path) -> &'static str {
    let path = path.to_string_lossy().to_ascii_lowercase();
    // CalculiX' own tests and examples, what reads its decks, and the tutorials that couple it.
    let is_of_calculix = ["calculix", "ccx"].iter().any(|name| path.contains(name));
    DIALECTS[usize::from(is_of_calculix)].0
}

/// What a rule found: in how many places of which files.
#[derive(Default)]
struct Found {
    /// One, or several where a rule is graver in some places.
    severities: BTreeSet<String>,
    name: String,
    places: usize,
    files: BTreeSet<String>,
}

/// What `check` says of every deck in the dialect that it was written for, by code.
fn findings(decks: &[PathBuf], dialect: &str) -> BTreeMap<String, Found> {
    let of_dialect = decks.iter().filter(|path| dialect_of(path) == dialect);
    let files: Vec<&str> = of_dialect.map(|path| path.to_str().expect("a name in UTF-8")).collect();
    let mut found: BTreeMap<String, Found> = BTreeMap::new();
    for some in files.chunks(100) {
        let arguments = ["check", "--isolated", "--exit-zero", "--format", "json", "--dialect", dialect];
        let run = program::run(program::command(&program::root(), &[&arguments[..], some].concat()), b"");
        assert_eq!(run.code, 0, "{}", run.errors);
        for line in run.output.lines() {
            let line: serde_json::Value = serde_json::from_str(line).expect("a finding");
            let text = |key: &str| line[key].as_str().expect("a text").to_owned();
            let of_rule = found.entry(text("code")).or_default();
            of_rule.severities.insert(text("severity"));
            of_rule.name = text("name");
            of_rule.places += 1;
            of_rule.files.insert(text("file"));
        }
    }
    found
}

/// What the rules bring up on decks that ran is a false alarm or a slip: the list is held, so that a change of a rule shows here.
#[test]
fn what_check_says_of_public_decks() {
    let is_deck = |path: &PathBuf| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("inp"));
    let decks: Vec<PathBuf> = corpus().into_iter().filter(is_deck).collect();
    if decks.is_empty() {
        return;
    }
    let mut section = format!(
        "## What `check` says of public decks\n\n\
         `INPACT_UPDATE=1 cargo test -p inpact-tests --test corpus what_check_says` with the decks in `INPACT_CORPUS`\n\n\
         {} decks, each in the dialect that it was written for. They are posted as they are: many are parts of decks, templates or tests of what a program refuses.\n",
        decks.len()
    );
    for (dialect, name) in DIALECTS {
        let count = decks.iter().filter(|path| dialect_of(path) == dialect).count();
        let _ = write!(
            section,
            "\n{name}, {count} decks:\n\n| rule | severity | findings | files |\n|---|---|---:|---:|\n"
        );
        for (code, Found { severities, name, places, files }) in findings(&decks, dialect) {
            let severity = severities.into_iter().collect::<Vec<_>>().join(", ");
            let _ = writeln!(section, "| {code} {name} | {severity} | {places} | {} |", files.len());
        }
    }
    let page = program::root().join("docs/reliability.md");
    if std::env::var_os("INPACT_UPDATE").is_some() {
        inpact_attack::page::write_section(&page, "corpus", &section).expect("writable");
    }
    let page = std::fs::read_to_string(page).expect("the page");
    // Other decks than those of the page may be at hand.
    let is_of_these = page.contains(&format!("\n{} decks, each in the dialect", decks.len()));
    assert!(!is_of_these || page.contains(section.trim()), "`docs/reliability.md` is out of date:\n{section}");
}
