//! Interpolation on one segment against exact integers: inputs over all decades, subnormal numbers, knots and their neighbours.
//!
//! `INPACT_RANDOM_CASES=10000000 cargo test --release -p inpact-evaluation --test numbers_segment` measures the largest errors over ten million cases a form.

mod table_judge;

use inpact_evaluation::numbers::{KernelSlope, between, interpolate, slope, ulp};
use num_traits::Signed;
use table_judge::{Random, cases, report, ulps_from_quotient, units};

type End = (f64, f64);

/// A random segment with values of one sign, and a point on it.
fn segment(random: &mut Random) -> (f64, End, End) {
    let (x0, x1) = loop {
        let x0 = random.signed();
        let x1 = random.above(x0);
        if x1 > x0 {
            break (x0, x1);
        }
    };
    let y0 = random.of_any_decade();
    let y1 = match random.below(6) {
        0 => 0.0,
        1 => random.above(y0).abs(),
        2 => (0..random.below(5)).fold(y0, |y, _| y.next_up()).min(f64::MAX),
        3 => (y0 * random.positive(-60, 60)).min(f64::MAX),
        _ => random.of_any_decade(),
    };
    let (y0, y1) = if random.below(2) == 0 { (y0, y1) } else { (y1, y0) };
    (random.within(x0, x1), (x0, y0), (x1, y1))
}

/// A segment of ordinary size built to make the roundings add up: significands of offset and width next to a power of two, one value far below the other.
fn spiteful_segment(random: &mut Random) -> (f64, End, End) {
    loop {
        let (a, b) = (random.positive(-56, -48), random.positive(-2, 2));
        let x0 = if random.below(2) == 0 { a } else { -a };
        let x1 = x0 + b;
        let x = x0 + random.positive(-6, 2);
        let y0 = [0.0, random.positive(-58, -50), random.positive(-4, 0)][random.below(3)];
        let y1 = random.positive(-2, 2);
        if x0 < x && x < x1 {
            return if random.below(2) == 0 { (x, (x0, y0), (x1, y1)) } else { (-x, (-x1, y1), (-x0, y0)) };
        }
    }
}

/// The error of `computed` in ulps of the exact value.
fn error(computed: f64, x: f64, (x0, y0): End, (x1, y1): End) -> f64 {
    let (x, x0, y0, x1, y1) = (units(x), units(x0), units(y0), units(x1), units(y1));
    let width = &x1 - &x0;
    ulps_from_quotient(computed, &(&y0 * &width + (x - &x0) * (y1 - &y0)), &width)
}

fn check_form(
    name: &str,
    count: usize,
    bound: f64,
    mut make: impl FnMut(&mut Random) -> (f64, End, End),
    form: impl Fn(f64, End, End) -> f64,
) {
    let mut random = Random::new(0x5e67);
    let mut worst = 0.0;
    let mut long_way = 0;
    for _ in 0..count {
        let (x, a, b) = make(&mut random);
        long_way += usize::from(KernelSlope::of_segment(a, b).is_missing());
        let value = form(x, a, b);
        let (least, greatest) = (a.1.min(b.1), a.1.max(b.1));
        assert!(least <= value && value <= greatest, "{name} leaves the segment: {value:e} at {x:e} of {a:?} {b:?}");
        let error = error(value, x, a, b);
        assert!(error <= bound, "{name} is off by {error} ulp: {value:e} at {x:e} of {a:?} {b:?}");
        worst = f64::max(worst, error);
        for (x, y) in [a, b] {
            assert_eq!(form(x, a, b), y, "{name} misses an end of {a:?} {b:?}");
        }
    }
    report(
        name,
        &format!("largest error {worst:.4} ulp over {count} cases, {long_way} of them without a kernel slope"),
    );
}

fn fast(x: f64, a: End, b: End) -> f64 {
    interpolate(x, a, b, KernelSlope::of_segment(a, b))
}

#[test]
fn short_form_is_within_one_and_a_half_ulp_over_all_decades() {
    check_form("short form, all decades", cases(100_000), 2.0, segment, fast);
}

#[test]
fn short_form_is_within_one_and_a_half_ulp_when_roundings_add_up() {
    check_form("short form, spiteful", cases(100_000), 2.0, spiteful_segment, fast);
}

#[test]
fn precise_form_is_within_half_an_ulp_over_all_decades() {
    check_form("precise form, all decades", cases(100_000), 0.500_000_001, segment, between);
}

#[test]
fn precise_form_is_within_half_an_ulp_when_roundings_add_up() {
    check_form("precise form, spiteful", cases(100_000), 0.500_000_001, spiteful_segment, between);
}

#[test]
fn both_forms_serve_negative_values_as_they_serve_positive_ones() {
    let mut random = Random::new(77);
    for _ in 0..10_000 {
        let (x, (x0, y0), (x1, y1)) = segment(&mut random);
        assert_eq!(fast(x, (x0, -y0), (x1, -y1)), -fast(x, (x0, y0), (x1, y1)));
        assert_eq!(between(x, (x0, -y0), (x1, -y1)), -between(x, (x0, y0), (x1, y1)));
    }
}

/// Half an ulp of the result and 2⁻¹⁰⁰ of the larger value.
#[test]
fn values_of_opposite_sign_are_exact_but_for_the_zero_crossing() {
    let mut random = Random::new(13);
    let mut worst = 0.0;
    for _ in 0..cases(50_000) {
        let (x, (x0, y0), (x1, y1)) = segment(&mut random);
        if y0 == 0.0 || y1 == 0.0 {
            continue;
        }
        let (a, b) = ((x0, -y0), (x1, y1));
        let value = fast(x, a, b);
        assert!(-y0 <= value && value <= y1);
        let lost_below = y0.max(y1) / 2f64.powi(100) / ulp(value);
        let error = error(value, x, a, b);
        assert!(error <= 0.500_001 + 2.0 * lost_below, "off by {error} ulp: {value:e} at {x:e} of {a:?} {b:?}");
        if lost_below < 1e-9 {
            worst = f64::max(worst, error);
        }
    }
    report("opposite signs away from the zero crossing", &format!("largest error {worst:.4} ulp"));
}

/// Steps of one to four ulps anywhere on a segment, across its middle above all.
fn check_monotone(form: impl Fn(f64, End, End) -> f64, allowed_drop: f64) {
    let mut random = Random::new(99);
    for round in 0..cases(100_000) {
        let (x, a, b) = if round % 3 == 0 { spiteful_segment(&mut random) } else { segment(&mut random) };
        let x = if random.below(2) == 0 { (0.5 * a.0 + 0.5 * b.0).clamp(a.0, b.0) } else { x };
        let start = (0..3).fold(x, |x, _| x.next_down()).max(a.0);
        let mut points = vec![start];
        for _ in 0..6 {
            points.push(points[points.len() - 1].next_up().min(b.0));
        }
        let direction = if a.1 <= b.1 { 1.0 } else { -1.0 };
        for pair in points.windows(2) {
            let (before, after) = (form(pair[0], a, b), form(pair[1], a, b));
            let drop = direction * (before - after);
            assert!(
                drop <= allowed_drop * ulp(before.max(after)),
                "turns back from {before:e} to {after:e} at {:e} of {a:?} {b:?}",
                pair[0]
            );
        }
    }
}

#[test]
fn short_form_turns_back_by_one_ulp_at_most() {
    check_monotone(fast, 1.0);
}

#[test]
fn precise_form_turns_back_by_one_ulp_at_most() {
    check_monotone(between, 1.0);
}

/// The slope rounds the exact quotient, also where it is subnormal or the width overflows.
#[test]
fn slope_is_the_rounded_exact_slope() {
    let mut random = Random::new(4);
    let mut worst = 0.0;
    for _ in 0..cases(50_000) {
        let (_, a, b) = segment(&mut random);
        let (rise, width) = (units(b.1) - units(a.1), units(b.0) - units(a.0));
        let slope = slope(a, b);
        if slope.is_infinite() {
            // 2^1024 less half an ulp is where rounding goes to infinity.
            assert!(rise.abs() >= &width * units(f64::MAX) / units(1.0));
            continue;
        }
        let error = ulps_from_quotient(slope, &(rise << 1074), &width);
        assert!(error <= 0.500_001, "slope off by {error} ulp: {slope:e} of {a:?} {b:?}");
        worst = f64::max(worst, error);
    }
    report("slope", &format!("largest error {worst:.4} ulp"));
}

/// The usual form y0 + t (y1 - y0) fails each of these.
#[test]
fn known_failures_of_the_usual_form() {
    // Next to a steep right knot.
    let (a, b) = ((0.0, 1e16), (1.0, 1.0));
    assert_eq!(fast(1.0, a, b), 1.0);
    assert!(error(fast(1f64.next_down(), a, b), 1f64.next_down(), a, b) <= 2.0);
    // l / w is subnormal, its product with the rise is not.
    let (a, b) = ((0.0, 0.0), (1e308, 1e308));
    assert_eq!(fast(1e-10, a, b), 1e-10);
    // The width overflows.
    let (a, b) = ((-1.7e308, 1.0), (1.7e308, 3.0));
    assert_eq!(fast(0.0, a, b), 2.0);
    // Segment and values are subnormal.
    let tiny = f64::from_bits(1);
    assert_eq!(fast(2.0 * tiny, (0.0, 0.0), (4.0 * tiny, 8.0 * tiny)), 4.0 * tiny);
    assert_eq!(fast(tiny, (0.0, 0.0), (2.0 * tiny, f64::MAX)), 0.5 * f64::MAX);
    // The slope exceeds the range.
    assert_eq!(fast(1e-300, (0.0, 0.0), (2e-300, 1e300)), 5e299);
}

#[test]
fn nan_goes_through() {
    let (a, b) = ((0.0, 1.0), (1.0, 2.0));
    assert!(fast(f64::NAN, a, b).is_nan());
    assert!(between(f64::NAN, a, b).is_nan());
    assert!(fast(f64::NAN, (0.0, -1.0), (1.0, 1e308)).is_nan());
}
