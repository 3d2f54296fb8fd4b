//! Tables of two or more axes resampled on a regular grid: one multiplication finds the cell, without a search.
//!
//! The nodes have the table's values; between them the grid is multilinear. Within a cell of the common refinement of grid and table both are linear along each axis,
//! and so is their difference: its largest magnitude is at a vertex of the refinement, and so is its largest ratio to the table's value.
//! The bound is the largest found there, hence the true maximum, plus a bound on rounding.
//! The refinement is processed in bands between two neighbouring groups of the outermost axis, which need only the abscissae of these two.
//!
//! A grid whose lines contain all abscissae is the table itself up to rounding ([`commensurate_cells`]). For one axis a grid gains nothing, see `docs/accuracy.md`.

use super::refusal::{MAX_AXES, MAX_NODES, MAX_VERTICES};
use super::vertices::{abscissae, all_abscissae, for_each_vertex};
use super::{ErrorBound, Refusal, largest_magnitude};
use crate::error::{Error, ErrorKind};
use crate::kernel::{InstructionSet, Lanes, Operation};
use crate::table::PiecewiseTable;

/// A table whose value depends on two to four axes, resampled on a regular grid over these.
#[derive(Clone, Debug)]
pub struct Grid {
    bound: ErrorBound,
    axes: Vec<GridAxis>,
    /// The values at the nodes, axis 0 varying fastest.
    nodes: Vec<f64>,
    /// The coordinate of the innermost axis beyond which every value is zero; infinite if there is none.
    zero_beyond: f64,
}

#[derive(Clone, Debug)]
struct GridAxis {
    /// The axis of the table.
    axis: usize,
    least: f64,
    greatest: f64,
    /// Cells for a unit of the coordinate.
    scale: f64,
    cells: usize,
    /// The distance of neighbouring nodes along this axis in `nodes`.
    stride: usize,
}

/// Half an ulp relative to a normal number; and the smallest subnormal, which bounds the rounding below it.
const UNIT: f64 = f64::EPSILON / 2.0;
const UNDERFLOW: f64 = f64::from_bits(1);

/// A number of which four can be added without overflow.
const SAFE_TO_ADD: f64 = f64::MAX / 4.0;

/// The block size in rows: cells first, then values.
const BLOCK: usize = 64;

impl Grid {
    /// The grid with `cells` along each axis that the value depends on, fastest first.
    ///
    /// # Errors
    /// There is none: the table depends on fewer than two or more than four axes, its numbers are so extreme that a sum could overflow,
    /// or the grid, or the refinement its error is computed on, is too large.
    pub fn new(table: &PiecewiseTable, cells: &[usize]) -> Result<Self, Error> {
        Self::made(table, cells).map_err(|refusal| ErrorKind::Grid(refusal).into())
    }

    /// The same, with the plain reason for a failure.
    pub(super) fn made(table: &PiecewiseTable, cells: &[usize]) -> Result<Self, Refusal> {
        match table.levels().len() {
            0 => return Err(Refusal::Constant),
            1 => return Err(Refusal::OneAxis),
            2..=MAX_AXES => {}
            count => return Err(Refusal::TooManyAxes(count)),
        }
        if cells.len() != table.levels().len() || cells.contains(&0) {
            return Err(Refusal::Cells);
        }
        let node_count = cells.iter().fold(1, |count: usize, &cells| count.saturating_mul(cells.saturating_add(1)));
        if node_count > MAX_NODES {
            return Err(Refusal::TooManyNodes(node_count));
        }
        if let Some(&large) = table.values().iter().find(|value| value.abs() > SAFE_TO_ADD) {
            return Err(Refusal::TooLarge(large));
        }
        let mut axes = Vec::new();
        let mut stride = 1;
        for (level, &cells) in table.levels().iter().zip(cells) {
            let summary = table.axes()[level.axis];
            let scale = cells as f64 / (summary.greatest - summary.least);
            if summary.least.abs().max(summary.greatest.abs()) > SAFE_TO_ADD || !scale.is_normal() {
                return Err(Refusal::Slope(scale));
            }
            let (least, greatest) = (summary.least, summary.greatest);
            axes.push(GridAxis { axis: level.axis, least, greatest, scale, cells, stride });
            stride *= cells + 1;
        }
        let lines: Vec<Vec<f64>> = axes.iter().enumerate().map(|(level, axis)| axis.lines(table, level)).collect();
        let mut nodes = Vec::with_capacity(node_count);
        let mut point = vec![0.0; table.axis_count()];
        for_each_vertex(&lines, &mut |node| {
            for (axis, &x) in axes.iter().zip(node) {
                point[axis.axis] = x;
            }
            nodes.push(table.value(&point));
        });
        let zero_beyond = zero_beyond(table, axes[0].greatest);
        let mut grid = Self { bound: ErrorBound::EXACT, zero_beyond, axes, nodes };
        grid.bound = grid.true_maximum(table, &lines)?;
        Ok(grid)
    }

    /// The number of cells along each axis that the value depends on, fastest first.
    pub fn cells(&self) -> Vec<usize> {
        self.axes.iter().map(|axis| axis.cells).collect()
    }

    /// The error bound, over all queries.
    pub fn bound(&self) -> ErrorBound {
        self.bound
    }

    /// The value at `point`, one coordinate per axis; bitwise equal to [`Self::values`].
    ///
    /// NaN where a coordinate the value depends on is NaN or missing, as in [`PiecewiseTable::value`].
    pub fn value(&self, point: &[f64]) -> f64 {
        let along = |axis: &GridAxis| point.get(axis.axis).copied().unwrap_or(f64::NAN);
        let mut coordinates = [f64::NAN; MAX_AXES];
        for (coordinate, axis) in coordinates.iter_mut().zip(&self.axes) {
            *coordinate = along(axis);
        }
        let mut value = [f64::NAN];
        let column = |level: usize| std::slice::from_ref(&coordinates[level]);
        self.rows([column(0), column(1), column(2), column(3)], &mut value);
        value[0]
    }

    /// The values at many points, one for each element of `values`: `columns` has one column per axis of the table, which may be empty where the value does not depend on the axis.
    ///
    /// # Panics
    /// If a column that the value depends on is missing or shorter than `values`.
    pub fn values(&self, columns: &[&[f64]], values: &mut [f64]) {
        let mut along = [&columns[self.axes[0].axis][..values.len()]; MAX_AXES];
        for (along, axis) in along.iter_mut().zip(&self.axes) {
            *along = &columns[axis.axis][..values.len()];
        }
        self.rows(along, values);
    }

    fn rows(&self, along: [&[f64]; MAX_AXES], values: &mut [f64]) {
        InstructionSet::best().run(Each { grid: self, along, values });
    }

    /// The largest error at a vertex of the common refinement, and a bound on the rounding error.
    fn true_maximum(&self, table: &PiecewiseTable, lines: &[Vec<f64>]) -> Result<ErrorBound, Refusal> {
        let height = table.levels().len();
        let outer = &table.levels()[height - 1];
        let largest = largest_magnitude(table.values());
        let mut worst = (0.0_f64, 0.0_f64);
        let mut vertices = 0;
        let mut point = vec![0.0; table.axis_count()];
        for knot in 0..outer.knots.len() - 1 {
            let (start, end) = (outer.knots[knot], outer.knots[knot + 1]);
            let groups = [outer.children_of(knot), outer.children_of(knot + 1)];
            let mut axes: Vec<Vec<f64>> = (0..height - 1)
                .map(|level| merged(abscissae(table, level, height - 1, &groups), &lines[level]))
                .collect();
            let within = lines[height - 1].iter().copied().filter(|&line| start < line && line < end);
            axes.push([start].into_iter().chain(within).chain([end]).collect());
            let count = axes.iter().fold(1_usize, |count, axis| count.saturating_mul(axis.len()));
            vertices = count.saturating_add(vertices);
            if vertices > MAX_VERTICES {
                return Err(Refusal::TooManyVertices(vertices));
            }
            for_each_vertex(&axes, &mut |vertex| {
                for (axis, &x) in self.axes.iter().zip(vertex) {
                    point[axis.axis] = x;
                }
                let exact = table.value(&point);
                let error = (self.value(&point) - exact).abs();
                worst.0 = worst.0.max(error);
                if error > 0.0 {
                    worst.1 = worst.1.max(error / exact.abs().max(f64::MIN_POSITIVE));
                }
            });
        }
        let rounding = self.rounding(largest);
        let least = smallest_magnitude(table);
        let pointwise = if least > f64::MIN_POSITIVE {
            worst.1 * (1.0 + 16.0 * f64::EPSILON) + rounding / least
        } else {
            f64::INFINITY
        };
        let pointwise = if pointwise < 1e15 { pointwise } else { f64::INFINITY };
        Ok(ErrorBound::of_magnitudes(worst.0 + rounding, pointwise, largest))
    }

    /// A bound on the rounding error, in addition to the error at the vertices.
    ///
    /// A coordinate in units of cells has an error of two roundings, and a grid line is not exactly where its node was evaluated;
    /// each contributes that fraction of the largest difference of neighbouring nodes. Each axis rounds a difference and a result. All of this counts twice, at the vertex and at the query,
    /// and the table's own kernel has an error of n + 1 ulp at the vertex.
    fn rounding(&self, largest: f64) -> f64 {
        let unit = UNIT;
        let mut of_kernel = 0.0;
        let mut of_lines = 0.0;
        for axis in &self.axes {
            let difference = self.largest_step(axis);
            let cells = axis.cells as f64;
            let reach = axis.least.abs().max(axis.greatest.abs()) * axis.scale;
            of_kernel += (2.0 * cells + 1.0) * unit * difference + unit * largest + UNDERFLOW;
            of_lines += 2.0 * difference * unit * (3.0 * cells + 18.0 * reach);
        }
        let of_table = 2.0 * (self.axes.len() as f64 + 1.0) * unit * largest + UNDERFLOW;
        (2.0 * of_kernel + of_lines + of_table) * (1.0 + 1024.0 * unit)
    }

    /// The largest difference of neighbouring nodes along an axis.
    fn largest_step(&self, axis: &GridAxis) -> f64 {
        let is_last = |node: usize| node / axis.stride % (axis.cells + 1) == axis.cells;
        (0..self.nodes.len())
            .filter(|&node| !is_last(node))
            .map(|node| (self.nodes[node + axis.stride] - self.nodes[node]).abs())
            .fold(0.0, f64::max)
    }

    /// Interpolates between the 2^(axes - first) nodes at and after `base`, `parts` holding the places within the cell.
    #[inline(always)]
    fn interpolate_2(&self, base: usize, parts: [f64; 2]) -> f64 {
        let next = base + self.axes[1].stride;
        let a = lerp(parts[0], self.nodes[base], self.nodes[base + 1]);
        let b = lerp(parts[0], self.nodes[next], self.nodes[next + 1]);
        lerp(parts[1], a, b)
    }

    #[inline(always)]
    fn interpolate_3(&self, base: usize, [x, y, z]: [f64; 3]) -> f64 {
        let a = self.interpolate_2(base, [x, y]);
        let b = self.interpolate_2(base + self.axes[2].stride, [x, y]);
        lerp(z, a, b)
    }

    #[inline(always)]
    fn interpolate_4(&self, base: usize, [x, y, z, w]: [f64; 4]) -> f64 {
        let a = self.interpolate_3(base, [x, y, z]);
        let b = self.interpolate_3(base + self.axes[3].stride, [x, y, z]);
        lerp(w, a, b)
    }

    /// The values of a block of rows beginning at row `start`.
    #[inline(always)]
    fn block(&self, along: [&[f64]; MAX_AXES], start: usize, values: &mut [f64]) {
        let rows = values.len();
        let mut bases = [0_u32; BLOCK];
        let mut parts = [[0.0_f64; BLOCK]; MAX_AXES];
        for ((axis, parts), column) in self.axes.iter().zip(&mut parts).zip(along) {
            let column = &column[start..start + rows];
            #[expect(clippy::cast_possible_truncation, reason = "a grid has at most 2^15 nodes")]
            let (last, stride) = (axis.cells as u32 - 1, axis.stride as u32);
            for ((base, part), &x) in bases.iter_mut().zip(parts).zip(column) {
                let place = (bounded(x, axis.least, axis.greatest) - axis.least) * axis.scale;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "saturates, which is meant"
                )]
                let cell = (place as u32).min(last);
                *base += cell * stride;
                *part = place - f64::from(cell);
            }
        }
        let [x, y, z, w] = &parts;
        match self.axes.len() {
            2 => {
                for (row, value) in values.iter_mut().enumerate() {
                    *value = self.interpolate_2(bases[row] as usize, [x[row], y[row]]);
                }
            }
            3 => {
                for (row, value) in values.iter_mut().enumerate() {
                    *value = self.interpolate_3(bases[row] as usize, [x[row], y[row], z[row]]);
                }
            }
            _ => {
                for (row, value) in values.iter_mut().enumerate() {
                    *value = self.interpolate_4(bases[row] as usize, [x[row], y[row], z[row], w[row]]);
                }
            }
        }
        if self.zero_beyond < f64::INFINITY {
            let column = &along[0][start..start + rows];
            for (value, &x) in values.iter_mut().zip(column) {
                // A NaN along another axis stays NaN.
                *value = if x > self.zero_beyond && !value.is_nan() { 0.0 } else { *value };
            }
        }
    }
}

impl GridAxis {
    /// The coordinates of the grid lines, snapped to the table's abscissae within a few ulp.
    fn lines(&self, table: &PiecewiseTable, level: usize) -> Vec<f64> {
        let knots = all_abscissae(table, level);
        let width = self.greatest - self.least;
        let nearness = 4.0 * f64::EPSILON * self.least.abs().max(self.greatest.abs());
        (0..=self.cells)
            .map(|cell| {
                let line = self.least + width * (cell as f64 / self.cells as f64);
                let right = knots.partition_point(|&knot| knot < line);
                let near = [right.saturating_sub(1), right.min(knots.len() - 1)].map(|knot| knots[knot]);
                let nearest = if (near[0] - line).abs() <= (near[1] - line).abs() { near[0] } else { near[1] };
                let met = if (nearest - line).abs() <= nearness { nearest } else { line };
                met.clamp(self.least, self.greatest)
            })
            .collect()
    }
}

/// Cells along each axis such that the grid lines contain all the table's abscissae; `None` if that takes too many nodes.
pub fn commensurate_cells(table: &PiecewiseTable) -> Option<Vec<usize>> {
    const MAX_CELLS: usize = 512;
    let height = table.levels().len();
    let of_level = |level: usize| {
        let knots = all_abscissae(table, level);
        let axis = table.axes()[table.levels()[level].axis];
        let width = axis.greatest - axis.least;
        let meets = |cells: usize, knot: f64| {
            let place = (knot - axis.least) / width * cells as f64;
            (place - place.round()).abs() <= 8.0 * f64::EPSILON * cells as f64 * (1.0 + axis.least.abs() / width)
        };
        (1..=MAX_CELLS).find(|&cells| knots.iter().all(|&knot| knot > axis.greatest || meets(cells, knot)))
    };
    let cells: Vec<usize> = (0..height).map(of_level).collect::<Option<_>>()?;
    let nodes = cells.iter().fold(1_usize, |count, cells| count.saturating_mul(cells + 1));
    (nodes <= MAX_NODES).then_some(cells)
}

/// `x` clamped to `least` and `greatest`; NaN stays NaN.
#[inline(always)]
fn bounded(x: f64, least: f64, greatest: f64) -> f64 {
    let raised = if x < least { least } else { x };
    if raised > greatest { greatest } else { raised }
}

/// `a` + `part` × (`b` − `a`).
#[inline(always)]
fn lerp(part: f64, a: f64, b: f64) -> f64 {
    part.mul_add(b - a, a)
}

/// Merges two ascending lists without duplicates.
fn merged(mut a: Vec<f64>, b: &[f64]) -> Vec<f64> {
    a.extend_from_slice(b);
    a.sort_unstable_by(f64::total_cmp);
    a.dedup();
    a
}

/// The innermost coordinate beyond which every value is zero, `greatest` if all groups end in zero at it or before.
fn zero_beyond(table: &PiecewiseTable, greatest: f64) -> f64 {
    if table.levels()[0].drops { greatest } else { f64::INFINITY }
}

/// The smallest magnitude of the table within the range of the grid; zero where signs differ or a group ends in zero before another.
fn smallest_magnitude(table: &PiecewiseTable) -> f64 {
    let least = table.values().iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = table.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let innermost = &table.levels()[0];
    let ends_early = innermost.drops
        && table.levels()[1].children[1..]
            .iter()
            .any(|&end| innermost.knots[end - 1] != innermost.knots[innermost.knots.len() - 1]);
    if ends_early || (least <= 0.0 && greatest >= 0.0) { 0.0 } else { least.abs().min(greatest.abs()) }
}

/// The grid's values, compiled for an instruction set.
struct Each<'a> {
    grid: &'a Grid,
    /// The columns of the axes that matter.
    along: [&'a [f64]; MAX_AXES],
    values: &'a mut [f64],
}

impl Operation for Each<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes>(self, _: L) {
        for (block, values) in self.values.chunks_mut(BLOCK).enumerate() {
            self.grid.block(self.along, block * BLOCK, values);
        }
    }
}
