//! Integrals of a node's flows over its history.
//!
//! The manuals do not say how ECDT, SJDT, HTL, SFDRT and PTL are integrated; the decision is backward Euler (semantics O-5, Q-26): flow at the end of an increment times its duration,
//! with SJDT from the increment's mean heat (H-08) and the gap-filling part of PTL as −w Δd exactly.
//! A history starts at its first row: the integrals are 0 there, the jump at its start is its own (C-25), the rate of its clearance is 0 unless given.
//! Sums are compensated, so that ten million increments cost no digits.
//!
//! One row takes two calls: `begin` gives what the law needs from the row before, `finish` adds what the law answered.
//! The caller refuses times that do not ascend.

mod thermal;

pub use thermal::{FlowHistory, ThermalHistory};

use crate::law::contact::{Clearance, ClearanceRate, PotentialJump};
use crate::law::electrical::ElectricalFlow;
use crate::law::pore::{Flow, Gap, PoreFlow};
use crate::numbers::{CompensatedSum, two_difference};

/// The integrals of current and heat at one node: ECDT, SJDT and, times the node's area, ECDTA, SJDTA.
#[derive(Clone, Debug, Default)]
pub struct ElectricalHistory {
    previous: Option<(f64, PotentialJump)>,
    current: Integral,
    heat: Integral,
}

/// What an increment of the electrical law needs from the row before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElectricalIncrement {
    /// Δt; `None` in the first row of a history.
    pub duration: Option<f64>,
    /// Δφ₀, the jump at its start.
    pub jump_at_start: PotentialJump,
}

impl ElectricalHistory {
    /// Goes on to the row at `time` with its jump of potential.
    pub fn begin(&mut self, time: f64, jump: PotentialJump) -> ElectricalIncrement {
        let increment = match self.previous {
            None => ElectricalIncrement { duration: None, jump_at_start: jump },
            Some((start, jump_at_start)) => ElectricalIncrement { duration: Some(time - start), jump_at_start },
        };
        self.previous = Some((time, jump));
        increment
    }

    /// Adds the increment's flow; `area` is the node's area at its end, if known.
    pub fn finish(&mut self, increment: &ElectricalIncrement, flow: &ElectricalFlow, area: Option<f64>) {
        self.current.add_increment(flow.current_density, increment.duration, area);
        self.heat.add_increment(flow.heat.total, increment.duration, area);
    }

    /// The integral of the current density (ECDT).
    pub fn current(&self) -> f64 {
        self.current.per_unit.total()
    }

    /// The integral of the current (ECDTA); `None` once an area was unknown.
    pub fn current_of_area(&self) -> Option<f64> {
        self.current.of_area()
    }

    /// The integral of the generated heat per area (SJDT).
    pub fn heat(&self) -> f64 {
        self.heat.per_unit.total()
    }

    /// The integral of the generated heat (SJDTA); `None` once an area was unknown.
    pub fn heat_of_area(&self) -> Option<f64> {
        self.heat.of_area()
    }
}

/// The integral of the pore fluid that leaves one slave node: PTL and, times its area, PTLA.
#[derive(Clone, Debug, Default)]
pub struct PoreHistory {
    previous: Option<(f64, Clearance)>,
    volume: Integral,
    is_unknown: bool,
}

/// What an increment of the pore law needs from the row before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoreIncrement {
    /// Δt; `None` in the first row of a history.
    pub duration: Option<f64>,
    /// Δd over the increment, as a rounded difference and what the rounding took away.
    clearance_change: (f64, f64),
    /// ḋ: as given, otherwise Δd/Δt, and 0 in the first row.
    pub clearance_rate: ClearanceRate,
}

impl PoreHistory {
    /// Goes on to the row at `time` with its clearance and, where the data has it, the rate of the clearance.
    pub fn begin(&mut self, time: f64, clearance: Clearance, given_rate: Option<ClearanceRate>) -> PoreIncrement {
        let (duration, clearance_change) = match self.previous {
            None => (None, (0.0, 0.0)),
            Some((start, before)) => (Some(time - start), two_difference(clearance.0, before.0)),
        };
        self.previous = Some((time, clearance));
        let from_history = match duration {
            Some(duration) if duration != 0.0 => clearance_change.0 / duration,
            _ => 0.0,
        };
        PoreIncrement { duration, clearance_change, clearance_rate: given_rate.unwrap_or(ClearanceRate(from_history)) }
    }

    /// Adds the increment's flow; `gap` is what the law was given, `area` the node's area at its end, if known.
    ///
    /// The flow across counts for the whole increment; gap filling counts with the change of the clearance, also where a rate was given.
    pub fn finish(&mut self, increment: &PoreIncrement, gap: Gap, flow: &PoreFlow, area: Option<f64>) {
        let Some(duration) = increment.duration else {
            self.volume.add_increment(0.0, None, area);
            return;
        };
        let (Some(q_across), Some(_)) = (flow.q_across, flow.q_gap_slave) else {
            self.is_unknown = true;
            return;
        };
        self.volume.add_increment(-q_across, Some(duration), area);
        if gap != Gap::Steady && flow.gap_fill == Flow::Active {
            let (change, error) = increment.clearance_change;
            self.volume.add_increment(flow.slave_share, Some(change), area);
            if error != 0.0 && error.is_finite() {
                self.volume.add_increment(flow.slave_share, Some(error), area);
            }
        }
    }

    /// The integral of the flow that leaves the slave (PTL); `None` once a flow was unknown.
    pub fn volume(&self) -> Option<f64> {
        (!self.is_unknown).then(|| self.volume.per_unit.total())
    }

    /// The integral of that flow times area (PTLA); `None` once a flow or an area was unknown.
    pub fn volume_of_area(&self) -> Option<f64> {
        if self.is_unknown { None } else { self.volume.of_area() }
    }
}

/// One integral per unit of area, and over the node's whole area for as long as that is known.
#[derive(Clone, Debug, Default)]
struct Integral {
    per_unit: CompensatedSum,
    whole: CompensatedSum,
    lacks_area: bool,
}

impl Integral {
    /// Adds `rate` × `duration`; without a duration, in a first row, only the lack of an area counts.
    fn add_increment(&mut self, rate: f64, duration: Option<f64>, area: Option<f64>) {
        self.lacks_area |= area.is_none();
        let Some(duration) = duration else {
            return;
        };
        self.per_unit.add_product(rate, duration);
        if let Some(area) = area {
            self.whole.add_product(rate * area, duration);
        }
    }

    fn of_area(&self) -> Option<f64> {
        (!self.lacks_area).then(|| self.whole.total())
    }
}
