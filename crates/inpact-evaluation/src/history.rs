//! Integrals of a node's flows over its history.
//!
//! The manuals do not say how ECDT, SJDT, HTL, SFDRT and PTL are integrated; the decision is backward Euler (semantics O-5, Q-26): flow at the end of an increment times its duration,
//! with SJDT from the increment's mean heat (H-08). The gap-filling part of PTL is −w Δb of the filled width exactly, or, where a rate is given, that rate times the duration, as PFL.
//! Where a history starts is a choice ([`HistoryStart`], C-25): at its first row, where the integrals are 0 and the jump at its start is its own, or at rest before it.
//! Sums are compensated, so that ten million increments cost no digits, and partial sums may exceed the range of f64.
//!
//! One row takes two calls: `begin` gives what the law needs from the previous row, `finish` adds the results of the law.
//! The caller rejects times that do not ascend.

mod steps;
mod thermal;

pub(crate) use steps::StepColumns;
use steps::{ElectricalSteps, Step};
pub use thermal::{FlowHistory, ThermalHistory};

use crate::law::contact::{Clearance, ClearanceRate, PotentialJump};
use crate::law::electrical::{ElectricalFlow, ExactFlow};
use crate::law::pore::{Gap, PoreFlow};
use crate::numbers::{Amount, Scaled, UnboundedSum, is_moderate};

/// Where the history of a node starts (C-25).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum HistoryStart {
    /// At its first row: the integrals are 0 there, its jump of potential and its clearance are those of the start.
    #[default]
    FirstRow,
    /// Without a jump of potential and with the clearance of its first row, at this time; a later first row ends an increment.
    AtRest {
        /// When histories start, T.
        time: f64,
    },
}

impl HistoryStart {
    /// When a history has started before its first row; `None` where that row is its start.
    fn before(self, first_row: f64) -> Option<f64> {
        match self {
            Self::AtRest { time } if time < first_row => Some(time),
            _ => None,
        }
    }
}

/// Δφ₀ in the heat of an increment at whose start the interface did not conduct.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClosingHeat {
    /// The jump of the open circuit, as in the manual: a heat that no circuit supplied.
    #[default]
    Manual,
    /// The jump at the end of the increment, so that power balances.
    Balanced,
}

/// The integrals of current and heat at one node: ECDT, SJDT and, times the node's area, ECDTA, SJDTA.
#[derive(Clone, Debug, Default)]
pub struct ElectricalHistory {
    start: HistoryStart,
    closing_heat: ClosingHeat,
    previous: Option<ElectricalRow>,
    current: Integral,
    heat: Integral,
}

/// Quantities of a row that the next one needs.
#[derive(Clone, Copy, Debug)]
struct ElectricalRow {
    time: f64,
    jump: PotentialJump,
    conducts: bool,
}

/// Quantities of the previous row that an increment of the electrical law needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElectricalIncrement {
    /// Δt; `None` in the first row of a history.
    pub duration: Option<f64>,
    /// Δφ₀, the jump at its start.
    pub jump_at_start: PotentialJump,
    /// Whether Δφ₀ is the jump of an open circuit which the increment closes.
    pub closes_circuit: bool,
}

impl ElectricalHistory {
    /// A history with this start, and this heat of increments that close a circuit.
    pub fn new(start: HistoryStart, closing_heat: ClosingHeat) -> Self {
        Self { start, closing_heat, ..Self::default() }
    }

    /// Advances to the row at `time` with its jump of potential and its conductance.
    pub fn begin(&mut self, time: f64, jump: PotentialJump, conductance: f64) -> ElectricalIncrement {
        let at_rest = |time| ElectricalRow { time, jump: PotentialJump(0.0), conducts: true };
        let before = self.previous.or_else(|| self.start.before(time).map(at_rest));
        let conducts = conductance != 0.0;
        let increment = match before {
            None => ElectricalIncrement { duration: None, jump_at_start: jump, closes_circuit: false },
            Some(before) => {
                let closes = !before.conducts && conducts && before.jump != jump;
                let is_balanced = closes && self.closing_heat == ClosingHeat::Balanced;
                ElectricalIncrement {
                    duration: Some(time - before.time),
                    jump_at_start: if is_balanced { jump } else { before.jump },
                    closes_circuit: closes && !is_balanced,
                }
            }
        };
        // A row exactly at the start is at rest, whatever its jump.
        let starts_at_rest = before.is_none() && self.start != HistoryStart::FirstRow;
        self.previous = Some(if starts_at_rest { at_rest(time) } else { ElectricalRow { time, jump, conducts } });
        increment
    }

    /// Adds the increment's flow; `area` is the node's area at its end, if known, and `rest` the rounding error of the current density.
    pub fn finish(&mut self, increment: &ElectricalIncrement, flow: &ElectricalFlow, rest: f64, area: Option<f64>) {
        self.current.add(Amount::new(flow.current_density), increment.duration, area);
        // Where currents of opposite sign cancel, only their rounding errors would remain.
        if rest != 0.0 && rest.is_finite() {
            self.current.add(Amount::new(rest), increment.duration, area);
        }
        self.heat.add(Amount::new(flow.heat.total), increment.duration, area);
    }

    /// [`Self::finish`] for steps computed by column, 0 in a row without a duration; every row has had an area.
    #[inline]
    pub(crate) fn add_steps(&mut self, steps: &ElectricalSteps) {
        self.current.add_steps(steps.current);
        self.current.add_steps(steps.rest);
        self.heat.add_steps(steps.heat);
    }

    /// Whether a row had no area.
    pub(crate) fn lacks_area(&self) -> bool {
        self.current.lacks_area
    }

    /// The integrals where every row has had an area: ECDT, ECDTA, SJDT, SJDTA.
    #[inline]
    pub(crate) fn integrals(&self) -> [f64; 4] {
        let (current, heat) = (&self.current, &self.heat);
        [&current.per_unit, &current.whole, &heat.per_unit, &heat.whole].map(UnboundedSum::total)
    }

    /// Forgets the previous row, as [`Self::begin`] must for the first row of another node; the sums stay.
    pub(crate) fn restart(&mut self) {
        self.previous = None;
    }

    /// Resets the sums.
    pub(crate) fn clear_integrals(&mut self) {
        (self.current, self.heat) = Default::default();
    }

    /// [`Self::finish`] for a flow that may exceed the range of f64 where its product with time or area does not.
    pub fn finish_exactly(&mut self, increment: &ElectricalIncrement, flow: &ExactFlow, area: Option<f64>) {
        self.current.add(flow.current_density, increment.duration, area);
        self.heat.add(flow.heat.total, increment.duration, area);
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
    start: HistoryStart,
    previous: Option<(f64, Clearance)>,
    volume: Integral,
    is_unknown: bool,
}

/// A given rate with a larger relative difference from the change of the clearance contradicts it (D021).
const CONTRADICTION: f64 = 0.01;

/// Whether a given rate of the clearance contradicts that at which it changes.
pub fn contradicts(given: f64, rate: f64) -> bool {
    CONTRADICTION * rate.abs().max(given.abs()) < (rate - given).abs()
}

/// Quantities of the previous row that an increment of the pore law needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoreIncrement {
    /// Δt; `None` in the first row of a history.
    pub duration: Option<f64>,
    /// The gap in a transient: it changes at the given rate, otherwise by the change of the clearance over the increment, and not at all in the first row.
    pub gap: Gap,
    /// ḋ from the change of the clearance, where a given rate contradicts it.
    pub contradicted: Option<ClearanceRate>,
}

impl PoreHistory {
    /// A history with this start.
    pub fn new(start: HistoryStart) -> Self {
        Self { start, ..Self::default() }
    }

    /// Advances to the row at `time` with its clearance and, where the data has it, the rate of the clearance.
    pub fn begin(&mut self, time: f64, clearance: Clearance, given_rate: Option<ClearanceRate>) -> PoreIncrement {
        let before = self.previous.or_else(|| self.start.before(time).map(|start| (start, clearance)));
        let is_measured = self.previous.is_some();
        self.previous = Some((time, clearance));
        let Some((start, before)) = before else {
            let gap = Gap::Changing(given_rate.unwrap_or_default());
            return PoreIncrement { duration: None, gap, contradicted: None };
        };
        let duration = time - start;
        let contradicted = given_rate.filter(|_| is_measured).and_then(|given| {
            let rate = (clearance.0 - before.0) / duration;
            contradicts(given.0, rate).then_some(ClearanceRate(rate))
        });
        let gap = given_rate.map_or(Gap::Since { clearance: before, duration }, Gap::Changing);
        PoreIncrement { duration: Some(duration), gap, contradicted }
    }

    /// Adds the increment's flow; `gap` is the input of the law, `area` the node's area at its end, if known.
    ///
    /// The flow across and a given rate hold for the whole increment; otherwise the gap contributes the change of its filled width.
    pub fn finish(&mut self, increment: &PoreIncrement, gap: Gap, flow: &PoreFlow, area: Option<f64>) {
        let Some(duration) = increment.duration else {
            self.volume.add(Amount::ZERO, None, area);
            return;
        };
        let (Some(crossing), Some([filling, _])) = (flow.crossing, flow.filling) else {
            self.is_unknown = true;
            return;
        };
        self.volume.add(-crossing, Some(duration), area);
        match gap {
            Gap::Steady => {}
            Gap::Changing(_) => self.volume.add(-filling, Some(duration), area),
            Gap::Since { .. } => {
                let (change, error) = flow.width_change;
                let share = Amount::new(flow.slave_share);
                self.volume.add(share, Some(change), area);
                if error != 0.0 && error.is_finite() {
                    self.volume.add(share, Some(error), area);
                }
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

/// One integral per unit of area, and one over the node's area as long as that is known.
#[derive(Clone, Debug, Default)]
struct Integral {
    per_unit: UnboundedSum,
    whole: UnboundedSum,
    lacks_area: bool,
}

impl Integral {
    /// Adds `rate` × `duration`; without a duration, in a first row, only a missing area matters.
    ///
    /// Where rate, duration or area are extreme, the products are computed without overflow; products with infinities or NaN are plain ones.
    fn add(&mut self, rate: Amount, duration: Option<f64>, area: Option<f64>) {
        self.lacks_area |= area.is_none();
        let Some(duration) = duration else { return };
        let factors = [duration, area.unwrap_or(0.0)];
        let is_plain = rate.is_moderate() && factors.into_iter().all(is_moderate);
        match rate.exact().filter(|_| !is_plain && factors.into_iter().all(f64::is_finite)) {
            Some(exact) => {
                let step = exact * Scaled::new(duration);
                self.per_unit.add_scaled(step);
                if let Some(area) = area {
                    self.whole.add_scaled(step * Scaled::new(area));
                }
            }
            None => {
                self.per_unit.add_product(rate.value(), duration);
                if let Some(area) = area {
                    self.whole.add_product(rate.value() * area, duration);
                }
            }
        }
    }

    /// Adds steps per area and of the node's area.
    #[inline]
    fn add_steps(&mut self, [per_unit, whole]: [Step; 2]) {
        self.per_unit.add_exact_product(per_unit.product, per_unit.error);
        self.whole.add_exact_product(whole.product, whole.error);
    }

    fn of_area(&self) -> Option<f64> {
        (!self.lacks_area).then(|| self.whole.total())
    }
}
