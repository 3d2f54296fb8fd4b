//! The judge of the numerical tests: exact rationals, written from the manual's text and not from the kernels, and random numbers over all decades.

#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

pub mod random_tables;

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

/// Random numbers, the same in every run.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number below `limit`.
    pub fn below(&mut self, limit: usize) -> usize {
        usize::try_from(self.bits() % u64::try_from(limit).unwrap()).unwrap()
    }

    /// A number from 0 to 1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / 9_007_199_254_740_992.0
    }

    /// A positive number with a binary exponent from `least` to `greatest`, -1074 to 1023; significands are random, short or next to a power of two.
    pub fn positive(&mut self, least: i32, greatest: i32) -> f64 {
        let span = usize::try_from(greatest - least + 1).unwrap();
        let exponent = least + i32::try_from(self.below(span)).unwrap();
        let noise = self.bits() >> 12;
        let fraction = match self.below(8) {
            0 => 0,
            1 => self.bits() & 7,
            2 => ((1 << 52) - 1) - (self.bits() & 7),
            3 => noise & !((1 << 44) - 1),
            _ => noise,
        };
        if exponent < -1022 {
            let bits = (1 << (exponent + 1074)) | (fraction >> (52 - (exponent + 1074)));
            return f64::from_bits(bits);
        }
        f64::from_bits(u64::try_from(exponent + 1023).unwrap() << 52 | fraction)
    }

    /// A number that is not negative, over all decades, zero included.
    pub fn of_any_decade(&mut self) -> f64 {
        match self.below(12) {
            0 => 0.0,
            1 => self.positive(-1074, -1000),
            2 => self.positive(1000, 1023),
            3 => 1.0,
            _ => self.positive(-1074, 1023),
        }
    }

    /// A number of either sign over all decades.
    pub fn signed(&mut self) -> f64 {
        let magnitude = self.of_any_decade();
        if self.below(2) == 0 { magnitude } else { -magnitude }
    }

    /// An abscissa above `x`: next to it, near it, of its own size or anywhere above.
    pub fn above(&mut self, x: f64) -> f64 {
        let candidate = match self.below(6) {
            0 => (0..=self.below(4)).fold(x, |x, _| x.next_up()),
            1 => x + x.abs() * self.positive(-52, 0),
            2 => x + x.abs() * self.positive(-2, 3),
            3 => x + self.positive(-60, 60),
            _ => self.signed(),
        };
        if candidate > x && candidate.is_finite() { candidate } else { x.next_up().min(f64::MAX) }
    }

    /// A point of the segment from `a` to `b`: at, next to or a random way from either end, about the middle, or of any size.
    pub fn within(&mut self, a: f64, b: f64) -> f64 {
        let part = match self.below(3) {
            0 => self.unit(),
            1 => self.positive(-60, -1),
            _ => 0.5 + self.positive(-56, -20) * [1.0, -1.0][self.below(2)],
        };
        let candidate = match self.below(7) {
            0 => (0..self.below(4)).fold(a, |x, _| x.next_up()),
            1 => (0..self.below(4)).fold(b, |x, _| x.next_down()),
            2 => self.signed(),
            3 => a + (b * 0.5 - a * 0.5) * part * 2.0,
            4 => b - (b * 0.5 - a * 0.5) * part * 2.0,
            _ => a * (1.0 - part) + b * part,
        };
        if candidate.is_nan() { a } else { candidate.clamp(a, b) }
    }
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
