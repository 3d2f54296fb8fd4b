//! The points at which the tables of a plan are evaluated: for each table in force, the coordinates of the rows that reach it.
//!
//! They are the points of an evaluation, kept to measure tables on a user's own rows.
//! View factors of radiation and the curves of CalculiX are not included: they are evaluated in one form only.

use super::laws::Laws;
use super::worker::Worker;
use crate::evaluator::Evaluator;
use crate::law::conductance::Branch;
use crate::law::conductance::columns::Gathered;
use crate::nodes::Batch;
use crate::plan::{Choices, Plan};
use crate::results::Along;
use crate::rows::{Part, Tally};
use crate::table::PiecewiseTable;
use inpact_parser::model::Model;

/// A table in force and the points at which it is evaluated.
#[derive(Debug, Clone)]
pub struct TableReads {
    /// The index of its interaction in the model.
    pub interaction: usize,
    /// The quantity it gives.
    pub quantity: TabulatedQuantity,
    /// The first of its variables.
    pub against: Along,
    /// The table as evaluated: folded along the axes on which the scene has one value.
    pub table: PiecewiseTable,
    /// The coordinates, one column per axis; empty for axes that the value does not depend on.
    pub columns: Vec<Vec<f64>>,
}

/// Quantities that tables give.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum TabulatedQuantity {
    /// Electrical conductance, C T⁻¹ L⁻² φ⁻¹.
    ElectricalConductance,
    /// Thermal conductance, M T⁻³ θ⁻¹.
    ThermalConductance,
    /// Permeability of the interface to pore fluid.
    Permeability,
}

/// Collects coordinates.
#[derive(Debug)]
pub struct Coordinates<'a> {
    laws: Laws,
    worker: Worker<'a>,
    reads: Vec<TableReads>,
}

impl<'a> Coordinates<'a> {
    /// Starts without rows, for a plan that was made from this model and these choices.
    pub fn new(model: &'a Model, plan: &Plan, choices: &Choices) -> Self {
        let laws = Laws::of(model, plan, choices);
        let tally = Tally::new(plan, laws.summed_outputs(), model.interactions.len());
        let worker = Worker::new(model, plan, &laws, tally);
        Self { laws, worker, reads: Vec::new() }
    }

    /// Adds one in `one_of` rows: for each table that a row reaches its coordinates, if it has them all.
    pub fn take(&mut self, batch: &Batch, one_of: u64) {
        for part in self.worker.parts(&self.laws, batch) {
            let Some(of) = &self.laws.interactions[part.interaction] else { continue };
            let mut found: Vec<(TabulatedQuantity, Along, &Evaluator, Gathered<'_>)> = Vec::new();
            let electrical = of.electrical.as_ref().and_then(|law| law.tables());
            let thermal = of.thermal.as_ref().and_then(|law| law.tables());
            for (quantity, columns) in [
                (TabulatedQuantity::ElectricalConductance, electrical),
                (TabulatedQuantity::ThermalConductance, thermal),
            ] {
                let Some(columns) = columns else { continue };
                for (branch, gathered) in columns.points(&part) {
                    let against = if branch == Branch::Pressure { Along::Pressure } else { Along::Clearance };
                    found.extend(columns.form(branch).map(|form| (quantity, against, form, gathered)));
                }
            }
            let pore = of.pore.as_ref().and_then(|law| law.points(&part));
            found.extend(
                pore.map(|(form, gathered)| (TabulatedQuantity::Permeability, Along::Pressure, form, gathered)),
            );
            for (quantity, against, form, gathered) in found {
                keep(&mut self.reads, (&part, quantity, against), form.table(), &gathered, |row| {
                    part.place(row).row.is_some_and(|number| (number - 1).is_multiple_of(one_of))
                });
            }
        }
    }

    /// The tables that vary and that a row has reached, in the order of the model.
    pub fn finish(mut self) -> Vec<TableReads> {
        self.reads.sort_by_key(|reads| (reads.interaction, reads.quantity, reads.against == Along::Pressure));
        self.reads
    }
}

/// Keeps the coordinates of the selected rows without NaN.
fn keep(
    reads: &mut Vec<TableReads>,
    (part, quantity, against): (&Part<'_>, TabulatedQuantity, Along),
    table: &PiecewiseTable,
    gathered: &Gathered<'_>,
    is_chosen: impl Fn(usize) -> bool,
) {
    let read: Vec<usize> = (0..gathered.columns.len()).filter(|axis| !gathered.columns[*axis].is_empty()).collect();
    for place in 0..gathered.count {
        let row = gathered.rows.as_ref().map_or(place, |rows| rows[place] as usize);
        let has_nan = || read.iter().any(|axis| gathered.columns[*axis][place].is_nan());
        if read.is_empty() || part.states[row].is_none() || !is_chosen(row) || has_nan() {
            continue;
        }
        let of = (part.interaction, quantity, against);
        let known = reads.iter().position(|reads| (reads.interaction, reads.quantity, reads.against) == of);
        let index = known.unwrap_or_else(|| {
            let columns = vec![Vec::new(); table.axes().len()];
            let interaction = part.interaction;
            reads.push(TableReads { interaction, quantity, against, table: table.clone(), columns });
            reads.len() - 1
        });
        for axis in &read {
            reads[index].columns[*axis].push(gathered.columns[*axis][place]);
        }
    }
}
