//! Places of columns and results for the laws of an interaction.

use crate::nodes::Column;
use crate::plan::{ContactPlaces, InteractionPlan, Plan, Source};
use crate::results::{Along, Output};

/// Binds the columns and results of the laws of one interaction to indices.
#[derive(Clone, Copy)]
pub(crate) struct Binder<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) of: &'a InteractionPlan,
}

/// The outputs that are numbers.
pub(crate) fn numbers(plan: &Plan) -> impl Iterator<Item = Output> {
    plan.outputs.iter().copied().filter(|output| output.is_number())
}

impl Binder<'_> {
    pub(crate) fn contact(self) -> ContactPlaces {
        let place = |column: Option<Column>| self.place(column?);
        let columns = self.of.contact;
        ContactPlaces {
            clearance: place(columns.clearance),
            pressure: place(columns.pressure),
            closed: place(columns.closed),
            state: columns.state,
        }
    }

    /// The index of a column among the numbers of a batch.
    pub(crate) fn place(self, column: Column) -> Option<usize> {
        self.plan.selection.number(column)
    }

    /// The index of a column among the texts of a batch.
    pub(crate) fn label(self, column: Column) -> Option<usize> {
        self.plan.selection.label(column)
    }

    /// The index of an output, if this interaction gives it.
    pub(crate) fn slot(self, output: Output) -> Option<usize> {
        let is_given = self.of.outputs.contains(&output);
        numbers(self.plan).position(|planned| planned == output).filter(|_| is_given)
    }

    /// The indices of the slopes of a law, and their variables.
    pub(crate) fn slopes(self, along: impl Fn(Output) -> Option<Along>) -> Vec<(usize, Along)> {
        self.of.outputs.iter().filter_map(|output| Some((self.slot(*output)?, along(*output)?))).collect()
    }

    /// A source in terms of indices.
    pub(crate) fn source(self, source: Option<Source<Column>>) -> Option<Source<usize>> {
        // The plan reads every column it names.
        source.map(|source| source.map(|column| self.place(column).unwrap_or_default()))
    }
}
