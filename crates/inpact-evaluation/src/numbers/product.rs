//! Means, products and ratios whose intermediate results must not overflow or underflow where the result is finite.

use super::float::is_ordinary;
use super::scaled::Scaled;

/// The mean of two values, correctly rounded, without overflow of their sum.
#[inline]
pub fn mean(a: f64, b: f64) -> f64 {
    let sum = a + b;
    // A sum beyond the range needs two large values, whose halves are exact.
    if sum.is_finite() { 0.5 * sum } else { 0.5 * a + 0.5 * b }
}

/// The product of all `factors`: finite and accurate wherever the exact product is finite, even where plain multiplication would over- or underflow.
///
/// Ordinary factors are multiplied in order, from the left; at most one rounding of half an ulp for each factor.
/// Zero times infinity is NaN, as is any product with NaN; a zero times finite factors gives zero however large they are.
/// The product of no factors is 1.
#[inline]
pub fn product(factors: &[f64]) -> f64 {
    if factors.len() <= 4 && factors.iter().all(|&factor| is_ordinary(factor)) {
        return factors.iter().product();
    }
    product_of_extremes(factors)
}

/// [`product`] where some factor is zero, extreme, infinite or NaN.
#[cold]
fn product_of_extremes(factors: &[f64]) -> f64 {
    if factors.iter().any(|factor| *factor == 0.0 || !factor.is_finite()) {
        // The finite factors only determine the sign.
        return factors
            .iter()
            .map(|&factor| if factor == 0.0 || !factor.is_finite() { factor } else { factor.signum() })
            .product();
    }
    factors.iter().fold(Scaled::new(1.0), |product, &factor| product * Scaled::new(factor)).to_f64()
}

/// `a` / (`a` + `b`) for two values of one sign, without overflow of the sum; NaN where both are zero.
pub fn ratio(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if sum.is_finite() { a / sum } else { (0.5 * a) / (0.5 * a + 0.5 * b) }
}

/// `factor` × (`a` − `b`), even where the difference alone exceeds the range of f64.
#[inline]
pub fn scaled_difference_product(factor: f64, a: f64, b: f64) -> f64 {
    let difference = a - b;
    if difference.is_infinite() && a.is_finite() && b.is_finite() && factor.is_finite() {
        return (Scaled::new(factor) * Scaled::difference(a, b)).to_f64();
    }
    factor * difference
}
