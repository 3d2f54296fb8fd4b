//! Decks as they are and changed by chance, through what every command does with them.
//!
//! A safe fix leaves what a deck says, by the reader of the project and by a second one that knows only the semantics
//! (`safe_fixes/oracle.rs`); `fmt` and `check --fix` come to an end after one run; every view of JSON gives the deck back.
//! Chance begins at the same number in every run. `INPACT_RUNS=50000` asks for that many decks instead of a few hundred, and with `INPACT_UPDATE=1` what they gave is
//! written into `docs/reliability.md`.
//!
//! The decks are those of the project and, where it is at hand, a folder of public ones (`INPACT_CORPUS`, or
//! `../shared/corpus` beside the repository).

#[path = "safe_fixes/oracle.rs"]
mod oracle;

#[path = "support/mutation.rs"]
mod mutation;

use inpact_parser::deck::{Deck, Keep, ScanOptions, Scanner, scan};
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::json;
use inpact_parser::model::{self, Model};
use inpact_parser::span::SourceId;
use inpact_validation::{Diagnostic, Edit, FixSafety, apply};
use mutation::{Chance, files, project};
use oracle::{Language, read as read_by_semantics};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The rounds in which safe fixes must have mended what they can.
const MAX_ROUNDS: usize = 10;

/// The most bytes of a changed deck, so that none takes long.
const MAX_BYTES: usize = 4000;

static DIALECTS: LazyLock<[Grammar; 2]> =
    LazyLock::new(|| [Dialect::Abaqus, Dialect::Calculix].map(|dialect| Grammar::new(dialect, Release::NEWEST)));

/// The number of safe fixes applied by themselves so far.
static SINGLE_FIXES: AtomicUsize = AtomicUsize::new(0);

static LANGUAGE: LazyLock<Language> = LazyLock::new(Language::read);

/// Lines that bring up the rules with safe fixes, and what stands around them in decks.
const LINES: &[&str] = &[
    "*ELSET, ELSET=E,",
    "GENERATE",
    "1, 10, 1",
    "*NSET, NSET=N,",
    "UNSORTED",
    "*STEP,",
    "NLGEOM",
    "PERTURBATION, NLGEOM=NO",
    "*STEP, NAME=LOAD,",
    "Heating up",
    "INC=100",
    "*BOUNDARY, TYPE=VELOCITY,",
    "FIXED",
    "*SURFACE INTERACTION, NAME=A,",
    "USER",
    "DEPVAR=2",
    "UNSYMM",
    "*SURFACE INTERACTION, NAME=B",
    "1.,",
    "*GAP ELECTRICAL CONDUCTANCE, PRESSURE,",
    "USR",
    "*GAP ELEC,",
    "PRES",
    "*GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=6",
    "*CONTACT PERMEABILITY, DEPENDENCIES=5",
    "*GAP CONDUCTANCE, DEPENDENCIES=14",
    "5.E6, 0., 20., 0., 0.1, 8., 1., 0.5, 3.",
    "5.E6, 0., 20., 0., 0.1, 8., 1., 0.5, *3.",
    "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18",
    "1., 2., 3., 4., 5., 6., 7., 8., 9.",
    "1., 2., 3., 4., 5., 6., 7., 8.",
    "9.",
    "10., 0.",
    "20., 1.",
    "<a>, 0.",
    "a = 5/4",
    "   ** second line of the title",
    "  ** a comment",
    "** a comment",
    "** inpact: ignore S009",
    "*HEADING",
    "*HEADING,",
    "*HEAD",
    "brake disc, run 12",
    "*PARAMETER",
    "*PARAMETER,",
    "a = 5 \\",
    "  ** 2",
    "b = (1 +",
    "*GAP HEAT GENERATION,",
    "*GAPH",
    "0.9, 0.3",
    "<a>, 0.5",
    "abc, 0.5",
    "*GAP RADIATION",
    "0.5, 0.5",
    "*CONTACT PAIR, INTERACTION=A,",
    "SLAVE, MASTER",
    "*END STEP",
    "*STATIC",
    "*FREQUENCY",
    "*COMPLEX FREQUENCY",
    "10,",
    "",
    " ",
    ",",
    "*",
    "*FRICTION,",
    "LAGRANGE",
    "0.3,",
    "*INCLUDE, FILE=1",
    "*INCLUDE, INPUT=a b",
    "*COUPLED TEMP,",
    "STEADY STATE",
    "*DYNAMIC, EXPLICIT",
    "*USER MATERIAL, CONSTANTS=2,",
    "UNSYMM",
    "*DEPVAR",
    "*SURF INT, NAME=C",
    "*PART, NAME=P",
    "*END PART",
    "SURFACE INTERACTION, NAME=X",
    "\u{FEFF}*SURFACE INTERACTION, NAME=Y",
    "*GAP CONDUCTANCE",
    "1.e\u{2212}3, 0.",
    "*SURFACE INTERACTION, NAME=U, USER=INTERACTION, PROPERTIES=10",
    "*CONTACT PROPERTY ASSIGNMENT",
    ", , A",
    "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR,",
    "PENALTY",
    "1.2345678901234568e-05, 0.30000000000000004",
];

fn decks() -> Vec<Vec<u8>> {
    [files(&project().join("fuzz/seeds/decks"), "inp"), files(&project().join("decks"), "inp")].concat()
}

/// A deck by chance: a few lines of a seed and a few of [`LINES`], with any line end.
fn changed(seeds: &[Vec<u8>], chance: &mut Chance) -> Vec<u8> {
    let mut lines: Vec<Vec<u8>> = Vec::new();
    if chance.below(3) > 0 {
        let seed = chance.one_of(seeds);
        lines = seed[..seed.len().min(MAX_BYTES / 2)].split(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
        for _ in 0..chance.below(3) {
            let at = chance.below(lines.len());
            lines.remove(at);
            if lines.is_empty() {
                break;
            }
        }
    }
    for _ in 0..=chance.below(12) {
        let at = chance.below(lines.len() + 1);
        let first = chance.below(LINES.len());
        // Lines that stand beside one another in the list make sense together.
        for line in &LINES[first..(first + 1 + chance.below(4)).min(LINES.len())] {
            let mut line = line.as_bytes().to_vec();
            match chance.below(14) {
                0 => line.insert(0, b' '),
                1 => line.extend(b" ,"),
                2 => line.extend(b", "),
                3 => line.make_ascii_lowercase(),
                4 if !line.is_empty() => {
                    let byte = chance.below(line.len());
                    line[byte] = chance.next().to_le_bytes()[0];
                }
                _ => {}
            }
            lines.insert(at, line);
        }
        if chance.below(2) == 0 {
            let end = (at + 5).min(lines.len());
            lines[at..end].reverse();
        }
    }
    let line_end: &[u8] = [&b"\n"[..], b"\r\n", b"\r"][chance.below(8).min(2) * usize::from(chance.below(4) == 0)];
    let mut deck = lines.join(line_end);
    if chance.below(2) == 0 {
        deck.extend_from_slice(line_end);
    }
    deck.truncate(MAX_BYTES);
    deck
}

fn findings(deck: &Deck, grammar: &Grammar) -> Vec<Diagnostic> {
    let (model, problems) = model::read(deck, grammar);
    inpact_validation::check(deck, grammar, &model, &problems)
}

/// The model of a deck as text; a cell that is no number is NaN, which equals nothing.
fn said(bytes: &[u8], grammar: &Grammar) -> String {
    said_by(&model::read(&scan("deck", bytes, grammar), grammar).0)
}

fn said_by(model: &Model) -> String {
    let mut model = model.without_places();
    // Their order in print is left to chance, so only the definitions count.
    let parameters = std::mem::take(&mut model.parameters);
    format!("{:?}{model:#?}", parameters.definitions())
}

fn safe_edits(found: &[Diagnostic]) -> Vec<Vec<Edit>> {
    let fixes = found.iter().filter_map(|found| found.fix.as_ref()).filter(|fix| fix.safety == FixSafety::Safe);
    fixes.map(|fix| fix.edits.clone()).collect()
}

/// Every safe fix by itself, then all until none is left: the deck says the same after each.
fn safe_fixes_change_nothing(bytes: &[u8], grammar: &Grammar) {
    let before = said(bytes, grammar);
    let is_abaqus = grammar.dialect() == Dialect::Abaqus;
    let by_semantics = if is_abaqus { read_by_semantics(bytes, &LANGUAGE) } else { Vec::new() };
    let compare = |after: &[u8], what: &str| {
        let said = said(after, grammar);
        assert!(said == before, "{what} changes the model:\n{}\n--- before\n{before}\n--- after\n{said}", shown(after));
        if is_abaqus {
            let again = read_by_semantics(after, &LANGUAGE);
            assert!(
                again == by_semantics,
                "{what} changes the reading:\n{}\n{by_semantics:#?}\n{again:#?}",
                shown(after)
            );
        }
    };
    let found = findings(&scan("deck", bytes, grammar), grammar);
    let fixes = safe_edits(&found);
    for fix in fixes.iter().take(30) {
        SINGLE_FIXES.fetch_add(1, Ordering::Relaxed);
        compare(&apply(bytes, fix), "a safe fix");
    }
    let mut text = bytes.to_vec();
    for round in 0.. {
        assert!(round < MAX_ROUNDS, "safe fixes go on after {MAX_ROUNDS} rounds");
        let edits = safe_edits(&findings(&scan("deck", &text, grammar), grammar)).concat();
        if edits.is_empty() {
            break;
        }
        text = apply(&text, &edits);
        compare(&text, "all safe fixes");
    }
}

/// The deck as `fmt` makes it says the same, and `fmt` leaves it alone.
fn formatting_changes_nothing(bytes: &[u8], grammar: &Grammar) {
    let deck = scan("deck", bytes, grammar);
    let text = inpact_parser::format(&deck, SourceId::ROOT, grammar);
    assert!(
        inpact_parser::format(&scan("deck", &text, grammar), SourceId::ROOT, grammar) == text,
        "formatting twice differs"
    );
    assert!(said(&text, grammar) == said(bytes, grammar), "formatting changes the model:\n{}", shown(&text));
}

/// The deck comes back from the lossless JSON byte for byte, and what it says from the model view.
fn json_gives_the_deck_back(bytes: &[u8], grammar: &Grammar) {
    let deck = scan("deck", bytes, grammar);
    assert!(deck.print(SourceId::ROOT) == bytes, "the deck gives other bytes back");
    let files = json::syntax::read(&json::syntax::write(&deck, grammar), grammar).expect("our own JSON");
    assert!(files == [("deck".to_owned(), bytes.to_vec())], "the lossless JSON gives other bytes back");
    let (model, _) = model::read(&deck, grammar);
    let text = json::model::write(&model, "deck");
    let again = json::model::read(&text).unwrap_or_else(|error| panic!("our own JSON is refused: {error}\n{text}"));
    let printed =
        model::print(&again, grammar).unwrap_or_else(|error| panic!("our own JSON is no deck: {error}\n{text}"));
    let (printed, _) = model::read(&scan("deck", printed.as_bytes(), grammar), grammar);
    let printed = json::model::write(&printed, "deck");
    assert!(
        without_spans(&printed) == without_spans(&text),
        "the deck of the JSON says something else:\n{text}\n{printed}"
    );
}

/// JSON without the lines that say where something stands.
fn without_spans(json: &str) -> String {
    json.lines().filter(|line| !line.trim_start().starts_with("\"span\"")).collect()
}

/// Findings and memory do not depend on what rows are kept, nor on the pieces the file comes in.
fn check_says_the_same(bytes: &[u8], grammar: &Grammar) {
    let mut scanner = Scanner::new("deck", ScanOptions { grammar, keep: Keep::Interpreted });
    bytes.chunks(7).for_each(|piece| scanner.push(piece));
    for found in findings(&scanner.finish(), grammar) {
        assert!(found.primary.span.end() <= bytes.len() as u64, "{} lies outside of the deck", found.code);
    }
}

fn shown(bytes: &[u8]) -> String {
    bytes.escape_ascii().to_string().replace("\\n", "\n")
}

/// Everything, in both dialects.
fn examine(bytes: &[u8]) {
    for grammar in &*DIALECTS {
        safe_fixes_change_nothing(bytes, grammar);
        formatting_changes_nothing(bytes, grammar);
        json_gives_the_deck_back(bytes, grammar);
        check_says_the_same(bytes, grammar);
    }
}

#[track_caller]
fn run(decks: impl IntoIterator<Item = Vec<u8>>) -> usize {
    let mut number = 0;
    for bytes in decks {
        let outcome = catch_unwind(AssertUnwindSafe(|| examine(&bytes)));
        assert!(outcome.is_ok(), "see above; deck {number} was\n{}", shown(&bytes));
        number += 1;
    }
    number
}

#[test]
fn our_own_decks() {
    assert!(run(decks()) > 20);
}

#[test]
fn decks_changed_by_chance() {
    let number = std::env::var("INPACT_RUNS").ok().and_then(|number| number.parse().ok());
    let seeds = decks();
    let mut chance = Chance(11);
    let run = run(std::iter::repeat_with(|| changed(&seeds, &mut chance)).take(number.unwrap_or(400)));
    if number.is_some() && std::env::var_os("INPACT_UPDATE").is_some() {
        write_section(run);
    }
}

/// Writes the findings of a long run, on the page of the figures of such runs.
fn write_section(decks: usize) {
    let path = project().join("docs/reliability.md");
    let executions = decks * DIALECTS.len();
    let single = SINGLE_FIXES.load(Ordering::Relaxed);
    let section = format!(
        "## Decks changed by chance\n\n\
         `INPACT_RUNS={decks} INPACT_UPDATE=1 cargo test -p inpact-tests --test safe_fixes decks_changed_by_chance`\n\n\
         {decks} decks made of the sample decks and of lines that bring up the rules with safe fixes, each in two dialects.\n\
         The commands are run as the functions they consist of, without their files.\n\
         The model is compared before and after, and in Abaqus' dialect a second reading, which knows the semantics and not the parser.\n\
         A run with a fault stops at it, and writes nothing here.\n\n\
         | what is done | executions | what must hold | faults |\n|---|---|---|---|\n\
         | `check` | {executions} | every finding lies in the deck | 0 |\n\
         | `check --fix` until nothing is left | {executions} | the deck says the same, and it comes to an end | 0 |\n\
         | one safe fix by itself | {single} | the deck says the same | 0 |\n\
         | `fmt` | {executions} | the deck says the same, and formatting it again changes nothing | 0 |\n\
         | `json`, then `inp` | {executions} | the deck says the same | 0 |\n\
         | `json --view syntax`, then `inp` | {executions} | the deck comes back byte for byte | 0 |\n"
    );
    inpact_attack::page::write_section(&path, "decks", &section).expect("writable");
}

/// Faulty fixes of legal decks from the past: the second reading sees each of them.
#[test]
fn the_second_reading_tells_decks_apart() {
    for (before, after) in [
        ("*ELSET, ELSET=E,\nGENERATE\n1, 5, 1\n", "*ELSET, ELSET=E\nGENERATE\n1, 5, 1\n"),
        ("*STEP,\nNLGEOM\n", "*STEP\nNLGEOM\n"),
        ("*BOUNDARY, TYPE=VELOCITY,\nFIXED\n", "*BOUNDARY, TYPE=VELOCITY\nFIXED\n"),
        ("*HEADING\n  ** title\n", "*HEADING\n** title\n"),
        ("*SURFACE INTERACTION, NAME=A,\nUSER\n", "*SURFACE INTERACTION, NAME=A\nUSER\n"),
        ("*GAP CONDUCTANCE, PRESSURE,\n\nUSER\n", "*GAP CONDUCTANCE, PRESSURE,\nUSER\n"),
        ("*GAP E, DEP=6\n1,2,3,4,5,6,7,8,*9\n", "*GAP E, DEP=6\n1,2,3,4,5,6,7,8\n*9\n"),
        ("*GAP C\n1., 2.\n", "*GAP H\n1., 2.\n"),
    ] {
        assert_ne!(
            read_by_semantics(before.as_bytes(), &LANGUAGE),
            read_by_semantics(after.as_bytes(), &LANGUAGE),
            "{before}"
        );
    }
    for (before, after) in [
        ("*GAPE, DEP=6\n1,2,3,4,5,6,7,8,9\n", "*GAP ELECTRICAL CONDUCTANCE, DEP=6\n1,2,3,4,5,6,7,8\n9\n"),
        ("*NODE,\n1, 0.\n  ** c\n\n2, 0.\n", "*NODE\n1, 0.\n** c\n2, 0.\n"),
    ] {
        assert_eq!(
            read_by_semantics(before.as_bytes(), &LANGUAGE),
            read_by_semantics(after.as_bytes(), &LANGUAGE),
            "{before}"
        );
    }
}

/// Public decks: safe fixes alone, since they are large.
#[test]
fn public_decks() {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/corpus");
    let folder = std::env::var_os("INPACT_CORPUS").map_or(beside, std::path::PathBuf::from);
    if !folder.is_dir() {
        return;
    }
    for extension in ["inp", "in", "inc"] {
        for bytes in files(&folder, extension).into_iter().filter(|bytes| bytes.len() < 200_000) {
            safe_fixes_change_nothing(&bytes, &DIALECTS[0]);
        }
    }
}
