//! Solves the equations of a body for several right-hand sides at once.
//!
//! Small ones are factored; large three-dimensional ones would fill in thousands of entries a node, so that conjugate gradients take some hundred iterations instead,
//! for all right-hand sides together. Where these do not converge, the matrix is factored.

mod direct;
mod gradients;

use crate::assembly::Matrix;
use crate::error::Error;
use inpact_network::ErrorKind;
use inpact_network::linear::NoSolution;

/// Above this number of unknowns the matrix is factored only as a fallback.
const MAX_FACTORED: usize = 20_000;

/// The largest acceptable imbalance of a node, relative to the flows through it and through all nodes.
const LARGEST_IMBALANCE: f64 = 1e-9;

/// How the equations of a body were solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution {
    /// The method.
    pub method: SolutionMethod,
    /// The number of unknowns.
    pub unknowns: usize,
    /// The number of entries of the matrix below the diagonal.
    pub entries: usize,
    /// The largest imbalance of a node, relative to the largest flow through one.
    pub imbalance: f64,
}

/// Ways to solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolutionMethod {
    /// A Cholesky factor with this number of entries.
    Factor(usize),
    /// This number of iterations of conjugate gradients.
    Iterations(usize),
}

/// Equations: a matrix, the nodes with known values, and right-hand sides.
pub(crate) struct Equations<'a> {
    pub(crate) matrix: &'a Matrix,
    /// Nodes that keep their values.
    pub(crate) is_held: &'a [bool],
    /// The flow into each node from outside, for each right-hand side.
    pub(crate) sources: Vec<Vec<f64>>,
}

impl Equations<'_> {
    /// Computes the values of the free nodes, from initial ones.
    ///
    /// # Errors
    ///
    /// Memory runs out, or rounding destroys the solution.
    pub(crate) fn solve(&self, fields: &mut [Vec<f64>]) -> Result<Solution, Error> {
        let unknowns = self.is_held.iter().filter(|is_held| !**is_held).count();
        let entries = self.matrix.values.len();
        let mut method = SolutionMethod::Factor(0);
        let mut imbalance = f64::INFINITY;
        if MAX_FACTORED < unknowns {
            let begun = fields.to_vec();
            method = SolutionMethod::Iterations(gradients::solve(self, fields));
            imbalance = self.imbalance(fields);
            if !is_balanced(imbalance) {
                fields.clone_from_slice(&begun);
            }
        }
        if !is_balanced(imbalance) {
            let filled = direct::solve(self, fields).map_err(|error| failed(&error, unknowns))?;
            method = SolutionMethod::Factor(filled);
            imbalance = self.imbalance(fields);
            if !is_balanced(imbalance) {
                return Err(Error::without_place(format!(
                    "the body was not solved: flows at a node leave {imbalance:.1e} of the largest unbalanced"
                )));
            }
        }
        Ok(Solution { method, unknowns, entries, imbalance })
    }

    /// The residual flow out of each node; 0 for held nodes.
    fn residual(&self, field: &[f64], sources: &[f64]) -> Vec<f64> {
        let mut residual = self.matrix.flows(field);
        for ((residual, source), is_held) in residual.iter_mut().zip(sources).zip(self.is_held) {
            *residual = if *is_held { 0.0 } else { source - *residual };
        }
        residual
    }

    /// The largest imbalance of a node that is not held, relative to the largest flow through any.
    fn imbalance(&self, fields: &[Vec<f64>]) -> f64 {
        let mut worst = 0.0_f64;
        for (field, sources) in fields.iter().zip(&self.sources) {
            let left = self.residual(field, sources).iter().copied().fold(0.0, larger);
            let mut through: Vec<f64> = sources.iter().map(|source| source.abs()).collect();
            for row in 0..field.len() {
                for at in self.matrix.starts[row]..self.matrix.starts[row + 1] {
                    let column = self.matrix.columns[at] as usize;
                    let flow = (self.matrix.values[at] * (field[row] - field[column])).abs();
                    through[row] += flow;
                    through[column] += flow;
                }
            }
            let largest = through.iter().copied().fold(0.0, larger);
            worst = if left == 0.0 { worst } else { larger(worst, left / largest) };
        }
        worst
    }
}

/// Whether a solution is acceptable; one with a NaN is not.
fn is_balanced(imbalance: f64) -> bool {
    imbalance <= LARGEST_IMBALANCE
}

/// The larger magnitude; what is not a number counts as the largest.
fn larger(largest: f64, value: f64) -> f64 {
    if value.abs() <= largest { largest } else { value.abs() }
}

fn failed(error: &inpact_network::Error, unknowns: usize) -> Error {
    Error::without_place(match error.kind() {
        ErrorKind::NotFactored(NoSolution::Memory) => {
            format!("there is not enough memory for a factor of {unknowns} unknowns")
        }
        _ => {
            format!("the body was not solved: rounding leaves its {unknowns} equations without a solution")
        }
    })
}
