//! The tables and queries that are timed.

use inpact_evaluation::table::{PiecewiseTable, Tail};

/// A table and the columns it is asked at.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) table: PiecewiseTable,
    /// The abscissae of each axis, where the table is a grid.
    pub(crate) grid: Option<Vec<Vec<f64>>>,
    /// Axis 0 running fastest, as the rows have it.
    pub(crate) values: Vec<f64>,
    /// One column an axis; a tenth of the queries lies outside on either side.
    pub(crate) columns: Vec<Vec<f64>>,
}

/// All cases with so many rows.
pub(crate) fn cases(rows: usize) -> Vec<Case> {
    let mut random = Random(1);
    let mut cases = Vec::new();
    for count in [2, 10, 16, 100, 1000] {
        let knots = uniform(&mut random, count);
        cases.push(grid_case(format!("1-D uniform, {count} points"), vec![knots], rows, &mut random, false));
    }
    for count in [10, 100, 1000] {
        let knots = logarithmic(&mut random, count);
        cases.push(grid_case(format!("1-D logarithmic, {count} points"), vec![knots], rows, &mut random, true));
    }
    let axes = vec![uniform(&mut random, 10), uniform(&mut random, 10)];
    cases.push(grid_case("2-D, 10 × 10".to_owned(), axes, rows, &mut random, false));
    cases.push(ragged_case(rows, &mut random));
    cases
}

fn grid_case(name: String, grid: Vec<Vec<f64>>, rows: usize, random: &mut Random, by_decades: bool) -> Case {
    let mut cells = Vec::new();
    let outer = grid.get(1).map_or(&[f64::NAN][..], Vec::as_slice);
    for &y in outer {
        for &x in &grid[0] {
            cells.push((1.0 + random.unit()) / (1.0 + x));
            cells.push(x);
            cells.extend((grid.len() > 1).then_some(y));
        }
    }
    let width = grid.len() + 1;
    let columns = grid.iter().map(|knots| queries(knots, rows, random, by_decades)).collect();
    let table = PiecewiseTable::from_rows(&cells, width, Tail::Constant).expect("the rows ascend");
    let values = cells.iter().step_by(width).copied().collect();
    Case { name, table, grid: Some(grid), values, columns }
}

/// Three axes of 4, 5 and some 8 points, each group with abscissae of its own.
fn ragged_case(rows: usize, random: &mut Random) -> Case {
    let mut cells = Vec::new();
    for z in uniform(random, 4) {
        for y in uniform(random, 5) {
            let count = 6 + random.below(5);
            for x in uniform(random, count) {
                cells.extend([(1.0 + random.unit()) / (1.0 + x), x, y, z]);
            }
        }
    }
    let columns = [10, 5, 4].map(|count| queries(&[0.0, f64::from(count)], rows, random, false)).to_vec();
    let table = PiecewiseTable::from_rows(&cells, 4, Tail::Constant).expect("the rows ascend");
    Case { name: "3-D ragged, 4 × 5 × 6 to 10".to_owned(), table, grid: None, values: Vec::new(), columns }
}

fn uniform(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|knot| knot as f64 + 0.6 * random.unit()).collect()
}

/// Abscissae from 1e-9 to about 1.
fn logarithmic(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|knot| 10_f64.powf(9.0 * (knot as f64 + 0.3 * random.unit()) / (count - 1) as f64 - 9.0)).collect()
}

fn queries(knots: &[f64], rows: usize, random: &mut Random, by_decades: bool) -> Vec<f64> {
    let (first, last) = (knots[0], knots[knots.len() - 1]);
    let mut part = || 1.2 * random.unit() - 0.1;
    (0..rows)
        .map(|_| if by_decades { first * (last / first).powf(part()) } else { first + (last - first) * part() })
        .collect()
}

/// Random numbers, the same in every run (SplitMix64).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / 9_007_199_254_740_992.0
    }

    fn below(&mut self, limit: u64) -> usize {
        usize::try_from(self.bits() % limit).unwrap_or(0)
    }
}
