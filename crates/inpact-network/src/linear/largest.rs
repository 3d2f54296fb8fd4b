//! The largest of some shares.

/// The largest of some non-negative numbers; NaN where one is NaN, which `f64::max` would ignore.
pub(crate) fn largest_or_nan(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |largest: f64, number| if number > largest || number.is_nan() { number } else { largest })
}
