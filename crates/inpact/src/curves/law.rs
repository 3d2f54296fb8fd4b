//! The laws that have curves, and their values at a point, as an evaluation of a node row would compute them.

use super::{Reach, Side};
use clap::ValueEnum;
use inpact_evaluation::law::{
    Clearance, Conductance, ConductanceTables, ContactPoint, ContactPressure, ContactState, ElectricalSource, Gap,
    InterfaceLaws, Permeability, PoreLaw, PorePoint, PorePressure, RadiationLaw, ThermalConductance,
};
use inpact_evaluation::table::Sides;
use inpact_parser::model::OptionKind;

/// A law with a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, ValueEnum)]
pub enum LawKind {
    /// Electrical conductance, *GAP ELECTRICAL CONDUCTANCE.
    #[value(help = "Electrical conductance")]
    Electrical,
    /// Thermal conductance, *GAP CONDUCTANCE.
    #[value(help = "Thermal conductance")]
    Thermal,
    /// The view factor of radiation, *GAP RADIATION.
    #[value(help = "The view factor of radiation")]
    ViewFactor,
    /// Permeability to pore fluid, *CONTACT PERMEABILITY.
    #[value(help = "Permeability to pore fluid")]
    Permeability,
}

impl LawKind {
    /// All of them, in the order in which they are drawn.
    pub const ALL: [Self; 4] = [Self::Electrical, Self::Thermal, Self::ViewFactor, Self::Permeability];

    /// The name in a sentence.
    pub fn name(self) -> &'static str {
        match self {
            Self::Electrical => "electrical conductance",
            Self::Thermal => "thermal conductance",
            Self::ViewFactor => "view factor",
            Self::Permeability => "permeability",
        }
    }

    /// The keyword of its rows.
    pub fn keyword(self) -> &'static str {
        match self {
            Self::Electrical => OptionKind::GapElectricalConductance.keyword(),
            Self::Thermal => OptionKind::GapConductance.keyword(),
            Self::ViewFactor => OptionKind::GapRadiation.keyword(),
            Self::Permeability => OptionKind::ContactPermeability.keyword(),
        }
    }
}

/// A law that can be evaluated.
#[derive(Debug, Clone, Copy)]
pub(super) enum Law<'a> {
    Electrical(&'a ConductanceTables),
    Thermal(&'a ThermalConductance),
    ViewFactor(&'a RadiationLaw),
    Permeability(&'a PoreLaw, Option<f64>),
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Value {
    pub(super) y: f64,
    pub(super) reach: Reach,
}

impl<'a> Law<'a> {
    /// The law of that kind; `None` where the interaction has none given by rows of the deck.
    pub(super) fn of(laws: &'a InterfaceLaws, kind: LawKind, characteristic_length: Option<f64>) -> Option<Self> {
        match kind {
            LawKind::Electrical => match laws.electrical.as_ref()? {
                ElectricalSource::Tables(tables) => Some(Self::Electrical(tables)),
                ElectricalSource::User(..) => None,
            },
            LawKind::Thermal => laws.thermal.as_ref().map(Self::Thermal),
            LawKind::ViewFactor => laws.radiation.as_ref().map(Self::ViewFactor),
            LawKind::Permeability => {
                let law = laws.pore.as_ref().filter(|law| matches!(law.permeability, Permeability::Finite(_)))?;
                Some(Self::Permeability(law, characteristic_length))
            }
        }
    }

    /// The clearance above which the law is switched off, if any and known.
    pub(super) fn cutoff(self) -> Option<f64> {
        match self {
            Self::Permeability(law, length) => law.cutoffs.flow_across.or(length),
            _ => None,
        }
    }

    /// Whether the values while open depend on the characteristic element length.
    pub(super) fn needs_characteristic_length(self) -> bool {
        matches!(self, Self::Permeability(..)) && self.cutoff().is_none()
    }

    /// The value at clearance or contact pressure `x`; `variables` are those of the rows after the first.
    ///
    /// `None` where the law has none, as beyond an unknown cutoff.
    pub(super) fn value(self, side: Side, x: f64, variables: &[f64]) -> Option<Value> {
        let (state, clearance, pressure) = match side {
            Side::Open => (ContactState::Open, x, 0.0),
            Side::Closed => (ContactState::Closed, 0.0, x),
        };
        let (clearance, pressure) = (Clearance(clearance), ContactPressure(pressure));
        let point = ContactPoint { clearance, pressure, state, variables };
        let found = match self {
            Self::Electrical(tables) => Value::of(side, tables.conductance(&point)),
            Self::Thermal(thermal) => Value::of(side, thermal.conductance(&point)),
            Self::ViewFactor(law) => {
                let (y, sides) = law.view_factor(clearance, state);
                let has_rows = side == Side::Open;
                Value { y, reach: if has_rows { reach(sides) } else { Reach::Continued } }
            }
            Self::Permeability(law, characteristic_length) => {
                let nothing = PorePressure(0.0);
                let flow = law.flow(&PorePoint {
                    clearance,
                    pressure,
                    state,
                    slave: nothing,
                    master: nothing,
                    jump: None,
                    variables,
                    characteristic_length,
                    bulk: None,
                    gap: Gap::Steady,
                    multiplier: None,
                });
                let has_rows = side == Side::Closed;
                Value { y: flow.permeability?, reach: if has_rows { reach(flow.sides) } else { Reach::Continued } }
            }
        };
        found.y.is_finite().then_some(found)
    }
}

impl Value {
    fn of(side: Side, found: Conductance) -> Self {
        use inpact_evaluation::law::Branch;
        let has_rows = match side {
            Side::Open => found.branch == Branch::Clearance,
            Side::Closed => found.branch == Branch::Pressure,
        };
        Self { y: found.value, reach: if has_rows { reach(found.sides) } else { Reach::Continued } }
    }
}

/// Continuation refers only to the axis of the curve; for other variables their fixed values are shown.
fn reach(sides: Sides) -> Reach {
    if sides.is_below(0) || sides.is_above(0) { Reach::Continued } else { Reach::Within }
}
