//! The fast forms: their errors are maximised, against the reference, and compared with their bounds.

mod accuracy_support;
mod table_judge;

use accuracy_support::{Range, compile, random_ending, random_rows};
use inpact_evaluation::accuracy::{Approximation, ErrorBound, commensurate_cells};
use inpact_evaluation::numbers::Scaled;
use inpact_evaluation::table::{AxisSummary, PiecewiseTable, Tail};
use table_judge::{Ending, Random, Rows, cases, report};

/// The error of an approximation at a point, absolute and as a part of the exact value.
fn error_at(table: &PiecewiseTable, made: &Approximation, point: &[f64]) -> (f64, f64) {
    let exact = table.reference_at(point[0], &point[1..]).unwrap();
    let value = made.value(point);
    assert!(value.is_finite(), "{value} at {point:?}");
    let absolute = (Scaled::new(value) + -exact).to_f64().abs();
    let magnitude = exact.to_f64().abs().max(f64::MIN_POSITIVE);
    (absolute, if absolute == 0.0 { 0.0 } else { absolute / magnitude })
}

/// The largest errors found: at abscissae and beside them, at random points, and by climbing from the best of these.
fn maximise(random: &mut Random, rows: &Rows, table: &PiecewiseTable, made: &Approximation) -> (f64, f64) {
    let axes = rows[0].len() - 1;
    let ranges: Vec<(f64, f64)> =
        (0..axes).map(|axis| (table.axes()[axis].least, table.axes()[axis].greatest)).collect();
    let all_knots: Vec<Vec<f64>> = (0..axes)
        .map(|axis| {
            let mut knots: Vec<f64> = rows.iter().map(|row| row[axis + 1]).collect();
            knots.sort_by(f64::total_cmp);
            knots.dedup();
            knots
        })
        .collect();
    let coordinate = |random: &mut Random, axis: usize| {
        let knot = rows[random.below(rows.len())][axis + 1];
        match random.below(10) {
            0 => knot,
            1 => knot.next_up(),
            2 => knot.next_down(),
            3 => knot + knot.abs().max(1e-3) * random.positive(-40, -10),
            4 => knot - knot.abs().max(1e-3) * random.positive(-40, -10),
            5 | 6 => ranges[axis].0 + (ranges[axis].1 - ranges[axis].0) * random.unit(),
            _ => {
                // Segments are chosen with equal chance, however narrow they are.
                let knots = &all_knots[axis];
                let left = random.below(knots.len() - 1);
                knots[left] + (knots[left + 1] - knots[left]) * random.unit()
            }
        }
    };
    let mut best = [(0.0, vec![0.0; axes]), (0.0, vec![0.0; axes])];
    let note = |best: &mut [(f64, Vec<f64>); 2], point: &[f64]| {
        let (absolute, relative) = error_at(table, made, point);
        for (best, error) in best.iter_mut().zip([absolute, relative]) {
            if error > best.0 {
                *best = (error, point.to_vec());
            }
        }
    };
    for _ in 0..600 * axes {
        let point: Vec<f64> = (0..axes).map(|axis| coordinate(random, axis)).collect();
        note(&mut best, &point);
    }
    for step in 0..600 * axes {
        let mut point = best[step % 2].1.clone();
        let axis = random.below(axes);
        let width = (ranges[axis].1 - ranges[axis].0).max(1e-300);
        let sign = [1.0, -1.0][random.below(2)];
        point[axis] = match random.below(3) {
            0 => coordinate(random, axis),
            1 => point[axis] + sign * width * random.positive(-52, -1),
            _ => point[axis] + sign * point[axis].abs() * random.positive(-52, -20),
        };
        note(&mut best, &point);
    }
    (best[0].0, best[1].0)
}

/// The quotients of bound and largest error of many tables.
#[derive(Default)]
struct Looseness {
    absolute: Vec<f64>,
    pointwise: Vec<f64>,
}

impl Looseness {
    fn note(&mut self, bound: ErrorBound, (absolute, relative): (f64, f64), of: &impl Fn() -> String) {
        assert!(absolute <= bound.absolute, "{absolute:e} is above {bound:?} of {}", of());
        assert!(relative <= bound.pointwise, "{relative:e} is above {bound:?} of {}", of());
        self.absolute.push(if absolute == 0.0 { f64::INFINITY } else { bound.absolute / absolute });
        if bound.pointwise.is_finite() {
            self.pointwise.push(if relative == 0.0 { f64::INFINITY } else { bound.pointwise / relative });
        }
    }

    /// Half of the quotients, nine tenths of them, and all are at most this.
    fn of(quotients: &mut [f64]) -> [f64; 3] {
        quotients.sort_by(f64::total_cmp);
        [quotients.len() / 2, quotients.len() * 9 / 10, quotients.len() - 1].map(|index| quotients[index])
    }

    /// The absolute bound is within a factor of six of the largest error for half of the tables, and never `greatest` times too large.
    /// The pointwise one can be: where a value falls by many decades on one segment, a single rounding decides, and for short numbers it is often none;
    /// with each further axis the worst place of the axes inside would have to coincide.
    fn check(mut self, what: &str, axes: usize, greatest: f64) {
        let absolute = Self::of(&mut self.absolute);
        let pointwise = Self::of(&mut self.pointwise);
        let measured = format!("bound / largest error for 50, 90, 100 %: {absolute:.3?}, pointwise {pointwise:.3?}");
        report(what, &measured);
        assert!(absolute[0] <= 6.0 && absolute[2] <= greatest, "{what}: {measured}");
        if axes <= 2 {
            assert!(pointwise[0] <= 0.5 * greatest, "{what}: {measured}");
        }
    }
}

/// A table that has something to approximate: a value that is no power of two, several abscissae on each axis.
fn table_of(random: &mut Random, axes: usize) -> (Rows, PiecewiseTable) {
    loop {
        let rows = random_rows(random, axes, Range::Ordinary);
        let ending = random_ending(random);
        let table = compile(&rows, ending);
        if table.axes().iter().all(AxisSummary::matters) {
            return (rows, table);
        }
    }
}

fn check_form(
    what: &str,
    axes: usize,
    count: usize,
    greatest: f64,
    make: impl Fn(&PiecewiseTable) -> Option<Approximation>,
) {
    let mut random = Random::new(0xa0 + axes as u64);
    let mut looseness = Looseness::default();
    let mut made_count = 0;
    for _ in 0..cases(count) {
        let (rows, table) = table_of(&mut random, axes);
        let Some(made) = make(&table) else { continue };
        made_count += 1;
        let errors = maximise(&mut random, &rows, &table, &made);
        looseness.note(made.bound(), errors, &|| format!("{rows:?} {:?}", table.tail()));
    }
    assert!(2 * made_count > count, "only {made_count} of {count} tables had the form");
    looseness.check(&format!("{what}, {axes} axes"), axes, greatest);
}

#[test]
fn the_slope_form_keeps_its_bound() {
    for (axes, count) in [(1, 60), (2, 30), (3, 12), (4, 5)] {
        check_form("slope", axes, count, 100.0, |table| Approximation::slope(table).ok());
    }
}

#[test]
fn the_single_form_keeps_its_bound() {
    for (axes, count) in [(1, 60), (2, 30), (3, 12), (4, 5)] {
        check_form("single", axes, count, 100.0, |table| Approximation::single(table).ok());
    }
}

/// A grid that meets none but the outermost abscissae of most tables.
fn resampled(axes: usize) -> impl Fn(&PiecewiseTable) -> Option<Approximation> {
    move |table| Approximation::grid(table, &vec![9; axes]).ok()
}

#[test]
fn a_grid_keeps_its_bound() {
    for (axes, count) in [(2, 30), (3, 8)] {
        // Where a grid happens to meet all abscissae only roundings are left, which are bounded without looking at each.
        check_form("grid", axes, count, 1000.0, resampled(axes));
    }
}

/// The error of a grid is largest at a vertex, where the bound has looked: what is found by climbing onto the vertices reaches it.
#[test]
fn the_bound_of_a_grid_is_its_true_maximum() {
    let rows: Rows = [[10.0, 0.0, 300.0], [6.0, 1.0, 300.0], [2.0, 2.0, 300.0], [20.0, 0.0, 400.0], [10.0, 3.5, 400.0]]
        .map(|row| row.to_vec())
        .to_vec();
    let table = compile(&rows, Ending::Constant);
    for cells in [[3, 2], [6, 1], [10, 10], [33, 5]] {
        let made = Approximation::grid(&table, &cells).unwrap();
        let mut worst = (0.0_f64, 0.0_f64);
        let lines = (0..=cells[0]).map(|line| 3.5 * line as f64 / cells[0] as f64);
        for x in lines.chain([0.0, 1.0, 2.0, 3.5]) {
            for line in 0..=cells[1] {
                let y = 300.0 + 100.0 * line as f64 / cells[1] as f64;
                let (absolute, relative) = error_at(&table, &made, &[x, y]);
                worst = (worst.0.max(absolute), worst.1.max(relative));
            }
        }
        let bound = made.bound();
        assert!(worst.0 > 1e-3, "{cells:?} meets every abscissa");
        assert!(worst.0 <= bound.absolute && bound.absolute <= 1.000_000_1 * worst.0, "{worst:?} and {bound:?}");
        assert!(worst.1 <= bound.pointwise && bound.pointwise <= 1.000_000_1 * worst.1, "{worst:?} and {bound:?}");
    }
}

#[test]
fn a_grid_that_meets_all_abscissae_is_exact() {
    let mut rows = Rows::new();
    let mut random = Random::new(5);
    for (group, y) in [20.0, 120.0, 220.0, 420.0].into_iter().enumerate() {
        for x in &[0.0, 0.1, 0.2, 0.5, 0.7][..5 - group % 2] {
            rows.push(vec![random.positive(-3, 3), *x, y]);
        }
    }
    let table = compile(&rows, Ending::Constant);
    let cells = commensurate_cells(&table).unwrap();
    assert_eq!(cells, [7, 4]);
    let made = Approximation::grid(&table, &cells).unwrap();
    assert!(made.bound().pointwise < 1e-11, "{:?}", made.bound());
    let (absolute, relative) = maximise(&mut random, &rows, &table, &made);
    assert!(0.0 < absolute && absolute <= made.bound().absolute, "{absolute:e} and {:?}", made.bound());
    assert!(relative <= made.bound().pointwise, "{relative:e} and {:?}", made.bound());
    let uneven = compile(
        &vec![
            vec![1.0, 0.0, 1.0],
            vec![2.0, 1.0, 1.0],
            vec![3.0, 0.0, 2.0],
            vec![1.0, 0.123_456_789, 2.0],
            vec![4.0, 1.0, 2.0],
        ],
        Ending::Constant,
    );
    assert_eq!(commensurate_cells(&uneven), None);
}

/// All forms of one table.
fn all_forms(table: &PiecewiseTable) -> Vec<Approximation> {
    let grid = (table.axes().iter().filter(|axis| axis.matters()).count() > 1)
        .then(|| Approximation::grid(table, &[8, 4]).unwrap());
    [Approximation::slope(table).unwrap(), Approximation::single(table).unwrap()].into_iter().chain(grid).collect()
}

#[test]
fn nan_infinities_and_ends_are_those_of_the_full_mode() {
    let two = [10.0, 0.0, 300.0, 2.0, 2.0, 300.0, 20.0, 0.0, 400.0, 10.0, 2.0, 400.0];
    let one = [10.0, 0.0, 6.0, 1.0, 2.0, 2.0];
    let mut many = Vec::new();
    for knot in 0..50_u16 {
        many.extend([1.0 + f64::from(knot % 7), f64::from(knot)]);
    }
    for (cells, width) in [(&two[..], 3), (&one[..], 2), (&many[..], 2)] {
        for tail in [Tail::Constant, Tail::Zero] {
            let table = PiecewiseTable::from_rows(cells, width, tail).unwrap();
            let last = table.axes()[0].greatest;
            for made in all_forms(&table) {
                for x in [f64::NEG_INFINITY, -1.0, 0.0, last, last.next_up(), 1e30, 1e300, f64::INFINITY, f64::NAN] {
                    for y in [f64::NEG_INFINITY, 300.0, 400.0, f64::INFINITY, f64::NAN] {
                        let point = &[x, y][..width - 1];
                        let (full, fast) = (table.value(point), made.value(point));
                        let same = full == fast || (full.is_nan() && fast.is_nan());
                        assert!(same, "{fast} for {full} at {point:?} with {}", made.form());
                    }
                }
            }
        }
    }
}

/// A point, any number of points and any kernel give the same bits.
#[test]
fn all_kernels_give_the_same_bits() {
    let mut random = Random::new(0xb175);
    // Up to 16 and 32 knots are held in registers; more are found through buckets.
    let knots: Vec<f64> = (0..40).map(|knot| f64::from(knot) + 0.7 * random.unit()).collect();
    let values: Vec<f64> = knots.iter().map(|_| random.positive(-5, 5)).collect();
    let table_of = |count: usize| {
        let cells: Vec<f64> = values.iter().zip(&knots).take(count).flat_map(|(&value, &knot)| [value, knot]).collect();
        PiecewiseTable::from_rows(&cells, 2, Tail::Constant).unwrap()
    };
    let long = [Approximation::slope(&table_of(40)).unwrap(), Approximation::single(&table_of(40)).unwrap()];
    for count in [2, 3, 5, 8, 16, 17, 32, 33] {
        let short = [Approximation::slope(&table_of(count)).unwrap(), Approximation::single(&table_of(count)).unwrap()];
        let xs: Vec<f64> = (0..1003)
            .map(|_| random.within(0.0, knots[count - 2]))
            .chain(knots[..count - 1].iter().flat_map(|&knot| [knot, knot.next_up(), knot.next_down()]))
            .collect();
        for (long, short) in long.iter().zip(&short) {
            let (mut a, mut b) = (vec![0.0; xs.len()], vec![0.0; xs.len()]);
            long.values(&[&xs], &mut a);
            short.values(&[&xs], &mut b);
            assert_eq!(a, b, "{} with {count} knots", short.form());
            let single_by_single: Vec<f64> = xs.iter().map(|&x| short.value(&[x])).collect();
            assert_eq!(b, single_by_single);
        }
    }
}

/// f32 columns give what their f64 copies give, rounded to f32; the jump at the end included.
#[test]
#[expect(clippy::cast_possible_truncation, reason = "rounding is what is tested")]
fn single_columns_are_the_same_numbers() {
    let mut random = Random::new(0xf32);
    for knots in [5_u16, 40] {
        for tail in [Tail::Constant, Tail::Zero] {
            let cells: Vec<f64> = (0..knots).flat_map(|knot| [random.positive(-5, 5), f64::from(knot) * 0.1]).collect();
            let table = PiecewiseTable::from_rows(&cells, 2, tail).unwrap();
            let last = f64::from(knots - 1) * 0.1;
            let mut xs: Vec<f32> = (0..1000).map(|_| random.within(-0.1, 1.2 * last) as f32).collect();
            xs.extend([last as f32, (last as f32).next_up(), (last as f32).next_down(), f32::NAN, f32::INFINITY]);
            let wide: Vec<f64> = xs.iter().copied().map(f64::from).collect();
            for made in all_forms(&table) {
                let mut singles = vec![0.0_f32; xs.len()];
                let mut values = vec![0.0; xs.len()];
                made.values_single(&[&xs], &mut singles);
                made.values(&[&wide], &mut values);
                for (row, (&single, &value)) in singles.iter().zip(&values).enumerate() {
                    assert_eq!(single.to_bits(), (value as f32).to_bits(), "{} at {}", made.form(), xs[row]);
                }
            }
        }
    }
}

/// With a drop to zero the side is decided before the coordinate is rounded to f32.
#[test]
fn the_drop_to_zero_is_where_the_table_has_it() {
    let last = 0.1;
    let table = PiecewiseTable::from_rows(&[20.0, 0.0, 10.0, last], 2, Tail::Zero).unwrap();
    for made in all_forms(&table) {
        assert_eq!(made.value(&[last]), 10.0, "{}", made.form());
        assert_eq!(made.value(&[last.next_up()]), 0.0, "{}", made.form());
        assert!(made.bound().absolute < 1e-4, "{}: {:?}", made.form(), made.bound());
    }
}
