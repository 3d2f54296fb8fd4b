//! Numbers of 106 bits with an exponent that neither over- nor underflows, for the inputs at which plain arithmetic loses its way.

use std::ops::{Add, Div, Mul, Neg};

use super::float::{LEAST_NORMAL, SAFE_TO_ADD, exponent_of, scale_by_power, two_difference, two_product, two_sum};

/// A finite real number (high + low) × 2^exponent, with 1 <= |high| < 2 or high = 0, and |low| at most half an ulp of high.
///
/// Sums, products and quotients are good to about 2⁻¹⁰² of the larger operand; [`Scaled::to_f64`] rounds once, to 0.5 ulp plus that.
/// Its operations cost some ten times those of an f64, so it is taken only where exponents are extreme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    high: f64,
    low: f64,
    exponent: i32,
}

/// Operands further apart than this many powers of two do not change each other's 106 bits.
const OUT_OF_SIGHT: i32 = 220;

impl Scaled {
    /// The number zero.
    pub const ZERO: Self = Self { high: 0.0, low: 0.0, exponent: 0 };

    /// A finite f64 as it is.
    pub fn new(value: f64) -> Self {
        Self::normalised(value, 0.0, 0)
    }

    /// The difference `a - b` of two finite numbers, also where it exceeds the range of f64.
    pub fn difference(a: f64, b: f64) -> Self {
        if a.abs().max(b.abs()) <= SAFE_TO_ADD {
            let (high, low) = two_difference(a, b);
            return Self::normalised(high, low, 0);
        }
        let (high, low) = two_difference(0.25 * a, 0.25 * b);
        Self::normalised(high, low, 2)
    }

    /// The nearest f64; infinite where the number exceeds its range, subnormal or zero where it falls below.
    pub fn to_f64(self) -> f64 {
        let nearest = scale_by_power(self.high, self.exponent);
        if self.exponent >= LEAST_NORMAL {
            return nearest;
        }
        // Below the normal range `high` is rounded a second time. What that took away decides together with `low` which neighbour is nearest.
        let taken = (self.high - scale_by_power(nearest, -self.exponent)) + self.low;
        let half_step = scale_by_power(1.0, LEAST_NORMAL - 53 - self.exponent);
        if taken > half_step {
            nearest.next_up()
        } else if taken < -half_step {
            nearest.next_down()
        } else {
            nearest
        }
    }

    /// The nearest f64 and the rest, as far as that is within the range of f64.
    pub(crate) fn to_pair(self) -> (f64, f64) {
        (self.to_f64(), scale_by_power(self.low, self.exponent))
    }

    /// (high + low) × 2^exponent brought into the form the type promises; `low` must not exceed `high` by much.
    fn normalised(high: f64, low: f64, exponent: i32) -> Self {
        let (high, low) = two_sum(high, low);
        if high == 0.0 {
            return Self { high, low: 0.0, exponent: 0 };
        }
        let shift = exponent_of(high);
        Self { high: scale_by_power(high, -shift), low: scale_by_power(low, -shift), exponent: exponent + shift }
    }
}

impl Add for Scaled {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.high == 0.0 {
            return other;
        }
        if other.high == 0.0 {
            return self;
        }
        let (big, small) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let shift = small.exponent - big.exponent;
        if shift < -OUT_OF_SIGHT {
            return big;
        }
        let (high, error) = two_sum(big.high, scale_by_power(small.high, shift));
        let (low, rest) = two_sum(big.low, scale_by_power(small.low, shift));
        let (high, error) = two_sum(high, error + low);
        Self::normalised(high, error + rest, big.exponent)
    }
}

impl Mul for Scaled {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (high, error) = two_product(self.high, other.high);
        let low = error + self.high.mul_add(other.low, self.low * other.high);
        Self::normalised(high, low, self.exponent + other.exponent)
    }
}

impl Div for Scaled {
    type Output = Self;

    /// The quotient; the divisor must not be zero.
    fn div(self, other: Self) -> Self {
        let quotient = self.high / other.high;
        let remainder = (-quotient).mul_add(other.high, self.high);
        let low = (remainder + (-quotient).mul_add(other.low, self.low)) / other.high;
        Self::normalised(quotient, low, self.exponent - other.exponent)
    }
}

impl Neg for Scaled {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low, exponent: self.exponent }
    }
}
