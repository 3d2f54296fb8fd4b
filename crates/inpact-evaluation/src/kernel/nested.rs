//! Tables of any number of axes, a block of rows at a time, from the outermost axis to the innermost.
//!
//! Along the innermost axis a row is interpolated on a half segment ([`super::pieces`]);
//! along an outer one both neighbouring groups are evaluated for the whole block and the values are interpolated as [`crate::numbers::between`] does.
//! Coordinates are clamped to the range of their group first, which gives the value at its end.
//!
//! An axis whose groups all have the same abscissae is searched once per block, however many groups a row's value needs; any other once for each of these.
//! Each step is a separate loop over the block, so that the latencies of one row overlap with those of others; the columns of the next block are prefetched.

use std::ops::Range;

use super::axis::{Axis, Found, Noted};
use super::lanes::{BLOCK, Lanes};
use super::pieces::{Piece, between_or_nan, halves, pieces};
use super::{InstructionSet, Search, column_of};
use crate::table::{Level, PiecewiseTable, Sides};

/// A table whose value depends on at least one axis.
#[derive(Clone, Debug)]
pub(super) struct NestedKernel {
    /// The axes, innermost first.
    axes: Vec<Axis>,
    /// Half segments of all groups of the innermost axis.
    pieces: Vec<Piece>,
    /// Half segments of all groups of each outer axis, innermost first.
    spans: Vec<Vec<Piece>>,
}

/// Intermediate results of a block along one axis.
#[derive(Clone, Debug)]
struct Scratch {
    /// The positions of the rows in the groups that are evaluated.
    own: Found,
    /// The numbers of the half segments that contain them.
    span: [[f64; BLOCK]; 4],
    /// The groups of the next axis inside at both ends.
    groups: [[u32; BLOCK]; 2],
    /// The values at the far ends.
    far_values: [f64; BLOCK],
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
        let mut all_pieces = Vec::new();
        let mut breaks = Vec::new();
        for rows in groups(0) {
            let knots = &innermost.knots[rows.clone()];
            let (of_group, of_breaks) = pieces(knots, &table.values()[rows.clone()], &table.slopes()[rows], beyond);
            all_pieces.extend(of_group);
            breaks.push(of_breaks);
        }
        let mut axes = vec![Axis::new(innermost, &groups(0), breaks, beyond.is_some())];
        let mut spans = Vec::new();
        for (level, of_level) in levels.iter().enumerate().skip(1) {
            let (axis, of_axis) = outer_axis(of_level, &groups(level));
            axes.push(axis);
            spans.push(of_axis);
        }
        Self { axes, pieces: all_pieces, spans }
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
        let axis_count = if self.axes.len() == 1 { 0 } else { self.axes.len() };
        let mut shared = vec![Found::default(); axis_count];
        let mut scratch = vec![Scratch::default(); axis_count];
        let mut own = Found::default();
        let mut has_nan = false;
        let mut first = 0;
        while first < rows {
            let values = &mut values[first..rows.min(first + BLOCK)];
            let part = first..first + values.len();
            let next = part.end..rows.min(part.end + BLOCK);
            let mut noted = sides.as_deref_mut().map(|sides| Noted::new(&mut sides[part.clone()]));
            if let [axis] = &self.axes[..] {
                let column = &columns[axis.column][part];
                axis.find(lanes, column, None, &mut own);
                lanes.prefetch(&columns[axis.column][next]);
                lanes.interpolate(&self.pieces, &own.clamped[..values.len()], &own.pieces[..values.len()], values);
                if let Some(noted) = &mut noted {
                    axis.note(None, column, noted);
                }
            } else {
                for (axis, found) in self.axes.iter().zip(&mut shared).filter(|(axis, _)| axis.is_shared()) {
                    axis.find(lanes, &columns[axis.column][part.clone()], None, found);
                }
                for axis in &self.axes {
                    lanes.prefetch(&columns[axis.column][next.clone()]);
                }
                let block = Block { kernel: self, set, columns, first, shared: &shared };
                block.values(lanes, &[0; BLOCK], &mut scratch, values, noted.as_mut());
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
    columns: &'a [&'a [f64]],
    /// The block's first row.
    first: usize,
    /// Positions of the rows along the axes whose groups share their abscissae.
    shared: &'a [Found],
}

impl Block<'_> {
    /// The values of a block of rows, each in a group of its own of the outermost axis that there is `scratch` for.
    #[inline(always)]
    fn values<L: Lanes>(
        self,
        lanes: L,
        groups: &[u32; BLOCK],
        scratch: &mut [Scratch],
        values: &mut [f64],
        mut noted: Option<&mut Noted<'_>>,
    ) {
        let Self { kernel, set, columns, first, shared } = self;
        let rows = values.len();
        let Some((scratch, inside)) = scratch.split_last_mut() else { return };
        let Scratch { own, span, groups: [near_groups, far_groups], far_values } = scratch;
        let height = inside.len();
        let axis = &kernel.axes[height];
        let column = &columns[axis.column][first..first + rows];
        let clamped = if axis.is_shared() {
            axis.places(groups, &shared[height].pieces, &mut own.pieces);
            &shared[height].clamped
        } else {
            axis.find(lanes, column, Some(groups), own);
            &own.clamped
        };
        let takes_part = noted.as_deref_mut().map(|noted| {
            axis.note(Some(groups), column, noted);
            noted.takes_part
        });
        if height == 0 {
            lanes.interpolate(&kernel.pieces, &clamped[..rows], &own.pieces[..rows], values);
            return;
        }
        lanes.fetch(&kernel.spans[height - 1], &own.pieces[..rows], span);
        let [near, width, width_error, children] = span;
        for (children, (near, far)) in children.iter().zip(near_groups.iter_mut().zip(&mut *far_groups)) {
            [*near, *far] = Piece::groups(*children);
        }
        let far_values = &mut far_values[..rows];
        let groups = [&*near_groups, &*far_groups];
        if height == 1 && kernel.axes[0].is_shared() {
            self.values_of_both(lanes, groups, &mut inside[0].groups, [&mut *values, &mut *far_values], noted);
        } else {
            let [near_groups, far_groups] = groups;
            set.run(InnerValues {
                block: self,
                groups: near_groups,
                scratch: &mut *inside,
                values: &mut *values,
                noted: noted.as_deref_mut(),
            });
            if let (Some(noted), Some(takes_part)) = (noted.as_deref_mut(), &takes_part) {
                for row in 0..rows {
                    // The group at an end is alone there.
                    noted.takes_part[row] = takes_part[row] && clamped[row] != near[row];
                }
            }
            set.run(InnerValues {
                block: self,
                groups: far_groups,
                scratch: inside,
                values: &mut *far_values,
                noted: noted.as_deref_mut(),
            });
            if let (Some(noted), Some(takes_part)) = (noted, takes_part) {
                noted.takes_part = takes_part;
            }
        }
        let spans = near.iter().zip(width.iter().zip(&*width_error));
        for (((value, &far), &x), (&near, (&width, &width_error))) in
            values.iter_mut().zip(&*far_values).zip(clamped).zip(spans)
        {
            *value = between_or_nan(x, near, (width, width_error), *value, far);
        }
    }

    /// The values in two groups per row of an innermost axis whose groups share their abscissae.
    #[inline(always)]
    fn values_of_both<L: Lanes>(
        self,
        lanes: L,
        groups: [&[u32; BLOCK]; 2],
        places: &mut [[u32; BLOCK]; 2],
        values: [&mut [f64]; 2],
        noted: Option<&mut Noted<'_>>,
    ) {
        let (axis, found) = (&self.kernel.axes[0], &self.shared[0]);
        let rows = values[0].len();
        for (groups, places) in groups.into_iter().zip(&mut *places) {
            axis.places(groups, &found.pieces, places);
        }
        let [near, far] = places;
        lanes.interpolate_both(&self.kernel.pieces, &found.clamped[..rows], [&near[..rows], &far[..rows]], values);
        if let Some(noted) = noted {
            // The groups have one range, and one of them takes part.
            axis.note(None, &self.columns[axis.column][self.first..self.first + rows], noted);
        }
    }
}

/// [`Block::values`] one axis further inside: a separate call, in which the instruction set must be requested again.
struct InnerValues<'a, 'b> {
    block: Block<'a>,
    groups: &'a [u32; BLOCK],
    scratch: &'a mut [Scratch],
    values: &'a mut [f64],
    noted: Option<&'a mut Noted<'b>>,
}

impl super::instruction_set::Operation for InnerValues<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes>(self, lanes: L) {
        self.block.values(lanes, self.groups, self.scratch, self.values, self.noted);
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self { own: Found::default(), span: [[0.0; BLOCK]; 4], groups: [[0; BLOCK]; 2], far_values: [0.0; BLOCK] }
    }
}

/// An axis with other axes inside it.
fn outer_axis(level: &Level, groups: &[Range<usize>]) -> (Axis, Vec<Piece>) {
    let mut spans = Vec::new();
    let mut breaks = Vec::new();
    // Knot j owns group j of the next level inside.
    let child = |knot: usize| u32::try_from(knot).expect("a table has fewer than 2^32 rows");
    for group in groups {
        let knots = &level.knots[group.clone()];
        let (of_group, of_breaks) = halves(knots);
        spans.extend(of_group.iter().map(|half| {
            let children = [half.near, half.far].map(|knot| child(group.start + knot));
            Piece::between_groups(knots[half.near], knots[half.far], children)
        }));
        breaks.push(of_breaks);
    }
    (Axis::new(level, groups, breaks, false), spans)
}
