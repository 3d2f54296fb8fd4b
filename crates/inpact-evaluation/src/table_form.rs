//! A table in the form in which it is evaluated: the accuracy that was asked for, over columns.
//!
//! What a law's tables mean stands in [`crate::table`]; how exactly and how fast their values are found is chosen here, once, when the laws are compiled.

use crate::accuracy::Accuracy;
use crate::numbers::Scaled;
use crate::table::{PiecewiseTable, Sides};

/// A table ready for columns of coordinates.
#[derive(Clone, Debug)]
pub struct TableForm {
    table: PiecewiseTable,
    means: Means,
}

/// How the values are found.
#[derive(Clone, Debug)]
enum Means {
    Full,
    Reference,
}

/// The value of a table at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundValue {
    /// The value, rounded.
    pub value: f64,
    /// What rounding took away, where the form knows it.
    pub rest: Option<f64>,
    /// Where the point lies outside the table.
    pub sides: Sides,
}

/// The values of a table in some rows.
#[derive(Clone, Debug, Default)]
pub struct TableValues {
    /// The values, rounded.
    pub values: Vec<f64>,
    /// What rounding took away; empty unless the form knows it.
    pub rests: Vec<f64>,
    /// Where each row lies outside the table.
    pub sides: Vec<Sides>,
}

impl TableForm {
    /// The table in a form of this accuracy.
    pub fn new(table: PiecewiseTable, accuracy: Accuracy) -> Self {
        let means = match accuracy {
            Accuracy::Reference => Means::Reference,
            Accuracy::Full | Accuracy::Fast => Means::Full,
        };
        Self { table, means }
    }

    /// The table itself.
    pub fn table(&self) -> &PiecewiseTable {
        &self.table
    }

    /// The values at some points, one column of coordinates for each axis; a column that the table does not depend on may be empty.
    pub fn evaluate(&self, columns: &[&[f64]], rows: usize, found: &mut TableValues) {
        found.values.clear();
        found.rests.clear();
        found.sides.clear();
        let mut others = vec![f64::NAN; columns.len().saturating_sub(1)];
        for row in 0..rows {
            let coordinate = |axis: usize| columns[axis].get(row).copied().unwrap_or(f64::NAN);
            let first = if columns.is_empty() { f64::NAN } else { coordinate(0) };
            for (axis, other) in others.iter_mut().enumerate() {
                *other = coordinate(axis + 1);
            }
            let FoundValue { value, rest, sides } = self.value_at(first, &others);
            found.values.push(value);
            found.rests.extend(rest);
            found.sides.push(sides);
        }
    }

    /// The value at one point.
    pub fn value_at(&self, first: f64, others: &[f64]) -> FoundValue {
        let (value, sides) = self.table.value_and_sides_at(first, others);
        match self.means {
            Means::Full => FoundValue { value, rest: None, sides },
            Means::Reference => {
                let (value, rest) = self.table.reference_at(first, others).map_or((f64::NAN, 0.0), Scaled::to_pair);
                FoundValue { value, rest: Some(rest), sides }
            }
        }
    }
}
