//! The electrical outputs of columns have the bits of the scalar law; totals are the same for any number of threads and right to the last bit.

mod table_judge;

use inpact_evaluation::kernel::electrical::{
    ElectricalInputs, ElectricalOutputs, electrical_outputs, electrical_outputs_of_table,
};
use inpact_evaluation::kernel::{InstructionSet, TableKernel, blocks, total};
use inpact_evaluation::law::conductance::ConductanceTables;
use inpact_evaluation::law::contact::PotentialJump;
use inpact_evaluation::law::electrical::{Dissipation, ElectricalLaw};
use inpact_evaluation::law::heat::HeatGeneration;
use inpact_evaluation::numbers::CompensatedSum;
use inpact_evaluation::table::{PiecewiseTable, Tail};
use num_rational::BigRational;
use num_traits::Zero;
use proptest::prelude::*;
use table_judge::{Random, cases, exact, ulps_from};

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
            let mut asked = columns.iter_mut().enumerate().map(|(index, column)| (wanted >> index & 1 == 1).then_some(&mut column[..]));
            let mut next = || asked.next().flatten();
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

    #[test]
    fn totals_are_the_same_for_any_number_of_threads_and_any_instructions(seed in any::<u64>(), rows in 0_usize..20_000) {
        let mut random = Random::new(seed);
        let column: Vec<f64> = (0..rows).map(|_| random.positive(-60, 60) * [1.0, -1.0][random.below(2)]).collect();
        let expected = total::total_with(InstructionSet::Scalar, &column);
        for set in InstructionSet::available() {
            prop_assert_eq!(total::total_with(set, &column), expected, "{}", set);
        }
        for threads in [1, 2, 3, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            prop_assert_eq!(pool.install(|| total::total(&column)), expected, "{} threads", threads);
            let blocks = pool.install(|| blocks::map_blocks(rows, |rows| total::block_total(InstructionSet::best(), &column[rows])));
            let mut merged = CompensatedSum::default();
            for block in &blocks {
                merged.merge(block);
            }
            prop_assert_eq!(merged, expected, "blocks by {} threads", threads);
        }
    }
}

#[test]
fn totals_are_right_to_the_last_bit() {
    for seed in 0..20 {
        let mut random = Random::new(seed);
        let column: Vec<f64> = (0..10_000).map(|_| random.positive(-30, 30)).collect();
        let sum = column.iter().fold(BigRational::zero(), |sum, &term| sum + exact(term));
        let ulps = ulps_from(total::total(&column).total(), &sum);
        assert!(ulps <= 0.500_001, "{ulps}");
    }
}

#[test]
fn one_pass_over_a_table_gives_the_same_as_two() {
    let mut random = Random::new(5);
    let rows = 3 * 4096 + 77;
    let cells = [[9.0, 0.0, 300.0], [4.0, 1.0, 300.0], [1.0, 3.0, 300.0], [7.0, 0.0, 400.0], [2.0, 5.0, 400.0]];
    let table = TableKernel::new(&PiecewiseTable::from_rows(cells.as_flattened(), 3, Tail::Zero).unwrap());
    let clearance: Vec<f64> = (0..rows).map(|_| 6.0 * random.unit()).collect();
    let temperature: Vec<f64> = (0..rows).map(|_| 280.0 + 140.0 * random.unit()).collect();
    let jump = column(&mut random, rows, None);
    let columns: [&[f64]; 2] = [&clearance, &temperature];
    let inputs = ElectricalInputs { jump: &jump, jump_at_start: None, area: None };
    let generation = HeatGeneration::default();
    let mut expected_conductance = vec![0.0; rows];
    table.values(&columns, &mut expected_conductance);
    let mut expected = vec![0.0; rows];
    let mut outputs = ElectricalOutputs { heat: Some(&mut expected), ..Default::default() };
    electrical_outputs(InstructionSet::Scalar, generation, &expected_conductance, &inputs, &mut outputs);
    for set in InstructionSet::available() {
        let (mut conductance, mut heat) = (vec![0.0; rows], vec![0.0; rows]);
        let mut outputs = ElectricalOutputs { heat: Some(&mut heat), ..Default::default() };
        electrical_outputs_of_table(set, generation, (&table, &columns), &mut conductance, &inputs, &mut outputs);
        assert_eq!(bits(&conductance), bits(&expected_conductance), "{set}");
        assert_eq!(bits(&heat), bits(&expected), "{set}");
    }
}

#[test]
fn blocks_are_the_same_for_any_number_of_threads() {
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut column = vec![0_usize; 3 * blocks::ROWS + 5];
        pool.install(|| {
            blocks::for_each_block(&mut column, |rows, part| {
                assert_eq!(rows.len(), part.len());
                assert_eq!(rows.start % blocks::ROWS, 0);
                part.iter_mut().zip(rows).for_each(|(place, row)| *place = row);
            });
        });
        assert!(column.iter().enumerate().all(|(row, &place)| row == place));
    }
}
