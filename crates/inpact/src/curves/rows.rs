//! The rows of a law's tables, as in the deck.

use super::{LawKind, Side, range};
use inpact_parser::model::{Interaction, Model, Table, TableKind};
use inpact_parser::span::Span;
use std::borrow::Cow;
use std::ops::Range;

/// The rows of one table: the value, then the abscissa, then the other variables.
#[derive(Debug, Clone)]
pub(super) struct Rows<'a> {
    pub(super) columns: Vec<String>,
    pub(super) cells: Cow<'a, [f64]>,
    /// The span of each row, as far as it is known.
    pub(super) spans: Vec<Span>,
}

/// The tables of one law, one per side of contact.
#[derive(Debug, Clone, Default)]
pub(super) struct LawRows<'a> {
    pub(super) open: Option<Rows<'a>>,
    pub(super) closed: Option<Rows<'a>>,
}

impl<'a> LawRows<'a> {
    /// The tables of a law; of two of the same kind the later one is in force.
    pub(super) fn of(model: &'a Model, interaction: &'a Interaction, kind: LawKind) -> Self {
        let tables = interaction.tables();
        let last = |wanted: TableKind| tables.iter().rfind(|of| of.kind == wanted).map(|of| Rows::of_table(of.table));
        match kind {
            LawKind::Electrical => {
                Self { open: last(TableKind::ElectricalClearance), closed: last(TableKind::ElectricalPressure) }
            }
            LawKind::Thermal => {
                Self { open: last(TableKind::ThermalClearance), closed: last(TableKind::ThermalPressure) }
            }
            LawKind::Permeability => Self { open: None, closed: last(TableKind::Permeability) },
            LawKind::ViewFactor => Self { open: view_factors(model, interaction), closed: None },
        }
    }

    pub(super) fn side(&self, side: Side) -> Option<&Rows<'a>> {
        match side {
            Side::Open => self.open.as_ref(),
            Side::Closed => self.closed.as_ref(),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.open.is_none() && self.closed.is_none()
    }

    /// The names of the variables after the abscissa: those of the table with more of them, which share a prefix.
    pub(super) fn variables(&self) -> &[String] {
        let of = |rows: &'_ Option<Rows<'a>>| rows.as_ref().map_or(0, |rows| rows.columns.len());
        let longer = if of(&self.open) < of(&self.closed) { &self.closed } else { &self.open };
        longer.as_ref().and_then(|rows| rows.columns.get(2..)).unwrap_or(&[])
    }

    /// The distinct values of a variable in both tables, ascending, without NaN.
    ///
    /// A table with one value of it is constant along it: that value is used only where the other has no more either.
    pub(super) fn distinct(&self, variable: &str) -> Vec<f64> {
        let of_tables =
            [&self.open, &self.closed].map(|rows| rows.as_ref().map_or_else(Vec::new, |rows| rows.distinct(variable)));
        let depends = of_tables.iter().any(|values| 1 < values.len());
        let mut values: Vec<f64> =
            of_tables.into_iter().filter(|values| !depends || 1 < values.len()).flatten().collect();
        sort_and_dedup(&mut values);
        if !depends {
            values.truncate(1);
        }
        values
    }
}

/// The rows of *GAP RADIATION after the emissivities (2.6).
fn view_factors<'a>(model: &Model, interaction: &'a Interaction) -> Option<Rows<'a>> {
    let rows = interaction.gap_radiation()?.rows(&model.parameters);
    let cells = rows.map_or_else(Vec::new, |(_, rows)| rows.concat());
    let columns = ["view_factor", "clearance"].map(str::to_owned).to_vec();
    Some(Rows { columns, cells: cells.into(), spans: Vec::new() })
}

impl<'a> Rows<'a> {
    fn of_table(table: &'a Table) -> Self {
        Self { columns: table.columns.to_vec(), cells: (&*table.values).into(), spans: table.row_spans().collect() }
    }

    pub(super) fn width(&self) -> usize {
        self.columns.len().max(1)
    }

    pub(super) fn count(&self) -> usize {
        self.cells.len() / self.width()
    }

    pub(super) fn row(&self, index: usize) -> &[f64] {
        &self.cells[index * self.width()..(index + 1) * self.width()]
    }

    /// For each variable after the abscissa whether the rows have more than one value of it.
    pub(super) fn depends(&self) -> Vec<bool> {
        let varies = |column: usize| {
            let mut values = (0..self.count()).map(|row| self.row(row)[column]);
            let first = values.next();
            values.any(|value| Some(value) != first)
        };
        (2..self.columns.len()).map(varies).collect()
    }

    fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == name)
    }

    /// The distinct values of a column, ascending.
    fn distinct(&self, name: &str) -> Vec<f64> {
        let Some(column) = self.column(name) else { return Vec::new() };
        let mut values = Vec::new();
        for row in 0..self.count() {
            let value = self.row(row)[column];
            // Most rows have the value of the previous row.
            if values.last() != Some(&value) {
                values.push(value);
            }
        }
        sort_and_dedup(&mut values);
        values
    }

    /// The smallest and the largest finite abscissa.
    pub(super) fn range(&self) -> Option<(f64, f64)> {
        let abscissae = (0..self.count()).filter_map(|row| self.row(row).get(1)).filter(|x| x.is_finite());
        range(abscissae.copied())
    }

    /// The ranges of rows that agree in all variables after the abscissa.
    pub(super) fn groups(&self) -> Vec<Range<usize>> {
        let outer = |row: usize| self.row(row).get(2..).unwrap_or(&[]);
        let mut groups: Vec<Range<usize>> = Vec::new();
        for row in 0..self.count() {
            match groups.last_mut() {
                Some(group) if outer(group.start) == outer(row) => group.end = row + 1,
                _ => groups.push(row..row + 1),
            }
        }
        groups
    }
}

fn sort_and_dedup(values: &mut Vec<f64>) {
    values.retain(|value| !value.is_nan());
    values.sort_unstable_by(f64::total_cmp);
    values.dedup();
}
