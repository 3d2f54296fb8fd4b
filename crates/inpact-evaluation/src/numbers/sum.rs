//! Compensated sums: the rounding error of each addition is kept.

use super::float::{two_product, two_sum};
use super::scaled::Scaled;

/// A compensated sum: the rounded total and the accumulated rounding error (Neumaier).
///
/// After n terms the error is about n·2⁻¹⁰⁶ of the sum of magnitudes plus half an ulp of the result: ten million terms are exact to the last bit unless they cancel.
/// Overflow of a partial sum makes it infinite, as in a plain sum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompensatedSum {
    sum: f64,
    compensation: f64,
}

impl CompensatedSum {
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

    /// Adds a product, rounded, and what the rounding took away.
    #[inline]
    fn add_exact_product(&mut self, product: f64, error: f64) {
        self.add(product);
        self.compensation += error;
    }

    /// Adds a term of twice the precision of f64.
    pub fn add_scaled(&mut self, term: Scaled) {
        let (value, rest) = term.to_pair();
        self.add(value);
        if value.is_finite() {
            self.compensation += rest;
        }
    }

    /// Adds another sum with its compensation, so that blocks can be summed separately without loss.
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
    #[inline]
    fn extend<T: IntoIterator<Item = f64>>(&mut self, terms: T) {
        for term in terms {
            self.add(term);
        }
    }
}

impl FromIterator<f64> for CompensatedSum {
    #[inline]
    fn from_iter<T: IntoIterator<Item = f64>>(terms: T) -> Self {
        let mut sum = Self::default();
        sum.extend(terms);
        sum
    }
}

/// The sum of a few terms, rounded about once.
#[inline]
pub(crate) fn compensated_sum<const N: usize>(terms: [f64; N]) -> f64 {
    terms.into_iter().collect::<CompensatedSum>().total()
}

/// 2⁹⁰⁰ and 2¹⁰⁰⁰: many terms below the first added to a sum below the second are far from overflow.
const SMALL: f64 = f64::from_bits((1023 + 900) << 52);
const LARGE: f64 = f64::from_bits((1023 + 1000) << 52);

/// A [`CompensatedSum`] whose terms and partial sums may exceed the range of f64: it is finite wherever the exact sum is.
///
/// As long as all stay within the range it costs as much as a compensated sum; once one exceeds it, the sum continues in [`Scaled`] numbers,
/// and is accurate to 2⁻¹⁰² of the largest term or partial sum.
/// Infinite and NaN terms have the same effect as in a plain sum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnboundedSum {
    plain: CompensatedSum,
    /// The sum, once it or a term has exceeded the range.
    beyond: Option<Box<Scaled>>,
}

impl UnboundedSum {
    /// Adds one term.
    #[inline]
    pub fn add(&mut self, term: f64) {
        self.add_plain(|sum| sum.add(term), || term.is_finite().then(|| Scaled::new(term)));
    }

    fn add_all(&mut self, terms: &[f64]) {
        for term in terms {
            self.add(*term);
        }
    }

    /// Adds the terms of one column to each of some sums, row by row, as [`add`](Self::add) does.
    ///
    /// # Panics
    /// If there are fewer columns than sums, or one is shorter than the first.
    pub(crate) fn add_columns(sums: &mut [Self], columns: &[&[f64]]) {
        let count = columns.first().map_or(0, |column| column.len());
        let mut first = 0;
        while first < count {
            let rows = first..count.min(first + Self::BLOCK);
            first = rows.end;
            // Two sums at a time: each addition depends on the previous one, and the other sum hides the latency.
            for (pair, columns) in sums.chunks_mut(2).zip(columns.chunks(2)) {
                match (pair, columns) {
                    ([one, other], [a, b]) => {
                        let (a, b) = (&a[rows.clone()], &b[rows.clone()]);
                        if one.stays_within(a) && other.stays_within(b) {
                            let (mut sums, terms) = ((one.plain, other.plain), a.iter().zip(b));
                            terms.for_each(|(a, b)| (sums.0.add(*a), sums.1.add(*b)).0);
                            (one.plain, other.plain) = sums;
                        } else {
                            one.add_all(a);
                            other.add_all(b);
                        }
                    }
                    (sums, columns) => {
                        for (sum, column) in sums.iter_mut().zip(columns) {
                            sum.add_all(&column[rows.clone()]);
                        }
                    }
                }
            }
        }
    }

    /// Adds a product, rounded, and its rounding error, both far from over- and underflow, as [`add_product`](Self::add_product) does.
    #[inline]
    pub(crate) fn add_exact_product(&mut self, product: f64, error: f64) {
        if self.beyond.is_none() && self.plain.sum.abs() < LARGE {
            self.plain.add_exact_product(product, error);
        } else {
            self.add_exact_product_to_large(product, error);
        }
    }

    #[cold]
    fn add_exact_product_to_large(&mut self, product: f64, error: f64) {
        let exact = || Some(Scaled::new(product) + Scaled::new(error));
        self.add_plain(|sum| sum.add_exact_product(product, error), exact);
    }

    /// The block size in terms.
    const BLOCK: usize = 512;

    /// Whether [`Self::BLOCK`] terms no larger than these can be added without checking the result: sum and terms are far from overflow.
    fn stays_within(&self, terms: &[f64]) -> bool {
        let CompensatedSum { sum, compensation } = self.plain;
        self.beyond.is_none()
            && sum.abs() < LARGE
            && compensation.abs() < LARGE
            && terms.iter().fold(true, |all, term| all & (term.abs() < SMALL))
    }

    /// Adds the product of `a` and `b` with the digits its rounding loses.
    #[inline]
    pub fn add_product(&mut self, a: f64, b: f64) {
        let exact = || (a.is_finite() && b.is_finite()).then(|| Scaled::new(a) * Scaled::new(b));
        self.add_plain(|sum| sum.add_product(a, b), exact);
    }

    /// Adds a term of double-double precision.
    pub fn add_scaled(&mut self, term: Scaled) {
        self.add_plain(|sum| sum.add_scaled(term), || Some(term));
    }

    /// Adds a term by plain compensation as long as that stays finite; `exact` is the term, where it is finite.
    #[inline]
    fn add_plain(&mut self, add: impl FnOnce(&mut CompensatedSum), exact: impl FnOnce() -> Option<Scaled>) {
        if self.beyond.is_none() {
            let before = self.plain;
            add(&mut self.plain);
            if !self.plain.total().is_finite() {
                self.go_beyond(before, exact());
            }
        } else if let Some(term) = exact() {
            self.beyond = self.beyond.take().map(|sum| Box::new(*sum + term));
        } else {
            (self.beyond, self.plain) = (None, CompensatedSum::default());
            add(&mut self.plain);
        }
    }

    #[cold]
    fn go_beyond(&mut self, before: CompensatedSum, term: Option<Scaled>) {
        if let (Some(term), true) = (term, before.total().is_finite()) {
            let CompensatedSum { sum, compensation } = before;
            self.beyond = Some(Box::new(Scaled::new(sum) + Scaled::new(compensation) + term));
        }
    }

    /// The sum, rounded once; infinite where it exceeds the range of f64.
    #[inline]
    pub fn total(&self) -> f64 {
        self.beyond.as_ref().map_or_else(|| self.plain.total(), |sum| sum.to_f64() + 0.0)
    }
}
