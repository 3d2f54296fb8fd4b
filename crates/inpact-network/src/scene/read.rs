//! From the text of a scene file, and of the tables it names, to a scene.
//!
//! Every problem is reported with its line; no scene is returned where there are errors.

mod entries;
mod files;
mod names;
mod parts;
mod time;

use super::course::Course;
use super::file::{LinkFileEntry, ProcedureName, SceneFile};
use super::rules::MALFORMED_SCENE;
use super::shape::{self, Shaped};
use super::syntax::{self, Sound};
use super::usable::{self, Refusal};
use super::values::Number;
use super::{Conditions, Field, Scene, SceneLink};
use inpact_diagnostics::{Diagnostic, Findings, Place, Rule, Severity};
use serde::Deserialize;
use std::collections::{BTreeMap, HashMap};
use toml::Spanned;

/// The tables of a scene file.
pub trait SceneFiles {
    /// The name of a file in findings; by default as in the scene.
    fn name(&self, name: &str) -> String {
        name.to_owned()
    }

    /// The bytes of a file, whose name is relative to the scene file; `None` where it cannot be read, which the caller knows how to say.
    fn read(&mut self, name: &str) -> Option<Vec<u8>>;
}

/// Reads a scene; `name` is the name of the scene file in findings.
///
/// The scene is `None` where one of the findings is an error.
pub fn read(text: &str, name: &str, files: &mut dyn SceneFiles) -> (Option<Scene>, Vec<Diagnostic>) {
    let (scene, found) = read_as_far_as_it_goes(text, name, files);
    let has_errors = found.iter().any(|found| found.severity == Severity::Error);
    (scene.filter(|_| !has_errors), found)
}

/// Reads a scene and returns the readable part together with its errors, so that further checks are possible; `None` where it is not a scene at all.
pub fn read_as_far_as_it_goes(text: &str, name: &str, files: &mut dyn SceneFiles) -> (Option<Scene>, Vec<Diagnostic>) {
    let mut reader = Reader::new(text, name);
    let Sound { text: sound, without, mut problems } = syntax::sound(text);
    let shaped = sound.as_deref().map(|sound| shape::shaped(sound, &without));
    let Shaped { table, problems: further, lacks_nodes } = shaped.unwrap_or_default();
    reader.lacks_nodes = lacks_nodes;
    problems.extend(further);
    problems.sort_by_key(|problem| problem.at);
    for shape::Problem { at, rule, message, help } in problems {
        let place = reader.place(at);
        reader.findings.report(rule, place, message, help);
    }
    match table.map(|table| SceneFile::deserialize(toml::de::Deserializer::from(table))) {
        Some(Ok(file)) => reader.take(file, files),
        // A text with the shape of a scene is readable.
        Some(Err(error)) => {
            let at = error.span().map_or(0, |span| span.start);
            reader.report(&MALFORMED_SCENE, at, error.message(), "");
        }
        None => {}
    }
    let Reader { scene, findings, mut found, .. } = reader;
    let mut all = findings.into_list();
    all.append(&mut found);
    (scene, all)
}

/// The maximum number of comparisons of unknown names with known ones, so that a table of a million unknown names takes no longer than a correct one.
const MAX_COMPARISONS: usize = 1_000_000;

/// A scene under construction.
pub(super) struct Reader<'a> {
    text: &'a str,
    /// The starts of lines.
    line_starts: Vec<usize>,
    scene: Option<Scene>,
    numbers: HashMap<String, u32>,
    /// The scene file and the tables of nodes, by their names.
    sources: Vec<String>,
    /// The source that defines each node, and its line; empty for nodes named only by a link.
    origins: Vec<(usize, u64)>,
    is_steady: bool,
    /// A node or a file was rejected that may define further names, so unknown names may be defined there.
    lacks_nodes: bool,
    /// The number of comparisons left, to suggest names.
    comparisons: usize,
    pub(super) findings: Findings,
    /// The findings in tables.
    found: Vec<Diagnostic>,
}

impl<'a> Reader<'a> {
    fn new(text: &'a str, name: &str) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(place, _)| place + 1);
        Self {
            text,
            line_starts: std::iter::once(0).chain(starts).collect(),
            scene: None,
            numbers: HashMap::new(),
            sources: vec![name.to_owned()],
            origins: Vec::new(),
            is_steady: true,
            lacks_nodes: false,
            comparisons: MAX_COMPARISONS,
            findings: Findings::new(name),
            found: Vec::new(),
        }
    }

    /// The line of a byte, from 1.
    fn line(&self, byte: usize) -> u64 {
        self.line_starts.partition_point(|&start| start <= byte.min(self.text.len())) as u64
    }

    /// The place of a token that begins at a byte: a key, a number, a text.
    fn place(&self, byte: usize) -> Place {
        let line = self.line(byte);
        let start = self.line_starts[usize::try_from(line).unwrap_or(1) - 1];
        let rest = self.text.get(byte..).unwrap_or_default();
        let end = match rest.chars().next() {
            Some(quote @ ('"' | '\'')) => match rest[1..].find([quote, '\n']) {
                Some(end) if rest[1 + end..].starts_with(quote) => end + 2,
                Some(end) => end + 1,
                None => rest.len(),
            },
            // The heading of an entry; a list or a table by its first character.
            Some('[') if rest.starts_with("[[") => rest.find("]]").map_or(1, |end| end + 2),
            Some('[' | '{') | None => rest.len().min(1),
            Some(_) => rest.find(|end: char| end.is_whitespace() || ",=]}#".contains(end)).unwrap_or(rest.len()),
        };
        let column = self.text.get(start..byte).unwrap_or_default().chars().count() as u64 + 1;
        let bytes = byte as u64..(byte + end.min(rest.len())) as u64;
        Place { exact: Some((bytes, column)), ..Place::of_line(line) }
    }

    fn line_of<T>(&self, spanned: &Spanned<T>) -> u64 {
        self.line(spanned.span().start)
    }

    /// Reports a finding about the token that begins at a byte.
    fn report(&mut self, rule: &Rule, at: usize, message: impl Into<String>, help: &str) {
        let place = self.place(at);
        self.findings.report(rule, place, message, help);
    }

    /// Reports a finding about a line.
    fn report_in_line(&mut self, rule: &Rule, line: u64, message: impl Into<String>, help: &str) {
        self.findings.report(rule, Place::of_line(line), message, help);
    }

    fn refuse(&mut self, at: usize, refusal: Refusal) {
        let Refusal { rule, column, message, help } = refusal;
        let place = Place { column, ..self.place(at) };
        self.findings.report(rule, place, message, help);
    }

    /// A number as written.
    fn written(&self, number: &Number) -> &'a str {
        self.text.get(number.span()).unwrap_or_default()
    }

    /// The value of a key; reports one that cannot be used.
    fn value(&mut self, key: &str, number: Option<&Number>, what: impl FnOnce() -> String) -> Option<f64> {
        let number = number?;
        if let Err(refusal) = usable::number(key, number.value(), self.written(number), what) {
            self.refuse(number.span().start, refusal);
        }
        Some(number.value())
    }

    fn take(&mut self, file: SceneFile, files: &mut dyn SceneFiles) {
        let procedure = self.procedure(&file);
        self.is_steady = file.procedure == ProcedureName::Steady;
        let key = "joule_heat_fraction";
        let fraction = self.value(key, file.joule_heat_fraction.as_ref(), || format!("`{key}`")).unwrap_or(0.0);
        let entry = file.initial;
        let mut initial = |key: &str, number: Option<&Number>| self.value(key, number, || format!("`initial.{key}`"));
        let mut scene = Scene {
            deck: file.deck.into_inner(),
            procedure,
            initial_temperature: initial("temperature", entry.temperature.as_ref()),
            initial_pore_pressure: initial("pore_pressure", entry.pore_pressure.as_ref()),
            nodes: Vec::new(),
            node_lines: BTreeMap::new(),
            parts: BTreeMap::new(),
            deck_conditions: self.deck_conditions(file.conditions.as_ref()),
            conditions: std::array::from_fn(|_| Conditions::default()),
            links: Vec::new(),
            interfaces: Vec::new(),
        };
        for node in file.nodes {
            self.take_node(node.into_inner(), &mut scene);
        }
        for entry in file.node_files {
            self.take_node_file(&entry.into_inner().file, files, &mut scene);
        }
        // If the scene defines nodes, another name in a table of links is a mistake; rows of a matrix have only numbers.
        let links_define_nodes = scene.nodes.is_empty() && !self.lacks_nodes;
        let link_files: Vec<LinkFileEntry> = file.link_files.into_iter().map(Spanned::into_inner).collect();
        // First, so that all links and interfaces can refer to nodes.
        let mut matrices: Vec<Option<Vec<SceneLink>>> =
            link_files.iter().map(|entry| self.take_matrix(entry, fraction, files, &mut scene)).collect();
        for link in file.links {
            let at = start(&link);
            self.take_link(link.into_inner(), at, fraction, &mut scene);
        }
        for (entry, links) in link_files.iter().zip(&mut matrices) {
            match links {
                Some(links) => scene.links.append(links),
                None => self.take_link_file(&entry.file, links_define_nodes, fraction, files, &mut scene),
            }
        }
        for interface in file.interfaces {
            let at = start(&interface);
            self.take_interface(interface.into_inner(), at, &mut scene);
        }
        for entry in file.interface_files {
            self.take_interface_file(&entry.into_inner().file, files, &mut scene);
        }
        self.check_parts(&scene);
        // All other faults come first.
        if scene.nodes.is_empty() && !self.lacks_nodes && !self.findings.has_errors() && self.found.is_empty() {
            let help = "add a [[node]] for each point whose potential, temperature or pore pressure is sought or held, or a [[node_file]]";
            self.report(&MALFORMED_SCENE, 0, "the scene has no nodes, so that there is nothing to solve", help);
        }
        self.scene = Some(scene);
    }
}

/// The start of a token.
pub(super) fn start<T>(spanned: &Spanned<T>) -> usize {
    spanned.span().start
}

/// A condition whose numbers can be used.
#[derive(Debug, Clone, Default)]
pub(super) struct CheckedCondition {
    pub(super) fixed: Option<Course>,
    pub(super) source: Option<Course>,
    pub(super) capacity: Option<f64>,
    pub(super) initial: Option<f64>,
}

fn put_condition(scene: &mut Scene, field: Field, node: u32, condition: CheckedCondition) {
    let conditions = &mut scene.conditions[field.index()];
    conditions.fixed.extend(condition.fixed.map(|course| (node, course)));
    conditions.sources.extend(condition.source.map(|course| (node, course)));
    conditions.capacities.extend(condition.capacity.map(|capacity| (node, capacity)));
    conditions.initial.extend(condition.initial.map(|initial| (node, initial)));
}
