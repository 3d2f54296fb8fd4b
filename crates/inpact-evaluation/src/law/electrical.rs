//! Electric current across an interface and the heat it generates: *GAP ELECTRICAL CONDUCTANCE.
//!
//! J = σ_g Δφ, Δφ = φ_slave − φ_master. J is positive leaving the slave surface (output ECD).
//!
//! The current dissipates P = J Δφ = σ_g Δφ² per area and time, of which q_g = η P becomes heat (output SJD):
//!
//! - steady state: q_g = η σ_g Δφ² with the values at the end of the increment (H-07);
//! - transient: q_g = (η σ_g / 3) (Δφ₁² + Δφ₁Δφ₀ + Δφ₀²), the mean over an increment in which Δφ runs linearly from Δφ₀ to Δφ₁, with σ_g at its end (H-08).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | σ_g | gap electrical conductance, by [`ConductanceTables`] | C T⁻¹ L⁻² φ⁻¹ |
//! | Δφ | jump of potential; Δφ₀, Δφ₁ at start and end of the increment | φ |
//! | J | current density | C T⁻¹ L⁻² |
//! | P, q_g | dissipation, heat | J T⁻¹ L⁻² |
//! | η, f | [`HeatGeneration`] | |
//!
//! Domain: σ_g >= 0, any finite jump; P and q_g are right wherever they are finite themselves, however large Δφ² or small σ_g.
//! Derivatives: ∂J/∂Δφ = σ_g, ∂J/∂x = (∂σ_g/∂x) Δφ with the slopes of the table (semantics 4.4: right-hand at an abscissa, zero outside).
//! Limits: Δφ₀ = Δφ₁ gives the steady form; σ_g = 0 no current and no heat.
//! Source: semantics H-01 to H-08; Analysis User's Guide 37.3.1 and 37.2.1, Theory Guide 5.2.6 (6.14).

use super::conductance::ConductanceTables;
use super::contact::PotentialJump;
use super::heat::{GeneratedHeat, HeatGeneration};
use crate::numbers::{Scaled, is_zero_or_ordinary};

/// The electrical law of one surface interaction.
#[derive(Clone, Debug)]
pub struct ElectricalLaw {
    /// σ_g against clearance, pressure, temperature and field variables.
    pub conductance: ConductanceTables,
    /// What becomes of the dissipated energy.
    pub heat_generation: HeatGeneration,
}

/// Over what the dissipation is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dissipation {
    /// At the end of the increment (H-07).
    Steady,
    /// The mean over the increment (H-08).
    Transient {
        /// Δφ₀, the jump at the start of the increment; in the first increment of a history the jump itself (C-25).
        jump_at_start: PotentialJump,
    },
}

impl ElectricalLaw {
    /// Current and heat for a conductance found with [`ConductanceTables::conductance`].
    #[inline]
    pub fn flow(&self, conductance: f64, jump: PotentialJump, dissipation: Dissipation) -> ElectricalFlow {
        flow(conductance, jump, dissipation, self.heat_generation)
    }

    /// [`reference_flow`] with the heat generation of this law.
    pub fn reference_flow(
        &self,
        value: f64,
        rest: f64,
        jump: PotentialJump,
        dissipation: Dissipation,
    ) -> ElectricalFlow {
        reference_flow((value, rest), jump, dissipation, self.heat_generation)
    }
}

/// Current and heat for a conductance, whatever gives it.
#[inline]
pub fn flow(
    conductance: f64,
    jump: PotentialJump,
    dissipation: Dissipation,
    generation: HeatGeneration,
) -> ElectricalFlow {
    ElectricalFlow {
        current_density: conductance * jump.0,
        heat: generated_heat(conductance, jump, dissipation, generation),
    }
}

/// [`flow`] in twice the precision of f64, each result rounded once, for a conductance of `value` + `rest` from the reference kernel.
///
/// Inputs that are infinite or NaN give what [`flow`] gives.
pub fn reference_flow(
    (value, rest): (f64, f64),
    jump: PotentialJump,
    dissipation: Dissipation,
    generation: HeatGeneration,
) -> ElectricalFlow {
    ExactFlow::new((value, rest), jump, dissipation, generation)
        .map_or_else(|| flow(value, jump, dissipation, generation), |exact| exact.rounded(generation))
}

/// Current and heat in twice the precision of f64 and without a limit to their size, for what they are multiplied with and summed up to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactFlow {
    /// J.
    pub current_density: Scaled,
    /// q_g.
    pub heat: Scaled,
}

impl ExactFlow {
    /// The flow for a conductance of `value` + `rest`; `None` where an input is infinite or NaN.
    pub fn new(
        (value, rest): (f64, f64),
        jump: PotentialJump,
        dissipation: Dissipation,
        generation: HeatGeneration,
    ) -> Option<Self> {
        let start = dissipation.jump_at_start(jump);
        let HeatGeneration { fraction, slave_weight } = generation;
        if ![value, rest, jump.0, start.0, fraction, slave_weight].iter().all(|input| input.is_finite()) {
            return None;
        }
        let conductance = Scaled::new(value) + Scaled::new(rest);
        Some(Self {
            current_density: conductance * Scaled::new(jump.0),
            heat: scaled_total(conductance, (jump.0, start.0), fraction),
        })
    }

    /// Each result rounded once.
    pub fn rounded(&self, generation: HeatGeneration) -> ElectricalFlow {
        ElectricalFlow { current_density: self.current_density.to_f64(), heat: shared(self.heat, generation) }
    }
}

impl Dissipation {
    /// Δφ₀ for an increment that ends with `jump`.
    fn jump_at_start(self, jump: PotentialJump) -> PotentialJump {
        match self {
            Self::Steady => jump,
            Self::Transient { jump_at_start } => jump_at_start,
        }
    }
}

/// What crosses the interface at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElectricalFlow {
    /// Current density J leaving the slave surface (output ECD).
    pub current_density: f64,
    /// Heat generated by it; `total` is output SJD.
    pub heat: GeneratedHeat,
}

/// The heat a current generates at the interface: q_g and its two shares.
#[inline]
pub fn generated_heat(
    conductance: f64,
    jump: PotentialJump,
    dissipation: Dissipation,
    generation: HeatGeneration,
) -> GeneratedHeat {
    let end = jump.0;
    let start = dissipation.jump_at_start(jump).0;
    let HeatGeneration { fraction, slave_weight } = generation;
    let inputs = [conductance, end, start, fraction, slave_weight];
    if !inputs.iter().all(|&input| is_zero_or_ordinary(input)) && inputs.iter().all(|input| input.is_finite()) {
        return scaled_heat(Scaled::new(conductance), (end, start), generation);
    }
    let mean_square = match dissipation {
        Dissipation::Steady => end * end,
        Dissipation::Transient { .. } => (end * end + end * start + start * start) / 3.0,
    };
    let total = fraction * (conductance * mean_square);
    GeneratedHeat { total, slave: slave_weight * total, master: (1.0 - slave_weight) * total }
}

/// [`generated_heat`] for finite inputs of any size, whose intermediate products may leave the range of f64; rounded once.
#[cold]
fn scaled_heat(conductance: Scaled, jumps: (f64, f64), generation: HeatGeneration) -> GeneratedHeat {
    shared(scaled_total(conductance, jumps, generation.fraction), generation)
}

/// q_g for the jumps at the end and at the start of an increment.
fn scaled_total(conductance: Scaled, (end, start): (f64, f64), fraction: f64) -> Scaled {
    let (end, start) = (Scaled::new(end), Scaled::new(start));
    let square_sum = end * end + end * start + start * start;
    Scaled::new(fraction) * conductance * (square_sum / Scaled::new(3.0))
}

/// A heat and the shares of both sides, each rounded once.
fn shared(total: Scaled, generation: HeatGeneration) -> GeneratedHeat {
    let slave_weight = Scaled::new(generation.slave_weight);
    GeneratedHeat {
        total: total.to_f64(),
        slave: (slave_weight * total).to_f64(),
        master: ((Scaled::new(1.0) + -slave_weight) * total).to_f64(),
    }
}
