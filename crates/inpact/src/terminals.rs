//! Terminals: parts of a mesh that are one node of a scene each, with their conditions in the deck.
//!
//! Used where a scene takes its conditions from the deck, and where a deck becomes a scene: one interpretation of *BOUNDARY, of fluxes and of films on a set.

use inpact_geometry::{NodeId, Placed, face_areas};
use inpact_network::scene::{Course, Field};
use inpact_parser::mesh::{
    AmplitudeTime, AmplitudeValue, Condition, ConditionField, ConditionKind, DeckConditions, InitialQuantity, Mesh,
    SurfaceKind,
};
use inpact_parser::model::{Model, Procedure, Regime};
use inpact_parser::number::read_float;
use inpact_parser::span::Span;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// A step of the deck, for its conditions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepTime {
    /// Whether conditions vary with time.
    pub(crate) regime: Regime,
    /// The length of the step (T).
    pub(crate) period: f64,
    /// The total time at its start (T); `None` where the previous steps do not give it.
    pub(crate) start: Option<f64>,
}

/// The conditions of the deck at a terminal.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stated {
    /// By field: the fixed value.
    pub(crate) fixed: [Option<Course>; 3],
    /// By field: the source.
    pub(crate) source: [Option<Course>; 3],
    /// By field: the initial value.
    pub(crate) initial: [Option<f64>; 3],
    pub(crate) films: Vec<Film>,
    /// Conditions that cannot be represented by one node: the field, the row, and the reason.
    pub(crate) faults: Vec<(Field, Span, String)>,
}

/// A film: a conductance to a sink.
#[derive(Debug, Clone)]
pub(crate) struct Film {
    /// Heat per time and temperature: coefficient times area.
    pub(crate) conductance: f64,
    pub(crate) sink: Course,
}

/// The conditions of a step by nodes and faces, and which of them terminals have taken.
pub(crate) struct Taker<'a> {
    mesh: &'a Mesh,
    conditions: &'a DeckConditions,
    time: StepTime,
    /// By field and node: the fixing condition; the last one applies.
    held: HashMap<(usize, NodeId), usize>,
    /// By field and node: the fluxes of the last step with any.
    flows: HashMap<(usize, NodeId), Vec<usize>>,
    faces: Vec<LoadedFace>,
    taken: BTreeSet<(usize, NodeId)>,
}

/// A face with a flux or a film.
struct LoadedFace {
    condition: usize,
    nodes: Vec<NodeId>,
    area: f64,
    is_taken: bool,
}

impl StepTime {
    /// The time of a step; the regime is that of the scene, independent of the deck's procedure.
    pub(crate) fn of(model: &Model, step: usize, regime: Regime) -> Self {
        let period = |step: usize| procedure(model, step).and_then(period_of);
        let before: Option<f64> = (1..step).map(period).sum();
        Self { regime, period: period(step).unwrap_or(1.0), start: before }
    }
}

pub(crate) fn procedure(model: &Model, step: usize) -> Option<&Procedure> {
    model.procedures.iter().find(|procedure| procedure.step == step)
}

/// The length of the step of a procedure, the second number of its row; 1 where the row leaves it out.
fn period_of(procedure: &Procedure) -> Option<f64> {
    match procedure.option.rows.iter().next().and_then(|row| row.get(1).map(|text| text.trim())) {
        None | Some("") => Some(1.0),
        Some(text) => read_float(text.as_bytes()).ok(),
    }
}

fn index_of(field: ConditionField) -> usize {
    match field {
        ConditionField::Potential => Field::Potential.index(),
        ConditionField::Temperature => Field::Temperature.index(),
        ConditionField::PorePressure => Field::PorePressure.index(),
    }
}

pub(crate) fn nodes_of(mesh: &Mesh, surface: usize) -> BTreeSet<NodeId> {
    match &mesh.surfaces[surface].kind {
        SurfaceKind::Faces(faces) => faces.surface.nodes().iter().copied().collect(),
        SurfaceKind::Nodes(nodes) => nodes.nodes.iter().copied().collect(),
    }
}

impl<'a> Taker<'a> {
    pub(crate) fn new(mesh: &'a Mesh, conditions: &'a DeckConditions, time: StepTime) -> Self {
        let mut taker = Self {
            mesh,
            conditions,
            time,
            held: HashMap::new(),
            flows: HashMap::new(),
            faces: Vec::new(),
            taken: BTreeSet::new(),
        };
        for (at, condition) in conditions.conditions.iter().enumerate() {
            let Some(surface) = condition.on else { continue };
            match condition.kind {
                ConditionKind::Held(field) => {
                    let nodes = nodes_of(mesh, surface).into_iter();
                    taker.held.extend(nodes.map(|node| ((index_of(field), node), at)));
                }
                ConditionKind::Flow(field) => {
                    for node in nodes_of(mesh, surface) {
                        let of_node = taker.flows.entry((index_of(field), node)).or_default();
                        // A later step replaces an earlier one, rows of one step add up.
                        of_node.retain(|other| conditions.conditions[*other].step == condition.step);
                        of_node.push(at);
                    }
                }
                ConditionKind::FlowPerArea(_) | ConditionKind::Film { .. } => taker.load_faces(at, condition, surface),
            }
        }
        taker
    }

    fn load_faces(&mut self, at: usize, condition: &Condition, surface: usize) {
        let SurfaceKind::Faces(faces) = &self.mesh.surfaces[surface].kind else { return };
        let thickness: Vec<f64> = faces.thickness.iter().map(|thickness| thickness.unwrap_or(1.0)).collect();
        let areas = Placed::new(&faces.surface, &self.mesh.points);
        let areas = areas.and_then(|placed| face_areas(&placed, faces.extent(&thickness))).unwrap_or_default();
        for (face, area) in faces.surface.faces().zip(areas) {
            let nodes = faces.surface.face(face).nodes.to_vec();
            let known = &self.conditions.conditions;
            self.faces.retain(|other| {
                let before = &known[other.condition];
                let is_same = std::mem::discriminant(&before.kind) == std::mem::discriminant(&condition.kind);
                !(before.step < condition.step && is_same && other.nodes == nodes)
            });
            self.faces.push(LoadedFace { condition: at, nodes, area, is_taken: false });
        }
    }

    /// The conditions of the deck at a terminal with these nodes; each is taken once.
    pub(crate) fn take(&mut self, nodes: &BTreeSet<NodeId>) -> Stated {
        let mut stated = Stated::default();
        for field in Field::ALL {
            self.take_held(field, nodes, &mut stated);
            self.take_flows(field, nodes, &mut stated);
        }
        self.take_films(nodes, &mut stated);
        for (field, quantity) in
            [(Field::Temperature, InitialQuantity::Temperature), (Field::PorePressure, InitialQuantity::PorePressure)]
        {
            if self.conditions.step <= 1 {
                stated.initial[field.index()] = self.initial(quantity, nodes);
            }
        }
        stated
    }

    /// The common initial value of all nodes; `None` where there is none.
    fn initial(&self, quantity: InitialQuantity, nodes: &BTreeSet<NodeId>) -> Option<f64> {
        let values = self.mesh.initial_values(quantity)?;
        let mut of_nodes = nodes.iter().map(|node| values[node.index()]);
        let first = of_nodes.next()??;
        of_nodes.all(|value| value == Some(first)).then_some(first)
    }

    fn take_held(&mut self, field: Field, nodes: &BTreeSet<NodeId>, stated: &mut Stated) {
        let at = field.index();
        let holders: Vec<usize> = nodes.iter().filter_map(|node| self.held.get(&(at, *node)).copied()).collect();
        let Some(&first) = holders.first() else { return };
        let condition = &self.conditions.conditions[first];
        let fault = |why: String| (field, condition.span, why);
        self.taken.extend(nodes.iter().map(|node| (at, *node)));
        if holders.len() < nodes.len() {
            let (some, all) = (holders.len(), nodes.len());
            stated.faults.push(fault(format!("*BOUNDARY holds the {field} of {some} of its {all} nodes only")));
            return;
        }
        let courses: Result<Vec<Course>, (Field, Span, String)> = holders
            .iter()
            .collect::<BTreeSet<_>>()
            .into_iter()
            .map(|holder| {
                let of = &self.conditions.conditions[*holder];
                self.course(of, of.magnitude).map_err(|why| (field, of.span, why))
            })
            .collect();
        match courses {
            Err(fault) => stated.faults.push(fault),
            Ok(courses) => match courses.iter().find(|course| **course != courses[0]) {
                Some(_) => {
                    stated.faults.push(fault(format!("*BOUNDARY holds its nodes at several values of the {field}")));
                }
                None => stated.fixed[at] = courses.into_iter().next(),
            },
        }
    }

    fn take_flows(&mut self, field: Field, nodes: &BTreeSet<NodeId>, stated: &mut Stated) {
        let at = field.index();
        let mut parts: BTreeMap<usize, f64> = BTreeMap::new();
        for node in nodes {
            // The flux of a node of two terminals goes to the first.
            if let Some(conditions) = self.flows.remove(&(at, *node)) {
                for condition in conditions {
                    *parts.entry(condition).or_default() += 1.0;
                }
            }
        }
        for face in self.faces.iter_mut().filter(|face| !face.is_taken) {
            let ConditionKind::FlowPerArea(of) = self.conditions.conditions[face.condition].kind else { continue };
            if index_of(of) == at && face.nodes.iter().all(|node| nodes.contains(node)) {
                face.is_taken = true;
                *parts.entry(face.condition).or_default() += face.area;
            }
        }
        let mut courses = Vec::new();
        for (condition, factor) in parts {
            let of = &self.conditions.conditions[condition];
            match self.course(of, of.magnitude) {
                Ok(course) => courses.push((factor, course)),
                Err(why) => return stated.faults.push((field, of.span, why)),
            }
        }
        if !courses.is_empty() {
            stated.source[at] = Some(Course::sum(&courses));
        }
    }

    fn take_films(&mut self, nodes: &BTreeSet<NodeId>, stated: &mut Stated) {
        let mut areas: BTreeMap<usize, f64> = BTreeMap::new();
        for face in self.faces.iter_mut().filter(|face| !face.is_taken) {
            let is_film = matches!(self.conditions.conditions[face.condition].kind, ConditionKind::Film { .. });
            if is_film && face.nodes.iter().all(|node| nodes.contains(node)) {
                face.is_taken = true;
                *areas.entry(face.condition).or_default() += face.area;
            }
        }
        for (condition, area) in areas {
            let of = &self.conditions.conditions[condition];
            let ConditionKind::Film { coefficient } = of.kind else { continue };
            match self.course(of, of.magnitude) {
                Ok(sink) => stated.films.push(Film { conductance: coefficient * area, sink }),
                Err(why) => stated.faults.push((Field::Temperature, of.span, why)),
            }
        }
    }

    /// The time course of a condition in step time; in a steady state its value at the end.
    fn course(&self, condition: &Condition, magnitude: f64) -> Result<Course, String> {
        let is_steady = self.time.regime == Regime::SteadyState;
        let Some(named) = &condition.amplitude else {
            let ramps = self.conditions.step_amplitude.as_deref() == Some("RAMP");
            if ramps && !is_steady && condition.step == self.conditions.step {
                return Err("AMPLITUDE=RAMP of *STEP lets it grow over the step, which is not taken over".to_owned());
            }
            return Ok(Course::constant(magnitude));
        };
        let amplitude = self.conditions.amplitudes.iter().find(|amplitude| amplitude.name == named.name);
        let amplitude = amplitude.ok_or_else(|| format!("the amplitude `{}` is not defined", named.name))?;
        let points = amplitude.points.as_ref().map_err(|why| format!("the amplitude `{}`: {why}", named.name))?;
        let offset = match amplitude.time {
            AmplitudeTime::Total => {
                let start = self.time.start;
                start.ok_or_else(|| {
                    format!("the amplitude `{}` counts total time, and steps before have no length", named.name)
                })?
            }
            AmplitudeTime::Step if condition.step < self.conditions.step => {
                return Err(format!("the amplitude `{}` counts the time of an earlier step", named.name));
            }
            AmplitudeTime::Step => 0.0,
        };
        let value = |value: f64| match amplitude.value {
            AmplitudeValue::Relative => magnitude * value,
            AmplitudeValue::Absolute => value,
        };
        let course = Course::through(points.iter().map(|point| [point[0] - offset, value(point[1])]).collect());
        Ok(if is_steady { Course::constant(course.at(self.time.period)) } else { course })
    }

    /// The conditions with nodes or faces outside of terminals, and their number.
    pub(crate) fn left_out(&self) -> Vec<(Span, String)> {
        let mut left: BTreeMap<usize, usize> = BTreeMap::new();
        for (key, condition) in &self.held {
            if !self.taken.contains(key) {
                *left.entry(*condition).or_default() += 1;
            }
        }
        for condition in self.flows.values().flatten() {
            *left.entry(*condition).or_default() += 1;
        }
        for face in self.faces.iter().filter(|face| !face.is_taken) {
            *left.entry(face.condition).or_default() += 1;
        }
        let known = self.conditions.conditions.iter().enumerate();
        known
            .filter_map(|(at, condition)| {
                let Condition { keyword, target, .. } = condition;
                let what = match condition.kind {
                    ConditionKind::Held(_) | ConditionKind::Flow(_) => "node",
                    ConditionKind::FlowPerArea(_) | ConditionKind::Film { .. } => "face",
                };
                let message = match (condition.on, left.get(&at)) {
                    (None, _) => format!("nothing of `{target}` of *{keyword} was found in the mesh"),
                    (Some(_), Some(1)) => {
                        format!("*{keyword} on `{target}` acts on a {what} that no node of the scene stands for")
                    }
                    (Some(_), Some(count)) => {
                        format!("*{keyword} on `{target}` acts on {count} {what}s that no node of the scene stands for")
                    }
                    (Some(_), None) => return None,
                };
                Some((condition.span, message))
            })
            .collect()
    }
}
