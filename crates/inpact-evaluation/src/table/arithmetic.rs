//! The arithmetics in which a table is evaluated: f64, f64 with a slope, double-double, and double-double with exponents that cannot overflow.

use std::cmp::Ordering;

use crate::numbers::{
    DoubleDouble, KernelSlope, Scaled, between, interpolate, is_ordinary, is_zero_or_ordinary, slope, two_difference,
    two_product, two_sum,
};

/// Operations on numbers that the evaluation of a table needs.
pub(super) trait Arithmetic {
    /// The value of a group of rows.
    type Number: Copy;

    /// The value of a row.
    fn of_row(&self, value: f64) -> Self::Number;

    /// The value at `x` on a segment of an axis, between two groups.
    fn between(&mut self, axis: usize, x: f64, start: (f64, Self::Number), end: (f64, Self::Number)) -> Self::Number;

    /// The value at `x` on a segment of the innermost axis, between two rows; `slope` is that of the segment.
    fn between_rows(
        &mut self,
        axis: usize,
        x: f64,
        (x0, y0): (f64, f64),
        (x1, y1): (f64, f64),
        _slope: KernelSlope,
    ) -> Self::Number {
        let (start, end) = (self.of_row(y0), self.of_row(y1));
        self.between(axis, x, (x0, start), (x1, end))
    }

    /// Called where a point lies before or beyond all abscissae of a group that contributes to the value.
    fn outside(&mut self, _axis: usize, _side: Ordering) {}

    /// Whether at an abscissa of `axis` the segment to its right is evaluated as well.
    fn looks_right_of_a_knot(&self, _axis: usize) -> bool {
        false
    }
}

/// f64: 1.5 ulp along the innermost axis ([`interpolate`]), half an ulp along each other ([`between`]); `outside` hears of what [`Arithmetic::outside`] does.
pub(super) struct Plain<F: FnMut(usize, Ordering)> {
    pub(super) outside: F,
}

impl<F: FnMut(usize, Ordering)> Arithmetic for Plain<F> {
    type Number = f64;

    #[inline]
    fn of_row(&self, value: f64) -> f64 {
        value
    }

    #[inline]
    fn between(&mut self, _: usize, x: f64, start: (f64, f64), end: (f64, f64)) -> f64 {
        between(x, start, end)
    }

    #[inline]
    fn between_rows(&mut self, _: usize, x: f64, start: (f64, f64), end: (f64, f64), slope: KernelSlope) -> f64 {
        interpolate(x, start, end, slope)
    }

    #[inline]
    fn outside(&mut self, axis: usize, side: Ordering) {
        (self.outside)(axis, side);
    }
}

/// [`Plain`], and the slope along one axis (semantics 4.4).
pub(super) struct WithSlope {
    /// The axis.
    pub(super) along: usize,
}

impl Arithmetic for WithSlope {
    /// The value and its slope.
    type Number = (f64, f64);

    fn of_row(&self, value: f64) -> (f64, f64) {
        (value, 0.0)
    }

    fn between(&mut self, axis: usize, x: f64, (x0, a): (f64, (f64, f64)), (x1, b): (f64, (f64, f64))) -> (f64, f64) {
        let value = between(x, (x0, a.0), (x1, b.0));
        let is_along = axis == self.along;
        (value, if is_along { slope((x0, a.0), (x1, b.0)) } else { between(x, (x0, a.1), (x1, b.1)) })
    }

    fn between_rows(
        &mut self,
        axis: usize,
        x: f64,
        start: (f64, f64),
        end: (f64, f64),
        of_segment: KernelSlope,
    ) -> (f64, f64) {
        let is_along = axis == self.along;
        (interpolate(x, start, end, of_segment), if is_along { slope(start, end) } else { 0.0 })
    }

    fn looks_right_of_a_knot(&self, axis: usize) -> bool {
        axis == self.along
    }
}

/// Double-double: 2⁻⁹⁸ of the exact value, for ordinary exponents.
#[derive(Default)]
pub(super) struct Double {
    /// A difference was so extreme that a part of the result could have under- or overflowed; the result is invalid.
    pub(super) is_out_of_range: bool,
}

impl Arithmetic for Double {
    type Number = DoubleDouble;

    fn of_row(&self, value: f64) -> DoubleDouble {
        DoubleDouble::new(value)
    }

    fn between(
        &mut self,
        _: usize,
        x: f64,
        (x0, y0): (f64, DoubleDouble),
        (x1, y1): (f64, DoubleDouble),
    ) -> DoubleDouble {
        let ((near, base), (far, other)) = if x - x0 <= x1 - x { ((x0, y0), (x1, y1)) } else { ((x1, y1), (x0, y0)) };
        let ((base, base_rest), (other, other_rest)) = (base.parts(), other.parts());
        let (offset, offset_error) = two_difference(x, near);
        let (width, width_error) = two_difference(far, near);
        let (rise, rise_error) = two_difference(other, base);
        self.is_out_of_range |=
            !(is_ordinary(offset) && is_ordinary(width) && [rise, base, other].into_iter().all(is_zero_or_ordinary));
        let rise_error = rise_error + (other_rest - base_rest);
        let part = offset / width;
        let part_error = ((-part).mul_add(width, offset) + (offset_error - part * width_error)) / width;
        let (step, step_error) = two_product(part, rise);
        let step_error = step_error + (part * rise_error + part_error * rise);
        let (value, value_error) = two_sum(base, step);
        DoubleDouble::of_parts(value, value_error + (step_error + base_rest))
    }
}

/// Double-double with an exponent of its own, for all finite numbers.
pub(super) struct AnyExponent;

impl Arithmetic for AnyExponent {
    type Number = Scaled;

    fn of_row(&self, value: f64) -> Scaled {
        Scaled::new(value)
    }

    fn between(&mut self, _: usize, x: f64, (x0, y0): (f64, Scaled), (x1, y1): (f64, Scaled)) -> Scaled {
        let ((near, base), (far, other)) = if x - x0 <= x1 - x { ((x0, y0), (x1, y1)) } else { ((x1, y1), (x0, y0)) };
        let part = Scaled::difference(x, near) / Scaled::difference(far, near);
        base + part * (other + -base)
    }
}
