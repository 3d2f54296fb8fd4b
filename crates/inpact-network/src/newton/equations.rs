//! The equations of a Newton step: matrix, slopes, pseudo-capacities and units of fields.

use super::Newton;
use super::system::{Evaluated, System};
use crate::knowledge::Knowledge;
use crate::linear::{NONE, each_part, index};
use crate::scene::Field;
use faer::sparse::Triplet;
use inpact_evaluation::numbers::{DoubleDouble, exponent_of, scale_by_power};
use std::cell::LazyCell;

/// The equations of a step of all fields.
pub(super) struct StepEquations {
    pub(super) entries: Vec<Triplet<u32, u32, f64>>,
    pub(super) right: Vec<f64>,
    /// The pseudo-capacity of each equation; empty where none has one.
    pub(super) pseudo_capacity: Vec<f64>,
    /// The factor of each field's unknowns.
    pub(super) scale: [f64; 3],
}

/// The slopes included in a step.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Slopes {
    All,
    /// Conductances and heat are frozen.
    Held,
}

impl<'a> Newton<'a> {
    /// The equations of a step.
    pub(super) fn equations(
        &self,
        knowledge: &Knowledge<'a>,
        states: &[Evaluated],
        slopes: Slopes,
        pseudo_capacity: f64,
    ) -> StepEquations {
        let count = self.fields.last().map_or(0, |last| last.start as usize + last.edges.form.count());
        let mut entries: Vec<Triplet<u32, u32, f64>> = Vec::new();
        let mut right = vec![0.0; count];
        for (system, state) in self.fields.iter().zip(states) {
            let start = system.start;
            each_part(&system.core, &system.edges, |row, column, part| {
                entries.push(Triplet::new(start + row, start + column, part));
                if row != column {
                    entries.push(Triplet::new(start + column, start + row, part));
                }
            });
            let missing = state.balance.missing();
            for (unknown, flow) in (0..).zip(missing) {
                right[(start + unknown) as usize] = scale_by_power(flow, -system.half(unknown));
            }
            if slopes == Slopes::All {
                self.slopes_of_flows(system, state, knowledge, &mut entries);
                self.slopes_of_heat(system, state, knowledge, &mut entries);
            }
        }
        let pseudo_capacity =
            if pseudo_capacity > 0.0 { self.add_pseudo_capacities(pseudo_capacity, &mut entries) } else { Vec::new() };
        let scale = balance_fields(&self.fields, &mut entries, &mut right);
        StepEquations { entries, right, pseudo_capacity, scale }
    }

    /// Gives each equation of temperature and pore pressure a pseudo-capacity of this multiple of the magnitudes of all its slopes; returns them.
    pub(super) fn add_pseudo_capacities(&self, times: f64, entries: &mut Vec<Triplet<u32, u32, f64>>) -> Vec<f64> {
        let all = self.fields.last().map_or(0, |last| last.start as usize + last.edges.form.count());
        let mut pseudo_capacity = vec![0.0; all];
        for system in self.fields.iter().filter(|system| system.field != Field::Potential) {
            let count = index(system.edges.form.count());
            let is_own = |unknown: u32| (system.start..system.start + count).contains(&unknown);
            let mut sums = vec![0.0; count as usize];
            for entry in entries.iter().filter(|entry| is_own(entry.row) && is_own(entry.col)) {
                sums[(entry.row - system.start) as usize] += entry.val.abs();
            }
            for (unknown, sum) in (system.start..).zip(sums) {
                pseudo_capacity[unknown as usize] = times * sum;
                entries.push(Triplet::new(unknown, unknown, times * sum));
            }
        }
        pseudo_capacity
    }

    /// The part of the slopes of flows through rows that comes from the dependence of conductances.
    pub(super) fn slopes_of_flows(
        &self,
        system: &System<'a>,
        state: &Evaluated,
        knowledge: &Knowledge<'_>,
        entries: &mut Vec<Triplet<u32, u32, f64>>,
    ) {
        // Jumps that no flow determines need the values of all nodes, which are assembled once, where a row uses them.
        let values = LazyCell::new(|| system.values());
        for (place, &row) in system.nodes.rows.iter().enumerate() {
            let (conducts, of) = (state.terms.slopes[place], knowledge.row(row));
            let slopes = [conducts.along_temperature, conducts.along_pore_pressure];
            if slopes.iter().chain(&conducts.radiation_slopes).all(|slope| *slope == 0.0) {
                continue;
            }
            let flow = system.nodes.links.len() + place;
            let element = system.origins.of_link[flow];
            if element == NONE {
                continue;
            }
            let conductance = state.terms.conductances[place];
            let jump = if conductance > 0.0 {
                (state.flows[flow] / DoubleDouble::new(conductance)).to_f64()
            } else {
                system.jump_of_values(&values, of.slave, of.master)
            };
            let common = 0.5 * conducts.along_temperature * jump * of.area;
            let radiation = conducts.radiation_slopes.map(|slope| slope * of.area);
            let of_own = 0.5 * conducts.along_pore_pressure * jump * of.area;
            let mut couple = |other: Field, slopes: [f64; 2]| {
                let Some(other) = self.fields.iter().find(|system| system.field == other) else { return };
                for (node, slope) in of.nodes().into_iter().zip(slopes) {
                    if slope == 0.0 {
                        continue;
                    }
                    other.on_value(node, |column, factor| {
                        system.on_element(element, |row, sign| {
                            entries.push(Triplet::new(row, column, sign * factor(slope)));
                        });
                    });
                }
            };
            couple(Field::Temperature, [common + radiation[0], common + radiation[1]]);
            couple(Field::PorePressure, [of_own; 2]);
        }
    }

    /// The slopes of the heat of currents in the equations of temperature.
    pub(super) fn slopes_of_heat(
        &self,
        system: &System<'a>,
        state: &Evaluated,
        knowledge: &Knowledge<'_>,
        entries: &mut Vec<Triplet<u32, u32, f64>>,
    ) {
        let Some(potential) = self.fields.iter().find(|system| system.field == Field::Potential) else { return };
        for term in &state.heat {
            let element = potential.origins.of_link[term.flow];
            for &(place, share) in &term.nodes {
                system.on_place(place, |row, into| {
                    if element != NONE {
                        potential.on_jump(element, |column, factor| {
                            entries.push(Triplet::new(row, column, -into(factor(share * term.along_jump))));
                        });
                    }
                    let slope = share * term.along_temperatures;
                    let of_row = term.flow.checked_sub(potential.nodes.links.len());
                    if let Some(of_row) = of_row.filter(|_| slope != 0.0) {
                        let of = knowledge.row(potential.nodes.rows[of_row]);
                        for node in of.nodes() {
                            system.on_value(node, |column, factor| {
                                entries.push(Triplet::new(row, column, -into(factor(slope))));
                            });
                        }
                    }
                });
            }
        }
    }
}

/// Chooses the unit of each field so that the coupling of two fields has equal magnitude in both directions; returns the factors.
pub(super) fn balance_fields(
    fields: &[System<'_>],
    entries: &mut [Triplet<u32, u32, f64>],
    right: &mut [f64],
) -> [f64; 3] {
    let mut scale = [1.0; 3];
    let [first, second] = fields else { return scale };
    let is_first = |unknown: u32| unknown < second.start;
    let largest = |of_first_row: bool| {
        let coupling = entries
            .iter()
            .filter(|entry| is_first(entry.row) == of_first_row && is_first(entry.row) != is_first(entry.col));
        coupling.fold(0.0, |largest: f64, entry| largest.max(entry.val.abs()))
    };
    let (upper, lower) = (largest(true), largest(false));
    if upper > 0.0 && lower > 0.0 && upper.is_finite() && lower.is_finite() {
        let exponent = (exponent_of(upper) - exponent_of(lower)) / 2;
        let factor = scale_by_power(1.0, exponent.clamp(-1000, 1000));
        for entry in entries.iter_mut() {
            match (is_first(entry.row), is_first(entry.col)) {
                (true, false) => entry.val /= factor,
                (false, true) => entry.val *= factor,
                _ => {}
            }
        }
        for unknown in 0..second.start {
            right[unknown as usize] /= factor;
        }
        scale[first.field.index()] = factor;
    }
    scale
}
