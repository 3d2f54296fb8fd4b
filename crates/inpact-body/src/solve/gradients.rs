//! Conjugate gradients for several right-hand sides, preconditioned by one symmetric Gauss–Seidel sweep.
//!
//! With the diagonal scaled to one, A = L + 1 + Lᵀ, and with the preconditioner (1 + L)(1 + Lᵀ) each step takes one solution with either factor and no product
//! with A: (1 + L)⁻¹ A (1 + Lᵀ)⁻¹ p = t + (1 + L)⁻¹(p − t), t = (1 + Lᵀ)⁻¹ p (S. C. Eisenstat, Efficient implementation of a class of preconditioned conjugate
//! gradient methods, SIAM J. Sci. Stat. Comput. 2, 1981). The preconditioner exists for every matrix that is positive definite, whatever the signs of its entries.
//!
//! Up to four right-hand sides are multiplied together, so that the entries of the matrix are read once for all of them.

use super::Equations;

/// The relative residual, in the norm of the preconditioner, at which an iteration ends. The error of conductances is a product of two errors, far below this.
const REDUCTION: f64 = 1e-12;

/// The maximum number of iterations, beyond which the factor is cheaper.
const MAX_ITERATIONS: usize = 5_000;

/// Solves as far as possible, and returns the number of iterations.
pub(super) fn solve(equations: &Equations<'_>, fields: &mut [Vec<f64>]) -> usize {
    let scaled = Scaled::of(equations);
    let mut most = 0;
    let mut done = 0;
    while done < fields.len() {
        let some = &mut fields[done..];
        let iterations = match some.len() {
            1 => scaled.solve::<1>(equations, done, some),
            2 => scaled.solve::<2>(equations, done, some),
            3 => scaled.solve::<3>(equations, done, some),
            _ => scaled.solve::<4>(equations, done, some),
        };
        most = most.max(iterations);
        done += some.len().min(4);
    }
    most
}

/// L of the matrix scaled from both sides to have ones on its diagonal; rows and columns of held nodes are zero.
struct Scaled<'a> {
    starts: &'a [usize],
    columns: &'a [u32],
    values: Vec<f64>,
    scale: Vec<f64>,
}

/// A value for each right-hand side, at each node.
type Columns<const W: usize> = Vec<[f64; W]>;

impl<'a> Scaled<'a> {
    fn of(equations: &Equations<'a>) -> Self {
        let matrix = equations.matrix;
        let scale: Vec<f64> = matrix
            .diagonal
            .iter()
            .zip(equations.is_held)
            .map(|(diagonal, is_held)| if *is_held { 0.0 } else { diagonal.sqrt().recip() })
            .collect();
        let mut values = matrix.values.clone();
        for row in 0..scale.len() {
            for at in matrix.starts[row]..matrix.starts[row + 1] {
                values[at] *= scale[row] * scale[matrix.columns[at] as usize];
            }
        }
        Self { starts: &matrix.starts, columns: &matrix.columns, values, scale }
    }

    fn entries(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.starts[row]..self.starts[row + 1];
        self.columns[range.clone()].iter().zip(&self.values[range]).map(|(column, value)| (*column as usize, *value))
    }

    /// (1 + L)⁻¹ in place.
    fn forward<const W: usize>(&self, x: &mut Columns<W>) {
        for row in 0..x.len() {
            let mut sum = x[row];
            for (column, value) in self.entries(row) {
                let other = x[column];
                (0..W).for_each(|k| sum[k] -= value * other[k]);
            }
            x[row] = sum;
        }
    }

    /// (1 + Lᵀ)⁻¹ in place.
    fn backward<const W: usize>(&self, x: &mut Columns<W>) {
        for row in (0..x.len()).rev() {
            let of_row = x[row];
            for (column, value) in self.entries(row) {
                let other = &mut x[column];
                (0..W).for_each(|k| other[k] -= value * of_row[k]);
            }
        }
    }

    /// Adds the corrections for their residuals to the first W fields.
    fn solve<const W: usize>(&self, equations: &Equations<'_>, first: usize, fields: &mut [Vec<f64>]) -> usize {
        let nodes = self.scale.len();
        let mut residual: Columns<W> = vec![[0.0; W]; nodes];
        for (k, field) in fields.iter().take(W).enumerate() {
            let left = equations.residual(field, &equations.sources[first + k]);
            for (to, (left, scale)) in residual.iter_mut().zip(left.iter().zip(&self.scale)) {
                to[k] = left * scale;
            }
        }
        self.forward(&mut residual);
        let mut direction = residual.clone();
        let mut solution: Columns<W> = vec![[0.0; W]; nodes];
        let mut turned: Columns<W> = vec![[0.0; W]; nodes];
        let mut image: Columns<W> = vec![[0.0; W]; nodes];
        let mut squares = products(&residual, &residual);
        let goals = squares.map(|square| square * REDUCTION * REDUCTION);
        let mut iterations = 0;
        while iterations < MAX_ITERATIONS && (0..W).any(|k| goals[k] < squares[k]) {
            iterations += 1;
            turned.copy_from_slice(&direction);
            self.backward(&mut turned);
            for ((image, direction), turned) in image.iter_mut().zip(&direction).zip(&turned) {
                (0..W).for_each(|k| image[k] = direction[k] - turned[k]);
            }
            self.forward(&mut image);
            for (image, turned) in image.iter_mut().zip(&turned) {
                (0..W).for_each(|k| image[k] += turned[k]);
            }
            let curvatures = products(&direction, &image);
            let mut steps = [0.0; W];
            for k in 0..W {
                // A converged one is unchanged.
                if goals[k] < squares[k] && 0.0 < curvatures[k] {
                    steps[k] = squares[k] / curvatures[k];
                }
            }
            if steps.iter().all(|step| *step == 0.0) {
                break;
            }
            for (at, (residual, solution)) in residual.iter_mut().zip(&mut solution).enumerate() {
                for k in 0..W {
                    solution[k] += steps[k] * turned[at][k];
                    residual[k] -= steps[k] * image[at][k];
                }
            }
            let next = products(&residual, &residual);
            let shares: [f64; W] = std::array::from_fn(|k| if 0.0 < squares[k] { next[k] / squares[k] } else { 0.0 });
            for (direction, residual) in direction.iter_mut().zip(&residual) {
                (0..W).for_each(|k| direction[k] = residual[k] + shares[k] * direction[k]);
            }
            squares = next;
        }
        for (k, field) in fields.iter_mut().take(W).enumerate() {
            for (value, (solution, scale)) in field.iter_mut().zip(solution.iter().zip(&self.scale)) {
                *value += solution[k] * scale;
            }
        }
        iterations
    }
}

/// The products of two columns, for each right-hand side.
fn products<const W: usize>(x: &Columns<W>, y: &Columns<W>) -> [f64; W] {
    let mut sums = [0.0; W];
    for (x, y) in x.iter().zip(y) {
        (0..W).for_each(|k| sums[k] += x[k] * y[k]);
    }
    sums
}
