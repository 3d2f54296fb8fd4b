//! Runs the pages of the rules: the examples in a rule's documentation are its test.
//!
//! A tag `calculix` or `release-6.14` says in which language the example is.
//!
//! A fenced block tagged `inp,expect` must bring up this rule and no other; `inp` must be clean;
//! `inp,fixed` is what the fix makes of the block before it, and is clean of this rule.

use inpact_parser::deck::{FoundFile, IncludedFiles, Keep, ScanOptions, Scanner, scan};
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::model;
use inpact_validation::RULES;
use inpact_validation::{Diagnostic, FixSafety, apply};
use inpact_validation::{FixKind, Rule};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// A fenced block of a page.
struct Example {
    tags: String,
    text: String,
}

impl Example {
    /// The tags that say what to expect, without those that say in which language.
    fn kind(&self) -> &'static str {
        let tags: Vec<&str> =
            self.tags.split(',').filter(|tag| !tag.starts_with("release-") && *tag != "calculix").collect();
        match tags.as_slice() {
            ["inp"] => "inp",
            ["inp", "expect"] => "inp,expect",
            ["inp", "fixed"] => "inp,fixed",
            _ => panic!("unknown tags `{}`", self.tags),
        }
    }
}

fn examples(page: &str) -> Vec<Example> {
    let mut examples: Vec<Example> = Vec::new();
    let mut open = false;
    for line in page.lines() {
        // A doc comment puts one blank before every line.
        let line = line.strip_prefix(' ').unwrap_or(line);
        match line.strip_prefix("```") {
            Some(_) if open => open = false,
            Some(tags) => {
                open = true;
                examples.push(Example { tags: tags.to_owned(), text: String::new() });
            }
            None if open => {
                let example = examples.last_mut().expect("a block is open");
                example.text += line;
                example.text.push('\n');
            }
            None => {}
        }
    }
    assert!(!open, "a block is not closed");
    examples
}

/// The files that an example may include.
struct Files;

impl IncludedFiles for Files {
    fn deck(&self) -> Option<PathBuf> {
        None
    }

    fn outside(&mut self, name: &str, _from: &str) -> Option<String> {
        name.ends_with("outside.inp").then(|| "decks".to_owned())
    }

    fn find(&mut self, name: &str, _from: &str) -> Result<FoundFile, String> {
        let is_there = matches!(name, "present.inp" | "itself.inp");
        let file = FoundFile { name: name.to_owned(), path: PathBuf::from(name) };
        if is_there { Ok(file) } else { Err("there is no such file".to_owned()) }
    }

    fn read(&mut self, file: &FoundFile, scanner: &mut Scanner<'_>) -> Result<(), String> {
        if file.name == "itself.inp" {
            scanner.push(b"*INCLUDE, INPUT=itself.inp\n");
        }
        Ok(())
    }
}

/// The language an example is in: its tags may name `calculix` or a release.
fn grammar_of(tags: &str) -> &'static Grammar {
    let release = tags.split(',').find_map(|tag| tag.strip_prefix("release-"));
    if tags.split(',').any(|tag| tag == "calculix") {
        return Box::leak(Box::new(Grammar::new(Dialect::Calculix, Release::NEWEST)));
    }
    match release {
        None => Grammar::builtin(),
        Some(release) => {
            let release = release.parse().expect("a release");
            Box::leak(Box::new(Grammar::new(Dialect::Abaqus, release)))
        }
    }
}

fn findings(text: &str, grammar: &Grammar) -> Vec<Diagnostic> {
    let deck = scan("example.inp", text.as_bytes(), grammar);
    let deck = deck.with_includes(ScanOptions { grammar, keep: Keep::Everything }, &mut Files);
    let (model, problems) = model::read(&deck, grammar);
    inpact_validation::check(&deck, grammar, &model, &problems)
}

fn shown(found: &[Diagnostic]) -> String {
    found
        .iter()
        .map(|found| format!("\n  {} at line {}: {}", found.code, found.primary.position.line, found.message))
        .collect()
}

/// The example after every fix of the rule has been applied.
fn fixed(text: &str, rule: &Rule, grammar: &Grammar) -> String {
    let of_rule = findings(text, grammar).into_iter().filter(|found| found.code == rule.code);
    let edits: Vec<_> = of_rule.filter_map(|found| found.fix).flat_map(|fix| fix.edits).collect();
    String::from_utf8(apply(text.as_bytes(), &edits)).expect("an example is UTF-8")
}

#[test]
fn every_example_does_what_it_says() {
    let mut failures = String::new();
    for rule in RULES {
        let mut fails = |what: String| failures += &format!("\n{} {}: {what}", rule.code, rule.name);
        let examples = examples(rule.documentation);
        for (index, example) in examples.iter().enumerate() {
            let grammar = grammar_of(&example.tags);
            match example.kind() {
                "inp,expect" => {
                    let found = findings(&example.text, grammar);
                    let codes: BTreeSet<&str> = found.iter().map(|found| found.code).collect();
                    if codes != BTreeSet::from([rule.code]) {
                        fails(format!("this should bring up {} alone:\n{}{}", rule.code, example.text, shown(&found)));
                    }
                }
                "inp" => {
                    let found = findings(&example.text, grammar);
                    if !found.is_empty() {
                        fails(format!("this should be clean:\n{}{}", example.text, shown(&found)));
                    }
                }
                "inp,fixed" => {
                    let before = &examples[index - 1].text;
                    let after = fixed(before, rule, grammar);
                    if after != example.text {
                        fails(format!("the fix should give:\n{}but gives:\n{after}", example.text));
                    }
                    if fixed(&after, rule, grammar) != after
                        || findings(&after, grammar).iter().any(|found| found.code == rule.code)
                    {
                        fails(format!("the finding is not gone from:\n{after}"));
                    }
                }
                kind => unreachable!("{kind}"),
            }
        }
        if !examples.iter().any(|example| example.kind() == "inp,expect") {
            fails("no example brings it up".to_owned());
        }
        if !examples.iter().any(|example| example.kind() != "inp,expect") {
            fails("no example shows how it should be".to_owned());
        }
        if (rule.fix != FixKind::None) != examples.iter().any(|example| example.kind() == "inp,fixed") {
            fails("a fix and an example of it go together".to_owned());
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn fixes_are_of_the_kind_that_the_rule_declares() {
    for rule in RULES {
        for example in examples(rule.documentation) {
            let grammar = grammar_of(&example.tags);
            for found in findings(&example.text, grammar).iter().filter(|found| found.code == rule.code) {
                let kind = match found.fix.as_ref().map(|fix| fix.safety) {
                    None => continue,
                    Some(FixSafety::Safe) => FixKind::Safe,
                    Some(FixSafety::ChangesMeaning) => FixKind::ChangesMeaning,
                };
                assert_eq!(kind, rule.fix, "{}", rule.code);
            }
        }
    }
}

#[test]
fn messages_read_alike() {
    for rule in RULES {
        for example in examples(rule.documentation) {
            let grammar = grammar_of(&example.tags);
            for found in findings(&example.text, grammar) {
                assert!(!found.message.ends_with('.'), "{}: {}", found.code, found.message);
                assert!(found.help.is_some() || found.note.is_some(), "{} says neither why nor what to do", found.code);
            }
        }
    }
}

#[test]
fn every_file_of_the_folder_is_listed() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/rules");
    let files = std::fs::read_dir(folder).expect("the folder is there");
    let codes: BTreeSet<String> =
        files.map(|file| file.expect("readable").file_name().to_string_lossy()[..4].to_uppercase()).collect();
    let listed: Vec<&str> = RULES.iter().map(|rule| rule.code).collect();
    assert!(listed.is_sorted(), "{listed:?}");
    assert_eq!(codes, listed.iter().map(|code| (*code).to_owned()).collect());
}

#[test]
fn the_list_of_rules() {
    let lines: Vec<String> = RULES
        .iter()
        .map(|rule| format!("{} {} {} {:?} {}", rule.code, rule.name, rule.severity, rule.fix, rule.source))
        .collect();
    insta::assert_snapshot!(lines.join("\n"));
}
