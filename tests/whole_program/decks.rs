//! The sample decks are right, and between them use every keyword of the grammar.

use crate::program::{inpact, root, sample_decks};
use inpact_parser::deck::{Block, scan};
use inpact_parser::grammar::Grammar;
use std::collections::BTreeSet;

#[test]
fn the_samples_are_clean_but_for_notes() {
    for deck in sample_decks().iter().filter(|deck| !deck.starts_with("decks/faulty/")) {
        let run = inpact(&["check", "--format", "concise", deck]);
        let graver = run.output.lines().filter(|line| !line.contains(": note["));
        assert_eq!(graver.collect::<Vec<_>>(), Vec::<&str>::new());
        assert_eq!(run.code, 0, "{deck}");
    }
}

#[test]
fn every_keyword_of_the_grammar_stands_in_a_sample() {
    let grammar = Grammar::builtin();
    let mut used = BTreeSet::new();
    for deck in sample_decks() {
        let bytes = std::fs::read(root().join(&deck)).expect("readable");
        used.extend(scan(&deck, &bytes, grammar).blocks().iter().filter_map(Block::keyword_id));
    }
    let defined = grammar.keywords().filter(|(_, keyword)| keyword.definition().is_some());
    let missing: Vec<&str> =
        defined.filter(|(id, _)| !used.contains(id)).map(|(_, keyword)| keyword.name.as_str()).collect();
    assert_eq!(missing, Vec::<&str>::new(), "keywords that no sample uses");
}
