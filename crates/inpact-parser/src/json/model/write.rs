//! From the model to its document.

use super::SCHEMA;
use super::document::{
    AssignmentDocument, Cell, ContactPairDocument, Document, ElectricalDocument, GivenDocuments, HeatDocument,
    InteractionDocument, MethodDocument, ParameterDocument, PermeabilityDocument, ProcedureDocument, RegimeDocument,
    SubOptionDocument, SurfacePairDocument, SymbolicCell, TableDocument, Unique, ValueDocument,
};
use crate::expression::{self, Value};
use crate::json::layout;
use crate::model::{
    CellText, ConstraintMethod, ContactPair, ContactPermeability, ElectricalConductance, GivenParameter, Interaction,
    Model, Procedure, PropertyAssignment, Reference, Regime, SubOption, Table, TextRows,
};

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
            span: [interaction.span.start(), interaction.span.end()],
            thickness: interaction.thickness,
            parameters: given_documents(&interaction.parameters),
            properties: interaction.properties.to_vec(),
            gap_electrical_conductance: interaction.gap_electrical_conductance.as_deref().map(Into::into),
            contact_permeability: interaction.contact_permeability.as_deref().map(Into::into),
            gap_heat_generation: interaction.gap_heat_generation.as_ref().map(|heat| HeatDocument {
                fraction: cell(heat.fraction, heat.texts.iter().find(|text| text.cell == 0)),
                slave_weight: cell(heat.slave_weight, heat.texts.iter().find(|text| text.cell == 1)),
                slip_rate: heat.slip_rate.map(|speed| cell(speed, heat.texts.iter().find(|text| text.cell == 2))),
            }),
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
    Unique(
        parameters
            .iter()
            .map(|parameter| (parameter.name.to_string(), parameter.value.as_deref().map(str::to_owned)))
            .collect(),
    )
}

fn text_documents(rows: &TextRows) -> Vec<Vec<String>> {
    rows.iter().map(|row| row.into_iter().map(str::to_owned).collect()).collect()
}

impl From<&ElectricalConductance> for ElectricalDocument {
    fn from(law: &ElectricalConductance) -> Self {
        let table = |table: Option<&Table>| {
            // With USER the tables are void; they are shown only where the deck has them nevertheless (C003).
            (law.user.is_none() || table.is_some()).then(|| table.map(Into::into))
        };
        Self {
            user: law.user.is_some(),
            kind: law.kind.as_deref().map(str::to_owned),
            clearance: table(law.clearance.as_deref()),
            pressure: table(law.pressure.as_deref()),
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
            keyword: option.keyword.to_string(),
            parameters: given_documents(&option.parameters),
            table: option.table.as_deref().map(Into::into),
            rows: text_documents(&option.rows),
        }
    }
}

impl From<&Table> for TableDocument {
    fn from(table: &Table) -> Self {
        let mut texts = table.texts.iter().peekable();
        let mut cells = table.values.iter().enumerate().map(|(place, value)| {
            let text = texts.next_if(|text| text.cell == place);
            cell(*value, text)
        });
        let rows = (0..table.row_count()).map(|_| cells.by_ref().take(table.width()).collect());
        let dependencies = (table.unwritten > 0).then(|| table.declared_dependencies());
        Self { columns: table.columns.to_vec(), dependencies, rows: rows.collect() }
    }
}

/// A number, with its text in the deck where it is not written as one.
fn cell(value: f64, text: Option<&CellText>) -> Cell {
    match text.map(|text| text.text.clone()) {
        None => Cell::Number(value),
        Some(text) if value.is_nan() => Cell::Text(text),
        Some(text) => Cell::Symbolic(SymbolicCell { text, value }),
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
            keyword: procedure.option.keyword.to_string(),
            parameters: given_documents(&procedure.option.parameters),
            rows: text_documents(&procedure.option.rows),
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
