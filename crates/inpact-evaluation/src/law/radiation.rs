//! Heat radiated across an interface: *GAP RADIATION.
//!
//! q_r = C F(d) [(θ_slave − θ_Z)⁴ − (θ_master − θ_Z)⁴] with C = σ_SB / (1/ε_slave + 1/ε_master − 1), positive leaving the slave surface.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ε | emissivity of a surface, 0 to 1; C is symmetric in the two (K-40) | 1 |
//! | σ_SB, θ_Z | Stefan-Boltzmann constant and absolute zero in the units of the deck | J T⁻¹ L⁻² θ⁻⁴, θ |
//! | F | effective view factor against clearance, zero beyond its last point (T-27) | 1 |
//! | θ | temperature of one side, on the scale of the deck | θ |
//! | q_r | heat flux | J T⁻¹ L⁻² |
//!
//! In contact the surfaces still radiate, in addition to conduction (K-41), with the view factor at d = 0; overclosure counts as d = 0.
//!
//! The difference of fourth powers is computed as (θ_s − θ_m) (θ_s' + θ_m') (θ_s'² + θ_m'²), θ' from absolute zero: no digits are lost where the temperatures are nearly equal.
//! Domain: any finite numbers; q_r is accurate wherever it is finite itself.
//! For temperatures above absolute zero it is within 6 ulp of the exact value; below it, where there is no temperature, the formula is evaluated as it stands.
//! Derivatives: ∂q_r/∂θ_slave = 4 C F (θ_slave − θ_Z)³, ∂q_r/∂θ_master = −4 C F (θ_master − θ_Z)³.
//! Limits: equal temperatures give zero; an emissivity of zero gives C = 0.
//! Source: semantics H-06, 2.6, K-40, K-41, T-27, A-30, section 8; Analysis User's Guide 37.2.1, Theory Guide 5.2.4 (6.14).

pub(crate) mod columns;
pub(crate) mod plan;

use super::contact::{Clearance, ContactState};
use super::thermal::{SideSlopes, Temperatures};
use crate::numbers::{Amount, Scaled, is_moderate, is_zero_or_ordinary, product};
use crate::table::{PiecewiseTable, Sides};

/// The radiation law of one surface interaction.
#[derive(Clone, Debug, PartialEq)]
pub struct RadiationLaw {
    /// C, the heat radiated per fourth power of temperature at a view factor of 1.
    pub coefficient: RadiationCoefficient,
    /// θ_Z.
    pub absolute_zero: f64,
    /// F against clearance.
    pub view_factor: PiecewiseTable,
}

/// C = σ_SB / (1/ε_slave + 1/ε_master − 1), J T⁻¹ L⁻² θ⁻⁴.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiationCoefficient(pub f64);

/// The emissivities of the two surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emissivities {
    /// Of the slave surface.
    pub slave: f64,
    /// Of the master surface.
    pub master: f64,
}

impl Emissivities {
    /// Whether both are from 0 to 1, the physical range.
    pub fn are_possible(self) -> bool {
        [self.slave, self.master].iter().all(|emissivity| (0.0..=1.0).contains(emissivity))
    }
}

impl RadiationCoefficient {
    /// The coefficient of two surfaces; zero where one of them does not radiate.
    ///
    /// `None` for emissivities outside 0 to 1, or a Stefan-Boltzmann constant that is not finite.
    pub fn new(stefan_boltzmann: f64, emissivities: Emissivities) -> Option<Self> {
        if !emissivities.are_possible() || !stefan_boltzmann.is_finite() {
            return None;
        }
        let Emissivities { slave, master } = emissivities;
        if slave == 0.0 || master == 0.0 {
            return Some(Self(0.0));
        }
        let one = Scaled::new(1.0);
        let resistance = one / Scaled::new(slave) + one / Scaled::new(master) + -one;
        Some(Self((Scaled::new(stefan_boltzmann) / resistance).to_f64()))
    }
}

impl RadiationLaw {
    /// The view factor, and whether the clearance lies beyond its table.
    ///
    /// In contact it is that of d = 0, whatever the clearance. NaN where the state is undetermined, or the clearance of an open point is NaN.
    #[inline]
    pub fn view_factor(&self, clearance: Clearance, state: ContactState) -> (f64, Sides) {
        match state.table_clearance(Some(clearance.0)) {
            Some(clearance) if !clearance.is_nan() => self.view_factor.value_and_sides_at(clearance, &[]),
            // A table of one value does not depend on the clearance, but on whether it is determined.
            _ => (f64::NAN, Sides::default()),
        }
    }

    /// The heat q_r that is radiated out of the slave surface, for a view factor from [`Self::view_factor`].
    #[inline]
    pub fn heat(&self, view_factor: f64, temperatures: Temperatures) -> f64 {
        radiated_heat(self.coefficient, view_factor, self.absolute_zero, temperatures)
    }

    /// [`Self::heat`] without overflow, for products and sums.
    pub fn heat_amount(&self, view_factor: f64, temperatures: Temperatures) -> Amount {
        let Temperatures { slave, master, jump } = temperatures;
        let inputs = [self.coefficient.0, view_factor, self.absolute_zero, slave, master, jump.unwrap_or(0.0)];
        if inputs.into_iter().all(is_moderate) || !inputs.into_iter().all(f64::is_finite) {
            return Amount::new(self.heat(view_factor, temperatures));
        }
        Amount::exactly(exact_radiated_heat(self.coefficient, view_factor, self.absolute_zero, temperatures))
    }

    /// The slopes of q_r along both temperatures.
    pub fn heat_slopes(&self, view_factor: f64, temperatures: Temperatures) -> SideSlopes {
        let of_side = |temperature: f64| {
            let absolute = temperature - self.absolute_zero;
            product(&[4.0, self.coefficient.0, view_factor, absolute, absolute, absolute])
        };
        SideSlopes { slave: of_side(temperatures.slave), master: -of_side(temperatures.master) }
    }
}

/// Magnitudes between 2⁻¹⁰⁰ and 2¹⁰⁰: with coefficients of ordinary size no product of [`radiated_heat`] leaves the range of f64.
const MODERATE: std::ops::RangeInclusive<f64> = 7.888_609_052_210_118e-31..=1.267_650_600_228_229_4e30;

/// q_r between two surfaces.
#[inline]
pub fn radiated_heat(
    coefficient: RadiationCoefficient,
    view_factor: f64,
    absolute_zero: f64,
    temperatures: Temperatures,
) -> f64 {
    let Temperatures { slave, master, jump } = temperatures;
    let (a, b, difference) = (slave - absolute_zero, master - absolute_zero, jump.unwrap_or(slave - master));
    let is_harmless = is_mild(a)
        && is_mild(b)
        && is_mild(difference)
        && is_zero_or_ordinary(coefficient.0)
        && is_zero_or_ordinary(view_factor);
    let inputs = [coefficient.0, view_factor, absolute_zero, slave, master, jump.unwrap_or(0.0)];
    if !is_harmless && inputs.iter().all(|input| input.is_finite()) {
        return exact_radiated_heat(coefficient, view_factor, absolute_zero, temperatures).to_f64() + 0.0;
    }
    plain_heat(coefficient, view_factor, [a, b], difference)
}

/// Whether the powers of a temperature stay within the range of f64 ([`MODERATE`]).
#[inline]
fn is_mild(value: f64) -> bool {
    value == 0.0 || MODERATE.contains(&value.abs())
}

/// q_r for temperatures from absolute zero and their difference, none of them extreme.
#[inline]
fn plain_heat(coefficient: RadiationCoefficient, view_factor: f64, [a, b]: [f64; 2], difference: f64) -> f64 {
    // Zero heat is +0, not −0.
    coefficient.0 * view_factor * ((a * a + b * b) * (a + b)) * difference + 0.0
}

/// [`radiated_heat`] for finite inputs of extreme size, whose powers may leave the range of f64.
#[cold]
fn exact_radiated_heat(
    coefficient: RadiationCoefficient,
    view_factor: f64,
    absolute_zero: f64,
    temperatures: Temperatures,
) -> Scaled {
    let absolute = |temperature| Scaled::difference(temperature, absolute_zero);
    let (a, b) = (absolute(temperatures.slave), absolute(temperatures.master));
    let powers = (a * a + b * b) * (a + b) * temperatures.difference();
    Scaled::new(coefficient.0) * Scaled::new(view_factor) * powers
}
