//! Contributions of rows to the integrals of current and heat, by column: each is a product with the duration and its rounding error.

#![expect(
    clippy::inline_always,
    reason = "what is not inlined is compiled without the instruction set that was asked for"
)]

use crate::kernel::scan::are_moderate;
use crate::kernel::{InstructionSet, Lanes, Operation};

/// A product, rounded, and its rounding error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Step {
    pub(crate) product: f64,
    pub(crate) error: f64,
}

impl Step {
    #[inline(always)]
    fn of(rate: f64, duration: f64) -> Self {
        let product = rate * duration;
        Self { product, error: rate.mul_add(duration, -product) }
    }
}

/// The steps of a row: of the current density, of its rounding error, and of the heat; each per area, and times the area of the node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ElectricalSteps {
    pub(super) current: [Step; 2],
    pub(super) rest: [Step; 2],
    pub(super) heat: [Step; 2],
}

/// The steps of some rows.
#[derive(Debug, Default)]
pub(crate) struct StepColumns {
    pub(crate) rows: Vec<ElectricalSteps>,
    /// What rounding took away from the current densities.
    rests: Vec<f64>,
}

impl StepColumns {
    /// Finds the steps of some rows, from conductance and jump, the resulting current density and heat, duration and area;
    /// false where a number is not moderate, so that plain arithmetic may be inaccurate.
    pub(crate) fn find(
        &mut self,
        [conductance, jump]: [&[f64]; 2],
        [current, heat]: [&[f64]; 2],
        [durations, area]: [&[f64]; 2],
    ) -> bool {
        self.rests.resize(current.len(), 0.0);
        self.rows.resize(current.len(), ElectricalSteps::default());
        let (rests, steps) = (&mut self.rests, &mut self.rows);
        let set = InstructionSet::best();
        set.run(FindRests { conductance, jump, current, rests });
        let is_plain = [current, heat, durations, area, rests].into_iter().all(are_moderate);
        if is_plain {
            set.run(FindSteps { current, rests, heat, durations, area, steps });
        }
        is_plain
    }
}

/// The rounding errors of current densities; 0 where that is not known.
struct FindRests<'a> {
    conductance: &'a [f64],
    jump: &'a [f64],
    current: &'a [f64],
    rests: &'a mut [f64],
}

impl Operation for FindRests<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes>(self, _: L) {
        let inputs = self.conductance.iter().zip(self.jump).zip(self.current);
        for (rest, ((conductance, jump), current)) in self.rests.iter_mut().zip(inputs) {
            let found = conductance.mul_add(*jump, -current);
            *rest = if found.is_finite() { found } else { 0.0 };
        }
    }
}

struct FindSteps<'a> {
    current: &'a [f64],
    rests: &'a [f64],
    heat: &'a [f64],
    durations: &'a [f64],
    area: &'a [f64],
    steps: &'a mut [ElectricalSteps],
}

impl Operation for FindSteps<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes>(self, _: L) {
        let rates = self.current.iter().zip(self.rests).zip(self.heat);
        let factors = self.durations.iter().zip(self.area);
        for (steps, (((current, rest), heat), (duration, area))) in self.steps.iter_mut().zip(rates.zip(factors)) {
            let both = |rate: f64| [Step::of(rate, *duration), Step::of(rate * area, *duration)];
            *steps = ElectricalSteps { current: both(*current), rest: both(*rest), heat: both(*heat) };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::{ClosingHeat, ElectricalHistory, HistoryStart};
    use crate::law::contact::PotentialJump;
    use crate::law::electrical::ElectricalFlow;
    use crate::law::heat::GeneratedHeat;

    /// Steps by column give the same integrals as row by row, bit for bit.
    #[test]
    fn steps_add_up_as_rows_do() {
        let mut state = 1_u64;
        let mut chance = || {
            state = state.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for size in [1.0, 1e-6, 1e15] {
            let mut column = |sign: f64| (0..100).map(|_| (chance() - sign) * size).collect::<Vec<f64>>();
            let (conductance, jump, heat, area) = (column(0.0), column(0.5), column(0.0), column(0.0));
            let current: Vec<f64> = conductance.iter().zip(&jump).map(|(c, j)| c * j).collect();
            let mut by_rows = ElectricalHistory::new(HistoryStart::FirstRow, ClosingHeat::Manual);
            let mut by_steps = by_rows.clone();
            let begun: Vec<_> = (0..100_u32)
                .map(|row| by_rows.begin(f64::from(row) / 3.0, PotentialJump(jump[row as usize]), 1.0))
                .collect();
            let durations: Vec<f64> = begun.iter().map(|increment| increment.duration.unwrap_or(0.0)).collect();
            let mut steps = StepColumns::default();
            assert!(steps.find([&conductance, &jump], [&current, &heat], [&durations, &area]), "all is moderate");
            for (row, steps) in steps.rows.iter().enumerate() {
                let heat = GeneratedHeat { total: heat[row], slave: 0.0, master: 0.0 };
                let flow = ElectricalFlow { current_density: current[row], heat };
                let rest = conductance[row].mul_add(jump[row], -current[row]);
                by_rows.finish(&begun[row], &flow, rest, Some(area[row]));
                by_steps.add_steps(steps);
                let integrals = |of: &ElectricalHistory| {
                    [Some(of.current()), of.current_of_area(), Some(of.heat()), of.heat_of_area()]
                        .map(|value| value.map(f64::to_bits))
                };
                assert_eq!(integrals(&by_rows), integrals(&by_steps), "row {row} of size {size}");
            }
        }
        assert!(!StepColumns::default().find([&[1e200], &[1.0]], [&[1e200], &[1.0]], [&[1.0], &[1.0]]));
    }
}
