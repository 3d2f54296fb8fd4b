//! Values at the nodes of a mesh at one time.

use inpact_evaluation::nodes::{Column, Part};
use inpact_evaluation::results::Output;
use inpact_geometry::{NodeId, Vector};
use inpact_parser::mesh::{InitialQuantity, Mesh};
use std::sync::Arc;

/// Values at the nodes at one time; every column is in the order of [`Mesh::nodes`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct State {
    /// When.
    pub moment: Moment,
    /// The displacements of the nodes since the beginning; `None` where they have not moved, or no source gives them.
    pub displacements: Option<Displacements>,
    /// The contact values of slave nodes.
    pub contact: Vec<ContactField>,
    /// The values of all nodes, each quantity once.
    pub fields: Vec<NodeField>,
    /// Interface outputs of a solver, for comparison with those computed here.
    pub outputs: Vec<OutputField>,
    /// The heat flux inside the bodies, at their nodes.
    pub heat_flux: Option<HeatFlux>,
    /// Values of a pair as a whole, from a solver.
    pub totals: Vec<PairTotal>,
}

/// The heat flux inside the bodies, extrapolated by the solver from integration points to nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatFlux {
    /// One vector per node (M T⁻³); `None` where it is unknown.
    pub vectors: Vec<Option<Vector>>,
    /// Its source.
    pub source: Source,
}

/// A quantity of a pair as a whole.
#[derive(Debug, Clone, PartialEq)]
pub struct PairTotal {
    /// Which.
    pub quantity: TotalQuantity,
    /// The pair, a position in [`Mesh::pairs`].
    pub pair: usize,
    /// Its value.
    pub value: f64,
    /// Its source.
    pub source: Source,
}

/// Quantities of a pair as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TotalQuantity {
    /// The area in contact (L²).
    ContactArea,
    /// All heat into the slave surface in a unit of time (M L² T⁻³).
    HeatIntoSlave,
    /// All heat into the master surface in a unit of time (M L² T⁻³).
    HeatIntoMaster,
}

/// The time of a state.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Moment {
    /// The total time (T); `None` for the initial state, a table without times, and where it is unknown.
    pub time: Option<f64>,
    /// The step, from 1.
    pub step: Option<i64>,
    /// The increment within its step.
    pub increment: Option<i64>,
    /// The time since the step began (T).
    pub step_time: Option<f64>,
}

/// Displacements of the nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Displacements {
    /// One vector per node (L).
    pub vectors: Vec<Vector>,
    /// Their source.
    pub source: Source,
}

/// A quantity of slave nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactField {
    /// Which.
    pub quantity: ContactQuantity,
    /// Its pair, a position in [`Mesh::pairs`]; `None` where it belongs to any pair in which a node is a slave.
    pub pair: Option<usize>,
    /// A value a node; `None` where it is not known.
    pub values: Vec<Option<f64>>,
    /// Its source.
    pub source: Source,
}

/// Quantities of a solver at slave nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum ContactQuantity {
    /// The clearance, open > 0 (L).
    Clearance,
    /// The contact pressure (F L⁻²).
    Pressure,
    /// The area of the node (L²).
    Area,
    /// The frictional shear stress (F L⁻²).
    Shear,
    /// The rate of relative slip (L T⁻¹).
    SlipRate,
}

/// A quantity of the nodes of either side.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeField {
    /// Which.
    pub quantity: NodeQuantity,
    /// A value a node; `None` where it is not known.
    pub values: Vec<Option<f64>>,
    /// Its source.
    pub source: Source,
}

/// Quantities of nodes of both sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum NodeQuantity {
    /// Temperature (θ).
    Temperature,
    /// Electric potential (φ).
    Potential,
    /// Pore pressure (F L⁻²).
    PorePressure,
    /// Field variable, from 1.
    FieldVariable(u32),
}

/// An interface output computed by a solver.
#[derive(Debug, Clone, PartialEq)]
pub struct OutputField {
    /// Which.
    pub output: Output,
    /// Its pair, as in [`ContactField::pair`].
    pub pair: Option<usize>,
    /// A value a node; `None` where it is not known.
    pub values: Vec<Option<f64>>,
    /// Its source.
    pub source: Source,
}

/// Sources of values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Source {
    /// *INITIAL CONDITIONS.
    InitialConditions,
    /// A result file: the name of the quantity there, and that of the file.
    File {
        /// The quantity, such as `COPEN`.
        quantity: Arc<str>,
        /// The file.
        file: Arc<str>,
    },
}

impl Source {
    /// As a word for a table cell: `COPEN`, `initial`.
    pub fn word(&self) -> &str {
        match self {
            Self::InitialConditions => "initial",
            Self::File { quantity, .. } => quantity,
        }
    }
}

impl std::fmt::Display for Source {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::InitialConditions => formatter.write_str("*INITIAL CONDITIONS"),
            Self::File { quantity, file } => write!(formatter, "{quantity} of {file}"),
        }
    }
}

impl ContactQuantity {
    /// All of them, in the order of columns.
    pub const ALL: [Self; 5] = [Self::Clearance, Self::Pressure, Self::Area, Self::Shear, Self::SlipRate];

    /// Its column of node tables.
    pub fn column(self) -> Column {
        match self {
            Self::Clearance => Column::Clearance,
            Self::Pressure => Column::Pressure,
            Self::Area => Column::Area,
            Self::Shear => Column::Shear,
            Self::SlipRate => Column::SlipRate,
        }
    }

    /// The quantity of a column of node tables, if any.
    pub fn of(column: Column) -> Option<Self> {
        Self::ALL.into_iter().find(|quantity| quantity.column() == column)
    }
}

impl NodeQuantity {
    /// Its column of node tables on one side.
    pub fn column(self, part: Part) -> Column {
        match self {
            Self::Temperature => Column::Temperature(part),
            Self::Potential => Column::Potential(part),
            Self::PorePressure => Column::PorePressure(part),
            Self::FieldVariable(number) => Column::FieldVariable(number, part),
        }
    }

    /// The quantity and the side of a column of node tables, if any.
    pub fn of(column: Column) -> Option<(Self, Part)> {
        match column {
            Column::Temperature(part) => Some((Self::Temperature, part)),
            Column::Potential(part) => Some((Self::Potential, part)),
            Column::PorePressure(part) => Some((Self::PorePressure, part)),
            Column::FieldVariable(number, part) => Some((Self::FieldVariable(number), part)),
            _ => None,
        }
    }
}

impl From<InitialQuantity> for NodeQuantity {
    fn from(quantity: InitialQuantity) -> Self {
        match quantity {
            InitialQuantity::Temperature => Self::Temperature,
            InitialQuantity::PorePressure => Self::PorePressure,
            InitialQuantity::FieldVariable(number) => Self::FieldVariable(number),
        }
    }
}

impl State {
    /// The initial state, from *INITIAL CONDITIONS.
    pub fn initial(mesh: &Mesh) -> Self {
        let mut state = Self::default();
        state.complete(mesh);
        state
    }

    /// Adds the quantities without another source from *INITIAL CONDITIONS.
    pub fn complete(&mut self, mesh: &Mesh) {
        for field in &mesh.initial {
            let quantity = field.quantity.into();
            if self.field(quantity).is_none() {
                let (values, source) = (field.values.clone(), Source::InitialConditions);
                self.fields.push(NodeField { quantity, values, source });
            }
        }
        self.fields.sort_by_key(|field| field.quantity);
    }

    /// A quantity of all nodes, where it is known.
    pub fn field(&self, quantity: NodeQuantity) -> Option<&NodeField> {
        self.fields.iter().find(|field| field.quantity == quantity)
    }

    /// A quantity of a slave node of a pair with its source; the first value takes precedence.
    pub fn contact(&self, quantity: ContactQuantity, pair: usize, node: NodeId) -> Option<(f64, &Source)> {
        let fields = self.contact.iter().filter(|field| field.quantity == quantity);
        first_of(fields.map(|field| (field.pair, &field.values, &field.source)), pair, node)
    }

    /// A solver's output at a slave node of a pair, with its source.
    pub fn output(&self, output: Output, pair: usize, node: NodeId) -> Option<(f64, &Source)> {
        let fields = self.outputs.iter().filter(|field| field.output == output);
        first_of(fields.map(|field| (field.pair, &field.values, &field.source)), pair, node)
    }
}

type Said<'a> = (Option<usize>, &'a Vec<Option<f64>>, &'a Source);

/// The first value that is said of the pair, or of the node whatever its pair.
fn first_of<'a>(mut fields: impl Iterator<Item = Said<'a>>, pair: usize, node: NodeId) -> Option<(f64, &'a Source)> {
    fields.find_map(|(of, values, source)| {
        let of_pair = of.is_none_or(|of| of == pair);
        Some((values[node.index()].filter(|_| of_pair)?, source))
    })
}
