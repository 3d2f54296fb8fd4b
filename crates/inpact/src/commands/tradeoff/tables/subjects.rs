//! Subjects of measurement: the tables in force and, as columns, the coordinates of the rows that reach them.

use crate::commands::evaluable::Evaluable;
use crate::failure::Failure;
use inpact_evaluation::evaluate::{Coordinates, TableReads, TabulatedQuantity};
use inpact_evaluation::results::Along;
use inpact_evaluation::table::PiecewiseTable;
use inpact_parser::model::Model;
use std::path::Path;

/// A table with the coordinates of the rows that reach it.
pub(super) struct Subject {
    /// The interaction and what the table is.
    pub(super) name: String,
    /// The table as it is evaluated: folded along the axes on which all rows have one value.
    pub(super) table: PiecewiseTable,
    /// One column an axis; of axes that make no difference the columns are empty.
    pub(super) columns: Vec<Vec<f64>>,
}

/// The rows that are measured on.
pub(super) struct Sample {
    /// The tables that vary and are reached by a row.
    pub(super) subjects: Vec<Subject>,
    /// The number of rows of the node table.
    pub(super) rows: u64,
    /// One of so many was taken.
    pub(super) one_of: u64,
}

impl Subject {
    /// The number of rows that reach it.
    pub(super) fn rows(&self) -> usize {
        self.columns.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// The number of axes that make a difference.
    pub(super) fn axes(&self) -> usize {
        self.columns.iter().filter(|column| !column.is_empty()).count()
    }
}

/// Keeps, of at most `most` rows of the node table, the coordinates that tables in force are read at.
pub(super) fn gather(evaluable: &mut Evaluable, nodes_path: &Path, most: u64) -> Result<Sample, Failure> {
    let Evaluable { model, plan, choices, rows, .. } = evaluable;
    let mut coordinates = Coordinates::new(model, plan, choices);
    let one_of = plan.rows.div_ceil(most).max(1);
    let unreadable = |error| Failure::read(nodes_path, error);
    let mut rows = rows.give_back(&plan.selection).map_err(unreadable)?;
    while let Some(batch) = rows.next_batch().map_err(unreadable)? {
        coordinates.take(&batch, one_of);
    }
    let subjects = coordinates.finish().into_iter().map(|reads| subject(model, reads));
    Ok(Sample { subjects: subjects.collect(), rows: plan.rows, one_of })
}

fn subject(model: &Model, reads: TableReads) -> Subject {
    let interaction = model.interactions.get_index(reads.interaction).map(|(name, _)| name.to_string());
    let against = if reads.against == Along::Pressure { "pressure" } else { "clearance" };
    let what = match reads.quantity {
        TabulatedQuantity::ElectricalConductance => format!("conductance against {against}"),
        TabulatedQuantity::ThermalConductance => format!("thermal conductance against {against}"),
        TabulatedQuantity::Permeability => "permeability".to_owned(),
    };
    let name = format!("{}: {what}", interaction.unwrap_or_default());
    Subject { name, table: reads.table, columns: reads.columns }
}
