//! Means, products, ratios and sums against exact rationals, at the extremes above all.

mod table_judge;

use inpact_evaluation::numbers::{
    CompensatedSum, Scaled, UnboundedSum, mean, product, ratio, scaled_difference_product, two_product, two_sum, ulp,
};
use num_rational::BigRational;
use num_traits::Zero;
use proptest::prelude::*;
use table_judge::{Random, exact, ulps_from};

/// Any finite f64, subnormal numbers and both zeros included.
fn finite() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |value| value.is_finite())
}

/// A finite f64 far from overflow.
fn safe_to_add() -> impl Strategy<Value = f64> {
    finite().prop_filter("at most 2^1022", |value| value.abs() <= f64::MAX / 4.0)
}

proptest! {
    #[test]
    fn mean_is_correctly_rounded(a in finite(), b in finite()) {
        let half = BigRational::new(1.into(), 2.into());
        prop_assert!(ulps_from(mean(a, b), &((exact(a) + exact(b)) * half)) <= 0.5);
    }

    #[test]
    fn product_is_right_wherever_it_is_finite(factors in prop::collection::vec(finite(), 0..6)) {
        let product_of_all = product(&factors);
        if product_of_all.is_finite() {
            let exact = factors.iter().map(|&factor| exact(factor)).product();
            prop_assert!(ulps_from(product_of_all, &exact) <= (factors.len() as f64).max(0.5));
        } else {
            let log2: f64 = factors.iter().map(|factor| factor.abs().log2()).sum();
            prop_assert!(log2 >= 1_023.999_999);
        }
    }

    #[test]
    fn ratio_is_right_for_values_of_one_sign(a in finite(), b in finite()) {
        let (a, b) = (a.abs(), b.abs());
        prop_assume!(a > 0.0 || b > 0.0);
        prop_assert!(ulps_from(ratio(a, b), &(exact(a) / (exact(a) + exact(b)))) <= 2.0);
    }

    #[test]
    fn difference_times_factor_survives_overflow_of_the_difference(factor in finite(), a in finite(), b in finite()) {
        let value = scaled_difference_product(factor, a, b);
        if value.is_finite() {
            // Below the normal range the difference keeps all digits and only the product rounds.
            prop_assert!(ulps_from(value, &(exact(factor) * (exact(a) - exact(b)))) <= 1.5);
        }
    }

    #[test]
    fn two_sum_loses_nothing(a in safe_to_add(), b in safe_to_add()) {
        let (sum, error) = two_sum(a, b);
        prop_assert_eq!(exact(sum) + exact(error), exact(a) + exact(b));
    }

    #[test]
    fn two_product_loses_nothing(a in -1e100..1e100, b in -1e100..1e100) {
        let (product, error) = two_product(a, b);
        prop_assert_eq!(exact(product) + exact(error), exact(a) * exact(b));
    }

    /// (|a b| + c²) / e, whatever its intermediate results.
    #[test]
    fn scaled_numbers_round_once(a in finite(), b in finite(), c in finite(), e in finite()) {
        prop_assume!(e != 0.0);
        let (a, b) = (a.abs(), b.abs());
        let sum = Scaled::new(a) * Scaled::new(b) + Scaled::new(c) * Scaled::new(c);
        let value = (sum / Scaled::new(e)).to_f64();
        if value.is_finite() {
            let expected = (exact(a) * exact(b) + exact(c) * exact(c)) / exact(e);
            prop_assert!(ulps_from(value, &expected) <= 0.500_001);
        }
    }
}

#[test]
fn mean_of_huge_and_of_subnormal_values() {
    assert_eq!(mean(f64::MAX, f64::MAX), f64::MAX);
    assert_eq!(mean(1.7e308, 1.5e308), 1.6e308);
    let tiny = f64::from_bits(1);
    assert_eq!(mean(tiny, 3.0 * tiny), 2.0 * tiny);
    assert_eq!(mean(f64::MAX, f64::MIN), 0.0);
    assert!(mean(f64::NAN, 1.0).is_nan());
}

/// σ Δφ² with σ = 1e-300 and Δφ = 1e160: Δφ² alone overflows.
#[test]
fn product_survives_overflow_on_the_way() {
    let value = product(&[1e-300, 1e160, 1e160]);
    assert!(ulps_from(value, &(exact(1e-300) * exact(1e160) * exact(1e160))) <= 0.500_001);
    assert!((value / 1e20 - 1.0).abs() < 1e-15);
    assert_eq!(product(&[1e300, 1e300, 0.0]), 0.0);
    assert_eq!(product(&[1e-300, 1e-300, f64::INFINITY]), f64::INFINITY);
    assert!(product(&[0.0, f64::INFINITY]).is_nan());
    assert!(product(&[f64::NAN, 0.0]).is_nan());
    assert_eq!(product(&[-1e300, 1e300]), f64::NEG_INFINITY);
    assert_eq!(product(&[]), 1.0);
}

#[test]
fn ratio_of_huge_values() {
    assert_eq!(ratio(1.5e308, 0.5e308), 0.75);
    assert_eq!(ratio(0.0, 2.0), 0.0);
    assert!(ratio(0.0, 0.0).is_nan());
}

#[test]
fn ulp_is_the_step_between_numbers() {
    assert_eq!(ulp(1.0), f64::EPSILON);
    assert_eq!(ulp(-1.5), f64::EPSILON);
    assert_eq!(ulp(0.0), f64::from_bits(1));
    assert_eq!(ulp(f64::MIN_POSITIVE), f64::from_bits(1));
    assert_eq!(ulp(f64::MAX), f64::MAX - f64::MAX.next_down());
    assert!(ulp(f64::INFINITY).is_nan());
}

#[test]
fn compensated_sum_keeps_what_cancels() {
    let sum: CompensatedSum = [1.0, 1e100, 1.0, -1e100].into_iter().collect();
    assert_eq!(sum.total(), 2.0);
}

#[test]
fn compensated_sum_is_exact_over_random_terms() {
    let mut random = Random::new(5);
    let mut sum = CompensatedSum::default();
    let mut halves = [CompensatedSum::default(); 2];
    let mut expected = BigRational::zero();
    for term in 0..20_000 {
        let (a, b) = (random.positive(-40, 40) * [1.0, -1.0][random.below(2)], random.positive(-20, 20));
        sum.add_product(a, b);
        halves[term % 2].add_product(a, b);
        expected += exact(a) * exact(b);
    }
    assert!(ulps_from(sum.total(), &expected) <= 0.500_001);
    let [mut all, odd] = halves;
    all.merge(&odd);
    assert!(ulps_from(all.total(), &expected) <= 0.500_001);
}

#[test]
fn compensated_sum_of_an_infinite_term_is_infinite() {
    let sum: CompensatedSum = [1.0, f64::INFINITY, 2.0].into_iter().collect();
    assert_eq!(sum.total(), f64::INFINITY);
    let mut sum = CompensatedSum::default();
    sum.add_product(1e200, 1e200);
    assert_eq!(sum.total(), f64::INFINITY);
}

#[test]
fn a_sum_leaves_the_range_on_its_way() {
    let mut sum = UnboundedSum::default();
    for term in [f64::MAX, f64::MAX, -f64::MAX, 1e300, -f64::MAX] {
        sum.add(term);
    }
    assert_eq!(sum.total(), 1e300);
    let mut sum = UnboundedSum::default();
    sum.add(0.5);
    sum.add_product(1e200, 1e200);
    assert_eq!(sum.total(), f64::INFINITY);
    sum.add_product(-1e200, 1e200);
    sum.add_scaled(Scaled::new(2.0));
    // The digits are those of the largest term, which was 1e400.
    assert_eq!(sum.total(), 2.0);
    sum.add(f64::NEG_INFINITY);
    assert_eq!(sum.total(), f64::NEG_INFINITY);
    sum.add(f64::INFINITY);
    assert!(sum.total().is_nan());
}
