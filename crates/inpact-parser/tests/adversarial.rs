//! Decks that nobody writes by hand: one of everything, far too large.
//!
//! Each is read and answered with what it holds and with what is wrong with it.
//! Each is made twice, the second time of double size, and what the deck holds then must double or stay; where the cost
//! grows with the square, these sizes take minutes.

use inpact_parser::deck::{
    Deck, FoundFile, IncludeOutcome, IncludedFiles, Keep, LineNoteKind, Resolved, ScanOptions, Scanner, lines, scan,
};
use inpact_parser::expression::MAX_TEXT;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{self, Model};
use inpact_parser::span::SourceId;
use inpact_parser::{Problem, ProblemKind};
use std::path::PathBuf;

/// The number of each element of a deck.
const SIZES: [usize; 2] = [8_000, 16_000];

const TABLE: &str = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n";

/// Reads a deck that is checked, and makes sure that the same deck can be printed.
fn read(text: &[u8]) -> (Deck, Model, Vec<Problem>) {
    let grammar = Grammar::builtin();
    assert!(scan("deck", text, grammar).print(SourceId::ROOT) == text, "the deck gives other bytes back");
    let mut scanner = Scanner::new("deck", ScanOptions { grammar, keep: Keep::Interpreted });
    text.chunks(1 << 16).for_each(|piece| scanner.push(piece));
    let deck = scanner.finish();
    let (model, problems) = model::read(&deck, grammar);
    (deck, model, problems)
}

fn long_lines(deck: &Deck) -> u64 {
    deck.notes().iter().filter(|note| note.kind == LineNoteKind::TooLong).map(|note| note.lines).sum()
}

fn bytes(text: &str, count: usize) -> Vec<u8> {
    text.repeat(count).into_bytes()
}

#[test]
fn a_line_of_data_without_end() {
    for size in SIZES {
        let (deck, model, problems) = read(&[TABLE.as_bytes(), &bytes("1.,", size), b"\n"].concat());
        assert_eq!((deck.blocks().len(), long_lines(&deck)), (2, 1));
        let [Problem { kind: ProblemKind::TooManyItems { allowed: 3, given, .. }, .. }] = problems[..] else {
            panic!("{problems:?}");
        };
        assert!(given.abs_diff(size) <= 1, "{given}");
        let law = model.interactions[0].gap_electrical_conductance.as_ref().expect("a law");
        assert_eq!(*law.clearance.as_ref().expect("a table").values, [1.; 3]);
        let (_, _, problems) = read(&[TABLE.as_bytes(), &bytes("0", size), b"., 0.\n"].concat());
        assert!(
            matches!(&problems[..], [Problem { kind: ProblemKind::NumberTooLong { characters, .. }, .. }] if *characters == size + 1)
        );
    }
}

#[test]
fn a_keyword_line_and_a_comment_without_end() {
    for size in SIZES {
        let (deck, _, _) = read(&[&b"*"[..], &bytes("A", size), b"\n"].concat());
        assert_eq!((deck.blocks().len(), long_lines(&deck)), (1, 1));
        assert_eq!(deck.blocks()[0].keyword.as_ref().expect("a keyword").resolved, Resolved::Unknown);
        let (deck, _, problems) = read(&[&b"**"[..], &bytes("A", size), b"\n*NODE\n"].concat());
        assert_eq!((deck.blocks().len(), long_lines(&deck), problems.len()), (2, 0, 0));
    }
}

#[test]
fn asterisks_without_end() {
    for size in SIZES {
        assert_eq!(read(&bytes("*", size)).0.blocks().len(), 1, "a comment");
        let (deck, _, _) = read(&bytes("*\n", size));
        assert_eq!(deck.blocks().len(), size);
        let (deck, _, _) = read(&bytes(" *", size));
        assert_eq!((deck.blocks().len(), long_lines(&deck)), (1, 1));
    }
}

#[test]
fn keywords_without_end() {
    for size in SIZES {
        let (deck, _, problems) = read(&bytes("*NODE\n", size));
        assert_eq!((deck.blocks().len(), problems.len()), (size, 0));
        let (_, _, problems) = read(&bytes("*GAP ELECTRICAL CONDUCTANCE\n", size));
        assert_eq!(problems.len(), size, "each of them is misplaced");
        let (_, model, _) = read(&bytes("*SURFACE INTERACTION, NAME=A\n", size));
        assert_eq!((model.interactions.len(), model.set_aside.len()), (1, size - 1));
    }
}

#[test]
fn parameters_without_end() {
    for size in SIZES {
        let (deck, _, _) = read(&[&b"*SURFACE INTERACTION"[..], &bytes(", A", size), b"\n"].concat());
        let parameters = &deck.blocks()[0].keyword.as_ref().expect("a keyword").parameters();
        assert_eq!((parameters.len(), long_lines(&deck)), (size, 1));
        assert!(parameters.clone().all(|parameter| parameter.resolved == Resolved::Unknown));
        // One a line, each line the continuation of the one before.
        let (deck, _, _) = read(&[&b"*SURFACE INTERACTION"[..], &bytes(",\nNAME=A", size), b"\n"].concat());
        let parameters = &deck.blocks()[0].keyword.as_ref().expect("a keyword").parameters();
        assert_eq!((deck.blocks().len(), parameters.len(), long_lines(&deck)), (1, size, 0));
    }
}

#[test]
fn groups_without_end() {
    for size in SIZES {
        let rows: String = (0..size).map(|group| format!("2., 0., {group}.\n1., 1., {group}.\n")).collect();
        let (_, model, problems) = read(&[TABLE.as_bytes(), rows.as_bytes()].concat());
        let law = model.interactions[0].gap_electrical_conductance.as_ref().expect("a law");
        assert_eq!((law.clearance.as_ref().expect("a table").row_count(), problems.len()), (2 * size, 0));
        let (_, _, problems) = read(&[TABLE.as_bytes(), &bytes("x\n", size)].concat());
        assert_eq!(problems.len(), size);
    }
}

#[test]
fn quotes_without_end() {
    for size in SIZES {
        for quotes in ["\"", "\"a\"", "\"\",\"=\"", "\"'\\\""] {
            for odd in ["", "\""] {
                let line = [b"*SURFACE, NAME=", &bytes(quotes, size)[..], odd.as_bytes(), b"\n*NODE\n"].concat();
                let (deck, _, _) = read(&line);
                let keyword = deck.blocks()[0].keyword.as_ref().expect("a keyword");
                let is_odd = !odd.is_empty();
                assert_eq!(keyword.unterminated_quote().is_some(), is_odd, "{quotes}{odd}");
                assert_eq!(deck.blocks().len(), 2, "a quote ends with its line");
            }
        }
    }
}

#[test]
fn names_without_end() {
    for size in SIZES {
        let name = "A".repeat(size);
        let text = format!("*SURFACE INTERACTION, NAME={name}\n*CONTACT PAIR, INTERACTION={name}\n{name}, {name}\n");
        let (deck, model, _) = read(text.as_bytes());
        assert_eq!((model.interactions.len(), model.contact_pairs.len(), long_lines(&deck)), (1, 1, 3));
        let interaction = &model.contact_pairs[0].interaction.as_ref().expect("a name").name;
        assert!(model.interactions.contains_key(interaction));
        let text = format!("*PARAMETER\n{name} = 1\nb = {name} + '{name}'\n{TABLE}<{name}>, <x{name}>\n");
        let (_, model, problems) = read(text.as_bytes());
        assert_eq!(problems.len(), 2, "a text beyond {MAX_TEXT} bytes, and a name that is not defined");
        assert_eq!(model.parameters.definitions().len(), 2);
    }
}

#[test]
fn field_variables_without_end() {
    for number in ["999999999", "9999999999999999999999", "-1", "18446744073709551615"] {
        let option = format!("*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES={number}\n1., 0.\n");
        let (_, model, _) = read(format!("*SURFACE INTERACTION, NAME=A\n{option}").repeat(100).as_bytes());
        for interaction in model.all_interactions() {
            for found in interaction.tables() {
                assert!(found.table.width() <= 3 + model::MAX_FIELD_VARIABLES, "{number}");
            }
        }
    }
}

#[test]
fn carriage_returns_and_blank_lines() {
    for size in SIZES {
        for end in ["\r", "\r\n", "\n", "\n\r"] {
            let text = format!("*NODE{end}1, 0.{end}").repeat(size);
            let (deck, _, _) = read(text.as_bytes());
            assert_eq!(deck.blocks().len(), size, "{end:?}");
            let last = deck.blocks().last().expect("a block").span_of_keyword();
            let lines = lines::lines(text.as_bytes()).count() as u64;
            let line_ends = if end == "\n\r" { 4 } else { 2 };
            assert_eq!(lines, line_ends * size as u64, "{end:?}");
            assert_eq!(deck.positions(&[last])[0].line, lines - line_ends + 1, "{end:?}");
        }
        let (_, _, problems) = read(&[TABLE.as_bytes(), &bytes("\r", size), b"1., 0."].concat());
        assert_eq!(problems.len(), size, "a blank row each");
    }
}

/// One text under whatever name, so that a deck can include more files than anybody has.
struct OneText<'text>(&'text str);

impl IncludedFiles for OneText<'_> {
    fn deck(&self) -> Option<PathBuf> {
        None
    }

    fn find(&mut self, name: &str, _from: &str) -> Result<FoundFile, String> {
        if name == "none" {
            return Err("no such file".to_owned());
        }
        Ok(FoundFile { name: name.to_owned(), path: PathBuf::from(name) })
    }

    fn read(&mut self, _file: &FoundFile, scanner: &mut Scanner<'_>) -> Result<(), String> {
        scanner.push(self.0.as_bytes());
        Ok(())
    }
}

fn with_includes(deck: &str, file: &str) -> Deck {
    let options = ScanOptions { grammar: Grammar::builtin(), keep: Keep::Interpreted };
    let mut scanner = Scanner::new("deck", options);
    scanner.push(deck.as_bytes());
    scanner.finish().with_includes(options, &mut OneText(file))
}

fn count(deck: &Deck, is_meant: impl Fn(&IncludeOutcome) -> bool) -> usize {
    deck.includes().iter().filter(|include| is_meant(&include.outcome)).count()
}

#[test]
fn includes_without_end() {
    for size in SIZES {
        let missing = with_includes(&"*INCLUDE, INPUT=none\n".repeat(size), "");
        assert_eq!(count(&missing, |outcome| matches!(outcome, IncludeOutcome::Unreadable(_))), size);
        let names: String = (0..size).map(|number| format!("*INCLUDE, INPUT={number}\n")).collect();
        let deck = with_includes(&format!("{TABLE}{names}"), "1., 0.\n");
        assert_eq!((deck.sources().len(), deck.blocks()[1].continued_in().len()), (size + 1, size));
        let (model, _) = model::read(&deck, Grammar::builtin());
        let law = model.interactions[0].gap_electrical_conductance.as_ref().expect("a law");
        assert_eq!(law.clearance.as_ref().expect("a table").row_count(), size);
    }
}

/// Ten files of twenty kilobytes that include one another would come to thirty thousand of them, five levels deep.
#[test]
fn files_that_include_one_another_over_and_over() {
    let names: String = (0..10).map(|number| format!("*INCLUDE, INPUT={number}\n")).collect();
    let deck = with_includes(&names, &format!("{names}**{}\n", "x".repeat(20_000)));
    let read: u64 = deck.sources().iter().map(inpact_parser::deck::Source::length).sum();
    assert!(read < 20 << 20, "{read} bytes were read");
    assert!(count(&deck, |outcome| matches!(outcome, IncludeOutcome::TooDeep)) > 0);
    let refused = |outcome: &IncludeOutcome| matches!(outcome, IncludeOutcome::Unreadable(reason) if reason.starts_with("files that are included more than once"));
    assert!(count(&deck, refused) > 0);
}
