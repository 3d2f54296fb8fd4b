//! The work of every fuzz target, and the promises that it checks.
//!
//! One function a target, from bytes; a promise that is broken is a panic.
//! The same functions run on a fixed set of inputs in the tests of the workspace (`tests/fuzz_corpus.rs`),
//! so nothing here may depend on libFuzzer.
//!
//! Except in [`scan_and_print`], an input may hold several files with a NUL byte between them:
//! the first is the deck, the others are called `1`, `2`, … in its *INCLUDE lines.

use inpact_parser::deck::{Deck, FoundFile, IncludedFiles, Keep, ScanOptions, Scanner, scan};
use inpact_parser::expression::{Parameters, StatementLine, define, references, substitute};
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::mesh::{KeptRows, SeekableRows, read as read_mesh};
use inpact_parser::model::Model;
use inpact_parser::span::{SourceId, Span};
use inpact_parser::{json, model};
use inpact_validation::{Diagnostic, Edit, FixSafety, apply};
use std::io::Cursor;
use std::path::PathBuf;
use std::sync::LazyLock;

/// The rounds in which safe fixes must have mended what they can.
const MAX_ROUNDS: usize = 10;

/// Both dialects, each in its newest release.
static DIALECTS: LazyLock<[Grammar; 2]> =
    LazyLock::new(|| [Dialect::Abaqus, Dialect::Calculix].map(|dialect| Grammar::new(dialect, Release::NEWEST)));

/// Any bytes: the deck gives them back, and it is the same deck whatever the pieces are in which they come.
pub fn scan_and_print(bytes: &[u8]) {
    for grammar in &*DIALECTS {
        let deck = scan("deck", bytes, grammar);
        assert!(deck.print(SourceId::ROOT) == bytes, "the deck gives other bytes back");
        // The first byte says where the cuts are, so that the fuzzer can move them.
        let any_size = usize::from(bytes.first().copied().unwrap_or(0)) + 2;
        for keep in [Keep::Everything, Keep::Interpreted, Keep::Ends] {
            let options = ScanOptions { grammar, keep };
            let whole = in_pieces(bytes, bytes.len().max(1), options);
            for size in [1, any_size] {
                assert!(in_pieces(bytes, size, options) == whole, "pieces of {size} bytes give another deck");
            }
        }
    }
}

/// Any bytes as decks with includes: a model comes out, the same whether all rows are kept or only those of interest,
/// and the lossless JSON gives every file back.
pub fn read(bytes: &[u8]) {
    for grammar in &*DIALECTS {
        let full = deck_of(bytes, ScanOptions { grammar, keep: Keep::Everything });
        let lean = deck_of(bytes, ScanOptions { grammar, keep: Keep::Interpreted });
        let ((model, problems), (lean_model, lean_problems)) =
            (model::read(&full, grammar), model::read(&lean, grammar));
        assert!(said(&model) == said(&lean_model), "the model depends on what is kept");
        assert_eq!(format!("{problems:?}"), format!("{lean_problems:?}"), "the problems depend on what is kept");
        let files = json::syntax::read(&json::syntax::write(&full, grammar), grammar).expect("our own JSON");
        for (index, (_, text)) in files.iter().enumerate() {
            assert!(full.print(source_id(index)) == *text, "JSON gives other bytes back");
        }
        model_survives_json(&model);
    }
}

/// Any bytes as decks with includes: a mesh comes out, the same from rows that were kept and from the files, and its pairs have a geometry or a reason.
pub fn mesh(bytes: &[u8]) {
    let files: Vec<&[u8]> = bytes.split(|byte| *byte == 0).collect();
    for grammar in &*DIALECTS {
        let full = deck_of(bytes, ScanOptions { grammar, keep: Keep::Everything });
        let lean = deck_of(bytes, ScanOptions { grammar, keep: Keep::Interpreted });
        let (model, _) = model::read(&full, grammar);
        let kept = read_mesh(&full, grammar, &model, &mut KeptRows(&full)).expect("rows that were kept");
        let opened = (0..).zip(lean.sources()).map(|(index, source)| {
            let number: usize = source.name().parse().unwrap_or(0);
            (source_id(index), Cursor::new(files.get(number).copied().unwrap_or_default()))
        });
        let sought = read_mesh(&lean, grammar, &model, &mut SeekableRows::new(opened)).expect("files in memory");
        assert_eq!(format!("{kept:?}"), format!("{sought:?}"), "the mesh depends on what is kept");
        for pair in &kept.pairs {
            // A geometry that is none is an error, never a panic.
            let _ = kept.contact(pair, 1.0);
        }
    }
}

/// Any bytes as decks with includes: every finding lies in its file, the ends of tables have the findings of all rows or
/// miss some, and safe fixes come to an end without changing what the deck says.
pub fn check(bytes: &[u8]) {
    for grammar in &*DIALECTS {
        let options = ScanOptions { grammar, keep: Keep::Interpreted };
        let deck = deck_of(bytes, options);
        let of_all = findings(&deck, grammar);
        for found in &of_all {
            assert_in_its_file(&deck, found);
        }
        let ends = deck_of(bytes, ScanOptions { grammar, keep: Keep::Ends });
        let of_ends = findings(&ends, grammar);
        assert!(ends.lacks_rows() || of_ends == of_all, "the findings depend on what is kept");
        // Fixes of included files are the same fixes, so one file is enough.
        let mut text = bytes.to_vec();
        let before = said(&model::read(&scan("deck", &text, grammar), grammar).0);
        let mut fixed_all = false;
        for _ in 0..MAX_ROUNDS {
            let deck = scan("deck", &text, grammar);
            let edits: Vec<Edit> = safe_edits(&findings(&deck, grammar));
            fixed_all = edits.is_empty();
            if fixed_all {
                break;
            }
            let after = apply(&text, &edits);
            assert!(after != text, "a fix changes nothing");
            text = after;
            let said = said(&model::read(&scan("deck", &text, grammar), grammar).0);
            assert!(said == before, "safe fixes change the model");
        }
        assert!(fixed_all, "safe fixes go on after {MAX_ROUNDS} rounds");
    }
}

/// Any lines as the rows of *PARAMETER: problems lie in their lines, running them again gives the same, and the values
/// can be put in the place of their names.
pub fn expressions(bytes: &[u8]) {
    let run = || {
        let (mut parameters, mut problems) = (Parameters::new(), Vec::new());
        define(statement_lines(bytes), &mut parameters, &mut problems);
        (parameters, problems)
    };
    let (parameters, problems) = run();
    let length = bytes.len() as u64;
    for span in problems.iter().map(|problem| problem.span).chain(parameters.definitions().iter().map(|d| d.span)) {
        assert!(span.start() <= span.end() && span.end() <= length, "{span:?} lies outside of {length} bytes");
    }
    let (again, problems_again) = run();
    assert_eq!(format!("{:?}", parameters.definitions()), format!("{:?}", again.definitions()));
    assert_eq!(problems, problems_again);
    for reference in references(bytes) {
        assert!(bytes[reference.range.clone()].starts_with(b"<"), "a reference begins with `<`");
    }
    if let Ok(text) = str::from_utf8(bytes) {
        // Whether it can be done is the deck's affair; that it ends is ours.
        let _ = substitute(text, &parameters);
    }
}

/// Any bytes as JSON: what is read as a model can be written as a deck or is refused, and comes back from JSON.
pub fn json_in(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    // An error is an answer.
    let _ = json::view_of(&text);
    for grammar in &*DIALECTS {
        if let Ok(files) = json::syntax::read(&text, grammar) {
            for (name, bytes) in files {
                assert!(scan(&name, &bytes, grammar).print(SourceId::ROOT) == bytes, "the deck gives other bytes back");
            }
        }
    }
    let Ok(model) = json::model::read(&text) else { return };
    model_survives_json(&model);
    for grammar in &*DIALECTS {
        let Ok(deck) = model::print(&model, grammar) else { continue };
        let (again, _) = model::read(&scan("deck", deck.as_bytes(), grammar), grammar);
        let printed = model::print(&again, grammar).expect("what was printed once can be printed again");
        assert_eq!(printed, deck, "printing what was printed gives something else");
    }
}

/// Any bytes: formatting what is formatted changes nothing, and the deck says the same before and after.
pub fn format(bytes: &[u8]) {
    for grammar in &*DIALECTS {
        let before = scan("deck", bytes, grammar);
        let text = inpact_parser::format(&before, SourceId::ROOT, grammar);
        let after = scan("deck", &text, grammar);
        assert!(inpact_parser::format(&after, SourceId::ROOT, grammar) == text, "formatting twice changes something");
        let ((before, _), (after, _)) = (model::read(&before, grammar), model::read(&after, grammar));
        assert!(said(&before) == said(&after), "formatting changes the model");
    }
}

/// The files of one input: the deck, then what its *INCLUDE lines call `1`, `2`, ….
struct Files<'input>(Vec<&'input [u8]>);

impl IncludedFiles for Files<'_> {
    fn deck(&self) -> Option<PathBuf> {
        Some(PathBuf::from("0"))
    }

    fn find(&mut self, name: &str, _from: &str) -> Result<FoundFile, String> {
        let number: usize = name.parse().map_err(|_| "no such file".to_owned())?;
        if number >= self.0.len() {
            return Err("no such file".to_owned());
        }
        Ok(FoundFile { name: name.to_owned(), path: PathBuf::from(number.to_string()) })
    }

    fn read(&mut self, file: &FoundFile, scanner: &mut Scanner<'_>) -> Result<(), String> {
        let number: usize = file.path.to_str().and_then(|path| path.parse().ok()).ok_or("no such file")?;
        scanner.push(self.0[number]);
        Ok(())
    }
}

fn deck_of(bytes: &[u8], options: ScanOptions<'_>) -> Deck {
    let mut files = Files(bytes.split(|byte| *byte == 0).collect());
    let mut scanner = Scanner::new("deck", options);
    scanner.push(files.0[0]);
    scanner.finish().with_includes(options, &mut files)
}

fn in_pieces(bytes: &[u8], size: usize, options: ScanOptions<'_>) -> Deck {
    let mut scanner = Scanner::new("deck", options);
    bytes.chunks(size).for_each(|piece| scanner.push(piece));
    scanner.finish()
}

fn source_id(index: usize) -> SourceId {
    SourceId(u32::try_from(index).expect("an input has fewer files than bytes"))
}

fn statement_lines(bytes: &[u8]) -> impl Iterator<Item = StatementLine<'_>> {
    let mut start = 0;
    bytes.split(|byte| *byte == b'\n').map(move |text| {
        let span = Span::new(SourceId::ROOT, start, start + text.len() as u64);
        start = span.end() + 1;
        StatementLine { span, text }
    })
}

fn findings(deck: &Deck, grammar: &Grammar) -> Vec<Diagnostic> {
    let (model, problems) = model::read(deck, grammar);
    inpact_validation::check(deck, grammar, &model, &problems)
}

fn safe_edits(found: &[Diagnostic]) -> Vec<Edit> {
    let fixes = found.iter().filter_map(|found| found.fix.as_ref()).filter(|fix| fix.safety == FixSafety::Safe);
    fixes.flat_map(|fix| fix.edits.iter().cloned()).collect()
}

fn assert_in_its_file(deck: &Deck, found: &Diagnostic) {
    assert!(!found.message.is_empty() && !found.message.ends_with('.'), "{}: `{}`", found.code, found.message);
    let labels = std::iter::once(&found.primary).chain(&found.secondary).map(|label| label.span);
    let edits = found.fix.iter().flat_map(|fix| fix.edits.iter().map(|edit| edit.span));
    for span in labels.chain(edits) {
        let length = deck.source(span.source()).length();
        assert!(span.start() <= span.end() && span.end() <= length, "{}: {span:?} of {length} bytes", found.code);
    }
    let mut edits: Vec<Span> = found.fix.iter().flat_map(|fix| fix.edits.iter().map(|edit| edit.span)).collect();
    edits.sort();
    let overlap = edits.windows(2).any(|pair| pair[0].source() == pair[1].source() && pair[0].end() > pair[1].start());
    assert!(!overlap, "{}: the edits of a fix overlap", found.code);
}

/// A model comes back from the JSON it is written as.
fn model_survives_json(model: &Model) {
    let text = json::model::write(model, "deck");
    if let Err(error) = json::model::read(&text) {
        panic!("our own JSON is refused: {error}\n{text}");
    }
}

/// A model as text: a cell that is no number is NaN, which equals nothing.
fn said(model: &Model) -> String {
    let mut model = model.without_places();
    // Their order in print is left to chance, so only the definitions count.
    let parameters = std::mem::take(&mut model.parameters);
    format!("{:?}{model:?}", parameters.definitions())
}
