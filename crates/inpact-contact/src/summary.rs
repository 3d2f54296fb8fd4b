//! What was made of a pair: counts, and where its quantities come from.

use crate::state::State;
use inpact_evaluation::nodes::Column;
use inpact_geometry::Shares;
use inpact_parser::mesh::{InitialQuantity, Mesh, MeshPair, Sliding, SurfaceKind};
use inpact_parser::model::Name;
use std::fmt;

/// Where the areas of slave nodes come from.
#[derive(Debug, Clone, PartialEq)]
pub enum AreaSource {
    /// The faces of the slave, shared among their nodes.
    Faces(Shares),
    /// A surface of nodes: so many of them have an area of *SURFACE, the others this one, from the first row of the interaction.
    Nodes {
        /// How many have their own.
        given: usize,
        /// How many have the interaction's.
        of_interaction: usize,
        /// That of the interaction (L²).
        area: f64,
    },
}

/// What was made of a pair; rows are counted over all states, the area is that of the first.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSummary {
    /// The slave surface.
    pub slave: Name,
    /// The master surface.
    pub master: Name,
    /// The interaction.
    pub interaction: Name,
    /// How many slave nodes it has.
    pub nodes: usize,
    /// The sum of their areas (L²).
    pub area: f64,
    /// Rows with a clearance of 0 or less.
    pub closed: u64,
    /// Rows with a clearance above 0.
    pub open: u64,
    /// Rows of slave nodes that have no master face across.
    pub without_master: u64,
    /// Where areas come from.
    pub area_source: AreaSource,
    /// Where clearances come from, for a person.
    pub clearance_source: String,
}

/// What is to be said of a column of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnSummary {
    /// The column.
    pub column: Column,
    /// Where its numbers come from, for a person; `None` for the geometry, of which [`PairSummary`] says it.
    pub source: Option<String>,
    /// In how many rows so far it is empty.
    pub empty: u64,
}

impl ColumnSummary {
    pub(crate) fn of(column: Column, states: &[State]) -> Self {
        let quantity = match column {
            Column::Temperature(_) => Some(InitialQuantity::Temperature),
            Column::PorePressure(_) => Some(InitialQuantity::PorePressure),
            Column::FieldVariable(number, _) => Some(InitialQuantity::FieldVariable(number)),
            _ => None,
        };
        let of_field =
            |state: &State| quantity.and_then(|quantity| state.field(quantity)).map(|field| field.source.clone());
        let of_pressure = |state: &State| state.pressure.as_ref().map(|pressure| pressure.source.clone());
        let mut sources: Vec<String> = match column {
            Column::Pressure => states.iter().filter_map(of_pressure).collect(),
            _ => states.iter().filter_map(of_field).collect(),
        };
        sources.dedup();
        Self { column, source: (!sources.is_empty()).then(|| sources.join(", then ")), empty: 0 }
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
