//! The quantities at one point of contact, each of its own type so that a clearance is not taken for a pressure, and whether the point is closed.

/// Clearance d between the surfaces (L): positive when open, negative in overclosure.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Clearance(pub f64);

/// Rate of change of the clearance (L T⁻¹): negative when the gap closes.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct ClearanceRate(pub f64);

/// Contact pressure p (F L⁻²): positive in compression.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct ContactPressure(pub f64);

/// Pore pressure on one side of the interface (F L⁻²).
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct PorePressure(pub f64);

/// Jump of the electric potential across the interface, Δφ = φ_slave − φ_master (φ).
///
/// A quantity of its own, because the difference of two stored potentials may have lost its digits: at potentials near 300 a jump of 1e-8 keeps two or three of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct PotentialJump(pub f64);

impl PotentialJump {
    /// The jump from the potentials of the two sides, where it is not known by itself.
    pub fn between(slave: f64, master: f64) -> Self {
        Self(slave - master)
    }
}

/// Whether a point of the interface is in contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactState {
    /// In contact.
    Closed,
    /// Apart.
    Open,
    /// It cannot be told, because clearance or pressure is NaN.
    Undetermined,
}

impl ContactState {
    /// The state where none is given: closed when d <= 0 or p ≠ 0 (semantics T-22, Q-12).
    pub fn from_clearance_and_pressure(clearance: Clearance, pressure: ContactPressure) -> Self {
        let (d, p) = (clearance.0, pressure.0);
        if d <= 0.0 || p < 0.0 || p > 0.0 {
            Self::Closed
        } else if d.is_nan() || p.is_nan() {
            Self::Undetermined
        } else {
            Self::Open
        }
    }
}
