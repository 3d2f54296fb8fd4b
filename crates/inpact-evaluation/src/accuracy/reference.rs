//! Tables in double-double: what the other modes are measured against.
//!
//! The nested evaluation of T-06 with every level in 106 bits, so that the outer axes interpolate what the inner ones have found with both its parts.
//! Queries of ordinary exponents run on pairs of f64; where a difference, a width or a rise is extreme, the whole query is repeated with [`Scaled`] numbers,
//! whose exponent neither over- nor underflows.

use std::ops::Range;

use crate::numbers::{Scaled, is_ordinary, is_zero_or_ordinary, two_difference, two_product, two_sum};
use crate::table::{PiecewiseTable, Place, Tail};

impl PiecewiseTable {
    /// The value at a point to 2⁻⁹⁸ of the exact one for values of one sign, otherwise of the largest that take part in it.
    ///
    /// `first` is the coordinate of axis 0, `others` are those of the following axes.
    /// `None` where a coordinate the value depends on is NaN or missing; infinities are beyond the range, as in [`Self::value_at`].
    pub fn reference_at(&self, first: f64, others: &[f64]) -> Option<Scaled> {
        let along = |axis: usize| match axis {
            0 => first,
            _ => others.get(axis - 1).copied().unwrap_or(f64::NAN),
        };
        if self.levels.iter().any(|level| along(level.axis).is_nan()) {
            return None;
        }
        let (height, whole) = self.whole_group();
        if let Some(Pair(high, low)) = self.evaluate_group(height, whole.clone(), &along, &Pair::new, &Pair::between) {
            return Some(Scaled::new(high) + Scaled::new(low));
        }
        self.evaluate_group(height, whole, &along, &Scaled::new, &between_scaled)
    }

    /// [`Self::reference_at`] rounded once: within 0.501 ulp of the exact value for values of one sign. NaN where there is no value.
    pub fn reference_value_at(&self, first: f64, others: &[f64]) -> f64 {
        self.reference_at(first, others).map_or(f64::NAN, Scaled::to_f64)
    }

    /// The number of levels and the knots of the outermost one: the group that is the whole table.
    pub(super) fn whole_group(&self) -> (usize, Range<usize>) {
        (self.levels.len(), 0..self.levels.last().map_or(1, |level| level.knots.len()))
    }

    /// The value of one group, `knots` of the level below `height`, in any arithmetic `N` that knows a row's value and how to interpolate on a segment.
    ///
    /// `None` where `between` has none. No coordinate that matters may be NaN.
    pub(super) fn evaluate_group<N: Copy>(
        &self,
        mut height: usize,
        mut knots: Range<usize>,
        along: &impl Fn(usize) -> f64,
        of_row: &impl Fn(f64) -> N,
        between: &impl Fn(f64, (f64, N), (f64, N)) -> Option<N>,
    ) -> Option<N> {
        while height > 0 {
            let level = &self.levels[height - 1];
            let x = along(level.axis);
            let knot = match level.place(&knots, x) {
                Place::Knot(knot) => knot,
                Place::Below => knots.start,
                Place::Above if level.axis == 0 && self.tail == Tail::Zero => return Some(of_row(0.0)),
                Place::Above => knots.end - 1,
                Place::Segment(left) => {
                    let end = |knot: usize| {
                        let inner = if height == 1 { knot..knot + 1 } else { level.children_of(knot) };
                        Some((level.knots[knot], self.evaluate_group(height - 1, inner, along, of_row, between)?))
                    };
                    return between(x, end(left)?, end(left + 1)?);
                }
            };
            height -= 1;
            knots = if height == 0 { knot..knot + 1 } else { level.children_of(knot) };
        }
        Some(of_row(self.values[knots.start]))
    }
}

/// A number in two parts, high + low, with |low| at most half an ulp of high.
#[derive(Clone, Copy)]
struct Pair(f64, f64);

impl Pair {
    fn new(value: f64) -> Self {
        Self(value, 0.0)
    }

    /// The value at `x` of the straight line between two points, from the nearer one; `None` where a difference is so extreme that a part of the result could under- or overflow.
    fn between(x: f64, (x0, y0): (f64, Self), (x1, y1): (f64, Self)) -> Option<Self> {
        let ((near, base), (far, other)) = if x - x0 <= x1 - x { ((x0, y0), (x1, y1)) } else { ((x1, y1), (x0, y0)) };
        let (offset, offset_error) = two_difference(x, near);
        let (width, width_error) = two_difference(far, near);
        let (rise, rise_error) = two_difference(other.0, base.0);
        let is_safe = is_ordinary(offset)
            && is_ordinary(width)
            && is_zero_or_ordinary(rise)
            && is_zero_or_ordinary(base.0)
            && is_zero_or_ordinary(other.0);
        if !is_safe {
            return None;
        }
        let rise_error = rise_error + (other.1 - base.1);
        let part = offset / width;
        let part_error = ((-part).mul_add(width, offset) + (offset_error - part * width_error)) / width;
        let (step, step_error) = two_product(part, rise);
        let step_error = step_error + (part * rise_error + part_error * rise);
        let (value, value_error) = two_sum(base.0, step);
        let (high, low) = two_sum(value, value_error + (step_error + base.1));
        Some(Self(high, low))
    }
}

/// [`Pair::between`] for all finite numbers.
#[cold]
#[expect(clippy::unnecessary_wraps, reason = "the arithmetic of pairs can have no answer")]
fn between_scaled(x: f64, (x0, y0): (f64, Scaled), (x1, y1): (f64, Scaled)) -> Option<Scaled> {
    let ((near, base), (far, other)) = if x - x0 <= x1 - x { ((x0, y0), (x1, y1)) } else { ((x1, y1), (x0, y0)) };
    let part = Scaled::difference(x, near) / Scaled::difference(far, near);
    Some(base + part * (other + -base))
}
