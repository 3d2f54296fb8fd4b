//! The quantities at one point of contact, each of its own type so that a clearance is not taken for a pressure, and whether the point is closed.

pub(crate) mod columns;

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
/// A separate quantity, because the difference of two stored potentials suffers from cancellation: at potentials near 300 a jump of 1e-8 keeps two or three digits.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct PotentialJump(pub f64);

impl PotentialJump {
    /// The jump from the potentials of the two sides, where it is not given directly.
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
    /// It is undetermined, because clearance or pressure is NaN.
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

    /// The state of a point with partial data: by `closed` (0 is open), otherwise by clearance and pressure (T-22); a missing pressure counts as zero.
    ///
    /// `None` where the data do not suffice: without a clearance only a pressure decides.
    #[inline]
    pub fn of(closed: Option<f64>, clearance: Option<f64>, pressure: Option<f64>) -> Option<Self> {
        match (closed, clearance, pressure) {
            (Some(closed), ..) if closed.is_nan() => Some(Self::Undetermined),
            (Some(closed), ..) => Some(if closed == 0.0 { Self::Open } else { Self::Closed }),
            (None, Some(clearance), pressure) => {
                let pressure = ContactPressure(pressure.unwrap_or(0.0));
                Some(Self::from_clearance_and_pressure(Clearance(clearance), pressure))
            }
            (None, None, Some(pressure)) if pressure.is_nan() => Some(Self::Undetermined),
            (None, None, Some(pressure)) if pressure != 0.0 => Some(Self::Closed),
            (None, None, _) => None,
        }
    }

    /// The clearance at which all tables against clearance are evaluated, of conductance and of view factors; `None` where it is needed and unknown.
    ///
    /// A closed point uses d = 0 whatever its clearance, which matters only while open; overclosure counts as zero clearance (J-5).
    /// NaN stays NaN, and where the state of contact is undetermined the clearance is NaN, as closed and open points use different values.
    #[inline]
    pub fn table_clearance(self, clearance: Option<f64>) -> Option<f64> {
        match self {
            Self::Closed => Some(0.0),
            Self::Undetermined => Some(f64::NAN),
            // f64::max would make NaN a clearance of zero.
            Self::Open => clearance.map(|clearance| if clearance < 0.0 { 0.0 } else { clearance }),
        }
    }
}
