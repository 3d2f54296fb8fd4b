//! How far the groups of a table differ from each other, exactly: what an error in the place between two groups costs.
//!
//! Two neighbouring groups are nested piecewise-linear functions of the inner axes. On each cell of the common refinement of their abscissae both are linear along each axis,
//! so their difference is largest at a vertex of a cell; and so is their ratio, which along an axis is a quotient of two linear functions.
//! A table that drops to zero beyond its last row is looked at one f64 beyond it too: no coordinate lies between.

use std::ops::Range;

use crate::numbers::between;
use crate::table::{PiecewiseTable, Tail};

/// How two groups differ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread {
    /// The largest difference at one point.
    pub(super) difference: f64,
    /// The largest difference as a part of the smaller of the two magnitudes; infinite where one is zero or the signs differ.
    pub(super) ratio: f64,
}

/// The most vertices that are looked at for one pair of groups.
const MOST_VERTICES: usize = 1 << 16;

/// Relative errors of the values compared, with room to spare.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

impl Spread {
    /// The spread of the groups `a` and `b` of the level below `height`.
    ///
    /// Where the refinement is too large to go through, the ranges of the two groups' values bound it.
    pub(super) fn of(table: &PiecewiseTable, height: usize, a: Range<usize>, b: Range<usize>) -> Self {
        let axes: Vec<Vec<f64>> =
            (0..height).map(|level| abscissae(table, level, height, &[a.clone(), b.clone()])).collect();
        let count = axes.iter().map(Vec::len).try_fold(1_usize, usize::checked_mul);
        let mut spread = Self { difference: 0.0, ratio: 0.0 };
        if count.is_none_or(|count| count > MOST_VERTICES) {
            let (a, b) = (extremes(table, height, a), extremes(table, height, b));
            spread.note(a.0, b.1);
            spread.note(a.1, b.0);
            return spread;
        }
        let mut point = vec![0.0; table.levels[height - 1].axis + 1];
        for_each_vertex(&axes, &mut |vertex| {
            for (level, &x) in vertex.iter().enumerate() {
                point[table.levels[level].axis] = x;
            }
            spread.note(group_value(table, height, a.clone(), &point), group_value(table, height, b.clone(), &point));
        });
        spread
    }

    fn note(&mut self, a: f64, b: f64) {
        let (small, large) = if a.abs() < b.abs() { (a.abs(), b.abs()) } else { (b.abs(), a.abs()) };
        let difference = if a == b { 0.0 } else { (a - b).abs() + ROUNDING * large };
        self.difference = self.difference.max(difference);
        let ratio = match difference {
            0.0 => 0.0,
            _ if a.signum() == b.signum() && small > f64::MIN_POSITIVE => difference / small * (1.0 + ROUNDING),
            _ => f64::INFINITY,
        };
        self.ratio = self.ratio.max(ratio);
    }
}

/// The f64 value of one group, as the table's own kernel has it to a rounding or two an axis.
pub(super) fn group_value(table: &PiecewiseTable, height: usize, group: Range<usize>, point: &[f64]) -> f64 {
    let between = |x: f64, start: (f64, f64), end: (f64, f64)| Some(between(x, start, end));
    table.evaluate_group(height, group, &|axis| point[axis], &|value| value, &between).unwrap_or(f64::NAN)
}

/// The knots of `level` within the given groups of the level below `height`, and the points just beyond the last rows of a table that drops to zero there; rising, each once.
pub(super) fn abscissae(table: &PiecewiseTable, level: usize, height: usize, groups: &[Range<usize>]) -> Vec<f64> {
    let knots = &table.levels[level].knots;
    let mut found = Vec::new();
    for group in groups {
        for group in groups_at(table, level, height, group.clone()) {
            found.extend_from_slice(&knots[group.clone()]);
            if table.levels[level].axis == 0 && table.tail == Tail::Zero && group.len() > 1 {
                found.push(knots[group.end - 1].next_up());
            }
        }
    }
    found.sort_unstable_by(f64::total_cmp);
    found.dedup();
    found
}

/// The groups of `level` that stand within a group of the level below `height`.
fn groups_at(table: &PiecewiseTable, level: usize, height: usize, group: Range<usize>) -> Vec<Range<usize>> {
    let mut groups = vec![group];
    for outer in (level + 1..height).rev() {
        let level = &table.levels[outer];
        groups = groups.into_iter().flatten().map(|knot| level.children_of(knot)).collect();
    }
    groups
}

/// The least and the greatest value within a group of the level below `height`.
pub(super) fn extremes(table: &PiecewiseTable, height: usize, group: Range<usize>) -> (f64, f64) {
    let drops = table.tail == Tail::Zero && table.levels.first().is_some_and(|level| level.axis == 0);
    let rows = if height == 0 { vec![group] } else { groups_at(table, 0, height, group) };
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    let mut note = |value: f64| range = (range.0.min(value), range.1.max(value));
    for rows in rows {
        if drops && rows.len() > 1 {
            note(0.0);
        }
        table.values[rows].iter().copied().for_each(&mut note);
    }
    range
}

/// Calls `visit` with every combination of one number of each of `axes`.
pub(super) fn for_each_vertex(axes: &[Vec<f64>], visit: &mut impl FnMut(&[f64])) {
    let mut indices = vec![0; axes.len()];
    let mut vertex: Vec<f64> = axes.iter().map(|axis| axis[0]).collect();
    loop {
        visit(&vertex);
        let mut axis = 0;
        loop {
            if axis == axes.len() {
                return;
            }
            indices[axis] += 1;
            if indices[axis] < axes[axis].len() {
                vertex[axis] = axes[axis][indices[axis]];
                break;
            }
            indices[axis] = 0;
            vertex[axis] = axes[axis][0];
            axis += 1;
        }
    }
}
