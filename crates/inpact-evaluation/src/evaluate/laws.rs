//! The laws of a plan with the columns of a batch that they read and fill.

use crate::history::{ClosingHeat, HistoryStart};
use crate::law::electrical::columns::ElectricalColumns;
use crate::law::pore::columns::PoreColumns;
use crate::law::thermal::columns::ThermalColumns;
use crate::nodes::Column;
use crate::plan::{Choices, ContactPlaces, History, Plan};
use crate::results::Output;
use crate::rows::{Binder, numbers};
use inpact_parser::model::Model;

/// The laws of a plan.
#[derive(Debug, Clone)]
pub(super) struct Laws {
    /// The laws of each interaction of the model; `None` for those that govern no row.
    pub(super) interactions: Vec<Option<InteractionLaws>>,
    /// The number of columns of numbers in the results.
    pub(super) result_columns: usize,
    /// The outputs that are summed over an interface, with their indices in the results; none where the times of the rows are unknown.
    pub(super) summed: Vec<(Output, usize)>,
    /// The index of column `node` among the texts of a batch.
    pub(super) node: Option<usize>,
    /// The index of column `interaction` among the texts of a batch.
    pub(super) interaction: Option<usize>,
    /// The index of column `time` among the numbers of a batch.
    pub(super) time: Option<usize>,
    /// The start of the histories of nodes.
    pub(super) history_start: HistoryStart,
    /// The jump in the heat of an increment that closes a circuit.
    pub(super) closing_heat: ClosingHeat,
    /// Whether data of the summary are computed.
    pub(super) summary: Summary,
    /// Whether a user's routine is called, sequentially in the order of the rows.
    pub(super) asks_user: bool,
}

/// Data of the summary: totals, and the errors of a sample of rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Summary {
    Made,
    LeftOut,
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
            summed: if has_known_times(plan) { crate::rows::summed(numbers(plan)) } else { Vec::new() },
            node: plan.selection.label(Column::Node),
            interaction: plan.selection.label(Column::Interaction),
            time: plan.selection.number(Column::Time),
            history_start: choices.history_start,
            closing_heat: choices.closing_heat,
            summary: Summary::Made,
            asks_user: choices.user_conductance.is_some(),
        }
    }

    /// The outputs that are summed over an interface.
    pub(super) fn summed_outputs(&self) -> Vec<Output> {
        self.summed.iter().map(|(output, _)| *output).collect()
    }

    /// The same without the data of the summary.
    pub(super) fn leave_out_summary(&mut self) {
        self.summary = Summary::LeftOut;
        self.summed.clear();
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
