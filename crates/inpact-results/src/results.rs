//! The common form of result files: frames of fields, each a set of columns over the same rows.
//!
//! Values are those of the file, in its units and order; nothing is interpolated, merged or sorted.
//! Columns have the identifiers of Abaqus where the quantity has one, whichever program wrote it: `U1`, `NT11`, `COPEN`, `CPRESS`.

use crate::format::Format;
use std::sync::Arc;

/// A name that frames and fields share.
pub type Name = Arc<str>;

/// Content of a result file.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// The format of the file.
    pub format: Format,
    /// The initial coordinates of nodes (L), where the file has them: field `COORD`, columns `COOR1` to `COOR3`.
    ///
    /// They map labels to nodes of the deck where the solver renumbers nodes: a `.fil` renumbers the nodes
    /// of all instances.
    pub coordinates: Option<Field>,
    /// Surfaces and their faces, where the file has them (`.fil`).
    pub surfaces: Vec<Surface>,
    /// The increments, in the order of the file.
    pub frames: Vec<Frame>,
    /// The skipped parts, by the file's own name for them, in the order of first occurrence.
    pub not_read: Vec<NotRead>,
}

impl Results {
    pub(crate) fn new(format: Format) -> Self {
        Self { format, coordinates: None, surfaces: Vec::new(), frames: Vec::new(), not_read: Vec::new() }
    }
}

/// One state of the model: an increment, a mode or a row of a history.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// The step, counted from 1.
    pub step: Option<i64>,
    /// The name of the step.
    pub step_name: Option<Name>,
    /// The increment within its step.
    pub increment: Option<i64>,
    /// The time from the beginning of the analysis (T).
    pub total_time: Option<f64>,
    /// The time from the beginning of the step (T).
    pub step_time: Option<f64>,
    /// The fields of this state.
    pub fields: Vec<Field>,
}

impl Frame {
    /// The first field that has a column of this name, and that column, without regard to case.
    ///
    /// A frame has several where several pairs, sets or parts were requested: see [`Frame::columns`].
    pub fn column(&self, name: &str) -> Option<(&Field, &Column)> {
        self.fields.iter().find_map(|field| field.column(name).map(|column| (field, column)))
    }

    /// All columns of this name with their fields, without regard to case.
    pub fn columns<'a>(&'a self, name: &'a str) -> impl Iterator<Item = (&'a Field, &'a Column)> {
        self.fields.iter().filter_map(move |field| field.column(name).map(|column| (field, column)))
    }
}

/// A quantity: its rows and, for each of its components, one value per row.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The identifier of the quantity, such as `U`, `CDISP` or `CPRESS`.
    pub name: Name,
    /// The part of the model it was written for.
    pub region: Region,
    /// The subjects of its rows.
    pub rows: Rows,
    /// The components; each has as many values as there are rows.
    pub columns: Vec<Column>,
}

impl Field {
    /// The column of this name, without regard to case.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name.eq_ignore_ascii_case(name))
    }
}

/// One component of a field.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The identifier of the component, such as `U1`, `COPEN` or `CPRESS`.
    pub name: Name,
    /// One value per row; NaN where the file has none.
    pub values: Vec<f64>,
}

/// The region of a field.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Region {
    /// The slave (secondary) surface of a contact pair.
    pub slave: Option<Name>,
    /// Its master (main) surface.
    pub master: Option<Name>,
    /// A set, a part or an instance.
    pub set: Option<Name>,
}

/// Subjects of the rows of a field, by the labels of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rows {
    /// Nodes.
    Nodes(Vec<i64>),
    /// Points on faces of elements, several a face: contact integration points.
    FacePoints {
        /// The elements.
        elements: Vec<i64>,
        /// Their faces: 1 is S1.
        faces: Vec<i64>,
    },
    /// Elements, or cells of a picture.
    Elements(Vec<i64>),
    /// The region as a whole: one row.
    Whole,
}

impl Rows {
    /// The number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Nodes(labels) | Self::Elements(labels) | Self::FacePoints { elements: labels, .. } => labels.len(),
            Self::Whole => 1,
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The labels, where the rows are nodes.
    pub fn nodes(&self) -> Option<&[i64]> {
        match self {
            Self::Nodes(labels) => Some(labels),
            _ => None,
        }
    }
}

/// A surface by its faces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Surface {
    /// Its name.
    pub name: Name,
    /// Its faces.
    pub faces: Vec<SurfaceFace>,
}

/// A face of a surface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SurfaceFace {
    /// The element it is a face of.
    pub element: i64,
    /// The face: 1 to 6 are S1 to S6, 7 is SPOS, 8 is SNEG.
    pub face: i64,
    /// Its nodes.
    pub nodes: Vec<i64>,
}

/// A part of the file that was skipped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotRead {
    /// The file's own name for it.
    pub what: String,
    /// The number of them.
    pub count: u64,
}
