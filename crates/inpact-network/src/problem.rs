//! The problem of a scene: the fields that get unknowns, the nodes and interface rows of each, and the order in which the fields are solved.
//!
//! Only what a scene requires is modelled:
//!
//! - a field gets unknowns where the scene mentions it, and a law couples it or something drives it: a fixed value or a non-zero source;
//! - only those nodes of a field get one that a condition names, or that links and interfaces of the field join to such a node;
//! - pore fluid crosses an interface only where both sides carry pore pressure (P-01);
//! - a field whose conductances depend on no other is solved before those that depend on it; mutually dependent fields are solved together;
//! - a field that depends on no unknown field is linear: it takes one solve, no Newton.

mod certain;
mod notes;

use notes::interaction_of;
pub use notes::report_unknown_interactions;

use crate::dependence::{Dependence, dependence_of_electrical, dependence_of_pore, dependence_of_thermal};
use crate::interface::{Contact, heat_of_friction};
use crate::linear::{NONE, Sets, index};
use crate::scene::{Course, Field, Scene, SceneInterface};
use inpact_evaluation::law::{ContactState, FlowOf, InterfaceLaws};
use inpact_evaluation::nodes::Findings;
use inpact_evaluation::plan::Choices;
use inpact_parser::model::Model;

/// A scene with the laws of its deck.
#[derive(Debug)]
pub struct Problem<'a> {
    pub(crate) scene: &'a Scene,
    /// The laws of each interaction of the model that a row names.
    pub(crate) laws: Vec<Option<InterfaceLaws>>,
    /// The interaction of each row, by its index in the model.
    pub(crate) interactions: Vec<usize>,
    /// The nodes of each field that is solved, by [`Field`].
    pub(crate) fields: [Option<FieldNodes>; 3],
    /// The fields in the order in which they are solved; those that depend on each other are one group.
    pub(crate) stages: Vec<Stage>,
    /// The default characteristic element length of rows.
    pub(crate) characteristic_length: Option<f64>,
    /// θ of absolute zero, where the deck gives it.
    pub(crate) absolute_zero: Option<f64>,
    /// The parts that are not solved, and why, for users.
    pub left_out: Vec<String>,
}

/// The nodes and rows of a field.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FieldNodes {
    /// The nodes of the scene that carry it.
    pub(crate) nodes: Vec<u32>,
    /// The index among them of each node of the scene; `NONE` for others.
    pub(crate) place: Vec<u32>,
    /// The links of the scene that conduct it.
    pub(crate) links: Vec<u32>,
    /// The rows that couple it.
    pub(crate) rows: Vec<u32>,
}

/// Fields that are solved together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Stage {
    pub(crate) fields: Vec<Field>,
    /// Whether one linear solve is enough.
    pub(crate) is_linear: bool,
}

/// Dependence of the laws of a scene on its fields.
#[derive(Debug, Clone, Copy, Default)]
struct Couplings {
    potential_on_temperature: bool,
    temperature_on_potential: bool,
    temperature_on_itself: bool,
    pore_on_itself: bool,
}

impl FieldNodes {
    /// Whether a node of the scene carries the field.
    pub(crate) fn carries(&self, node: u32) -> bool {
        self.place[node as usize] != NONE
    }

    /// The nodes of the scene that each of its links joins, then those of each row.
    pub(crate) fn ends(&self, scene: &Scene) -> impl Iterator<Item = [u32; 2]> {
        let links = self.links.iter().map(|&link| scene.links[link as usize].nodes);
        links.chain(self.rows.iter().map(|&row| scene.interfaces[row as usize].nodes()))
    }
}

impl<'a> Problem<'a> {
    /// Combines a scene and the model of its deck; `None` after reporting what is missing.
    pub fn new(scene: &'a Scene, model: &Model, choices: &Choices, findings: &mut Findings) -> Option<Self> {
        let mut problem = Self {
            scene,
            laws: (0..model.interactions.len()).map(|_| None).collect(),
            interactions: Vec::with_capacity(scene.interfaces.len()),
            fields: [None, None, None],
            stages: Vec::new(),
            characteristic_length: choices.characteristic_length,
            absolute_zero: model.constants.absolute_zero,
            left_out: Vec::new(),
        };
        report_unknown_interactions(scene, model, findings);
        for row in &scene.interfaces {
            let Some(interaction) = interaction_of(row, model) else {
                problem.interactions.push(0);
                continue;
            };
            problem.interactions.push(interaction);
            if problem.laws[interaction].is_none()
                && let Some(of) = model.interactions.get_index(interaction)
            {
                let laws = InterfaceLaws::of(model, of, choices);
                let unsolved = laws.left_out.iter().filter(|(flow, _)| !scene.mentions(field_of(*flow)));
                problem
                    .left_out
                    .extend(unsolved.map(|(_, left)| format!("{} of `{}`: {}", left.what, of.name, left.reason)));
                problem.laws[interaction] = Some(laws);
            }
        }
        if findings.has_errors() {
            return None;
        }
        problem.choose_fields();
        problem.check_laws(findings);
        problem.check_rows(findings);
        problem.check_initial(findings);
        problem.check_temperatures(findings);
        problem.check_friction(findings);
        problem.check_rates(findings);
        problem.note_friction();
        problem.note_without_effect();
        problem.note_one_sided();
        problem.choose_stages();
        (!findings.has_errors()).then_some(problem)
    }

    /// The scene that is solved.
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The laws of a row.
    pub(crate) fn laws_of(&self, row: usize) -> Option<&InterfaceLaws> {
        self.laws[self.interactions[row]].as_ref()
    }

    /// The nodes of a field; `None` where it is not solved.
    pub(crate) fn field(&self, field: Field) -> Option<&FieldNodes> {
        self.fields[field.index()].as_ref()
    }

    /// The fields that are solved, in the order of the results.
    pub fn solved_fields(&self) -> Vec<Field> {
        Field::ALL.into_iter().filter(|field| self.field(*field).is_some()).collect()
    }

    /// The nodes that carry a solved field.
    pub fn nodes_of(&self, field: Field) -> &[u32] {
        self.field(field).map_or(&[], |nodes| &nodes.nodes)
    }

    /// The time at which contact is first evaluated, T.
    pub(crate) fn start(&self) -> f64 {
        match self.scene.procedure {
            crate::scene::Procedure::Steady => 0.0,
            crate::scene::Procedure::Transient(span) => span.start,
        }
    }

    /// Whether an interaction has a law of a field.
    fn has_law(laws: &InterfaceLaws, field: Field) -> bool {
        match field {
            Field::Potential => laws.electrical.is_some(),
            Field::Temperature => laws.thermal.is_some() || laws.radiation.is_some() || laws.friction.is_some(),
            Field::PorePressure => laws.pore.is_some(),
        }
    }

    fn choose_fields(&mut self) {
        for field in Field::ALL {
            let scene = self.scene;
            let row_numbers = 0..scene.interfaces.len();
            let has_law = |row: &usize| self.laws_of(*row).is_some_and(|laws| Self::has_law(laws, field));
            if !scene.mentions(field) {
                let tells = |row: usize| match field {
                    Field::PorePressure => self.laws_of(row).is_some_and(|laws| laws.tells_of_pore),
                    _ => has_law(&row),
                };
                if row_numbers.clone().any(tells) {
                    self.left_out.push(format!("{field}: the deck has laws of it, and the scene says nothing of it"));
                }
                continue;
            }
            let mut carries = vec![false; scene.nodes.len()];
            let conditions = scene.conditions(field);
            let driven = conditions.fixed.keys().chain(conditions.sources.keys());
            let named = driven.chain(conditions.capacities.keys()).chain(conditions.initial.keys());
            named.for_each(|node| carries[*node as usize] = true);
            let conducting = |link: &u32| scene.links[*link as usize].conductances[field.index()] > 0.0;
            let links: Vec<u32> = (0..index(scene.links.len())).filter(conducting).collect();
            for &link in &links {
                for node in scene.links[link as usize].nodes {
                    carries[node as usize] = true;
                }
            }
            let with_law = || (0..index(scene.interfaces.len())).filter(|row| has_law(&(*row as usize)));
            let ends = |row: u32| scene.interfaces[row as usize].nodes();
            if field != Field::PorePressure {
                spread(&mut carries, with_law().map(ends));
            }
            let rows: Vec<u32> = with_law().filter(|&row| ends(row).iter().all(|&end| carries[end as usize])).collect();
            let is_driven = !conditions.fixed.is_empty()
                || conditions.sources.values().any(|source| source.values().any(|value| value != 0.0))
                || conditions.capacities.values().any(|capacity| *capacity > 0.0);
            if rows.is_empty() && !is_driven {
                self.left_out.push(format!("{field}: no interface law couples it, and nothing drives it"));
                continue;
            }
            let nodes: Vec<u32> = (0..index(carries.len())).filter(|node| carries[*node as usize]).collect();
            let mut place = vec![NONE; scene.nodes.len()];
            for (number, node) in (0..).zip(&nodes) {
                place[*node as usize] = number;
            }
            self.fields[field.index()] = Some(FieldNodes { nodes, place, links, rows });
        }
    }

    /// The rows of a field with their laws.
    pub(crate) fn rows_of(&self, field: Field) -> impl Iterator<Item = (usize, &SceneInterface, &InterfaceLaws)> {
        let rows = self.field(field).map_or(&[][..], |nodes| &nodes.rows);
        rows.iter().filter_map(|&row| {
            let row = row as usize;
            Some((row, &self.scene.interfaces[row], self.laws_of(row)?))
        })
    }

    /// The dependence of a row's law of a field in any state of contact that may occur.
    pub(crate) fn dependence(row: &SceneInterface, laws: &InterfaceLaws, field: Field, time: f64) -> Dependence {
        // Contact that varies with time may be open or closed.
        let follows_time = |course: &Option<Course>| course.as_ref().is_some_and(|of| of.corners().next().is_some());
        let changes = row.closed.is_none() && (follows_time(&row.clearance) || follows_time(&row.pressure));
        let now = Contact::of(row, time).map_or(ContactState::Undetermined, |contact| contact.state);
        let states: &[ContactState] =
            if changes { &[ContactState::Closed, ContactState::Open] } else { std::slice::from_ref(&now) };
        let of_state = |state: &ContactState| match (field, &laws.electrical) {
            (Field::Potential, Some(source)) => dependence_of_electrical(source, *state),
            (Field::Potential, None) => Dependence::default(),
            (Field::Temperature, _) => dependence_of_thermal(laws, *state),
            (Field::PorePressure, _) => dependence_of_pore(laws, *state),
        };
        states.iter().map(of_state).fold(Dependence::default(), Dependence::or)
    }

    /// The name of a row in messages.
    pub(crate) fn label(&self, row: &SceneInterface) -> String {
        let [slave, master] = row.nodes().map(|node| &self.scene.nodes[node as usize]);
        format!("the interface of `{slave}` and `{master}`")
    }

    fn choose_stages(&mut self) {
        let couplings = self.couplings();
        let has = |field| self.field(field).is_some();
        let electrical = has(Field::Potential).then_some(Field::Potential);
        let thermal = has(Field::Temperature).then_some(Field::Temperature);
        let is_mutual = couplings.potential_on_temperature && couplings.temperature_on_potential;
        let mut stages = Vec::new();
        if let (Some(electrical), Some(thermal), true) = (electrical, thermal, is_mutual) {
            stages.push(Stage { fields: vec![electrical, thermal], is_linear: false });
        } else {
            let of_potential = electrical.map(|field| Stage { fields: vec![field], is_linear: true });
            let of_temperature =
                thermal.map(|field| Stage { fields: vec![field], is_linear: !couplings.temperature_on_itself });
            // The field that depends on the other comes second.
            let pair = if couplings.potential_on_temperature {
                [of_temperature, of_potential]
            } else {
                [of_potential, of_temperature]
            };
            stages.extend(pair.into_iter().flatten());
        }
        if has(Field::PorePressure) {
            stages.push(Stage { fields: vec![Field::PorePressure], is_linear: !couplings.pore_on_itself });
        }
        self.stages = stages;
    }

    fn couplings(&self) -> Couplings {
        let has_temperature = self.field(Field::Temperature).is_some();
        let start = self.start();
        let mut couplings = Couplings::default();
        for (_, of, laws) in self.rows_of(Field::Potential) {
            let needs = Self::dependence(of, laws, Field::Potential, start);
            couplings.potential_on_temperature |= needs.temperature && has_temperature;
            couplings.temperature_on_potential |=
                self.receives_heat(of) && laws.heat_generation.is_some_and(|heat| heat.fraction != 0.0);
        }
        let heats = |link: &crate::scene::SceneLink| link.joule_heat_fraction > 0.0 && link.conductances[0] > 0.0;
        couplings.temperature_on_potential |= has_temperature && self.scene.links.iter().any(heats);
        for (_, of, laws) in self.rows_of(Field::Temperature) {
            couplings.temperature_on_itself |= Self::dependence(of, laws, Field::Temperature, start).temperature;
        }
        for (_, of, laws) in self.rows_of(Field::PorePressure) {
            couplings.pore_on_itself |= Self::dependence(of, laws, Field::PorePressure, start).pore_pressure;
        }
        couplings
    }

    /// Whether one of the nodes of a row carries temperature and so receives the heat of its current.
    fn receives_heat(&self, row: &SceneInterface) -> bool {
        self.field(Field::Temperature).is_some_and(|of| row.nodes().into_iter().any(|node| of.carries(node)))
    }

    /// The heat of friction of a row at a time, into slave and master; zero where it is not given, and where the contact is open.
    pub(crate) fn friction(&self, row: usize, time: f64) -> [f64; 2] {
        let of = &self.scene.interfaces[row];
        if Contact::of(of, time).is_some_and(|contact| contact.state == ContactState::Open) {
            return [0.0; 2];
        }
        let heat = self.laws_of(row).and_then(|laws| heat_of_friction(laws, of));
        heat.map_or([0.0; 2], |heat| [heat.slave * of.area, heat.master * of.area])
    }
}

/// Marks every node that is connected by pairs to a marked one.
fn spread(is_marked: &mut [bool], pairs: impl Iterator<Item = [u32; 2]> + Clone) {
    let mut sets = Sets::new(is_marked.len());
    for [a, b] in pairs {
        sets.join(a, b);
    }
    let mut has_marked = vec![false; is_marked.len()];
    for (node, _) in (0..).zip(&*is_marked).filter(|(_, is_marked)| **is_marked) {
        has_marked[sets.of(node) as usize] = true;
    }
    for (node, is_marked) in (0..).zip(is_marked) {
        *is_marked = has_marked[sets.of(node) as usize];
    }
}

/// The field that drives a flow.
fn field_of(flow: FlowOf) -> Field {
    match flow {
        FlowOf::Charge => Field::Potential,
        FlowOf::Heat => Field::Temperature,
        FlowOf::PoreFluid => Field::PorePressure,
    }
}
