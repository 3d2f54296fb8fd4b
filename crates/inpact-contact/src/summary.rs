//! Summary of a pair: counts and sources of its quantities.

use crate::state::Source;
use inpact_evaluation::law::ContactState;
use inpact_evaluation::nodes::Column;
use inpact_geometry::Shares;
use inpact_parser::mesh::{Mesh, MeshPair, Sliding, SurfaceKind};
use inpact_parser::model::Name;
use std::fmt;

/// The source of a number of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Origin<'a> {
    /// The mesh of the deck.
    Mesh,
    /// The mesh, moved by displacements.
    Moved(&'a Source),
    /// A value given by a source.
    Said(&'a Source),
}

/// Sources of the areas of slave nodes.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum AreaSource {
    /// The faces of the slave, shared among their nodes.
    Faces(Shares),
    /// A surface of nodes: this many of them have an area from *SURFACE, the others this one, from the first row of the interaction.
    Nodes {
        /// The number with an own area.
        given: usize,
        /// The number with the area of the interaction.
        of_interaction: usize,
        /// That of the interaction (L²).
        area: f64,
    },
}

/// Summary of a pair; rows are counted over all states, the area is that of the first.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSummary {
    /// The slave surface.
    pub slave: Name,
    /// The master surface.
    pub master: Name,
    /// The interaction.
    pub interaction: Name,
    /// The number of its slave nodes.
    pub nodes: usize,
    /// The sum of their areas (L²).
    pub area: f64,
    /// Rows in contact: with a clearance of 0 or less, or a pressure.
    pub closed: u64,
    /// Rows with a clearance above 0 and no pressure.
    pub open: u64,
    /// Rows without a clearance, since they have no opposite master face.
    pub without_master: u64,
    /// The source of areas.
    pub area_source: AreaSource,
    /// The source of clearances, for users.
    pub clearance_source: String,
}

/// Summary of a column of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnSummary {
    /// The column.
    pub column: Column,
    /// The number of rows so far in which it is empty.
    pub empty: u64,
    /// The sources of its numbers, and the number of each.
    origins: Vec<(Place, u64)>,
}

/// The source of a number, to be kept.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Place {
    Mesh,
    Moved(Source),
    Said(Source),
}

impl Place {
    fn is(&self, origin: Origin<'_>) -> bool {
        match (self, origin) {
            (Self::Mesh, Origin::Mesh) => true,
            (Self::Moved(source), Origin::Moved(other)) | (Self::Said(source), Origin::Said(other)) => source == other,
            _ => false,
        }
    }

    fn of(origin: Origin<'_>) -> Self {
        match origin {
            Origin::Mesh => Self::Mesh,
            Origin::Moved(source) => Self::Moved(source.clone()),
            Origin::Said(source) => Self::Said(source.clone()),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mesh => formatter.write_str("mesh"),
            Self::Moved(source) => write!(formatter, "mesh moved by {source}"),
            Self::Said(source) => source.fmt(formatter),
        }
    }
}

impl ColumnSummary {
    pub(crate) fn new(column: Column) -> Self {
        Self { column, empty: 0, origins: Vec::new() }
    }

    /// The sources of its numbers, for users; `None` where all are from the mesh, for which [`PairSummary`] gives them.
    pub fn source(&self) -> Option<String> {
        match self.origins.as_slice() {
            [] | [(Place::Mesh, _)] => None,
            [(place, _)] => Some(place.to_string()),
            several => {
                let counted = several.iter().map(|(place, rows)| format!("{place} in {rows}"));
                Some(counted.collect::<Vec<_>>().join(", ") + " rows")
            }
        }
    }

    pub(crate) fn count(&mut self, found: Option<(f64, Option<Origin<'_>>)>) {
        let Some((_, origin)) = found else {
            self.empty += 1;
            return;
        };
        let Some(origin) = origin else { return };
        match self.origins.iter_mut().find(|(place, _)| place.is(origin)) {
            Some((_, rows)) => *rows += 1,
            None => self.origins.push((Place::of(origin), 1)),
        }
    }
}

impl PairSummary {
    pub(crate) fn of(mesh: &Mesh, pair: &MeshPair, interaction: &Name, thickness: f64) -> Self {
        let area_source = match &mesh.surfaces[pair.slave].kind {
            SurfaceKind::Faces(_) => AreaSource::Faces(pair.shares),
            SurfaceKind::Nodes(nodes) => {
                let given = nodes.areas.iter().flatten().count();
                AreaSource::Nodes { given, of_interaction: nodes.areas.len() - given, area: thickness }
            }
        };
        Self {
            slave: mesh.surfaces[pair.slave].name.clone(),
            master: mesh.surfaces[pair.master].name.clone(),
            interaction: interaction.clone(),
            nodes: 0,
            area: 0.0,
            closed: 0,
            open: 0,
            without_master: 0,
            area_source,
            clearance_source: clearance_source(pair),
        }
    }

    /// Counts a row.
    pub(crate) fn count(&mut self, clearance: Option<f64>, pressure: Option<f64>) {
        match ContactState::of(None, clearance, pressure) {
            Some(ContactState::Closed) => self.closed += 1,
            Some(ContactState::Open) => self.open += 1,
            Some(ContactState::Undetermined) | None => self.without_master += 1,
        }
    }
}

fn clearance_source(pair: &MeshPair) -> String {
    let mut source = match (pair.clearance, pair.adjust) {
        (Some(value), _) => format!("{value:?} of *CLEARANCE"),
        (None, Some(within)) => format!("distance along the master's normal, 0 up to {within:?} (ADJUST)"),
        (None, None) => "distance along the master's normal".to_owned(),
    };
    if pair.sliding == Sliding::Small {
        source += ", small sliding";
    }
    source
}

impl fmt::Display for AreaSource {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Faces(Shares::Equal) => formatter.write_str("equal shares, node to surface"),
            Self::Faces(Shares::ShapeFunctions) => formatter.write_str("by shape functions, surface to surface"),
            Self::Nodes { given, of_interaction, area } => {
                write!(formatter, "{given} of *SURFACE, {of_interaction} with {area:?} of the interaction")
            }
        }
    }
}
