//! The laws of one interface row at one state: conductances, their slopes, and the heat and fluid generated there.
//!
//! | field | element from slave to master | sources |
//! |---|---|---|
//! | potential | σ A, current J A = σ A (φ_s − φ_m) | |
//! | temperature | (k + h_r) A with h_r = C F (θ_s'² + θ_m'²)(θ_s' + θ_m'), θ' from absolute zero: conduction and radiation are one conductance times one jump | heat of current and friction, shared by f |
//! | pore pressure | k A, infinite where no table is given | gap filling −w ḋ A and −(1 − w) ḋ A |
//!
//! The slopes of section 8 of the semantics: for a flow q = g Δ whose g depends on the mean of both sides, ½ g' Δ in addition to ± g.
//! Source: semantics T-20 to T-25, H-01 to H-08, K-41, P-30 to P-42, section 8.

use crate::scene::SceneInterface;
use inpact_evaluation::law::{
    BulkPermeabilities, Clearance, ContactPoint, ContactPressure, ContactState, Dissipation, ElectricalSource, Flow,
    Gap, GeneratedHeat, HeatGeneration, InterfaceLaws, PorePoint, PorePressure, PotentialJump, ShearStress, SlipRate,
    Temperatures, UserConductancePoint, UserFault, frictional_heat, generated_heat,
};
use inpact_evaluation::numbers::{DoubleDouble, product};

/// State of contact of a row at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Contact {
    pub(crate) clearance: Clearance,
    pub(crate) pressure: ContactPressure,
    pub(crate) state: ContactState,
}

/// Values on both sides of a row, at which its laws are evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sides {
    /// θ of slave and master; NaN where neither is known.
    pub(crate) temperatures: [DoubleDouble; 2],
    /// Pore pressures of slave and master.
    pub(crate) pore_pressures: [DoubleDouble; 2],
}

/// The mean of both sides, and its rounding error.
///
/// A steep table changes by more than a digit within the last digit of a large value: tables are evaluated at the number,
/// and its rounding error is added along their slope.
#[derive(Debug, Clone, Copy)]
struct Mean {
    number: f64,
    lost: f64,
}

impl Mean {
    fn of([slave, master]: [DoubleDouble; 2]) -> Self {
        let (number, lost) = (slave + master).times_power_of_two(-1).parts();
        Self { number, lost: if lost.is_finite() { lost } else { 0.0 } }
    }
}

/// A flow from slave to master per area: a conductance, and the parts of its slopes along the values of both sides other than ± the conductance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Conducts {
    pub(crate) conductance: f64,
    /// Along the mean temperature: ∂g/∂θ̄, of which each side contributes half.
    pub(crate) along_temperature: f64,
    /// Along the mean pore pressure.
    pub(crate) along_pore_pressure: f64,
    /// The part of radiation in the slopes along the temperatures of slave and master, other than that in the conductance.
    pub(crate) radiation_slopes: [f64; 2],
}

/// The element of a row in the network of pore fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PoreElement {
    /// Fluid crosses by a finite conductance; zero beyond the cutoff.
    Finite(Conducts),
    /// Both sides have one pore pressure.
    Constrained,
    /// It depends on the characteristic element length, which is not known.
    NeedsLength,
}

/// Heat of a current with its slopes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HeatOfCurrent {
    pub(crate) heat: GeneratedHeat,
    /// ∂q_g/∂Δφ.
    pub(crate) along_jump: f64,
    /// ∂q_g/∂σ.
    pub(crate) along_conductance: f64,
}

/// Time and increment at which a law is evaluated, for user subroutines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moment {
    pub(crate) time: f64,
    pub(crate) step_time: f64,
    pub(crate) increment: i32,
}

impl Contact {
    /// The contact of a row at a time; `None` where it is undetermined.
    pub(crate) fn of(row: &SceneInterface, time: f64) -> Option<Self> {
        let number = |course: &Option<crate::scene::Course>| course.as_ref().map(|course| course.at(time));
        let (clearance, pressure) = (number(&row.clearance), number(&row.pressure));
        let state = match row.closed {
            Some(true) => ContactState::Closed,
            Some(false) => ContactState::Open,
            None => {
                // Without pressure a row with unknown clearance may be open or closed.
                let of_clearance = match (clearance, pressure) {
                    (Some(clearance), _) => Clearance(clearance),
                    (None, Some(pressure)) if pressure != 0.0 => Clearance(f64::INFINITY),
                    _ => return None,
                };
                let of_pressure = ContactPressure(pressure.unwrap_or(0.0));
                ContactState::from_clearance_and_pressure(of_clearance, of_pressure)
            }
        };
        Some(Self {
            clearance: Clearance(clearance.unwrap_or(f64::NAN)),
            pressure: ContactPressure(pressure.unwrap_or(f64::NAN)),
            state,
        })
    }

    fn point<'a>(&self, variables: &'a [f64]) -> ContactPoint<'a> {
        ContactPoint { clearance: self.clearance, pressure: self.pressure, state: self.state, variables }
    }
}

/// The electrical conductance of a row.
///
/// # Errors
/// A routine of the user's gives what is no conductance.
pub(crate) fn electrical(
    source: &ElectricalSource,
    row: &SceneInterface,
    contact: &Contact,
    sides: &Sides,
    moment: Moment,
    node: i32,
) -> Result<Conducts, UserFault> {
    match source {
        ElectricalSource::Tables(tables) => {
            let temperature = Mean::of(sides.temperatures);
            let variables = variables(&[temperature.number], &row.field_variables);
            let point = contact.point(&variables);
            let mut slopes = vec![0.0; variables.len()];
            tables.slopes(&point, &mut slopes);
            let along_temperature = finite(slopes[0]);
            let conductance = corrected(tables.conductance(&point).value, &[(along_temperature, temperature)]);
            Ok(Conducts { conductance, along_temperature, ..Conducts::default() })
        }
        ElectricalSource::User(law, names) => {
            let fields: Vec<[f64; 2]> = row.field_variables.iter().map(|&value| [value; 2]).collect();
            let value = law.conductance(&UserConductancePoint {
                clearance: contact.clearance.0,
                temperatures: sides.temperatures.map(DoubleDouble::to_f64),
                field_variables: &fields,
                time: [moment.step_time, moment.time],
                names,
                coordinates: [[0.0; 3]; 2],
                node,
                step: 1,
                increment: moment.increment,
            })?;
            Ok(Conducts {
                conductance: value.conductance,
                along_temperature: value.slope_along_mean_temperature(),
                ..Conducts::default()
            })
        }
    }
}

/// The thermal conductance of a row: conduction and radiation together.
pub(crate) fn thermal(laws: &InterfaceLaws, row: &SceneInterface, contact: &Contact, sides: &Sides) -> Conducts {
    let mut conducts = Conducts::default();
    if let Some(law) = &laws.thermal {
        let temperature = Mean::of(sides.temperatures);
        let first = [temperature.number, row.mass_flow.map_or(f64::NAN, f64::abs)];
        let variables = variables(&first, &row.field_variables);
        let point = contact.point(&variables);
        let mut slopes = vec![0.0; variables.len()];
        law.slopes(&point, &mut slopes);
        conducts.along_temperature = finite(slopes[0]);
        conducts.conductance = corrected(law.conductance(&point).value, &[(conducts.along_temperature, temperature)]);
    }
    if let Some(law) = &laws.radiation {
        let (view_factor, _) = law.view_factor(contact.clearance, contact.state);
        let [a, b] = sides.temperatures.map(|temperature| temperature.to_f64() - law.absolute_zero);
        // Below absolute zero, which a Newton step may reach, nothing is radiated.
        let (a, b) = (a.max(0.0), b.max(0.0));
        let part = |powers: &[f64]| product(&[&[law.coefficient.0, view_factor], powers].concat());
        let radiation = part(&[a, a, a]) + part(&[a, a, b]) + part(&[a, b, b]) + part(&[b, b, b]);
        conducts.conductance += radiation;
        let slopes = law.heat_slopes(view_factor, Temperatures::of(a + law.absolute_zero, b + law.absolute_zero));
        conducts.radiation_slopes = [slopes.slave - radiation, slopes.master + radiation];
    }
    conducts
}

/// The heat that a current generates, per area.
pub(crate) fn heat_of_current(
    conductance: f64,
    jump: f64,
    jump_at_start: Option<f64>,
    generation: HeatGeneration,
) -> HeatOfCurrent {
    let dissipation = jump_at_start
        .map_or(Dissipation::Steady, |start| Dissipation::Transient { jump_at_start: PotentialJump(start) });
    let heat = generated_heat(conductance, PotentialJump(jump), dissipation, generation);
    let per_conductance = generated_heat(1.0, PotentialJump(jump), dissipation, generation).total;
    let factor = generation.fraction * conductance;
    let along_jump = match jump_at_start {
        None => 2.0 * factor * jump,
        Some(start) => factor / 3.0 * (2.0 * jump + start),
    };
    HeatOfCurrent { heat, along_jump: finite(along_jump), along_conductance: finite(per_conductance) }
}

/// The heat of friction of a row, per area; zero where the scene does not give it.
pub(crate) fn heat_of_friction(laws: &InterfaceLaws, row: &SceneInterface) -> Option<GeneratedHeat> {
    let (source, generation) = (laws.friction?, laws.heat_generation?);
    let (shear, slip_rate) = (row.shear?, source.slip_rate.or(row.slip_rate)?);
    let (shear, slip_rate) = if source.takes_magnitudes { (shear.abs(), slip_rate.abs()) } else { (shear, slip_rate) };
    Some(frictional_heat(ShearStress(shear), SlipRate(slip_rate), generation))
}

/// The pore fluid law of a row: its element, and the flows into slave and master out of the changing gap, per area.
pub(crate) fn pore(
    laws: &InterfaceLaws,
    row: &SceneInterface,
    contact: &Contact,
    sides: &Sides,
    (gap, length): (Gap, Option<f64>),
) -> (PoreElement, [f64; 2]) {
    let Some(law) = &laws.pore else { return (PoreElement::Finite(Conducts::default()), [0.0; 2]) };
    let [slave, master] = sides.pore_pressures.map(DoubleDouble::to_f64);
    let means = [sides.pore_pressures, sides.temperatures].map(Mean::of);
    let variables = variables(&means.map(|mean| mean.number), &row.field_variables);
    let bulk = match row.bulk_permeabilities {
        [Some(slave), Some(master)] => Some(BulkPermeabilities { slave, master }),
        _ => None,
    };
    let point = PorePoint {
        clearance: contact.clearance,
        pressure: contact.pressure,
        state: contact.state,
        slave: PorePressure(slave),
        master: PorePressure(master),
        jump: None,
        variables: &variables,
        characteristic_length: row.characteristic_length.or(length),
        bulk,
        gap,
        multiplier: None,
    };
    let flow = law.flow(&point);
    let filling = [flow.q_gap_slave(), flow.q_gap_master()];
    let (Flow::Active | Flow::CutOff, [Some(into_slave), Some(into_master)]) = (flow.across, filling) else {
        return (PoreElement::NeedsLength, [0.0; 2]);
    };
    let element = match flow.permeability {
        None => PoreElement::Constrained,
        Some(conductance) => {
            let mut slopes = vec![0.0; variables.len()];
            law.permeability_slopes(&point, &mut slopes);
            let [along_pore_pressure, along_temperature] = [slopes[0], slopes[1]].map(finite);
            let slopes = [(along_pore_pressure, means[0]), (along_temperature, means[1])];
            let conductance = corrected(conductance, &slopes);
            PoreElement::Finite(Conducts { conductance, along_temperature, along_pore_pressure, ..Conducts::default() })
        }
    };
    (element, [into_slave, into_master])
}

/// The variables of a table: some first ones, then the field variables.
fn variables(first: &[f64], field_variables: &[f64]) -> Vec<f64> {
    first.iter().chain(field_variables).copied().collect()
}

/// A conductance corrected for the rounding errors of its variables.
fn corrected(conductance: f64, slopes: &[(f64, Mean)]) -> f64 {
    let lost: f64 = slopes.iter().map(|(slope, mean)| slope * mean.lost).sum();
    let sum = conductance + lost;
    // A table that falls to zero there stays at zero; NaN stays NaN.
    if conductance == 0.0 || sum < 0.0 { 0.0 } else { sum }
}

/// A finite slope; at a jump there may be none.
fn finite(slope: f64) -> f64 {
    if slope.is_finite() { slope } else { 0.0 }
}
