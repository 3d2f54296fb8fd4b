//! Tables of any number of axes, by buckets: blocks of rows that stay in cache, from the outermost axis to the innermost.
//!
//! Along the innermost axis a row is interpolated on a half segment ([`super::pieces`]);
//! along an outer one both neighbouring groups are evaluated for the whole block and the values are interpolated as [`crate::numbers::between`] does.
//! Coordinates are clamped to the range of their group first, which gives the value at its end.

use std::hint::select_unpredictable;

use super::buckets::{BISECTION, BITS, Breaks, GroupSearch, LINEAR, Search};
use super::pieces::{Piece, half_segments};
use super::{InstructionSet, column_of};
use crate::numbers::{is_ordinary, two_difference};
use crate::table::{Level, PiecewiseTable, Sides, Tail};

/// Rows that are taken through all axes together.
const BLOCK: usize = 256;

/// A table with at least one axis that matters.
#[derive(Clone, Debug)]
pub(super) struct NestedKernel {
    leaf: Axis,
    /// Half segments of all groups of the innermost axis.
    pieces: Vec<Piece>,
    /// The other axes, from the inside out.
    outer: Vec<(Axis, Vec<Segment>)>,
}

/// One axis: its groups and the search in them.
#[derive(Clone, Debug)]
struct Axis {
    /// Which axis of the rows this is.
    column: usize,
    ranges: Vec<GroupRange>,
    search: GroupSearch,
}

#[derive(Clone, Copy, Debug)]
struct GroupRange {
    /// The range coordinates are clamped to.
    least: f64,
    greatest: f64,
    /// Below and above these a point is outside the table; infinite in a group of one knot.
    below: f64,
    above: f64,
}

/// A segment of an outer axis, and the groups of the next axis inside at its ends.
#[derive(Clone, Copy, Debug)]
struct Segment {
    x0: f64,
    x1: f64,
    lower: u32,
    upper: u32,
}

/// Where the sides of the rows of a block are noted.
struct Noted<'a> {
    sides: &'a mut [Sides],
    /// Whether the group under evaluation takes part in the value of a row.
    takes_part: [bool; BLOCK],
}

impl NestedKernel {
    pub(super) fn new(table: &PiecewiseTable) -> Self {
        let levels = table.levels();
        let groups = |level: usize| -> Vec<std::ops::Range<usize>> {
            match levels.get(level + 1) {
                Some(outer) => outer.children.windows(2).map(|pair| pair[0]..pair[1]).collect(),
                None => std::iter::once(0..levels[level].knots.len()).collect(),
            }
        };
        let innermost = &levels[0];
        let drops = innermost.axis == 0 && table.tail() == Tail::Zero;
        let mut pieces = Vec::new();
        let mut leaf = AxisBuilder::default();
        for rows in groups(0) {
            let knots = &innermost.knots[rows.clone()];
            let (of_group, breaks) =
                half_segments(knots, &table.values()[rows.clone()], &table.slopes()[rows], drops.then_some(0.0));
            pieces.extend(of_group);
            leaf.push(knots, breaks, drops);
        }
        let outer = (1..levels.len()).map(|level| outer_axis(&levels[level], &groups(level))).collect();
        Self { leaf: leaf.build(innermost.axis), pieces, outer }
    }

    pub(super) fn search(&self) -> Search {
        self.leaf.search.kind()
    }

    /// The values of all rows, and whether some are NaN.
    #[inline(always)]
    pub(super) fn values(
        &self,
        set: InstructionSet,
        columns: &[&[f64]],
        values: &mut [f64],
        mut sides: Option<&mut [Sides]>,
    ) -> bool {
        let rows = values.len();
        for axis in std::iter::once(&self.leaf).chain(self.outer.iter().map(|(axis, _)| axis)) {
            let _: &[f64] = column_of(columns, axis.column, rows);
        }
        let mut has_nan = false;
        let mut first = 0;
        while first < rows {
            let values = &mut values[first..rows.min(first + BLOCK)];
            let mut noted = sides
                .as_deref_mut()
                .map(|sides| Noted { sides: &mut sides[first..first + values.len()], takes_part: [true; BLOCK] });
            if self.outer.is_empty() {
                let x = &columns[self.leaf.column][first..];
                self.leaf_values(x, None, values, noted.as_mut());
            } else {
                let block = Block { kernel: self, set, height: self.outer.len(), columns, first };
                block.values(&[0; BLOCK], values, noted.as_mut());
            }
            has_nan |= values.iter().fold(false, |any, value| any | value.is_nan());
            first += BLOCK;
        }
        has_nan
    }

    /// The values of a block of rows along the innermost axis, each in its group or all in the first.
    #[inline(always)]
    fn leaf_values(
        &self,
        column: &[f64],
        groups: Option<&[u32; BLOCK]>,
        values: &mut [f64],
        noted: Option<&mut Noted<'_>>,
    ) {
        let column = &column[..values.len()];
        let (mut clamped, mut found) = ([0.0; BLOCK], [0; BLOCK]);
        let (clamped, found) = (&mut clamped[..values.len()], &mut found[..values.len()]);
        self.leaf.find(column, groups, clamped, found);
        for ((&x, &piece), value) in clamped.iter().zip(&*found).zip(values) {
            *value = self.pieces[piece as usize].value(x);
        }
        if let Some(noted) = noted {
            for (row, (&x, sides)) in column.iter().zip(&mut *noted.sides).enumerate() {
                if noted.takes_part[row] {
                    self.leaf.note(groups.map_or(0, |groups| groups[row] as usize), x, sides);
                }
            }
        }
    }
}

/// A block of rows on its way through the axes.
#[derive(Clone, Copy)]
struct Block<'a> {
    kernel: &'a NestedKernel,
    set: InstructionSet,
    /// How many outer axes are still to be gone through.
    height: usize,
    columns: &'a [&'a [f64]],
    /// The block's first row.
    first: usize,
}

impl Block<'_> {
    /// The values of a block of rows, each in a group of its own below `height`.
    #[inline(always)]
    fn values(self, groups: &[u32; BLOCK], values: &mut [f64], mut noted: Option<&mut Noted<'_>>) {
        let Self { kernel, set, height, columns, first } = self;
        if height == 0 {
            let x = &columns[kernel.leaf.column][first..];
            return kernel.leaf_values(x, Some(groups), values, noted);
        }
        let (axis, segments) = &kernel.outer[height - 1];
        let rows = values.len();
        let column = &columns[axis.column][first..first + rows];
        let mut clamped = [0.0; BLOCK];
        let mut ends = [[0.0; BLOCK]; 2];
        let mut inner = [[0; BLOCK]; 2];
        let mut found = [0; BLOCK];
        let (clamped, found) = (&mut clamped[..rows], &mut found[..rows]);
        axis.find(column, Some(groups), clamped, found);
        for row in 0..rows {
            let segment = &segments[found[row] as usize];
            (ends[0][row], ends[1][row]) = (segment.x0, segment.x1);
            (inner[0][row], inner[1][row]) = (segment.lower, segment.upper);
        }
        let takes_part = noted.as_deref_mut().map(|noted| {
            for row in 0..rows {
                if noted.takes_part[row] {
                    axis.note(groups[row] as usize, column[row], &mut noted.sides[row]);
                }
            }
            noted.takes_part
        });
        let mut upper_values = [0.0; BLOCK];
        let upper_values = &mut upper_values[..rows];
        for (side, values) in [&mut *values, &mut *upper_values].into_iter().enumerate() {
            if let (Some(noted), Some(takes_part)) = (noted.as_deref_mut(), &takes_part) {
                for row in 0..rows {
                    let other_end = ends[1 - side][row];
                    // The group at an end is alone there; a segment without width is a group of one knot.
                    let is_other_alone = clamped[row] == other_end && (side == 1 || ends[0][row] < other_end);
                    noted.takes_part[row] = takes_part[row] && !is_other_alone;
                }
            }
            let inside = Self { height: height - 1, ..self };
            set.run(InnerValues { block: inside, groups: &inner[side], values, noted: noted.as_deref_mut() });
        }
        if let (Some(noted), Some(takes_part)) = (noted, takes_part) {
            noted.takes_part = takes_part;
        }
        let abscissae = clamped.iter().zip(ends[0].iter().zip(&ends[1]));
        for ((value, &upper), (&x, (&x0, &x1))) in values.iter_mut().zip(&*upper_values).zip(abscissae) {
            *value = between_or_nan(x, (x0, *value), (x1, upper));
        }
    }
}

/// [`Block::values`] one axis further inside: a call of its own, which the instruction set would be lost in if it were not asked for again.
struct InnerValues<'a, 'b> {
    block: Block<'a>,
    groups: &'a [u32; BLOCK],
    values: &'a mut [f64],
    noted: Option<&'a mut Noted<'b>>,
}

impl pulp::NullaryFnOnce for InnerValues<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.block.values(self.groups, self.values, self.noted);
    }
}

impl Axis {
    /// Clamps the coordinates of a block to the groups they are in and finds the pieces that hold them.
    #[inline(always)]
    fn find(&self, column: &[f64], groups: Option<&[u32; BLOCK]>, clamped: &mut [f64], pieces: &mut [u32]) {
        match (self.search.kind(), self.search.steps()) {
            (Search::LinearBuckets, 1) => self.find_by::<LINEAR, 1>(column, groups, clamped, pieces),
            (Search::LinearBuckets, 2) => self.find_by::<LINEAR, 2>(column, groups, clamped, pieces),
            (Search::LinearBuckets, _) => self.find_by::<LINEAR, 4>(column, groups, clamped, pieces),
            (Search::BitBuckets, 1) => self.find_by::<BITS, 1>(column, groups, clamped, pieces),
            (Search::BitBuckets, 2) => self.find_by::<BITS, 2>(column, groups, clamped, pieces),
            (Search::BitBuckets, _) => self.find_by::<BITS, 4>(column, groups, clamped, pieces),
            _ => self.find_by::<BISECTION, 0>(column, groups, clamped, pieces),
        }
    }

    #[inline(always)]
    fn find_by<const KIND: u8, const STEPS: usize>(
        &self,
        column: &[f64],
        groups: Option<&[u32; BLOCK]>,
        clamped: &mut [f64],
        pieces: &mut [u32],
    ) {
        if let (Some(groups), true) = (groups, self.ranges.len() > 1) {
            for ((clamped, &x), &group) in clamped.iter_mut().zip(column).zip(groups) {
                *clamped = self.ranges[group as usize].clamp(x);
            }
            self.search.find::<KIND, STEPS>(clamped, |row| self.search.group(groups[row] as usize), pieces);
        } else {
            // One group for all: what it tells stays in registers.
            let (range, group) = (self.ranges[0], self.search.group(0));
            for (clamped, &x) in clamped.iter_mut().zip(column) {
                *clamped = range.clamp(x);
            }
            self.search.find::<KIND, STEPS>(clamped, |_| group, pieces);
        }
    }

    /// Notes whether `x` lies outside the group.
    #[inline(always)]
    fn note(&self, group: usize, x: f64, sides: &mut Sides) {
        let range = &self.ranges[group];
        if x < range.below {
            sides.mark_below(self.column);
        }
        if x > range.above {
            sides.mark_above(self.column);
        }
    }
}

impl GroupRange {
    /// `x` within the range; NaN stays NaN.
    #[inline(always)]
    fn clamp(&self, x: f64) -> f64 {
        let x = if x < self.least { self.least } else { x };
        if x > self.greatest { self.greatest } else { x }
    }
}

/// Collects the groups of an axis.
#[derive(Default)]
struct AxisBuilder {
    ranges: Vec<GroupRange>,
    breaks: Vec<Breaks>,
}

impl AxisBuilder {
    fn push(&mut self, knots: &[f64], breaks: Vec<f64>, drops: bool) {
        let (least, last) = (knots[0], knots[knots.len() - 1]);
        let range = if knots.len() == 1 {
            GroupRange { least, greatest: least, below: f64::NEG_INFINITY, above: f64::INFINITY }
        } else {
            GroupRange { least, greatest: if drops { last.next_up() } else { last }, below: least, above: last }
        };
        self.breaks.push(Breaks { least, greatest: range.greatest, at: breaks });
        self.ranges.push(range);
    }

    fn build(self, column: usize) -> Axis {
        Axis { column, search: GroupSearch::new(&self.breaks), ranges: self.ranges }
    }
}

/// An axis with other axes inside it.
fn outer_axis(level: &Level, groups: &[std::ops::Range<usize>]) -> (Axis, Vec<Segment>) {
    let mut segments = Vec::new();
    let mut axis = AxisBuilder::default();
    // Knot j owns group j of the next level inside.
    let child = |knot: usize| u32::try_from(knot).expect("a table has fewer than 2^32 rows");
    for group in groups {
        let knots = &level.knots[group.clone()];
        let last = knots.len() - 1;
        axis.push(knots, knots[last.min(1)..last].to_vec(), false);
        let segment = |left: usize, right: usize| Segment {
            x0: knots[left],
            x1: knots[right],
            lower: child(group.start + left),
            upper: child(group.start + right),
        };
        if last == 0 {
            segments.push(segment(0, 0));
        }
        segments.extend((0..last).map(|left| segment(left, left + 1)));
    }
    (axis.build(level.axis), segments)
}

/// [`crate::numbers::between`], operation by operation and without branches; NaN where a difference is extreme.
#[inline(always)]
fn between_or_nan(x: f64, (x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> f64 {
    let from_left = x - x0 <= x1 - x;
    let (near, far) = (select_unpredictable(from_left, x0, x1), select_unpredictable(from_left, x1, x0));
    let (base, other) = (select_unpredictable(from_left, y0, y1), select_unpredictable(from_left, y1, y0));
    let (offset, offset_error) = two_difference(x, near);
    let (width, width_error) = two_difference(far, near);
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
    let ordinary = is_ordinary(offset) & is_ordinary(width) & is_ordinary(rise);
    let value = select_unpredictable(ordinary, value, f64::NAN);
    let value = select_unpredictable(x == near, base, value);
    let value = select_unpredictable(base == other, base, value);
    select_unpredictable(x.is_nan(), f64::NAN, value)
}
