//! The shape of a scene file: its keys and the kinds of their values, checked against the text in one pass.
//!
//! Every deviation is reported with its place: unknown or missing keys, values of another type. Faulty parts are removed,
//! an entry as a whole, so that the rest can be read and its problems reported in the same run.
//! The keys are those of `file.rs`; a test compares them with its schema.

use super::file;
use super::nearest::{listed, meant_or, near};
use super::rules::{MALFORMED_SCENE, UNUSABLE_NUMBER};
use super::usable::lost;
use inpact_diagnostics::Rule;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeString, DeTable, DeValue};

/// The maximum length of a quoted text, in characters.
const LONGEST_QUOTE: usize = 60;

/// A deviation from the shape of a scene.
pub(super) struct Problem {
    /// Its first byte.
    pub(super) at: usize,
    pub(super) rule: &'static Rule,
    pub(super) message: String,
    pub(super) help: String,
}

/// A scene file with only known keys and values of the right type.
#[derive(Default)]
pub(super) struct Shaped<'t> {
    /// The valid part of it; `None` where its head is faulty.
    pub(super) table: Option<Spanned<DeTable<'t>>>,
    /// The problems, in the order of the text.
    pub(super) problems: Vec<Problem>,
    /// Whether an entry was removed that may define nodes.
    pub(super) lacks_nodes: bool,
}

/// The keys of a table.
struct Shape {
    keys: &'static [Key],
    /// One of them, for a message.
    one: &'static str,
    many: &'static str,
    /// Whether it may define nodes.
    defines_nodes: bool,
}

struct Key {
    name: &'static str,
    /// Its other name.
    other: Option<&'static str>,
    kind: Kind,
    need: Need,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Need {
    Needed,
    Optional,
}

/// Kinds of values of keys.
enum Kind {
    Number,
    Text,
    Flag,
    OneOf(&'static [&'static str]),
    Numbers,
    Course,
    TwoNames,
    Table(&'static Shape),
    Entries(&'static Shape),
}

const fn key(name: &'static str, kind: Kind) -> Key {
    Key { name, other: None, kind, need: Need::Optional }
}

const fn needed(name: &'static str, kind: Kind) -> Key {
    Key { name, other: None, kind, need: Need::Needed }
}

/// A table of these keys, with its singular and plural for messages.
const fn shape([one, many]: [&'static str; 2], keys: &'static [Key]) -> Shape {
    Shape { keys, one, many, defines_nodes: false }
}

static SCENE: Shape = shape(
    ["a scene", "scenes"],
    &[
        needed("deck", Kind::Text),
        key("procedure", Kind::OneOf(&["steady", "transient"])),
        key("time", Kind::Table(&TIME)),
        key("initial", Kind::Table(&INITIAL)),
        key("joule_heat_fraction", Kind::Number),
        key("conditions", Kind::Table(&CONDITIONS)),
        key("node", Kind::Entries(&NODE)),
        key("link", Kind::Entries(&LINK)),
        key("interface", Kind::Entries(&INTERFACE)),
        key("node_file", Kind::Entries(&NODE_FILE)),
        key("link_file", Kind::Entries(&LINK_FILE)),
        key("interface_file", Kind::Entries(&INTERFACE_FILE)),
    ],
);

static TIME: Shape = shape(
    ["a table such as { end = 1.0, step = 0.1 }", "tables such as { end = 1.0, step = 0.1 }"],
    &[
        key("start", Kind::Number),
        needed("end", Kind::Number),
        key("step", Kind::Number),
        key("tolerance", Kind::Number),
        key("first_step", Kind::Number),
        key("start_from", Kind::OneOf(&["first-row", "at-rest"])),
        key("closing_heat", Kind::OneOf(&["balanced", "manual"])),
    ],
);

static INITIAL: Shape = shape(
    ["a table such as { temperature = 20.0 }", "tables such as { temperature = 20.0 }"],
    &[key("temperature", Kind::Number), key("pore_pressure", Kind::Number)],
);

static CONDITIONS: Shape =
    shape(["a table such as { step = 1 }", "tables such as { step = 1 }"], &[key("step", Kind::Number)]);

static NODE: Shape = Shape {
    defines_nodes: true,
    ..shape(
        ["an entry under [[node]]", "entries under [[node]]"],
        &[
            needed("name", Kind::Text),
            key("set", Kind::Text),
            key("surface", Kind::Text),
            key("potential", Kind::Table(&CONDITION)),
            key("temperature", Kind::Table(&CONDITION)),
            key("pore_pressure", Kind::Table(&CONDITION)),
        ],
    )
};

static CONDITION: Shape = shape(
    ["a table such as { fixed = 1.0 }", "tables such as { fixed = 1.0 }"],
    &[
        key("fixed", Kind::Course),
        key("source", Kind::Course),
        key("capacity", Kind::Number),
        key("initial", Kind::Number),
    ],
);

static LINK: Shape = shape(
    ["an entry under [[link]]", "entries under [[link]]"],
    &[
        needed("nodes", Kind::TwoNames),
        key("electrical", Kind::Number),
        key("thermal", Kind::Number),
        key("hydraulic", Kind::Number),
        key("joule_heat_fraction", Kind::Number),
    ],
);

static INTERFACE: Shape = shape(
    ["an entry under [[interface]]", "entries under [[interface]]"],
    &[
        key("interaction", Kind::Text),
        Key { name: "slave", other: Some("secondary"), kind: Kind::Text, need: Need::Needed },
        Key { name: "master", other: Some("main"), kind: Kind::Text, need: Need::Needed },
        needed("area", Kind::Number),
        key("clearance", Kind::Course),
        key("pressure", Kind::Course),
        key("closed", Kind::Flag),
        key("fv", Kind::Numbers),
        key("temperature", Kind::Number),
        key("mass_flow", Kind::Number),
        key("shear", Kind::Number),
        key("slip_rate", Kind::Number),
        key("clearance_rate", Kind::Number),
        key("char_length", Kind::Number),
        key("perm_s", Kind::Number),
        key("perm_m", Kind::Number),
    ],
);

static NODE_FILE: Shape = Shape { defines_nodes: true, ..INTERFACE_FILE };

static LINK_FILE: Shape = Shape {
    defines_nodes: true,
    ..shape(
        ["an entry under [[link_file]]", "entries under [[link_file]]"],
        &[
            needed("file", Kind::Text),
            key("conducts", Kind::OneOf(&["electrical", "thermal", "hydraulic"])),
            key("prefix", Kind::Text),
        ],
    )
};

const INTERFACE_FILE: Shape = shape(
    ["an entry with `file`", "entries with `file`, each under a heading in double brackets"],
    &[needed("file", Kind::Text)],
);

/// Checks a text against the shape of a scene.
///
/// `without` gives the removed lines: keys missing in their entries are not reported.
pub(super) fn shaped<'t>(text: &'t str, without: &[usize]) -> Shaped<'t> {
    let mut walk = Walk { text, without, problems: Vec::new(), lacks_nodes: false };
    // Lines that are not TOML were removed before.
    let table = DeTable::parse(text).ok().and_then(|parsed| {
        let span = parsed.span();
        walk.table(parsed.into_inner(), &span, &SCENE).map(|table| Spanned::new(span, table))
    });
    walk.problems.sort_by_key(|problem| problem.at);
    Shaped { table, problems: walk.problems, lacks_nodes: walk.lacks_nodes }
}

/// Parts of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// All of it.
    Whole,
    /// An element in its brackets.
    Inside,
}

/// The value expected after a key under a heading, where it is known.
pub(super) fn expected_of(heading: Option<&str>, name: &str, part: Part) -> Option<String> {
    let below = |name: &str| {
        SCENE.keys.iter().find(|key| key.is_called(name)).and_then(|key| match key.kind {
            Kind::Table(shape) | Kind::Entries(shape) => Some(shape),
            _ => None,
        })
    };
    let here = match heading {
        Some(heading) => below(heading)?,
        None => &SCENE,
    };
    // Conditions are inline tables.
    let mut keys = here.keys.iter().chain(CONDITION.keys);
    let kind = &keys.find(|key| key.is_called(name))?.kind;
    match (part, kind) {
        (Part::Whole, _) => Some(kind.expected()),
        (Part::Inside, Kind::Numbers | Kind::Course) => Some(Kind::Number.expected()),
        (Part::Inside, Kind::TwoNames) => Some(Kind::Text.expected()),
        (Part::Inside, _) => None,
    }
}

struct Walk<'w, 't> {
    text: &'t str,
    without: &'w [usize],
    problems: Vec<Problem>,
    lacks_nodes: bool,
}

impl<'t> Walk<'_, 't> {
    fn report(&mut self, at: usize, message: String, help: impl Into<String>) {
        self.problems.push(Problem { at, rule: &MALFORMED_SCENE, message, help: help.into() });
    }

    /// Whether a line was removed from a table that begins at a place.
    fn is_cut(&self, span: &Range<usize>) -> bool {
        if self.without.is_empty() {
            return false;
        }
        let rest = self.text.get(span.end..).unwrap_or_default();
        let end = if self.text[span.start..].starts_with('{') {
            span.end
        } else {
            let mut lines = rest.match_indices('\n').map(|(end, _)| end + 1);
            let next = lines.find(|start| rest[*start..].trim_start_matches([' ', '\t']).starts_with('['));
            next.map_or(self.text.len(), |next| span.end + next)
        };
        let first = self.without.partition_point(|line| *line < span.start);
        self.without.get(first).is_some_and(|line| *line < end)
    }

    /// A piece of the text, if it is short enough to be quoted.
    fn quoted(&self, span: &Range<usize>) -> Option<&'t str> {
        let written = self.text.get(span.clone())?.trim();
        (!written.is_empty() && !written.contains('\n') && written.len() <= LONGEST_QUOTE).then_some(written)
    }

    /// A table with only known and valid keys; `None` where a required one is not, or its head is faulty.
    fn table(&mut self, table: DeTable<'t>, span: &Range<usize>, shape: &'static Shape) -> Option<DeTable<'t>> {
        let mut kept = DeTable::new();
        let (mut is_whole, mut seen, mut meant) = (true, Vec::new(), Vec::new());
        for (name, value) in table {
            let Some(key) = shape.keys.iter().find(|key| key.is_called(name.get_ref())) else {
                meant.extend(self.unknown_key(&name, shape));
                is_whole &= !matches!(value.get_ref(), DeValue::Table(_));
                continue;
            };
            if let (true, Some(other)) = (seen.contains(&key.name), key.other) {
                let message = format!("`{}` and `{other}` are two names of one node, and both are given", key.name);
                self.report(span.start, message, "leave one of the two out");
                continue;
            }
            seen.push(key.name);
            match self.value(value, &key.kind) {
                Some(value) => {
                    kept.insert(name, value);
                }
                // An empty list has no entries, whatever the faults of those removed.
                None => is_whole &= matches!(key.kind, Kind::Entries(_)),
            }
        }
        let is_cut = self.is_cut(span);
        // The rest of a scene is usable, while the rest of an entry would have another meaning.
        is_whole &= !is_cut || std::ptr::eq(shape, &raw const SCENE);
        let missing = shape.keys.iter().filter(|key| key.need == Need::Needed && !seen.contains(&key.name));
        for key in missing {
            is_whole = false;
            // A misspelt name was reported already.
            if !meant.contains(&key.name) && !is_cut {
                let help = match key.name {
                    "deck" => "begin the scene with the name of its deck, such as deck = \"joint.inp\"".to_owned(),
                    name => format!("add `{name}` to the entry that begins here"),
                };
                self.report(span.start, format!("`{}` is missing", key.name), help);
            }
        }
        is_whole.then_some(kept)
    }

    /// Reports an unknown key of a table; returns suggestions.
    fn unknown_key(&mut self, name: &Spanned<DeString<'t>>, shape: &'static Shape) -> Vec<&'static str> {
        let names = || shape.keys.iter().flat_map(|key| std::iter::once(key.name).chain(key.other));
        let all: Vec<&str> = names().collect();
        let help = match all[..] {
            [only] => format!("the only key here is `{only}`"),
            _ => format!("the keys here are {}", listed(&all)),
        };
        let written = name.get_ref();
        self.report(name.span().start, format!("there is no key `{written}` here"), meant_or(written, names(), &help));
        near(written, names())
    }

    /// A value of a type; `None` where it has another.
    fn value(&mut self, value: Spanned<DeValue<'t>>, kind: &Kind) -> Option<Spanned<DeValue<'t>>> {
        let span = value.span();
        match (kind, value.get_ref()) {
            (Kind::Number, _) => self.number(&value).then_some(value),
            (Kind::Text, DeValue::String(_)) | (Kind::Flag, DeValue::Boolean(_)) => Some(value),
            (Kind::OneOf(names), DeValue::String(name)) if names.contains(&name.as_ref()) => Some(value),
            (Kind::OneOf(names), DeValue::String(name)) => {
                let message = format!("`{name}` is none of {}", listed(names));
                let help = meant_or(name, names.iter().copied(), "");
                self.report(span.start, message, help);
                None
            }
            (Kind::Numbers, DeValue::Array(numbers)) => {
                let is_right = numbers.iter().map(|number| self.number(number)).fold(true, |all, one| all & one);
                is_right.then_some(value)
            }
            (Kind::Course, DeValue::Array(points)) => {
                let is_point = |point: &Spanned<DeValue<'_>>| match point.get_ref() {
                    DeValue::Array(pair) => pair.len() == 2 && pair.iter().all(is_number),
                    _ => false,
                };
                if !points.iter().all(is_point) {
                    return self.other_kind(&value, file::COURSE);
                }
                let numbers = points.iter().filter_map(|point| point.get_ref().as_array()).flatten();
                let is_right = numbers.map(|number| self.number(number)).fold(true, |all, one| all & one);
                is_right.then_some(value)
            }
            (Kind::Course, _) if is_number(&value) => self.number(&value).then_some(value),
            (Kind::TwoNames, DeValue::Array(names)) => {
                let other = names.iter().find(|name| name.get_ref().as_str().is_none());
                match other.filter(|_| names.len() == 2) {
                    Some(other) => {
                        let (other, expected) = (other.clone(), "a text in quotes");
                        self.other_kind(&other, expected)
                    }
                    None if names.len() == 2 => Some(value),
                    None => self.other_kind(&value, file::TWO_NAMES),
                }
            }
            (Kind::Table(shape), DeValue::Table(_)) => {
                let DeValue::Table(table) = value.into_inner() else { return None };
                let before = self.problems.len();
                let table = self.table(table, &span, shape)?;
                (self.problems.len() == before).then(|| Spanned::new(span, DeValue::Table(table)))
            }
            (Kind::Entries(shape), DeValue::Array(_)) => {
                let DeValue::Array(entries) = value.into_inner() else { return None };
                let right: DeArray<'t> = entries.into_iter().filter_map(|entry| self.entry(entry, shape)).collect();
                Some(Spanned::new(span, DeValue::Array(right)))
            }
            (Kind::Entries(shape), _) => {
                self.lacks_nodes |= shape.defines_nodes;
                self.other_kind(&value, &kind.expected())
            }
            _ => self.other_kind(&value, &kind.expected()),
        }
    }

    /// An entry without faults.
    fn entry(&mut self, entry: Spanned<DeValue<'t>>, shape: &'static Shape) -> Option<Spanned<DeValue<'t>>> {
        let before = self.problems.len();
        let entry = self.value(entry, &Kind::Table(shape)).filter(|_| self.problems.len() == before);
        self.lacks_nodes |= entry.is_none() && shape.defines_nodes;
        entry
    }

    /// Checks that a value is a number in the range of f64; reports one that is not.
    fn number(&mut self, value: &Spanned<DeValue<'t>>) -> bool {
        let written = match value.get_ref() {
            DeValue::Float(float) => float.as_str(),
            DeValue::Integer(whole) => {
                let is_in_range = i64::from_str_radix(whole.as_str(), whole.radix()).is_ok();
                if !is_in_range {
                    let message = format!("`{}` is beyond the range of whole numbers", whole.as_str());
                    self.report(value.span().start, message, "write it with a decimal point");
                }
                return is_in_range;
            }
            _ => return self.other_kind(value, "a number").is_some(),
        };
        let Some(lost) = written.parse().ok().and_then(|number| lost(number, written)) else { return true };
        let message = format!("`{written}` is {lost} the range of numbers");
        let help = "give a number within it, in other units if need be; only `inf` is infinite, and only 0 is zero";
        self.problems.push(Problem { at: value.span().start, rule: &UNUSABLE_NUMBER, message, help: help.to_owned() });
        false
    }

    /// Reports a value of another type.
    fn other_kind(&mut self, value: &Spanned<DeValue<'t>>, expected: &str) -> Option<Spanned<DeValue<'t>>> {
        let found = match (self.quoted(&value.span()), value.get_ref()) {
            (Some(written), _) => format!("`{written}`"),
            (None, DeValue::Array(_)) => "a list of another length".to_owned(),
            (None, DeValue::Table(_)) => "a table".to_owned(),
            (None, _) => "something else".to_owned(),
        };
        self.report(value.span().start, format!("expected {expected}, found {found}"), "");
        None
    }
}

impl Kind {
    /// The expected value, for a message.
    fn expected(&self) -> String {
        match self {
            Self::Number => "a number".to_owned(),
            Self::Text => "a text in quotes".to_owned(),
            Self::Flag => "`true` or `false`".to_owned(),
            Self::OneOf(names) => format!("one of {}", listed(names)),
            Self::Numbers => "a list of numbers such as [1.0]".to_owned(),
            Self::Course => file::COURSE.to_owned(),
            Self::TwoNames => file::TWO_NAMES.to_owned(),
            Self::Table(shape) => shape.one.to_owned(),
            Self::Entries(shape) => shape.many.to_owned(),
        }
    }
}

impl Key {
    fn is_called(&self, name: &str) -> bool {
        self.name == name || self.other == Some(name)
    }
}

fn is_number(value: &Spanned<DeValue<'_>>) -> bool {
    matches!(value.get_ref(), DeValue::Float(_) | DeValue::Integer(_))
}

#[cfg(test)]
mod tests {
    use super::{Kind, SCENE, Shape};
    use serde_json::Value;
    use std::collections::BTreeSet;

    /// The keys of a shape and of all nested ones, with the names of each.
    fn keys_of(shape: &'static Shape, keys: &mut BTreeSet<String>) {
        for key in shape.keys {
            keys.insert(key.name.to_owned());
            match key.kind {
                Kind::Table(below) | Kind::Entries(below) => keys_of(below, keys),
                Kind::OneOf(names) => keys.extend(names.iter().map(|word| format!("\"{word}\""))),
                _ => {}
            }
        }
    }

    fn keys_of_schema(value: &Value, keys: &mut BTreeSet<String>) {
        match value {
            Value::Object(entries) => {
                if let Some(Value::Object(properties)) = entries.get("properties") {
                    keys.extend(properties.keys().cloned());
                }
                keys.extend(entries.get("const").and_then(Value::as_str).map(|word| format!("\"{word}\"")));
                entries.values().for_each(|value| keys_of_schema(value, keys));
            }
            Value::Array(values) => values.iter().for_each(|value| keys_of_schema(value, keys)),
            _ => {}
        }
    }

    /// A key only in `file.rs` would be rejected, one only here would be lost.
    #[test]
    fn the_shape_has_the_keys_of_the_schema() {
        let schema = schemars::generate::SchemaSettings::draft2020_12()
            .into_generator()
            .into_root_schema_for::<super::file::SceneFile>();
        let (mut of_shape, mut of_schema) = (BTreeSet::new(), BTreeSet::new());
        keys_of(&SCENE, &mut of_shape);
        keys_of_schema(schema.as_value(), &mut of_schema);
        assert_eq!(of_shape, of_schema);
    }
}
