//! Double-double numbers, 106 bits with the exponents of f64: for running differences and residuals.

use super::float::{scale_by_power, two_difference, two_product, two_sum};
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// The unevaluated sum of a rounded value and its rounding error.
///
/// Sums, products and quotients are accurate to about 2⁻¹⁰⁴ of the larger operand as long as no part of them over- or underflows:
/// below 2⁻⁹⁶⁰ the low part underflows and the number has fewer digits, like a subnormal f64.
/// Some three times as fast as [`Scaled`](super::Scaled), which has no such limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// The number zero.
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };

    /// An f64, exactly.
    #[inline]
    pub const fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// The difference `a - b`, exact up to magnitudes of 2¹⁰²².
    #[inline]
    pub fn difference(a: f64, b: f64) -> Self {
        let (high, low) = two_difference(a, b);
        Self { high, low }
    }

    /// The product of two f64, exact unless it over- or underflows.
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        let (high, low) = two_product(a, b);
        Self { high, low: if low.is_finite() { low } else { 0.0 } }
    }

    /// The nearest f64.
    #[inline]
    pub fn to_f64(self) -> f64 {
        self.high
    }

    /// The nearest f64, and the remainder.
    #[inline]
    pub fn parts(self) -> (f64, f64) {
        (self.high, self.low)
    }

    /// Whether it is zero.
    #[inline]
    pub fn is_zero(self) -> bool {
        self.high == 0.0
    }

    /// The number × 2^`exponent`.
    #[inline]
    #[must_use]
    pub fn times_power_of_two(self, exponent: i32) -> Self {
        if exponent == 0 {
            return self;
        }
        Self { high: scale_by_power(self.high, exponent), low: scale_by_power(self.low, exponent) }
    }

    /// Its magnitude.
    #[inline]
    #[must_use]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The sum of a value and a smaller one; a non-finite value is returned alone.
    #[inline]
    pub(crate) fn of_parts(high: f64, low: f64) -> Self {
        let sum = high + low;
        let rest = low - (sum - high);
        Self { high: sum, low: if rest.is_finite() { rest } else { 0.0 } }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, error) = two_sum(self.high, other.high);
        let (low, rest) = two_sum(self.low, other.low);
        let first = Self::of_parts(high, error + low);
        Self::of_parts(first.high, first.low + rest)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        let (high, error) = two_product(self.high, factor);
        Self::of_parts(high, self.low.mul_add(factor, error))
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let (high, error) = two_product(self.high, other.high);
        Self::of_parts(high, error + self.high.mul_add(other.low, self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    /// The quotient; NaN or infinite where the divisor is zero.
    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let remainder = self - other * first;
        let second = remainder.high / other.high;
        let rest = (remainder - other * second).high / other.high;
        let quotient = Self::of_parts(first, second);
        Self::of_parts(quotient.high, quotient.low + rest)
    }
}

impl AddAssign for DoubleDouble {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for DoubleDouble {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Sum for DoubleDouble {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, |sum, term| sum + term)
    }
}
