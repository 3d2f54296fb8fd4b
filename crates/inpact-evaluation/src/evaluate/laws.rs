//! The laws of a plan with the columns of a batch that they read and fill.

use crate::history::{ClosingHeat, HistoryStart};
use crate::law::electrical::columns::ElectricalColumns;
use crate::law::pore::columns::PoreColumns;
use crate::law::thermal::columns::ThermalColumns;
use crate::nodes::Column;
use crate::plan::{Choices, ContactPlaces, History, InteractionPlan, Plan, Source};
use crate::results::{Along, Output};
use inpact_parser::model::Model;

/// The laws of a plan.
#[derive(Debug, Clone)]
pub(super) struct Laws {
    /// The laws of each interaction of the model; `None` for those that govern no row.
    pub(super) interactions: Vec<Option<InteractionLaws>>,
    /// How many columns of numbers the results have.
    pub(super) result_columns: usize,
    /// The outputs that are added up over an interface, with their places among the results; none where the times of the rows are not known.
    pub(super) summed: Vec<(Output, usize)>,
    /// Where a batch has the texts of column `node`.
    pub(super) node: Option<usize>,
    /// Where a batch has the texts of column `interaction`.
    pub(super) interaction: Option<usize>,
    /// Where a batch has the numbers of column `time`.
    pub(super) time: Option<usize>,
    /// Where the histories of nodes start.
    pub(super) history_start: HistoryStart,
    /// The jump in the heat of an increment that closes a circuit.
    pub(super) closing_heat: ClosingHeat,
    /// Whether a routine of the user's is asked, which sees the rows in their order and one at a time.
    pub(super) asks_user: bool,
}

/// The laws of one interaction.
#[derive(Debug, Clone)]
pub(super) struct InteractionLaws {
    pub(super) contact: ContactPlaces,
    pub(super) electrical: Option<ElectricalColumns>,
    pub(super) thermal: Option<ThermalColumns>,
    pub(super) pore: Option<PoreColumns>,
    /// Whether the rows of a node are increments of one of them.
    pub(super) keeps_history: bool,
}

/// Finds the places of columns and results for the laws of one interaction.
#[derive(Clone, Copy)]
pub(crate) struct Binder<'a> {
    plan: &'a Plan,
    of: &'a InteractionPlan,
}

impl Laws {
    /// The laws of a plan that was made from this model and these choices.
    pub(super) fn of(model: &Model, plan: &Plan, choices: &Choices) -> Self {
        let mut interactions: Vec<Option<InteractionLaws>> = Vec::new();
        interactions.resize_with(model.interactions.len(), || None);
        for planned in &plan.interactions {
            interactions[planned.index] = Some(InteractionLaws::of(Binder { plan, of: planned }, choices));
        }
        Self {
            interactions,
            result_columns: numbers(plan).count(),
            summed: if has_known_times(plan) { super::totals::summed(numbers(plan)) } else { Vec::new() },
            node: plan.selection.label(Column::Node),
            interaction: plan.selection.label(Column::Interaction),
            time: plan.selection.number(Column::Time),
            history_start: choices.history_start,
            closing_heat: choices.closing_heat,
            asks_user: choices.user_conductance.is_some(),
        }
    }

    /// The columns of texts that laws read of a part.
    pub(super) fn labels(&self) -> Vec<usize> {
        self.node.into_iter().collect()
    }
}

impl InteractionLaws {
    fn of(binder: Binder<'_>, choices: &Choices) -> Self {
        let planned = binder.of;
        let (flow, thermal) = (&planned.tables.flow, &planned.tables.thermal);
        let electrical = planned.electrical.as_deref();
        let laws = Self {
            contact: binder.contact(),
            electrical: electrical.and_then(|law| ElectricalColumns::bind(binder, law, flow, choices)),
            thermal: planned.thermal.as_ref().map(|law| ThermalColumns::bind(binder, law, thermal, choices)),
            pore: planned.pore.as_ref().map(|law| PoreColumns::bind(binder, law, flow, choices)),
            keeps_history: false,
        };
        let histories = [
            laws.electrical.as_ref().map(|law| law.history),
            laws.thermal.as_ref().map(|law| law.history),
            laws.pore.as_ref().map(|law| law.history),
        ];
        Self { keeps_history: histories.contains(&Some(History::ByTime)), ..laws }
    }
}

/// Whether the times of the rows are read, or there are none.
fn has_known_times(plan: &Plan) -> bool {
    let is_there = plan.columns.iter().any(|column| column.column == Some(Column::Time));
    !is_there || plan.selection.number(Column::Time).is_some()
}

/// The outputs that are numbers.
fn numbers(plan: &Plan) -> impl Iterator<Item = Output> {
    plan.outputs.iter().copied().filter(|output| output.is_number())
}

impl Binder<'_> {
    fn contact(self) -> ContactPlaces {
        let place = |column: Option<Column>| self.place(column?);
        let columns = self.of.contact;
        ContactPlaces {
            clearance: place(columns.clearance),
            pressure: place(columns.pressure),
            closed: place(columns.closed),
            state: columns.state,
        }
    }

    /// The place of a column among the numbers of a batch.
    pub(crate) fn place(self, column: Column) -> Option<usize> {
        self.plan.selection.number(column)
    }

    /// The place of a column among the texts of a batch.
    pub(crate) fn label(self, column: Column) -> Option<usize> {
        self.plan.selection.label(column)
    }

    /// Where an output goes, if this interaction gives it.
    pub(crate) fn slot(self, output: Output) -> Option<usize> {
        let is_given = self.of.outputs.contains(&output);
        numbers(self.plan).position(|planned| planned == output).filter(|_| is_given)
    }

    /// Where the slopes of a law go, and along what they are.
    pub(crate) fn slopes(self, along: impl Fn(Output) -> Option<Along>) -> Vec<(usize, Along)> {
        self.of.outputs.iter().filter_map(|output| Some((self.slot(*output)?, along(*output)?))).collect()
    }

    /// A source in terms of places.
    pub(crate) fn source(self, source: Option<Source<Column>>) -> Option<Source<usize>> {
        // The plan reads every column it names.
        source.map(|source| source.map(|column| self.place(column).unwrap_or_default()))
    }
}
