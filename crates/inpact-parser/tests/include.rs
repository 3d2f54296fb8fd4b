//! Included files stand in their places, and what cannot be read is said.

use inpact_parser::deck::{Deck, FoundFile, IncludeOutcome, IncludedFiles, Keep, ScanOptions, Scanner, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::model;
use inpact_parser::span::SourceId;
use std::collections::HashMap;
use std::path::PathBuf;

/// Files in memory.
struct Memory(HashMap<&'static str, String>);

impl IncludedFiles for Memory {
    fn deck(&self) -> Option<PathBuf> {
        Some(PathBuf::from("deck"))
    }

    fn find(&mut self, name: &str, _from: &str) -> Result<FoundFile, String> {
        let found = self.0.contains_key(name);
        let file = FoundFile { name: name.to_owned(), path: PathBuf::from(name) };
        if found { Ok(file) } else { Err("no such file".to_owned()) }
    }

    fn read(&mut self, file: &FoundFile, scanner: &mut Scanner<'_>) -> Result<(), String> {
        scanner.push(self.0[file.name.as_str()].as_bytes());
        Ok(())
    }
}

fn read_with(files: &[(&'static str, &str)], keep: Keep) -> Deck {
    let options = ScanOptions { grammar: Grammar::builtin(), keep };
    let mut memory = Memory(files.iter().map(|(name, text)| (*name, (*text).to_owned())).collect());
    let mut scanner = Scanner::new("deck", options);
    scanner.push(memory.0["deck"].as_bytes());
    scanner.finish().with_includes(options, &mut memory)
}

fn outcomes(deck: &Deck) -> Vec<IncludeOutcome> {
    deck.includes().iter().map(|include| include.outcome.clone()).collect()
}

#[test]
fn s_51_rows_go_on_across_files() {
    let files = [
        (
            "deck",
            "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n3., 0.\n*INCLUDE, INPUT=rows\n1., 2.\n*FRICTION\n",
        ),
        ("rows", "2., 1.\n"),
    ];
    for keep in [Keep::Everything, Keep::Interpreted] {
        let deck = read_with(&files, keep);
        let (model, problems) = model::read(&deck, Grammar::builtin());
        assert_eq!(problems, []);
        let law = model.interactions[0].gap_electrical_conductance.as_ref().expect("a law");
        let table = law.clearance.as_ref().expect("a table");
        assert_eq!(*table.values, [3., 0., 0., 2., 1., 0., 1., 2., 0.]);
        assert_eq!(table.row_spans().map(|row| row.source().0).collect::<Vec<_>>(), [0, 1, 0]);
        assert_eq!(model.interactions[0].other.len(), 1, "the block goes on after the included rows");
        for (index, (_, text)) in files.iter().enumerate() {
            assert_eq!(deck.print(SourceId(u32::try_from(index).expect("few files"))), text.as_bytes());
        }
    }
}

#[test]
fn a_block_may_begin_in_an_included_file() {
    let files = [
        ("deck", "*INCLUDE, INPUT=head\n1., 0.\n"),
        ("head", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n"),
    ];
    let deck = read_with(&files, Keep::Interpreted);
    let (model, _) = model::read(&deck, Grammar::builtin());
    let law = model.interactions[0].gap_electrical_conductance.as_ref().expect("a law");
    assert_eq!(*law.clearance.as_ref().expect("a table").values, [1., 0., 0.]);
    assert_eq!(deck.include_chain(SourceId(1)).len(), 1);
}

#[test]
fn what_cannot_be_read_is_said_and_the_rest_is_read() {
    let text = "*INCLUDE, INPUT=none\n*INCLUDE, INPUT=deck.x, PASSWORD=p\n*INCLUDE\n*SURFACE INTERACTION, NAME=A\n";
    let deck = read_with(&[("deck", text)], Keep::Interpreted);
    let expected =
        [IncludeOutcome::Unreadable("no such file".to_owned()), IncludeOutcome::Encrypted, IncludeOutcome::Unnamed];
    assert_eq!(outcomes(&deck), expected);
    assert_eq!(model::read(&deck, Grammar::builtin()).0.interactions.len(), 1);
}

#[test]
fn s_54_files_that_include_one_another_end() {
    let files = [("deck", "*INCLUDE, INPUT=a\n"), ("a", "*INCLUDE, INPUT=b\n"), ("b", "*INCLUDE, INPUT=a\n*NODE\n")];
    let deck = read_with(&files, Keep::Interpreted);
    assert_eq!(outcomes(&deck)[0], IncludeOutcome::Cycle);
    assert_eq!(deck.sources().len(), 3);
    let itself = read_with(&[("deck", "*INCLUDE, INPUT=deck\n")], Keep::Interpreted);
    assert_eq!(outcomes(&itself), [IncludeOutcome::Cycle]);
}

#[test]
fn s_52_five_levels_are_read_and_no_more() {
    let files = [
        ("deck", "*INCLUDE, INPUT=1\n"),
        ("1", "*INCLUDE, INPUT=2\n"),
        ("2", "*INCLUDE, INPUT=3\n"),
        ("3", "*INCLUDE, INPUT=4\n"),
        ("4", "*INCLUDE, INPUT=5\n"),
        ("5", "*INCLUDE, INPUT=6\n"),
        ("6", "*NODE\n"),
    ];
    let deck = read_with(&files, Keep::Interpreted);
    assert_eq!(deck.sources().len(), 6);
    assert_eq!(outcomes(&deck)[0], IncludeOutcome::TooDeep);
}

#[test]
fn s_22_blanks_in_a_name_count_only_in_quotes() {
    let files = [("deck", "*INCLUDE, INPUT= a b \n*INCLUDE, INPUT=\"c d\"\n"), ("ab", ""), ("c d", "")];
    assert!(
        outcomes(&read_with(&files, Keep::Interpreted)).iter().all(|found| matches!(found, IncludeOutcome::Read(_)))
    );
}

#[test]
fn a_deck_without_includes_is_what_it_was() {
    let options = ScanOptions { grammar: Grammar::builtin(), keep: Keep::Everything };
    let deck = scan("deck", b"*NODE\n1, 2.\n", Grammar::builtin());
    assert_eq!(deck.clone().with_includes(options, &mut Memory(HashMap::new())), deck);
}
