//! The judge of the numerical tests: exact rationals, written from the manual's text and not from the kernels, and random numbers over all decades.

#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

mod random;
pub mod random_tables;

pub use random::Random;

use std::io::Write as _;

use num_bigint::{BigInt, BigUint, Sign};
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// A finite f64 as the exact multiple of 2⁻¹⁰⁷⁴ that it is.
pub fn units(value: f64) -> BigInt {
    assert!(value.is_finite(), "{value} has no exact value");
    let bits = value.to_bits();
    let biased = (bits >> 52) & 0x7ff;
    let fraction = bits & ((1 << 52) - 1);
    let magnitude = match biased {
        0 => BigUint::from(fraction),
        _ => BigUint::from(fraction | (1 << 52)) << (biased - 1),
    };
    BigInt::from_biguint(if value.is_sign_negative() { Sign::Minus } else { Sign::Plus }, magnitude)
}

/// A finite f64 as a rational.
pub fn exact(value: f64) -> BigRational {
    BigRational::new(units(value), BigInt::one() << 1074)
}

/// How far `computed` is from `numerator / denominator`, in ulps of the exact value; `denominator` is positive and the quotient in units of 2⁻¹⁰⁷⁴.
pub fn ulps_from_quotient(computed: f64, numerator: &BigInt, denominator: &BigInt) -> f64 {
    let error = (units(computed) * denominator - numerator).abs();
    as_f64(&error, &(denominator << ulp_power(numerator, denominator)))
}

/// How far `computed` is from an exact value, in ulps of the exact value.
pub fn ulps_from(computed: f64, exact: &BigRational) -> f64 {
    ulps_from_quotient(computed, &(exact.numer() << 1074), exact.denom())
}

/// The difference of two rationals as f64, good to 2⁻⁴⁰.
pub fn difference(a: &BigRational, b: &BigRational) -> f64 {
    let difference = a - b;
    let magnitude = as_f64(&difference.numer().abs(), difference.denom());
    if difference.is_negative() { -magnitude } else { magnitude }
}

/// The power of two, in units of 2⁻¹⁰⁷⁴, of the ulp of |numerator / denominator|.
fn ulp_power(numerator: &BigInt, denominator: &BigInt) -> u64 {
    if numerator.is_zero() {
        return 0;
    }
    let numerator = numerator.abs();
    // floor(log2 of the quotient) is the difference of the bit lengths or one less.
    let guess = i64::try_from(numerator.bits()).unwrap() - i64::try_from(denominator.bits()).unwrap();
    let log2 = if shifted(denominator, guess) > shifted(&numerator, -guess) { guess - 1 } else { guess };
    u64::try_from((log2 - 52).max(0)).unwrap()
}

/// `value` × 2^`power` for a positive power, `value` otherwise: enough to compare a quotient with a power of two.
fn shifted(value: &BigInt, power: i64) -> BigInt {
    value << u64::try_from(power.max(0)).unwrap()
}

/// A quotient of non-negative integers as f64, to 2⁻⁴⁰.
fn as_f64(numerator: &BigInt, denominator: &BigInt) -> f64 {
    let quotient: BigInt = (numerator << 40) / denominator;
    quotient.to_f64().unwrap() / f64::from(1u32 << 20) / f64::from(1u32 << 20)
}

/// The rows of a table: value, axis 0 (fastest) to the last axis (slowest).
pub type Rows = Vec<Vec<f64>>;

/// What the table is beyond the last row of a group of axis 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    Constant,
    Zero,
}

/// The exact value of a table at a point by the manual's rules: rows grouped by the last variable, each group evaluated by itself, linear between, constant outside.
pub fn table_value(rows: &[Vec<f64>], point: &[f64], ending: Ending) -> BigRational {
    let groups = groups_of(rows, point.len());
    let Some((&x, inner)) = point.split_last() else {
        return exact(rows[0][0]);
    };
    let of_group = |group: usize| table_value(groups[group].1, inner, ending);
    let last = groups.len() - 1;
    // Beyond a single row too.
    if inner.is_empty() && ending == Ending::Zero && groups[last].0 < x {
        return BigRational::zero();
    }
    if last == 0 || x <= groups[0].0 {
        return of_group(0);
    }
    if groups[last].0 <= x {
        return of_group(last);
    }
    let right = groups.iter().position(|(knot, _)| *knot > x).unwrap();
    let (x0, x1) = (exact(groups[right - 1].0), exact(groups[right].0));
    let (y0, y1) = (of_group(right - 1), of_group(right));
    let part = (exact(x) - &x0) / (x1 - x0);
    &y0 + part * (&y1 - &y0)
}

/// The exact slope along `axis`: that of the segment that holds the point, right-hand at a knot, zero outside; interpolated over the axes outside it.
pub fn table_slope(rows: &[Vec<f64>], point: &[f64], axis: usize, ending: Ending) -> BigRational {
    let groups = groups_of(rows, point.len());
    let Some((&x, inner)) = point.split_last() else {
        return BigRational::zero();
    };
    let last = groups.len() - 1;
    let right = groups.iter().position(|(knot, _)| *knot > x);
    if inner.len() == axis {
        return match right {
            Some(right) if right > 0 => {
                let value = |group: usize| table_value(groups[group].1, inner, ending);
                (value(right) - value(right - 1)) / (exact(groups[right].0) - exact(groups[right - 1].0))
            }
            _ => BigRational::zero(),
        };
    }
    let of_group = |group: usize| table_slope(groups[group].1, inner, axis, ending);
    match right {
        None => of_group(last),
        Some(0) => of_group(0),
        Some(right) => {
            let (x0, x1) = (exact(groups[right - 1].0), exact(groups[right].0));
            let (s0, s1) = (of_group(right - 1), of_group(right));
            let part = (exact(x) - &x0) / (x1 - x0);
            &s0 + part * (&s1 - &s0)
        }
    }
}

/// The rows in groups of one abscissa of the axis in `column`, in order.
fn groups_of(rows: &[Vec<f64>], column: usize) -> Vec<(f64, &[Vec<f64>])> {
    rows.chunk_by(|a, b| a[column] == b[column]).map(|group| (group[0][column], group)).collect()
}

/// How many random cases a test runs: INPACT_RANDOM_CASES if that is set, for a long run, otherwise `usual`.
pub fn cases(usual: usize) -> usize {
    std::env::var("INPACT_RANDOM_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(usual)
}

/// Says what a long run measured.
pub fn report(what: &str, measured: &str) {
    if std::env::var_os("INPACT_RANDOM_CASES").is_some() {
        let _ = writeln!(std::io::stderr(), "{what}: {measured}");
    }
}
