//! Tables of extreme shape: at knots and beside them, two points and a million, segments one ulp wide, values across 600 decades.

use super::evaluators::{EVALUATORS, Ready};
use super::judge::{Ending, Random, table_value};
use super::judged::{Errors, judged};
use super::markdown::{count, table, ulps};
use inpact_evaluation::table::{PiecewiseTable, Tail};

const TEXT: &str = "\
## Tables of extreme shape

Each table has one axis; every query is judged by the exact value of its segment.
*At* is at the abscissae themselves, *beside* one ulp below and above them, *between* at random points of random segments.
";

/// Points (x, y) of a table of one axis, and its name.
struct Shape {
    name: &'static str,
    points: Vec<(f64, f64)>,
}

/// The number of knots of a table evaluated at and next to, and of segments between.
const ASKED: usize = 1_500;

/// The section of the page.
pub(super) fn section() -> String {
    let mut rows = Vec::new();
    for shape in shapes() {
        let cells: Vec<f64> = shape.points.iter().flat_map(|(x, y)| [*y, *x]).collect();
        let built = PiecewiseTable::from_rows(&cells, 2, Tail::Constant).expect("abscissae that ascend");
        let queries = queries(&shape.points);
        for evaluator in EVALUATORS {
            let mut row = vec![shape.name.to_owned(), count(shape.points.len()), evaluator.name.to_owned()];
            match (evaluator.of)(&built) {
                Ok(ready) => {
                    let errors = queries.each_ref().map(|queries| errors(&ready, queries, &shape.points));
                    row.push(count(queries.iter().map(Vec::len).sum()));
                    row.extend(errors.each_ref().map(|errors| ulps(errors.largest)));
                    row.push(count(errors.iter().map(|errors| errors.outside).sum()));
                }
                Err(reason) => row.extend(["—", "—", "—", "—", &format!("refused: {reason}")].map(str::to_owned)),
            }
            rows.push(row);
        }
    }
    let header = [
        "table",
        "points",
        "mode and kernel",
        "queries",
        "at knots, ulp",
        "one ulp beside, ulp",
        "between, ulp",
        "outside the bound",
    ];
    format!("{TEXT}\n{}", table(&header, rows))
}

fn shapes() -> Vec<Shape> {
    let mut random = Random::new(0x5a9e5);
    let two = vec![(0.0, 50.0), (0.1, 1.0 / 3.0)];
    let whole_range = vec![(f64::MIN, 0.0), (f64::MAX, f64::MAX)];
    let mut x = 0.0;
    let million = (0..1_000_000).map(|_| {
        x += random.unit() + 1e-3;
        (x, 1e3 * random.unit())
    });
    let million = million.collect();
    let one_ulp = std::iter::successors(Some(1.0_f64), |x| Some(x.next_up()));
    let one_ulp = one_ulp.take(64).map(|x| (x, 100.0 * random.unit())).collect();
    let cliff = vec![(0.0, 1e6), (1.0, 1e6 - 1.0), (1.0_f64.next_up(), 1e-6), (2.0, 3e-7)];
    let subnormal = (0..40).map(|step| (f64::from_bits(3 * step), random.positive(-1074, -1022))).collect();
    let decades = (-300..=300).map(|decade| (f64::from(decade), 10f64.powi(decade) * (1.0 + random.unit()))).collect();
    let both = (-300..=300)
        .map(|decade| (10f64.powi(decade), 10f64.powi(300 - (decade + 300)) * (1.0 + random.unit())))
        .collect();
    let alternating = (0..200).map(|step| (f64::from(step), if step % 2 == 0 { 1e-300 } else { 1e300 })).collect();
    vec![
        Shape { name: "two points", points: two },
        Shape { name: "two points, from −1.8e308 to 1.8e308", points: whole_range },
        Shape { name: "a million points", points: million },
        Shape { name: "segments one ulp wide", points: one_ulp },
        Shape { name: "a fall by 1e12 over one ulp", points: cliff },
        Shape { name: "subnormal abscissae and values", points: subnormal },
        Shape { name: "values across 600 decades", points: decades },
        Shape { name: "abscissae and values across 600 decades", points: both },
        Shape { name: "1e-300 and 1e300 in turn", points: alternating },
    ]
}

/// Queries at, next to and between the knots.
fn queries(points: &[(f64, f64)]) -> [Vec<f64>; 3] {
    let mut random = Random::new(0x9e51);
    let last = points.len() - 1;
    let knots: Vec<usize> =
        if last < ASKED { (0..=last).collect() } else { (0..ASKED).map(|_| random.below(last + 1)).collect() };
    let at: Vec<f64> = knots.iter().map(|knot| points[*knot].0).collect();
    let beside = at.iter().flat_map(|x| [x.next_down(), x.next_up()]).filter(|x| x.is_finite()).collect();
    let between = (0..ASKED).map(|_| {
        let left = random.below(last);
        random.within(points[left].0, points[left + 1].0)
    });
    let between = between.collect();
    [at, beside, between]
}

fn errors(ready: &Ready<'_>, queries: &[f64], points: &[(f64, f64)]) -> Errors {
    let mut errors = Errors::default();
    for x in queries {
        let above = points.partition_point(|(knot, _)| knot <= x);
        let left = above.saturating_sub(1).min(points.len() - 2);
        // The segment alone has the same values as the table, beyond whose ends it is constant, too.
        let segment: Vec<Vec<f64>> = points[left..left + 2].iter().map(|(x, y)| vec![*y, *x]).collect();
        let exact = table_value(&segment, &[*x], Ending::Constant);
        errors.add(judged((ready.value)(&[*x]), &exact, &ready.bound));
    }
    errors
}
