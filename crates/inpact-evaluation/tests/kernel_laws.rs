//! The electrical outputs of columns have the bits of the scalar law.

mod table_judge;

use inpact_evaluation::law::{
    ConductanceTables, Dissipation, ElectricalInputs, ElectricalLaw, ElectricalOutputs, HeatGeneration, PotentialJump,
    electrical_outputs,
};
use inpact_evaluation::table::{InstructionSet, PiecewiseTable};
use proptest::prelude::*;
use table_judge::{Random, cases};

fn bits(column: &[f64]) -> Vec<u64> {
    // Which NaN a product gives is left open by the language.
    column.iter().map(|value| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() }).collect()
}

/// Numbers of ordinary size with, if `one_in` says so, some of any size, infinite or NaN.
fn column(random: &mut Random, rows: usize, one_in: Option<usize>) -> Vec<f64> {
    (0..rows)
        .map(|_| match one_in {
            Some(one_in) if random.below(one_in) == 0 => match random.below(6) {
                0 => [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][random.below(3)],
                _ => random.signed(),
            },
            _ if random.below(20) == 0 => [0.0, -0.0][random.below(2)],
            _ => random.positive(-40, 40) * [1.0, -1.0][random.below(2)],
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: u32::try_from(cases(150)).unwrap(), ..ProptestConfig::default() })]

    #[test]
    fn electrical_outputs_have_the_bits_of_the_law(
        seed in any::<u64>(),
        rows in 0_usize..1200,
        one_in in proptest::option::of(1_usize..2000),
        transient in any::<bool>(),
        wanted in 0_u32..64,
        fraction in prop_oneof![Just(1.0), Just(0.3), Just(1e300), Just(0.0)],
        slave_weight in prop_oneof![Just(0.5), Just(0.0), Just(1.0), Just(0.7)],
    ) {
        let mut random = Random::new(seed);
        let conductance = column(&mut random, rows, one_in);
        let jump = column(&mut random, rows, one_in);
        let start = column(&mut random, rows, one_in);
        let area = column(&mut random, rows, one_in);
        let generation = HeatGeneration { fraction, slave_weight };
        let law = ElectricalLaw { conductance: ConductanceTables::Clearance(PiecewiseTable::constant(1.0)), heat_generation: generation };
        let mut expected = vec![vec![0.0; rows]; 6];
        for row in 0..rows {
            let dissipation = if transient {
                Dissipation::Transient { jump_at_start: PotentialJump(start[row]) }
            } else {
                Dissipation::Steady
            };
            let flow = law.flow(conductance[row], PotentialJump(jump[row]), dissipation);
            let of_row = [
                flow.current_density,
                flow.current_density * area[row],
                flow.heat.total,
                flow.heat.total * area[row],
                flow.heat.slave,
                flow.heat.master,
            ];
            for (column, value) in expected.iter_mut().zip(of_row) {
                column[row] = value;
            }
        }
        for set in InstructionSet::available() {
            let mut columns = vec![vec![7.0; rows]; 6];
            let mut given = columns.iter_mut().enumerate().map(|(index, column)| (wanted >> index & 1 == 1).then_some(&mut column[..]));
            let mut next = || given.next().flatten();
            let mut outputs = ElectricalOutputs {
                current_density: next(),
                current: next(),
                heat: next(),
                heat_of_area: next(),
                heat_slave: next(),
                heat_master: next(),
            };
            let inputs = ElectricalInputs { jump: &jump, jump_at_start: transient.then_some(&start), area: Some(&area) };
            electrical_outputs(set, generation, &conductance, &inputs, &mut outputs);
            for (index, (column, expected)) in columns.iter().zip(&expected).enumerate() {
                if wanted >> index & 1 == 1 {
                    prop_assert_eq!(bits(column), bits(expected), "output {} with {}", index, set);
                } else {
                    prop_assert!(column.iter().all(|&value| value == 7.0), "output {} was not asked for", index);
                }
            }
        }
    }
}
