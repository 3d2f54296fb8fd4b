//! The model view: what a deck says, as typed data.
//!
//! The structs here are the JSON, field by field; the model itself knows nothing of JSON.
//! Places (`span`) are byte ranges of the deck the JSON was made from; they are optional on the way back.

use super::{JsonError, layout, parse};
use crate::expression::{self, Parameters, StatementLine, Value, define, references};
use crate::model::{
    CellText, ConstraintMethod, ContactPair, ContactPermeability, ElectricalConductance, GivenParameter,
    HeatGeneration, Interaction, Model, Name, Procedure, PropertyAssignment, Reference, Regime, SubOption, SurfacePair,
    Table,
};
use crate::span::{SourceId, Span};
use indexmap::IndexMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The value of the `schema` field.
pub const SCHEMA: &str = "inpact/model/1";

/// The document.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    schema: String,
    source: String,
    parameters: Vec<ParameterDocument>,
    interactions: IndexMap<String, InteractionDocument>,
    contact_pairs: Vec<ContactPairDocument>,
    property_assignments: Vec<AssignmentDocument>,
    procedures: Vec<ProcedureDocument>,
}

/// A definition of *PARAMETER.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ParameterDocument {
    name: String,
    expression: String,
    /// What the expression gives, for reading only: it follows from the expression. `null` when it gives nothing.
    #[serde(deserialize_with = "required")]
    value: Option<ValueDocument>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
enum ValueDocument {
    Integer(i64),
    Real(f64),
    Text(String),
}

/// `[start, end]` in bytes.
type SpanDocument = [u64; 2];

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct InteractionDocument {
    name: String,
    #[serde(default)]
    span: SpanDocument,
    thickness: f64,
    parameters: GivenDocuments,
    properties: Vec<f64>,
    #[serde(deserialize_with = "required")]
    gap_electrical_conductance: Option<ElectricalDocument>,
    #[serde(deserialize_with = "required")]
    contact_permeability: Option<PermeabilityDocument>,
    #[serde(deserialize_with = "required")]
    gap_heat_generation: Option<HeatDocument>,
    other: Vec<SubOptionDocument>,
}

/// Parameters by name; a flag has the value `null`.
type GivenDocuments = IndexMap<String, Option<String>>;

/// `{"user": true}` or `{"clearance": TABLE|null, "pressure": TABLE|null}`.
#[expect(clippy::option_option, reason = "a branch that is not there differs from one that is null")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ElectricalDocument {
    #[serde(default, skip_serializing_if = "is_false")]
    user: bool,
    #[serde(default, rename = "type", skip_serializing_if = "Option::is_none")]
    kind: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    clearance: Option<Option<TableDocument>>,
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pressure: Option<Option<TableDocument>>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PermeabilityDocument {
    #[serde(deserialize_with = "required")]
    table: Option<TableDocument>,
    #[serde(deserialize_with = "required")]
    cutoff_flow_across: Option<f64>,
    #[serde(deserialize_with = "required")]
    cutoff_gap_fill: Option<f64>,
    #[serde(deserialize_with = "required")]
    constraint_method: Option<MethodDocument>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
enum MethodDocument {
    #[serde(rename = "DIRECT")]
    Direct,
    #[serde(rename = "PENALTY")]
    Penalty,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct HeatDocument {
    fraction: f64,
    slave_weight: f64,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SubOptionDocument {
    keyword: String,
    parameters: GivenDocuments,
    #[serde(deserialize_with = "required")]
    table: Option<TableDocument>,
    rows: Vec<Vec<String>>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct TableDocument {
    columns: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ContactPairDocument {
    #[serde(deserialize_with = "required")]
    interaction: Option<String>,
    parameters: GivenDocuments,
    pairs: Vec<SurfacePairDocument>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SurfacePairDocument {
    slave: String,
    #[serde(deserialize_with = "required")]
    master: Option<String>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct AssignmentDocument {
    #[serde(deserialize_with = "required")]
    first: Option<String>,
    #[serde(deserialize_with = "required")]
    second: Option<String>,
    #[serde(deserialize_with = "required")]
    interaction: Option<String>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ProcedureDocument {
    step: usize,
    keyword: String,
    parameters: GivenDocuments,
    rows: Vec<Vec<String>>,
    /// `steady` or `transient`, for reading only: it follows from keyword and parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    regime: Option<RegimeDocument>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum RegimeDocument {
    Steady,
    Transient,
}

/// A number; `{"text": "<name>", "value": 1.5}` for one that is written with parameters (S-62); or the text of a cell
/// that is no number.
///
/// On the way back a text must have a parameter in it: a number that is malformed in the deck is to be mended.
#[derive(Debug, Clone, PartialEq)]
enum Cell {
    Number(f64),
    Symbolic(SymbolicCell),
    Text(String),
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SymbolicCell {
    text: String,
    value: f64,
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
        if references(value.as_bytes()).next().is_some() {
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

/// A field that must be there, though it may be `null`.
fn required<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    Option::deserialize(deserializer)
}

/// Tells a field that is there, and may be `null`, from one that is not.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_false(value: &bool) -> bool {
    !value
}

// Writing.

/// The model view of a deck as pretty-printed JSON; `source` is the name of the deck.
pub fn write(model: &Model, source: &str) -> String {
    let interactions = model.interactions.values().map(|found| (found.name.written().to_owned(), found.into()));
    let document = Document {
        schema: SCHEMA.to_owned(),
        source: source.to_owned(),
        parameters: model.parameters.definitions().iter().map(Into::into).collect(),
        interactions: interactions.collect(),
        contact_pairs: model.contact_pairs.iter().map(Into::into).collect(),
        property_assignments: model.property_assignments.iter().map(Into::into).collect(),
        procedures: model.procedures.iter().map(Into::into).collect(),
    };
    layout::to_string(&document)
}

impl From<&Interaction> for InteractionDocument {
    fn from(interaction: &Interaction) -> Self {
        Self {
            name: interaction.name.written().to_owned(),
            span: [interaction.span.start, interaction.span.end],
            thickness: interaction.thickness,
            parameters: given_documents(&interaction.parameters),
            properties: interaction.properties.clone(),
            gap_electrical_conductance: interaction.gap_electrical_conductance.as_ref().map(Into::into),
            contact_permeability: interaction.contact_permeability.as_ref().map(Into::into),
            gap_heat_generation: interaction
                .gap_heat_generation
                .map(|heat| HeatDocument { fraction: heat.fraction, slave_weight: heat.slave_weight }),
            other: interaction.other.iter().map(Into::into).collect(),
        }
    }
}

impl From<&expression::Definition> for ParameterDocument {
    fn from(definition: &expression::Definition) -> Self {
        let value = definition.value.as_ref().map(|value| match value {
            Value::Integer(value) => ValueDocument::Integer(*value),
            Value::Real(value) => ValueDocument::Real(*value),
            Value::Text(value) => ValueDocument::Text(value.clone()),
        });
        Self { name: definition.name.clone(), expression: definition.expression.clone(), value }
    }
}

fn given_documents(parameters: &[GivenParameter]) -> GivenDocuments {
    parameters.iter().map(|parameter| (parameter.name.clone(), parameter.value.clone())).collect()
}

impl From<&ElectricalConductance> for ElectricalDocument {
    fn from(law: &ElectricalConductance) -> Self {
        let table = |table: &Option<Table>| {
            // With USER the tables are void; they are shown only where the deck has them all the same (C003).
            (law.user.is_none() || table.is_some()).then(|| table.as_ref().map(Into::into))
        };
        Self {
            user: law.user.is_some(),
            kind: law.kind.clone(),
            clearance: table(&law.clearance),
            pressure: table(&law.pressure),
        }
    }
}

impl From<&ContactPermeability> for PermeabilityDocument {
    fn from(permeability: &ContactPermeability) -> Self {
        Self {
            table: permeability.table.as_ref().map(Into::into),
            cutoff_flow_across: permeability.cutoff_flow_across,
            cutoff_gap_fill: permeability.cutoff_gap_fill,
            constraint_method: permeability.constraint_method.map(|method| match method {
                ConstraintMethod::Direct => MethodDocument::Direct,
                ConstraintMethod::Penalty => MethodDocument::Penalty,
            }),
        }
    }
}

impl From<&SubOption> for SubOptionDocument {
    fn from(option: &SubOption) -> Self {
        Self {
            keyword: option.keyword.clone(),
            parameters: given_documents(&option.parameters),
            table: option.table.as_ref().map(Into::into),
            rows: option.rows.clone(),
        }
    }
}

impl From<&Table> for TableDocument {
    fn from(table: &Table) -> Self {
        let mut texts = table.texts.iter().peekable();
        let mut cells = table.values.iter().enumerate().map(|(cell, value)| {
            let text = texts.next_if(|text| text.cell == cell);
            match text.map(|text| text.text.clone()) {
                None => Cell::Number(*value),
                Some(text) if value.is_nan() => Cell::Text(text),
                Some(text) => Cell::Symbolic(SymbolicCell { text, value: *value }),
            }
        });
        let rows = (0..table.row_count()).map(|_| cells.by_ref().take(table.width()).collect());
        Self { columns: table.columns.clone(), rows: rows.collect() }
    }
}

impl From<&ContactPair> for ContactPairDocument {
    fn from(pair: &ContactPair) -> Self {
        let pairs = pair.pairs.iter().map(|pair| SurfacePairDocument {
            slave: pair.slave.name.written().to_owned(),
            master: written(pair.master.as_ref()),
        });
        Self {
            interaction: written(pair.interaction.as_ref()),
            parameters: given_documents(&pair.parameters),
            pairs: pairs.collect(),
        }
    }
}

impl From<&PropertyAssignment> for AssignmentDocument {
    fn from(assignment: &PropertyAssignment) -> Self {
        Self {
            first: written(assignment.first.as_ref()),
            second: written(assignment.second.as_ref()),
            interaction: written(assignment.interaction.as_ref()),
        }
    }
}

impl From<&Procedure> for ProcedureDocument {
    fn from(procedure: &Procedure) -> Self {
        Self {
            step: procedure.step,
            keyword: procedure.option.keyword.clone(),
            parameters: given_documents(&procedure.option.parameters),
            rows: procedure.option.rows.clone(),
            regime: procedure.regime().map(|regime| match regime {
                Regime::SteadyState => RegimeDocument::Steady,
                Regime::Transient => RegimeDocument::Transient,
            }),
        }
    }
}

fn written(reference: Option<&Reference>) -> Option<String> {
    reference.map(|reference| reference.name.written().to_owned())
}

// Reading.

/// Reads the model view back.
///
/// # Errors
/// JSON that is not of this view, a table whose rows do not fit its columns, a name or an item that no deck could hold.
pub fn read(text: &str) -> Result<Model, JsonError> {
    let document: Document = parse(text)?;
    if document.schema != SCHEMA {
        return Err(JsonError::new("schema", format!("expected `{SCHEMA}`, found `{}`", document.schema)));
    }
    let mut model = Model { parameters: parameters(&document.parameters)?, ..Model::default() };
    for (key, interaction) in document.interactions {
        let path = format!("interactions.{key}");
        if Name::new(&key) != Name::new(&interaction.name) {
            let message = format!("`{}` is not the name it stands under", interaction.name);
            return Err(JsonError::new(format!("{path}.name"), message));
        }
        let interaction = interaction.into_model(&path)?;
        if model.interactions.contains_key(&interaction.name) {
            return Err(JsonError::new(path, "an interaction of that name stands there already"));
        }
        model.interactions.insert(interaction.name.clone(), interaction);
    }
    model.contact_pairs = document.contact_pairs.into_iter().map(ContactPairDocument::into_model).collect();
    model.property_assignments =
        document.property_assignments.into_iter().map(AssignmentDocument::into_model).collect();
    let procedures = document.procedures.into_iter().enumerate();
    model.procedures = procedures.map(|(index, found)| found.into_model(index)).collect::<Result<_, _>>()?;
    Ok(model)
}

/// Executes the definitions again; what the JSON says of their values must agree.
fn parameters(documents: &[ParameterDocument]) -> Result<Parameters, JsonError> {
    let mut parameters = Parameters::new();
    for (index, document) in documents.iter().enumerate() {
        let statement = format!("{} = {}", document.name, document.expression);
        let line = StatementLine { span: Span::default(), text: statement.as_bytes() };
        let mut problems = Vec::new();
        define([line], &mut parameters, &mut problems);
        let path = format!("parameters[{index}]");
        if let Some(problem) = problems.first().filter(|_| document.value.is_some()) {
            return Err(JsonError::new(format!("{path}.expression"), problem.message.clone()));
        }
        let again = parameters.definitions().get(index).map(ParameterDocument::from);
        if again.as_ref().map(|again| &again.value) != Some(&document.value) {
            return Err(JsonError::new(format!("{path}.value"), "does not follow from the expression"));
        }
    }
    Ok(parameters)
}

impl InteractionDocument {
    fn into_model(self, path: &str) -> Result<Interaction, JsonError> {
        let [start, end] = self.span;
        let mut interaction = Interaction::new(Name::new(&self.name), Span::new(SourceId::ROOT, start, end));
        interaction.thickness = self.thickness;
        interaction.parameters = given_parameters(self.parameters);
        interaction.properties = self.properties;
        let electrical = self.gap_electrical_conductance;
        interaction.gap_electrical_conductance =
            electrical.map(|law| law.into_model(&format!("{path}.gap_electrical_conductance"))).transpose()?;
        interaction.contact_permeability = self
            .contact_permeability
            .map(|option| option.into_model(&format!("{path}.contact_permeability")))
            .transpose()?;
        interaction.gap_heat_generation = self.gap_heat_generation.map(|heat| HeatGeneration {
            span: Span::default(),
            row: None,
            fraction: heat.fraction,
            slave_weight: heat.slave_weight,
        });
        let other = self.other.into_iter().enumerate();
        interaction.other = other
            .map(|(index, option)| option.into_model(&format!("{path}.other[{index}]")))
            .collect::<Result<_, _>>()?;
        Ok(interaction)
    }
}

fn given_parameters(parameters: GivenDocuments) -> Vec<GivenParameter> {
    parameters.into_iter().map(|(name, value)| GivenParameter { name, value, span: Span::default() }).collect()
}

impl ElectricalDocument {
    fn into_model(self, path: &str) -> Result<ElectricalConductance, JsonError> {
        if !self.user {
            for (branch, is_there) in [("clearance", self.clearance.is_some()), ("pressure", self.pressure.is_some())] {
                if !is_there {
                    return Err(JsonError::new(path, format!("missing field `{branch}`: a table, or null")));
                }
            }
        }
        let table = |table: Option<Option<TableDocument>>, branch: &str| {
            let expected = ["conductance", branch, "temp"];
            table.flatten().map(|table| table.into_model(&format!("{path}.{branch}"), &expected)).transpose()
        };
        Ok(ElectricalConductance {
            user: self.user.then(Span::default),
            clearance: table(self.clearance, "clearance")?,
            pressure: table(self.pressure, "pressure")?,
            kind: self.kind,
        })
    }
}

impl PermeabilityDocument {
    fn into_model(self, path: &str) -> Result<ContactPermeability, JsonError> {
        let expected = ["permeability", "pressure", "pore_pressure", "temp"];
        Ok(ContactPermeability {
            span: Span::default(),
            table: self.table.map(|table| table.into_model(&format!("{path}.table"), &expected)).transpose()?,
            cutoff_flow_across: self.cutoff_flow_across,
            cutoff_gap_fill: self.cutoff_gap_fill,
            constraint_method: self.constraint_method.map(|method| match method {
                MethodDocument::Direct => ConstraintMethod::Direct,
                MethodDocument::Penalty => ConstraintMethod::Penalty,
            }),
        })
    }
}

impl SubOptionDocument {
    fn into_model(self, path: &str) -> Result<SubOption, JsonError> {
        Ok(SubOption {
            keyword: self.keyword,
            span: Span::default(),
            parameters: given_parameters(self.parameters),
            table: self.table.map(|table| table.into_model(&format!("{path}.table"), &[])).transpose()?,
            rows: self.rows,
        })
    }
}

impl TableDocument {
    /// The table; its first columns must be `expected`, and field variables may follow.
    fn into_model(self, path: &str, expected: &[&str]) -> Result<Table, JsonError> {
        self.check_columns(path, expected)?;
        let mut table = Table { columns: self.columns, ..Table::default() };
        for (index, row) in self.rows.into_iter().enumerate() {
            if row.len() != table.width() {
                let message = format!("{} items in a table of {} columns", row.len(), table.width());
                return Err(JsonError::new(format!("{path}.rows[{index}]"), message));
            }
            for cell in row {
                match cell {
                    Cell::Number(value) => table.values.push(value),
                    Cell::Symbolic(SymbolicCell { text, value }) => {
                        table.texts.push(CellText { cell: table.values.len(), text });
                        table.values.push(value);
                    }
                    Cell::Text(text) => {
                        table.texts.push(CellText { cell: table.values.len(), text });
                        table.values.push(f64::NAN);
                    }
                }
            }
        }
        Ok(table)
    }

    fn check_columns(&self, path: &str, expected: &[&str]) -> Result<(), JsonError> {
        let fields = (1..).map(|number| format!("fv{number}"));
        let names = expected.iter().map(|name| (*name).to_owned()).chain(fields);
        if self.columns.is_empty() || self.columns.len() < expected.len() {
            let message = format!("expected the columns {}, then fv1, fv2, …", expected.join(", "));
            return Err(JsonError::new(format!("{path}.columns"), message));
        }
        for (index, (column, name)) in self.columns.iter().zip(names).enumerate() {
            if !expected.is_empty() && *column != name {
                let message = format!("unknown column `{column}`, expected `{name}`");
                return Err(JsonError::new(format!("{path}.columns[{index}]"), message));
            }
        }
        Ok(())
    }
}

impl ContactPairDocument {
    fn into_model(self) -> ContactPair {
        let pairs = self
            .pairs
            .into_iter()
            .map(|pair| SurfacePair { slave: reference_to(pair.slave), master: pair.master.map(reference_to) });
        ContactPair {
            span: Span::default(),
            interaction: self.interaction.map(reference_to),
            parameters: given_parameters(self.parameters),
            pairs: pairs.collect(),
        }
    }
}

impl AssignmentDocument {
    fn into_model(self) -> PropertyAssignment {
        PropertyAssignment {
            span: Span::default(),
            first: self.first.map(reference_to),
            second: self.second.map(reference_to),
            interaction: self.interaction.map(reference_to),
        }
    }
}

impl ProcedureDocument {
    fn into_model(self, index: usize) -> Result<Procedure, JsonError> {
        let option = SubOption {
            keyword: self.keyword,
            span: Span::default(),
            parameters: given_parameters(self.parameters),
            table: None,
            rows: self.rows,
        };
        let procedure = Procedure { step: self.step, option };
        let derived = ProcedureDocument::from(&procedure).regime;
        if self.regime.is_some() && self.regime != derived {
            let message = "does not follow from the keyword and its parameters";
            return Err(JsonError::new(format!("procedures[{index}].regime"), message));
        }
        Ok(procedure)
    }
}

#[expect(clippy::needless_pass_by_value, reason = "used as a function of an Option's content")]
fn reference_to(name: String) -> Reference {
    Reference { name: Name::new(&name), span: Span::default() }
}
