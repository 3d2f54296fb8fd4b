//! Half segments: the pieces of an axis on which interpolation starts from the same end.
//!
//! [`crate::numbers::interpolate`] and [`crate::numbers::between`] start from the left end while `x - x0 <= x1 - x` and from the right end after that.
//! Both differences are monotone in x as computed, so that there is one last x of the left half, found here by bisection over the bits of f64:
//! at a query one search over the halves then gives segment and end together.
//! Buckets, which `search` fills, name the piece at their left end.

use std::hint::select_unpredictable;

use pulp::bytemuck::cast;

use crate::numbers::{KernelSlope, LEAST_ORDINARY, ORDINARY_LIMIT, is_ordinary, two_difference};

/// The numbers that interpolation needs on one half segment, first the abscissa of the end it starts from.
///
/// Between rows: the value there, the slope and its rounding error; the slope is NaN where the segment has no kernel slope.
/// Between groups: the difference to the abscissa of the other end, its rounding error, and the groups at both ends.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct Piece(pub(super) [f64; 4]);

impl Piece {
    fn between_rows(near: f64, base: f64, (high, low): (f64, f64)) -> Self {
        Self([near, base, high, low])
    }

    /// Where the difference is extreme, its rounding error is set to NaN, which makes every value NaN that is not the value of an end ([`between_or_nan`]).
    pub(super) fn between_groups(near: f64, far: f64, groups: [u32; 2]) -> Self {
        let (width, error) = two_difference(far, near);
        Self([near, width, if is_ordinary(width) { error } else { f64::NAN }, cast(groups)])
    }

    /// The groups at both ends, from the last number of a piece between groups.
    #[inline(always)]
    pub(super) fn groups(number: f64) -> [u32; 2] {
        cast(number)
    }

    /// The value at `x` between rows: [`crate::numbers::interpolate`], operation by operation; NaN where there is no kernel slope.
    #[inline(always)]
    pub(super) fn value(&self, x: f64) -> f64 {
        let [near, base, high, low] = self.0;
        let (offset, offset_error) = two_difference(x, near);
        let value = offset.mul_add(high, base);
        let value = value + (offset * low + offset_error * high);
        // A branch would be mispredicted wherever queries at knots, or clamped to the ends, are mixed with others.
        select_unpredictable(x == near, base, value)
    }
}

/// The piece at the left end of a bucket: where it ends and its index, side by side so that one load fetches both.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub(crate) struct Bucket(pub(super) [f64; 2]);

impl Bucket {
    pub(super) fn new(end: f64, piece: u32) -> Self {
        Self([end, f64::from_bits(u64::from(piece))])
    }

    /// The piece at `x`, if the bucket contains at most one break.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the low bits are the number")]
    pub(super) fn piece_at(self, x: f64) -> u32 {
        let [end, piece] = self.0;
        piece.to_bits() as u32 + u32::from(x >= end)
    }
}

/// The value at `x` between groups, of which `base` is the value at `near` and `other` that at the other end:
/// [`crate::numbers::between`], operation by operation and without branches; NaN where a difference is extreme.
#[inline(always)]
pub(super) fn between_or_nan(x: f64, near: f64, (width, width_error): (f64, f64), base: f64, other: f64) -> f64 {
    let (offset, offset_error) = two_difference(x, near);
    let (rise, rise_error) = two_difference(other, base);
    let part = offset / width;
    let remainder = (-part).mul_add(width, offset) + (offset_error - part * width_error);
    let part_error = remainder / width;
    let step = part * rise;
    let step_error = part.mul_add(rise, -step);
    let step_error = step_error + (part * rise_error + part_error * rise);
    let value = base + step;
    let step_part = value - base;
    let base_part = value - step_part;
    let value_error = (base - base_part) + (step - step_part);
    let value = value + (value_error + step_error);
    let (least, greatest) = if base < other { (base, other) } else { (other, base) };
    let value = if value < least { least } else { value };
    let value = if value > greatest { greatest } else { value };
    // The offset is no larger than the width, which is ordinary where the value is not NaN already.
    let ordinary = (offset.abs() >= LEAST_ORDINARY) & (rise.abs() >= LEAST_ORDINARY) & (rise.abs() < ORDINARY_LIMIT);
    let value = select_unpredictable(ordinary, value, f64::NAN);
    let value = select_unpredictable(x == near, base, value);
    select_unpredictable((base == other) & !x.is_nan(), base, value)
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

/// Half of a segment, by the knots of its group: `near` is the end that interpolation starts from, `far` the other; a group of one knot has one half without width.
pub(super) struct Half {
    /// The knot at the segment's left end.
    pub(super) left: usize,
    pub(super) near: usize,
    pub(super) far: usize,
}

/// The half segments of a group and where each but the first begins.
pub(super) fn halves(knots: &[f64]) -> (Vec<Half>, Vec<f64>) {
    let mut halves = Vec::with_capacity(2 * knots.len());
    let mut breaks = Vec::with_capacity(2 * knots.len());
    let last = knots.len() - 1;
    for left in 0..last {
        let (x0, x1) = (knots[left], knots[left + 1]);
        if left > 0 {
            breaks.push(x0);
        }
        halves.push(Half { left, near: left, far: left + 1 });
        let right_half = last_of_left_half(x0, x1).next_up();
        // The right half of an inner segment may contain only x1, which begins the next one.
        if right_half < x1 || left + 1 == last {
            breaks.push(right_half);
            halves.push(Half { left, near: left + 1, far: left });
        }
    }
    if last == 0 {
        halves.push(Half { left: 0, near: 0, far: 0 });
    }
    (halves, breaks)
}

/// The pieces of a group of the innermost axis and where each but the first begins; `beyond` is the value past the last knot, if it is not that of the knot.
pub(super) fn pieces(
    knots: &[f64],
    values: &[f64],
    slopes: &[KernelSlope],
    beyond: Option<f64>,
) -> (Vec<Piece>, Vec<f64>) {
    let (halves, mut breaks) = halves(knots);
    let slope = |half: &Half| if knots.len() == 1 { (0.0, 0.0) } else { slopes[half.left].parts() };
    let mut pieces: Vec<Piece> =
        halves.iter().map(|half| Piece::between_rows(knots[half.near], values[half.near], slope(half))).collect();
    if let Some(beyond) = beyond {
        let after = knots[knots.len() - 1].next_up();
        breaks.push(after);
        pieces.push(Piece::between_rows(after, beyond, (0.0, 0.0)));
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
