//! Points that count as outside a table whose rows no longer say so: one that was folded, or whose groups all have one range.

use super::{PiecewiseTable, Point, Sides};

/// Which points lie outside a table that was folded from a larger one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Marks {
    /// Outside at every point: the folded coordinate lies there.
    pub(super) always: Sides,
    /// For an axis the bounds below and above which a point lies outside.
    pub(super) ranges: Vec<(usize, (f64, f64))>,
}

impl Marks {
    /// The range of an axis.
    pub(super) fn range(&self, axis: usize) -> (f64, f64) {
        let found = self.ranges.iter().find(|(marked, _)| *marked == axis);
        found.map_or((f64::NEG_INFINITY, f64::INFINITY), |(_, range)| *range)
    }

    /// On which sides a point lies; on none where the value is undefined.
    pub(super) fn sides(&self, point: Point<'_>, is_undefined: bool) -> Sides {
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

impl PiecewiseTable {
    /// Whether marks, not the rows, determine which points lie outside: the table was folded from a larger one.
    pub(crate) fn marks_sides(&self) -> bool {
        self.0.marks.is_some()
    }

    /// On which sides the points of some columns lie, for a table with marks.
    pub(crate) fn mark_sides(&self, columns: &[&[f64]], sides: &mut [Sides]) {
        let Some(marks) = &self.0.marks else { return };
        sides.fill(marks.always);
        for (axis, (least, greatest)) in &marks.ranges {
            for (x, sides) in columns[*axis].iter().zip(sides.iter_mut()) {
                if x < least {
                    sides.mark_below(*axis);
                }
                if greatest < x {
                    sides.mark_above(*axis);
                }
            }
        }
        // Where the value is undefined, so are the sides.
        for level in self.levels() {
            for (x, sides) in columns[level.axis].iter().zip(sides.iter_mut()) {
                if x.is_nan() {
                    *sides = Sides::default();
                }
            }
        }
    }

    /// The same table with marks, where the groups of each axis have one range; then no search is needed to find points outside.
    pub(crate) fn with_marks(&self) -> Option<Self> {
        if self.marks_sides() {
            return Some(self.clone());
        }
        let mut groups = 0..1;
        let mut ranges = Vec::new();
        for level in self.levels().iter().rev() {
            let mut bounds = groups.clone().map(|group| {
                // The groups of the outermost level are one, those of another the children of the knots outside it.
                let outside = self.levels().iter().rev().take_while(|other| other.axis != level.axis).last();
                let knots = outside.map_or(0..level.knots.len(), |outside| outside.children_of(group));
                (level.knots[knots.start], level.knots[knots.end - 1], knots.len())
            });
            let (least, greatest, first_count) = bounds.next()?;
            let is_one_range = (level.drops || first_count > 1)
                && bounds.all(|(first, last, count)| (level.drops || count > 1) && first == least && last == greatest);
            if !is_one_range {
                return None;
            }
            ranges.push((level.axis, (least, greatest)));
            groups = 0..level.knots.len();
        }
        Some(self.marked(Marks { always: Sides::default(), ranges }))
    }
}
