//! Values and slopes of a table at a point: the scalar reference kernel.
//!
//! The innermost axis is interpolated with [`interpolate`] (1.5 ulp), the outer ones with [`between`] (0.5 ulp each).
//! In relative terms that is two roundings and one for each outer axis: a value of a table of non-negative rows is within n + 1 ulp of the exact one for n axes.

use std::cmp::Ordering;
use std::ops::Range;

use super::{Level, Marks, PiecewiseTable, Sides, Tail};
use crate::numbers::{between, interpolate, slope};

/// The coordinates of a query: axis 0, then the others.
#[derive(Clone, Copy)]
struct Point<'a> {
    first: f64,
    others: &'a [f64],
}

impl Point<'_> {
    /// The coordinate along `axis`; NaN where the caller gave none.
    #[inline]
    fn along(self, axis: usize) -> f64 {
        match axis {
            0 => self.first,
            _ => self.others.get(axis - 1).copied().unwrap_or(f64::NAN),
        }
    }
}

/// Where a coordinate lies among the abscissae of a group.
pub(crate) enum Place {
    Below,
    Knot(usize),
    Segment(usize),
    Above,
}

impl PiecewiseTable {
    /// The value at `point`, one coordinate an axis.
    ///
    /// A coordinate that is NaN or missing gives NaN, unless the table does not depend on that axis; infinities are beyond the range.
    #[inline]
    pub fn value(&self, point: &[f64]) -> f64 {
        let (first, others) = split(point);
        self.value_at(first, others)
    }

    /// [`Self::value`] with the coordinate of axis 0 apart from the others.
    pub fn value_at(&self, first: f64, others: &[f64]) -> f64 {
        self.descend_from_top(Point { first, others }, &mut |_, _| {})
    }

    /// The value, and along which axes the point lies outside the range of a group that took part in it.
    pub fn value_and_sides_at(&self, first: f64, others: &[f64]) -> (f64, Sides) {
        let point = Point { first, others };
        if let Some(marks) = &self.marks {
            return (self.value_at(first, others), marks.sides(point, self.is_undefined_at(point)));
        }
        let mut sides = Sides::default();
        let value = self.descend_from_top(point, &mut |axis, side| match side {
            Ordering::Less => sides.mark_below(axis),
            _ => sides.mark_above(axis),
        });
        (value, sides)
    }

    /// Whether it is not the rows that say which points lie outside: the table is what was left of a larger one.
    pub(crate) fn marks_sides(&self) -> bool {
        self.marks.is_some()
    }

    /// On which sides the points of some columns lie, for a folded table.
    pub(crate) fn mark_sides(&self, columns: &[&[f64]], sides: &mut [Sides]) {
        let Some(marks) = &self.marks else { return };
        let mut others = vec![f64::NAN; columns.len().saturating_sub(1)];
        for (row, sides) in sides.iter_mut().enumerate() {
            let coordinate = |axis: usize| columns.get(axis).and_then(|column| column.get(row)).copied();
            for (axis, other) in others.iter_mut().enumerate() {
                *other = coordinate(axis + 1).unwrap_or(f64::NAN);
            }
            let point = Point { first: coordinate(0).unwrap_or(f64::NAN), others: &others };
            *sides = marks.sides(point, self.is_undefined_at(point));
        }
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

    /// The slope along `axis` (semantics 4.4): that of the segment which holds the point, the right-hand one at a knot, zero outside and at the last knot.
    ///
    /// Across outer axes it is interpolated as values are; the slope along an outer axis is that between the interpolated values of the two groups.
    /// NaN where a coordinate the table depends on is NaN; infinite where the slope exceeds the range of f64.
    pub fn slope_at(&self, axis: usize, first: f64, others: &[f64]) -> f64 {
        let point = Point { first, others };
        if self.is_undefined_at(point) {
            return f64::NAN;
        }
        match self.levels.iter().position(|level| level.axis == axis) {
            None => 0.0,
            Some(target) => self.slope_along(target, self.top(), self.whole(), point),
        }
    }

    fn descend_from_top(&self, point: Point<'_>, note: &mut impl FnMut(usize, Ordering)) -> f64 {
        if self.is_undefined_at(point) {
            return f64::NAN;
        }
        self.descend(self.top(), self.whole(), point, note)
    }

    /// Whether a coordinate is NaN along an axis the value depends on.
    fn is_undefined_at(&self, point: Point<'_>) -> bool {
        self.levels.iter().any(|level| point.along(level.axis).is_nan())
    }

    /// The number of levels, each descent counting down from it.
    fn top(&self) -> usize {
        self.levels.len()
    }

    /// All knots of the outermost level, which is one group; for a table without levels its one row.
    fn whole(&self) -> Range<usize> {
        0..self.levels.last().map_or(1, |level| level.knots.len())
    }

    /// The value of one group: `knots` of the level below `height`, or the row itself at height 0.
    ///
    /// Goes down in a loop as long as one child decides, and into a recursion, at most one a level, where two are interpolated.
    fn descend(
        &self,
        mut height: usize,
        mut knots: Range<usize>,
        point: Point<'_>,
        note: &mut impl FnMut(usize, Ordering),
    ) -> f64 {
        while height > 0 {
            let level = &self.levels[height - 1];
            let x = point.along(level.axis);
            let knot = match level.place(&knots, x) {
                Place::Knot(knot) => knot,
                Place::Below => {
                    note(level.axis, Ordering::Less);
                    knots.start
                }
                Place::Above => {
                    note(level.axis, Ordering::Greater);
                    if self.drops_to_zero_beyond(level) {
                        return 0.0;
                    }
                    knots.end - 1
                }
                Place::Segment(left) => {
                    let (x0, x1) = (level.knots[left], level.knots[left + 1]);
                    if height == 1 {
                        return interpolate(x, (x0, self.values[left]), (x1, self.values[left + 1]), self.slopes[left]);
                    }
                    let y0 = self.descend(height - 1, level.children_of(left), point, note);
                    let y1 = self.descend(height - 1, level.children_of(left + 1), point, note);
                    return between(x, (x0, y0), (x1, y1));
                }
            };
            height -= 1;
            knots = if height == 0 { knot..knot + 1 } else { level.children_of(knot) };
        }
        self.values[knots.start]
    }

    /// The slope along the axis of level `target` of one group: `knots` of the level below `height`.
    fn slope_along(&self, target: usize, mut height: usize, mut knots: Range<usize>, point: Point<'_>) -> f64 {
        loop {
            let level = &self.levels[height - 1];
            let x = point.along(level.axis);
            let place = level.place(&knots, x);
            if height - 1 == target {
                return match place {
                    Place::Segment(left) => self.slope_of_segment(height, left, point),
                    Place::Knot(left) if left + 1 < knots.end => self.slope_of_segment(height, left, point),
                    _ => 0.0,
                };
            }
            let knot = match place {
                Place::Below => knots.start,
                Place::Knot(knot) => knot,
                Place::Above => knots.end - 1,
                Place::Segment(left) => {
                    let s0 = self.slope_along(target, height - 1, level.children_of(left), point);
                    let s1 = self.slope_along(target, height - 1, level.children_of(left + 1), point);
                    return between(x, (level.knots[left], s0), (level.knots[left + 1], s1));
                }
            };
            height -= 1;
            knots = level.children_of(knot);
        }
    }

    /// The slope of the segment that begins at knot `left` of the level below `height`.
    fn slope_of_segment(&self, height: usize, left: usize, point: Point<'_>) -> f64 {
        let level = &self.levels[height - 1];
        let end = |knot: usize| {
            let value = if height == 1 {
                self.values[knot]
            } else {
                self.descend(height - 1, level.children_of(knot), point, &mut |_, _| {})
            };
            (level.knots[knot], value)
        };
        slope(end(left), end(left + 1))
    }

    /// Whether the table is zero beyond the last knot of `level`.
    fn drops_to_zero_beyond(&self, level: &Level) -> bool {
        level.axis == 0 && self.tail == Tail::Zero
    }
}

impl Marks {
    /// On which sides a point lies; on none where the value is undefined.
    fn sides(&self, point: Point<'_>, is_undefined: bool) -> Sides {
        let mut sides = Sides::default();
        if is_undefined {
            return sides;
        }
        for (axis, (least, greatest)) in &self.ranges {
            let x = point.along(*axis);
            if x < *least {
                sides.mark_below(*axis);
            }
            // Between two groups without a common range a point is below one and above the other.
            if *greatest < x {
                sides.mark_above(*axis);
            }
        }
        sides.or(self.always)
    }
}

impl Level {
    /// Where `x` lies in the group of `knots`. A group of one knot is met by every `x` (T-07).
    pub(crate) fn place(&self, knots: &Range<usize>, x: f64) -> Place {
        if knots.len() == 1 {
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
