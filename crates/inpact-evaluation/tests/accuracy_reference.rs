//! The reference mode against exact rationals: random ragged tables of one to four axes, numbers over all decades.

mod table_judge;

use inpact_evaluation::table::{PiecewiseTable, Tail, full_bound};
use num_traits::Signed;
use table_judge::random_tables::{Range, compile, random_ending, random_point, random_rows};
use table_judge::{Random, cases, exact, report, table_value, ulps_from};

fn check_reference(axes: usize, count: usize, range: Range) {
    let mut random = Random::new(0x2ef + u64::try_from(axes).unwrap());
    let mut worst = 0.0;
    let mut queries = 0;
    while queries < count {
        let rows = random_rows(&mut random, axes, range);
        let ending = random_ending(&mut random);
        let table = compile(&rows, ending);
        for row in &rows {
            assert_eq!(table.reference_value_at(row[1], &row[2..]), row[0], "a breakpoint is missed: {row:?}");
        }
        for _ in 0..8 {
            queries += 1;
            let point = random_point(&mut random, &rows);
            let value = table.reference_value_at(point[0], &point[1..]);
            let error = ulps_from(value, &table_value(&rows, &point, ending));
            assert!(error <= 0.501, "off by {error} ulp: {value:e} at {point:?} of {rows:?}");
            worst = f64::max(worst, error);
        }
    }
    assert!(worst > 0.3, "nothing was rounded: {worst}");
    report(&format!("{axes} axes"), &format!("largest error {worst:.6} ulp over {queries} queries"));
}

#[test]
fn one_axis_is_rounded_once() {
    check_reference(1, cases(8_000), Range::AllDecades);
    check_reference(1, cases(2_000), Range::Ordinary);
}

#[test]
fn two_axes_are_rounded_once() {
    check_reference(2, cases(3_000), Range::AllDecades);
    check_reference(2, cases(1_000), Range::Ordinary);
}

#[test]
fn three_axes_are_rounded_once() {
    check_reference(3, cases(1_000), Range::AllDecades);
    check_reference(3, cases(600), Range::Ordinary);
}

#[test]
fn four_axes_are_rounded_once() {
    check_reference(4, cases(300), Range::AllDecades);
    check_reference(4, cases(200), Range::Ordinary);
}

#[test]
fn both_parts_reach_the_caller() {
    // A third of the way: the rest after rounding to f64 is what the second part holds.
    let table = PiecewiseTable::from_rows(&[1.0, 0.0, 2.0, 3.0], 2, Tail::Constant).unwrap();
    let value = table.reference_at(1.0, &[]).unwrap();
    let high = value.to_f64();
    let low = (value + -inpact_evaluation::numbers::Scaled::new(high)).to_f64();
    let missing = table_value(&[vec![1.0, 0.0], vec![2.0, 3.0]], &[1.0], table_judge::Ending::Constant)
        - (exact(high) + exact(low));
    assert!(low != 0.0 && missing.abs() < exact(2f64.powi(-100)), "{high:e} + {low:e}");
}

#[test]
fn nan_and_infinities_follow_the_full_mode() {
    let rows = [10.0, 0.0, 300.0, 2.0, 2.0, 300.0, 20.0, 0.0, 400.0, 10.0, 4.0, 400.0];
    for tail in [Tail::Constant, Tail::Zero] {
        let table = PiecewiseTable::from_rows(&rows, 3, tail).unwrap();
        assert!(table.reference_at(f64::NAN, &[350.0]).is_none());
        assert!(table.reference_at(1.0, &[f64::NAN]).is_none());
        assert!(table.reference_at(1.0, &[]).is_none());
        for x in [f64::NEG_INFINITY, -1.0, 0.0, 2.0, 2f64.next_up(), 3.0, 4.0, 5.0, f64::INFINITY] {
            for y in [f64::NEG_INFINITY, 300.0, 350.0, 400.0, f64::INFINITY] {
                assert_eq!(table.reference_value_at(x, &[y]), table.value_at(x, &[y]), "at {x}, {y}");
            }
        }
    }
}

/// The bound of the full mode holds, and is not far above what random queries find.
#[test]
fn the_bound_of_the_full_mode_holds() {
    for axes in 1..=3 {
        let mut random = Random::new(0xf0 + u64::try_from(axes).unwrap());
        let mut worst = 0.0;
        for _ in 0..cases(400) {
            let rows = random_rows(&mut random, axes, Range::Ordinary);
            let table = compile(&rows, table_judge::Ending::Constant);
            let bound = full_bound(&table);
            for _ in 0..8 {
                let point = random_point(&mut random, &rows);
                let exact_value = table_value(&rows, &point, table_judge::Ending::Constant);
                let error = (exact(table.value(&point)) - &exact_value).abs();
                assert!(error <= exact(bound.absolute), "{error} above {bound:?}");
                assert!(error <= exact(bound.pointwise) * &exact_value, "{error} above {bound:?}");
                if bound.pointwise > 0.0 {
                    let part = table_judge::difference(&(error / (exact(bound.pointwise) * exact_value)), &exact(0.0));
                    worst = f64::max(worst, part);
                }
            }
        }
        assert!(worst > 0.1, "with {axes} axes the bound is loose: at most {worst} of it is reached");
    }
}
