//! The names of a deck: where each is defined and where it is used, in all of its files.
//!
//! Interactions, surfaces, sets of nodes and of elements, and parameters. Names in the typed model are looked up there; others are
//! found by the parameters that hold them (NSET, ELSET, SURFACE, …) and by the items of rows, since most keywords of a deck are not
//! interpreted by inpact. An item that could be a surface or a set of either kind is taken for whichever the deck defines by that name.

use super::blocks::{self, Entry};
use super::workspace::View;
use inpact_parser::deck::items;
use inpact_parser::expression::{names as names_of_statement, references};
use inpact_parser::grammar::{Level, RowShape};
use inpact_parser::model::Name;
use inpact_parser::span::Span;
use std::collections::BTreeSet;

/// Kinds of names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Kind {
    Interaction,
    Surface,
    NodeSet,
    ElementSet,
    /// Of *PARAMETER.
    Parameter,
}

impl Kind {
    /// Its name in messages, with its article.
    pub(super) fn one(self) -> String {
        let word = self.word();
        let article = if word.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
        format!("{article} {word}")
    }

    /// Its name in messages.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Interaction => "interaction",
            Self::Surface => "surface",
            Self::NodeSet => "node set",
            Self::ElementSet => "element set",
            Self::Parameter => "parameter",
        }
    }
}

/// An occurrence of a name.
#[derive(Debug, Clone)]
pub(super) struct Occurrence {
    pub(super) kind: Kind,
    pub(super) name: Name,
    pub(super) span: Span,
    pub(super) is_definition: bool,
    /// Whether only the name determines its kind.
    pub(super) is_guess: bool,
    /// The part or instance that it is defined in; empty for what is not defined in one.
    pub(super) scope: String,
}

/// Possible kinds of a written name.
struct Meaning {
    kinds: &'static [Kind],
    is_definition: bool,
}

const SURFACE: &[Kind] = &[Kind::Surface];
const INTERACTION: &[Kind] = &[Kind::Interaction];
const NODE_SET: &[Kind] = &[Kind::NodeSet];
const ELEMENT_SET: &[Kind] = &[Kind::ElementSet];
const ANY: &[Kind] = &[Kind::Surface, Kind::NodeSet, Kind::ElementSet];

impl Meaning {
    const fn used(kinds: &'static [Kind]) -> Self {
        Self { kinds, is_definition: false }
    }

    const fn defined(kinds: &'static [Kind]) -> Self {
        Self { kinds, is_definition: true }
    }
}

/// Keywords that define a surface by NAME.
const DEFINE_SURFACES: [&str; 4] = ["SURFACE", "SURFACE DEFINITION", "RIGID SURFACE", "CONTACT NODE SET"];

/// The kind of name in the value of a parameter.
fn meaning_of_value(keyword: &str, parameter: &[u8]) -> Option<Meaning> {
    let is = |name: &str| blocks::is_same(parameter, name);
    let surfaces = ["SURFACE", "MASTER", "SLAVE", "MAIN", "SECONDARY"];
    Some(match keyword {
        "SURFACE INTERACTION" if is("NAME") => Meaning::defined(INTERACTION),
        _ if DEFINE_SURFACES.contains(&keyword) && is("NAME") => Meaning::defined(SURFACE),
        "NSET" | "NODE" | "NGEN" | "NFILL" | "NMAP" if is("NSET") => Meaning::defined(NODE_SET),
        "ELSET" | "ELEMENT" | "ELGEN" if is("ELSET") => Meaning::defined(ELEMENT_SET),
        // *NSET, ELSET=X uses the nodes of an element set.
        _ if is("ELSET") => Meaning::used(ELEMENT_SET),
        _ if is("NSET") || is("REF NODE SET") => Meaning::used(NODE_SET),
        _ if is("INTERACTION") || is("INTERACTION PROPERTY") => Meaning::used(INTERACTION),
        _ if surfaces.into_iter().any(is) => Meaning::used(SURFACE),
        _ => return None,
    })
}

/// The kind of name in an item of a row, by index from 0; `None` for rows without names.
fn meaning_of_item(entry: &Entry<'_>, view: View<'_>, item: usize) -> Option<Meaning> {
    let kinds = match entry.name {
        "CONTACT PROPERTY ASSIGNMENT" if item == 2 => INTERACTION,
        "CONTACT PAIR" | "CONTACT PROPERTY ASSIGNMENT" | "CONTACT INCLUSIONS" | "CONTACT EXCLUSIONS" | "TIE" => SURFACE,
        "NSET" | "CONTACT NODE SET" => NODE_SET,
        "ELSET" => ELEMENT_SET,
        "SURFACE" if entry.value_written(view, "COMBINE").is_some() => SURFACE,
        "SURFACE" if item == 0 => {
            let kind = entry.value_written(view, "TYPE").map(|kind| view.shown(kind).to_ascii_uppercase());
            if kind.is_some_and(|kind| kind.starts_with("NODE")) { NODE_SET } else { ELEMENT_SET }
        }
        // Numbers, or words that are not names.
        "SURFACE" | "NODE" | "ELEMENT" | "HEADING" | "PARAMETER" | "AMPLITUDE" | "NGEN" | "ELGEN" => return None,
        _ => {
            let is_interpreted = |definition: &inpact_parser::grammar::Definition| {
                definition.rows().is_numbers() || definition.rows() == RowShape::Text
            };
            if entry.definition.is_some_and(is_interpreted) {
                return None;
            }
            ANY
        }
    };
    Some(Meaning::used(kinds))
}

/// Visits every name of a deck.
///
/// Rows are read again from the text, as most are not kept.
fn visit(view: View<'_>, wanted: &[Kind], mut take: impl FnMut(Meaning, &Entry<'_>, &[u8], Span, &str)) {
    let mut open: Vec<(Level, String)> = Vec::new();
    for entry in blocks::entries(view.analysis) {
        let name = || entry.value_written(view, "NAME").map(|name| view.shown(name)).unwrap_or_default();
        blocks::pass_level(&mut open, entry.name, name);
        let in_part = open.iter().rev().find(|(level, _)| matches!(level, Level::Part | Level::Instance));
        let scope = in_part.map_or("", |(_, name)| name.as_str());
        for given in entry.keyword.parameters() {
            let meaning = meaning_of_value(entry.name, &view.text(given.name));
            if let (Some(value), Some(meaning)) = (given.value, meaning) {
                take(meaning, &entry, &view.text(value), value, scope);
            }
        }
        let is_wanted = |item| {
            meaning_of_item(&entry, view, item)
                .is_some_and(|found| found.kinds.iter().any(|kind| wanted.contains(kind)))
        };
        if !(0..3).any(is_wanted) {
            continue;
        }
        for rows in entry.rows() {
            for (line, text) in view.lines(rows) {
                view.workspace.stop.look();
                for (index, range) in items(&text).enumerate() {
                    let item = &text[range.clone()];
                    // Most items are numbers, not names.
                    if !item
                        .first()
                        .is_some_and(|byte| byte.is_ascii_alphabetic() || matches!(byte, b'_' | b'"' | b'<'))
                    {
                        continue;
                    }
                    let span = line.part(range.clone());
                    if let Some(meaning) = meaning_of_item(&entry, view, index) {
                        take(meaning, &entry, item, span, scope);
                    }
                }
            }
        }
    }
}

/// The last part of a dotted name (S-44) and its bytes; quotes hold a name together.
fn last_part(text: &[u8], span: Span) -> (String, Span) {
    let mut is_quoted = false;
    let mut from = 0;
    for (at, byte) in text.iter().enumerate() {
        is_quoted ^= *byte == b'"';
        if *byte == b'.' && !is_quoted {
            from = at + 1;
        }
    }
    let part = String::from_utf8_lossy(&text[from..]).into_owned();
    (part, Span::new(span.source(), span.start() + from as u64, span.end()))
}

/// All occurrences of that kind and name: definitions and uses, in the order of the deck.
pub(super) fn occurrences(view: View<'_>, kind: Kind, name: &Name) -> Vec<Occurrence> {
    if kind == Kind::Parameter {
        return occurrences_of_parameter(view, name);
    }
    let mut found = Vec::new();
    let dialect = view.analysis.settings.grammar.dialect();
    visit(view, &[kind], |meaning, _, text, span, scope| {
        if !meaning.kinds.contains(&kind) {
            return;
        }
        let whole = Name::in_dialect(&String::from_utf8_lossy(text), dialect);
        let (part, part_span) = last_part(text, span);
        let span = match () {
            () if whole == *name => span,
            () if kind != Kind::Interaction && Name::in_dialect(&part, dialect) == *name => part_span,
            () => return,
        };
        found.push(Occurrence {
            kind,
            name: name.clone(),
            span,
            is_definition: meaning.is_definition,
            is_guess: meaning.kinds.len() > 1,
            scope: scope.to_owned(),
        });
    });
    once_each(found)
}

/// A file that is included twice has each of its names twice.
fn once_each(mut found: Vec<Occurrence>) -> Vec<Occurrence> {
    let mut seen = BTreeSet::new();
    found.retain(|occurrence| seen.insert((occurrence.span.source(), occurrence.span.start())));
    found
}

/// Statements that define or use a parameter, and `<name>` wherever it stands (S-60 to S-62).
fn occurrences_of_parameter(view: View<'_>, name: &Name) -> Vec<Occurrence> {
    let mut found = Vec::new();
    let mut take = |span, is_definition| {
        let (name, scope) = (name.clone(), String::new());
        found.push(Occurrence { kind: Kind::Parameter, name, span, is_definition, is_guess: false, scope });
    };
    for block in view.analysis.deck.blocks() {
        let entry = Entry::of(view.analysis, block);
        if let Some(keyword) = &block.keyword {
            let text = view.text(keyword.span);
            for reference in references(&text).filter(|reference| reference.name == name.written()) {
                take(inner(&text, reference.range, keyword.span), false);
            }
        }
        let is_parameter = entry.is_some_and(|entry| entry.name == "PARAMETER");
        if !is_parameter && memchr::memchr(b'<', &view.text(block.rows())).is_none() {
            continue;
        }
        for (line, text) in view.lines(block.rows()) {
            if is_parameter {
                let mut names =
                    names_of_statement(&text).filter(|range| &text[range.clone()] == name.written().as_bytes());
                let first = names.next();
                for range in first.into_iter().chain(names) {
                    let before = text[..range.start].trim_ascii();
                    let after = text[range.end..].trim_ascii_start();
                    let assigns = before.is_empty() && after.first() == Some(&b'=') && after.get(1) != Some(&b'=');
                    take(line.part(range), assigns);
                }
            } else {
                for reference in references(&text).filter(|reference| reference.name == name.written()) {
                    take(inner(&text, reference.range, line), false);
                }
            }
        }
    }
    once_each(found)
}

/// The name between the brackets of a reference.
fn inner(text: &[u8], range: std::ops::Range<usize>, line: Span) -> Span {
    let within = &text[range.start + 1..range.end - 1];
    let start = range.start + 1 + (within.len() - within.trim_ascii_start().len());
    line.part(start..start + within.trim_ascii().len())
}

/// The name at a position, with its kind.
pub(super) fn at(view: View<'_>, offset: u64) -> Option<Occurrence> {
    if let Some((span, name)) = parameter_at(view, offset) {
        let inner = Span::new(span.source(), span.start() + 1, span.end() - 1);
        return Some(of_parameter(&name, inner));
    }
    let entry = blocks::owner_at(view.analysis, view.source, offset)?;
    let dialect = view.analysis.settings.grammar.dialect();
    let touches = |span: Span| span.touches(view.at(offset));
    let (text, span, meaning) = if offset < entry.keyword.span.end() && touches(entry.keyword.span) {
        let given = entry.keyword.parameters().find(|given| given.value.is_some_and(touches))?;
        let value = given.value?;
        (view.text(value).into_owned(), value, meaning_of_value(entry.name, &view.text(given.name))?)
    } else {
        let (line_span, line) = view.line_at(offset)?;
        if line.trim_ascii_start().starts_with(b"**") {
            return None;
        }
        let part = |range: &std::ops::Range<usize>| line_span.part(range.clone());
        if entry.name == "PARAMETER" {
            let range = names_of_statement(line).find(|range| touches(part(range)))?;
            let name = String::from_utf8_lossy(&line[range.clone()]).into_owned();
            view.analysis.model.parameters.definition(&name)?;
            return Some(of_parameter(&name, part(&range)));
        }
        let (index, range) = items(line).enumerate().find(|(_, range)| touches(part(range)))?;
        (line[range.clone()].to_vec(), part(&range), meaning_of_item(&entry, view, index)?)
    };
    if text.is_empty() {
        return None;
    }
    let is_name = text.first().is_some_and(|byte| byte.is_ascii_alphabetic() || matches!(byte, b'_' | b'"'));
    let (part, part_span) = last_part(&text, span);
    let whole = Name::in_dialect(&String::from_utf8_lossy(&text), dialect);
    let part = Name::in_dialect(&part, dialect);
    let candidates = [(whole, span), (part, part_span)];
    let guess = meaning.kinds.len() > 1;
    if !is_name {
        return None;
    }
    for (name, span) in &candidates {
        let kind = meaning.kinds.iter().find(|kind| meaning.is_definition || is_defined(view, **kind, name));
        if let Some(kind) = kind {
            let (name, scope) = (name.clone(), String::new());
            return Some(Occurrence {
                kind: *kind,
                name,
                span: *span,
                is_definition: meaning.is_definition,
                is_guess: guess,
                scope,
            });
        }
    }
    // Nothing defines it: the kind follows from the keyword, if that is unique.
    let (name, span) = candidates.into_iter().next()?;
    let kind = (!guess).then_some(meaning.kinds[0])?;
    Some(Occurrence { kind, name, span, is_definition: false, is_guess: false, scope: String::new() })
}

/// Whether the deck defines that kind and name, by keyword lines only.
fn is_defined(view: View<'_>, kind: Kind, name: &Name) -> bool {
    let dialect = view.analysis.settings.grammar.dialect();
    let mut is_defined = false;
    visit(view, &[], |meaning, _, text, _, _| {
        is_defined |= meaning.is_definition
            && meaning.kinds.contains(&kind)
            && Name::in_dialect(&String::from_utf8_lossy(text), dialect) == *name;
    });
    is_defined
}

fn of_parameter(name: &str, span: Span) -> Occurrence {
    let (kind, name) = (Kind::Parameter, Name::new(name));
    Occurrence { kind, name, span, is_definition: false, is_guess: false, scope: String::new() }
}

/// The distinct names of a kind that the deck defines, in the order of the deck.
pub(super) fn defined_names(view: View<'_>, kind: Kind) -> Vec<Name> {
    let mut found: Vec<Name> = Vec::new();
    let mut seen = BTreeSet::new();
    if kind == Kind::Parameter {
        return view
            .analysis
            .model
            .parameters
            .final_definitions()
            .map(|definition| Name::new(&definition.name))
            .collect();
    }
    let dialect = view.analysis.settings.grammar.dialect();
    // No rows define anything.
    visit(view, &[], |meaning, _, text, _, _| {
        if meaning.is_definition && meaning.kinds.contains(&kind) {
            let name = Name::in_dialect(&String::from_utf8_lossy(text), dialect);
            if seen.insert(name.canonical().to_owned()) {
                found.push(name);
            }
        }
    });
    found
}

/// The kinds of things that the value of a parameter may name.
pub(super) fn kinds_of_value(keyword: &str, parameter: &[u8]) -> &'static [Kind] {
    let meaning = meaning_of_value(keyword, parameter);
    // A name that is defined here is a new one.
    meaning.filter(|meaning| !meaning.is_definition).map_or(&[], |meaning| meaning.kinds)
}

/// The kinds of things that an item of a row may name.
pub(super) fn kinds_of_item(entry: &Entry<'_>, view: View<'_>, item: usize) -> &'static [Kind] {
    meaning_of_item(entry, view, item).map_or(&[], |meaning| meaning.kinds)
}

/// The `<name>` at a place: its bytes, brackets included, and the name.
pub(super) fn parameter_at(view: View<'_>, offset: u64) -> Option<(Span, String)> {
    let (line_span, line) = view.line_at(offset)?;
    if line.trim_ascii_start().starts_with(b"**") {
        return None;
    }
    let mut found = references(line).map(|reference| (line_span.part(reference.range), reference.name.to_owned()));
    found.find(|(span, _)| span.touches(view.at(offset)))
}
