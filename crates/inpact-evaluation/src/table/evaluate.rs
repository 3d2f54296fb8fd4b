//! Values and slopes of a table at a point: one recursion over the axes, generic over the arithmetic.
//!
//! In f64 the innermost axis is interpolated to 1.5 ulp, the outer ones to half an ulp each.
//! That is two roundings plus one for each outer axis: a value of a table of non-negative rows is within n + 1 ulp of the exact one for n axes.
//! In double-double every axis keeps 106 bits: the outer axes interpolate the results of the inner ones with both parts.

use std::cmp::Ordering;
use std::ops::Range;

use super::arithmetic::{AnyExponent, Arithmetic, Double, Plain, WithSlope};
use super::{Level, PiecewiseTable, Point, Sides};
use crate::numbers::Scaled;

/// Position of a coordinate among the abscissae of a group.
pub(super) enum Place {
    Below,
    Knot(usize),
    Segment(usize),
    Above,
}

impl PiecewiseTable {
    /// The value at `point`, one coordinate per axis.
    ///
    /// A coordinate that is NaN or missing gives NaN, unless the table does not depend on that axis; infinities are beyond the range.
    #[inline]
    pub fn value(&self, point: &[f64]) -> f64 {
        let (first, others) = split(point);
        self.value_at(first, others)
    }

    /// [`Self::value`] with the coordinate of axis 0 separate from the others.
    pub fn value_at(&self, first: f64, others: &[f64]) -> f64 {
        self.evaluate(&mut Plain { outside: |_, _| () }, Point { first, others }).unwrap_or(f64::NAN)
    }

    /// The value, and along which axes the point lies outside the range of a group that took part in it.
    pub fn value_and_sides_at(&self, first: f64, others: &[f64]) -> (f64, Sides) {
        let point = Point { first, others };
        if let Some(marks) = &self.0.marks {
            return (self.value_at(first, others), marks.sides(point, self.is_undefined_at(point)));
        }
        let mut sides = Sides::default();
        let outside = |axis, side| match side {
            Ordering::Less => sides.mark_below(axis),
            _ => sides.mark_above(axis),
        };
        let value = self.evaluate(&mut Plain { outside }, point).unwrap_or(f64::NAN);
        (value, sides)
    }

    /// Along which axes `point` lies outside the range of a group that takes part in the value there.
    pub fn sides(&self, point: &[f64]) -> Sides {
        let (first, others) = split(point);
        self.value_and_sides_at(first, others).1
    }

    /// The value at `point` and its slopes, one for each axis; `slopes` beyond the number of axes are set to zero.
    ///
    /// See [`Self::slope_at`] for the convention.
    pub fn value_and_slopes(&self, point: &[f64], slopes: &mut [f64]) -> f64 {
        let (first, others) = split(point);
        for (axis, slope) in slopes.iter_mut().enumerate() {
            *slope = self.slope_at(axis, first, others);
        }
        self.value_at(first, others)
    }

    /// The slope along `axis` (semantics 4.4): that of the segment which contains the point, the right-hand one at a knot, zero outside and at the last knot.
    ///
    /// Across outer axes it is interpolated as values are; the slope along an outer axis is that between the interpolated values of the two groups.
    /// NaN where a coordinate the table depends on is NaN; infinite where the slope exceeds the range of f64.
    pub fn slope_at(&self, axis: usize, first: f64, others: &[f64]) -> f64 {
        let found = self.evaluate(&mut WithSlope { along: axis }, Point { first, others });
        found.map_or(f64::NAN, |(_, slope)| slope)
    }

    /// [`Self::slope_at`] at the points of columns, one per axis, empty along axes that the value does not depend on; `axis` gives the axis for each row, `None` for no slope.
    pub(crate) fn slopes_in_columns(
        &self,
        columns: &[&[f64]],
        axis: impl Iterator<Item = Option<usize>>,
        mut take: impl FnMut(usize, f64),
    ) {
        let coordinate = |column: &[f64], row: usize| column.get(row).copied().unwrap_or(f64::NAN);
        let (first, others) = columns.split_first().map_or((&[][..], &[][..]), |(first, others)| (*first, others));
        let mut point = vec![f64::NAN; others.len()];
        for (row, axis) in axis.enumerate() {
            point.iter_mut().zip(others).for_each(|(x, column)| *x = coordinate(column, row));
            take(row, axis.map_or(0.0, |axis| self.slope_at(axis, coordinate(first, row), &point)));
        }
    }

    /// The value at a point to within 2⁻⁹⁸ of the exact one for values of one sign, otherwise of the largest value involved.
    ///
    /// `first` is the coordinate of axis 0, `others` are those of the following axes.
    /// `None` where a coordinate the value depends on is NaN or missing; infinities are beyond the range, as in [`Self::value_at`].
    pub fn reference_at(&self, first: f64, others: &[f64]) -> Option<Scaled> {
        let point = Point { first, others };
        let mut double = Double::default();
        let (high, low) = self.evaluate(&mut double, point)?.parts();
        if double.is_out_of_range {
            return self.evaluate(&mut AnyExponent, point);
        }
        Some(Scaled::new(high) + Scaled::new(low))
    }

    /// [`Self::reference_at`] rounded once: within 0.501 ulp of the exact value for values of one sign. NaN where there is no value.
    pub fn reference_value_at(&self, first: f64, others: &[f64]) -> f64 {
        self.reference_at(first, others).map_or(f64::NAN, Scaled::to_f64)
    }

    /// The value at a point in any arithmetic; `None` where a coordinate is NaN along an axis the value depends on.
    fn evaluate<A: Arithmetic>(&self, arithmetic: &mut A, point: Point<'_>) -> Option<A::Number> {
        if self.is_undefined_at(point) {
            return None;
        }
        // All knots of the outermost level are one group; of a table without levels the one row is the value.
        let whole = 0..self.levels().last().map_or(1, |level| level.knots.len());
        Some(self.group_value(arithmetic, self.levels().len(), whole, point))
    }

    /// Whether a coordinate is NaN along an axis the value depends on.
    fn is_undefined_at(&self, point: Point<'_>) -> bool {
        self.levels().iter().any(|level| point.along(level.axis).is_nan())
    }

    /// The value of one group: `knots` of the level below `height`, or the row itself at height 0.
    ///
    /// Descends in a loop as long as one child decides, and recursively, at most once per level, where two are interpolated.
    fn group_value<A: Arithmetic>(
        &self,
        arithmetic: &mut A,
        mut height: usize,
        mut knots: Range<usize>,
        point: Point<'_>,
    ) -> A::Number {
        while height > 0 {
            let level = &self.levels()[height - 1];
            let x = point.along(level.axis);
            let knot = match level.place(&knots, x) {
                Place::Knot(left) if left + 1 < knots.end && arithmetic.looks_right_of_a_knot(level.axis) => {
                    return self.segment_value(arithmetic, height, left, point);
                }
                Place::Knot(knot) => knot,
                Place::Below => {
                    arithmetic.outside(level.axis, Ordering::Less);
                    knots.start
                }
                Place::Above => {
                    arithmetic.outside(level.axis, Ordering::Greater);
                    if level.drops {
                        return arithmetic.of_row(0.0);
                    }
                    knots.end - 1
                }
                Place::Segment(left) => return self.segment_value(arithmetic, height, left, point),
            };
            height -= 1;
            knots = if height == 0 { knot..knot + 1 } else { level.children_of(knot) };
        }
        arithmetic.of_row(self.values()[knots.start])
    }

    /// The value on the segment that begins at knot `left` of the level below `height`.
    fn segment_value<A: Arithmetic>(
        &self,
        arithmetic: &mut A,
        height: usize,
        left: usize,
        point: Point<'_>,
    ) -> A::Number {
        let level = &self.levels()[height - 1];
        let x = point.along(level.axis);
        let (x0, x1) = (level.knots[left], level.knots[left + 1]);
        if height == 1 {
            let (y0, y1) = (self.values()[left], self.values()[left + 1]);
            return arithmetic.between_rows(level.axis, x, (x0, y0), (x1, y1), self.slopes()[left]);
        }
        let y0 = self.group_value(arithmetic, height - 1, level.children_of(left), point);
        let y1 = self.group_value(arithmetic, height - 1, level.children_of(left + 1), point);
        arithmetic.between(level.axis, x, (x0, y0), (x1, y1))
    }
}

impl Level {
    /// The position of `x` in the group of `knots`. A group of one knot contains every `x` (T-07), unless the value drops beyond it.
    pub(super) fn place(&self, knots: &Range<usize>, x: f64) -> Place {
        if knots.len() == 1 && !self.drops {
            return Place::Knot(knots.start);
        }
        let group = &self.knots[knots.clone()];
        let not_above = group.partition_point(|&knot| knot <= x);
        match not_above {
            0 => Place::Below,
            _ if group[not_above - 1] == x => Place::Knot(knots.start + not_above - 1),
            _ if not_above == group.len() => Place::Above,
            _ => Place::Segment(knots.start + not_above - 1),
        }
    }

    /// The knots of the level below that belong to `knot`.
    pub(crate) fn children_of(&self, knot: usize) -> Range<usize> {
        self.children[knot]..self.children[knot + 1]
    }
}

/// The coordinate of axis 0, NaN if there is none, and the others.
fn split(point: &[f64]) -> (f64, &[f64]) {
    point.split_first().map_or((f64::NAN, &[]), |(&first, others)| (first, others))
}
