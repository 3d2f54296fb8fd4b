//! Values compared with the exact result and with the guaranteed bound.

use super::judge::{exact, ulps_from};
use inpact_evaluation::table::ErrorBound;
use num_rational::BigRational;
use num_traits::Signed;

/// The error of one value.
#[derive(Clone, Copy)]
pub(super) struct Judged {
    /// In ulp of the exact value; infinite for a value that is not finite.
    ulps: f64,
    is_within_bound: bool,
}

/// The errors of many values.
#[derive(Clone, Copy, Default)]
pub(super) struct Errors {
    /// The largest, in ulp.
    pub(super) largest: f64,
    /// The number of values farther from the exact one than the bound.
    pub(super) outside: usize,
}

/// Compares a value; `wanted` is finite.
pub(super) fn judged(value: f64, wanted: &BigRational, bound: &ErrorBound) -> Judged {
    if !value.is_finite() {
        return Judged { ulps: f64::INFINITY, is_within_bound: false };
    }
    // A bound that has overflowed guarantees nothing.
    let is_within_bound = bound.absolute == f64::INFINITY || (exact(value) - wanted).abs() <= exact(bound.absolute);
    Judged { ulps: ulps_from(value, wanted), is_within_bound }
}

impl Errors {
    /// Adds one.
    pub(super) fn add(&mut self, judged: Judged) {
        self.largest = self.largest.max(judged.ulps);
        self.outside += usize::from(!judged.is_within_bound);
    }
}
