//! Exact rational solutions of linear networks, the judge of the solvers.
//!
//! Written from Kirchhoff's laws alone: nothing of the solvers' own formulas is in it.

use inpact_network::linear::LinearNetwork;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

/// Every f64 times two to this power is an integer.
const BITS: u32 = 1074;

/// Everything there is to know of a network, without rounding.
#[derive(Debug)]
pub struct Exact {
    /// The value of each node.
    pub values: Vec<BigRational>,
    /// The jump across each link.
    pub jumps: Vec<BigRational>,
    /// The flow through each link; `None` through an infinite conductance.
    pub flows: Vec<Option<BigRational>>,
}

/// Solves a network by elimination without fractions (Bareiss); nodes joined by infinite conductances are one.
///
/// # Panics
/// For a network without one solution.
pub fn solve(network: &LinearNetwork) -> Exact {
    let cluster = clusters(network);
    let nodes = network.nodes();
    let mut held: Vec<Option<f64>> = vec![None; nodes];
    for node in 0..nodes {
        held[cluster[node]] = held[cluster[node]].or(network.held[node]);
    }
    let mut unknown = vec![None; nodes];
    let mut count = 0;
    for node in (0..nodes).filter(|&node| cluster[node] == node && held[node].is_none()) {
        unknown[node] = Some(count);
        count += 1;
    }
    let mut rows = vec![vec![BigInt::zero(); count + 1]; count];
    for link in network.links.iter().filter(|link| link.conductance > 0.0 && link.conductance.is_finite()) {
        let ends = link.nodes.map(|node| cluster[node as usize]);
        let conductance = integer(link.conductance);
        for (here, there) in [(ends[0], ends[1]), (ends[1], ends[0])] {
            let Some(row) = unknown[here].filter(|_| ends[0] != ends[1]) else { continue };
            rows[row][row] += &conductance;
            match unknown[there] {
                Some(column) => rows[row][column] -= &conductance,
                None => rows[row][count] += &conductance * integer(held[there].expect("held or unknown")),
            }
        }
    }
    for store in &network.stores {
        let Some(row) = unknown[cluster[store.node as usize]] else { continue };
        let conductance = integer(store.conductance);
        rows[row][count] += &conductance * integer(store.before.to_f64());
        rows[row][row] += conductance;
    }
    for node in 0..nodes {
        if let Some(row) = unknown[cluster[node]] {
            rows[row][count] += integer(network.sources[node]) << BITS;
        }
    }
    let solution = eliminate(rows);
    let scale = BigRational::from(BigInt::from(1) << BITS);
    let value_of = |node: usize| match unknown[cluster[node]] {
        Some(unknown) => &solution[unknown] / &scale,
        None => rational(held[cluster[node]].expect("held or unknown")),
    };
    let values: Vec<BigRational> = (0..nodes).map(value_of).collect();
    let jump = |nodes: [u32; 2]| &values[nodes[0] as usize] - &values[nodes[1] as usize];
    let jumps: Vec<BigRational> = network.links.iter().map(|link| jump(link.nodes)).collect();
    let flow = |(link, jump): (&inpact_network::linear::Link, &BigRational)| {
        link.conductance.is_finite().then(|| jump * rational(link.conductance))
    };
    let flows = network.links.iter().zip(&jumps).map(flow).collect();
    Exact { values, jumps, flows }
}

/// A finite f64 as it is.
fn rational(value: f64) -> BigRational {
    BigRational::from_float(value).expect("a finite number")
}

fn integer(value: f64) -> BigInt {
    (rational(value) * BigRational::from(BigInt::from(1) << BITS)).to_integer()
}

/// The smallest node with the same value as each node, by infinite conductances.
fn clusters(network: &LinearNetwork) -> Vec<usize> {
    let mut cluster: Vec<usize> = (0..network.nodes()).collect();
    loop {
        let before = cluster.clone();
        for link in network.links.iter().filter(|link| link.conductance.is_infinite()) {
            let [a, b] = link.nodes.map(|node| node as usize);
            let least = cluster[a].min(cluster[b]);
            cluster[a] = least;
            cluster[b] = least;
        }
        if cluster == before {
            return cluster;
        }
    }
}

/// Gauss–Jordan elimination of rows with the right side last; all divisions are exact.
fn eliminate(mut rows: Vec<Vec<BigInt>>) -> Vec<BigRational> {
    let count = rows.len();
    let mut before = BigInt::from(1);
    for pivot in 0..count {
        let from = (pivot..count).find(|&row| !rows[row][pivot].is_zero()).expect("a network with one solution");
        rows.swap(pivot, from);
        let pivot_row = rows[pivot].clone();
        for (number, row) in rows.iter_mut().enumerate().filter(|(number, _)| *number != pivot) {
            let factor = row[pivot].clone();
            for (column, entry) in row.iter_mut().enumerate() {
                // Columns before the pivot are those of a diagonal.
                if column >= pivot || column == number {
                    *entry = (&*entry * &pivot_row[pivot] - &factor * &pivot_row[column]) / &before;
                }
            }
        }
        before = pivot_row[pivot].clone();
    }
    rows.into_iter().map(|row| BigRational::new(row[count].clone(), before.clone())).collect()
}

/// Below that an f64 runs out of digits: what is smaller may be off by as much.
const LEAST: i32 = -960;

/// The relative error of a value; zero where both are below what an f64 has digits for.
pub fn relative_error(value: f64, exact: &BigRational) -> f64 {
    if !value.is_finite() {
        return f64::INFINITY;
    }
    let difference = (rational(value) - exact).abs();
    if difference.is_zero() {
        return 0.0;
    }
    let least = BigRational::new(BigInt::from(1), BigInt::from(1) << LEAST.unsigned_abs());
    if difference <= least && exact.abs() <= least {
        return 0.0;
    }
    if exact.is_zero() { f64::INFINITY } else { to_f64(&(difference / exact.abs())) }
}

/// A rational of any size as an f64, in some fifteen digits.
pub fn to_f64(number: &BigRational) -> f64 {
    let bits = |integer: &BigInt| i64::try_from(integer.bits()).unwrap_or(i64::MAX);
    let (top, bottom) = (number.numer(), number.denom());
    let shift = bits(top) - bits(bottom) - 64;
    let by = usize::try_from(shift.unsigned_abs()).unwrap_or(usize::MAX);
    let quotient = if shift >= 0 { top / (bottom << by) } else { (top << by) / bottom };
    let power = |exponent: i64| 2.0_f64.powi(i32::try_from(exponent.clamp(-2000, 2000)).unwrap_or(0));
    quotient.to_f64().unwrap_or(f64::NAN) * power(shift / 2) * power(shift - shift / 2)
}
