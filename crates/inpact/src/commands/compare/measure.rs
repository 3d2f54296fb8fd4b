//! Differences between the two values of each quantity.

use crate::commands::evaluable::Evaluable;
use inpact_evaluation::results::Output;

/// A quantity: one value per row on both sides, `None` where it is unknown.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Quantity {
    pub(super) name: String,
    /// Its unit by dimension; `1` for a pure number.
    pub(super) dimension: &'static str,
    /// The solver's source.
    pub(super) source: String,
    pub(super) rows_of: RowsOf,
    pub(super) ours: Vec<Option<f64>>,
    pub(super) solvers: Vec<Option<f64>>,
}

/// The subjects of the rows of a quantity in each state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RowsOf {
    /// Each slave node.
    Nodes,
    /// Each pair.
    Pairs,
}

impl RowsOf {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Nodes => "node",
            Self::Pairs => "pair",
        }
    }
}

/// The index of the largest difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Largest {
    pub(super) row: usize,
    /// |ours − solver's|.
    pub(super) difference: f64,
    /// The same relative to the solver's largest value; infinite where that is 0.
    pub(super) relative: f64,
}

/// The name and the time of each row.
pub(super) type NamesAndTimes = (Vec<String>, Vec<Option<f64>>);

/// All quantities, and the names of rows.
#[derive(Debug)]
pub(super) struct Comparison {
    /// The source of the rows.
    pub(super) made_of: String,
    pub(super) quantities: Vec<Quantity>,
    pub(super) tolerance: Option<f64>,
    /// The names of the rows of nodes, and their times; then those of pairs.
    of_nodes: NamesAndTimes,
    of_pairs: NamesAndTimes,
}

impl Quantity {
    /// A quantity of nodes.
    pub(super) fn new(name: String, dimension: &'static str, source: String) -> Self {
        Self { name, dimension, source, rows_of: RowsOf::Nodes, ours: Vec::new(), solvers: Vec::new() }
    }

    /// An output of the interface.
    pub(super) fn of_output(output: Output) -> Self {
        Self::new(output.to_string(), output.page().map_or("", |page| page.unit), String::new())
    }

    fn both(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        let rows = self.ours.iter().zip(&self.solvers).enumerate();
        rows.filter_map(|(row, (ours, solvers))| Some((row, (*ours)?, (*solvers)?)))
    }

    /// The number of rows with both values.
    pub(super) fn compared(&self) -> usize {
        self.both().count()
    }

    /// The number of rows with only the solver's value.
    pub(super) fn not_computed(&self) -> usize {
        self.ours.iter().zip(&self.solvers).filter(|(ours, solvers)| ours.is_none() && solvers.is_some()).count()
    }

    /// The largest difference; NaN counts as the largest of all. `None` where nothing is compared.
    pub(super) fn largest(&self) -> Option<Largest> {
        let scale = self.both().map(|(_, _, solvers)| solvers.abs()).fold(0.0, f64::max);
        let difference = |ours: f64, solvers: f64| if ours == solvers { 0.0 } else { (ours - solvers).abs() };
        let rank = |difference: f64| if difference.is_nan() { f64::INFINITY } else { difference };
        let differences = self.both().map(|(row, ours, solvers)| (row, difference(ours, solvers)));
        // The first of equals.
        let (row, difference) =
            differences.reduce(|most, other| if rank(most.1) < rank(other.1) { other } else { most })?;
        let relative = match difference {
            0.0 => 0.0,
            difference => difference / scale,
        };
        Some(Largest { row, difference, relative })
    }
}

impl Comparison {
    pub(super) fn new(
        quantities: Vec<Quantity>,
        prepared: &Evaluable,
        of_pairs: NamesAndTimes,
        tolerance: Option<f64>,
    ) -> Self {
        let of_nodes = prepared.made.as_ref().map(|made| made.drawn.names_and_times()).unwrap_or_default();
        Self { made_of: prepared.nodes_name.clone(), quantities, tolerance, of_nodes, of_pairs }
    }

    /// The number of rows of nodes.
    pub(super) fn rows(&self) -> usize {
        self.of_nodes.0.len()
    }

    pub(super) fn name(&self, quantity: &Quantity, row: usize) -> (&str, Option<f64>) {
        let (names, times) = match quantity.rows_of {
            RowsOf::Nodes => &self.of_nodes,
            RowsOf::Pairs => &self.of_pairs,
        };
        (&names[row], times[row])
    }

    /// Whether a quantity exceeds the tolerance.
    pub(super) fn is_beyond(&self) -> bool {
        self.quantities.iter().any(|quantity| self.is_quantity_beyond(quantity))
    }

    pub(super) fn is_quantity_beyond(&self, quantity: &Quantity) -> bool {
        let within = |largest: &Largest| self.tolerance.is_none_or(|tolerance| largest.relative <= tolerance);
        quantity.largest().is_some_and(|largest| !within(&largest))
    }
}
