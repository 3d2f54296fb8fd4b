//! Linear interpolation on one segment, and its slope.
//!
//! Two forms, both from the nearer end, so that each end is met exactly and no digits are lost against a far larger value at the other:
//!
//! - [`interpolate`], for the segments of a table: one fused multiply-add with a slope computed beforehand.
//!   The offset x − x0 and the slope carry half an ulp each; as their significands multiply to the product's, both together cost at most 1.5 ulp of it,
//!   and the product never exceeds the result; with the final rounding that is 2 ulp.
//!   Either half is clamped at the midpoint's value, which makes the form monotone without exception.
//! - [`between`], for values known only at the query, as those of the groups of a nested table are: the same expression in twice the precision, 0.5 ulp.
//!
//! A segment on which the short form could fail has NaN for its kernel slope and goes through `between`, which for extreme exponents uses [`Scaled`] numbers.
//!
//! Values of opposite sign: `between` is good to half an ulp of the result plus 2⁻¹⁰² of the larger value, so that relative accuracy is lost only within 2⁻⁵⁰
//! of the zero crossing; `kernel_slope` sends such segments there.

use super::float::{SAFE_TO_ADD, is_ordinary, two_difference, two_product, two_sum};
use super::scaled::Scaled;

/// The value at `x` of the straight line from (`x0`, `y0`) to (`x1`, `y1`), with `slope` from [`kernel_slope`] of the same segment.
///
/// For `x0 <= x <= x1` and values of one sign: within 2 ulp of the exact value, exact at both ends, never outside the two values, monotone in `x`.
/// NaN if `x` is NaN. Outside the segment the result is of no use.
#[inline]
pub fn interpolate(x: f64, (x0, y0): (f64, f64), (x1, y1): (f64, f64), slope: f64) -> f64 {
    if slope.is_nan() || x.is_nan() {
        return between(x, (x0, y0), (x1, y1));
    }
    let left = x - x0;
    let right = x1 - x;
    let (offset, base) = if left <= right {
        (left, y0)
    } else {
        (-right, y1)
    };
    let middle = 0.5 * (y0 + y1);
    offset
        .mul_add(slope, base)
        .max(base.min(middle))
        .min(base.max(middle))
}

/// The slope that [`interpolate`] wants for a segment with `x0 < x1`: the exact slope rounded to f64, or NaN where the short form is not good enough.
///
/// That is the case where the width overflows, the slope is infinite or subnormal, the values are within a factor of four of overflow or of opposite sign.
pub fn kernel_slope((x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> f64 {
    let slope = slope((x0, y0), (x1, y1));
    let harmless = (slope.is_normal() || y0 == y1)
        && (x1 - x0).is_finite()
        && y0.abs().max(y1.abs()) <= SAFE_TO_ADD
        && !(y0.min(y1) < 0.0 && y0.max(y1) > 0.0);
    if harmless { slope } else { f64::NAN }
}

/// The slope (y1 − y0) / (x1 − x0) of a segment with `x0 < x1`, rounded to f64 (0.5 ulp plus 2⁻⁵⁰); infinite where it exceeds the range of f64.
///
/// NaN where one of the values is infinite or NaN.
pub fn slope((x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> f64 {
    let (rise, rise_error) = two_difference(y1, y0);
    let (width, width_error) = two_difference(x1, x0);
    if is_ordinary(rise) && is_ordinary(width) {
        let quotient = rise / width;
        let remainder =
            (-quotient).mul_add(width, rise) + (-quotient).mul_add(width_error, rise_error);
        return quotient + remainder / width;
    }
    if !(y0.is_finite() && y1.is_finite()) {
        return f64::NAN;
    }
    (Scaled::difference(y1, y0) / Scaled::difference(x1, x0)).to_f64()
}

/// The value at `x` of the straight line from (`x0`, `y0`) to (`x1`, `y1`), in twice the precision of f64.
///
/// For `x0 <= x <= x1`: within 0.5 ulp plus 2⁻¹⁰² of the larger value, exact at both ends, never outside the two values.
/// NaN if `x` is NaN; infinite values, which a slope can have, give an infinity or NaN.
pub fn between(x: f64, (x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> f64 {
    if x.is_nan() {
        return f64::NAN;
    }
    let from_left = x - x0 <= x1 - x;
    let ((near, base), (far, other)) = if from_left {
        ((x0, y0), (x1, y1))
    } else {
        ((x1, y1), (x0, y0))
    };
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
    let remainder = (-part).mul_add(width, offset) + (-part).mul_add(width_error, offset_error);
    let part_error = remainder / width;
    let (step, step_error) = two_product(part, rise);
    let step_error = step_error + part.mul_add(rise_error, part_error * rise);
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
