//! Findings of the fuzz targets of `fuzz/`, each in the smallest form.

use inpact_parser::deck::{FoundFile, IncludedFiles, Keep, ScanOptions, Scanner, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::{json, model};
use std::path::PathBuf;

/// A file with one row, under every name.
struct OneRow;

impl IncludedFiles for OneRow {
    fn deck(&self) -> Option<PathBuf> {
        None
    }

    fn find(&mut self, name: &str, _from: &str) -> Result<FoundFile, String> {
        Ok(FoundFile { name: name.to_owned(), path: PathBuf::from(name) })
    }

    fn read(&mut self, _file: &FoundFile, scanner: &mut Scanner<'_>) -> Result<(), String> {
        scanner.push(b"2., 1.\n");
        Ok(())
    }
}

/// The rows after an *INCLUDE were a block of their own in JSON, which the lines then did not form.
#[test]
fn rows_after_an_include_come_back_from_the_lossless_json() {
    let text = b"*SURFACE INTERACTION, NAME=A\n*INCLUDE, INPUT=rows\n1., 2.\n*FRICTION\n";
    let grammar = Grammar::builtin();
    let options = ScanOptions { grammar, keep: Keep::Everything };
    let mut scanner = Scanner::new("deck", options);
    scanner.push(text);
    let deck = scanner.finish().with_includes(options, &mut OneRow);
    let files = json::syntax::read(&json::syntax::write(&deck, grammar), grammar);
    let expected = [("deck".to_owned(), text.to_vec()), ("rows".to_owned(), b"2., 1.\n".to_vec())];
    assert_eq!(files, Ok(expected.to_vec()));
}

/// A parameter whose text has a byte that is not UTF-8 has no value in the deck, and its JSON was refused.
#[test]
fn a_parameter_that_json_cannot_show_is_read_back() {
    let grammar = Grammar::builtin();
    let deck = scan("deck", b"*PARAMETER\nx = 'a\xFFb'\n", grammar);
    let (model, problems) = model::read(&deck, grammar);
    assert_eq!(problems.len(), 1, "S016");
    let back = json::model::read(&json::model::write(&model, "deck")).expect("our own JSON");
    assert_eq!(back.parameters.definitions().len(), 1);
}
