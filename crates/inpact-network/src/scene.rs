//! Scenes: nodes, the conductances between them, the interfaces of a deck that couple them, held values and sources.
//!
//! A scene file is TOML ([`read`]); large parts of it can be in tables beside it. No file is opened here: the caller gives bytes.

mod course;
mod file;
mod matrix;
pub(crate) mod nearest;
mod read;
mod rules;
mod shape;
mod syntax;
mod tables;
mod usable;
mod values;

pub use course::Course;
pub use read::{SceneFiles, read, read_as_far_as_it_goes};
pub use rules::{
    CONDITION_LEFT_OUT, CONTRADICTORY_VALUES, FLOATING_BODY, MISSING_QUANTITY, NOT_CONVERGED, NOT_ONE_CONDITION,
    SCENE_RULES, UNKNOWN_PART, UNUSABLE_NUMBER,
};

use inpact_evaluation::HistoryStart;
use inpact_evaluation::law::ClosingHeat;
use inpact_evaluation::nodes::Place;
use inpact_parser::model::Name;
use std::collections::BTreeMap;
use std::fmt;

/// A scene as given, with all names resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The deck, as the scene names it.
    pub deck: String,
    /// Steady state or transient.
    pub procedure: Procedure,
    /// The initial temperature of nodes and nonlinear solutions, θ.
    pub initial_temperature: Option<f64>,
    /// The initial pore pressure of nodes, F L⁻².
    pub initial_pore_pressure: Option<f64>,
    /// The names of the nodes.
    pub nodes: Vec<String>,
    /// The line of the scene file of each node that has one.
    pub node_lines: BTreeMap<u32, u64>,
    /// The parts of the deck that nodes represent.
    pub parts: BTreeMap<u32, NodePart>,
    /// The conditions taken from the deck at these; `None` where the scene gives its own.
    pub deck_conditions: Option<ConditionsOfDeck>,
    /// Given values of each field at the nodes, by [`Field`].
    pub conditions: [Conditions; 3],
    /// The bulk conductances.
    pub links: Vec<SceneLink>,
    /// The interfaces.
    pub interfaces: Vec<SceneInterface>,
}

/// A part of the deck's mesh that a node represents.
#[derive(Debug, Clone, PartialEq)]
pub struct NodePart {
    /// The kind of part.
    pub kind: PartKind,
    /// Its name in the deck.
    pub name: Name,
    /// The line of the scene file.
    pub line: u64,
}

/// Kinds of parts of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PartKind {
    /// A node set.
    Set,
    /// A surface.
    Surface,
}

/// The conditions of the deck that a scene takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ConditionsOfDeck {
    /// The step, from 1; `None` for the only one.
    pub step: Option<usize>,
    /// The line of the scene file.
    pub line: u64,
}

/// Steady state or transient.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Procedure {
    /// Nothing.
    Steady,
    /// Everything with a capacity.
    Transient(TimeSpan),
}

/// The time of a transient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeSpan {
    /// Start time, T.
    pub start: f64,
    /// End time, T.
    pub end: f64,
    /// Lengths of the increments.
    pub steps: Steps,
    /// Start of histories: with the state at the start, or at rest (C-25).
    pub start_from: StartFrom,
    /// The jump of potential in the heat of an increment that closes a circuit.
    pub closing_heat: ClosingHeat,
}

/// Start of histories.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "StartFromName"))]
pub enum StartFrom {
    /// The state at the start, with its jumps of potential.
    #[default]
    FirstRow,
    /// No jump of potential.
    AtRest,
}

/// Lengths of increments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Steps {
    /// All of one length, T; the last may be shorter.
    Given(f64),
    /// As long as the estimated local error allows.
    ByError {
        /// The error that an increment may add, as a part of the range of the field's values.
        tolerance: f64,
        /// The length of the first, T.
        first: f64,
    },
}

/// A field that nodes carry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Field {
    /// Electric potential φ; its flow is current.
    Potential,
    /// Temperature θ; its flow is heat.
    Temperature,
    /// Pore pressure; its flow is volume of fluid per time.
    PorePressure,
}

/// Given values of one field at the nodes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Conditions {
    /// The held values of nodes.
    pub fixed: BTreeMap<u32, Course>,
    /// Sources at the nodes: current, heat or volume of fluid per time.
    pub sources: BTreeMap<u32, Course>,
    /// Capacities of nodes: storage per change of the value.
    pub capacities: BTreeMap<u32, f64>,
    /// The initial values of nodes.
    pub initial: BTreeMap<u32, f64>,
}

/// A lumped bulk conductance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLink {
    /// The nodes; flows are positive from the first to the second.
    pub nodes: [u32; 2],
    /// Its conductance for each field, by [`Field`]; 0 for none, infinite where both nodes are merged.
    pub conductances: [f64; 3],
    /// The fraction of the energy dissipated by its current that becomes heat.
    pub joule_heat_fraction: f64,
}

/// A slave node, the opposite point of the master surface, and the inputs of their laws.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SceneInterface {
    /// The *SURFACE INTERACTION; `None` for the only one of the deck.
    pub interaction: Option<Name>,
    /// The slave node.
    pub slave: u32,
    /// The master node.
    pub master: u32,
    /// Area of the slave node, L².
    pub area: f64,
    /// Clearance d, L.
    pub clearance: Option<Course>,
    /// Contact pressure p, F L⁻².
    pub pressure: Option<Course>,
    /// State of contact, where it is given.
    pub closed: Option<bool>,
    /// Field variables from number 1 on, averages of both sides.
    pub field_variables: Vec<f64>,
    /// The mean temperature where none is solved for, θ.
    pub temperature: Option<f64>,
    /// Mean mass flow rate per area, M L⁻² T⁻¹.
    pub mass_flow: Option<f64>,
    /// Frictional shear stress τ, F L⁻².
    pub shear: Option<f64>,
    /// Rate of relative slip γ̇, L T⁻¹.
    pub slip_rate: Option<f64>,
    /// Rate of the clearance ḋ, where it does not follow from its time course, L T⁻¹.
    pub clearance_rate: Option<f64>,
    /// Characteristic element length, L.
    pub characteristic_length: Option<f64>,
    /// Bulk permeabilities behind slave and master.
    pub bulk_permeabilities: [Option<f64>; 2],
    /// Line, and table unless it is the scene file.
    pub place: (u64, Option<String>),
}

impl TimeSpan {
    /// The shortest increment that is longer than the rounding of its ends, T: four units in the last place of the time furthest from 0.
    pub fn resolution(&self) -> f64 {
        4.0 * f64::EPSILON * self.start.abs().max(self.end.abs())
    }
}

impl Field {
    /// All of them, in the order of the results.
    pub const ALL: [Self; 3] = [Self::Potential, Self::Temperature, Self::PorePressure];

    /// Its place in arrays.
    pub fn index(self) -> usize {
        self as usize
    }

    /// The key of a link's conductance.
    pub fn conductance_key(self) -> &'static str {
        match self {
            Self::Potential => "electrical",
            Self::Temperature => "thermal",
            Self::PorePressure => "hydraulic",
        }
    }

    /// The name of its column and key.
    pub fn key(self) -> &'static str {
        match self {
            Self::Potential => "potential",
            Self::Temperature => "temperature",
            Self::PorePressure => "pore_pressure",
        }
    }

    /// The name of the flow.
    pub fn flow_name(self) -> &'static str {
        match self {
            Self::Potential => "current",
            Self::Temperature => "heat",
            Self::PorePressure => "fluid",
        }
    }
}

impl SceneInterface {
    /// Slave and master.
    pub(crate) fn nodes(&self) -> [u32; 2] {
        [self.slave, self.master]
    }

    /// The temperatures of both sides, from those of their nodes: a side without one has that of the row, of the scene, or of the other side.
    pub(crate) fn temperatures<T: Copy>(
        &self,
        [slave, master]: [Option<T>; 2],
        of_scene: Option<f64>,
        number: impl Fn(f64) -> T,
    ) -> [Option<T>; 2] {
        let given = self.temperature.or(of_scene).map(number);
        [slave.or(given).or(master), master.or(given).or(slave)]
    }

    /// The place and message of a finding about it: lines of a table of the scene go into the message, since the file of the finding is the scene.
    pub fn located(&self, message: String) -> (Place, String) {
        let (line, table) = &self.place;
        let message = match table {
            Some(table) => format!("{message} (line {line} of `{table}`)"),
            None => message,
        };
        (Place { line: table.is_none().then_some(*line), ..Place::default() }, message)
    }
}

impl fmt::Display for Field {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Potential => "potential",
            Self::Temperature => "temperature",
            Self::PorePressure => "pore pressure",
        })
    }
}

impl Scene {
    /// The given values of a field.
    pub fn conditions(&self, field: Field) -> &Conditions {
        &self.conditions[field.index()]
    }

    /// Whether the scene mentions a field.
    pub fn mentions(&self, field: Field) -> bool {
        *self.conditions(field) != Conditions::default()
            || self.links.iter().any(|link| link.conductances[field.index()] > 0.0)
    }

    /// Start of the histories of its interfaces.
    pub fn history_start(&self) -> HistoryStart {
        match self.procedure {
            Procedure::Transient(TimeSpan { start, start_from: StartFrom::AtRest, .. }) => {
                HistoryStart::AtRest { time: start }
            }
            _ => HistoryStart::FirstRow,
        }
    }

    /// The jump of potential in the heat of an increment that closes a circuit.
    pub fn closing_heat(&self) -> ClosingHeat {
        match self.procedure {
            Procedure::Transient(span) => span.closing_heat,
            Procedure::Steady => ClosingHeat::Balanced,
        }
    }

    /// Whether it is a transient.
    pub fn is_transient(&self) -> bool {
        matches!(self.procedure, Procedure::Transient(_))
    }
}
