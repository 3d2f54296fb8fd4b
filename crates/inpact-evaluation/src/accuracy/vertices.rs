//! The vertices of the common refinement of a table's abscissae: between them the table is linear along each axis.

use std::ops::Range;

use crate::table::PiecewiseTable;

/// The abscissae of `level` within the given groups of the level below `height`, and the points just beyond the last rows of a table that drops to zero there; rising, each once.
pub(super) fn abscissae(table: &PiecewiseTable, level: usize, height: usize, groups: &[Range<usize>]) -> Vec<f64> {
    let of_level = &table.levels()[level];
    let mut found = Vec::new();
    for group in groups.iter().flat_map(|group| groups_at(table, level, height, group.clone())) {
        found.extend_from_slice(&of_level.knots[group.clone()]);
        if of_level.drops {
            found.push(of_level.knots[group.end - 1].next_up());
        }
    }
    found.sort_unstable_by(f64::total_cmp);
    found.dedup();
    found
}

/// [`abscissae`] within the whole table.
pub(super) fn all_abscissae(table: &PiecewiseTable, level: usize) -> Vec<f64> {
    let height = table.levels().len();
    let whole = 0..table.levels()[height - 1].knots.len();
    abscissae(table, level, height, &[whole])
}

/// The groups of `level` within a group of the level below `height`.
fn groups_at(table: &PiecewiseTable, level: usize, height: usize, group: Range<usize>) -> Vec<Range<usize>> {
    let mut groups = vec![group];
    for outer in (level + 1..height).rev() {
        let level = &table.levels()[outer];
        groups = groups.into_iter().flatten().map(|knot| level.children_of(knot)).collect();
    }
    groups
}

/// Calls `visit` with every combination of one number of each of `axes`, the first varying fastest.
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
