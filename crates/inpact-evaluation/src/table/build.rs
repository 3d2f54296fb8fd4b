//! From the rows of a deck to a table that can be evaluated: validation (semantics T-08 to T-10) and grouping (T-02, T-05).

use super::{AxisSummary, Content, Level, PiecewiseTable, Tail};
use crate::error::{Error, TableFault};
use crate::numbers::KernelSlope;
use std::sync::Arc;

impl PiecewiseTable {
    /// Builds a table from `cells`, rows of `width` numbers each: the value, then axis 0 (fastest) to the last axis (slowest).
    ///
    /// # Errors
    /// The first row that violates the order (T-08, T-09: an abscissa that does not increase while all outer ones are constant, or an outer one that decreases),
    /// holds a number that is not finite, or is incomplete. Abscissae are compared as numbers (T-10).
    ///
    /// # Example
    /// Conductance against clearance at two temperatures, each with clearances of its own:
    /// ```
    /// use inpact_evaluation::table::{PiecewiseTable, Tail};
    ///
    /// let rows = [
    ///     [10.0, 0.0, 300.0],
    ///     [6.0, 1.0, 300.0],
    ///     [2.0, 2.0, 300.0],
    ///     [20.0, 0.0, 400.0],
    ///     [10.0, 4.0, 400.0],
    /// ];
    /// let table = PiecewiseTable::from_rows(rows.as_flattened(), 3, Tail::Zero)?;
    /// assert_eq!(table.value(&[2.0, 350.0]), 8.5); // halfway between 2 and 15
    /// assert_eq!(table.value(&[3.0, 350.0]), 6.25); // 0 beyond the clearances at 300
    /// # Ok::<(), inpact_evaluation::Error>(())
    /// ```
    pub fn from_rows(cells: &[f64], width: usize, tail: Tail) -> Result<Self, Error> {
        check_cells(cells, width)?;
        let axis_count = width - 1;
        let mut axes = vec![Vec::<f64>::new(); axis_count];
        // For each axis but the first, the start of the children of its knots in the axis below.
        let mut starts = vec![Vec::<usize>::new(); axis_count];
        let mut group_counts = vec![0; axis_count];
        let mut previous: Option<&[f64]> = None;
        for (row, cells) in cells.chunks_exact(width).enumerate() {
            let abscissae = &cells[1..];
            let changed = match previous {
                None => axis_count,
                Some(previous) => first_change(previous, abscissae).map_err(|fault| Error::of_rows(row, fault))?,
            };
            // The outermost changed axis continues its group; all inside it begin new groups.
            for axis in (0..axis_count).take(changed + usize::from(changed < axis_count)).rev() {
                if axis > 0 {
                    let children = axes[axis - 1].len();
                    starts[axis].push(children);
                }
                axes[axis].push(abscissae[axis]);
                if axis < changed {
                    group_counts[axis] += 1;
                }
            }
            previous = Some(abscissae);
        }
        let values: Vec<f64> = cells.iter().step_by(width).copied().collect();
        let summaries: Vec<AxisSummary> = axes
            .iter()
            .zip(&group_counts)
            .enumerate()
            .map(|(axis, (knots, &group_count))| AxisSummary {
                least: knots.iter().copied().fold(f64::INFINITY, f64::min),
                greatest: knots.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                group_count,
                knot_count: knots.len(),
                distinct_count: distinct_count(knots, group_count),
                drops: axis == 0 && tail == Tail::Zero,
            })
            .collect();
        let levels = levels_that_matter(axes, starts, &summaries);
        let slopes = row_slopes(&levels, &values);
        Ok(Self(Arc::new(Content { axis_count, tail, levels, values, slopes, axes: summaries, marks: None })))
    }
}

/// Rejects cells that are not complete rows of finite numbers.
fn check_cells(cells: &[f64], width: usize) -> Result<(), Error> {
    let fault = |row, fault| Err(Error::of_rows(row, fault));
    if cells.is_empty() {
        return fault(0, TableFault::NoRows);
    }
    let found = cells.len() % width.max(1);
    if width == 0 || found != 0 {
        return fault(cells.len() / width.max(1), TableFault::IncompleteRow { width, found });
    }
    match cells.iter().position(|cell| !cell.is_finite()) {
        None => Ok(()),
        Some(index) => fault(index / width, TableFault::NotFinite { column: index % width, found: cells[index] }),
    }
}

/// The slowest axis on which a row differs from the previous one, which must have risen.
fn first_change(previous: &[f64], found: &[f64]) -> Result<usize, TableFault> {
    let changed = (0..found.len()).rev().find(|&axis| previous[axis] != found[axis]).unwrap_or(0);
    match (previous.get(changed), found.get(changed)) {
        (Some(&previous), Some(&found)) if found > previous => Ok(changed),
        (Some(&previous), Some(&found)) => Err(TableFault::NotAscending { axis: changed, previous, found }),
        _ => Err(TableFault::SecondConstant),
    }
}

/// The number of distinct abscissae of an axis over all its groups.
fn distinct_count(knots: &[f64], group_count: usize) -> usize {
    if group_count == 1 {
        return knots.len();
    }
    let mut sorted = knots.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted.dedup();
    sorted.len()
}

/// The levels of the axes that the value depends on: some group has more than one knot, or the value drops beyond the last;
/// each is linked to the next such axis inside it.
///
/// An axis left out has one knot a group, so its knot j is the only child of knot j of the axis outside it:
/// knot j of the next axis that matters owns what knot j of the outermost left-out axis owns.
fn levels_that_matter(axes: Vec<Vec<f64>>, mut starts: Vec<Vec<usize>>, summaries: &[AxisSummary]) -> Vec<Level> {
    let mut levels: Vec<Level> = Vec::new();
    for (axis, knots) in axes.into_iter().enumerate() {
        if !summaries[axis].matters() {
            continue;
        }
        let children = levels.last().map_or_else(Vec::new, |below| {
            let mut children = std::mem::take(&mut starts[below.axis + 1]);
            children.push(below.knots.len());
            children
        });
        levels.push(Level { axis, knots, children, drops: summaries[axis].drops });
    }
    levels
}

/// The kernel slope from each row to the next of its group; meaningless in the last row of a group.
fn row_slopes(levels: &[Level], values: &[f64]) -> Vec<KernelSlope> {
    let Some(innermost) = levels.first() else {
        return vec![KernelSlope::UNUSED; values.len()];
    };
    let mut slopes: Vec<KernelSlope> = innermost
        .knots
        .windows(2)
        .zip(values.windows(2))
        .map(|(knots, values)| {
            // Within a group abscissae ascend. Where they do not, the next row opens a group; otherwise the slope is never used.
            if knots[0] < knots[1] {
                KernelSlope::of_segment((knots[0], values[0]), (knots[1], values[1]))
            } else {
                KernelSlope::UNUSED
            }
        })
        .collect();
    slopes.push(KernelSlope::UNUSED);
    slopes
}
