//! `grammar/syntax.ebnf`: the parser accepts and rejects the examples of every production.

use inpact_parser::deck::lines::{LineKind, line_kind, lines};
use inpact_parser::deck::{Deck, items, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::model::read;
use inpact_parser::number::{read_float, read_integer};
use inpact_parser::span::SourceId;
use inpact_parser::{Problem, ProblemKind};
use std::collections::{BTreeMap, BTreeSet};

const SYNTAX: &str = include_str!("../grammar/syntax.ebnf");

/// The examples of a production.
#[derive(Debug, Default)]
struct Examples {
    accepted: Vec<Vec<u8>>,
    rejected: Vec<Vec<u8>>,
}

/// The productions by name with the examples that stand before them.
fn productions() -> BTreeMap<&'static str, Examples> {
    let mut productions = BTreeMap::new();
    let mut examples = Examples::default();
    for line in SYNTAX.lines() {
        if let Some(example) = line.strip_prefix("(* accepts: ") {
            examples.accepted.push(example_text(example));
        } else if let Some(example) = line.strip_prefix("(* rejects: ") {
            examples.rejected.push(example_text(example));
        } else if let Some((name, _)) = line.split_once(" = ").filter(|_| line.ends_with(';')) {
            productions.insert(name, std::mem::take(&mut examples));
        }
    }
    assert!(examples.accepted.is_empty(), "examples after the last production");
    productions
}

/// The bytes of an example, of which the grave accents and the end of the comment are left.
fn example_text(quoted: &str) -> Vec<u8> {
    let inner = quoted.strip_prefix('`').and_then(|rest| rest.strip_suffix("` *)"));
    let mut rest = inner.unwrap_or_else(|| panic!("malformed example: {quoted}"));
    let mut bytes = Vec::new();
    while let Some(at) = rest.find('\\') {
        bytes.extend_from_slice(&rest.as_bytes()[..at]);
        let (byte, length) = match &rest[at + 1..=at + 1] {
            "n" => (b'\n', 2),
            "r" => (b'\r', 2),
            "t" => (b'\t', 2),
            "\\" => (b'\\', 2),
            "x" => (u8::from_str_radix(&rest[at + 2..at + 4], 16).unwrap(), 4),
            other => panic!("unknown escape \\{other} in {quoted}"),
        };
        bytes.push(byte);
        rest = &rest[at + length..];
    }
    bytes.extend_from_slice(rest.as_bytes());
    bytes
}

fn deck(bytes: &[u8]) -> Deck {
    scan("example.inp", bytes, Grammar::builtin())
}

/// Whether a deck is one keyword line and nothing else.
fn is_keyword_line(bytes: &[u8]) -> bool {
    let deck = deck(bytes);
    let [block] = deck.blocks() else { return false };
    let Some(keyword) = &block.keyword else { return false };
    block.rows().is_empty() && keyword.unterminated_quote().is_none() && keyword.dangling_comma().is_none()
}

/// Whether `*X, ` and the example is a keyword line of exactly that parameter; its name and value.
fn one_parameter(example: &[u8]) -> Option<(Vec<u8>, Option<Vec<u8>>)> {
    let line = [b"*X, ", example].concat();
    if !is_keyword_line(&line) {
        return None;
    }
    let deck = deck(&line);
    let keyword = deck.blocks()[0].keyword.as_ref()?;
    let mut parameters = keyword.parameters();
    let (Some(parameter), None) = (parameters.next(), parameters.next()) else { return None };
    Some((deck.text(parameter.name).to_vec(), parameter.value.map(|value| deck.text(value).to_vec())))
}

/// Whether the example is read whole as the value of a parameter.
fn is_value(example: &[u8]) -> bool {
    let whole = one_parameter(&[b"NAME=", example].concat());
    whole.is_some_and(|(_, value)| value.as_deref() == Some(example))
}

/// Whether the example is read whole as the name of a keyword without parameters.
fn is_word(example: &[u8]) -> bool {
    let line = [b"*", example].concat();
    let deck = deck(&line);
    let keyword = deck.blocks().first().and_then(|block| block.keyword.as_ref());
    keyword.is_some_and(|keyword| deck.text(keyword.name()) == example && keyword.parameters().len() == 0)
        && one_parameter(example).is_some_and(|(name, value)| name == example && value.is_none())
}

/// Whether two parameters with the example between their comma and the second stand on one keyword line.
fn is_continuation(example: &[u8]) -> bool {
    let line = [b"*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1.,", example, b"CUTOFF GAP FILL=2."].concat();
    let deck = deck(&line);
    let keyword = deck.blocks()[0].keyword.as_ref().unwrap();
    is_keyword_line(&line) && keyword.parameters().len() == 2
}

/// Whether the example, as an item of a table, is a symbol for a parameter's value.
fn is_symbol(example: &[u8]) -> bool {
    let text = [b"*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY\n", example, b", 0.\n"].concat();
    let (model, problems) = read(&deck(&text), Grammar::builtin());
    let table = model.interactions[0].contact_permeability.as_ref().unwrap().table.as_ref().unwrap();
    // Nothing defines the parameter here: that is the one thing wrong with it.
    let is_undefined = matches!(&problems[..], [Problem { kind: ProblemKind::UndefinedParameter { .. }, .. }]);
    is_undefined && table.row(0)[0].is_nan()
}

/// Whether the parser reads the example as that production.
fn is_read_as(production: &str, example: &[u8]) -> bool {
    let one_line = lines(example).count() <= 1;
    match production {
        "deck" => {
            let deck = deck(example);
            deck.print(SourceId::ROOT) == example
        }
        "line end" => {
            let text = [b"1", example, b"2"].concat();
            lines(&text).count() == 2 && lines(&text).next() == Some(0..1 + example.len())
        }
        "line" => lines(example).count() <= 1,
        "comment" => one_line && line_kind(example) == LineKind::Comment,
        "indented comment" => one_line && line_kind(example) == LineKind::IndentedComment,
        "blank line" => one_line && line_kind(example) == LineKind::Blank,
        "data line" => one_line && line_kind(example) == LineKind::Data,
        "keyword line" => is_keyword_line(example),
        "continuation" => is_continuation(example),
        "parameter" => one_parameter(example).is_some(),
        "word" => is_word(example),
        "value" => is_value(example),
        "quoted" => is_value(example) && example.first() == Some(&b'"') && items(example).count() == 1,
        "list" => is_value(example) && example.first() == Some(&b'('),
        "item" => {
            let mut found = items(example).map(|range| &example[range]);
            found.next() == Some(example.trim_ascii()) && found.next().is_none()
        }
        "float" => read_float(example).is_ok(),
        "exponent" => {
            example.first().is_some_and(u8::is_ascii_alphabetic) && read_float(&[b"1.", example].concat()).is_ok()
        }
        "integer" => read_integer(example).is_ok(),
        "symbol" => is_symbol(example),
        other => panic!("no test for the production `{other}`"),
    }
}

#[test]
fn the_parser_reads_the_examples() {
    let mut read = 0;
    for (production, examples) in productions() {
        for example in &examples.accepted {
            let shown = example.escape_ascii();
            assert!(is_read_as(production, example), "{production} should accept `{shown}`");
        }
        for example in &examples.rejected {
            let shown = example.escape_ascii();
            assert!(!is_read_as(production, example), "{production} should reject `{shown}`");
        }
        read += examples.accepted.len() + examples.rejected.len();
    }
    assert!(read > 100, "{read}");
}

/// Every production has examples, but for those that name single bytes.
#[test]
fn every_production_has_examples() {
    let terminals =
        ["text", "character", "word character", "value character", "blank", "sign", "letter", "digit", "LF", "CR"];
    for (production, examples) in productions() {
        assert_eq!(examples.accepted.is_empty(), terminals.contains(&production), "{production}");
    }
}

/// Every name on the right-hand side is defined, and every production but `deck` is used.
#[test]
fn every_name_is_defined_and_used() {
    let productions = productions();
    let right_hand_sides = SYNTAX.lines().filter(|line| !line.starts_with("(*") && line.ends_with(';'));
    let mut used = BTreeSet::new();
    for line in right_hand_sides {
        let (_, right) = line.split_once(" = ").unwrap();
        used.extend(names_in(right));
    }
    let defined: BTreeSet<String> = productions.keys().map(|name| (*name).to_owned()).collect();
    let undefined: Vec<&String> = used.difference(&defined).collect();
    assert!(undefined.is_empty(), "used and not defined: {undefined:?}");
    let unused: Vec<&String> = defined.difference(&used).collect();
    assert_eq!(unused, ["deck"]);
}

/// The names of productions in a right-hand side: what is neither quoted, nor between question marks, nor punctuation.
fn names_in(right: &str) -> Vec<String> {
    let mut plain = String::new();
    let mut closed_by = None;
    for character in right.chars() {
        match closed_by {
            Some(end) if character == end => closed_by = None,
            Some(_) => {}
            None if "\"'?".contains(character) => {
                closed_by = Some(character);
                plain.push('|');
            }
            None => plain.push(character),
        }
    }
    let names = plain.split(|character: char| !character.is_alphabetic() && character != ' ');
    names.map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned).collect()
}
