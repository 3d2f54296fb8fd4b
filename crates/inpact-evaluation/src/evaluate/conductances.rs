//! The conductances of a batch: its rows are gathered by the table that they read, each table is evaluated over columns, and the values go back to their rows.

use super::{InteractionTally, Row};
use crate::compile::CompiledTables;
use crate::evaluator::{SeenError, TableValues};
use crate::law::conductance::{Branch, Conductance};
use crate::law::contact::ContactState;
use crate::numbers::mean;
use crate::results::Along;
use crate::table::Sides;

/// The conductances of the rows of a batch.
#[derive(Debug, Default)]
pub(super) struct Conductances {
    of_rows: Vec<Option<RowConductance>>,
    /// For each interaction the rows that read its table against clearance, and those that read the one against pressure.
    gathered: Vec<[Gathered; 2]>,
    /// The interactions of which rows were gathered; one may stand twice.
    met: Vec<usize>,
    found: TableValues,
}

/// The conductance of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RowConductance {
    pub(super) conductance: Conductance,
    /// What rounding took away from its value, where that is known.
    pub(super) rest: f64,
}

/// The rows of a batch that read one table, and their coordinates.
#[derive(Debug, Default)]
struct Gathered {
    rows: Vec<usize>,
    /// One column an axis of the table; empty where it is not read.
    columns: Vec<Vec<f64>>,
}

impl Conductances {
    /// Begins a batch of so many rows.
    pub(super) fn begin(&mut self, rows: usize, interactions: usize) {
        self.of_rows.clear();
        self.of_rows.resize(rows, None);
        self.gathered.resize_with(interactions, Default::default);
        self.met.clear();
    }

    /// Takes a row of an interaction; one that lacks a number which its table needs gets no conductance.
    #[inline]
    pub(super) fn take(&mut self, interaction: usize, law: &CompiledTables, row: Row<'_>) {
        let Some((against, needs)) = law.needs(row.state) else {
            // Open with a table against pressure alone: no table holds, nothing is conducted (section 4.2).
            let value = if row.state == ContactState::Undetermined { f64::NAN } else { 0.0 };
            let conductance = Conductance { value, branch: Branch::Neither, sides: Sides::default() };
            self.of_rows[row.index] = Some(RowConductance { conductance, rest: 0.0 });
            return;
        };
        let abscissa = match against {
            Along::Pressure => row.pressure,
            _ => row.state.table_clearance(row.clearance),
        };
        if needs.abscissa && abscissa.is_none() {
            return;
        }
        let gathered = &mut self.gathered[interaction][usize::from(against == Along::Pressure)];
        if gathered.rows.is_empty() {
            gathered.columns.resize_with(law.variables.len() + 1, Vec::new);
            self.met.push(interaction);
        }
        for variable in &needs.variables {
            let source = law.variables[*variable].as_ref();
            let Some(value) = source.and_then(|source| row.fetch(source, mean)) else {
                gathered.even_out();
                return;
            };
            gathered.columns[variable + 1].push(value);
        }
        if needs.abscissa {
            gathered.columns[0].extend(abscissa);
        }
        gathered.rows.push(row.index);
    }

    /// Evaluates the tables of all interactions for the rows taken, and compares some of the values with the reference.
    pub(super) fn finish<'a>(
        &mut self,
        law_of: impl Fn(usize) -> Option<&'a CompiledTables>,
        tallies: &mut [InteractionTally],
    ) {
        for interaction in std::mem::take(&mut self.met) {
            if let Some(law) = law_of(interaction) {
                self.evaluate(interaction, law, &mut tallies[interaction].seen_error);
            }
        }
    }

    fn evaluate(&mut self, interaction: usize, law: &CompiledTables, seen: &mut SeenError) {
        let tables = [(Branch::Clearance, &law.clearance_form), (Branch::Pressure, &law.pressure_form)];
        for (gathered, (branch, form)) in self.gathered[interaction].iter_mut().zip(tables) {
            let Some(form) = form.as_ref().filter(|_| !gathered.rows.is_empty()) else { continue };
            let columns: Vec<&[f64]> = gathered.columns.iter().map(Vec::as_slice).collect();
            form.evaluate(&columns, gathered.rows.len(), &mut self.found);
            form.compare(&columns, &self.found.values, seen);
            for (place, row) in gathered.rows.iter().enumerate() {
                let (value, sides) = (self.found.values[place], self.found.sides[place]);
                let rest = self.found.rests.get(place).copied().unwrap_or(0.0);
                self.of_rows[*row] = Some(RowConductance { conductance: Conductance { value, branch, sides }, rest });
            }
            gathered.rows.clear();
            gathered.columns.iter_mut().for_each(Vec::clear);
        }
    }

    /// The conductance of a row; `None` where it lacks a number.
    #[inline]
    pub(super) fn of_row(&self, row: usize) -> Option<RowConductance> {
        self.of_rows[row]
    }
}

impl Gathered {
    /// Takes back the coordinates of a row that turned out to lack one.
    fn even_out(&mut self) {
        let rows = self.rows.len();
        self.columns.iter_mut().for_each(|column| column.truncate(rows));
    }
}
