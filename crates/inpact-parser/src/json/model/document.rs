//! The JSON of the model view, field by field: `schema/model.schema.json` is generated from these types.
//!
//! Independent of the model; the doc comment of a field is its description in the schema.
//! Units are those of the deck, given by their dimensions: M mass, L length, T time, θ temperature, φ electric potential,
//! C electric charge.

use crate::expression::references;
use crate::json::required;
use crate::number::{FortranNumber, read_float, read_fortran};
use indexmap::IndexMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The model view of a deck: its contact interfaces, and what uses them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Model view of a deck"))]
#[serde(deny_unknown_fields, expecting = "a document: an object")]
pub(super) struct Document {
    /// The kind of document, and the number of its form.
    #[cfg_attr(test, schemars(extend("const" = super::SCHEMA)))]
    pub(super) schema: String,
    /// The name of the deck; it is not read back.
    pub(super) source: String,
    /// The definitions of *PARAMETER, in the order in which they are executed.
    pub(super) parameters: Vec<ParameterDocument>,
    /// The interactions by name, in the order of the deck.
    #[serde(deserialize_with = "unique_keys")]
    #[cfg_attr(test, schemars(with = "IndexMap<String, InteractionDocument>"))]
    pub(super) interactions: IndexMap<String, InteractionDocument>,
    /// The *CONTACT PAIR options, in the order of the deck.
    pub(super) contact_pairs: Vec<ContactPairDocument>,
    /// The lines of *CONTACT PROPERTY ASSIGNMENT, in the order of the deck: the last that fits wins.
    pub(super) property_assignments: Vec<AssignmentDocument>,
    /// The procedures of the steps, in the order of the deck.
    pub(super) procedures: Vec<ProcedureDocument>,
}

/// A definition of *PARAMETER.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "parameter"))]
#[serde(deny_unknown_fields, expecting = "a parameter: an object")]
pub(super) struct ParameterDocument {
    /// The name; upper and lower case differ.
    pub(super) name: String,
    /// The expression after the equals sign, as it is written.
    pub(super) expression: String,
    /// The value of the expression, for reading only: it follows from the expression. `null` when there is none.
    #[serde(deserialize_with = "required")]
    pub(super) value: Option<ValueDocument>,
}

/// The value of a parameter: an integer, a real number, or a text.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "value"))]
#[serde(untagged, expecting = "expected a number or a text")]
pub(super) enum ValueDocument {
    Integer(i64),
    Real(f64),
    Text(String),
}

/// `[start, end]` in bytes.
type SpanDocument = [u64; 2];

/// A *SURFACE INTERACTION with its sub-options.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "interaction"))]
#[serde(deny_unknown_fields, expecting = "an interaction: an object")]
pub(super) struct InteractionDocument {
    /// NAME as it is written, quotes included; the same name as its key.
    pub(super) name: String,
    /// The span of its keyword line in the deck: start and end in bytes. It may be left out.
    #[serde(default)]
    pub(super) span: SpanDocument,
    /// Out-of-plane thickness, dimension L, or area per node of a node-based surface, dimension L²; 1 by default.
    pub(super) thickness: f64,
    /// The other parameters of the keyword line, by name; of one that it gives twice (K009) the last, which counts: the lossless form has both.
    pub(super) parameters: GivenDocuments,
    /// The constants of USER, PROPERTIES=n; their dimensions are those of the user subroutine.
    pub(super) properties: Vec<f64>,
    /// *GAP ELECTRICAL CONDUCTANCE; `null` when the interaction has none.
    #[serde(deserialize_with = "required")]
    pub(super) gap_electrical_conductance: Option<ElectricalDocument>,
    /// *CONTACT PERMEABILITY; `null` when the interaction has none.
    #[serde(deserialize_with = "required")]
    pub(super) contact_permeability: Option<PermeabilityDocument>,
    /// *GAP HEAT GENERATION; `null` when the interaction has none.
    #[serde(deserialize_with = "required")]
    pub(super) gap_heat_generation: Option<HeatDocument>,
    /// Every other sub-option, in the order of the deck.
    pub(super) other: Vec<SubOptionDocument>,
}

/// Parameters by name; a flag has the value `null`.
pub(super) type GivenDocuments = Unique<Option<String>>;

/// *GAP ELECTRICAL CONDUCTANCE: `{"user": true}`, or the tables of both branches, `null` for one that is not given.
#[expect(clippy::option_option, reason = "a branch that is not there differs from one that is null")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[cfg_attr(test, schemars(rename = "electrical_conductance", extend("anyOf" = crate::json::schema::user_or_both_branches())))]
#[serde(deny_unknown_fields, expecting = "an electrical conductance: an object")]
pub(super) struct ElectricalDocument {
    /// Whether a user subroutine gives the conductance.
    #[serde(default, skip_serializing_if = "is_false")]
    pub(super) user: bool,
    /// TYPE as it is written.
    #[serde(default, rename = "type", skip_serializing_if = "Option::is_none")]
    pub(super) kind: Option<String>,
    /// Conductance, dimension C L⁻² T⁻¹ φ⁻¹, against clearance, dimension L, and temperature, dimension θ.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    #[cfg_attr(test, schemars(extend("properties" = crate::json::schema::columns(&["conductance", "clearance", "temp"]))))]
    pub(super) clearance: Option<Option<TableDocument>>,
    /// Conductance, dimension C L⁻² T⁻¹ φ⁻¹, against contact pressure, dimension M L⁻¹ T⁻², and temperature,
    /// dimension θ.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    #[cfg_attr(test, schemars(extend("properties" = crate::json::schema::columns(&["conductance", "pressure", "temp"]))))]
    pub(super) pressure: Option<Option<TableDocument>>,
}

/// *CONTACT PERMEABILITY.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "contact_permeability"))]
#[serde(deny_unknown_fields, expecting = "a contact permeability: an object")]
pub(super) struct PermeabilityDocument {
    /// Permeability, dimension L² T M⁻¹, against contact pressure and pore pressure, both of dimension M L⁻¹ T⁻², and
    /// temperature, dimension θ; `null` for an infinite permeability.
    #[serde(deserialize_with = "required")]
    #[cfg_attr(test, schemars(extend(
        "properties" = crate::json::schema::columns(&["permeability", "pressure", "pore_pressure", "temp"])
    )))]
    pub(super) table: Option<TableDocument>,
    /// CUTOFF FLOW ACROSS, dimension L: no flow across above this clearance. `null` when it is not given.
    #[serde(deserialize_with = "required")]
    pub(super) cutoff_flow_across: Option<f64>,
    /// CUTOFF GAP FILL, dimension L: a change of the gap draws no fluid above this clearance. `null` when it is not given.
    #[serde(deserialize_with = "required")]
    pub(super) cutoff_gap_fill: Option<f64>,
    /// CONSTRAINT METHOD; `null` when it is not given.
    #[serde(deserialize_with = "required")]
    pub(super) constraint_method: Option<MethodDocument>,
}

/// CONSTRAINT METHOD of *CONTACT PERMEABILITY.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "constraint_method"))]
#[serde(expecting = "\"DIRECT\" or \"PENALTY\"")]
pub(super) enum MethodDocument {
    #[serde(rename = "DIRECT")]
    Direct,
    #[serde(rename = "PENALTY")]
    Penalty,
}

/// *GAP HEAT GENERATION.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "heat_generation"))]
#[serde(deny_unknown_fields, expecting = "a heat generation: an object")]
pub(super) struct HeatDocument {
    /// η, the fraction of dissipated energy that becomes heat; without dimension.
    pub(super) fraction: Cell,
    /// f, the fraction of that heat that goes into the slave surface; without dimension.
    pub(super) slave_weight: Cell,
    /// The relative speed of the surfaces, dimension L T⁻¹, where the deck is one of CalculiX; below zero it is computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) slip_rate: Option<Cell>,
}

/// A keyword with its parameters and rows, not interpreted further.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "sub_option"))]
#[serde(deny_unknown_fields, expecting = "a sub-option: an object")]
pub(super) struct SubOptionDocument {
    /// The keyword, in full, in upper case and without its asterisk.
    pub(super) keyword: String,
    /// Its parameters, by name; of one that is given twice (K009) the last, which counts: the lossless form has both.
    pub(super) parameters: GivenDocuments,
    /// Its rows as numbers, where they form a table; `null` otherwise.
    #[serde(deserialize_with = "required")]
    pub(super) table: Option<TableDocument>,
    /// Its rows as texts otherwise: the items of every line.
    pub(super) rows: Vec<Vec<String>>,
}

/// A table: the first column is the dependent value, the others are what it depends on, the one that varies fastest first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "table"))]
#[serde(deny_unknown_fields, expecting = "a table: an object")]
pub(super) struct TableDocument {
    /// The names of the columns, such as `conductance`, `clearance`, `temp`, then `fv1`, `fv2`, … for field variables.
    #[cfg_attr(test, schemars(length(min = 1)))]
    pub(super) columns: Vec<String>,
    /// DEPENDENCIES, only where it counts more field variables than there are columns: no row goes on to the others, and they are zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) dependencies: Option<usize>,
    /// The rows in the order of the deck, each with an item for every column.
    pub(super) rows: Vec<Vec<Cell>>,
}

/// A *CONTACT PAIR.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "contact_pair"))]
#[serde(deny_unknown_fields, expecting = "a contact pair: an object")]
pub(super) struct ContactPairDocument {
    /// The name of its interaction; `null` when none is given.
    #[serde(deserialize_with = "required")]
    pub(super) interaction: Option<String>,
    /// The other parameters of the keyword line, by name; of one that it gives twice (K009) the last, which counts: the lossless form has both.
    pub(super) parameters: GivenDocuments,
    /// The pairs of surfaces, one a line.
    pub(super) pairs: Vec<SurfacePairDocument>,
}

/// A slave surface and its master.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "surface_pair"))]
#[serde(deny_unknown_fields, expecting = "a pair of surfaces: an object")]
pub(super) struct SurfacePairDocument {
    /// The slave (secondary) surface.
    pub(super) slave: String,
    /// The master (main) surface; `null` for contact of the slave surface with itself.
    #[serde(deserialize_with = "required")]
    pub(super) master: Option<String>,
}

/// A line of *CONTACT PROPERTY ASSIGNMENT.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "property_assignment"))]
#[serde(deny_unknown_fields, expecting = "a property assignment: an object")]
pub(super) struct AssignmentDocument {
    /// The first surface; `null` is the whole domain.
    #[serde(deserialize_with = "required")]
    pub(super) first: Option<String>,
    /// The second surface; `null` is the first once more.
    #[serde(deserialize_with = "required")]
    pub(super) second: Option<String>,
    /// The interaction; `null` is the unnamed default.
    #[serde(deserialize_with = "required")]
    pub(super) interaction: Option<String>,
}

/// The procedure of a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "procedure"))]
#[serde(deny_unknown_fields, expecting = "a procedure: an object")]
pub(super) struct ProcedureDocument {
    /// The step it belongs to, from 1; 0 outside of steps.
    pub(super) step: usize,
    /// The keyword, in full, in upper case and without its asterisk.
    pub(super) keyword: String,
    /// Its parameters, by name; of one that is given twice (K009) the last, which counts: the lossless form has both.
    pub(super) parameters: GivenDocuments,
    /// The items of every line.
    pub(super) rows: Vec<Vec<String>>,
    /// Steady or transient, for reading only: it follows from keyword and parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) regime: Option<RegimeDocument>,
}

/// Steady state or transient.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "regime"))]
#[serde(rename_all = "lowercase", expecting = "\"steady\" or \"transient\"")]
pub(super) enum RegimeDocument {
    Steady,
    Transient,
}

/// A number; `{"text": "<name>", "value": 1.5}` for one that is written with parameters (S-62); or the text of a cell
/// that is no number: a parameter without a value, or what is malformed in the deck.
///
/// Texts that a deck could not contain are refused on the way back: a number in quotes, two items, a comment.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cell {
    Number(f64),
    Symbolic(SymbolicCell),
    Text(String),
}

/// A number that is written with parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "symbolic_number"))]
#[serde(deny_unknown_fields, expecting = "a number that is written with parameters: an object")]
pub(super) struct SymbolicCell {
    /// The text in the deck, with `<name>` for a parameter.
    pub(super) text: String,
    /// The number that it gives.
    pub(super) value: f64,
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(value) => serializer.serialize_f64(*value),
            Self::Symbolic(cell) => cell.serialize(serializer),
            Self::Text(text) => serializer.serialize_str(text),
        }
    }
}

impl<'de> Deserialize<'de> for Cell {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CellVisitor)
    }
}

/// Written out because an untagged enum would say only that nothing matched.
struct CellVisitor;

impl<'de> serde::de::Visitor<'de> for CellVisitor {
    type Value = Cell;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("a number, or a parameter such as \"<sigma>\"")
    }

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<Cell, E> {
        Ok(Cell::Number(value))
    }

    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<Cell, E> {
        Ok(Cell::Number(value as f64))
    }

    fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<Cell, E> {
        Ok(Cell::Number(value as f64))
    }

    fn visit_str<E: serde::de::Error>(self, value: &str) -> Result<Cell, E> {
        if is_no_number(value) {
            return Ok(Cell::Text(value.to_owned()));
        }
        Err(E::invalid_value(serde::de::Unexpected::Str(value), &self))
    }

    fn visit_map<A: serde::de::MapAccess<'de>>(self, map: A) -> Result<Cell, A::Error> {
        let cell = SymbolicCell::deserialize(serde::de::value::MapAccessDeserializer::new(map))?;
        if references(cell.text.as_bytes()).next().is_some() {
            return Ok(Cell::Symbolic(cell));
        }
        Err(serde::de::Error::invalid_value(serde::de::Unexpected::Str(&cell.text), &self))
    }
}

impl Cell {
    /// The number; NaN for a text that has none.
    pub(super) fn value(&self) -> f64 {
        match self {
            Self::Number(value) => *value,
            Self::Symbolic(cell) => cell.value,
            Self::Text(_) => f64::NAN,
        }
    }
}

/// Whether a text can occur in a cell of a deck and is no number there, in either dialect: CalculiX reads 20 characters alone (CX-05).
fn is_no_number(text: &str) -> bool {
    let item = text.trim_matches(|character: char| character.is_ascii_whitespace());
    let is_none = || {
        let of_calculix = read_fortran(text.as_bytes());
        read_float(text.as_bytes()).is_err() || matches!(of_calculix, Err(_) | Ok(FortranNumber::CutToNothing))
    };
    !text.is_empty() && item.len() == text.len() && is_none()
}

/// An object none of whose keys occurs twice: the second would replace the first without a word.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unique<V>(pub(super) IndexMap<String, V>);

impl<V: Serialize> Serialize for Unique<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de, V: Deserialize<'de>> Deserialize<'de> for Unique<V> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        unique_keys(deserializer).map(Self)
    }
}

#[cfg(test)]
impl<V: schemars::JsonSchema> schemars::JsonSchema for Unique<V> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        IndexMap::<String, V>::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        IndexMap::<String, V>::json_schema(generator)
    }
}

/// Reads an object and refuses a key that occurs twice.
fn unique_keys<'de, D: Deserializer<'de>, V: Deserialize<'de>>(
    deserializer: D,
) -> Result<IndexMap<String, V>, D::Error> {
    struct UniqueKeys<V>(std::marker::PhantomData<V>);

    impl<'de, V: Deserialize<'de>> serde::de::Visitor<'de> for UniqueKeys<V> {
        type Value = IndexMap<String, V>;

        fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            formatter.write_str("a map")
        }

        fn visit_map<A: serde::de::MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
            let mut map = IndexMap::new();
            while let Some(key) = entries.next_key::<String>()? {
                if map.contains_key(&key) {
                    return Err(serde::de::Error::custom(format_args!("duplicate key `{key}`")));
                }
                map.insert(key, entries.next_value()?);
            }
            Ok(map)
        }
    }

    deserializer.deserialize_map(UniqueKeys(std::marker::PhantomData))
}

/// Written out because the three forms are distinguished by hand.
#[cfg(test)]
impl schemars::JsonSchema for Cell {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "cell".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let symbolic = generator.subschema_for::<SymbolicCell>();
        schemars::json_schema!({
            "description": "A number, as it is or written with parameters; or the text of a cell that has no number. \
                            A number in quotes is refused on the way back.",
            "anyOf": [{"type": "number"}, symbolic, {"type": "string"}],
        })
    }
}

/// Tells a field that is there, and may be `null`, from one that is not.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_false(value: &bool) -> bool {
    !value
}
