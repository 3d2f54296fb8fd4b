//! Runs the pages of the rules on geometry: the examples in a rule's documentation are its test.
//!
//! A fenced block tagged `inp,expect` must bring up this rule and no other, of decks or of geometry; `inp` must be clean.

use inpact_contact::{GEOMETRY_RULES, check_geometry};
use inpact_diagnostics::Diagnostic;
use inpact_parser::deck::scan;
use inpact_parser::grammar::Grammar;
use inpact_parser::mesh::{KeptRows, read};
use inpact_parser::model;
use inpact_validation::check_with;
use std::collections::BTreeSet;

/// The fenced blocks of a page with their tags.
fn examples(page: &str) -> Vec<(String, String)> {
    let mut examples: Vec<(String, String)> = Vec::new();
    let mut open = false;
    for line in page.lines() {
        // A doc comment puts one blank before every line.
        let line = line.strip_prefix(' ').unwrap_or(line);
        match line.strip_prefix("```") {
            Some(_) if open => open = false,
            Some(tags) => {
                open = true;
                examples.push((tags.to_owned(), String::new()));
            }
            None if open => {
                let (_, text) = examples.last_mut().expect("a block is open");
                *text += line;
                text.push('\n');
            }
            None => {}
        }
    }
    assert!(!open, "a block is not closed");
    examples
}

fn findings(text: &str) -> Vec<Diagnostic> {
    let grammar = Grammar::builtin();
    let deck = scan("example.inp", text.as_bytes(), grammar);
    let (model, problems) = model::read(&deck, grammar);
    let mesh = read(&deck, grammar, &model, &mut KeptRows(&deck)).expect("kept");
    assert_eq!(mesh.notes, [], "the mesh of an example is read whole:\n{text}");
    check_with(&deck, grammar, &model, &problems, check_geometry(&mesh, &model))
}

fn shown(found: &[Diagnostic]) -> String {
    let line =
        |found: &Diagnostic| format!("\n  {} at line {}: {}", found.code, found.primary.position.line, found.message);
    found.iter().map(line).collect()
}

#[test]
fn every_example_does_what_it_says() {
    let mut failures = String::new();
    for rule in GEOMETRY_RULES {
        let examples = examples(rule.documentation);
        let kinds: BTreeSet<&str> = examples.iter().map(|(tags, _)| tags.as_str()).collect();
        assert_eq!(kinds, BTreeSet::from(["inp", "inp,expect"]), "{}", rule.code);
        for (tags, text) in examples {
            let found = findings(&text);
            let codes: BTreeSet<&str> = found.iter().map(|found| found.code).collect();
            let expected = if tags == "inp" { BTreeSet::new() } else { BTreeSet::from([rule.code]) };
            if codes != expected {
                failures += &format!("\n{}: expected {expected:?} of\n{text}{}", rule.code, shown(&found));
            }
            for found in found.iter().filter(|found| found.code == rule.code) {
                assert!(
                    !found.message.ends_with('.') && found.help.is_some() && found.note.is_some(),
                    "{}",
                    found.code
                );
                assert_eq!(&*found.primary.file, "example.inp");
            }
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn the_list_of_rules() {
    let listed: Vec<String> =
        GEOMETRY_RULES.iter().map(|rule| format!("{} {} {}", rule.code, rule.name, rule.severity)).collect();
    let expected = [
        "G001 wrong-side warning",
        "G002 without-master note",
        "G003 deep-overclosure warning",
        "G004 beyond-cutoff warning",
        "G005 table-not-reached warning",
        "G006 node-based-surface warning",
    ];
    assert_eq!(listed, expected);
}

/// A comment in the deck silences a finding as it does those of other rules.
#[test]
fn a_finding_can_be_silenced() {
    let (_, text) = examples(GEOMETRY_RULES[0].documentation).swap_remove(0);
    let silenced = text.replace("*CONTACT PAIR", "** inpact: ignore G001\n*CONTACT PAIR");
    assert_eq!(shown(&findings(&silenced)), "");
}
