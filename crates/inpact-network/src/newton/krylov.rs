//! Newton–Krylov steps for large scenes, without factoring the whole unsymmetric matrix.
//!
//! The coupling of two fields, or of a conductance to its own field, is small compared with the symmetric blocks of the single fields, which have the pattern of their networks:
//! minimum degree or nested dissection orders them, and one Cholesky factor each, in f32 as it need not be accurate, is the preconditioner;
//! with `iterative` it is an incomplete factor. Between the fields it is block-triangular.
//! Restarted GMRES then solves for the step; its memory is that of a few vectors in f32. A restart recovers the digits that this costs,
//! since it begins with the residual in f64. A step that is solved to a few digits is still a step (inexact Newton): the line search judges it.
//!
//! An unsymmetric factor with pivoting needs memory for the pattern of AᵀA, 50 KiB for each contact of a plate; it is used for small scenes, and where GMRES does not converge.
//! Source: Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., sections 6.5 and 9.3; a basis of fewer digits: Aliaga and others, Compressed basis GMRES on high-performance graphics processing units, Int. J. High Perform. Comput. Appl. 37 (2023) 82–100.

use super::system::System;
use crate::linear::{Analysis, Factor, Incomplete, Matrix, Method, NoSolution, Pattern, Solves, largest_or_nan};
use faer::sparse::Triplet;
use std::sync::Arc;

/// Parameters of GMRES by preconditioner.
struct GmresParameters {
    /// The restart length.
    restart: usize,
    /// The maximum number of restarts.
    most_restarts: usize,
    /// It fails where more than this fraction of the residual remains after a restart.
    stagnation: f64,
}

/// Complete factors are nearly inverses: without fast convergence there is none.
const WITH_FACTORS: GmresParameters = GmresParameters { restart: 24, most_restarts: 16, stagnation: 0.9 };

/// Incomplete factors leave the slow modes of large plates, which need many vectors; these take a tenth of the memory of the factor of the whole matrix that would be next.
const WITH_INCOMPLETE_FACTORS: GmresParameters = GmresParameters { restart: 60, most_restarts: 60, stagnation: 0.98 };

/// The reduction of the residual.
const REDUCTION: f64 = 1e-9;

/// A step that reduces the residual by less than this is not worth trying.
const WORTH_TRYING: f64 = 1e-2;

/// The order of the block of a field, good as long as its matrix has entries in the same places.
#[derive(Debug)]
pub(super) struct Order {
    pattern: Pattern,
    analysis: Option<Arc<Analysis>>,
}

/// A matrix in compressed columns, for products only.
pub(super) struct Columns {
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl Columns {
    /// The square matrix of entries given as contributions, in any order.
    ///
    /// The contributions are summed in place: a large scene has three for each entry, and no memory for both.
    pub(super) fn of(count: usize, mut parts: Vec<Triplet<u32, u32, f64>>) -> Self {
        parts.sort_unstable_by_key(|part| (part.col, part.row));
        parts.dedup_by(|part, entry| {
            let is_same = (part.col, part.row) == (entry.col, entry.row);
            if is_same {
                entry.val += part.val;
            }
            is_same
        });
        let mut starts = vec![0_u32; count + 1];
        for entry in &parts {
            starts[entry.col as usize + 1] += 1;
        }
        for column in 0..count {
            starts[column + 1] += starts[column];
        }
        let rows = parts.iter().map(|entry| entry.row).collect();
        let values = parts.iter().map(|entry| entry.val).collect();
        Self { starts, rows, values }
    }

    fn column(&self, column: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.starts[column] as usize..self.starts[column + 1] as usize;
        self.rows[range.clone()].iter().map(|&row| row as usize).zip(self.values[range].iter().copied())
    }
}

/// The block of one field, and its approximate solver.
pub(super) struct Block {
    start: usize,
    count: usize,
    inverse: Inverse,
}

enum Inverse {
    Single(Factor<f32>),
    Double(Factor<f64>),
    Incomplete(Incomplete),
}

impl Block {
    /// The block of a field, whose diagonal includes the pseudo-capacities; `None` where it cannot be factored.
    pub(super) fn of(
        system: &System<'_>,
        pseudo_capacity: &[f64],
        method: Method,
        kept: &mut Option<Order>,
    ) -> Option<Self> {
        let (start, count) = (system.start as usize, system.edges.form.count());
        let pattern = Pattern::of(&system.core, &system.edges);
        if method == Method::Iterative {
            // Without an ordering there is nothing to reuse.
            let inverse = Inverse::Incomplete(Incomplete::of(&matrix(&pattern, system, pseudo_capacity)));
            return Some(Self { start, count, inverse });
        }
        let order = match kept.take() {
            Some(order) if order.pattern.has_entries_of(pattern.symbolic()) => {
                kept.insert(Order { pattern, analysis: order.analysis })
            }
            _ => kept.insert(Order { pattern, analysis: None }),
        };
        let matrix = matrix(&order.pattern, system, pseudo_capacity);
        let analysis = match &order.analysis {
            Some(analysis) => Arc::clone(analysis),
            None => Arc::clone(order.analysis.insert(Arc::new(Analysis::of(matrix.pattern)?))),
        };
        let inverse = match Factor::new(&analysis, &matrix) {
            Ok(single) => Inverse::Single(single),
            Err(_) => Inverse::Double(Factor::new(&analysis, &matrix).ok()?),
        };
        Some(Self { start, count, inverse })
    }

    fn range(&self) -> std::ops::Range<usize> {
        self.start..self.start + self.count
    }
}

/// The matrix of a field, whose diagonal includes the pseudo-capacities.
fn matrix<'a>(pattern: &'a Pattern, system: &System<'_>, pseudo_capacity: &[f64]) -> Matrix<'a> {
    let mut matrix = pattern.matrix(&system.core, &system.edges);
    for (column, more) in pseudo_capacity.iter().enumerate() {
        // A column begins with its diagonal.
        let diagonal = matrix.pattern.col_ptr()[column] as usize;
        matrix.values[diagonal] += more;
    }
    matrix
}

impl Inverse {
    fn apply(&mut self, vector: &mut [f64]) -> Result<(), NoSolution> {
        match self {
            Self::Single(factor) => factor.solve(vector),
            Self::Double(factor) => factor.solve(vector),
            Self::Incomplete(factor) => {
                factor.solve_in_place(vector);
                Ok(())
            }
        }
    }
}

/// Solves for a step; `None` where it does not converge.
pub(super) fn solve(matrix: &Columns, blocks: &mut [Block], right: &[f64]) -> Option<Vec<f64>> {
    let mut solution = vec![0.0; right.len()];
    let mut residual = right.to_vec();
    let size = norm(right);
    if size == 0.0 {
        return Some(solution);
    }
    if !size.is_finite() {
        return None;
    }
    let mut before = size;
    let is_incomplete = blocks.iter().any(|block| matches!(block.inverse, Inverse::Incomplete(_)));
    let patience = if is_incomplete { WITH_INCOMPLETE_FACTORS } else { WITH_FACTORS };
    for _ in 0..patience.most_restarts {
        extend(matrix, blocks, &mut solution, &residual, (REDUCTION * size, patience.restart))?;
        let product = product(matrix, &solution);
        residual.iter_mut().zip(right.iter().zip(&product)).for_each(|(rest, (right, of))| *rest = right - of);
        let now = norm(&residual);
        if now <= REDUCTION * size || !now.is_finite() || patience.stagnation * before < now {
            break;
        }
        before = now;
    }
    (norm(&residual) <= WORTH_TRYING * size).then_some(solution)
}

/// Adds the least-squares combination of the basis to a solution.
fn extend(
    matrix: &Columns,
    blocks: &mut [Block],
    solution: &mut [f64],
    residual: &[f64],
    (enough, restart): (f64, usize),
) -> Option<()> {
    let size = norm(residual);
    let mut basis = vec![narrowed(residual, size)];
    // The columns of the triangle, the Givens rotations, and the right-hand side.
    let (mut triangle, mut rotations, mut rest) = (Vec::<Vec<f64>>::new(), Vec::<(f64, f64)>::new(), vec![size]);
    for step in 0..restart {
        let mut next = product(matrix, &preconditioned(matrix, blocks, widened(&basis[step]))?);
        let mut column: Vec<f64> = Vec::with_capacity(step + 2);
        for direction in &basis {
            let part = dot(&next, direction);
            next.iter_mut().zip(direction).for_each(|(entry, of)| *entry -= part * f64::from(*of));
            column.push(part);
        }
        let height = norm(&next);
        if !height.is_finite() {
            return None;
        }
        for (row, &(cosine, sine)) in rotations.iter().enumerate() {
            let (upper, lower) = (column[row], column[row + 1]);
            column[row] = cosine * upper + sine * lower;
            column[row + 1] = cosine * lower - sine * upper;
        }
        let length = column[step].hypot(height);
        if length == 0.0 {
            break;
        }
        let (cosine, sine) = (column[step] / length, height / length);
        column[step] = length;
        rotations.push((cosine, sine));
        triangle.push(column);
        let last = rest[step];
        rest[step] = cosine * last;
        rest.push(-sine * last);
        if rest[step + 1].abs() <= enough || height == 0.0 {
            break;
        }
        basis.push(narrowed(&next, height));
    }
    let mut weights = vec![0.0; triangle.len()];
    for row in (0..weights.len()).rev() {
        let known: f64 = (row + 1..weights.len()).map(|column| triangle[column][row] * weights[column]).sum();
        weights[row] = (rest[row] - known) / triangle[row][row];
    }
    let mut sum = vec![0.0; residual.len()];
    for (direction, weight) in basis.iter().zip(&weights) {
        sum.iter_mut().zip(direction).for_each(|(entry, of)| *entry += weight * f64::from(*of));
    }
    drop(basis);
    let step = preconditioned(matrix, blocks, sum)?;
    solution.iter_mut().zip(&step).for_each(|(entry, of)| *entry += of);
    Some(())
}

/// Block forward substitution.
fn preconditioned(matrix: &Columns, blocks: &mut [Block], vector: Vec<f64>) -> Option<Vec<f64>> {
    let mut rest = vector;
    let last = blocks.len();
    for (place, block) in blocks.iter_mut().enumerate() {
        let range = block.range();
        block.inverse.apply(&mut rest[range.clone()]).ok()?;
        if place + 1 < last {
            let (solved, later) = rest.split_at_mut(range.end);
            for column in range.clone() {
                let value = solved[column];
                for (row, entry) in matrix.column(column) {
                    if let Some(place) = row.checked_sub(range.end) {
                        later[place] -= entry * value;
                    }
                }
            }
        }
    }
    Some(rest)
}

fn product(matrix: &Columns, vector: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; vector.len()];
    for (column, value) in vector.iter().enumerate() {
        for (row, entry) in matrix.column(column) {
            product[row] += entry * value;
        }
    }
    product
}

fn dot(one: &[f64], other: &[f32]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * f64::from(*other)).sum()
}

/// A stored vector, normalised.
#[expect(
    clippy::cast_possible_truncation,
    reason = "no entry is larger than the whole, and what is lost of it is found again"
)]
fn narrowed(vector: &[f64], length: f64) -> Vec<f32> {
    vector.iter().map(|entry| (entry / length) as f32).collect()
}

fn widened(vector: &[f32]) -> Vec<f64> {
    vector.iter().map(|entry| f64::from(*entry)).collect()
}

fn norm(vector: &[f64]) -> f64 {
    let largest = largest_or_nan(vector.iter().map(|entry| entry.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * vector.iter().map(|entry| (entry / largest).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::{Block, Columns, Inverse, norm, product, solve};
    use crate::linear::{Incomplete, Matrix};
    use faer::sparse::{SparseColMat, Triplet};

    /// Two fields of `count` unknowns each: chains that are coupled in both directions, so that the whole is not symmetric.
    fn coupled(count: u32) -> (Columns, Vec<Block>) {
        let chain = |start: u32, lower_only: bool| {
            (0..count).flat_map(move |unknown| {
                let at = start + unknown;
                let mut entries = vec![Triplet::new(at, at, 2.5)];
                if unknown > 0 {
                    entries.push(Triplet::new(at, at - 1, -1.0));
                    if !lower_only {
                        entries.push(Triplet::new(at - 1, at, -1.0));
                    }
                }
                entries
            })
        };
        let mut entries: Vec<Triplet<u32, u32, f64>> = chain(0, false).chain(chain(count, false)).collect();
        for unknown in 0..count {
            entries.push(Triplet::new(unknown, count + unknown, 0.75));
            entries.push(Triplet::new(count + unknown, unknown, -1.25));
        }
        let size = 2 * count as usize;
        let whole = Columns::of(size, entries);
        let lower: Vec<_> = chain(0, true).collect();
        let lower = SparseColMat::<u32, f64>::try_new_from_triplets(count as usize, count as usize, &lower)
            .expect("entries within the block");
        let block = |start: usize| {
            let (pattern, values) = (lower.symbolic(), lower.val().to_vec());
            let inverse = Inverse::Incomplete(Incomplete::of(&Matrix { pattern, values }));
            Block { start, count: count as usize, inverse }
        };
        let blocks = vec![block(0), block(count as usize)];
        (whole, blocks)
    }

    #[test]
    fn a_coupled_system_is_solved_to_nine_digits() {
        let (matrix, mut blocks) = coupled(500);
        let wanted: Vec<f64> = (0..1000).map(|unknown| f64::from(unknown % 17) - 8.0).collect();
        let right = product(&matrix, &wanted);
        let found = solve(&matrix, &mut blocks, &right).expect("a system that is well conditioned");
        let off: Vec<f64> = found.iter().zip(&wanted).map(|(found, wanted)| found - wanted).collect();
        assert!(norm(&off) < 1e-8 * norm(&wanted), "{}", norm(&off));
        assert_eq!(solve(&matrix, &mut blocks, &[0.0; 1000]), Some(vec![0.0; 1000]));
    }

    /// A permutation in one cycle, for which only the last direction makes progress, like slow modes with an incomplete factor.
    #[test]
    fn slow_progress_is_waited_for_with_incomplete_factors() {
        const COUNT: u32 = 40;
        let cycle: Vec<_> = (0..COUNT).map(|row| Triplet::new(row, (row + 1) % COUNT, 1.0)).collect();
        let matrix = Columns::of(COUNT as usize, cycle);
        let diagonal: Vec<_> = (0..COUNT).map(|row| Triplet::new(row, row, 1.0)).collect();
        let identity = SparseColMat::<u32, f64>::try_new_from_triplets(COUNT as usize, COUNT as usize, &diagonal)
            .expect("entries within the block");
        let (pattern, values) = (identity.symbolic(), identity.val().to_vec());
        let inverse = Inverse::Incomplete(Incomplete::of(&Matrix { pattern, values }));
        let mut blocks = [Block { start: 0, count: COUNT as usize, inverse }];
        let mut wanted = vec![0.0; COUNT as usize];
        wanted[7] = 1.0;
        let found =
            solve(&matrix, &mut blocks, &product(&matrix, &wanted)).expect("it takes one direction for each unknown");
        let off: Vec<f64> = found.iter().zip(&wanted).map(|(found, wanted)| found - wanted).collect();
        assert!(norm(&off) < 1e-9, "{}", norm(&off));
    }

    #[test]
    fn what_has_no_solution_is_given_up() {
        let (matrix, mut blocks) = coupled(10);
        assert_eq!(solve(&matrix, &mut blocks, &[f64::NAN; 20]), None);
    }
}
