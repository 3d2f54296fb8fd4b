//! The electrical outputs of a block of rows in one pass: current, heat, their shares and products with the area.
//!
//! Bitwise equal to [`ElectricalLaw::flow`](crate::law::electrical::ElectricalLaw::flow).
//! A chunk of rows with an extreme input falls back to that function, row by row; see `is_zero_or_ordinary`.

use super::InstructionSet;
use crate::law::contact::PotentialJump;
use crate::law::electrical::{Dissipation, generated_heat};
use crate::law::heat::HeatGeneration;
use crate::numbers::is_zero_or_ordinary;

/// The chunk size in rows, so that the output of one step is still in the L1 cache for the next.
const CHUNK: usize = 512;

/// The inputs of the electrical law in a block of rows, one column each.
#[derive(Clone, Copy, Debug)]
pub struct ElectricalInputs<'a> {
    /// Δφ, the jump of potential at the end of the increment.
    pub jump: &'a [f64],
    /// Δφ₀, that at its start (H-08); none in steady state (H-07).
    pub jump_at_start: Option<&'a [f64]>,
    /// The area of the slave node, which the outputs per node need.
    pub area: Option<&'a [f64]>,
}

/// The columns to be written, as long as the inputs; only these are computed.
#[derive(Debug, Default)]
pub struct ElectricalOutputs<'a> {
    /// Current density J (ECD).
    pub current_density: Option<&'a mut [f64]>,
    /// J times the area (ECDA).
    pub current: Option<&'a mut [f64]>,
    /// Heat q_g (SJD).
    pub heat: Option<&'a mut [f64]>,
    /// q_g times the area (SJDA).
    pub heat_of_area: Option<&'a mut [f64]>,
    /// Heat into the slave surface.
    pub heat_slave: Option<&'a mut [f64]>,
    /// Heat into the master surface.
    pub heat_master: Option<&'a mut [f64]>,
}

/// The outputs of rows with known conductance.
///
/// # Panics
/// If an input or output is shorter than `conductance`, or an output times the area is requested without one.
pub fn electrical_outputs(
    set: InstructionSet,
    generation: HeatGeneration,
    conductance: &[f64],
    inputs: &ElectricalInputs<'_>,
    outputs: &mut ElectricalOutputs<'_>,
) {
    let mut first = 0;
    while first < conductance.len() {
        let end = conductance.len().min(first + CHUNK);
        set.run(Chunk { generation, conductance: &conductance[first..end], inputs, first, outputs: &mut *outputs });
        first = end;
    }
}

/// At most [`CHUNK`] rows, those of `conductance`.
struct Chunk<'a, 'b> {
    generation: HeatGeneration,
    conductance: &'a [f64],
    inputs: &'a ElectricalInputs<'a>,
    /// The chunk's first row in the inputs and outputs.
    first: usize,
    outputs: &'a mut ElectricalOutputs<'b>,
}

impl super::instruction_set::Operation for Chunk<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call<L: super::Lanes>(self, _: L) {
        let Self { generation, conductance, inputs, first, outputs } = self;
        let count = conductance.len();
        let rows = first..first + count;
        let jump = &inputs.jump[rows.clone()];
        let start = inputs.jump_at_start.map(|start| &start[rows.clone()]);
        let area = inputs.area.map(|area| &area[rows.clone()]);
        if let Some(column) = &mut outputs.current_density {
            products(conductance, jump, &mut column[rows.clone()]);
        }
        if let Some(column) = &mut outputs.current {
            let area = area.expect("an output of a node needs its area");
            let column = &mut column[rows.clone()];
            for row in 0..count {
                column[row] = conductance[row] * jump[row] * area[row];
            }
        }
        let wants_heat = outputs.heat.is_some()
            || outputs.heat_of_area.is_some()
            || outputs.heat_slave.is_some()
            || outputs.heat_master.is_some();
        if !wants_heat {
            return;
        }
        let mut heat = [0.0; CHUNK];
        let heat = &mut heat[..count];
        let HeatGeneration { fraction, slave_weight } = generation;
        let is_plain = [fraction, slave_weight].into_iter().all(is_zero_or_ordinary)
            && all_ordinary(conductance)
            && all_ordinary(jump)
            && start.is_none_or(all_ordinary);
        if !is_plain {
            return extreme_heat(generation, conductance, (jump, start, area), rows, outputs);
        }
        match start {
            None => {
                for row in 0..count {
                    heat[row] = fraction * (conductance[row] * (jump[row] * jump[row]));
                }
            }
            Some(start) => {
                for row in 0..count {
                    let (end, start) = (jump[row], start[row]);
                    let mean_square = (end * end + end * start + start * start) / 3.0;
                    heat[row] = fraction * (conductance[row] * mean_square);
                }
            }
        }
        if let Some(column) = &mut outputs.heat {
            column[rows.clone()].copy_from_slice(heat);
        }
        if let Some(column) = &mut outputs.heat_of_area {
            let area = area.expect("an output of a node needs its area");
            products(heat, area, &mut column[rows.clone()]);
        }
        if let Some(column) = &mut outputs.heat_slave {
            column[rows.clone()].iter_mut().zip(&*heat).for_each(|(part, heat)| *part = slave_weight * heat);
        }
        if let Some(column) = &mut outputs.heat_master {
            let weight = 1.0 - slave_weight;
            column[rows].iter_mut().zip(&*heat).for_each(|(part, heat)| *part = weight * heat);
        }
    }
}

/// `a` times `b`, row by row.
#[inline(always)]
fn products(a: &[f64], b: &[f64], products: &mut [f64]) {
    for ((product, a), b) in products.iter_mut().zip(a).zip(b) {
        *product = a * b;
    }
}

/// Whether all rows are finite and of ordinary magnitude.
#[inline(always)]
fn all_ordinary(column: &[f64]) -> bool {
    column.iter().fold(true, |all, &number| all & is_zero_or_ordinary(number))
}

/// The heat of a chunk with an extreme input, by the scalar law.
#[cold]
fn extreme_heat(
    generation: HeatGeneration,
    conductance: &[f64],
    (jump, start, area): (&[f64], Option<&[f64]>, Option<&[f64]>),
    rows: std::ops::Range<usize>,
    outputs: &mut ElectricalOutputs<'_>,
) {
    for (index, row) in rows.enumerate() {
        let dissipation = match start {
            None => Dissipation::Steady,
            Some(start) => Dissipation::Transient { jump_at_start: PotentialJump(start[index]) },
        };
        let heat = generated_heat(conductance[index], PotentialJump(jump[index]), dissipation, generation);
        let heat_of_area = area.map_or(f64::NAN, |area| heat.total * area[index]);
        let columns = [
            (&mut outputs.heat, heat.total),
            (&mut outputs.heat_of_area, heat_of_area),
            (&mut outputs.heat_slave, heat.slave),
            (&mut outputs.heat_master, heat.master),
        ];
        for (column, value) in columns {
            if let Some(column) = column {
                column[row] = value;
            }
        }
    }
}
