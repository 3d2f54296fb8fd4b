//! Sums that keep what each addition rounds away.

use super::float::{two_product, two_sum};
use super::scaled::Scaled;

/// A running sum in two parts, the rounded total and what rounding has taken from it (Neumaier's form).
///
/// After n terms the error is about n·2⁻¹⁰⁶ of the sum of magnitudes plus half an ulp of the result: ten million steps are exact to the last bit unless they cancel.
/// Terms that overflow on the way make it infinite, as they would a plain sum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompensatedSum {
    sum: f64,
    compensation: f64,
}

impl CompensatedSum {
    /// A sum of which the rounded total and what rounding has taken from it are known.
    pub(crate) fn from_parts(sum: f64, compensation: f64) -> Self {
        Self { sum, compensation }
    }

    /// Adds one term.
    #[inline]
    pub fn add(&mut self, term: f64) {
        let (sum, error) = two_sum(self.sum, term);
        self.sum = sum;
        self.compensation += error;
    }

    /// Adds the product of `a` and `b` with the digits its rounding loses.
    #[inline]
    pub fn add_product(&mut self, a: f64, b: f64) {
        let (product, error) = two_product(a, b);
        self.add(product);
        if error.is_finite() {
            self.compensation += error;
        }
    }

    /// Adds a term of twice the precision of f64.
    pub fn add_scaled(&mut self, term: Scaled) {
        let (value, rest) = term.to_pair();
        self.add(value);
        if value.is_finite() {
            self.compensation += rest;
        }
    }

    /// Adds another sum with its compensation, so that blocks summed apart lose nothing when they are put together.
    pub fn merge(&mut self, other: &Self) {
        self.add(other.sum);
        self.compensation += other.compensation;
    }

    /// The sum, rounded once.
    #[inline]
    pub fn total(&self) -> f64 {
        if self.sum.is_finite() { self.sum + self.compensation } else { self.sum }
    }
}

impl Extend<f64> for CompensatedSum {
    fn extend<T: IntoIterator<Item = f64>>(&mut self, terms: T) {
        for term in terms {
            self.add(term);
        }
    }
}

impl FromIterator<f64> for CompensatedSum {
    fn from_iter<T: IntoIterator<Item = f64>>(terms: T) -> Self {
        let mut sum = Self::default();
        sum.extend(terms);
        sum
    }
}
