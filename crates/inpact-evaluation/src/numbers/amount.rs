//! An intermediate result that is multiplied and summed further, and may exceed the range of f64 in between.

use super::float::is_moderate;
use super::scaled::Scaled;
use super::sum::compensated_sum;
use std::ops::Neg;

/// A rounded number and, where plain arithmetic could over- or underflow in intermediate results, the number itself.
///
/// Sums and products of an amount with moderate numbers are plain arithmetic; all others go through [`Scaled`] and are rounded once, at the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amount {
    value: f64,
    exact: Option<Scaled>,
}

impl Amount {
    /// The amount zero.
    pub const ZERO: Self = Self { value: 0.0, exact: None };

    /// A number given as f64.
    pub fn new(value: f64) -> Self {
        Self { value, exact: None }
    }

    /// A number that may lie outside the range of f64.
    pub fn exactly(exact: Scaled) -> Self {
        // A zero amount is +0, not −0.
        Self { value: exact.to_f64() + 0.0, exact: Some(exact) }
    }

    /// The nearest f64; infinite where it exceeds the range.
    pub fn value(self) -> f64 {
        self.value
    }

    /// The number itself; `None` where it is infinite or NaN.
    pub fn exact(self) -> Option<Scaled> {
        self.exact.or_else(|| self.value.is_finite().then(|| Scaled::new(self.value)))
    }

    /// Its product with a factor, rounded.
    pub fn times(self, factor: f64) -> f64 {
        match self.exact {
            Some(exact) if factor.is_finite() => (exact * Scaled::new(factor)).to_f64() + 0.0,
            _ => self.value * factor,
        }
    }

    /// The number, from plain arithmetic.
    #[inline]
    pub(crate) fn plain(self) -> Option<f64> {
        if self.exact.is_none() { Some(self.value) } else { None }
    }

    /// Whether plain arithmetic with a few moderate numbers is accurate for it.
    pub(crate) fn is_moderate(self) -> bool {
        self.exact.is_none() && is_moderate(self.value)
    }

    /// A sum of amounts that may nearly cancel, or whose partial sums exceed the range of f64 where the total does not.
    #[inline]
    pub fn sum<const N: usize>(parts: [Self; N]) -> Self {
        if parts.iter().all(|part| part.exact.is_none()) {
            let total = compensated_sum(parts.map(|part| part.value));
            if total.is_finite() {
                return Self::new(total + 0.0);
            }
        }
        let exact = parts.iter().try_fold(Scaled::ZERO, |sum, part| Some(sum + part.exact()?));
        exact.map_or_else(|| Self::new(parts.iter().map(|part| part.value).sum()), Self::exactly)
    }
}

impl Neg for Amount {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, exact: self.exact.map(|exact| -exact) }
    }
}
