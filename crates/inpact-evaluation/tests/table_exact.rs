//! Nested tables against exact rationals: random ragged tables of up to five axes, numbers over all decades.
//!
//! `INPACT_RANDOM_CASES=1000000 cargo test --release -p inpact-evaluation --test table_exact` measures the largest errors over a million queries.

mod table_judge;

use inpact_evaluation::numbers::ulp;
use table_judge::random_tables::{Range, compile, random_ending, random_point, random_rows};
use table_judge::{Ending, Random, Rows, cases, difference, exact, report, table_slope, table_value, ulps_from};

fn check_values(axes: usize, count: usize, range: Range) {
    let mut random = Random::new(0x7ab1e + u64::try_from(axes).unwrap());
    let mut worst = 0.0;
    let mut queries = 0;
    while queries < count {
        let rows = random_rows(&mut random, axes, range);
        let ending = random_ending(&mut random);
        let table = compile(&rows, ending);
        let greatest = rows.iter().map(|row| row[0]).fold(0.0, f64::max);
        let least = match ending {
            Ending::Zero => 0.0,
            Ending::Constant => rows.iter().map(|row| row[0]).fold(f64::INFINITY, f64::min),
        };
        for row in &rows {
            assert_eq!(table.value(&row[1..]), row[0], "a breakpoint is missed: {row:?} of {rows:?}");
        }
        for _ in 0..8 {
            queries += 1;
            let point = random_point(&mut random, &rows);
            let value = table.value(&point);
            let error = ulps_from(value, &table_value(&rows, &point, ending));
            assert!(error <= 2.0 * axes as f64, "off by {error} ulp: {value:e} at {point:?} of {rows:?}");
            assert!(
                least <= value && value <= greatest,
                "{value:e} outside {least:e} to {greatest:e} at {point:?} of {rows:?}"
            );
            worst = f64::max(worst, error);
        }
    }
    report(&format!("{axes} axes"), &format!("largest error {worst:.4} ulp over {queries} queries"));
}

#[test]
fn one_axis_is_within_two_ulp() {
    check_values(1, cases(8_000), Range::AllDecades);
}

#[test]
fn two_axes_are_within_four_ulp() {
    check_values(2, cases(3_000), Range::AllDecades);
}

#[test]
fn three_axes_are_within_six_ulp() {
    check_values(3, cases(1_000), Range::AllDecades);
}

#[test]
fn four_axes_are_within_eight_ulp() {
    check_values(4, cases(300), Range::AllDecades);
}

#[test]
fn five_axes_are_within_ten_ulp() {
    check_values(5, cases(100), Range::AllDecades);
}

#[test]
fn ordinary_tables_keep_the_same_bounds() {
    for axes in 1..=4 {
        check_values(axes, cases(1_000), Range::Ordinary);
    }
}

/// From one f64 to the next along any axis the value follows the exact one to an ulp.
#[test]
fn monotone_to_one_ulp_along_every_axis() {
    let mut random = Random::new(0x30203);
    for round in 0..cases(1_500) {
        let axes = 1 + round % 3;
        let range = if random.below(2) == 0 { Range::AllDecades } else { Range::Ordinary };
        let rows = random_rows(&mut random, axes, range);
        let table = compile(&rows, Ending::Constant);
        let point = random_point(&mut random, &rows);
        let axis = random.below(axes);
        let mut before = (table.value(&point), table_value(&rows, &point, Ending::Constant));
        let mut moved = point.clone();
        for _ in 0..3 {
            moved[axis] = moved[axis].next_up().min(f64::MAX);
            let after = (table.value(&moved), table_value(&rows, &moved, Ending::Constant));
            let turn = if before.1 <= after.1 { before.0 - after.0 } else { after.0 - before.0 };
            assert!(
                turn <= ulp(before.0.max(after.0)),
                "from {:e} to {:e} along axis {axis} at {moved:?} of {rows:?}",
                before.0,
                after.0
            );
            before = after;
        }
    }
}

/// A table of one axis whose rows rise never falls by more than an ulp, within its segments and across its knots.
#[test]
fn a_rising_table_rises_everywhere() {
    let mut random = Random::new(0x415e5);
    for _ in 0..cases(400) {
        let mut rows = random_rows(&mut random, 1, Range::AllDecades);
        let mut values: Vec<f64> = rows.iter().map(|row| row[0]).collect();
        values.sort_by(f64::total_cmp);
        for (row, value) in rows.iter_mut().zip(values) {
            row[0] = value;
        }
        let table = compile(&rows, Ending::Constant);
        let mut queries: Vec<f64> = (0..40).map(|_| random_point(&mut random, &rows)[0]).collect();
        queries.sort_by(f64::total_cmp);
        for pair in queries.windows(2) {
            let (before, after) = (table.value(&pair[..1]), table.value(&pair[1..]));
            assert!(before - after <= ulp(before), "falls between {pair:?} of {rows:?}");
        }
    }
}

/// Slopes against the exact slopes of the exact function: to the rounding of the values they are differences of.
#[test]
fn slopes_follow_the_exact_slopes() {
    let mut random = Random::new(0x510be);
    for round in 0..cases(1_500) {
        let axes = 1 + round % 3;
        let rows = random_rows(&mut random, axes, Range::Ordinary);
        let ending = random_ending(&mut random);
        let table = compile(&rows, ending);
        let point = random_point(&mut random, &rows);
        let mut slopes = vec![f64::NAN; axes];
        let value = table.value_and_slopes(&point, &mut slopes);
        assert_eq!(value, table.value(&point));
        let greatest = rows.iter().map(|row| row[0]).fold(0.0, f64::max);
        for (axis, slope) in slopes.into_iter().enumerate() {
            let least_width = 2f64.powi(-9);
            let tolerance = 16.0 * ulp(greatest) / least_width;
            let error = difference(&exact(slope), &table_slope(&rows, &point, axis, ending)).abs();
            assert!(
                error <= tolerance,
                "slope {slope:e} along axis {axis} is off by {error:e} at {point:?} of {rows:?}"
            );
        }
    }
}

/// On one axis each slope is the rounded slope of its segment, over all decades.
#[test]
fn slope_of_one_axis_is_rounded_once() {
    let mut random = Random::new(0x51);
    for _ in 0..cases(2_000) {
        let rows = random_rows(&mut random, 1, Range::AllDecades);
        let table = compile(&rows, Ending::Constant);
        let point = random_point(&mut random, &rows);
        let slope = table.slope_at(0, point[0], &[]);
        if slope.is_finite() {
            let error = ulps_from(slope, &table_slope(&rows, &point, 0, Ending::Constant));
            assert!(error <= 0.500_001, "slope {slope:e} is off by {error} ulp at {point:?} of {rows:?}");
        }
    }
}

/// Slopes against differences of the values themselves, inside a cell where the function is linear along each axis.
#[test]
fn slopes_are_those_of_the_values() {
    let mut random = Random::new(0xd1ff);
    let grid = [0.0, 1.0, 3.0, 7.0];
    for _ in 0..300 {
        let mut rows = Rows::new();
        for z in &grid[..2] {
            for y in &grid[..3] {
                for x in grid {
                    rows.push(vec![1.0 + 9.0 * random.unit(), x, *y, *z]);
                }
            }
        }
        let table = compile(&rows, Ending::Constant);
        let corner = [grid[random.below(3)], grid[random.below(2)], 0.0];
        let point = corner.map(|start| start + 0.25 + 0.25 * random.unit());
        let mut slopes = [0.0; 3];
        let value = table.value_and_slopes(&point, &mut slopes);
        for axis in 0..3 {
            let mut moved = point;
            moved[axis] += 0.25;
            let from_values = (table.value(&moved) - value) / (moved[axis] - point[axis]);
            assert!(
                (from_values - slopes[axis]).abs() <= 1e-12,
                "{from_values} and {} along axis {axis}",
                slopes[axis]
            );
        }
    }
}
