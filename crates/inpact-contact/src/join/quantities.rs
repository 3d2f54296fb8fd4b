//! Maps columns of result files to the quantities of node tables.

use crate::state::{ContactQuantity, NodeQuantity};
use inpact_evaluation::results::Output;
use inpact_results::Format;
use std::sync::Arc;

/// Quantities of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// A component of the displacement, from 0.
    Displacement(usize),
    /// A quantity of the nodes of either side.
    Node(NodeQuantity, &'static str),
    /// A quantity of slave nodes.
    Contact(ContactQuantity, &'static str),
    /// A component of the frictional shear stress, from 0.
    Shear(usize),
    /// A component of the accumulated slip, from 0.
    Slip(usize),
    /// A component of the flux of heat in a body, from 0.
    HeatFlux(usize),
    /// An output that is computed here too.
    Output(Output),
}

impl Quantity {
    /// Whether it belongs to slave nodes only.
    pub(super) fn is_of_contact(self) -> bool {
        !matches!(self, Self::Displacement(_) | Self::HeatFlux(_) | Self::Node(..))
    }

    /// The name in the file.
    pub(super) fn name(self) -> Arc<str> {
        match self {
            Self::Displacement(_) => "U".into(),
            Self::Node(NodeQuantity::FieldVariable(number), _) => format!("FV{number}").into(),
            Self::Node(_, name) | Self::Contact(_, name) => name.into(),
            Self::Shear(_) => "CSHEAR".into(),
            Self::Slip(_) => "CSLIP".into(),
            Self::HeatFlux(_) => "HFL".into(),
            Self::Output(output) => output.to_string().into(),
        }
    }
}

/// The quantity of a column of a result file; `None` without a counterpart in a node table.
pub(super) fn of_column(name: &str, format: Format) -> Option<Quantity> {
    let name = name.to_ascii_uppercase();
    let known = match name.as_str() {
        "U1" => Quantity::Displacement(0),
        "U2" => Quantity::Displacement(1),
        "U3" => Quantity::Displacement(2),
        "HFL1" => Quantity::HeatFlux(0),
        "HFL2" => Quantity::HeatFlux(1),
        "HFL3" => Quantity::HeatFlux(2),
        // Shells have several; the first is that of the reference surface.
        "NT11" | "NT" => Quantity::Node(NodeQuantity::Temperature, "NT11"),
        "EPOT" => Quantity::Node(NodeQuantity::Potential, "EPOT"),
        "POR" => Quantity::Node(NodeQuantity::PorePressure, "POR"),
        "COPEN" => Quantity::Contact(ContactQuantity::Clearance, "COPEN"),
        "CPRESS" => Quantity::Contact(ContactQuantity::Pressure, "CPRESS"),
        "CNAREA" => Quantity::Contact(ContactQuantity::Area, "CNAREA"),
        "CSHEAR1" => Quantity::Shear(0),
        "CSHEAR2" => Quantity::Shear(1),
        // The slip of CalculiX is the elastic stick displacement; a deck for it gives the speed itself (K-38).
        "CSLIP1" if !is_of_calculix(format) => Quantity::Slip(0),
        "CSLIP2" if !is_of_calculix(format) => Quantity::Slip(1),
        _ => return field_variable(&name).or_else(|| output(&name)),
    };
    Some(known)
}

/// Whether CalculiX wrote the file.
pub(super) fn is_of_calculix(format: Format) -> bool {
    matches!(format, Format::Frd | Format::Dat)
}

fn field_variable(name: &str) -> Option<Quantity> {
    let number = name.strip_prefix("FV")?.parse().ok().filter(|number| *number != 0)?;
    Some(Quantity::Node(NodeQuantity::FieldVariable(number), "FV"))
}

/// An output of Abaqus; our own are in lower case.
fn output(name: &str) -> Option<Quantity> {
    Output::NAMED.iter().copied().find(|output| output.to_string() == name).map(Quantity::Output)
}
