//! On which sides of a table's range a point lies, axis by axis.

/// The axes along which a point lies outside the table, below the first or above the last abscissa of some group that took part in the value.
///
/// Axes 0 to 62 have flags of their own; the 64th and all after it share one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sides {
    below: u64,
    above: u64,
}

impl Sides {
    /// Whether the point lies within the range along every axis.
    #[inline]
    pub fn is_within(self) -> bool {
        self.below | self.above == 0
    }

    /// Whether the point lies below the first abscissa of `axis`.
    pub fn is_below(self, axis: usize) -> bool {
        self.below & flag(axis) != 0
    }

    /// Whether the point lies above the last abscissa of `axis`.
    pub fn is_above(self, axis: usize) -> bool {
        self.above & flag(axis) != 0
    }

    /// The union of the sides.
    #[must_use]
    pub(crate) fn or(self, other: Self) -> Self {
        Self { below: self.below | other.below, above: self.above | other.above }
    }

    #[inline]
    pub(crate) fn mark_below(&mut self, axis: usize) {
        self.below |= flag(axis);
    }

    #[inline]
    pub(crate) fn mark_above(&mut self, axis: usize) {
        self.above |= flag(axis);
    }
}

#[inline]
fn flag(axis: usize) -> u64 {
    1 << axis.min(63)
}
