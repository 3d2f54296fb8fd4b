//! Exact rational solutions of linear networks, the judge of numbers.

use inpact_network::linear::LinearNetwork;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

/// Everything there is to know of a network, without rounding.
pub struct Exact {
    /// The value of each node.
    pub values: Vec<BigRational>,
    /// The flow through each link with a finite conductance; zero for the others.
    pub flows: Vec<BigRational>,
}

/// A finite f64 as it is.
pub fn rational(value: f64) -> BigRational {
    BigRational::from_float(value).expect("a finite number")
}

/// Solves a network by elimination without fractions (Bareiss); nodes joined by infinite conductances are one.
pub fn solve(network: &LinearNetwork) -> Exact {
    let cluster = clusters(network);
    let nodes = network.nodes();
    let mut held: Vec<Option<f64>> = vec![None; nodes];
    for node in 0..nodes {
        held[cluster[node]] = held[cluster[node]].or(network.held[node]);
    }
    let mut unknown = vec![None; nodes];
    let mut count = 0;
    for node in 0..nodes {
        if cluster[node] == node && held[node].is_none() {
            unknown[node] = Some(count);
            count += 1;
        }
    }
    // Every f64 times 2^1074 is an integer.
    let integer = |value: f64| (rational(value) * BigRational::from(BigInt::from(1) << 1074_u32)).to_integer();
    let mut rows = vec![vec![BigInt::zero(); count + 1]; count];
    for link in network.links.iter().filter(|link| link.conductance > 0.0 && link.conductance.is_finite()) {
        let ends = link.nodes.map(|node| cluster[node as usize]);
        if ends[0] == ends[1] {
            continue;
        }
        let conductance = integer(link.conductance);
        for (here, there) in [(ends[0], ends[1]), (ends[1], ends[0])] {
            let Some(row) = unknown[here] else { continue };
            rows[row][row] += &conductance;
            match unknown[there] {
                Some(column) => rows[row][column] -= &conductance,
                None => rows[row][count] += &conductance * integer(held[there].expect("held")),
            }
        }
    }
    for store in &network.stores {
        let Some(row) = unknown[cluster[store.node as usize]] else { continue };
        let conductance = integer(store.conductance);
        rows[row][row] += &conductance;
        rows[row][count] += &conductance * integer(store.before.to_f64());
    }
    for node in 0..nodes {
        if let Some(row) = unknown[cluster[node]] {
            rows[row][count] += integer(network.sources[node]) << 1074_u32;
        }
    }
    let solution = eliminate(rows);
    let scale = BigRational::from(BigInt::from(1) << 1074_u32);
    let value_of = |node: usize| match unknown[cluster[node]] {
        Some(unknown) => &solution[unknown] / &scale,
        None => rational(held[cluster[node]].expect("held")),
    };
    let values: Vec<BigRational> = (0..nodes).map(value_of).collect();
    let flows = network.links.iter().map(|link| {
        let jump = &values[link.nodes[0] as usize] - &values[link.nodes[1] as usize];
        if link.conductance.is_finite() { jump * rational(link.conductance) } else { BigRational::zero() }
    });
    Exact { flows: flows.collect(), values: values.clone() }
}

/// The smallest node with the same value as each node by infinite conductances.
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

/// Gauss–Jordan elimination of rows with the right side last, all divisions exact.
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

/// The relative error of a value; infinite for a number in the place of zero. What is below the range of f64 may be zero.
pub fn relative_error(value: f64, exact: &BigRational) -> f64 {
    if exact.is_zero() {
        return if value == 0.0 { 0.0 } else { f64::INFINITY };
    }
    if !value.is_finite() {
        return f64::INFINITY;
    }
    let difference = rational(value) - exact;
    // Half the smallest subnormal is as near as an f64 comes; up to the smallest normal that is a loss of digits no one can help.
    let smallest = BigRational::new(BigInt::from(1), BigInt::from(1) << 1074_u32);
    if difference.abs() <= smallest {
        return 0.0;
    }
    to_f64(&(difference / exact).abs())
}

/// A rational of any size as an f64, in some fifteen digits.
pub fn to_f64(number: &BigRational) -> f64 {
    let (top, bottom) = (number.numer(), number.denom());
    let shift = i64::try_from(top.bits()).unwrap() - i64::try_from(bottom.bits()).unwrap() - 64;
    let quotient = if shift >= 0 {
        top / (bottom << u64::try_from(shift).unwrap())
    } else {
        (top << u64::try_from(-shift).unwrap()) / bottom
    };
    let digits = quotient.to_f64().unwrap();
    let clamp = |exponent: i64| i32::try_from(exponent.clamp(-2000, 2000)).unwrap();
    digits * 2.0_f64.powi(clamp(shift / 2)) * 2.0_f64.powi(clamp(shift - shift / 2))
}
