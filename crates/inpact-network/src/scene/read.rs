//! From the text of a scene file, and of the tables it names, to a scene.
//!
//! Every problem found is reported, with its line; a scene with errors is not given.

use super::course::Course;
use super::file::{
    self, ClosingHeatName, Condition, InterfaceEntry, LinkEntry, LinkFileEntry, NodeEntry, ProcedureName, SceneFile,
    StartFromName, TimeEntry,
};
use super::nearest::meant_or;
use super::rules::{DUPLICATE_NODE, MALFORMED_SCENE, MALFORMED_TIME, UNKNOWN_NODE};
use super::shape::{self, Shaped};
use super::syntax::{self, Sound};
use super::usable::{self, Given, Refusal};
use super::values::{Keyed, Number, Pair};
use super::{
    Conditions, Field, Procedure, Scene, SceneInterface, SceneLink, StartFrom, Steps, TimeSpan, matrix, tables,
};
use crate::linear::index;
use inpact_diagnostics::{Diagnostic, Findings, Place, Rule, Severity};
use inpact_evaluation::history::ClosingHeat;
use inpact_parser::model::{MOST_FIELD_VARIABLES, Name};
use serde::Deserialize;
use std::collections::{BTreeMap, HashMap};
use toml::Spanned;

/// The tables beside a scene file.
pub trait SceneFiles {
    /// The bytes of a file, whose name is relative to the scene file; `None` where it cannot be read, which the caller knows how to say.
    fn read(&mut self, name: &str) -> Option<Vec<u8>>;
}

/// Reads a scene; `name` is what the scene file is called in findings.
///
/// The scene is `None` where one of the findings is an error.
pub fn read(text: &str, name: &str, files: &mut dyn SceneFiles) -> (Option<Scene>, Vec<Diagnostic>) {
    let (scene, found) = read_as_far_as_it_goes(text, name, files);
    let has_errors = found.iter().any(|found| found.severity == Severity::Error);
    (scene.filter(|_| !has_errors), found)
}

/// Reads a scene and gives what could be read of it beside its errors, so that more can be said of it; `None` where it is no scene at all.
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
        // What has the shape of a scene can be read.
        Some(Err(error)) => {
            let line = reader.line(error.span().map_or(0, |span| span.start));
            reader.report(&MALFORMED_SCENE, line, error.message(), "");
        }
        None => {}
    }
    let Reader { scene, findings, mut found, .. } = reader;
    let mut all = findings.into_list();
    all.append(&mut found);
    (scene, all)
}

/// How many names are compared with unknown ones at most, so that a table of a million of them takes no longer than one that is right.
const MOST_COMPARISONS: usize = 1_000_000;

/// Below this share of the range of values, the local error of an increment is lost in rounding.
const LEAST_TOLERANCE: f64 = 1e-12;

/// More increments than that are a slip of units and not a wish: their states alone would fill a disk.
const MOST_INCREMENTS: f64 = 1e7;

/// A scene in the making.
pub(super) struct Reader<'a> {
    text: &'a str,
    /// Where lines begin.
    line_starts: Vec<usize>,
    scene: Option<Scene>,
    numbers: HashMap<String, u32>,
    /// The scene file and the tables of nodes, by their names.
    sources: Vec<String>,
    /// Which of the sources defines each node, and in which line; of the nodes that no source but a link names, nothing.
    origins: Vec<(usize, u64)>,
    is_steady: bool,
    /// Whether a node or a file was refused that may define more, so that what is not known may be there.
    lacks_nodes: bool,
    /// How many names are still compared with unknown ones, to find what was meant.
    comparisons: usize,
    pub(super) findings: Findings,
    /// What was found in tables.
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
            comparisons: MOST_COMPARISONS,
            findings: Findings::new(name),
            found: Vec::new(),
        }
    }

    /// The line of a byte, from 1.
    fn line(&self, byte: usize) -> u64 {
        self.line_starts.partition_point(|&start| start <= byte.min(self.text.len())) as u64
    }

    /// The place of what begins at a byte: a key, a number, a text.
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

    fn report(&mut self, rule: &Rule, line: u64, message: impl Into<String>, help: &str) {
        self.findings.report(rule, Place::of_line(line), message, help);
    }

    fn refuse(&mut self, line: u64, refusal: Refusal) {
        let Refusal { rule, column, message, help } = refusal;
        self.findings.report(rule, Place { column, ..Place::of_line(line) }, message, help);
    }

    /// A number as it is written.
    fn written(&self, number: &Number) -> &'a str {
        self.text.get(number.span()).unwrap_or_default()
    }

    /// The value of a key; reports one that cannot be used.
    fn value(&mut self, key: &str, number: Option<&Number>, what: impl FnOnce() -> String) -> Option<f64> {
        let number = number?;
        let line = self.line(number.span().start);
        if let Err(refusal) = usable::number(key, number.value(), self.written(number), what) {
            self.refuse(line, refusal);
        }
        Some(number.value())
    }

    fn take(&mut self, file: SceneFile, files: &mut dyn SceneFiles) {
        let procedure = self.procedure(&file);
        self.is_steady = file.procedure == ProcedureName::Steady;
        let key = "joule_heat_fraction";
        let fraction = self.value(key, file.joule_heat_fraction.as_ref(), || format!("`{key}`")).unwrap_or(0.0);
        let Keyed(entry) = file.initial;
        let mut initial = |key: &str, number: Option<&Number>| self.value(key, number, || format!("`initial.{key}`"));
        let mut scene = Scene {
            deck: file.deck.into_inner(),
            procedure,
            initial_temperature: initial("temperature", entry.temperature.as_ref()),
            initial_pore_pressure: initial("pore_pressure", entry.pore_pressure.as_ref()),
            nodes: Vec::new(),
            node_lines: BTreeMap::new(),
            conditions: std::array::from_fn(|_| Conditions::default()),
            links: Vec::new(),
            interfaces: Vec::new(),
        };
        for node in file.nodes.0 {
            self.take_node(node.into_inner().0, &mut scene);
        }
        for entry in file.node_files.0 {
            self.take_node_file(&entry.into_inner().0.file, files, &mut scene);
        }
        // Where the scene names nodes, another name in a table of links is a slip; rows of a matrix have no names but their numbers.
        let links_define_nodes = scene.nodes.is_empty() && !self.lacks_nodes;
        let link_files: Vec<LinkFileEntry> = file.link_files.0.into_iter().map(|entry| entry.into_inner().0).collect();
        // First, so that all links and interfaces can name their nodes.
        let mut matrices: Vec<Option<Vec<SceneLink>>> =
            link_files.iter().map(|entry| self.take_matrix(entry, fraction, files, &mut scene)).collect();
        for link in file.links.0 {
            let line = self.line_of(&link);
            self.take_link(link.into_inner().0, line, fraction, &mut scene);
        }
        for (entry, links) in link_files.iter().zip(&mut matrices) {
            match links {
                Some(links) => scene.links.append(links),
                None => self.take_link_file(&entry.file, links_define_nodes, fraction, files, &mut scene),
            }
        }
        for interface in file.interfaces.0 {
            let line = self.line_of(&interface);
            self.take_interface(interface.into_inner().0, line, &mut scene);
        }
        for entry in file.interface_files.0 {
            self.take_interface_file(&entry.into_inner().0.file, files, &mut scene);
        }
        // Whatever else is wrong comes first.
        if scene.nodes.is_empty() && !self.lacks_nodes && !self.findings.has_errors() && self.found.is_empty() {
            let help = "add a [[node]] for each point whose potential, temperature or pore pressure is sought or held, or a [[node_file]]";
            self.report(&MALFORMED_SCENE, 1, "the scene has no nodes, so that there is nothing to solve", help);
        }
        self.scene = Some(scene);
    }

    fn take_node_file(&mut self, name: &Spanned<String>, files: &mut dyn SceneFiles, scene: &mut Scene) {
        let source = self.sources.len();
        self.sources.push(name.as_ref().clone());
        let is_whole = self.take_file(name, files, |reader, text, findings| {
            tables::nodes(text, findings, &mut |row| {
                let number = reader.define_at(&row.name, (source, row.line), scene)?;
                for (field, condition) in Field::ALL.into_iter().zip(row.conditions) {
                    put_condition(scene, field, number, condition);
                }
                Ok(())
            });
        });
        self.lacks_nodes |= !is_whole;
    }

    /// The links of a matrix, whose rows are nodes; `None` for a table.
    fn take_matrix(
        &mut self,
        entry: &LinkFileEntry,
        joule_heat_fraction: f64,
        files: &mut dyn SceneFiles,
        scene: &mut Scene,
    ) -> Option<Vec<SceneLink>> {
        if !entry.file.as_ref().to_ascii_lowercase().ends_with(".mtx") {
            return None;
        }
        let mut links = Vec::new();
        let is_whole = self.take_file(&entry.file, files, |reader, text, findings| {
            matrix::matrix(text, entry.conducts.map(field_of), findings, &mut |ends: [u32; 2], conductances| {
                let nodes = ends.map(|end| reader.number_or_new(&format!("{}{end}", entry.prefix), scene));
                links.push(SceneLink { nodes, conductances, joule_heat_fraction });
            });
        });
        self.lacks_nodes |= !is_whole;
        Some(links)
    }

    fn take_link_file(
        &mut self,
        name: &Spanned<String>,
        defines_nodes: bool,
        default: f64,
        files: &mut dyn SceneFiles,
        scene: &mut Scene,
    ) {
        let is_whole = self.take_file(name, files, |reader, text, findings| {
            tables::links(text, findings, &mut |row| {
                let mut numbers = [None; 2];
                for (end, name) in row.nodes.iter().enumerate() {
                    numbers[end] = if defines_nodes {
                        Some(reader.number_or_new(name, scene))
                    } else {
                        reader.known(name, scene).map_err(|refusal| (end, refusal))?
                    };
                }
                if let [Some(first), Some(second)] = numbers {
                    let joule_heat_fraction = row.joule_heat_fraction.unwrap_or(default);
                    let (nodes, conductances) = ([first, second], row.conductances);
                    scene.links.push(SceneLink { nodes, conductances, joule_heat_fraction });
                }
                Ok(())
            });
        });
        self.lacks_nodes |= defines_nodes && !is_whole;
    }

    fn take_interface_file(&mut self, name: &Spanned<String>, files: &mut dyn SceneFiles, scene: &mut Scene) {
        self.take_file(name, files, |reader, text, findings| {
            tables::interfaces(text, findings, &mut |row| {
                let slave = reader.known(&row.slave, scene).map_err(|refusal| (0, refusal))?;
                let master = reader.known(&row.master, scene).map_err(|refusal| (1, refusal))?;
                if let (Some(slave), Some(master)) = (slave, master) {
                    let place = (row.interface.place.0, Some(name.as_ref().clone()));
                    scene.interfaces.push(SceneInterface { slave, master, place, ..row.interface });
                }
                Ok(())
            });
        });
    }

    /// Reads a table beside the scene file; whether nothing is wrong with it.
    fn take_file(
        &mut self,
        name: &Spanned<String>,
        files: &mut dyn SceneFiles,
        take: impl FnOnce(&mut Self, &[u8], &mut Findings),
    ) -> bool {
        let Some(bytes) = files.read(name.as_ref()) else { return false };
        let mut findings = Findings::new(name.as_ref());
        take(self, &bytes, &mut findings);
        let is_whole = !findings.has_errors();
        self.found.append(&mut findings.into_list());
        is_whole
    }

    fn procedure(&mut self, file: &SceneFile) -> Procedure {
        match (file.procedure, &file.time) {
            (ProcedureName::Steady, None) => Procedure::Steady,
            (ProcedureName::Steady, Some(time)) => {
                let line = self.line_of(time);
                let help = "write procedure = \"transient\", or leave `time` out";
                self.report(&MALFORMED_TIME, line, "a steady state has no `time`", help);
                Procedure::Steady
            }
            (ProcedureName::Transient, None) => {
                let help = "add [time] with `end`, and `step` or `tolerance`";
                self.report(&MALFORMED_TIME, 1, "a transient needs `time`", help);
                Procedure::Steady
            }
            (ProcedureName::Transient, Some(time)) => {
                let Keyed(entry) = time.as_ref();
                self.time_span(entry).map_or_else(
                    |(number, message, help)| {
                        let line = number.map_or_else(|| self.line_of(time), |number| self.line(number.span().start));
                        self.report(&MALFORMED_TIME, line, message, help);
                        Procedure::Steady
                    },
                    Procedure::Transient,
                )
            }
        }
    }

    /// The time of a transient; or the number that is wrong, what is wrong, and what to do.
    fn time_span<'n>(&self, entry: &'n TimeEntry) -> Result<TimeSpan, (Option<&'n Number>, String, &'static str)> {
        let TimeEntry { start, end, step, tolerance, first_step, start_from, closing_heat } = entry;
        for (name, number) in [("start", start.as_ref()), ("end", Some(end))] {
            if let Some(number) = number.filter(|number| !number.value().is_finite()) {
                return Err((Some(number), format!("`{name}` is {}", self.written(number)), "give a finite time"));
            }
        }
        let (from, to) = (start.as_ref().map_or(0.0, Number::value), end.value());
        if to <= from {
            let from = start.as_ref().map_or("0.0", |start| self.written(start));
            let message = format!("the time goes from {from} to {}", self.written(end));
            return Err((Some(end), message, "let `end` be later than `start`"));
        }
        let positive = |number: &'n Option<Number>, name: &str| match number {
            Some(number) if !(number.value() > 0.0 && number.value().is_finite()) => {
                Err((Some(number), format!("`{name}` is {}", self.written(number)), "give a finite number above zero"))
            }
            number => Ok(number.as_ref().map(Number::value)),
        };
        let given = (positive(step, "step")?, positive(tolerance, "tolerance")?, positive(first_step, "first_step")?);
        let steps = match given {
            (Some(step), None, None) => Steps::Given(step),
            (Some(_), None, Some(_)) => {
                let message = "`first_step` stands beside `step`".to_owned();
                return Err((first_step.as_ref(), message, "leave one of the two out"));
            }
            (None, Some(tolerance), first) => Steps::ByError { tolerance, first: first.unwrap_or(1e-3 * (to - from)) },
            _ => {
                let help = "give `step` for increments of one length, or `tolerance` for increments by their error";
                return Err((None, "`time` needs one of `step` and `tolerance`".to_owned(), help));
            }
        };
        let start_from = match start_from {
            StartFromName::FirstRow => StartFrom::FirstRow,
            StartFromName::AtRest => StartFrom::AtRest,
        };
        let closing_heat = match closing_heat {
            ClosingHeatName::Balanced => ClosingHeat::Balanced,
            ClosingHeatName::Manual => ClosingHeat::Manual,
        };
        let span = TimeSpan { start: from, end: to, steps, start_from, closing_heat };
        let shown = |number: &Option<Number>| number.as_ref().map_or("", |number| self.written(number));
        if let Some(number) = tolerance.as_ref().filter(|tolerance| tolerance.value() < LEAST_TOLERANCE) {
            let message = format!("`tolerance` is {}, below what rounding leaves of an error", shown(tolerance));
            return Err((Some(number), message, "give a tolerance of 1e-12 or above"));
        }
        for (name, given) in [("step", step), ("first_step", first_step)] {
            if let Some(number) = given.as_ref().filter(|given| given.value() < span.resolution()) {
                let furthest = from.abs().max(to.abs());
                let message =
                    format!("`{name}` is {}, which rounding loses beside a time of {furthest:?}", shown(given));
                return Err((Some(number), message, "give a longer one, or count the time from a start nearer to 0"));
            }
        }
        if let Some(number) = step.as_ref().filter(|step| MOST_INCREMENTS < (to - from) / step.value()) {
            let increments = (to - from) / number.value();
            let message =
                format!("a `step` of {} makes {increments:.0} increments, more than {MOST_INCREMENTS:.0}", shown(step));
            return Err((Some(number), message, "give a longer `step`, or `tolerance` for increments by their error"));
        }
        Ok(span)
    }

    fn take_node(&mut self, entry: NodeEntry, scene: &mut Scene) {
        let line = self.line_of(&entry.name);
        let name = entry.name.into_inner();
        if let Err(refusal) = usable::node_name(&name, || "`name`".to_owned()) {
            self.lacks_nodes = true;
            return self.refuse(line, refusal);
        }
        let number = match self.define_at(&name, (0, line), scene) {
            Ok(number) => number,
            Err(refusal) => return self.refuse(line, refusal),
        };
        scene.node_lines.insert(number, line);
        let conditions = [entry.potential, entry.temperature, entry.pore_pressure];
        for (field, condition) in Field::ALL.into_iter().zip(conditions) {
            let Some(condition) = condition else { continue };
            let line = self.line_of(&condition);
            if let Some(condition) = self.checked(field, condition.into_inner().0, line, &name) {
                put_condition(scene, field, number, condition);
            }
        }
    }

    /// A condition whose numbers can be used.
    fn checked(&mut self, field: Field, condition: Condition, line: u64, node: &str) -> Option<CheckedCondition> {
        // What is named carries the field, be there nothing to say of it.
        let is_named_only = condition == Condition::default();
        let Condition { fixed, source, capacity, initial } = condition;
        let given = Given {
            fixed: fixed.is_some(),
            source: source.is_some(),
            capacity: capacity.is_some(),
            initial: initial.is_some(),
        };
        if let Err(refusal) = usable::condition(field, given, node) {
            self.refuse(line, refusal);
            return None;
        }
        let label = format!("`{}` of `{node}`", field.key());
        let capacity = self.value("capacity", capacity.as_ref(), || format!("`capacity` of {label}"));
        let initial = self.value("initial", initial.as_ref(), || format!("`initial` of {label}"));
        let fixed = self.course("fixed", fixed, &label);
        let source = self.course("source", source, &label);
        let source = if is_named_only { Some(Course::constant(0.0)) } else { source };
        Some(CheckedCondition { fixed, source, capacity, initial })
    }

    /// The course that a key of something gives; reports one that cannot be used.
    fn course(&mut self, key: &str, course: Option<Spanned<file::Course>>, label: &str) -> Option<Course> {
        let course = course?;
        let (span, line) = (course.span(), self.line_of(&course));
        let what = format!("`{key}` of {label}");
        let points = match course.into_inner() {
            file::Course::Constant(value) => {
                let written = self.text.get(span).unwrap_or_default();
                let refused =
                    usable::number(key, value, written, || what).map_err(|refusal| self.refuse(line, refusal));
                return refused.is_ok().then(|| Course::constant(value));
            }
            file::Course::Points(points) => points,
        };
        let pairs = points.iter().zip(points.iter().skip(1));
        let late = pairs.map(|(before, after)| (before[0], after[0])).find(|(before, after)| after <= before);
        let time = points.iter().map(|point| point[0]).find(|time| !time.is_finite());
        let message = if points.is_empty() {
            format!("{what} has no points")
        } else if let Some(time) = time {
            format!("a time of {what} is {time:?}, which is not finite")
        } else if let Some((before, after)) = late {
            format!("the times of {what} do not ascend: {after:?} stands behind {before:?}")
        } else if self.is_steady {
            let help = "give a number, or write procedure = \"transient\"";
            self.report(&MALFORMED_TIME, line, format!("{what} follows time, and a steady state has none"), help);
            return None;
        } else {
            let unusable = points.iter().find_map(|&[time, value]| {
                usable::number(key, value, &format!("{value:?}"), || format!("{what} at time {time:?}")).err()
            });
            return match unusable {
                Some(refusal) => {
                    self.refuse(line, refusal);
                    None
                }
                None => Some(Course::through(points)),
            };
        };
        let help = "give a number, or points of time and value whose times ascend, such as [[0.0, 20.0], [1.0, 80.0]]";
        self.report(&MALFORMED_TIME, line, message, help);
        None
    }

    fn take_link(&mut self, entry: LinkEntry, line: u64, default: f64, scene: &mut Scene) {
        let at = self.line_of(&entry.nodes);
        let Pair(names) = entry.nodes.into_inner();
        let numbers = [0, 1].map(|end| self.number(&names[end], at, "a name in `nodes`", scene));
        let label = format!("the link of `{}` and `{}`", names[0], names[1]);
        if let Err(refusal) = usable::joined([&names[0], &names[1]], "the link") {
            return self.refuse(at, refusal);
        }
        let given = [&entry.electrical, &entry.thermal, &entry.hydraulic];
        if let Err(refusal) = usable::conducting(given.iter().any(|conductance| conductance.is_some()), &label) {
            self.refuse(line, refusal);
        }
        let conductances = Field::ALL.map(|field| {
            let key = field.conductance_key();
            let conductance = self.value(key, given[field.index()].as_ref(), || format!("`{key}` of {label}"));
            conductance.unwrap_or(0.0)
        });
        let key = "joule_heat_fraction";
        let fraction = self.value(key, entry.joule_heat_fraction.as_ref(), || format!("`{key}` of {label}"));
        if let [Some(first), Some(second)] = numbers {
            let joule_heat_fraction = fraction.unwrap_or(default);
            scene.links.push(SceneLink { nodes: [first, second], conductances, joule_heat_fraction });
        }
    }

    fn take_interface(&mut self, entry: InterfaceEntry, line: u64, scene: &mut Scene) {
        let ends = [(&entry.slave, "`slave`"), (&entry.master, "`master`")];
        let numbers = ends.map(|(name, what)| self.number(name.as_ref(), self.line_of(name), what, scene));
        let [slave, master] = [entry.slave.as_ref(), entry.master.as_ref()];
        let label = format!("the interface of `{slave}` and `{master}`");
        if entry.fv.0.len() > MOST_FIELD_VARIABLES {
            let message = format!("`fv` of {label} has {} numbers", entry.fv.0.len());
            let help = format!("a deck has {MOST_FIELD_VARIABLES} field variables at most");
            self.report(&MALFORMED_SCENE, line, message, &help);
        }
        let mut field_variables = Vec::new();
        for (number, position) in entry.fv.0.iter().zip(1..) {
            field_variables.extend(self.value("fv", Some(number), || format!("`fv{position}` of {label}")));
        }
        let clearance = self.course("clearance", entry.clearance, &label);
        let pressure = self.course("pressure", entry.pressure, &label);
        let mut value = |key: &str, number: Option<&Number>| self.value(key, number, || format!("`{key}` of {label}"));
        let interface = SceneInterface {
            interaction: entry.interaction.map(|name| Name::new(name.as_ref())),
            slave: 0,
            master: 0,
            area: value("area", Some(&entry.area)).unwrap_or_default(),
            clearance,
            pressure,
            closed: entry.closed,
            field_variables,
            temperature: value("temperature", entry.temperature.as_ref()),
            mass_flow: value("mass_flow", entry.mass_flow.as_ref()),
            shear: value("shear", entry.shear.as_ref()),
            slip_rate: value("slip_rate", entry.slip_rate.as_ref()),
            clearance_rate: value("clearance_rate", entry.clearance_rate.as_ref()),
            characteristic_length: value("char_length", entry.char_length.as_ref()),
            bulk_permeabilities: [value("perm_s", entry.perm_s.as_ref()), value("perm_m", entry.perm_m.as_ref())],
            place: (line, None),
        };
        if let Err(refusal) = usable::joined([slave, master], "the interface") {
            self.refuse(line, refusal);
        } else if let [Some(slave), Some(master)] = numbers {
            scene.interfaces.push(SceneInterface { slave, master, ..interface });
        }
    }

    /// The number of a new node; that of the old one where the name is taken.
    fn define(&mut self, name: &str, scene: &mut Scene) -> Result<u32, u32> {
        if let Some(&number) = self.numbers.get(name) {
            return Err(number);
        }
        let number = index(scene.nodes.len());
        scene.nodes.push(name.to_owned());
        self.numbers.insert(name.to_owned(), number);
        Ok(number)
    }

    fn number_or_new(&mut self, name: &str, scene: &mut Scene) -> u32 {
        match self.define(name, scene) {
            Ok(number) | Err(number) => number,
        }
    }

    /// The number of a new node that a source defines in a line.
    fn define_at(&mut self, name: &str, (source, line): (usize, u64), scene: &mut Scene) -> Result<u32, Refusal> {
        let number = self.define(name, scene).map_err(|number| {
            let (first_source, first) = self.origins[number as usize];
            let file =
                if first_source == source { String::new() } else { format!(" of `{}`", self.sources[first_source]) };
            let message = format!("node `{name}` is defined twice, first in line {first}{file}");
            Refusal::new(&DUPLICATE_NODE, message, "give every node a name of its own")
        })?;
        self.origins.push((source, line));
        Ok(number)
    }

    /// The number of a node that is named in a line of the scene file.
    fn number(&mut self, name: &str, line: u64, what: &str, scene: &Scene) -> Option<u32> {
        let is_named = usable::node_name(name, || what.to_owned());
        let number = is_named.and_then(|()| self.known(name, scene));
        number.unwrap_or_else(|refusal| {
            self.refuse(line, refusal);
            None
        })
    }

    /// The number of a node; `None` where a file may define it that was refused.
    fn known(&mut self, name: &str, scene: &Scene) -> Result<Option<u32>, Refusal> {
        let number = self.numbers.get(name).copied();
        if number.is_some() || self.lacks_nodes {
            return Ok(number);
        }
        let left = self.comparisons.checked_sub(scene.nodes.len());
        self.comparisons = left.unwrap_or(self.comparisons);
        let compared = if left.is_some() { &scene.nodes[..] } else { &[] };
        let meant = meant_or(name, compared.iter().map(String::as_str), "");
        let otherwise = if meant.is_empty() { "add" } else { " Otherwise add" };
        let help = format!("{meant}{otherwise} a [[node]] of that name");
        Err(Refusal::new(&UNKNOWN_NODE, format!("the scene defines no node `{name}`"), help))
    }
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

fn field_of(conducts: file::Conducts) -> Field {
    match conducts {
        file::Conducts::Electrical => Field::Potential,
        file::Conducts::Thermal => Field::Temperature,
        file::Conducts::Hydraulic => Field::PorePressure,
    }
}
