//! The integrals of the heat at one node: HTL and SFDRT and, times its area, HTLA and SFDRTA.
//!
//! Backward Euler, as the integrals of current are (O-5). The two flows have increments of their own, because a row may have one and not the other.

use super::{HistoryStart, Integral};
use crate::numbers::Amount;

/// The integrals of the heat that leaves the slave and of the heat of friction.
#[derive(Clone, Debug, Default)]
pub struct ThermalHistory {
    /// Heat leaving the slave surface: HTL, HTLA.
    pub leaving: FlowHistory,
    /// Heat of friction into both surfaces: SFDRT, SFDRTA.
    pub friction: FlowHistory,
}

/// The integral of one flow per area over time and, times the area of the node, of the whole flow.
#[derive(Clone, Debug, Default)]
pub struct FlowHistory {
    start: HistoryStart,
    previous: Option<f64>,
    integral: Integral,
}

impl ThermalHistory {
    /// A history that starts so.
    pub fn new(start: HistoryStart) -> Self {
        Self { leaving: FlowHistory::new(start), friction: FlowHistory::new(start) }
    }
}

impl FlowHistory {
    /// A history that starts so.
    pub fn new(start: HistoryStart) -> Self {
        Self { start, ..Self::default() }
    }

    /// Advances to the row at `time`, whose flow holds since the previous row, or since the start; `area` is the area of the node, if known.
    pub fn add(&mut self, time: f64, flow: Amount, area: Option<f64>) {
        let duration = self.previous.or_else(|| self.start.before(time)).map(|start| time - start);
        self.previous = Some(time);
        self.integral.add(flow, duration, area);
    }

    /// The integral of the flow per area.
    pub fn per_area(&self) -> f64 {
        self.integral.per_unit.total()
    }

    /// The integral of the whole flow; `None` once an area was unknown.
    pub fn of_area(&self) -> Option<f64> {
        self.integral.of_area()
    }
}
