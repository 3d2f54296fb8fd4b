//! The plan of an evaluation: which laws, tables, columns and outputs a deck and a node table need, and what is left out, with the reason.
//!
//! A [`Survey`] reads the node table once: which columns have numbers in the rows of each interaction, and their bounds.
//! [`make`] combines deck and survey. A [`Plan`] is a plain value that can be printed; [`Evaluation`](crate::evaluate::Evaluation) runs it.
//!
//! Decisions (section 9.2, C-24, P-01, P-03, U-3, Q-1 to Q-6 of the semantics):
//!
//! - steady state or transient by the last procedure of the deck that solves the law's field, steady state where there is none; [`Choices::regime`] overrides both;
//! - an interaction has the electrical law when it has *GAP ELECTRICAL CONDUCTANCE, whatever the procedures;
//! - it has the thermal law when it has *GAP CONDUCTANCE or *GAP RADIATION, or its rows have the columns of friction;
//! - it has the pore fluid law when both sides have pore pressures in its rows, and it has *CONTACT PERMEABILITY or a procedure solves pore pressure;
//! - an output whose columns are not all present is left out; a law that lacks a column for each of its results is left out as a whole.

mod choices;
mod columns;
mod concern;
mod cost;
mod dropped;
pub(crate) mod folding;
mod governing;
pub(crate) mod law_columns;
mod make;
mod outline;
pub(crate) mod output_groups;
pub(crate) mod planner;
mod print;
pub(crate) mod reason;
pub(crate) mod regime;
mod requested;
pub(crate) mod source;
mod survey;
mod surveyed;
mod table_plan;
pub(crate) mod tables;
mod wanted;

pub use crate::law::electrical::plan::ElectricalPlan;
pub use crate::law::friction::plan::{FrictionPlan, SlipRateSource};
pub use crate::law::pore::plan::{Bulk, CharacteristicLength, PorePlan, Rate};
pub use crate::law::radiation::plan::RadiationPlan;
pub use crate::law::thermal::conduction::{ConductionPlan, MassFlow};
pub use crate::law::thermal::plan::{CurrentHeat, ThermalPlan};
pub use crate::law::user::plan::UserPlan;
pub use choices::{Choices, Currents, Derivatives};
pub use concern::concerning;
pub use dropped::Dropped;
pub use governing::{GovernedBy, NameFault, RowInteractions};
pub use make::make;
pub use outline::{Cut, Node, Outline};
pub use reason::{LeftOut, Missing, Reason};
pub use regime::{RegimeInForce, RegimeReason};
pub use source::{Presence, Source};
pub use survey::{survey, survey_keeping};
pub use surveyed::{ColumnSurvey, InteractionSurvey, Survey};
pub use table_plan::{AxisPlan, ContactColumns, FormPlan, History, TablePlan};

pub(crate) use planner::generation_of;
pub(crate) use survey::ContactPlaces;
pub(crate) use tables::{BuiltTables, InteractionTables};

use crate::nodes::{Batch, Column, Findings, HistoryOrder, MISSING_COLUMN, Place, Selection};
use crate::results::Output;
use inpact_parser::model::Name;
use std::sync::Arc;

/// The plan of an evaluation.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The number of rows of the node table.
    pub rows: u64,
    /// The source of the interaction that governs a row.
    pub governed_by: GovernedBy,
    /// The interactions that govern rows, in the order of the deck.
    pub interactions: Vec<InteractionPlan>,
    /// The interactions of the deck that govern none.
    pub unused: Vec<Name>,
    /// The role of each column of the node table, in the order of its header.
    pub columns: Vec<ColumnPlan>,
    /// The order of the rows by node, where they have histories.
    pub order: HistoryOrder,
    /// The columns an evaluation reads.
    pub selection: Selection,
    /// The columns of the result besides the key columns, in their order.
    pub outputs: Vec<Output>,
}

/// The parts evaluated in the rows of one interaction.
#[derive(Debug, Clone, PartialEq)]
pub struct InteractionPlan {
    /// Its name.
    pub name: Name,
    /// Its index in the model.
    pub index: usize,
    /// The number of rows it governs.
    pub rows: u64,
    /// The number of closed rows.
    pub closed: u64,
    /// The number of open rows.
    pub open: u64,
    /// The number of its nodes, where they have histories.
    pub histories: Option<u64>,
    /// The columns that decide contact.
    pub contact: ContactColumns,
    /// The electrical law.
    pub electrical: Option<Box<ElectricalPlan>>,
    /// The thermal law.
    pub thermal: Option<Box<ThermalPlan>>,
    /// The pore fluid law.
    pub pore: Option<Box<PorePlan>>,
    /// The tables of the deck that its laws are made of.
    pub(crate) tables: Arc<BuiltTables>,
    /// The outputs, in the order of the result's columns.
    pub outputs: Vec<Output>,
    /// The parts left out, and why.
    pub left_out: Vec<LeftOut>,
    /// The parts of its laws that were dropped, with their costs.
    pub dropped: Vec<Dropped>,
    /// Notes.
    pub notes: Vec<String>,
}

/// A column of the node table and its role.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnPlan {
    /// Its name in the header.
    pub header: String,
    /// Its meaning; `None` for a name the contract does not have.
    pub column: Option<Column>,
    /// Its role.
    pub role: ColumnRole,
    /// The smallest and the largest number in it, where it was read and has finite ones.
    pub range: Option<(f64, f64)>,
}

/// Roles of columns.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnRole {
    /// Its texts are those of the result.
    Key,
    /// The same, and its numbers or names are used as well.
    KeyAndRead,
    /// Its numbers are used.
    Read,
    /// It is skipped.
    NotRead(Reason),
}

impl Plan {
    /// The key columns of the result: those the node table has, in the order of the contract.
    pub fn keys(&self) -> &[Column] {
        &self.selection.labels
    }

    /// Gives the rows of a batch the name of the interaction chosen for all of them, overriding the node table.
    pub fn name_rows(&self, batch: &mut Batch) {
        let GovernedBy::Chosen(chosen) = self.governed_by else { return };
        let name =
            self.interactions.iter().find(|interaction| interaction.index == chosen).map(|plan| plan.name.written());
        if let (Some(place), Some(name)) = (self.selection.label(Column::Interaction), name) {
            batch.labels[place].fill(name.as_bytes(), batch.rows);
        }
    }

    /// Reports each column whose absence leaves something out (D001): for a plan with nothing to evaluate.
    pub fn report_missing(&self, findings: &mut Findings) {
        for interaction in &self.interactions {
            for LeftOut { what, reason, .. } in &interaction.left_out {
                let Reason::Missing(missing) = reason else { continue };
                let message = format!("{missing}, which the {what} of `{}` needs", interaction.name);
                let place = Place { column: missing.columns.first().map(ToString::to_string), ..Place::default() };
                findings.report(&MISSING_COLUMN, place, message, "");
            }
        }
    }
}
