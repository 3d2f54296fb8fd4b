//! The f64 itself: error-free sums and products, exponents, powers of two, the unit in the last place.

/// The sum of `a` and `b`, rounded, and its rounding error (two-sum): `a + b = sum + error` exactly, for magnitudes up to 2¹⁰²².
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}

/// The difference `a - b`, rounded, and its rounding error: `a - b = difference + error` exactly, for magnitudes up to 2¹⁰²².
#[inline]
pub fn two_difference(a: f64, b: f64) -> (f64, f64) {
    two_sum(a, -b)
}

/// The product of `a` and `b`, rounded, and its rounding error (two-product): `a * b = product + error` exactly, unless one of the two over- or underflows.
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// The unit in the last place of `value`: the distance from its magnitude to the next larger f64.
///
/// It is 2⁻¹⁰⁷⁴ for zero and all subnormal numbers, and NaN where `value` is infinite or NaN.
pub fn ulp(value: f64) -> f64 {
    if !value.is_finite() {
        return f64::NAN;
    }
    let exponent = if value == 0.0 { LEAST_NORMAL } else { exponent_of(value).max(LEAST_NORMAL) };
    scale_by_power(1.0, exponent - 52)
}

/// A quarter of the largest f64, just below 2¹⁰²²: sums of two such numbers are far from overflow.
pub(super) const SAFE_TO_ADD: f64 = f64::MAX / 4.0;

/// The exponent of the smallest normal f64.
pub(super) const LEAST_NORMAL: i32 = -1022;

/// 2⁻²⁵⁰ and 2²⁵¹, see [`is_ordinary`].
pub(crate) const LEAST_ORDINARY: f64 = f64::from_bits((1023 - 250) << 52);
pub(crate) const ORDINARY_LIMIT: f64 = f64::from_bits((1023 + 251) << 52);

/// Whether the magnitude of `value` lies between 2⁻²⁵⁰ and 2²⁵¹, so that a few products and quotients of such numbers neither over- nor underflow.
/// False for zero, infinities and NaN.
#[inline]
pub(crate) fn is_ordinary(value: f64) -> bool {
    let biased = (value.to_bits() >> 52) & 0x7ff;
    (1023 - 250..=1023 + 250).contains(&biased)
}

/// Whether `value` is zero or of ordinary magnitude, see [`is_ordinary`].
#[inline]
pub(crate) fn is_zero_or_ordinary(value: f64) -> bool {
    value == 0.0 || is_ordinary(value)
}

/// Whether `value` is zero or its magnitude lies between 2⁻¹²⁰ and 2¹²¹, so that eight such numbers can be multiplied in any order.
#[inline]
pub(crate) fn is_moderate(value: f64) -> bool {
    let biased = (value.to_bits() >> 52) & 0x7ff;
    value == 0.0 || (1023 - 120..=1023 + 120).contains(&biased)
}

/// The exponent e of a finite `value` that is not zero: 2^e <= |value| < 2^(e+1).
pub fn exponent_of(value: f64) -> i32 {
    let biased = ((value.to_bits() >> 52) & 0x7ff) as i32;
    if biased > 0 {
        return biased - 1023;
    }
    let normal = value * power_of_two(100);
    (((normal.to_bits() >> 52) & 0x7ff) as i32) - 1023 - 100
}

/// `value` × 2^`exponent`, rounded once where the result is subnormal, for a `value` of ordinary size or a scaling that makes it one.
pub fn scale_by_power(value: f64, exponent: i32) -> f64 {
    match exponent {
        ..-1022 => value * power_of_two(-1000) * power_of_two((exponent + 1000).max(-1022)),
        -1022..=1023 => value * power_of_two(exponent),
        1024.. => value * power_of_two(1000) * power_of_two((exponent - 1000).min(1023)),
    }
}

/// 2^`exponent` for a normal result, -1022 to 1023.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(u64::from((exponent + 1023).unsigned_abs()) << 52)
}
