//! The accuracy of tables that a user requests: a mode or a tolerance.

use super::{Accuracy, ErrorBound, Refusal};

/// The error a user accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// As a part of the largest magnitude among the table's values.
    RelativeToLargest(f64),
    /// As a part of the exact value at the same point.
    Pointwise(f64),
}

impl Tolerance {
    /// The part of a bound that is compared with the tolerance.
    fn of_bound(self, bound: &ErrorBound) -> f64 {
        match self {
            Self::RelativeToLargest(_) => bound.relative_to_largest,
            Self::Pointwise(_) => bound.pointwise,
        }
    }

    fn value(self) -> f64 {
        match self {
            Self::RelativeToLargest(value) | Self::Pointwise(value) => value,
        }
    }

    /// Why a bound is not within the tolerance, if it is not.
    pub(super) fn refusal(self, bound: &ErrorBound) -> Option<Refusal> {
        let (bound, tolerance) = (self.of_bound(bound), self.value());
        if bound <= tolerance { None } else { Some(Refusal::Bound { bound, tolerance }) }
    }
}

/// The requested accuracy: a mode or a tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// A mode. [`Accuracy::Fast`] takes a grid where it is faster than [`Accuracy::Full`] and its bound is within 1e-4 of the largest value.
    Mode(Accuracy),
    /// The cheapest mode within a tolerance; the reference where nothing is.
    Within(Tolerance),
}

impl Default for Wanted {
    fn default() -> Self {
        Self::Mode(Accuracy::default())
    }
}

impl Wanted {
    /// Whether values are requested in double-double precision.
    pub fn is_reference(self) -> bool {
        self == Self::Mode(Accuracy::Reference)
    }

    /// The tolerance, if a bound is above it.
    pub(crate) fn missed_by(self, bound: &ErrorBound) -> Option<f64> {
        match self {
            Self::Within(tolerance) if tolerance.refusal(bound).is_some() => Some(tolerance.value()),
            _ => None,
        }
    }

    /// Whether the error of one more rounding to f64 is acceptable, as a table has that is folded before it is evaluated.
    pub(crate) fn allows_folding(self) -> bool {
        match self {
            Self::Mode(accuracy) => accuracy != Accuracy::Reference,
            // The bounds of the table's own kernel are a few ulp of 2.2e-16.
            Self::Within(tolerance) => tolerance.value() >= 1e-14,
        }
    }
}

/// The tolerance of [`Accuracy::Fast`] where none is given: 1e-4 of the largest value of the table.
pub(crate) const FAST_TOLERANCE: Tolerance = Tolerance::RelativeToLargest(1e-4);
