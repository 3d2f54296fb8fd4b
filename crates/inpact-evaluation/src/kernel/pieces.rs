//! Half segments: the pieces of an axis on which interpolation starts from the same end.
//!
//! [`crate::numbers::interpolate`] starts from the left end while `x - x0 <= x1 - x` and from the right end after that.
//! Both differences are monotone in x as computed, so that there is one last x of the left half, found here by bisection over the bits of f64:
//! at a query one search over the halves then gives segment and end together.

use std::hint::select_unpredictable;

use crate::numbers::KernelSlope;

/// The numbers that interpolation needs on one half segment: the abscissa of the end it starts from and the value there,
/// the slope and its rounding error; the slope is NaN where the segment has no kernel slope.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct Piece(pub(super) [f64; 4]);

impl Piece {
    pub(super) fn new(near: f64, base: f64, (high, low): (f64, f64)) -> Self {
        Self([near, base, high, low])
    }

    /// The value at `x`: [`crate::numbers::interpolate`], operation by operation; NaN where there is no kernel slope.
    #[inline(always)]
    pub(super) fn value(&self, x: f64) -> f64 {
        let [near, base, high, low] = self.0;
        let (offset, offset_error) = crate::numbers::two_difference(x, near);
        let value = offset.mul_add(high, base);
        let value = value + (offset * low + offset_error * high);
        // A branch would be mispredicted wherever queries at knots, or clamped to the ends, are mixed with others.
        select_unpredictable(x == near, base, value)
    }
}

/// The last x of the segment that is interpolated from its left end.
pub(super) fn last_of_left_half(x0: f64, x1: f64) -> f64 {
    let (mut left, mut right) = (ordered(x0), ordered(x1));
    while i128::from(right) - i128::from(left) > 1 {
        // Halfway without overflow; rounding towards minus infinity keeps it from reaching `right`.
        let middle = (left & right) + ((left ^ right) >> 1);
        let x = from_ordered(middle);
        if x - x0 <= x1 - x {
            left = middle;
        } else {
            right = middle;
        }
    }
    from_ordered(left)
}

/// The half segments of a group and where each but the first begins; `beyond` is the value past the last knot, if it is not that of the knot.
pub(super) fn half_segments(
    knots: &[f64],
    values: &[f64],
    slopes: &[KernelSlope],
    beyond: Option<f64>,
) -> (Vec<Piece>, Vec<f64>) {
    let mut pieces = Vec::with_capacity(2 * knots.len());
    let mut breaks = Vec::with_capacity(2 * knots.len());
    let last = knots.len() - 1;
    for left in 0..last {
        let (x0, x1) = (knots[left], knots[left + 1]);
        let slope = slopes[left].parts();
        if left > 0 {
            breaks.push(x0);
        }
        pieces.push(Piece::new(x0, values[left], slope));
        let right_half = last_of_left_half(x0, x1).next_up();
        // The right half of an inner segment may contain only x1, which begins the next one.
        if right_half < x1 || left + 1 == last {
            breaks.push(right_half);
            pieces.push(Piece::new(x1, values[left + 1], slope));
        }
    }
    if last == 0 {
        pieces.push(Piece::new(knots[0], values[0], (0.0, 0.0)));
    }
    if let Some(beyond) = beyond {
        let after = knots[last].next_up();
        breaks.push(after);
        pieces.push(Piece::new(after, beyond, (0.0, 0.0)));
    }
    (pieces, breaks)
}

/// Integers in the order of the numbers; −0 comes just before 0.
#[inline(always)]
pub(super) fn ordered(x: f64) -> i64 {
    let bits = x.to_bits().cast_signed();
    bits ^ ((bits >> 63).cast_unsigned() >> 1).cast_signed()
}

/// The inverse of [`ordered`].
fn from_ordered(order: i64) -> f64 {
    f64::from_bits((order ^ ((order >> 63).cast_unsigned() >> 1).cast_signed()).cast_unsigned())
}
