//! A Cholesky factor over the free nodes.

use super::Equations;
use inpact_network::linear::{Cholesky, NoSolution};
use inpact_network::{Error, ErrorKind};

const HELD: u32 = u32::MAX;

const MEMORY: ErrorKind = ErrorKind::NotFactored(NoSolution::Memory);

/// Solves, and returns the number of entries of the factor.
pub(super) fn solve(equations: &Equations<'_>, fields: &mut [Vec<f64>]) -> Result<usize, Error> {
    let Equations { matrix, is_held, sources } = equations;
    let mut number = vec![HELD; is_held.len()];
    let mut free: Vec<usize> = Vec::new();
    for (node, number) in number.iter_mut().enumerate().filter(|(node, _)| !is_held[*node]) {
        *number = u32::try_from(free.len()).map_err(|_| MEMORY)?;
        free.push(node);
    }
    if free.is_empty() {
        return Ok(0);
    }
    // Rows become columns: the entries of each are counted, then put in ascending order.
    let links = || {
        free.iter().enumerate().flat_map(|(row, &node)| {
            let range = matrix.starts[node]..matrix.starts[node + 1];
            let entries = matrix.columns[range.clone()].iter().zip(&matrix.values[range]);
            entries.map(move |(column, value)| (row, *column as usize, *value))
        })
    };
    let mut starts = vec![0_u32; free.len() + 1];
    (0..free.len()).for_each(|column| starts[column + 1] = 1);
    for column in links().map(|(_, column, _)| number[column]).filter(|column| *column != HELD) {
        starts[column as usize + 1] = starts[column as usize + 1].checked_add(1).ok_or(MEMORY)?;
    }
    for column in 0..free.len() {
        starts[column + 1] = starts[column + 1].checked_add(starts[column]).ok_or(MEMORY)?;
    }
    let mut next: Vec<usize> = starts.iter().map(|start| *start as usize).collect();
    let entries = next[free.len()];
    let (mut rows, mut values) = (vec![0_u32; entries], vec![0.0; entries]);
    let mut put = |column: usize, row: usize, value: f64| {
        rows[next[column]] = number[free[row]];
        values[next[column]] = value;
        next[column] += 1;
    };
    for (column, &node) in free.iter().enumerate() {
        put(column, column, matrix.diagonal[node]);
    }
    for (row, column, value) in links().filter(|(_, column, _)| number[*column] != HELD) {
        put(number[column] as usize, row, value);
    }
    let mut factor = Cholesky::new(&starts, &rows, values)?;
    for (field, sources) in fields.iter_mut().zip(sources) {
        // A second solve corrects the rounding of the first (iterative refinement).
        for _ in 0..2 {
            let residual = equations.residual(field, sources);
            let mut right: Vec<f64> = free.iter().map(|node| residual[*node]).collect();
            factor.solve(&mut right)?;
            for (node, change) in free.iter().zip(right) {
                field[*node] += change;
            }
        }
    }
    Ok(factor.entries())
}
