//! Tables of any number of axes, a block of rows at a time, from the outermost axis to the innermost.
//!
//! Along the innermost axis a row is interpolated on a half segment ([`super::pieces`]);
//! along an outer one both neighbouring groups are evaluated for the whole block and the values are interpolated as [`crate::numbers::between`] does.
//! Coordinates are clamped to the range of their group first, which gives the value at its end.
//!
//! An axis whose groups all have the same abscissae is searched once per block, however many groups a row's value needs; any other once for each of these.

use std::hint::select_unpredictable;
use std::ops::Range;

use super::axis::{Axis, BLOCK, Found, Noted};
use super::instruction_set::Lanes;
use super::pieces::{Piece, half_segments};
use super::{InstructionSet, Search, column_of};
use crate::numbers::{is_ordinary, two_difference};
use crate::table::{Level, PiecewiseTable, Sides};

/// A table whose value depends on at least one axis.
#[derive(Clone, Debug)]
pub(super) struct NestedKernel {
    /// The axes, innermost first.
    axes: Vec<Axis>,
    /// Half segments of all groups of the innermost axis.
    pieces: Vec<Piece>,
    /// Segments of all groups of each outer axis, innermost first.
    segments: Vec<Vec<Segment>>,
}

/// A segment of an outer axis, and the groups of the next axis inside at its ends.
#[derive(Clone, Copy, Debug)]
struct Segment {
    x0: f64,
    x1: f64,
    lower: u32,
    upper: u32,
}

impl NestedKernel {
    pub(super) fn new(table: &PiecewiseTable) -> Self {
        let levels = table.levels();
        let groups = |level: usize| -> Vec<Range<usize>> {
            match levels.get(level + 1) {
                Some(outer) => outer.children.windows(2).map(|pair| pair[0]..pair[1]).collect(),
                None => std::iter::once(0..levels[level].knots.len()).collect(),
            }
        };
        let innermost = &levels[0];
        let beyond = innermost.drops.then_some(0.0);
        let mut pieces = Vec::new();
        let mut breaks = Vec::new();
        for rows in groups(0) {
            let knots = &innermost.knots[rows.clone()];
            let (of_group, of_breaks) =
                half_segments(knots, &table.values()[rows.clone()], &table.slopes()[rows], beyond);
            pieces.extend(of_group);
            breaks.push(of_breaks);
        }
        let mut axes = vec![Axis::new(innermost, &groups(0), breaks, beyond.is_some())];
        let mut segments = Vec::new();
        for (level, of_level) in levels.iter().enumerate().skip(1) {
            let (axis, of_axis) = outer_axis(of_level, &groups(level));
            axes.push(axis);
            segments.push(of_axis);
        }
        Self { axes, pieces, segments }
    }

    pub(super) fn search(&self) -> Search {
        self.axes[0].search()
    }

    /// The values of all rows, and whether some are NaN.
    #[inline(always)]
    pub(super) fn values<L: Lanes>(
        &self,
        lanes: L,
        set: InstructionSet,
        columns: &[&[f64]],
        values: &mut [f64],
        mut sides: Option<&mut [Sides]>,
    ) -> bool {
        let rows = values.len();
        for axis in &self.axes {
            let _: &[f64] = column_of(columns, axis.column, rows);
        }
        let mut shared = vec![Found::default(); if self.axes.len() == 1 { 0 } else { self.axes.len() }];
        let mut own = Found::default();
        let mut has_nan = false;
        let mut first = 0;
        while first < rows {
            let values = &mut values[first..rows.min(first + BLOCK)];
            let part = first..first + values.len();
            let mut noted = sides.as_deref_mut().map(|sides| Noted::new(&mut sides[part.clone()]));
            if let [axis] = &self.axes[..] {
                let column = &columns[axis.column][part];
                axis.find(column, None, &mut own);
                lanes.interpolate(&self.pieces, &own.clamped, &own.pieces, values);
                if let Some(noted) = &mut noted {
                    axis.note(None, column, noted);
                }
            } else {
                for (axis, found) in self.axes.iter().zip(&mut shared).filter(|(axis, _)| axis.is_shared()) {
                    axis.find(&columns[axis.column][part.clone()], None, found);
                }
                let block = Block { kernel: self, set, height: self.axes.len() - 1, columns, first, shared: &shared };
                block.values(lanes, &[0; BLOCK], values, noted.as_mut());
            }
            has_nan |= values.iter().fold(false, |any, value| any | value.is_nan());
            first += BLOCK;
        }
        has_nan
    }
}

/// A block of rows during the recursion over the axes.
#[derive(Clone, Copy)]
struct Block<'a> {
    kernel: &'a NestedKernel,
    set: InstructionSet,
    /// The current axis.
    height: usize,
    columns: &'a [&'a [f64]],
    /// The block's first row.
    first: usize,
    /// Positions of the rows along the axes whose groups share their abscissae.
    shared: &'a [Found],
}

impl Block<'_> {
    /// The values of a block of rows, each in a group of its own of the axis `height`.
    #[inline(always)]
    fn values<L: Lanes>(self, lanes: L, groups: &[u32; BLOCK], values: &mut [f64], mut noted: Option<&mut Noted<'_>>) {
        let Self { kernel, set, height, columns, first, shared } = self;
        let rows = values.len();
        let axis = &kernel.axes[height];
        let column = &columns[axis.column][first..first + rows];
        let mut own = Found::default();
        let clamped = if axis.is_shared() {
            axis.places(groups, &shared[height].pieces, &mut own.pieces);
            &shared[height].clamped
        } else {
            axis.find(column, Some(groups), &mut own);
            &own.clamped
        };
        let takes_part = noted.as_deref_mut().map(|noted| {
            axis.note(Some(groups), column, noted);
            noted.takes_part
        });
        let Some(inside) = height.checked_sub(1) else {
            lanes.interpolate(&kernel.pieces, clamped, &own.pieces, values);
            return;
        };
        let segments = &kernel.segments[inside][..];
        let mut ends = [[0.0; BLOCK]; 2];
        let mut inner = [[0; BLOCK]; 2];
        for row in 0..rows {
            let segment = &segments[own.pieces[row] as usize];
            (ends[0][row], ends[1][row]) = (segment.x0, segment.x1);
            (inner[0][row], inner[1][row]) = (segment.lower, segment.upper);
        }
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
            let block = Self { height: inside, ..self };
            set.run(InnerValues { block, groups: &inner[side], values, noted: noted.as_deref_mut() });
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

/// [`Block::values`] one axis further inside: a separate call, in which the instruction set must be requested again.
struct InnerValues<'a, 'b> {
    block: Block<'a>,
    groups: &'a [u32; BLOCK],
    values: &'a mut [f64],
    noted: Option<&'a mut Noted<'b>>,
}

impl super::instruction_set::Operation for InnerValues<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes>(self, lanes: L) {
        self.block.values(lanes, self.groups, self.values, self.noted);
    }
}

/// An axis with other axes inside it.
fn outer_axis(level: &Level, groups: &[Range<usize>]) -> (Axis, Vec<Segment>) {
    let mut segments = Vec::new();
    let mut breaks = Vec::new();
    // Knot j owns group j of the next level inside.
    let child = |knot: usize| u32::try_from(knot).expect("a table has fewer than 2^32 rows");
    for group in groups {
        let knots = &level.knots[group.clone()];
        let last = knots.len() - 1;
        breaks.push(knots[last.min(1)..last].to_vec());
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
    (Axis::new(level, groups, breaks, false), segments)
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
