//! Division of two integers by `/`, which depends on the release (S-60).

use super::value::Value;
use crate::grammar::Release;
use crate::span::Span;

/// Division of an integer by an integer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Division {
    /// As Python 2 does, towards minus infinity: 5/4 = 1 (before release 2024).
    Floor,
    /// As Python 3 does: 5/4 = 1.25 (from release 2024 on).
    #[default]
    True,
}

impl Division {
    /// That of the Python version of a release.
    pub fn of_release(release: Release) -> Self {
        if release < Release::R2024 { Self::Floor } else { Self::True }
    }
}

/// A `/` between two integers with a remainder: its result depends on the release (S019).
#[derive(Debug, Clone, PartialEq)]
pub struct IntegerDivision {
    /// Dividend and divisor with the text between them.
    pub span: Span,
    /// The dividend as written.
    pub dividend: Span,
    /// The divisor as written.
    pub divisor: Span,
    /// The quotient before release 2024, rounded down.
    pub floor: Value,
    /// The quotient from release 2024 on.
    pub quotient: Value,
}
