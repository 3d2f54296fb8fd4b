//! From the text of a scene file, and of the tables it names, to a scene.
//!
//! Every problem found is reported, with its line; a scene with errors is not given.

use super::course::Course;
use super::diagnostic::{DUPLICATE_NODE, MALFORMED_SCENE, MALFORMED_TIME, UNKNOWN_NODE, UNUSABLE_NUMBER};
use super::file::{self, Condition, InterfaceEntry, LinkEntry, NodeEntry, ProcedureName, SceneFile, TimeEntry};
use super::tables;
use super::usable::{Unusable, unusable_numbers};
use super::{Conditions, Field, Procedure, Scene, SceneInterface, SceneLink, Steps, TimeSpan};
use crate::linear::index;
use inpact_evaluation::nodes::{DataDiagnostic, DataRule, Findings, Place};
use inpact_parser::grammar::nearest_names;
use inpact_parser::model::Name;
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
pub fn read(text: &str, name: &str, files: &mut dyn SceneFiles) -> (Option<Scene>, Vec<DataDiagnostic>) {
    let mut reader = Reader::new(text, name);
    match toml::from_str::<SceneFile>(text) {
        Ok(file) => reader.take(file, files),
        Err(error) => {
            let line = error.span().map(|span| reader.line(span.start));
            // Some messages of the parser have several lines.
            let message = error.message().lines().collect::<Vec<_>>().join("; ");
            reader.findings.report(&MALFORMED_SCENE, Place { line, ..Place::default() }, message, "");
        }
    }
    let Reader { scene, findings, mut found, .. } = reader;
    let mut all = findings.into_list();
    all.append(&mut found);
    let has_errors = all.iter().any(|found| found.severity == inpact_validation::Severity::Error);
    (if has_errors { None } else { scene }, all)
}

/// A scene in the making.
pub(super) struct Reader<'a> {
    text: &'a str,
    /// Where lines begin.
    line_starts: Vec<usize>,
    scene: Option<Scene>,
    numbers: HashMap<String, u32>,
    is_steady: bool,
    /// Whether a table of nodes was refused, so that nodes are not known that it may define.
    lacks_nodes: bool,
    pub(super) findings: Findings,
    /// What was found in tables.
    found: Vec<DataDiagnostic>,
}

impl<'a> Reader<'a> {
    fn new(text: &'a str, name: &str) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(place, _)| place + 1);
        Self {
            text,
            line_starts: std::iter::once(0).chain(starts).collect(),
            scene: None,
            numbers: HashMap::new(),
            is_steady: true,
            lacks_nodes: false,
            findings: Findings::new(name),
            found: Vec::new(),
        }
    }

    /// The line of a byte, from 1.
    fn line(&self, byte: usize) -> u64 {
        self.line_starts.partition_point(|&start| start <= byte.min(self.text.len())) as u64
    }

    fn line_of<T>(&self, spanned: &Spanned<T>) -> u64 {
        self.line(spanned.span().start)
    }

    fn report(&mut self, rule: &DataRule, line: u64, message: impl Into<String>, help: &str) {
        self.findings.report(rule, Place { line: Some(line), ..Place::default() }, message, help);
    }

    fn take(&mut self, file: SceneFile, files: &mut dyn SceneFiles) {
        let procedure = self.procedure(&file);
        self.is_steady = file.procedure == ProcedureName::Steady;
        self.check_fraction(file.joule_heat_fraction, 1, "`joule_heat_fraction`");
        for (value, what) in [
            (file.initial.temperature.unwrap_or(0.0), "`initial.temperature`"),
            (file.initial.pore_pressure.unwrap_or(0.0), "`initial.pore_pressure`"),
        ] {
            self.check_finite(value, 1, what);
        }
        let mut scene = Scene {
            deck: file.deck.into_inner(),
            procedure,
            initial_temperature: file.initial.temperature,
            initial_pore_pressure: file.initial.pore_pressure,
            nodes: Vec::new(),
            node_lines: BTreeMap::new(),
            conditions: std::array::from_fn(|_| Conditions::default()),
            links: Vec::new(),
            interfaces: Vec::new(),
        };
        for node in file.nodes {
            self.take_node(node.into_inner(), &mut scene);
        }
        for entry in &file.node_files {
            let is_whole = self.take_file(&entry.file, files, |reader, text, findings| {
                tables::nodes(text, findings, &mut |row| {
                    let number = reader
                        .define(&row.name, &mut scene)
                        .map_err(|_| (&DUPLICATE_NODE, format!("node `{}` is defined twice", row.name)))?;
                    for (field, condition) in Field::ALL.into_iter().zip(row.conditions) {
                        put_condition(&mut scene, field, number, condition);
                    }
                    Ok(())
                });
            });
            self.lacks_nodes |= !is_whole;
        }
        for link in file.links {
            let line = self.line_of(&link);
            self.take_link(link.into_inner(), line, file.joule_heat_fraction, &mut scene);
        }
        for entry in &file.link_files {
            let is_matrix = entry.file.as_ref().to_ascii_lowercase().ends_with(".mtx");
            self.take_file(&entry.file, files, |reader, text, findings| {
                let default = file.joule_heat_fraction;
                if is_matrix {
                    let conducts = entry.conducts.map(field_of);
                    tables::matrix(text, conducts, findings, &mut |ends: [u32; 2], conductances| {
                        let nodes = ends.map(|end| reader.number_or_new(&format!("{}{end}", entry.prefix), &mut scene));
                        scene.links.push(SceneLink { nodes, conductances, joule_heat_fraction: default });
                    });
                } else {
                    tables::links(text, findings, &mut |row| {
                        let nodes = row.nodes.map(|name| reader.number_or_new(&name, &mut scene));
                        let joule_heat_fraction = row.joule_heat_fraction.unwrap_or(default);
                        scene.links.push(SceneLink { nodes, conductances: row.conductances, joule_heat_fraction });
                    });
                }
            });
        }
        for interface in file.interfaces {
            let line = self.line_of(&interface);
            self.take_interface(interface.into_inner(), line, &mut scene);
        }
        for entry in &file.interface_files {
            let name = entry.file.as_ref().clone();
            self.take_file(&entry.file, files, |reader, text, findings| {
                tables::interfaces(text, findings, &mut |row, line| {
                    let [slave, master] = [&row.slave, &row.master].map(|name| reader.numbers.get(name).copied());
                    if reader.lacks_nodes && (slave.is_none() || master.is_none()) {
                        return Ok(());
                    }
                    let unknown = |name: &str| (&UNKNOWN_NODE, format!("the scene defines no node `{name}`"));
                    let slave = slave.ok_or_else(|| unknown(&row.slave))?;
                    let master = master.ok_or_else(|| unknown(&row.master))?;
                    let place = (line, Some(name.clone()));
                    scene.interfaces.push(SceneInterface { slave, master, place, ..row.interface });
                    Ok(())
                });
            });
        }
        self.scene = Some(scene);
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
                let line = self.line_of(time);
                match time_span(*time.as_ref()) {
                    Ok(span) => Procedure::Transient(span),
                    Err((message, help)) => {
                        self.report(&MALFORMED_TIME, line, message, help);
                        Procedure::Steady
                    }
                }
            }
        }
    }

    fn take_node(&mut self, entry: NodeEntry, scene: &mut Scene) {
        let line = self.line_of(&entry.name);
        let name = entry.name.into_inner();
        let number = match self.define(&name, scene) {
            Ok(number) => number,
            Err(number) => {
                let before =
                    scene.node_lines.get(&number).map_or(String::new(), |line| format!(", first in line {line}"));
                let help = "give every node a name of its own";
                self.report(&DUPLICATE_NODE, line, format!("node `{name}` is defined twice{before}"), help);
                return;
            }
        };
        scene.node_lines.insert(number, line);
        let conditions = [entry.potential, entry.temperature, entry.pore_pressure];
        for (field, condition) in Field::ALL.into_iter().zip(conditions) {
            let Some(condition) = condition else { continue };
            let line = self.line_of(&condition);
            if let Some(condition) = self.checked(field, condition.into_inner(), line, &name) {
                put_condition(scene, field, number, condition);
            }
        }
    }

    /// A condition whose numbers can be used.
    fn checked(&mut self, field: Field, condition: Condition, line: u64, node: &str) -> Option<CheckedCondition> {
        let key = field.key();
        // What is named carries the field, be there nothing to say of it.
        let is_named_only = condition == Condition::default();
        let Condition { fixed, source, capacity, initial } = condition;
        let source = if is_named_only { Some(file::Course::Constant(0.0)) } else { source };
        if fixed.is_some() && (source.is_some() || capacity.is_some()) {
            let other = if source.is_some() { "source" } else { "capacity" };
            let help = "what is held takes up whatever flows there: leave one of the two out";
            let message = format!("the {field} of `{node}` has `fixed` and `{other}`");
            self.report(&MALFORMED_SCENE, line, message, help);
            return None;
        }
        if field == Field::Potential && (capacity.is_some() || initial.is_some()) {
            let help = "currents are steady at every instant (direct current), as in Abaqus";
            self.report(
                &MALFORMED_SCENE,
                line,
                format!("the potential of `{node}` cannot have a capacity or an initial value"),
                help,
            );
            return None;
        }
        if let Some(capacity) = capacity.filter(|capacity| !(*capacity >= 0.0 && capacity.is_finite())) {
            let message = format!("`capacity` of `{key}` of `{node}` is {capacity:?}");
            self.report(&UNUSABLE_NUMBER, line, message, "give a finite number of zero or above");
        }
        if let Some(initial) = initial {
            self.check_finite(initial, line, &format!("`initial` of `{key}` of `{node}`"));
        }
        let mut course = |course: Option<file::Course>, what: &str| {
            self.course(course?, line, &format!("`{what}` of `{key}` of `{node}`"))
        };
        Some(CheckedCondition { fixed: course(fixed, "fixed"), source: course(source, "source"), capacity, initial })
    }

    fn course(&mut self, course: file::Course, line: u64, what: &str) -> Option<Course> {
        let course = match course {
            file::Course::Constant(value) => Course::constant(value),
            file::Course::Points(points) => {
                let is_ascending = points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
                let is_finite = points.iter().all(|point| point[0].is_finite());
                if points.is_empty() || !is_ascending || !is_finite {
                    let help = "give points [time, value] whose times ascend";
                    self.report(&MALFORMED_TIME, line, format!("the times of {what} do not ascend"), help);
                    return None;
                }
                if self.is_steady {
                    let help = "give a number, or write procedure = \"transient\"";
                    self.report(
                        &MALFORMED_TIME,
                        line,
                        format!("{what} follows time, and a steady state has none"),
                        help,
                    );
                    return None;
                }
                Course::through(points)
            }
        };
        let values: Vec<f64> = course.values().collect();
        values.iter().all(|&value| self.check_finite(value, line, what)).then_some(course)
    }

    fn check_fraction(&mut self, value: f64, line: u64, what: &str) {
        if !(0.0..=1.0).contains(&value) {
            let help = "give a share of the energy dissipated, from 0 to 1";
            self.report(&UNUSABLE_NUMBER, line, format!("{what} is {value:?}"), help);
        }
    }

    fn check_finite(&mut self, value: f64, line: u64, what: &str) -> bool {
        if !value.is_finite() {
            self.report(&UNUSABLE_NUMBER, line, format!("{what} is {value:?}"), "give a finite number");
        }
        value.is_finite()
    }

    fn take_link(&mut self, entry: LinkEntry, line: u64, default: f64, scene: &mut Scene) {
        let at = self.line_of(&entry.nodes);
        let names = entry.nodes.into_inner();
        let numbers = [0, 1].map(|end| self.number(&names[end], at, scene));
        let label = format!("the link of `{}` and `{}`", names[0], names[1]);
        if names[0] == names[1] {
            self.report(&MALFORMED_SCENE, at, format!("{label} joins a node to itself"), "name two nodes");
            return;
        }
        let given = [entry.electrical, entry.thermal, entry.hydraulic];
        if given.iter().all(Option::is_none) {
            let help = "give `electrical`, `thermal` or `hydraulic`";
            self.report(&MALFORMED_SCENE, line, format!("{label} conducts nothing"), help);
        }
        for (field, conductance) in Field::ALL.into_iter().zip(&given) {
            let Some(spanned) = conductance else { continue };
            let conductance = *spanned.as_ref();
            if conductance.is_nan() || conductance < 0.0 {
                let (key, at) = (field.conductance_key(), self.line_of(spanned));
                let help = "give a conductance of zero or above; `inf` makes both nodes one";
                self.report(&UNUSABLE_NUMBER, at, format!("`{key}` of {label} is {conductance:?}"), help);
            }
        }
        let fraction = entry.joule_heat_fraction.unwrap_or(default);
        if entry.joule_heat_fraction.is_some() {
            self.check_fraction(fraction, line, &format!("`joule_heat_fraction` of {label}"));
        }
        if let [Some(first), Some(second)] = numbers {
            scene.links.push(SceneLink {
                nodes: [first, second],
                conductances: given.map(|conductance| conductance.map_or(0.0, Spanned::into_inner)),
                joule_heat_fraction: fraction,
            });
        }
    }

    fn take_interface(&mut self, entry: InterfaceEntry, line: u64, scene: &mut Scene) {
        let ends = [&entry.slave, &entry.master].map(|end| (self.line_of(end), end.as_ref().clone()));
        let numbers = ends.clone().map(|(at, name)| self.number(&name, at, scene));
        let [(_, slave), (_, master)] = ends;
        let label = format!("the interface of `{slave}` and `{master}`");
        let clearance = entry.clearance.map(|course| self.course(course, line, &format!("`clearance` of {label}")));
        let pressure = entry.pressure.map(|course| self.course(course, line, &format!("`pressure` of {label}")));
        let interface = SceneInterface {
            interaction: entry.interaction.map(|name| Name::new(name.as_ref())),
            slave: 0,
            master: 0,
            area: entry.area,
            clearance: clearance.flatten(),
            pressure: pressure.flatten(),
            closed: entry.closed,
            field_variables: entry.fv,
            temperature: entry.temperature,
            mass_flow: entry.mass_flow,
            shear: entry.shear,
            slip_rate: entry.slip_rate,
            clearance_rate: entry.clearance_rate,
            characteristic_length: entry.char_length,
            bulk_permeabilities: [entry.perm_s, entry.perm_m],
            place: (line, None),
        };
        for unusable in unusable_numbers(&interface) {
            let Unusable { key, value, .. } = &unusable;
            self.report(&UNUSABLE_NUMBER, line, format!("`{key}` of {label} is {value:?}"), unusable.help());
        }
        if slave == master {
            self.report(&MALFORMED_SCENE, line, format!("{label} joins a node to itself"), "name two nodes");
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

    /// The number of a node that is named in a line.
    fn number(&mut self, name: &str, line: u64, scene: &Scene) -> Option<u32> {
        let found = self.numbers.get(name).copied();
        if found.is_none() && !self.lacks_nodes {
            let near = nearest_names(name.as_bytes(), scene.nodes.iter().map(String::as_str), 3);
            let near: Vec<String> = near.iter().map(|name| format!("`{name}`")).collect();
            let help = if near.is_empty() {
                "add a [[node]] of that name".to_owned()
            } else {
                format!("is {} meant? Otherwise add a [[node]] of that name", near.join(" or "))
            };
            self.report(&UNKNOWN_NODE, line, format!("the scene defines no node `{name}`"), &help);
        }
        found
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

fn time_span(entry: TimeEntry) -> Result<TimeSpan, (String, &'static str)> {
    let TimeEntry { start, end, step, tolerance, first_step } = entry;
    if !(start < end && start.is_finite() && end.is_finite()) {
        return Err((format!("the time goes from {start:?} to {end:?}"), "let `end` be later than `start`"));
    }
    let positive = |number: Option<f64>, name: &str| match number {
        Some(number) if !(number > 0.0 && number.is_finite()) => {
            Err((format!("`{name}` is {number:?}"), "give a finite number above zero"))
        }
        number => Ok(number),
    };
    let steps = match (positive(step, "step")?, positive(tolerance, "tolerance")?, positive(first_step, "first_step")?)
    {
        (Some(step), None, None) => Steps::Given(step),
        (Some(_), None, Some(_)) => {
            return Err(("`first_step` stands beside `step`".to_owned(), "leave one of the two out"));
        }
        (None, Some(tolerance), first) => Steps::ByError { tolerance, first: first.unwrap_or(1e-3 * (end - start)) },
        _ => {
            let help = "give `step` for increments of one length, or `tolerance` for increments by their error";
            return Err(("`time` needs one of `step` and `tolerance`".to_owned(), help));
        }
    };
    Ok(TimeSpan { start, end, steps })
}
