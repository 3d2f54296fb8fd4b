//! What the fast forms need to know of f32 and f64.

use std::fmt::Debug;
use std::ops::{Mul, Sub};

/// f32 or f64, as the kernels and the error analysis see them.
pub(super) trait Number: Copy + Debug + PartialOrd + Sub<Output = Self> + Mul<Output = Self> {
    /// Zero.
    const ZERO: Self;
    /// The largest relative error of one rounding in the normal range: half an ulp.
    const UNIT: f64;
    /// The largest absolute error of one rounding below the normal range: half the smallest subnormal, as far as an f64 can say so.
    const UNDERFLOW: f64;
    /// The smallest normal number.
    const LEAST_NORMAL: f64;
    /// The largest number of which four can be added without overflow.
    const SAFE_TO_ADD: f64;

    /// The nearest number to `value`.
    fn nearest(value: f64) -> Self;

    /// The number itself as f64, exactly.
    fn exact(self) -> f64;

    /// `self` × `factor` + `addend`, rounded once.
    fn fused(self, factor: Self, addend: Self) -> Self;

    /// `self` brought between `least` and `greatest`; NaN stays.
    fn bounded(self, least: Self, greatest: Self) -> Self;

    /// The whole part of a number that is not negative, at most a table's length; 0 for NaN and below zero.
    fn whole(self) -> usize;

    /// A whole number that rises with `self`.
    fn rank(self) -> u64;
}

macro_rules! number {
    ($real:ident, $bits:ident) => {
        impl Number for $real {
            const ZERO: Self = 0.0;
            const UNIT: f64 = $real::EPSILON as f64 / 2.0;
            const UNDERFLOW: f64 = $real::from_bits(1) as f64;
            const LEAST_NORMAL: f64 = $real::MIN_POSITIVE as f64;
            const SAFE_TO_ADD: f64 = $real::MAX as f64 / 4.0;

            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
            fn nearest(value: f64) -> Self {
                value as $real
            }

            #[inline(always)]
            #[allow(clippy::cast_lossless, clippy::unnecessary_cast, reason = "one of the two types is f64 itself")]
            fn exact(self) -> f64 {
                self as f64
            }

            #[inline(always)]
            fn fused(self, factor: Self, addend: Self) -> Self {
                self.mul_add(factor, addend)
            }

            #[inline(always)]
            fn bounded(self, least: Self, greatest: Self) -> Self {
                let raised = if self < least { least } else { self };
                if raised > greatest { greatest } else { raised }
            }

            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, which is meant")]
            fn whole(self) -> usize {
                self as u32 as usize
            }

            #[inline(always)]
            #[allow(clippy::cast_lossless, clippy::unnecessary_cast, reason = "one of the two types is u64 itself")]
            fn rank(self) -> u64 {
                // Adding zero makes the two zeros one.
                let bits = (self + 0.0).to_bits();
                (if self < 0.0 { !bits } else { bits | (1 << ($bits::BITS - 1)) }) as u64
            }
        }
    };
}

number!(f32, u32);
number!(f64, u64);
