//! Fields collected row by row.

use crate::results::{Column, Field, Name, NotRead, Region, Rows};
use std::collections::HashMap;

/// Subjects of rows.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Row {
    Node(i64),
    FacePoint { element: i64, face: i64 },
    Whole,
}

impl Row {
    fn none_yet(self) -> Rows {
        match self {
            Self::Node(_) => Rows::Nodes(Vec::new()),
            Self::FacePoint { .. } => Rows::FacePoints { elements: Vec::new(), faces: Vec::new() },
            Self::Whole => Rows::Whole,
        }
    }
}

/// A field without rows.
pub(crate) fn field<S: Into<Name>>(
    name: impl Into<Name>,
    region: Region,
    kind: Row,
    columns: impl IntoIterator<Item = S>,
) -> Field {
    let columns = columns.into_iter().map(|name| Column { name: name.into(), values: Vec::new() }).collect();
    Field { name: name.into(), region, rows: kind.none_yet(), columns }
}

/// Adds a row, of the kind that the field was made for and with a value for each of its columns.
pub(crate) fn push(field: &mut Field, row: Row, values: &[f64]) {
    match (&mut field.rows, row) {
        (Rows::Nodes(labels), Row::Node(label)) => labels.push(label),
        (Rows::FacePoints { elements, faces }, Row::FacePoint { element, face }) => {
            elements.push(element);
            faces.push(face);
        }
        // One row: what is written again stays what was written first.
        (Rows::Whole, Row::Whole) if field.columns.iter().all(|column| column.values.is_empty()) => (),
        _ => return,
    }
    for (column, value) in field.columns.iter_mut().zip(values) {
        column.values.push(*value);
    }
}

/// Parts skipped, counted by name.
#[derive(Debug, Default)]
pub(crate) struct PassedOver {
    found: Vec<NotRead>,
    places: HashMap<String, usize>,
}

impl PassedOver {
    pub(crate) fn count(&mut self, what: &str) {
        if let Some(at) = self.places.get(what) {
            self.found[*at].count += 1;
            return;
        }
        self.places.insert(what.to_owned(), self.found.len());
        self.found.push(NotRead { what: what.to_owned(), count: 1 });
    }

    pub(crate) fn list(self) -> Vec<NotRead> {
        self.found
    }
}
