//! From the document to the model, with the checks that the types of the document cannot express.

use super::SCHEMA;
use super::document::{
    AssignmentDocument, Cell, ContactPairDocument, Document, ElectricalDocument, GivenDocuments, InteractionDocument,
    MethodDocument, ParameterDocument, PermeabilityDocument, ProcedureDocument, SubOptionDocument, SymbolicCell,
    TableDocument,
};
use crate::Error;
use crate::expression::{Parameters, StatementLine, define};
use crate::grammar::{Dialect, Release};
use crate::json::parse;
use crate::model::named_in;
use crate::model::{
    CellText, ConstraintMethod, ContactPair, ContactPermeability, ElectricalConductance, GivenParameter,
    HeatGeneration, Interaction, MAX_FIELD_VARIABLES, Model, Name, Procedure, PropertyAssignment, Reference, SubOption,
    SurfacePair, Table,
};
use crate::span::{SourceId, Span};
use std::collections::HashSet;

/// The greatest number of a step: every step up to it is written, also those without a procedure.
const MAX_STEPS: usize = 100_000;

/// Reads the model view back.
///
/// # Errors
/// JSON that is not of this view, a table whose rows do not fit its columns, a name or an item that no deck can express.
pub fn read(text: &str) -> Result<Model, Error> {
    let document: Document = parse(text)?;
    if document.schema != SCHEMA {
        return Err(Error::json("schema", format!("expected `{SCHEMA}`, found `{}`", document.schema)));
    }
    let mut model = Model { parameters: parameters(&document.parameters)?, ..Model::default() };
    let dialect = dialect_of(&document.interactions.iter().map(|(key, _)| key.as_str()));
    for (key, interaction) in document.interactions {
        let path = format!("interactions.{key}");
        if Name::new(&key) != Name::new(&interaction.name) {
            let message = format!("expected the name of its key, found `{}`", interaction.name);
            return Err(Error::json(format!("{path}.name"), message));
        }
        let mut interaction = interaction.into_model(&path)?;
        interaction.name = Name::in_dialect(interaction.name.written(), dialect);
        if model.interactions.contains_key(&interaction.name) {
            return Err(Error::json(path, "duplicate interaction"));
        }
        model.interactions.insert(interaction);
    }
    model.contact_pairs = document.contact_pairs.into_iter().map(ContactPairDocument::into_model).collect();
    model.property_assignments =
        document.property_assignments.into_iter().map(AssignmentDocument::into_model).collect();
    let procedures = document.procedures.into_iter().enumerate();
    model.procedures = procedures.map(|(index, found)| found.into_model(index)).collect::<Result<_, _>>()?;
    Ok(named_in(dialect, model))
}

/// The dialect whose names these are: JSON does not say which, and only CalculiX tells `"SI"` and `SI` apart (CX-02).
fn dialect_of<'key>(keys: &(impl Iterator<Item = &'key str> + Clone)) -> Dialect {
    let is_distinguished = |dialect| {
        let mut names = HashSet::new();
        keys.clone().all(|key| names.insert(Name::in_dialect(key, dialect)))
    };
    let is_of_calculix = !is_distinguished(Dialect::Abaqus) && is_distinguished(Dialect::Calculix);
    if is_of_calculix { Dialect::Calculix } else { Dialect::Abaqus }
}

/// Executes the definitions again; the values in the JSON must agree.
///
/// The values are those of some release: where they are not those of the newest, they may be those of an older one (S-60).
fn parameters(documents: &[ParameterDocument]) -> Result<Parameters, Error> {
    parameters_of(documents, Release::NEWEST)
        .or_else(|error| parameters_of(documents, Release::R2022).map_err(|_| error))
}

fn parameters_of(documents: &[ParameterDocument], release: Release) -> Result<Parameters, Error> {
    let mut parameters = Parameters::of_release(release);
    for (index, document) in documents.iter().enumerate() {
        let statement = format!("{} = {}", document.name, document.expression);
        let line = StatementLine { span: Span::default(), text: statement.as_bytes() };
        let mut problems = Vec::new();
        define([line], &mut parameters, &mut problems);
        let path = format!("parameters[{index}]");
        if let Some(problem) = problems.first().filter(|_| document.value.is_some()) {
            return Err(Error::json(format!("{path}.expression"), problem.message.clone()));
        }
        let again = parameters.definitions().get(index).map(ParameterDocument::from);
        // Without a value there is nothing to compare: the statement had a problem where it was read, which may be
        // a byte that JSON cannot show.
        let agrees = document.value.is_none() || again.is_some_and(|again| again.value == document.value);
        if !agrees {
            return Err(Error::json(format!("{path}.value"), "does not follow from the expression"));
        }
    }
    Ok(parameters)
}

impl InteractionDocument {
    fn into_model(self, path: &str) -> Result<Interaction, Error> {
        let [start, end] = self.span;
        let mut interaction = Interaction::new(Name::new(&self.name), Span::new(SourceId::ROOT, start, end));
        interaction.thickness = self.thickness;
        interaction.parameters = given_parameters(self.parameters).into();
        interaction.properties = self.properties.into();
        let electrical = self.gap_electrical_conductance;
        interaction.gap_electrical_conductance = electrical
            .map(|law| law.into_model(&format!("{path}.gap_electrical_conductance")).map(Box::new))
            .transpose()?;
        interaction.contact_permeability = self
            .contact_permeability
            .map(|option| option.into_model(&format!("{path}.contact_permeability")).map(Box::new))
            .transpose()?;
        interaction.gap_heat_generation = self.gap_heat_generation.map(|heat| {
            Box::new(HeatGeneration {
                span: Span::default(),
                row: None,
                fraction: heat.fraction.value(),
                slave_weight: heat.slave_weight.value(),
                slip_rate: heat.slip_rate.as_ref().map(Cell::value),
                texts: [Some(heat.fraction), Some(heat.slave_weight), heat.slip_rate]
                    .into_iter()
                    .flatten()
                    .enumerate()
                    .filter_map(written)
                    .collect(),
            })
        });
        let other = self.other.into_iter().enumerate();
        interaction.other = other
            .map(|(index, option)| option.into_model(&format!("{path}.other[{index}]")))
            .collect::<Result<_, _>>()?;
        Ok(interaction)
    }
}

/// The text of a cell that is not written as a number.
fn written((place, cell): (usize, Cell)) -> Option<CellText> {
    match cell {
        Cell::Number(_) => None,
        Cell::Symbolic(SymbolicCell { text, .. }) | Cell::Text(text) => Some(CellText { cell: place, text }),
    }
}

fn given_parameters(parameters: GivenDocuments) -> Vec<GivenParameter> {
    parameters
        .0
        .into_iter()
        .map(|(name, value)| GivenParameter { name: name.into(), value: value.map(Into::into), span: Span::default() })
        .collect()
}

impl ElectricalDocument {
    fn into_model(self, path: &str) -> Result<ElectricalConductance, Error> {
        if !self.user {
            for (branch, is_there) in [("clearance", self.clearance.is_some()), ("pressure", self.pressure.is_some())] {
                if !is_there {
                    return Err(Error::json(path, format!("missing field `{branch}`: a table, or null")));
                }
            }
        }
        let table = |table: Option<Option<TableDocument>>, branch: &str| {
            let expected = ["conductance", branch, "temp"];
            table
                .flatten()
                .map(|table| table.into_model(&format!("{path}.{branch}"), &expected).map(Box::new))
                .transpose()
        };
        Ok(ElectricalConductance {
            user: self.user.then(Span::default),
            clearance: table(self.clearance, "clearance")?,
            pressure: table(self.pressure, "pressure")?,
            kind: self.kind.map(Into::into),
        })
    }
}

impl PermeabilityDocument {
    fn into_model(self, path: &str) -> Result<ContactPermeability, Error> {
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
    fn into_model(self, path: &str) -> Result<SubOption, Error> {
        Ok(SubOption {
            keyword: self.keyword.into(),
            span: Span::default(),
            parameters: given_parameters(self.parameters).into(),
            table: self.table.map(|table| table.into_model(&format!("{path}.table"), &[])).transpose()?.map(Box::new),
            rows: self.rows.into_iter().collect(),
        })
    }
}

impl TableDocument {
    /// The table; its first columns must be `expected`, and field variables may follow.
    fn into_model(self, path: &str, expected: &[&str]) -> Result<Table, Error> {
        self.check_columns(path, expected)?;
        let mut table = Table { columns: self.columns.into(), ..Table::default() };
        if let Some(dependencies) = self.dependencies {
            let listed = table.dependencies();
            if dependencies < listed || MAX_FIELD_VARIABLES < dependencies {
                let message = format!(
                    "expected a number from {listed}, which are listed, to {MAX_FIELD_VARIABLES}, found {dependencies}"
                );
                return Err(Error::json(format!("{path}.dependencies"), message));
            }
            table.unwritten = dependencies - listed;
        }
        let (mut values, mut texts) = (Vec::new(), Vec::new());
        for (index, row) in self.rows.into_iter().enumerate() {
            if row.len() != table.width() {
                let message = format!("{} items in a table of {} columns", row.len(), table.width());
                return Err(Error::json(format!("{path}.rows[{index}]"), message));
            }
            for cell in row {
                let value = cell.value();
                texts.extend(written((values.len(), cell)));
                values.push(value);
            }
        }
        (table.values, table.texts) = (values.into(), texts.into());
        Ok(table)
    }

    fn check_columns(&self, path: &str, expected: &[&str]) -> Result<(), Error> {
        let fields = (1..).map(|number| format!("fv{number}"));
        let names = expected.iter().map(|name| (*name).to_owned()).chain(fields);
        if self.columns.is_empty() || self.columns.len() < expected.len() {
            let message = format!("expected the columns {}, then fv1, fv2, …", expected.join(", "));
            return Err(Error::json(format!("{path}.columns"), message));
        }
        for (index, (column, name)) in self.columns.iter().zip(names).enumerate() {
            if !expected.is_empty() && *column != name {
                let message = format!("unknown column `{column}`, expected `{name}`");
                return Err(Error::json(format!("{path}.columns[{index}]"), message));
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
            parameters: given_parameters(self.parameters).into(),
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
    fn into_model(self, index: usize) -> Result<Procedure, Error> {
        let option = SubOption {
            keyword: self.keyword.into(),
            span: Span::default(),
            parameters: given_parameters(self.parameters).into(),
            table: None,
            rows: self.rows.into_iter().collect(),
        };
        if self.step > MAX_STEPS {
            let message = format!("expected the number of a step from 0 to {MAX_STEPS}, found {}", self.step);
            return Err(Error::json(format!("procedures[{index}].step"), message));
        }
        let procedure = Procedure { step: self.step, option };
        let derived = ProcedureDocument::from(&procedure).regime;
        if self.regime.is_some() && self.regime != derived {
            let message = "does not follow from the keyword and its parameters";
            return Err(Error::json(format!("procedures[{index}].regime"), message));
        }
        Ok(procedure)
    }
}

#[expect(clippy::needless_pass_by_value, reason = "used as a function of an Option's content")]
fn reference_to(name: String) -> Reference {
    Reference { name: Name::new(&name), span: Span::default() }
}
