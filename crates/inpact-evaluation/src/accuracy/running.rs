//! Running error analysis of the slope form, in f64 and in f32: how far its values can be from those of the table.
//!
//! Let k, y be the knots and values of the table and k̂, ŷ what they are rounded to. A coordinate x of the segment [k₀, k₁] is rounded to x̂, which lies in [k̂₀, k̂₁], since rounding keeps order:
//! a query never falls into another segment. Let φ be the linear map of [k₀, k₁] on [k̂₀, k̂₁]. The line through (k̂, ŷ) has at φ(x) the value of the table at x but for the rounding of y; so the error is at most, on the innermost axis,
//!
//! - the rounding of the values, |ŷ − y|,
//! - slope × |x̂ − φ(x)|, where |x̂ − φ(x)| is at most the rounding of x and that of the knots,
//! - the rounding of the offset, |Δy|·u, unless the offset is exact, and what the slope has lost, times the offset,
//! - the rounding of the result, u·|ŷ|,
//!
//! each a linear function along the segment, whose ends are therefore all that is looked at. Across an outer axis the values of two groups with errors E are interpolated at a place t that is wrong by
//! the same two roundings over the width of the segment and by three of the arithmetic; that costs as much of the largest difference of the two groups ([`Spread`]).
//! Terms of second order are covered by a factor 1 + 32u, gradual underflow by half a smallest subnormal.
//!
//! For f64 coordinates and knots are not rounded, and only the last two points remain.

use std::ops::Range;

use super::ErrorBound;
use super::flat::{Flat, FlatLevel};
use super::largest_magnitude;
use super::number::Number;
use super::spread::{Spread, extremes};
use crate::numbers::Scaled;
use crate::table::PiecewiseTable;

/// The error of a group over all coordinates of its axes.
#[derive(Clone, Copy)]
struct GroupError {
    absolute: f64,
    pointwise: f64,
}

/// Factor for what is of second order in the unit roundoff.
fn second_order<T: Number>() -> f64 {
    1.0 + 32.0 * T::UNIT
}

/// The error bound of a slope form.
pub(super) fn bound<T: Number>(table: &PiecewiseTable, flat: &Flat<T>) -> ErrorBound {
    let (height, whole) = table.whole_group();
    let error = group_error(table, flat, height, 0, whole);
    ErrorBound::of_magnitudes(error.absolute, error.pointwise, largest_magnitude(&table.values))
}

/// The error of group number `group` of the level below `height`, which has the knots `knots`.
fn group_error<T: Number>(
    table: &PiecewiseTable,
    flat: &Flat<T>,
    height: usize,
    group: usize,
    knots: Range<usize>,
) -> GroupError {
    if height == 1 {
        return row_errors(table, flat, &knots);
    }
    let level = &table.levels[height - 1];
    let inner = |knot: usize| group_error(table, flat, height - 1, knot, level.children_of(knot));
    let mut left = inner(knots.start);
    let mut worst = left;
    for knot in knots.start..knots.end - 1 {
        let right = inner(knot + 1);
        let (a, b) = (level.children_of(knot), level.children_of(knot + 1));
        let (least_a, greatest_a) = extremes(table, height - 1, a.clone());
        let (least_b, greatest_b) = extremes(table, height - 1, b.clone());
        let (least, greatest) = (least_a.min(least_b), greatest_a.max(greatest_b));
        let smallest = if least > 0.0 || greatest < 0.0 { least.abs().min(greatest.abs()) } else { 0.0 };
        let spread = Spread::of(table, height - 1, a, b);
        let segment = Segment {
            place: place_error(&flat.levels[height - 1], &level.knots, knot),
            spread,
            largest: least.abs().max(greatest.abs()),
            smallest,
        };
        worst = worst.with(segment.error::<T>(left, right));
        left = right;
    }
    debug_assert!(group < flat.levels[height - 1].groups.len(), "groups are numbered by the knots outside");
    worst
}

/// One segment of an outer axis: what it adds to the errors of the two groups at its ends.
struct Segment {
    /// How far the place between the groups can be off: by the rounding of coordinates, and relative to itself.
    place: (f64, f64),
    spread: Spread,
    largest: f64,
    smallest: f64,
}

impl Segment {
    fn error<T: Number>(&self, a: GroupError, b: GroupError) -> GroupError {
        let (shift, relative) = self.place;
        let inner = a.absolute.max(b.absolute);
        let computed_difference = self.spread.difference + a.absolute + b.absolute;
        let absolute = inner
            + (shift + relative + T::UNIT) * computed_difference
            + T::UNIT * (self.largest + inner)
            + T::UNDERFLOW * (1.0 + computed_difference);
        let inner = a.pointwise.max(b.pointwise);
        let of_inner = if inner == 0.0 { 0.0 } else { (a.pointwise + b.pointwise) * (1.0 + self.spread.ratio) };
        let ratio = self.spread.ratio + of_inner;
        let pointwise = inner
            + product(shift, ratio)
            + (relative + T::UNIT) * ratio.max(1.0)
            + T::UNIT * (1.0 + inner)
            + part(T::UNDERFLOW * (1.0 + computed_difference), self.smallest);
        GroupError { absolute: absolute * second_order::<T>(), pointwise: judged(pointwise * second_order::<T>()) }
    }
}

/// How far the place on the segment from `left` to the next knot of an outer axis can be off: by the rounding of coordinate and knots, as a part of the width;
/// and by that of the arithmetic, relative to the place itself.
fn place_error<T: Number>(level: &FlatLevel<T>, knots: &[f64], left: usize) -> (f64, f64) {
    let (start, end) = (level.knots[left].at.exact(), level.knots[left + 1].at.exact());
    let width = end - start;
    let shift = shift::<T>(knots[left], start).max(shift::<T>(knots[left + 1], end));
    // What the inverse of the width has lost, and the roundings of the offset and of the product.
    let whole = Scaled::new(level.knots[left].rate.exact()) * Scaled::difference(end, start);
    let inverse_error = (whole + -Scaled::new(1.0)).to_f64().abs() * (1.0 + f64::EPSILON);
    let offset_unit = if offsets_are_exact(start, end) { 0.0 } else { T::UNIT };
    (shift / width, inverse_error + offset_unit + T::UNIT)
}

/// How far a coordinate near the knot `knot`, rounded to `rounded`, can be from where it stood in its segment.
fn shift<T: Number>(knot: f64, rounded: f64) -> f64 {
    if T::UNIT < f64::EPSILON {
        return 0.0;
    }
    T::UNIT * knot.abs() + T::UNDERFLOW + (rounded - knot).abs()
}

/// The error of one group of the innermost axis.
fn row_errors<T: Number>(table: &PiecewiseTable, flat: &Flat<T>, rows: &Range<usize>) -> GroupError {
    let level = &flat.levels[0];
    let values = &table.values;
    let value_error = |row: usize| (level.knots[row].value.exact() - values[row]).abs();
    let at_knot = |row: usize| {
        let absolute = value_error(row);
        GroupError { absolute, pointwise: judged(part(absolute, values[row].abs())) }
    };
    let mut worst = at_knot(rows.end - 1);
    for row in rows.start..rows.end - 1 {
        let (left, right) = (level.knots[row], level.knots[row + 1]);
        let (x0, x1) = (left.at.exact(), right.at.exact());
        let (y0, y1) = (left.value.exact(), right.value.exact());
        let (width, rise, rate) = (x1 - x0, (y1 - y0).abs(), left.rate.exact());
        let knots = &table.levels[0].knots;
        let exact_slope = Scaled::difference(y1, y0) / Scaled::difference(x1, x0);
        let slope = exact_slope.to_f64();
        let rate_error = (exact_slope + -Scaled::new(rate)).to_f64().abs();
        let offset_unit = if offsets_are_exact(x0, x1) { 0.0 } else { T::UNIT };
        // Where the slope is zero the fused operation is exact.
        let (result_unit, underflow) = if rate == 0.0 { (0.0, 0.0) } else { (T::UNIT, T::UNDERFLOW) };
        let moved = |knot: usize, rounded: f64| shift::<T>(knots[knot], rounded).min(width) * slope.abs();
        let at_left = value_error(row) + moved(row, x0) + result_unit * y0.abs() + underflow;
        let at_right = value_error(row + 1)
            + moved(row + 1, x1)
            + offset_unit * rise
            + result_unit * y1.abs()
            + rate_error * width * (1.0 + f64::EPSILON)
            + underflow;
        let (at_left, at_right) = (at_left * second_order::<T>(), at_right * second_order::<T>());
        let (start, end) = (values[row], values[row + 1]);
        let parts = (part(at_left, start.abs()), part(at_right, end.abs()));
        let pointwise = if start.signum() != end.signum() && start != 0.0 && end != 0.0 {
            f64::INFINITY
        } else if start.abs().min(end.abs()) < f64::MIN_POSITIVE {
            // The quotient of error and value is not monotone where the value passes the smallest normal number.
            parts.0 + parts.1
        } else {
            parts.0.max(parts.1)
        };
        worst = worst.with(GroupError { absolute: at_left.max(at_right), pointwise: judged(pointwise) });
    }
    worst
}

/// Whether x − x₀ is never rounded for x from `x0` to `x1`: the two are within a factor of two of each other (Sterbenz), or `x0` is zero.
fn offsets_are_exact(x0: f64, x1: f64) -> bool {
    x0 == 0.0 || (0.0 < x0 && x1 <= 2.0 * x0) || (x1 < 0.0 && 2.0 * x1 <= x0)
}

impl GroupError {
    fn with(self, other: Self) -> Self {
        Self { absolute: self.absolute.max(other.absolute), pointwise: self.pointwise.max(other.pointwise) }
    }
}

/// `error` as a part of `magnitude`, or of the smallest normal number below that.
fn part(error: f64, magnitude: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / magnitude.max(f64::MIN_POSITIVE) }
}

/// A product in which zero wins over infinity.
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a * b }
}

/// A relative error that says nothing any more is infinite.
fn judged(pointwise: f64) -> f64 {
    if pointwise < 1e15 { pointwise } else { f64::INFINITY }
}
