//! The arithmetic of 106 bits that networks are solved with, against exact rationals.

use inpact_evaluation::numbers::DoubleDouble;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use proptest::prelude::*;

fn exact_f64(value: f64) -> BigRational {
    BigRational::from_float(value).expect("finite")
}

fn exact(value: DoubleDouble) -> BigRational {
    let (high, low) = value.parts();
    exact_f64(high) + exact_f64(low)
}

/// Whether `found` is within 2^-`bits` of `magnitude` from what it should be.
fn is_within(found: DoubleDouble, expected: &BigRational, magnitude: &BigRational, bits: u32) -> bool {
    (exact(found) - expected).abs() * BigRational::from(BigInt::one() << bits) <= magnitude.abs()
}

/// An f64 with an exponent from -200 to 200, or zero: products and quotients have all their digits.
fn number() -> impl Strategy<Value = f64> {
    let any = (any::<u64>(), -200..=200_i32, any::<bool>()).prop_map(|(bits, exponent, is_negative)| {
        let digits = f64::from_bits(bits >> 12 | 1023 << 52);
        let magnitude = digits * 2_f64.powi(exponent);
        if is_negative { -magnitude } else { magnitude }
    });
    prop_oneof![9 => any, 1 => Just(0.0), 1 => Just(1.0)]
}

/// A number of 106 bits, often one whose second half is far below the first one.
fn double_double() -> impl Strategy<Value = DoubleDouble> {
    (number(), number(), 0..60_i32).prop_map(|(high, low, gap)| {
        let low = if low == 0.0 { 0.0 } else { low / low.abs() * high.abs() * 2_f64.powi(-53 - gap) };
        DoubleDouble::new(high) + DoubleDouble::new(low)
    })
}

/// Two numbers, of which the second is near the first or its negative now and then.
fn pair() -> impl Strategy<Value = (DoubleDouble, DoubleDouble)> {
    let near = (double_double(), -60..0_i32, prop::bool::ANY).prop_map(|(a, gap, is_negative)| {
        let (high, _) = a.parts();
        let b = a + DoubleDouble::new(high * 2_f64.powi(gap));
        (a, if is_negative { -b } else { b })
    });
    prop_oneof![(double_double(), double_double()), near]
}

/// The first half is the number rounded to f64.
fn is_normal(value: DoubleDouble) -> bool {
    let (high, low) = value.parts();
    high + low == high && value.to_f64() == high
}

proptest! {
    #[test]
    fn a_difference_and_a_product_of_f64_are_exact(a in number(), b in number()) {
        prop_assert_eq!(exact(DoubleDouble::difference(a, b)), exact_f64(a) - exact_f64(b));
        prop_assert_eq!(exact(DoubleDouble::product(a, b)), exact_f64(a) * exact_f64(b));
        prop_assert_eq!(exact(DoubleDouble::new(a) + DoubleDouble::new(b)), exact_f64(a) + exact_f64(b));
    }

    #[test]
    fn sums_lose_less_than_104_bits_of_the_larger_number((a, b) in pair()) {
        let larger = if exact(a).abs() < exact(b).abs() { exact(b) } else { exact(a) };
        for (found, expected) in [(a + b, exact(a) + exact(b)), (a - b, exact(a) - exact(b))] {
            prop_assert!(is_within(found, &expected, &larger, 104), "{:?} and {:?}: {:?}", a, b, found);
            prop_assert!(is_normal(found), "{:?}", found);
        }
    }

    #[test]
    fn what_is_assigned_is_the_same((a, b) in pair()) {
        let (mut sum, mut difference) = (a, a);
        sum += b;
        difference -= b;
        prop_assert_eq!((sum, difference), (a + b, a - b));
        prop_assert_eq!([a, b, -a].into_iter().sum::<DoubleDouble>(), DoubleDouble::ZERO + a + b + -a);
    }

    #[test]
    fn products_lose_less_than_103_bits((a, b) in pair(), factor in number()) {
        for (found, expected) in [(a * b, exact(a) * exact(b)), (a * factor, exact(a) * exact_f64(factor))] {
            prop_assert!(is_within(found, &expected, &expected, 103), "{:?} and {:?}: {:?}", a, b, found);
            prop_assert!(is_normal(found), "{:?}", found);
        }
    }

    #[test]
    fn quotients_lose_less_than_102_bits((a, b) in pair()) {
        prop_assume!(!b.is_zero());
        let (found, expected) = (a / b, exact(a) / exact(b));
        prop_assert!(is_within(found, &expected, &expected, 102), "{:?} and {:?}: {:?}", a, b, found);
        prop_assert!(is_normal(found), "{:?}", found);
    }

    #[test]
    fn signs_and_powers_of_two_are_exact(a in double_double(), exponent in -600..600) {
        prop_assert_eq!(exact(-a), -exact(a));
        prop_assert_eq!(exact(a.abs()), exact(a).abs());
        prop_assert_eq!(a.is_zero(), exact(a).is_zero());
        let two = BigRational::from(BigInt::from(2));
        prop_assert_eq!(exact(a.times_power_of_two(exponent)), exact(a) * num_traits::Pow::pow(two, exponent));
    }

    /// A sum that overflows is infinite, and no infinite number becomes none by its second half; of a product one half may be none.
    #[test]
    fn what_is_beyond_the_range_is_not_finite(a in any::<f64>(), b in any::<f64>()) {
        let (x, y) = (DoubleDouble::new(a), DoubleDouble::new(b));
        for (sum, plain) in [(x + y, a + b), (x - y, a - b)] {
            prop_assert!(plain.is_finite() || sum.to_f64() == plain || plain.is_nan() && sum.to_f64().is_nan());
        }
        for product in [x * y, x * b] {
            prop_assert!((a * b).is_finite() || !product.to_f64().is_finite(), "{} and {}: {:?}", a, b, product);
        }
    }
}

#[test]
fn a_quotient_by_zero_is_not_finite() {
    assert!(!(DoubleDouble::new(1.0) / DoubleDouble::ZERO).to_f64().is_finite());
    assert!(!(DoubleDouble::ZERO / DoubleDouble::ZERO).to_f64().is_finite());
}

/// One third, three times: what is missing is below the last of 106 bits.
#[test]
fn a_third_and_what_is_left() {
    let third = DoubleDouble::new(1.0) / DoubleDouble::new(3.0);
    let (high, low) = third.parts();
    assert_eq!(high, 1.0 / 3.0);
    assert!((low / high - f64::EPSILON / 4.0).abs() <= f64::EPSILON / 1e15, "{low} of {high}");
    let left = (DoubleDouble::new(1.0) - third * 3.0).to_f64();
    assert!(left.abs() <= 1.0 / (1_u128 << 104) as f64, "{left}");
}
