//! The scene file as written: TOML without unknown keys, with the places of values for findings.
//!
//! The format is a contract; its JSON Schema is committed (`schema/scene.schema.json`).

use super::StartFrom;
use super::values::Number;
use serde::Deserialize;
use toml::Spanned;

/// A scene: nodes, what conducts between them, the interfaces of a deck that couple them, and what is held.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Scene of inpact solve"))]
pub(crate) struct SceneFile {
    /// The deck, relative to the scene file.
    #[cfg_attr(test, schemars(with = "String"))]
    pub(crate) deck: Spanned<String>,
    /// Steady state or transient; it has the say over the procedures of the deck.
    #[serde(default)]
    pub(crate) procedure: ProcedureName,
    /// The time of a transient.
    #[cfg_attr(test, schemars(with = "Option<TimeEntry>"))]
    pub(crate) time: Option<Spanned<TimeEntry>>,
    /// Values at the start of a transient of nodes with a capacity, and where a nonlinear solution begins.
    #[serde(default)]
    pub(crate) initial: InitialEntry,
    /// The share of the energy dissipated in links that becomes heat in their nodes, where a link gives none; 0 unless given.
    pub(crate) joule_heat_fraction: Option<Number>,
    /// Conditions of the deck at the nodes that name a set or a surface of it.
    #[cfg_attr(test, schemars(with = "Option<ConditionsEntry>"))]
    pub(crate) conditions: Option<Spanned<ConditionsEntry>>,
    /// The nodes.
    #[serde(default, rename = "node")]
    #[cfg_attr(test, schemars(with = "Vec<NodeEntry>"))]
    pub(crate) nodes: Vec<Spanned<NodeEntry>>,
    /// Lumped bulk conductances.
    #[serde(default, rename = "link")]
    #[cfg_attr(test, schemars(with = "Vec<LinkEntry>"))]
    pub(crate) links: Vec<Spanned<LinkEntry>>,
    /// The interfaces.
    #[serde(default, rename = "interface")]
    #[cfg_attr(test, schemars(with = "Vec<InterfaceEntry>"))]
    pub(crate) interfaces: Vec<Spanned<InterfaceEntry>>,
    /// Further nodes, in tables of comma-separated values.
    #[serde(default, rename = "node_file")]
    #[cfg_attr(test, schemars(with = "Vec<FileEntry>"))]
    pub(crate) node_files: Vec<Spanned<FileEntry>>,
    /// Further links, in tables or Matrix Market files; tables name nodes that the scene defines, unless it defines none.
    #[serde(default, rename = "link_file")]
    #[cfg_attr(test, schemars(with = "Vec<LinkFileEntry>"))]
    pub(crate) link_files: Vec<Spanned<LinkFileEntry>>,
    /// Further interfaces, in tables of comma-separated values.
    #[serde(default, rename = "interface_file")]
    #[cfg_attr(test, schemars(with = "Vec<FileEntry>"))]
    pub(crate) interface_files: Vec<Spanned<FileEntry>>,
}

/// Steady state or transient.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) enum ProcedureName {
    /// Nothing changes: one solution.
    #[default]
    Steady,
    /// Nodes with capacities take up heat or fluid: increments of time.
    Transient,
}

/// The time of a transient: one of `step` and `tolerance`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct TimeEntry {
    /// Start time, T; 0 unless given.
    pub(crate) start: Option<Number>,
    /// End time, T.
    pub(crate) end: Number,
    /// The length of every increment; the last may be shorter.
    pub(crate) step: Option<Number>,
    /// Increments are as long as their estimated local error stays within this share of the range of the values.
    pub(crate) tolerance: Option<Number>,
    /// The length of the first increment with `tolerance`, instead of a thousandth of the whole.
    pub(crate) first_step: Option<Number>,
    /// Start of histories: with the jumps of potential of the state at the start, or without any, as in Abaqus.
    #[serde(default)]
    pub(crate) start_from: StartFrom,
    /// The jump of potential in the heat of a current at the start of an increment that closes a circuit: the jump at its end, so that power balances, or that of the open circuit, as in the manual.
    #[serde(default)]
    pub(crate) closing_heat: ClosingHeatName,
}

/// The jump of potential in the heat of a current at the start of an increment that closes a circuit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) enum ClosingHeatName {
    /// The jump at the end of the increment, so that power balances.
    #[default]
    Balanced,
    /// The jump of the open circuit, as the manual has it.
    Manual,
}

/// Values to begin with.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct InitialEntry {
    /// Of all temperatures that are not given by node; also the temperature of interfaces where no temperature is solved for.
    pub(crate) temperature: Option<Number>,
    /// Of all pore pressures that are not given by node.
    pub(crate) pore_pressure: Option<Number>,
}

/// Conditions that are taken from the deck: what is held, what flows in, films, and initial values.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ConditionsEntry {
    /// The step of the deck whose conditions hold, from 1; not needed where the deck has only one.
    pub(crate) step: Option<Number>,
}

/// A node.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct NodeEntry {
    /// Its name.
    #[cfg_attr(test, schemars(with = "String"))]
    pub(crate) name: Spanned<String>,
    /// The node set of the deck that it stands for, whose conditions it takes with [conditions].
    #[cfg_attr(test, schemars(with = "Option<String>"))]
    pub(crate) set: Option<Spanned<String>>,
    /// The surface of the deck that it stands for, instead of a set.
    #[cfg_attr(test, schemars(with = "Option<String>"))]
    pub(crate) surface: Option<Spanned<String>>,
    /// Its electric potential.
    #[cfg_attr(test, schemars(with = "Option<Condition>"))]
    pub(crate) potential: Option<Spanned<Condition>>,
    /// Its temperature.
    #[cfg_attr(test, schemars(with = "Option<Condition>"))]
    pub(crate) temperature: Option<Spanned<Condition>>,
    /// Its pore pressure.
    #[cfg_attr(test, schemars(with = "Option<Condition>"))]
    pub(crate) pore_pressure: Option<Spanned<Condition>>,
}

/// Given values of one field at a node.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct Condition {
    /// The value it is held at.
    #[cfg_attr(test, schemars(with = "Option<Course>"))]
    pub(crate) fixed: Option<Spanned<Course>>,
    /// Source: current, heat, volume of fluid per time.
    #[cfg_attr(test, schemars(with = "Option<Course>"))]
    pub(crate) source: Option<Spanned<Course>>,
    /// Capacity, storage per change of the value: heat capacity, storage of pore fluid.
    pub(crate) capacity: Option<Number>,
    /// Its value at the start of a transient.
    pub(crate) initial: Option<Number>,
}

/// A number, or one that follows time: linear between points of time and value, constant before and after them.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) enum Course {
    /// The same at all times.
    Constant(f64),
    /// Points of time and value.
    Points(Vec<[f64; 2]>),
}

/// The form of a course, for messages.
pub(crate) const COURSE: &str = "a number, or points of time and value such as [[0.0, 20.0], [1.0, 80.0]]";

/// The form of the nodes of a link, for messages.
pub(crate) const TWO_NAMES: &str = "the names of two nodes such as [\"a\", \"b\"]";

/// A lumped bulk conductance between two nodes; `inf` makes them one.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct LinkEntry {
    /// The two nodes; flows are positive from the first to the second.
    #[cfg_attr(test, schemars(with = "[String; 2]"))]
    pub(crate) nodes: Spanned<[String; 2]>,
    /// Current per potential.
    pub(crate) electrical: Option<Number>,
    /// Heat per time and temperature.
    pub(crate) thermal: Option<Number>,
    /// Volume of fluid per time and pressure.
    pub(crate) hydraulic: Option<Number>,
    /// The share of the energy its current dissipates that becomes heat, half of it in either node.
    pub(crate) joule_heat_fraction: Option<Number>,
}

/// A slave node, the point of the master surface opposite to it, and what governs both.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct InterfaceEntry {
    /// The *SURFACE INTERACTION of the deck; not needed where it has only one.
    #[cfg_attr(test, schemars(with = "Option<String>"))]
    pub(crate) interaction: Option<Spanned<String>>,
    /// The node of the slave (secondary) side.
    #[serde(alias = "secondary")]
    #[cfg_attr(test, schemars(with = "String"))]
    pub(crate) slave: Spanned<String>,
    /// The node of the master (main) side.
    #[serde(alias = "main")]
    #[cfg_attr(test, schemars(with = "String"))]
    pub(crate) master: Spanned<String>,
    /// The area of the slave node.
    pub(crate) area: Number,
    /// Clearance, open > 0.
    #[cfg_attr(test, schemars(with = "Option<Course>"))]
    pub(crate) clearance: Option<Spanned<Course>>,
    /// Contact pressure.
    #[cfg_attr(test, schemars(with = "Option<Course>"))]
    pub(crate) pressure: Option<Spanned<Course>>,
    /// Whether it is closed; otherwise it is where the clearance is not above zero or the contact pressure is not zero.
    pub(crate) closed: Option<bool>,
    /// Field variables from number 1 on, averages of both sides; a thousand at most.
    #[serde(default)]
    pub(crate) fv: Vec<Number>,
    /// The mean temperature, where no temperature is solved for.
    pub(crate) temperature: Option<Number>,
    /// The mean of the magnitudes of the mass flow rates of both sides.
    pub(crate) mass_flow: Option<Number>,
    /// Frictional shear stress.
    pub(crate) shear: Option<Number>,
    /// Rate of relative slip.
    pub(crate) slip_rate: Option<Number>,
    /// Rate of the clearance; otherwise from its course.
    pub(crate) clearance_rate: Option<Number>,
    /// The characteristic element length, default of both cutoffs of pore fluid flow.
    pub(crate) char_length: Option<Number>,
    /// The bulk permeability behind the slave surface, for the shares of gap filling.
    pub(crate) perm_s: Option<Number>,
    /// The bulk permeability behind the master surface.
    pub(crate) perm_m: Option<Number>,
}

/// A table beside the scene file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct FileEntry {
    /// Its name, relative to the scene file.
    #[cfg_attr(test, schemars(with = "String"))]
    pub(crate) file: Spanned<String>,
}

/// A file of links: a table of comma-separated values, or a symmetric Matrix Market file of one field.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct LinkFileEntry {
    /// Its name, relative to the scene file; `.mtx` is a Matrix Market file, whose rows are nodes.
    #[cfg_attr(test, schemars(with = "String"))]
    pub(crate) file: Spanned<String>,
    /// Of a Matrix Market file, what its numbers conduct.
    pub(crate) conducts: Option<Conducts>,
    /// Of a Matrix Market file, the prefix of the names of the nodes, before the numbers of its rows.
    #[serde(default)]
    pub(crate) prefix: String,
}

/// The field of a conductance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) enum Conducts {
    /// Current.
    Electrical,
    /// Heat.
    Thermal,
    /// Pore fluid.
    Hydraulic,
}

#[cfg(test)]
#[path = "../../../../tests/support/schema.rs"]
mod schema;

#[cfg(test)]
mod tests {
    use super::SceneFile;
    use schemars::JsonSchema;
    use schemars::generate::SchemaSettings;

    #[test]
    fn the_committed_schema_is_that_of_the_file() {
        assert_eq!(SceneFile::schema_name(), "Scene of inpact solve");
        super::schema::check::<SceneFile>("scene.schema.json", SchemaSettings::draft2020_12());
    }
}
