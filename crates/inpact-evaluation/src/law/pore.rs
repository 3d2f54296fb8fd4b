//! Pore fluid across an interface and into its changing gap: *CONTACT PERMEABILITY.
//!
//! q_slave = q_gap,slave + q_across, q_master = q_gap,master − q_across: volume per area and time, positive **into** each body (P-10).
//!
//! - across: q_across = k (p_master − p_slave), positive out of the master into the slave (P-11, P-31);
//!   without a table the permeability is infinite, both pore pressures are equal and q_across is an unknown of the equations (P-30);
//! - gap filling: q_gap,slave = −w ḃ, q_gap,master = −(1 − w) ḃ with w = k₁ / (k₁ + k₂) of the bulk permeabilities of slave and master,
//!   and w = ½ where the interface's permeability is infinite or the bulk's unknown (P-40 to P-42); zero in steady state (P-13).
//!   The gap that fills has the width b = min(max(d, 0), cutoff): overclosure expels nothing, and a closed cycle gives 0.
//!   A rate of the clearance that is given counts where 0 < d ≤ cutoff, and at d = 0 where the gap opens.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | permeability of the interface, a table against contact pressure, mean pore pressure, mean temperature, field variables | L² T M⁻¹ |
//! | p_slave, p_master | pore pressures | M L⁻¹ T⁻² |
//! | d, ḋ | clearance and its rate | L, L T⁻¹ |
//! | b, ḃ | width of the gap that is filled and its rate | L, L T⁻¹ |
//! | k₁, k₂ | bulk permeabilities behind slave and master | any, the same for both |
//!
//! Both parts end at a cutoff of their own, by default the characteristic element length of the surfaces (P-20, P-21), at which they are still in force (P-22, Q-4).
//! While the interface is open, k is the table's value at contact pressure 0 (P-34).
//! Output PFL is the flow leaving the slave, −q_slave (section 3.6).
//!
//! Derivatives: slopes of the table as in semantics 4.4; ∂q_across/∂p_master = k + ½ k_p̄ (p_master − p_slave), ∂q_across/∂p_slave = −k + ½ k_p̄ (p_master − p_slave) (section 8).
//! Limits: k = 0 is a sealed interface; a cutoff of 0 confines its part to the closed interface.
//! Source: semantics P-10 to P-42; Analysis User's Guide 37.4.1, Theory Guide 5.2.2 (6.14).

pub(crate) mod columns;
pub(crate) mod plan;

use super::contact::{Clearance, ClearanceRate, ContactPressure, ContactState, PorePressure};
use crate::evaluator::FoundValue;
use crate::numbers::{Amount, Scaled, is_moderate, ratio, scaled_difference_product, two_difference};
use crate::table::{PiecewiseTable, Sides};

/// The pore fluid law of one surface interaction.
#[derive(Clone, Debug)]
pub struct PoreLaw {
    /// Resistance to flow across.
    pub permeability: Permeability,
    /// The cutoff distances.
    pub cutoffs: Cutoffs,
    /// Whether a part is in force exactly at its cutoff.
    pub boundary: CutoffBoundary,
}

/// The permeability of an interface.
#[derive(Clone, Debug)]
pub enum Permeability {
    /// No resistance: equal pore pressures on both sides (P-30).
    Infinite,
    /// A table: axis 0 contact pressure, 1 mean pore pressure, 2 mean temperature, then field variables (P-32).
    Finite(PiecewiseTable),
}

/// The clearances up to which fluid flows; `None` where the characteristic element length takes their place (P-20).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cutoffs {
    /// CUTOFF FLOW ACROSS.
    pub flow_across: Option<f64>,
    /// CUTOFF GAP FILL.
    pub gap_fill: Option<f64>,
}

/// Whether flow at a clearance equal to the cutoff is still in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CutoffBoundary {
    /// Yes, as in the user's guide: off above the cutoff.
    #[default]
    Inclusive,
    /// No, as in the theory guide: off from the cutoff on.
    Exclusive,
}

/// The variables of pore flow at one point of the interface.
#[derive(Clone, Copy, Debug)]
pub struct PorePoint<'a> {
    /// Clearance d.
    pub clearance: Clearance,
    /// Contact pressure p, the effective one (P-01).
    pub pressure: ContactPressure,
    /// Closed or open.
    pub state: ContactState,
    /// Pore pressure at the slave surface.
    pub slave: PorePressure,
    /// Pore pressure at the master surface.
    pub master: PorePressure,
    /// p_slave − p_master, where it is given directly: the difference of two nearly equal pressures suffers from cancellation.
    pub jump: Option<f64>,
    /// The mean of the two pore pressures, the mean temperature, then the field variables, as far as the table depends on them; the rest may be NaN or left out.
    pub variables: &'a [f64],
    /// The characteristic element length, if known.
    pub characteristic_length: Option<f64>,
    /// Bulk permeabilities behind slave and master, if both are known.
    pub bulk: Option<BulkPermeabilities>,
    /// The change of the gap.
    pub gap: Gap,
    /// q_across where it is known although the permeability is infinite, from a solution of the equations in which it is an unknown.
    pub multiplier: Option<f64>,
}

/// Permeabilities of the materials on both sides, in any one unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BulkPermeabilities {
    /// Behind the slave surface, k₁.
    pub slave: f64,
    /// Behind the master surface, k₂.
    pub master: f64,
}

/// Whether a changing gap takes up fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gap {
    /// Steady state: it does not change (P-13).
    Steady,
    /// Its clearance changes at this rate, which is given.
    Changing(ClearanceRate),
    /// Its clearance has changed over an increment of a history.
    Since {
        /// The clearance at the start of the increment.
        clearance: Clearance,
        /// The length of the increment, above zero, T.
        duration: f64,
    },
}

/// Whether one of the two parts of the flow is in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// It is.
    Active,
    /// The surfaces are beyond its cutoff.
    CutOff,
    /// The cutoff is the characteristic element length, which is needed and unknown.
    NeedsCharacteristicLength,
}

/// Flows at one point of the interface. `None` is unknown: see `across` and `gap_fill` for the reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoreFlow {
    /// Whether fluid crosses the interface.
    pub across: Flow,
    /// Whether a changing gap would take up fluid.
    pub gap_fill: Flow,
    /// k in force: 0 beyond the cutoff, `None` where it is infinite.
    pub permeability: Option<f64>,
    /// Whether an infinite permeability constrains the two pore pressures to be equal here.
    pub is_constrained: bool,
    /// Flow from master to slave.
    pub crossing: Option<Amount>,
    /// Flow into slave and master out of the closing gap.
    pub filling: Option<[Amount; 2]>,
    /// w, the slave's share of gap filling.
    pub slave_share: f64,
    /// Δb, the change of the filled width over the increment, and its rounding error; zeros except for [`Gap::Since`].
    pub width_change: (f64, f64),
    /// Along which axes of the table the point lies outside.
    pub sides: Sides,
}

impl PoreFlow {
    /// Flow from master to slave, q_across.
    pub fn q_across(&self) -> Option<f64> {
        self.crossing.map(Amount::value)
    }

    /// Flow into the slave out of the closing gap, q_gap,slave.
    pub fn q_gap_slave(&self) -> Option<f64> {
        self.filling.map(|[slave, _]| slave.value())
    }

    /// Flow into the master out of the closing gap, q_gap,master.
    pub fn q_gap_master(&self) -> Option<f64> {
        self.filling.map(|[_, master]| master.value())
    }

    /// All flow into the slave, q_s.
    pub fn into_slave(&self) -> Option<f64> {
        Some(Amount::sum([self.filling?[0], self.crossing?]).value())
    }

    /// All flow into the master, q_m.
    pub fn into_master(&self) -> Option<f64> {
        Some(Amount::sum([self.filling?[1], -self.crossing?]).value())
    }

    /// Pore volume flux leaving the slave (output PFL), −q_s.
    pub fn leaving_slave(&self) -> Option<Amount> {
        Some(Amount::sum([-self.filling?[0], -self.crossing?]))
    }
}

impl PoreLaw {
    /// The flow at a point.
    pub fn flow(&self, point: &PorePoint<'_>) -> PoreFlow {
        self.flow_with(point, |table, first, others| {
            let (value, sides) = table.value_and_sides_at(first, others);
            FoundValue { value, rest: None, sides }
        })
    }

    /// [`Self::flow`] with the table's values from `find`.
    pub fn flow_with(
        &self,
        point: &PorePoint<'_>,
        find: impl Fn(&PiecewiseTable, f64, &[f64]) -> FoundValue,
    ) -> PoreFlow {
        let across = self.flow_across(point);
        let gap_fill = self.gap_fill(point);
        let (permeability, rest, sides) = self.permeability_in_force(across, point, find);
        let is_constrained = across == Flow::Active && matches!(self.permeability, Permeability::Infinite);
        let crossing = match permeability {
            Some(permeability) if across == Flow::Active => Some(flow_of(permeability, rest, point)),
            _ if is_constrained => point.multiplier.map(Amount::new),
            _ if across == Flow::CutOff => Some(Amount::ZERO),
            _ => None,
        };
        let (slave_share, master_share) = self.gap_shares(point.bulk);
        let width_change = self.width_change(point);
        // The rate of the filled width; for an increment the cutoff is applied to its widths.
        let rate = match (gap_fill, point.gap) {
            (Flow::NeedsCharacteristicLength, _) => None,
            (_, Gap::Since { duration, .. }) => Some(width_rate(width_change, duration)),
            (_, Gap::Steady) | (Flow::CutOff, _) => Some(Amount::ZERO),
            (Flow::Active, Gap::Changing(rate)) => Some(Amount::new(given_rate(point.clearance, rate))),
        };
        let filling = rate.map(|rate| [slave_share, master_share].map(|share| filling_of(share, rate)));
        PoreFlow { across, gap_fill, permeability, is_constrained, crossing, filling, slave_share, width_change, sides }
    }

    /// The slope of the permeability in force along contact pressure, and in `variables` along mean pore pressure, mean temperature and field variables.
    ///
    /// Zero along the contact pressure while open, and altogether where there is no flow across or the permeability is infinite.
    pub fn permeability_slopes(&self, point: &PorePoint<'_>, variables: &mut [f64]) -> f64 {
        variables.fill(0.0);
        let (Permeability::Finite(table), Flow::Active) = (&self.permeability, self.flow_across(point)) else {
            return 0.0;
        };
        let pressure = effective_pressure(point);
        for (variable, slope) in variables.iter_mut().enumerate() {
            *slope = table.slope_at(variable + 1, pressure, point.variables);
        }
        match point.state {
            ContactState::Open => 0.0,
            _ => table.slope_at(0, pressure, point.variables),
        }
    }

    /// Whether fluid crosses the interface at a point.
    fn flow_across(&self, point: &PorePoint<'_>) -> Flow {
        self.flow_within(self.cutoffs.flow_across, point)
    }

    /// Whether a change of the gap draws fluid at a point; without a change the cutoff does not matter.
    fn gap_fill(&self, point: &PorePoint<'_>) -> Flow {
        let flow = self.flow_within(self.cutoffs.gap_fill, point);
        let is_known = self.cutoffs.gap_fill.or(point.characteristic_length).is_some();
        match point.gap {
            Gap::Since { clearance: start, .. } if !is_known => {
                // Any cutoff is above zero: a gap that opens, closes or changes its width depends on it.
                let changes = opening(start) < opening(point.clearance) || opening(point.clearance) < opening(start);
                if changes { Flow::NeedsCharacteristicLength } else { Flow::Active }
            }
            Gap::Steady if !is_known => Flow::Active,
            Gap::Changing(rate) if !is_known && rate.0 == 0.0 => Flow::Active,
            _ => flow,
        }
    }

    /// Δb over the increment, as a rounded difference and its rounding error.
    fn width_change(&self, point: &PorePoint<'_>) -> (f64, f64) {
        let Gap::Since { clearance: start, .. } = point.gap else { return (0.0, 0.0) };
        let cutoff = self.cutoffs.gap_fill.or(point.characteristic_length).unwrap_or(f64::INFINITY);
        let width = |clearance: Clearance| {
            let opening = opening(clearance);
            if cutoff < opening { cutoff } else { opening }
        };
        two_difference(width(point.clearance), width(start))
    }

    fn flow_within(&self, cutoff: Option<f64>, point: &PorePoint<'_>) -> Flow {
        let d = point.clearance.0;
        let Some(cutoff) = cutoff.or(point.characteristic_length) else {
            // Any cutoff is positive, so a closed interface is within it.
            return if d > 0.0 { Flow::NeedsCharacteristicLength } else { Flow::Active };
        };
        let is_beyond = match self.boundary {
            CutoffBoundary::Inclusive => d > cutoff,
            CutoffBoundary::Exclusive => d >= cutoff,
        };
        if is_beyond { Flow::CutOff } else { Flow::Active }
    }

    fn permeability_in_force(
        &self,
        across: Flow,
        point: &PorePoint<'_>,
        find: impl Fn(&PiecewiseTable, f64, &[f64]) -> FoundValue,
    ) -> (Option<f64>, Option<f64>, Sides) {
        let nowhere = Sides::default();
        match (across, &self.permeability) {
            (Flow::CutOff, _) => (Some(0.0), None, nowhere),
            (Flow::NeedsCharacteristicLength, _) | (Flow::Active, Permeability::Infinite) => (None, None, nowhere),
            (Flow::Active, Permeability::Finite(_)) if point.clearance.0.is_nan() => (Some(f64::NAN), None, nowhere),
            (Flow::Active, Permeability::Finite(table)) => {
                let found = find(table, effective_pressure(point), point.variables);
                (Some(found.value), found.rest, found.sides)
            }
        }
    }

    /// The shares of slave and master in gap filling (P-42).
    pub(crate) fn gap_shares(&self, bulk: Option<BulkPermeabilities>) -> (f64, f64) {
        match (&self.permeability, bulk) {
            (Permeability::Finite(_), Some(BulkPermeabilities { slave, master })) if slave != 0.0 || master != 0.0 => {
                (ratio(slave, master), ratio(master, slave))
            }
            _ => (0.5, 0.5),
        }
    }
}

/// max(d, 0); NaN where the clearance is.
fn opening(clearance: Clearance) -> f64 {
    if clearance.0 <= 0.0 { 0.0 } else { clearance.0 }
}

/// The flow of a given rate of the clearance within the cutoff: an overclosed interface has no gap, and one at zero clearance only where it opens.
pub(crate) fn given_rate(clearance: Clearance, rate: ClearanceRate) -> f64 {
    let has_gap = 0.0 < clearance.0 || (0.0 <= clearance.0 && 0.0 < rate.0);
    if has_gap || clearance.0.is_nan() { rate.0 } else { 0.0 }
}

/// ḃ over an increment, from the change of the width and its rounding error.
fn width_rate((change, error): (f64, f64), duration: f64) -> Amount {
    let inputs = [change, error, duration];
    if inputs.into_iter().all(is_moderate) || !inputs.into_iter().all(f64::is_finite) {
        return Amount::new(change / duration);
    }
    Amount::exactly((Scaled::new(change) + Scaled::new(error)) / Scaled::new(duration))
}

/// −w ḃ.
fn filling_of(share: f64, rate: Amount) -> Amount {
    match rate.exact() {
        Some(exact) if !(rate.is_moderate() && is_moderate(share)) && share.is_finite() => {
            Amount::exactly(-(Scaled::new(share) * exact))
        }
        // 0 − q and not −q: zero flow is +0, not −0.
        _ => Amount::new(0.0 - share * rate.value()),
    }
}

/// k (p_master − p_slave); `rest` is the rounding error of k, where that is known.
fn flow_of(permeability: f64, rest: Option<f64>, point: &PorePoint<'_>) -> Amount {
    let (slave, master) = point.jump.map_or((point.slave.0, point.master.0), |jump| (jump, 0.0));
    let inputs = [permeability, rest.unwrap_or(0.0), slave, master];
    let is_plain = rest.is_none() && inputs.into_iter().all(is_moderate);
    if is_plain || !inputs.into_iter().all(f64::is_finite) {
        return Amount::new(scaled_difference_product(permeability, master, slave));
    }
    Amount::exactly((Scaled::new(permeability) + Scaled::new(inputs[1])) * Scaled::difference(master, slave))
}

/// The contact pressure the table is read at: 0 while open (P-34).
fn effective_pressure(point: &PorePoint<'_>) -> f64 {
    match point.state {
        ContactState::Closed => point.pressure.0,
        ContactState::Open => 0.0,
        ContactState::Undetermined => f64::NAN,
    }
}

/// Slopes of q_across along the pore pressures of slave and master, in this order (section 8), for a permeability and its slope along the mean pore pressure.
pub fn across_slopes(
    permeability: f64,
    mean_pressure_slope: f64,
    slave: PorePressure,
    master: PorePressure,
) -> (f64, f64) {
    let common = 0.5 * scaled_difference_product(mean_pressure_slope, master.0, slave.0);
    (common - permeability, common + permeability)
}
