//! Heat across an interface: conduction by *GAP CONDUCTANCE, and the sum of all heat that crosses it or is generated there.
//!
//! q_k = k (θ_slave − θ_master), positive leaving the slave surface.
//! With radiation q_r and generated heat q_g of which the share f goes into the slave, the heat that leaves each side is
//!
//! - slave: q_k + q_r − f q_g (output HFL);
//! - master: −q_k − q_r − (1 − f) q_g;
//!
//! so that both sides together absorb q_g: the interface stores no heat (H-09).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | gap conductance, against clearance or pressure, mean temperature, mass flow rate, field variables | J T⁻¹ L⁻² θ⁻¹ |
//! | θ | temperature of one side, on the scale of the deck | θ |
//! | ṁ | mean of the magnitudes of the mass flow rates of both sides | M L⁻² T⁻¹ |
//! | q | heat flux | J T⁻¹ L⁻² |
//!
//! Domain: any finite temperatures; q_k is accurate wherever it is finite, even where the difference of the temperatures is not.
//! Derivatives: ∂q_k/∂θ_slave = k + ½k'(θ_slave − θ_master), ∂q_k/∂θ_master = −k + ½k'(θ_slave − θ_master), k' the slope along the mean temperature.
//! Limits: beyond the last clearance k is zero (K-31), outside the range of pressures it is constant.
//! Source: semantics 4.2, 5 (H-02 to H-06, H-09), 8, K-30 to K-32; Analysis User's Guide 37.2.1, Theory Guide 5.2.4 and 5.2.6 (6.14).

pub(crate) mod columns;
pub(crate) mod conduction;
pub(crate) mod plan;
pub(crate) mod tables;

use super::calculix::CalculixConductance;
use super::conductance::{Conductance, ConductanceSlopes, ConductanceTables, ContactPoint};
use super::heat::HeatAmounts;
use crate::numbers::{Amount, Scaled, is_moderate, mean, scaled_difference_product};

/// The gap conductance of an interaction.
///
/// Of the `variables` of a [`ContactPoint`], 0 is the mean temperature, 1 the mean mass flow rate, the rest are the field variables.
#[derive(Clone, Debug)]
pub enum ThermalConductance {
    /// *GAP CONDUCTANCE of Abaqus: against clearance, contact pressure, or both.
    Tables(ConductanceTables),
    /// *GAP CONDUCTANCE of CalculiX: against pressure and temperature, closed only.
    Calculix(CalculixConductance),
}

impl ThermalConductance {
    /// The conductance at a point; NaN where an input it depends on is NaN.
    #[inline]
    pub fn conductance(&self, point: &ContactPoint<'_>) -> Conductance {
        match self {
            Self::Tables(tables) => tables.conductance(point),
            Self::Calculix(curves) => curves.conductance(point),
        }
    }

    /// Its slopes along clearance and pressure, and along the other variables in `variables` (semantics 4.4).
    pub fn slopes(&self, point: &ContactPoint<'_>, variables: &mut [f64]) -> ConductanceSlopes {
        match self {
            Self::Tables(tables) => tables.slopes(point, variables),
            Self::Calculix(curves) => curves.slopes(point, variables),
        }
    }
}

/// The temperatures of the two sides, θ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Temperatures {
    /// Of the slave surface.
    pub slave: f64,
    /// Of the master surface.
    pub master: f64,
    /// θ_slave − θ_master, where it is given directly: the difference of two nearly equal temperatures suffers from cancellation.
    pub jump: Option<f64>,
}

impl Temperatures {
    /// The temperatures of two surfaces, without a given difference.
    pub fn of(slave: f64, master: f64) -> Self {
        Self { slave, master, jump: None }
    }

    /// Those of two surfaces with only θ_slave − θ_master known: enough for conduction, but not for anything that depends on the temperatures themselves.
    pub fn of_jump(jump: f64) -> Self {
        Self { slave: jump, master: 0.0, jump: Some(jump) }
    }

    /// The exact difference θ_slave − θ_master of finite temperatures.
    pub(crate) fn difference(self) -> Scaled {
        self.jump.map_or_else(|| Scaled::difference(self.slave, self.master), Scaled::new)
    }

    /// Their mean, on which conductances depend.
    pub fn mean(self) -> f64 {
        mean(self.slave, self.master)
    }
}

/// The heat q_k that is conducted out of the slave into the master surface.
#[inline]
pub fn conducted_heat(conductance: f64, temperatures: Temperatures) -> f64 {
    // Zero heat is +0, not −0.
    match temperatures.jump {
        Some(jump) => conductance * jump + 0.0,
        None => scaled_difference_product(conductance, temperatures.slave, temperatures.master) + 0.0,
    }
}

/// [`conducted_heat`] without overflow, for products and sums; `rest` is the rounding error of the conductance, where that is known.
pub(crate) fn conducted_heat_amount(value: f64, rest: Option<f64>, temperatures: Temperatures) -> Amount {
    let Temperatures { slave, master, jump } = temperatures;
    if rest.is_none() && [value, slave, master, jump.unwrap_or(0.0)].into_iter().all(is_moderate) {
        return Amount::new(conducted_heat(value, temperatures));
    }
    let exact = exact_conducted_heat(value, rest.unwrap_or(0.0), temperatures);
    exact.map_or_else(|| Amount::new(conducted_heat(value, temperatures)), Amount::exactly)
}

/// q_k; `None` where an input is infinite or NaN.
fn exact_conducted_heat(value: f64, rest: f64, temperatures: Temperatures) -> Option<Scaled> {
    let Temperatures { slave, master, jump } = temperatures;
    let is_finite = [value, rest, slave, master, jump.unwrap_or(0.0)].into_iter().all(f64::is_finite);
    is_finite.then(|| (Scaled::new(value) + Scaled::new(rest)) * temperatures.difference())
}

/// Slopes of a flux along the temperatures of both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideSlopes {
    /// ∂q/∂θ_slave.
    pub slave: f64,
    /// ∂q/∂θ_master.
    pub master: f64,
}

/// The slopes of q_k along both temperatures, for a conductance with the slope `along_mean` along the mean temperature.
///
/// Along clearance, pressure, mass flow rate and field variables the slope of q_k is that of the conductance by [`conducted_heat`].
pub fn conducted_heat_slopes(conductance: f64, along_mean: f64, temperatures: Temperatures) -> SideSlopes {
    let by_mean = conducted_heat(0.5 * along_mean, temperatures);
    SideSlopes { slave: by_mean + conductance, master: by_mean - conductance }
}

/// The mean of the magnitudes of the mass flow rates of both sides; a side without one counts as at rest (K-32).
#[inline]
pub fn mean_mass_flow(slave: Option<f64>, master: Option<f64>) -> f64 {
    mean(slave.map_or(0.0, f64::abs), master.map_or(0.0, f64::abs))
}

/// All heat at one point of an interface, each part per area and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterfaceHeat {
    /// q_k, conducted out of the slave surface.
    pub conduction: Amount,
    /// q_r, radiated out of the slave surface.
    pub radiation: Amount,
    /// Generated by electric current.
    pub current: HeatAmounts,
    /// Generated by friction.
    pub friction: HeatAmounts,
}

impl InterfaceHeat {
    /// The heat that leaves the slave surface, q_k + q_r − f q_g (output HFL).
    #[inline]
    pub fn leaving_slave(&self) -> Amount {
        Amount::sum([self.conduction, self.radiation, -self.current.slave, -self.friction.slave])
    }

    /// All heat into the slave surface.
    #[inline]
    pub fn into_slave(&self) -> f64 {
        // Zero heat is +0, not −0.
        0.0 - self.leaving_slave().value()
    }

    /// All heat into the master surface.
    #[inline]
    pub fn into_master(&self) -> f64 {
        Amount::sum([self.conduction, self.radiation, self.current.master, self.friction.master]).value()
    }
}
