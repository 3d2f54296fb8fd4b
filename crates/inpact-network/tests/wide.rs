//! The arithmetic of 106 bits that networks are solved with, against exact rationals.

use inpact_evaluation::numbers::Wide;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use proptest::prelude::*;

fn exact_f64(value: f64) -> BigRational {
    BigRational::from_float(value).expect("finite")
}

fn exact(wide: Wide) -> BigRational {
    let (high, low) = wide.parts();
    exact_f64(high) + exact_f64(low)
}

/// Whether `found` is within 2^-`bits` of `magnitude` from what it should be.
fn is_within(found: Wide, expected: &BigRational, magnitude: &BigRational, bits: u32) -> bool {
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
fn wide() -> impl Strategy<Value = Wide> {
    (number(), number(), 0..60_i32).prop_map(|(high, low, gap)| {
        let low = if low == 0.0 { 0.0 } else { low / low.abs() * high.abs() * 2_f64.powi(-53 - gap) };
        Wide::new(high) + Wide::new(low)
    })
}

/// Two numbers, of which the second is near the first or its negative now and then.
fn pair() -> impl Strategy<Value = (Wide, Wide)> {
    let near = (wide(), -60..0_i32, prop::bool::ANY).prop_map(|(a, gap, is_negative)| {
        let (high, _) = a.parts();
        let b = a + Wide::new(high * 2_f64.powi(gap));
        (a, if is_negative { -b } else { b })
    });
    prop_oneof![(wide(), wide()), near]
}

/// The first half is the number rounded to f64.
fn is_normal(wide: Wide) -> bool {
    let (high, low) = wide.parts();
    high + low == high && wide.to_f64() == high
}

proptest! {
    #[test]
    fn a_difference_and_a_product_of_f64_are_exact(a in number(), b in number()) {
        prop_assert_eq!(exact(Wide::difference(a, b)), exact_f64(a) - exact_f64(b));
        prop_assert_eq!(exact(Wide::product(a, b)), exact_f64(a) * exact_f64(b));
        prop_assert_eq!(exact(Wide::new(a) + Wide::new(b)), exact_f64(a) + exact_f64(b));
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
        prop_assert_eq!([a, b, -a].into_iter().sum::<Wide>(), Wide::ZERO + a + b + -a);
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
    fn signs_and_powers_of_two_are_exact(a in wide(), exponent in -600..600) {
        prop_assert_eq!(exact(-a), -exact(a));
        prop_assert_eq!(exact(a.abs()), exact(a).abs());
        prop_assert_eq!(a.is_zero(), exact(a).is_zero());
        let two = BigRational::from(BigInt::from(2));
        prop_assert_eq!(exact(a.times_power_of_two(exponent)), exact(a) * num_traits::Pow::pow(two, exponent));
    }

    /// A sum that overflows is infinite, and no infinite number becomes none by its second half; of a product one half may be none.
    #[test]
    fn what_is_beyond_the_range_is_not_finite(a in any::<f64>(), b in any::<f64>()) {
        let (x, y) = (Wide::new(a), Wide::new(b));
        for (wide, plain) in [(x + y, a + b), (x - y, a - b)] {
            prop_assert!(plain.is_finite() || wide.to_f64() == plain || plain.is_nan() && wide.to_f64().is_nan());
        }
        for wide in [x * y, x * b] {
            prop_assert!((a * b).is_finite() || !wide.to_f64().is_finite(), "{} and {}: {:?}", a, b, wide);
        }
    }
}

#[test]
fn a_quotient_by_zero_is_not_finite() {
    assert!(!(Wide::new(1.0) / Wide::ZERO).to_f64().is_finite());
    assert!(!(Wide::ZERO / Wide::ZERO).to_f64().is_finite());
}

/// One third, three times: what is missing is below the last of 106 bits.
#[test]
fn a_third_and_what_is_left() {
    let third = Wide::new(1.0) / Wide::new(3.0);
    let (high, low) = third.parts();
    assert_eq!(high, 1.0 / 3.0);
    assert!((low / high - f64::EPSILON / 4.0).abs() <= f64::EPSILON / 1e15, "{low} of {high}");
    let left = (Wide::new(1.0) - third * 3.0).to_f64();
    assert!(left.abs() <= 1.0 / (1_u128 << 104) as f64, "{left}");
}
