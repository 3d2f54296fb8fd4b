//! Linear interpolation on one segment, and its slope.
//!
//! Two forms, both from the nearer end, so that both ends are exact and no digits are lost against a far larger value at the other:
//!
//! - [`interpolate`], for the segments of a table: one fused multiply-add of the offset x − x0 and a slope computed beforehand,
//!   then a correction by the rounding errors of offset and slope. Two roundings remain, of the fused operation and of the correction: 1 ulp,
//!   or 1.5 where the first crosses a power of two that the second takes back. As the sum before the last rounding is off by half an ulp at most,
//!   the result never turns back by more than one ulp, and near an end the correction is too small to leave it.
//! - [`between`], for values known only at the query, as those of the groups of a nested table are: the same expression in twice the precision, 0.5 ulp.
//!
//! A segment on which the short form could fail has no kernel slope and falls back to `between`, which for extreme exponents uses [`Scaled`] numbers.
//!
//! Values of opposite sign: `between` is good to half an ulp of the result plus 2⁻¹⁰² of the larger value, so that relative accuracy is lost only within 2⁻⁵⁰
//! of the zero crossing; such segments have no kernel slope.

use super::float::{SAFE_TO_ADD, is_ordinary, two_difference, two_product, two_sum};
use super::scaled::Scaled;

/// The slope of a segment for [`interpolate`]: a rounded quotient and its rounding error.
#[derive(Clone, Copy, Debug)]
pub struct KernelSlope {
    high: f64,
    low: f64,
}

/// Slopes below this one have a `low` that may be subnormal: 2⁻⁹⁰⁰.
const LEAST_KERNEL_SLOPE: f64 = 1.183_052_186_166_774_7e-271;

impl KernelSlope {
    /// A placeholder slope for segments that are never used.
    pub(crate) const UNUSED: Self = Self { high: f64::NAN, low: 0.0 };

    /// The slope of a segment with `x0 < x1`.
    ///
    /// There is none, and [`interpolate`] takes the slow path, where the slope is infinite or extremely small, a number is within a factor of four of overflow,
    /// or the values are of opposite sign.
    pub fn of_segment((x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> Self {
        let (high, low) = precise_slope((x0, y0), (x1, y1));
        let largest = y0.abs().max(y1.abs()).max(x0.abs()).max(x1.abs());
        let is_harmless = (high.abs() >= LEAST_KERNEL_SLOPE || y0 == y1)
            && high.is_finite()
            && largest <= SAFE_TO_ADD
            && !(y0.min(y1) < 0.0 && y0.max(y1) > 0.0);
        if is_harmless { Self { high, low } } else { Self::UNUSED }
    }

    /// The rounded slope and its rounding error.
    pub(crate) fn parts(self) -> (f64, f64) {
        (self.high, self.low)
    }

    /// Whether the segment needs the slow path of interpolation.
    pub fn is_missing(self) -> bool {
        self.high.is_nan()
    }
}

/// The value at `x` of the straight line from (`x0`, `y0`) to (`x1`, `y1`), with the slope of the same segment.
///
/// For `x0 <= x <= x1` and values of one sign: within 1.5 ulp of the exact value, exact at both ends, never outside the two values, monotone to one ulp.
/// NaN if `x` is NaN. Outside the segment the result is meaningless.
#[inline]
pub fn interpolate(x: f64, (x0, y0): (f64, f64), (x1, y1): (f64, f64), slope: KernelSlope) -> f64 {
    if slope.is_missing() {
        return between(x, (x0, y0), (x1, y1));
    }
    let (near, base) = if x - x0 <= x1 - x { (x0, y0) } else { (x1, y1) };
    let (offset, offset_error) = two_difference(x, near);
    let value = offset.mul_add(slope.high, base);
    value + (offset * slope.low + offset_error * slope.high)
}

/// The slope (y1 − y0) / (x1 − x0) of a segment with `x0 < x1`, rounded to f64 (0.5 ulp plus 2⁻⁵⁰); infinite where it exceeds the range of f64.
///
/// NaN where one of the values is infinite or NaN.
pub fn slope(start: (f64, f64), end: (f64, f64)) -> f64 {
    precise_slope(start, end).0
}

/// The slope of a segment, rounded, and its rounding error, where that is representable in f64.
fn precise_slope((x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> (f64, f64) {
    let (rise, rise_error) = two_difference(y1, y0);
    let (width, width_error) = two_difference(x1, x0);
    if is_ordinary(rise) && is_ordinary(width) {
        let quotient = rise / width;
        let remainder = (-quotient).mul_add(width, rise) + (rise_error - quotient * width_error);
        return two_sum(quotient, remainder / width);
    }
    if !(y0.is_finite() && y1.is_finite()) {
        return (f64::NAN, 0.0);
    }
    (Scaled::difference(y1, y0) / Scaled::difference(x1, x0)).to_pair()
}

/// The value at `x` of the straight line from (`x0`, `y0`) to (`x1`, `y1`), in double-double precision.
///
/// For `x0 <= x <= x1`: within 0.5 ulp plus 2⁻¹⁰² of the larger value, exact at both ends, never outside the two values.
/// NaN if `x` is NaN; infinite values, which a slope can have, give an infinity or NaN.
pub fn between(x: f64, (x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> f64 {
    if x.is_nan() {
        return f64::NAN;
    }
    let from_left = x - x0 <= x1 - x;
    let ((near, base), (far, other)) = if from_left { ((x0, y0), (x1, y1)) } else { ((x1, y1), (x0, y0)) };
    if x == near || base == other {
        return base;
    }
    let (offset, offset_error) = two_difference(x, near);
    let (width, width_error) = two_difference(far, near);
    let (rise, rise_error) = two_difference(other, base);
    if !(is_ordinary(offset) && is_ordinary(width) && is_ordinary(rise)) {
        return between_extremes(x, (near, base), (far, other));
    }
    let part = offset / width;
    let remainder = (-part).mul_add(width, offset) + (offset_error - part * width_error);
    let part_error = remainder / width;
    let (step, step_error) = two_product(part, rise);
    let step_error = step_error + (part * rise_error + part_error * rise);
    let (value, value_error) = two_sum(base, step);
    clamp_between(value + (value_error + step_error), base, other)
}

/// [`between`] where some difference is extreme, infinite or NaN.
#[cold]
fn between_extremes(x: f64, (near, base): (f64, f64), (far, other): (f64, f64)) -> f64 {
    let part = Scaled::difference(x, near) / Scaled::difference(far, near);
    if !(base.is_finite() && other.is_finite()) {
        let part = part.to_f64();
        return (1.0 - part) * base + part * other;
    }
    let step = part * Scaled::difference(other, base);
    clamp_between((Scaled::new(base) + step).to_f64(), base, other)
}

/// `value`, but not outside the range of `a` and `b`.
#[inline]
fn clamp_between(value: f64, a: f64, b: f64) -> f64 {
    value.max(a.min(b)).min(a.max(b))
}
