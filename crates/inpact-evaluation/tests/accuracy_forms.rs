//! Grids: their errors are maximised, against the reference, and compared with their bounds.

mod table_judge;

use inpact_evaluation::ErrorKind;
use inpact_evaluation::numbers::Scaled;
use inpact_evaluation::table::{
    AxisSummary, ErrorBound, Grid, Method, PiecewiseTable, Refusal, Tail, choose, commensurate_cells,
};
use inpact_evaluation::{Tolerance, Wanted};
use table_judge::random_tables::{Range, compile, random_ending, random_point, random_rows};
use table_judge::{Ending, Random, Rows, cases, report};

/// The error of a grid at a point, absolute and as a part of the exact value.
fn error_at(table: &PiecewiseTable, made: &Grid, point: &[f64]) -> (f64, f64) {
    let exact = table.reference_at(point[0], &point[1..]).unwrap();
    let value = made.value(point);
    assert!(value.is_finite(), "{value} at {point:?}");
    let absolute = (Scaled::new(value) + -exact).to_f64().abs();
    let magnitude = exact.to_f64().abs().max(f64::MIN_POSITIVE);
    (absolute, if absolute == 0.0 { 0.0 } else { absolute / magnitude })
}

/// The largest errors found: at abscissae and beside them, at random points, and by climbing from the best of these.
fn maximise(random: &mut Random, rows: &Rows, table: &PiecewiseTable, made: &Grid) -> (f64, f64) {
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

fn check_form(what: &str, axes: usize, count: usize, greatest: f64, make: impl Fn(&PiecewiseTable) -> Option<Grid>) {
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

/// A grid that meets none but the outermost abscissae of most tables.
fn resampled(axes: usize) -> impl Fn(&PiecewiseTable) -> Option<Grid> {
    move |table| Grid::new(table, &vec![9; axes]).ok()
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
        let made = Grid::new(&table, &cells).unwrap();
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
    let made = Grid::new(&table, &cells).unwrap();
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

#[test]
fn nan_infinities_and_ends_are_those_of_the_full_mode() {
    let cells = [10.0, 0.0, 300.0, 2.0, 2.0, 300.0, 20.0, 0.0, 400.0, 10.0, 2.0, 400.0];
    for tail in [Tail::Constant, Tail::Zero] {
        let table = PiecewiseTable::from_rows(&cells, 3, tail).unwrap();
        let last = table.axes()[0].greatest;
        let made = Grid::new(&table, &[8, 4]).unwrap();
        for x in [f64::NEG_INFINITY, -1.0, 0.0, last, last.next_up(), 1e30, 1e300, f64::INFINITY, f64::NAN] {
            for y in [f64::NEG_INFINITY, 300.0, 400.0, f64::INFINITY, f64::NAN] {
                let (full, fast) = (table.value(&[x, y]), made.value(&[x, y]));
                let same = full == fast || (full.is_nan() && fast.is_nan());
                assert!(same, "{fast} for {full} at {x}, {y}");
            }
        }
    }
}

/// A point and any number of points give the same bits.
#[test]
fn a_grid_gives_the_same_bits_for_any_number_of_rows() {
    let mut random = Random::new(0xb175);
    for axes in 2..=4 {
        let (rows, table) = table_of(&mut random, axes);
        let Ok(made) = Grid::new(&table, &vec![5; axes]) else { continue };
        let points: Vec<Vec<f64>> = (0..259).map(|_| random_point(&mut random, &rows)).collect();
        let columns: Vec<Vec<f64>> = (0..axes).map(|axis| points.iter().map(|point| point[axis]).collect()).collect();
        let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let mut values = vec![0.0; points.len()];
        made.values(&columns, &mut values);
        for (point, value) in points.iter().zip(&values) {
            assert_eq!(made.value(point).to_bits(), value.to_bits(), "at {point:?} of {rows:?}");
        }
    }
}

/// What is chosen for a tolerance keeps it, on whatever table: the bound of the method that was chosen is above the largest error found.
#[test]
fn what_is_chosen_keeps_its_bound() {
    let mut random = Random::new(0xc4);
    let mut grids = 0;
    for round in 0..cases(60) {
        // Abscissae on multiples of a step, some of them left out in each group.
        let mut rows = Rows::new();
        for y in 0..4 {
            let mut xs: Vec<usize> = (0..7).filter(|_| random.below(3) > 0).collect();
            xs.extend([7, 8]);
            rows.extend(xs.iter().map(|&x| vec![random.positive(-3, 3), x as f64 * 0.5, 300.0 + 40.0 * f64::from(y)]));
        }
        let table = compile(&rows, [Ending::Constant, Ending::Zero][round % 2]);
        let tolerance = random.positive(-48, -4);
        let choice = choose(&table, Wanted::Within(Tolerance::RelativeToLargest(tolerance)));
        let bound = choice.chosen.bound.unwrap();
        assert!(bound.relative_to_largest <= tolerance, "{:?} for {tolerance:e}", choice.chosen);
        if let Method::Grid { cells } = &choice.chosen.method {
            let made = Grid::new(&table, cells).unwrap();
            let (absolute, relative) = maximise(&mut random, &rows, &table, &made);
            assert!(absolute <= bound.absolute && relative <= bound.pointwise, "{absolute:e}, {relative:e}: {bound:?}");
            grids += 1;
        }
    }
    assert!(grids > 5, "only {grids} tables were resampled");
}

#[test]
fn what_no_grid_can_hold_is_refused_with_the_reason() {
    let refusal = |cells: &[f64], width: usize| {
        let table = PiecewiseTable::from_rows(cells, width, Tail::Constant).unwrap();
        let error = Grid::new(&table, &vec![4; width - 1]).map(|made| made.bound()).unwrap_err();
        let ErrorKind::Grid(refusal) = *error.kind() else { panic!("{error}") };
        refusal
    };
    assert_eq!(refusal(&[5.0], 1), Refusal::Constant);
    assert_eq!(refusal(&[5.0, 0.0, 6.0, 1.0], 2), Refusal::OneAxis);
    let with = |value: f64, x: f64| [1.0, 0.0, 0.0, value, x, 0.0, 1.0, 0.0, 1.0, 2.0, 1.0, 1.0];
    assert_eq!(refusal(&with(f64::MAX, 1.0), 3), Refusal::TooLarge(f64::MAX));
    assert!(matches!(refusal(&with(2.0, f64::MAX), 3), Refusal::Slope(_)));
}

#[test]
fn a_grid_beyond_a_limit_is_refused_with_both_numbers() {
    let refusal = |cells: &[f64], along: &[usize]| {
        let table = PiecewiseTable::from_rows(cells, along.len() + 1, Tail::Constant).unwrap();
        Grid::new(&table, along).map(|made| made.bound()).unwrap_err().to_string()
    };
    // A corner of a cube in five dimensions a row, the first axis fastest.
    let corner = |number: u32| (0..5).map(move |axis| f64::from(number >> axis & 1));
    let cube: Vec<f64> = (0..32).flat_map(|number| std::iter::once(f64::from(number)).chain(corner(number))).collect();
    assert_eq!(refusal(&cube, &[1; 5]), "the value depends on 5 axes, more than 4");
    let square = [1.0, 0.0, 0.0, 2.0, 1.0, 0.0, 1.0, 0.0, 1.0, 3.0, 1.0, 1.0];
    let most = "a grid of 32942 nodes would not stay in cache, as 32768 do";
    assert_eq!(refusal(&square, &[180, 181]), most);
    // No two groups have an abscissa in common, so that the table refined has all of them everywhere.
    let group = |number: u32| (0..600).map(move |row| f64::from(row) + f64::from(number) / 1024.0);
    let row = |number: u32| group(number).flat_map(move |x| [x * f64::from(number + 1), x, f64::from(number)]);
    let ragged: Vec<f64> = (0..1000).flat_map(row).collect();
    let message = refusal(&ragged, &[4, 4]);
    assert!(message.starts_with("its error would have to be computed at "), "{message}");
    assert!(message.ends_with(" vertices, more than 1048576"), "{message}");
}
