//! One axis of a table: the groups of its abscissae, the search in them, and which rows lie outside.

use std::ops::Range;

use super::Search;
use super::lanes::{BLOCK, Lanes};
use super::search::{BISECTION, BITS, Breaks, GroupSearch, LINEAR};
use crate::table::{Level, Sides};

/// One axis: its groups and the search in them.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    /// The axis of the rows.
    pub(super) column: usize,
    /// The ranges of its groups; one where all have the same abscissae.
    ranges: Vec<GroupRange>,
    search: GroupSearch,
    /// The number of pieces of a group where all have the same abscissae, otherwise 0: then pieces are numbered across all groups.
    stride: u32,
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

/// Positions of the rows of a block along an axis.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// The coordinates within the range of their group.
    pub(super) clamped: [f64; BLOCK],
    /// The pieces that contain them.
    pub(super) pieces: [u32; BLOCK],
}

impl Default for Found {
    #[inline(always)]
    fn default() -> Self {
        Self { clamped: [0.0; BLOCK], pieces: [0; BLOCK] }
    }
}

/// Where the sides of the rows of a block are recorded.
pub(super) struct Noted<'a> {
    sides: &'a mut [Sides],
    /// Whether the current group contributes to the value of a row.
    pub(super) takes_part: [bool; BLOCK],
}

impl<'a> Noted<'a> {
    #[inline(always)]
    pub(super) fn new(sides: &'a mut [Sides]) -> Self {
        Self { sides, takes_part: [true; BLOCK] }
    }
}

impl Axis {
    /// The axis of a level with the given groups, the breaks between the pieces of each, and whether the value drops beyond the last knot of each.
    pub(super) fn new(level: &Level, groups: &[Range<usize>], mut breaks: Vec<Vec<f64>>, drops: bool) -> Self {
        let knots = |group: &Range<usize>| &level.knots[group.clone()];
        let first = knots(&groups[0]);
        // Bitwise: −0 and 0 are one abscissa, but a value interpolated from −0 may differ in its sign.
        let is_same = |other: &[f64]| {
            other.len() == first.len() && other.iter().zip(first).all(|(a, b)| a.to_bits() == b.to_bits())
        };
        let is_shared = groups[1..].iter().all(|group| is_same(knots(group)));
        if is_shared {
            breaks.truncate(1);
        }
        let stride = if is_shared { u32::try_from(breaks[0].len() + 1).unwrap_or(u32::MAX) } else { 0 };
        let ranges: Vec<GroupRange> = groups[..breaks.len()]
            .iter()
            .map(|group| match knots(group) {
                [only] if !drops => {
                    GroupRange { least: *only, greatest: *only, below: f64::NEG_INFINITY, above: f64::INFINITY }
                }
                knots => {
                    let (least, last) = (knots[0], knots[knots.len() - 1]);
                    GroupRange { least, greatest: if drops { last.next_up() } else { last }, below: least, above: last }
                }
            })
            .collect();
        let breaks =
            ranges.iter().zip(breaks).map(|(range, at)| Breaks { least: range.least, greatest: range.greatest, at });
        Self { column: level.axis, search: GroupSearch::new(&breaks.collect::<Vec<_>>()), ranges, stride }
    }

    /// Whether all groups have the same abscissae, so that one search serves them all.
    #[inline(always)]
    pub(super) fn is_shared(&self) -> bool {
        self.stride > 0
    }

    /// The search method.
    pub(super) fn search(&self) -> Search {
        self.search.kind()
    }

    /// Clamps the coordinates of a block to the groups they are in, one group for all if none are given, and finds the pieces that contain them.
    #[inline(always)]
    pub(super) fn find<L: Lanes>(&self, lanes: L, column: &[f64], groups: Option<&[u32; BLOCK]>, found: &mut Found) {
        match (self.search.kind(), self.search.steps()) {
            (Search::LinearBuckets, 1) => self.find_by::<LINEAR, 1, L>(lanes, column, groups, found),
            (Search::LinearBuckets, 2) => self.find_by::<LINEAR, 2, L>(lanes, column, groups, found),
            (Search::LinearBuckets, _) => self.find_by::<LINEAR, 4, L>(lanes, column, groups, found),
            (Search::BitBuckets, 1) => self.find_by::<BITS, 1, L>(lanes, column, groups, found),
            (Search::BitBuckets, 2) => self.find_by::<BITS, 2, L>(lanes, column, groups, found),
            (Search::BitBuckets, _) => self.find_by::<BITS, 4, L>(lanes, column, groups, found),
            _ => self.find_by::<BISECTION, 0, L>(lanes, column, groups, found),
        }
    }

    #[inline(always)]
    fn find_by<const KIND: u8, const STEPS: usize, L: Lanes>(
        &self,
        lanes: L,
        column: &[f64],
        groups: Option<&[u32; BLOCK]>,
        found: &mut Found,
    ) {
        let (clamped, pieces) = (&mut found.clamped[..column.len()], &mut found.pieces[..column.len()]);
        if let Some(groups) = groups.filter(|_| self.ranges.len() > 1) {
            for ((clamped, &x), &group) in clamped.iter_mut().zip(column).zip(groups) {
                *clamped = self.ranges[group as usize].clamp(x);
            }
            self.search.find::<KIND, STEPS, L>(lanes, clamped, |row| self.search.group(groups[row] as usize), pieces);
        } else {
            // One group for all: its data stay in registers.
            let range = self.ranges[0];
            self.search.find_in_one::<KIND, STEPS, L>(lanes, column, |x| range.clamp(x), clamped, pieces);
        }
    }

    /// The pieces in the groups of the rows, from those of a search that served all groups.
    #[inline(always)]
    pub(super) fn places(&self, groups: &[u32; BLOCK], shared: &[u32; BLOCK], pieces: &mut [u32; BLOCK]) {
        for ((piece, shared), group) in pieces.iter_mut().zip(shared).zip(groups) {
            *piece = group * self.stride + shared;
        }
    }

    /// Records which of the contributing rows lie outside their group.
    #[inline(always)]
    pub(super) fn note(&self, groups: Option<&[u32; BLOCK]>, column: &[f64], noted: &mut Noted<'_>) {
        let of_rows = column.iter().zip(&mut *noted.sides).zip(&noted.takes_part).enumerate();
        for (row, ((&x, sides), &takes_part)) in of_rows {
            let group = if self.is_shared() { 0 } else { groups.map_or(0, |groups| groups[row] as usize) };
            let range = &self.ranges[group];
            if takes_part && x < range.below {
                sides.mark_below(self.column);
            }
            if takes_part && x > range.above {
                sides.mark_above(self.column);
            }
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
