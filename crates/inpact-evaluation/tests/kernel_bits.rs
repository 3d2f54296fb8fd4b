//! The kernels give the bits of the scalar functions, with every instruction set of the machine.

mod table_judge;

use inpact_evaluation::table::{InstructionSet, PiecewiseTable, Search, Sides, TableKernel, Tail};
use proptest::prelude::*;
use table_judge::{Random, cases};

/// Which numbers a table is made of.
#[derive(Clone, Copy, Debug)]
enum Numbers {
    /// All decades, both signs, subnormal numbers, neighbours one ulp apart.
    Any,
    /// Abscissae from 0, values of one sign.
    Uniform,
    /// Abscissae over many decades.
    Logarithmic,
}

fn knots(random: &mut Random, numbers: Numbers, count: usize) -> Vec<f64> {
    let mut knots = Vec::with_capacity(count);
    let mut x = match numbers {
        Numbers::Any => random.signed().min(1e308),
        Numbers::Uniform => [0.0, -0.0, -3.0][random.below(3)],
        Numbers::Logarithmic => random.positive(-40, -20),
    };
    for _ in 0..count {
        knots.push(x);
        let next = match numbers {
            Numbers::Any => random.above(x),
            Numbers::Uniform => x + 0.01 + random.unit(),
            Numbers::Logarithmic => x * (1.0 + random.unit()),
        };
        if next <= x || !next.is_finite() {
            break;
        }
        x = next;
    }
    knots
}

fn value(random: &mut Random, numbers: Numbers) -> f64 {
    match (numbers, random.below(12)) {
        (_, 0) => 0.0,
        (Numbers::Any, 1) => -0.0,
        (Numbers::Any, _) => random.signed(),
        _ => random.positive(-20, 20),
    }
}

/// Rows of a table: along each axis all groups have the abscissae of `common`, or each its own, sometimes only one.
fn rows(
    random: &mut Random,
    numbers: Numbers,
    common: &[Option<Vec<f64>>],
    counts: &[usize],
    outer: &[f64],
    cells: &mut Vec<f64>,
) {
    let axes = common.len();
    let Some((common_knots, inside)) = common.split_last() else {
        cells.push(value(random, numbers));
        cells.extend(outer);
        return;
    };
    let most = counts[axes - 1];
    let count = if random.below(5) == 0 { 1 } else { 1 + random.below(most) };
    let count = if axes == counts.len() && axes == 1 { most } else { count };
    for knot in common_knots.clone().unwrap_or_else(|| knots(random, numbers, count)) {
        let outer: Vec<f64> = std::iter::once(knot).chain(outer.iter().copied()).collect();
        rows(random, numbers, inside, counts, &outer, cells);
    }
}

/// A table and, for each axis, the abscissae it was made of.
struct Sample {
    table: PiecewiseTable,
    abscissae: Vec<Vec<f64>>,
}

fn sample(random: &mut Random, numbers: Numbers, counts: &[usize]) -> Sample {
    let mut cells = Vec::new();
    let common: Vec<Option<Vec<f64>>> = counts
        .iter()
        .map(|&count| (counts.len() > 1 && random.below(2) == 0).then(|| knots(random, numbers, count)))
        .collect();
    rows(random, numbers, &common, counts, &[], &mut cells);
    let width = counts.len() + 1;
    let tail = [Tail::Constant, Tail::Zero][random.below(2)];
    let table = PiecewiseTable::from_rows(&cells, width, tail).expect("the rows ascend");
    let abscissae = (1..width).map(|column| cells.iter().skip(column).step_by(width).copied().collect()).collect();
    Sample { table, abscissae }
}

/// Coordinates at and beside knots, between them, outside, and what is no number.
fn queries(random: &mut Random, abscissae: &[f64], count: usize) -> Vec<f64> {
    let pick = |random: &mut Random| abscissae[random.below(abscissae.len())];
    (0..count)
        .map(|_| match random.below(16) {
            0 => [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY][random.below(4)],
            1..=3 => pick(random),
            4 => pick(random).next_up(),
            5 => pick(random).next_down(),
            6 => -pick(random),
            7 => random.signed(),
            8 => f64::from_bits(random.bits()),
            _ => {
                let index = random.below(abscissae.len());
                let (a, b) = (abscissae[index], abscissae[(index + 1) % abscissae.len()]);
                random.within(a.min(b), a.max(b))
            }
        })
        .collect()
}

/// Compares every instruction set with the scalar function, value and sides, bit for bit.
fn compare(sample: &Sample, random: &mut Random, rows: usize) {
    let Sample { table, abscissae } = sample;
    let columns: Vec<Vec<f64>> = abscissae.iter().map(|knots| queries(random, knots, rows)).collect();
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let kernel = TableKernel::new(table);
    let expected: Vec<(f64, Sides)> = (0..rows)
        .map(|row| {
            let point: Vec<f64> = columns.iter().map(|column| column[row]).collect();
            table.value_and_sides_at(point[0], &point[1..])
        })
        .collect();
    for set in InstructionSet::available() {
        let mut values = vec![1.0; rows];
        let mut values_beside_sides = vec![1.0; rows];
        let mut sides = vec![Sides::default(); rows];
        kernel.values_with(set, &columns, &mut values);
        kernel.values_and_sides_with(set, &columns, &mut values_beside_sides, &mut sides);
        for row in 0..rows {
            let point: Vec<f64> = columns.iter().map(|column| column[row]).collect();
            let (value, value_sides) = expected[row];
            let place = || format!("{set}, {:?}, row {row} at {point:?}, {table:?}", kernel.search());
            assert_eq!(values[row].to_bits(), value.to_bits(), "{} is not {value:e}: {}", values[row], place());
            assert_eq!(values_beside_sides[row].to_bits(), value.to_bits(), "beside sides: {}", place());
            assert_eq!(sides[row], value_sides, "{}", place());
        }
    }
}

fn numbers() -> impl Strategy<Value = Numbers> {
    prop_oneof![Just(Numbers::Any), Just(Numbers::Uniform), Just(Numbers::Logarithmic)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: u32::try_from(cases(300)).unwrap(), ..ProptestConfig::default() })]

    #[test]
    fn small_tables_of_one_axis(seed in any::<u64>(), numbers in numbers(), knots in 1_usize..=17) {
        let mut random = Random::new(seed);
        let sample = sample(&mut random, numbers, &[knots]);
        compare(&sample, &mut random, 300);
    }

    #[test]
    fn tables_of_one_axis(seed in any::<u64>(), numbers in numbers(), decades in 0_u32..=11) {
        let mut random = Random::new(seed);
        let knots = 1 + random.below(1 << decades);
        let sample = sample(&mut random, numbers, &[knots]);
        compare(&sample, &mut random, 700);
    }

    #[test]
    fn tables_of_several_axes(seed in any::<u64>(), numbers in numbers(), counts in proptest::collection::vec(1_usize..=7, 2..=4)) {
        let mut random = Random::new(seed);
        let sample = sample(&mut random, numbers, &counts);
        compare(&sample, &mut random, 530);
    }
}

#[test]
fn two_thousand_knots() {
    for (seed, numbers) in [Numbers::Any, Numbers::Uniform, Numbers::Logarithmic].into_iter().enumerate() {
        let mut random = Random::new(seed as u64);
        let sample = sample(&mut random, numbers, &[2000]);
        compare(&sample, &mut random, 20_000);
    }
}

#[test]
fn the_search_fits_the_abscissae() {
    let search = |knots: &[f64]| {
        let cells: Vec<f64> = knots.iter().flat_map(|&knot| [1.0 + knot.abs(), knot]).collect();
        TableKernel::new(&PiecewiseTable::from_rows(&cells, 2, Tail::Constant).unwrap()).search()
    };
    let uniform: Vec<f64> = (0..100).map(f64::from).collect();
    let logarithmic: Vec<f64> = (0..100).map(|power| 2_f64.powi(power)).collect();
    // Knots that are close together by any measure, beside one far away.
    let mut clustered: Vec<f64> = std::iter::successors(Some(1.0_f64), |x| Some(x.next_up())).take(100).collect();
    clustered.extend([2.0, 1e300]);
    assert_eq!(search(&uniform), Search::LinearBuckets);
    assert_eq!(search(&logarithmic), Search::BitBuckets);
    assert_eq!(search(&clustered), Search::Bisection);
    assert_eq!(search(&[1.0]), Search::Constant);
    if InstructionSet::best() == InstructionSet::Avx512 {
        assert_eq!(search(&uniform[..16]), Search::Registers);
    }
}

#[test]
fn rows_of_any_count_and_columns_that_do_not_matter() {
    let cells = [[1.0, 0.0, 5.0], [2.0, 1.0, 5.0], [4.0, 3.0, 5.0]];
    let table = PiecewiseTable::from_rows(cells.as_flattened(), 3, Tail::Zero).unwrap();
    let kernel = TableKernel::new(&table);
    for rows in [0, 1, 7, 8, 9, 127, 128, 129, 255, 256, 257, 1000] {
        let column: Vec<f64> = (0..rows).map(|row| f64::from(row) * 0.01).collect();
        let mut values = vec![f64::NAN; column.len()];
        for set in InstructionSet::available() {
            kernel.values_with(set, &[&column, &[]], &mut values);
            let expected: Vec<f64> = column.iter().map(|&x| table.value_at(x, &[])).collect();
            assert_eq!(values, expected);
        }
    }
}
