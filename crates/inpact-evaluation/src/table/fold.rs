//! Tables with fewer axes: what is left of a table where one of its variables has the same value in every row of a scene.
//!
//! The table is a nested piecewise-linear function (semantics T-05, T-06), so with one variable fixed it is one of the others:
//! a group that is interpolated between two others has the abscissae of both, and at each of them the interpolated value.
//! The new values are computed in 106 bits and rounded once, so that a folded table keeps the accuracy of the whole one.
//!
//! Knows nothing of scenes: the plan decides what to fold.

use super::marks::Marks;
use super::{PiecewiseTable, Sides, Tail};
use crate::numbers::Scaled;
use std::fmt;

/// The most rows a folded table may have; groups without a common abscissa add up.
const MOST_ROWS: usize = 1 << 20;

/// Why a table cannot be folded along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoldRefusal {
    /// The groups of an axis, counted from zero, have different ranges, so that no one range says which points lie beyond the table.
    RangesDiffer {
        /// The axis.
        axis: usize,
    },
    /// Groups of axis 0 between which values are interpolated drop to zero at different abscissae.
    DropsDiffer,
    /// The folded table would have more than a million rows.
    TooManyRows,
}

impl fmt::Display for FoldRefusal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RangesDiffer { .. } => formatter.write_str("its groups have different ranges"),
            Self::DropsDiffer => formatter.write_str("its groups drop to zero at different abscissae"),
            Self::TooManyRows => formatter.write_str("the folded table would have more than a million rows"),
        }
    }
}

impl std::error::Error for FoldRefusal {}

/// A part of a table while it is folded.
#[derive(Clone, Debug)]
enum Part {
    Value(Scaled),
    Group(Group),
}

/// A group of one axis: its abscissae and what is inside.
#[derive(Clone, Debug)]
struct Group {
    level: usize,
    knots: Vec<f64>,
    children: Vec<Part>,
    /// Below the first and above the second a point counts as outside.
    range: (f64, f64),
}

impl PiecewiseTable {
    /// The table for a finite coordinate `at` along `axis`, as a table with the same axes that no longer depends on that one.
    ///
    /// At every point its value is that of the whole table within half an ulp more than the bound of the axes that are left,
    /// and exact where the whole table's is a row's value; a point counts as outside ([`Sides`]) exactly where it did.
    /// Slopes are those of the folded table, whose values are rounded.
    ///
    /// # Errors
    /// [`FoldRefusal`], where the remaining function cannot be written as a table.
    ///
    /// # Example
    /// ```
    /// use inpact_evaluation::table::{PiecewiseTable, Tail};
    ///
    /// let rows = [[10.0, 0.0, 300.0], [2.0, 2.0, 300.0], [20.0, 0.0, 400.0], [10.0, 4.0, 400.0]];
    /// let table = PiecewiseTable::from_rows(rows.as_flattened(), 3, Tail::Constant)?;
    /// let folded = table.folded(1, 350.0)?;
    /// assert_eq!(folded.row_count(), 3); // clearances 0, 2 and 4
    /// assert_eq!(folded.value(&[2.0, f64::NAN]), table.value(&[2.0, 350.0]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn folded(&self, axis: usize, at: f64) -> Result<Self, FoldRefusal> {
        let Some(target) = self.levels().iter().position(|level| level.axis == axis) else { return Ok(self.clone()) };
        let mut folding = Folding { tail: self.tail(), target, at, sides: None, axis, rows: 0 };
        let whole = self.part(self.levels().len(), 0..self.levels().last().map_or(1, |level| level.knots.len()));
        let part = folding.fold(&whole)?;
        let mut ranges = vec![None; self.levels().len()];
        part.collect_ranges(&mut ranges)
            .map_err(|level| FoldRefusal::RangesDiffer { axis: self.levels()[level].axis })?;
        let mut sides = folding.sides.unwrap_or_default();
        if let Some(marks) = &self.0.marks {
            sides = sides.or(marks.always);
        }
        let ranges = self.levels().iter().zip(ranges).filter_map(|(level, range)| Some((level.axis, range?)));
        let marks = Marks { always: sides, ranges: ranges.collect() };
        let width = self.axis_count() + 1;
        let mut cells = Vec::new();
        let levels: Vec<usize> = self.levels().iter().map(|level| level.axis).collect();
        part.write_rows(&levels, &mut vec![0.0; width], &mut cells);
        let table = Self::from_rows(&cells, width, self.tail()).map_err(|_| FoldRefusal::TooManyRows)?;
        Ok(table.marked(marks))
    }

    /// The knots of the level below `height` as a part, with all that is inside.
    fn part(&self, height: usize, knots: std::ops::Range<usize>) -> Part {
        if height == 0 {
            return Part::Value(Scaled::new(self.values()[knots.start]));
        }
        let level = &self.levels()[height - 1];
        let children = knots.clone().map(|knot| {
            let inside = if height == 1 { knot..knot + 1 } else { level.children[knot]..level.children[knot + 1] };
            self.part(height - 1, inside)
        });
        let children = children.collect();
        let own = &level.knots[knots];
        let range = match (&self.0.marks, own) {
            (Some(marks), _) => marks.range(level.axis),
            (None, [first, .., last]) => (*first, *last),
            // A group of one row is met by every point (T-07).
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        };
        Part::Group(Group { level: height - 1, knots: own.to_vec(), children, range })
    }
}

/// A table being folded.
struct Folding {
    tail: Tail,
    target: usize,
    axis: usize,
    at: f64,
    /// Where `at` lies along the folded axis, once a group of it was met.
    sides: Option<Sides>,
    rows: usize,
}

impl Folding {
    fn fold(&mut self, part: &Part) -> Result<Part, FoldRefusal> {
        let Part::Group(group) = part else { return Ok(part.clone()) };
        if group.level == self.target {
            self.note_sides(group)?;
            let drops = group.level == 0
                && self.axis == 0
                && self.tail == Tail::Zero
                && group.knots.len() > 1
                && group.knots.last().is_some_and(|last| *last < self.at);
            return if drops { Ok(Part::Value(Scaled::ZERO)) } else { self.at_coordinate(group, self.at) };
        }
        let children: Result<Vec<Part>, FoldRefusal> = group.children.iter().map(|child| self.fold(child)).collect();
        Ok(Part::Group(Group { children: children?, ..group.clone() }))
    }

    /// All groups of the folded axis must lie on the same side of the coordinate.
    fn note_sides(&mut self, group: &Group) -> Result<(), FoldRefusal> {
        let mut sides = Sides::default();
        if self.at < group.range.0 {
            sides.mark_below(self.axis);
        }
        if self.at > group.range.1 {
            sides.mark_above(self.axis);
        }
        match self.sides.replace(sides) {
            Some(before) if before != sides => Err(FoldRefusal::RangesDiffer { axis: self.axis }),
            _ => Ok(()),
        }
    }

    /// What a group is at one coordinate of its axis.
    fn at_coordinate(&mut self, group: &Group, x: f64) -> Result<Part, FoldRefusal> {
        let not_above = group.knots.partition_point(|knot| *knot <= x);
        let last = group.knots.len() - 1;
        if not_above == 0 {
            return Ok(group.children[0].clone());
        }
        let left = not_above - 1;
        if left == last || group.knots[left] == x {
            return Ok(group.children[left].clone());
        }
        let (start, end) = (group.knots[left], group.knots[left + 1]);
        let width = Scaled::difference(end, start);
        // From the nearer end, so that a small value keeps its digits beside a large one.
        if x - start <= end - x {
            self.between(Scaled::difference(x, start) / width, &group.children[left], &group.children[left + 1])
        } else {
            self.between(Scaled::difference(end, x) / width, &group.children[left + 1], &group.children[left])
        }
    }

    /// The part a `weight` of the way, at most half, from one to the other.
    fn between(&mut self, weight: Scaled, near: &Part, far: &Part) -> Result<Part, FoldRefusal> {
        match (near, far) {
            (Part::Group(near), Part::Group(far)) => {
                if near.level == 0 && self.tail == Tail::Zero && drop_of(near) != drop_of(far) {
                    return Err(FoldRefusal::DropsDiffer);
                }
                let knots = common_knots(&near.knots, &far.knots);
                self.rows += knots.len();
                if self.rows > MOST_ROWS {
                    return Err(FoldRefusal::TooManyRows);
                }
                let children = knots.iter().map(|&knot| {
                    let near = self.at_coordinate(near, knot)?;
                    let far = self.at_coordinate(far, knot)?;
                    self.between(weight, &near, &far)
                });
                let children: Result<Vec<Part>, FoldRefusal> = children.collect();
                let range = (near.range.0.max(far.range.0), near.range.1.min(far.range.1));
                Ok(Part::Group(Group { level: near.level, children: children?, knots, range }))
            }
            (Part::Value(near), Part::Value(far)) => Ok(Part::Value(*near + weight * (*far + -*near))),
            // Every group of a table has the same axes inside.
            _ => Ok(near.clone()),
        }
    }
}

/// The abscissae of two groups together; a group of one row is constant and adds none (T-07).
fn common_knots(a: &[f64], b: &[f64]) -> Vec<f64> {
    if a.len() == 1 || b.len() == 1 {
        return if a.len() == 1 { b.to_vec() } else { a.to_vec() };
    }
    let mut knots: Vec<f64> = a.iter().chain(b).copied().collect();
    knots.sort_unstable_by(f64::total_cmp);
    // Abscissae are compared as numbers (T-10): −0 and 0 are one.
    knots.dedup();
    knots
}

/// Where a group of axis 0 drops to zero; nowhere with one row (T-07).
fn drop_of(group: &Group) -> Option<f64> {
    group.knots.last().copied().filter(|_| group.knots.len() > 1)
}

impl Part {
    /// Puts the common range of the groups of each level into `ranges`; the level whose groups have none in common is the error.
    fn collect_ranges(&self, ranges: &mut [Option<(f64, f64)>]) -> Result<(), usize> {
        let Self::Group(group) = self else { return Ok(()) };
        match ranges[group.level].replace(group.range) {
            Some(before) if before != group.range => return Err(group.level),
            _ => {}
        }
        group.children.iter().try_for_each(|child| child.collect_ranges(ranges))
    }

    /// Adds the rows of the part; `row` holds the abscissae outside it.
    fn write_rows(&self, axes: &[usize], row: &mut [f64], cells: &mut Vec<f64>) {
        match self {
            Self::Value(value) => {
                row[0] = value.to_f64();
                cells.extend_from_slice(row);
            }
            Self::Group(group) => {
                for (knot, child) in group.knots.iter().zip(&group.children) {
                    row[axes[group.level] + 1] = *knot;
                    child.write_rows(axes, row, cells);
                }
            }
        }
    }
}
