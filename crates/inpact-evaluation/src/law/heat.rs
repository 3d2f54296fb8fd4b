//! How the heat generated at an interface is shared: *GAP HEAT GENERATION.
//!
//! q_slave = f q_g, q_master = (1 − f) q_g, with q_g = η P of the energy P dissipated per area and time.
//!
//! | symbol | meaning | default |
//! |---|---|---|
//! | η | fraction of the dissipated energy turned into heat; may hold a factor of units and so exceed 1 | 1 |
//! | f | fraction of that heat which goes into the slave surface, 0 to 1 | 0.5 |
//!
//! Semantics H-02 to H-04, K-35 to K-37; Analysis User's Guide 37.2.1 and Keywords Guide, 6.14.

use crate::numbers::{Amount, Scaled};

/// Fraction of the dissipated energy that becomes heat, and the slave surface's share of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatGeneration {
    /// η, heat per dissipated energy.
    pub fraction: f64,
    /// f, the share of the heat that goes into the slave surface; output WEIGHT.
    pub slave_weight: f64,
}

impl Default for HeatGeneration {
    /// All dissipated energy becomes heat, half of it on either side, as when the keyword is absent.
    fn default() -> Self {
        Self { fraction: 1.0, slave_weight: 0.5 }
    }
}

/// Heat generated at a point of the interface, per area and time (J T⁻¹ L⁻²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneratedHeat {
    /// Heat into both sides together, ηP; output SJD when a current generates it.
    pub total: f64,
    /// Heat into the slave surface, fηP.
    pub slave: f64,
    /// Heat into the master surface, (1 − f)ηP.
    pub master: f64,
}

/// [`GeneratedHeat`] as amounts, which their sums and products may need unrounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatAmounts {
    /// Heat into both sides together.
    pub total: Amount,
    /// Heat into the slave surface.
    pub slave: Amount,
    /// Heat into the master surface.
    pub master: Amount,
}

impl HeatAmounts {
    /// No heat.
    pub const ZERO: Self = Self { total: Amount::ZERO, slave: Amount::ZERO, master: Amount::ZERO };

    /// A heat of any size, shared; the weight must be finite.
    pub fn share(total: Scaled, slave_weight: f64) -> Self {
        let weight = Scaled::new(slave_weight);
        let master_weight = Scaled::new(1.0) + -weight;
        Self {
            total: Amount::exactly(total),
            slave: Amount::exactly(weight * total),
            master: Amount::exactly(master_weight * total),
        }
    }

    /// Heat into slave and master surface, from plain arithmetic.
    #[inline]
    pub(crate) fn plain_shares(&self) -> Option<[f64; 2]> {
        Some([self.slave.plain()?, self.master.plain()?])
    }

    /// Each rounded once.
    pub fn rounded(&self) -> GeneratedHeat {
        GeneratedHeat { total: self.total.value(), slave: self.slave.value(), master: self.master.value() }
    }
}

impl From<GeneratedHeat> for HeatAmounts {
    fn from(heat: GeneratedHeat) -> Self {
        let GeneratedHeat { total, slave, master } = heat;
        Self { total: Amount::new(total), slave: Amount::new(slave), master: Amount::new(master) }
    }
}
