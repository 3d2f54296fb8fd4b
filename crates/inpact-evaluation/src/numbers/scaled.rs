//! Double-double numbers with an exponent that neither over- nor underflows, for inputs at which plain arithmetic does.

use std::ops::{Add, Div, Mul, Neg};

use super::double_double::DoubleDouble;
use super::float::{LEAST_NORMAL, SAFE_TO_ADD, exponent_of, scale_by_power};

/// A finite real number mantissa × 2^exponent, with 1 <= |mantissa| < 2 or mantissa = 0.
///
/// Sums, products and quotients are those of [`DoubleDouble`], accurate to about 2⁻¹⁰² of the larger operand; [`Scaled::to_f64`] rounds once, to 0.5 ulp plus that.
/// Its operations cost some ten times those of an f64, so it is used only where exponents are extreme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    mantissa: DoubleDouble,
    exponent: i32,
}

/// Operands further apart than this many powers of two do not change each other's 106 bits.
const OUT_OF_SIGHT: i32 = 220;

impl Scaled {
    /// The number zero.
    pub const ZERO: Self = Self { mantissa: DoubleDouble::ZERO, exponent: 0 };

    /// A finite f64, exactly.
    pub fn new(value: f64) -> Self {
        Self::normalised(DoubleDouble::new(value), 0)
    }

    /// The difference `a - b` of two finite numbers, even where it exceeds the range of f64.
    pub fn difference(a: f64, b: f64) -> Self {
        if a.abs().max(b.abs()) <= SAFE_TO_ADD {
            return Self::normalised(DoubleDouble::difference(a, b), 0);
        }
        Self::normalised(DoubleDouble::difference(0.25 * a, 0.25 * b), 2)
    }

    /// The nearest f64; infinite where the number exceeds its range, subnormal or zero where it falls below.
    pub fn to_f64(self) -> f64 {
        let (high, low) = self.mantissa.parts();
        let nearest = scale_by_power(high, self.exponent);
        if self.exponent >= LEAST_NORMAL {
            return nearest;
        }
        // Below the normal range `high` is rounded a second time. That rounding error together with `low` decides which neighbour is nearest.
        let taken = (high - scale_by_power(nearest, -self.exponent)) + low;
        let half_step = scale_by_power(1.0, LEAST_NORMAL - 53 - self.exponent);
        if taken > half_step {
            nearest.next_up()
        } else if taken < -half_step {
            nearest.next_down()
        } else {
            nearest
        }
    }

    /// The nearest f64 and the remainder, as far as that is within the range of f64.
    pub(crate) fn to_pair(self) -> (f64, f64) {
        (self.to_f64(), scale_by_power(self.mantissa.parts().1, self.exponent))
    }

    /// `value` × 2^`exponent`, normalised.
    fn normalised(value: DoubleDouble, exponent: i32) -> Self {
        if value.is_zero() {
            return Self { mantissa: value, exponent: 0 };
        }
        let shift = exponent_of(value.to_f64());
        Self { mantissa: value.times_power_of_two(-shift), exponent: exponent + shift }
    }
}

impl Add for Scaled {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.mantissa.is_zero() {
            return other;
        }
        if other.mantissa.is_zero() {
            return self;
        }
        let (big, small) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let shift = small.exponent - big.exponent;
        if shift < -OUT_OF_SIGHT {
            return big;
        }
        Self::normalised(big.mantissa + small.mantissa.times_power_of_two(shift), big.exponent)
    }
}

impl Mul for Scaled {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::normalised(self.mantissa * other.mantissa, self.exponent + other.exponent)
    }
}

impl Div for Scaled {
    type Output = Self;

    /// The quotient; the divisor must not be zero.
    fn div(self, other: Self) -> Self {
        Self::normalised(self.mantissa / other.mantissa, self.exponent - other.exponent)
    }
}

impl Neg for Scaled {
    type Output = Self;

    fn neg(self) -> Self {
        Self { mantissa: -self.mantissa, exponent: self.exponent }
    }
}
