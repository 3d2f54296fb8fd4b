//! Properties of a column, computed in one vectorised pass: minimum and maximum, counts of non-finite numbers and of numbers of extreme magnitude.
//!
//! A running minimum depends on the previous one; here each of [`LANES`] lanes has its own, and the lanes are reduced at the end.

#![expect(clippy::needless_bitwise_bool, reason = "a branch a number would keep a loop from its vectors")]

use super::InstructionSet;
use super::instruction_set::Operation;
use super::lanes::Lanes;
use crate::numbers::is_moderate;

/// The number of lanes, each with its own minimum and maximum.
const LANES: usize = 64;

/// Properties of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extremes {
    /// The smallest of the finite numbers, the first of those that are equal; infinity where there is none.
    pub(crate) least: f64,
    /// The largest of them; minus infinity where there is none.
    pub(crate) greatest: f64,
    /// The number of NaNs and infinities.
    pub(crate) non_finite: u64,
}

/// The extremes of a column.
pub(crate) fn extremes(values: &[f64]) -> Extremes {
    if values.len() < LANES {
        return values.iter().fold(Extremes::default(), |found, value| found.with(*value));
    }
    let mut found = InstructionSet::best().run(FindExtremes { values });
    // 0 and −0 are equal: the first of them is the result of a sequential comparison.
    let first_zero = || values.iter().copied().find(|value| *value == 0.0);
    if found.least == 0.0 {
        found.least = first_zero().unwrap_or(found.least);
    }
    if found.greatest == 0.0 {
        found.greatest = first_zero().unwrap_or(found.greatest);
    }
    found
}

impl Default for Extremes {
    fn default() -> Self {
        Self { least: f64::INFINITY, greatest: f64::NEG_INFINITY, non_finite: 0 }
    }
}

impl Extremes {
    /// Those of one number more.
    #[inline(always)]
    fn with(self, value: f64) -> Self {
        let is_finite = value.abs() < f64::INFINITY;
        Self {
            least: if is_finite & (value < self.least) { value } else { self.least },
            greatest: if is_finite & (self.greatest < value) { value } else { self.greatest },
            non_finite: self.non_finite + u64::from(!is_finite),
        }
    }
}

struct FindExtremes<'a> {
    values: &'a [f64],
}

impl Operation for FindExtremes<'_> {
    type Output = Extremes;

    #[inline(always)]
    fn call<L: Lanes>(self, _: L) -> Extremes {
        let mut least = [f64::INFINITY; LANES];
        let mut greatest = [f64::NEG_INFINITY; LANES];
        let mut non_finite = [0_u64; LANES];
        for block in self.values.chunks(LANES) {
            let lanes = least.iter_mut().zip(&mut greatest).zip(&mut non_finite);
            for (value, ((least, greatest), non_finite)) in block.iter().zip(lanes) {
                let is_finite = value.abs() < f64::INFINITY;
                *least = if is_finite & (*value < *least) { *value } else { *least };
                *greatest = if is_finite & (*greatest < *value) { *value } else { *greatest };
                *non_finite += u64::from(!is_finite);
            }
        }
        let ends = least.into_iter().chain(greatest);
        let whole = ends.filter(|end| end.is_finite()).fold(Extremes::default(), Extremes::with);
        Extremes { non_finite: non_finite.into_iter().sum(), ..whole }
    }
}

/// The number of positive numbers; NaN is not.
pub(crate) fn count_above_zero(values: &[f64]) -> u64 {
    InstructionSet::best().run(Count { values, is_counted: |value| value > 0.0 })
}

/// Whether a number is below zero; NaN is not.
pub(crate) fn has_below_zero(values: &[f64]) -> bool {
    InstructionSet::best().run(Count { values, is_counted: |value| value < 0.0 }) > 0
}

struct Count<'a, F> {
    values: &'a [f64],
    is_counted: F,
}

impl<F: Fn(f64) -> bool> Operation for Count<'_, F> {
    type Output = u64;

    #[inline(always)]
    fn call<L: Lanes>(self, _: L) -> u64 {
        self.values.iter().fold(0, |count, value| count + u64::from((self.is_counted)(*value)))
    }
}

/// Whether a number is below `below` or above `above`; NaN is neither.
pub(crate) fn has_outside(values: &[f64], below: f64, above: f64) -> bool {
    InstructionSet::best().run(Count { values, is_counted: |value| (value < below) | (above < value) }) > 0
}

/// Whether all numbers are moderate ([`is_moderate`]).
pub(crate) fn are_moderate(values: &[f64]) -> bool {
    InstructionSet::best().run(Count { values, is_counted: |value| !is_moderate(value) }) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sequentially.
    fn plainly(values: &[f64]) -> Extremes {
        let mut found = Extremes { least: f64::INFINITY, greatest: f64::NEG_INFINITY, non_finite: 0 };
        for value in values {
            if !value.is_finite() {
                found.non_finite += 1;
                continue;
            }
            found.least = if *value < found.least { *value } else { found.least };
            found.greatest = if found.greatest < *value { *value } else { found.greatest };
        }
        found
    }

    #[test]
    fn extremes_are_those_of_one_number_after_the_other() {
        let specials = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 5e-324, -1.5, f64::MAX, f64::MIN];
        let mut state = 1_u64;
        for count in (0..300).chain([1000, 8192]) {
            let mut next = || {
                state = state.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
                usize::try_from(state >> 40).expect("24 bits")
            };
            for kinds in 1..=specials.len() {
                let values: Vec<f64> = (0..count).map(|_| specials[next() % kinds]).collect();
                let (found, expected) = (extremes(&values), plainly(&values));
                let bits = |of: Extremes| (of.least.to_bits(), of.greatest.to_bits(), of.non_finite);
                assert_eq!(bits(found), bits(expected), "{values:?}");
                let above = values.iter().filter(|value| **value > 0.0).count() as u64;
                assert_eq!(count_above_zero(&values), above);
                assert_eq!(has_below_zero(&values), values.iter().any(|value| *value < 0.0));
                assert_eq!(are_moderate(&values), values.iter().all(|v| is_moderate(*v)));
            }
        }
    }
}
