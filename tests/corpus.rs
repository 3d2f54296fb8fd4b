//! Reads public decks: each comes back byte for byte, and none makes the check panic or hang.
//!
//! The decks are no part of the project. The folder is taken from `INPACT_CORPUS`, or from `../shared/corpus` beside the
//! repository; where neither is there the test says so and checks nothing.

use inpact_parser::deck::{Keep, ScanOptions, Scanner, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::span::SourceId;
use inpact_parser::{json, model};
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
        let mut scanner = Scanner::new("x", ScanOptions { grammar, keep: Keep::Interpreted });
        bytes.chunks(4096).for_each(|piece| scanner.push(piece));
        let deck = scanner.finish();
        let (model, problems) = model::read(&deck, grammar);
        for found in inpact_validation::check(&deck, grammar, &model, &problems) {
            let length = bytes.len() as u64;
            assert!(found.primary.span.end <= length, "{}: {}", path.display(), found.message);
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
