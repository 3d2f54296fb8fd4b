//! Exact solutions of linear networks, the reference for the solvers.
//!
//! Written from Kirchhoff's laws alone, in integer arithmetic: it shares no formula with the solvers.

use inpact_network::linear::{LinearNetwork, Link};
use num_bigint::{BigInt, Sign};
use num_traits::{Signed, ToPrimitive, Zero};

/// The exact solution of a network.
#[derive(Debug)]
pub struct Exact {
    /// The value of each node.
    pub values: Vec<Fraction>,
    /// The jump across each link.
    pub jumps: Vec<Fraction>,
    /// The flow through each link; `None` through an infinite conductance.
    pub flows: Vec<Option<Fraction>>,
}

/// An unreduced fraction: finding common factors of numbers with 100,000 digits would take longer than solving the network.
#[derive(Debug)]
pub struct Fraction {
    top: BigInt,
    /// More than zero.
    bottom: BigInt,
}

/// Solves a network by fraction-free elimination (Bareiss); nodes joined by infinite conductances are merged.
///
/// # Panics
/// For a network without one solution.
pub fn solve(network: &LinearNetwork) -> Exact {
    let scale = Scale::of(network);
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
        let conductance = whole(link.conductance, scale.conductances);
        for (here, there) in [(ends[0], ends[1]), (ends[1], ends[0])] {
            let Some(row) = unknown[here].filter(|_| ends[0] != ends[1]) else { continue };
            rows[row][row] += &conductance;
            match unknown[there] {
                Some(column) => rows[row][column] -= &conductance,
                None => {
                    let held = whole(held[there].expect("held or unknown"), scale.values);
                    rows[row][count] += &conductance * held;
                }
            }
        }
    }
    for store in &network.stores {
        let Some(row) = unknown[cluster[store.node as usize]] else { continue };
        let conductance = whole(store.conductance, scale.conductances);
        rows[row][count] += &conductance * whole(store.before.to_f64(), scale.values);
        rows[row][row] += conductance;
    }
    for node in 0..nodes {
        if let Some(row) = unknown[cluster[node]] {
            rows[row][count] += whole(network.sources[node], scale.conductances + scale.values);
        }
    }
    let (tops, bottom) = eliminate(rows);
    let top_of = |node: usize| match unknown[cluster[node]] {
        Some(unknown) => tops[unknown].clone(),
        None => whole(held[cluster[node]].expect("held or unknown"), scale.values) * &bottom,
    };
    let values: Vec<BigInt> = (0..nodes).map(top_of).collect();
    let jump = |link: &Link| &values[link.nodes[0] as usize] - &values[link.nodes[1] as usize];
    let of_value = |top: BigInt| Fraction { top, bottom: &bottom << scale.values };
    let flow = |link: &Link| {
        link.conductance.is_finite().then(|| Fraction {
            top: jump(link) * whole(link.conductance, scale.conductances),
            bottom: &bottom << (scale.values + scale.conductances),
        })
    };
    Exact {
        jumps: network.links.iter().map(|link| of_value(jump(link))).collect(),
        flows: network.links.iter().map(flow).collect(),
        values: values.iter().cloned().map(of_value).collect(),
    }
}

/// The number of fractional bits that make everything in a network an integer.
struct Scale {
    conductances: u32,
    values: u32,
}

impl Scale {
    fn of(network: &LinearNetwork) -> Self {
        let most = |numbers: &mut dyn Iterator<Item = f64>| numbers.map(bits_after_point).max().unwrap_or(0);
        let finite = network.links.iter().map(|link| link.conductance).filter(|conductance| conductance.is_finite());
        let conductances = most(&mut finite.chain(network.stores.iter().map(|store| store.conductance)));
        let before = network.stores.iter().map(|store| store.before.to_f64());
        let values = most(&mut network.held.iter().flatten().copied().chain(before));
        let sources = most(&mut network.sources.iter().copied());
        Self { conductances, values: values.max(sources.saturating_sub(conductances)) }
    }
}

/// A finite f64 as an integer times a power of two.
fn parts(value: f64) -> (i64, i32) {
    let bits = value.to_bits();
    let exponent = i32::try_from(bits >> 52 & 0x7ff).unwrap_or(0);
    let fraction = i64::try_from(bits & ((1 << 52) - 1)).unwrap_or(0);
    let (whole, exponent) = if exponent == 0 { (fraction, 1) } else { (fraction | 1 << 52, exponent) };
    (if value < 0.0 { -whole } else { whole }, exponent - 1075)
}

fn bits_after_point(value: f64) -> u32 {
    let (whole, exponent) = parts(value);
    if whole == 0 {
        return 0;
    }
    let zeros = i32::try_from(whole.trailing_zeros()).unwrap_or(0);
    u32::try_from(-(exponent + zeros)).unwrap_or(0)
}

/// A number times a power of two that makes it an integer.
fn whole(value: f64, bits: u32) -> BigInt {
    let (whole, exponent) = parts(value);
    shifted(BigInt::from(whole), i64::from(exponent) + i64::from(bits))
}

/// A number times a power of two; the bits shifted out are zero.
fn shifted(number: BigInt, by: i64) -> BigInt {
    if by < 0 { number >> by.unsigned_abs() } else { number << by.unsigned_abs() }
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

/// The solution of symmetric rows with the right-hand side last, as numerators and their common denominator.
///
/// Every division is exact; the pivots are the principal minors of a positive definite matrix, so none is zero.
fn eliminate(mut rows: Vec<Vec<BigInt>>) -> (Vec<BigInt>, BigInt) {
    let count = rows.len();
    let mut before = BigInt::from(1);
    for pivot in 0..count {
        let (above, below) = rows.split_at_mut(pivot + 1);
        let pivot_row = &above[pivot];
        assert!(pivot_row[pivot].is_positive(), "a network with one solution");
        for (row, number) in below.iter_mut().zip(pivot + 1..) {
            let factor = &pivot_row[number];
            for column in number..=count {
                let product = if factor.is_zero() || pivot_row[column].is_zero() {
                    BigInt::zero()
                } else {
                    factor * &pivot_row[column]
                };
                row[column] = (&row[column] * &pivot_row[pivot] - product) / &before;
            }
        }
        before.clone_from(&pivot_row[pivot]);
    }
    let mut tops = vec![BigInt::zero(); count];
    for row in (0..count).rev() {
        let mut top = &rows[row][count] * &before;
        for column in row + 1..count {
            top -= &rows[row][column] * &tops[column];
        }
        tops[row] = top / &rows[row][row];
    }
    (tops, before)
}

/// Below two to this power an f64 loses digits: smaller numbers may have an error of that size.
const LEAST: i64 = -960;

impl Fraction {
    /// Whether it is not zero, but subnormal or below the range of f64.
    pub fn is_below_range(&self) -> bool {
        !self.top.is_zero() && self.top.magnitude() <= shifted(self.bottom.clone(), LEAST).magnitude()
    }
}

/// Two to this power is beyond the range of f64.
const BEYOND: i64 = 1024;

impl Exact {
    /// Whether a value or a flow is larger than any f64.
    pub fn is_beyond_range(&self) -> bool {
        self.values.iter().chain(self.flows.iter().flatten()).any(Fraction::is_beyond_range)
    }
}

impl Fraction {
    /// Whether it is larger than any f64.
    fn is_beyond_range(&self) -> bool {
        self.top.magnitude() >= shifted(self.bottom.clone(), BEYOND).magnitude()
    }
}

/// The relative error of a value; zero where both are below the normal range of f64.
pub fn relative_error(value: f64, exact: &Fraction) -> f64 {
    if !value.is_finite() {
        return f64::INFINITY;
    }
    let Fraction { top, bottom } = exact;
    let (whole, exponent) = parts(value);
    let product = bottom * whole;
    // Aligns the fractional bits of the two.
    let (product, top) = if exponent < 0 {
        (product, top << exponent.unsigned_abs())
    } else {
        (product << exponent.unsigned_abs(), top.clone())
    };
    let difference = (product - &top).abs();
    if difference.is_zero() {
        return 0.0;
    }
    let least = shifted(bottom.clone(), LEAST - i64::from(exponent.min(0)));
    if difference <= least && top.magnitude() <= least.magnitude() {
        return 0.0;
    }
    if top.sign() == Sign::NoSign { f64::INFINITY } else { quotient(&difference, &top.abs()) }
}

/// A quotient of two positive numbers of any size, in some fifteen digits.
fn quotient(top: &BigInt, bottom: &BigInt) -> f64 {
    let bits = |number: &BigInt| i64::try_from(number.bits()).unwrap_or(i64::MAX);
    let shift = bits(top) - bits(bottom) - 64;
    let digits =
        if shift < 0 { (top << shift.unsigned_abs()) / bottom } else { top / (bottom << shift.unsigned_abs()) };
    let power = |exponent: i64| 2.0_f64.powi(i32::try_from(exponent.clamp(-2000, 2000)).unwrap_or(0));
    digits.to_f64().unwrap_or(f64::NAN) * power(shift / 2) * power(shift - shift / 2)
}
