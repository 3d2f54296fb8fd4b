//! Current and heat at the extremes: potentials that cancel, products whose intermediate results overflow or underflow, long histories.

use super::judge::{exact, ulps_from};
use super::markdown::{count, number, table, ulps};
use super::run::{Results, Scene};
use crate::random::Random;
use inpact_evaluation::law::{
    ConductanceTables, Dissipation, ElectricalHistory, ElectricalLaw, HeatGeneration, PotentialJump,
};
use inpact_evaluation::nodes::{Batch, Column, Part};
use inpact_evaluation::table::PiecewiseTable;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

/// The section of the page.
pub(super) fn section() -> String {
    [cancellation(), products(), histories()].join("\n")
}

const CANCELLATION: &str = "\
## Potentials that cancel

φ of the master side is 300, φ of the slave side 300 + Δφ rounded to f64, σ is 10.
Near 300 neighbouring f64 are 5.7e-14 apart, so that the stored potentials have lost digits of Δφ before anything is computed; their difference itself is exact.
With a column `epot_jump` Δφ comes as it is.
*Counted* is the number of such rows in the summary (|Δφ| < 1e-8 |φ|).
";

fn cancellation() -> String {
    const DECK: &str = "*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n10., 0.\n10., 1.\n";
    let jumps = [1.0, 1e-3, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12, 300.0_f64.next_up() - 300.0, 1e-14];
    let rows = jumps.map(|jump| {
        let potentials = format!("clearance,epot_s,epot_m\n0.5,{:?},300\n", 300.0 + jump);
        let with_jump = format!("clearance,epot_s,epot_m,epot_jump\n0.5,{:?},300,{jump:?}\n", 300.0 + jump);
        let wanted = exact(10.0) * exact(jump);
        let mut row = vec![number(jump)];
        for nodes in [potentials, with_jump] {
            let results = Results::of(DECK, &nodes).expect("a node table without errors");
            let current = results.output("ECD").expect("potentials are given");
            let error = ((exact(current) - &wanted) / &wanted).to_f64().unwrap_or(f64::NAN).abs();
            row.extend([number(current), relative(error), results.tally.lost_digits.to_string()]);
        }
        row
    });
    let header =
        ["Δφ", "ECD from potentials", "relative error", "counted", "ECD from `epot_jump`", "relative error", "counted"];
    format!("{CANCELLATION}\n{}", table(&header, rows))
}

/// A relative error in two digits.
fn relative(error: f64) -> String {
    if error == 0.0 { "0".to_owned() } else { format!("{error:.1e}") }
}

const PRODUCTS: &str = "\
## Products that leave the range of f64 on their way

ECD = σ Δφ, SJD = σ Δφ², ECDA and SJDA are these times the area, ECDT is ECD times the time step.
Whatever Δφ² or σ Δφ would be, ECD and SJD are finite where their exact values are.
ECDA, SJDA and ECDT are made from what ECD and SJD are before these are rounded: where ECD is infinite or zero in the results, its product with an area or a time step is still right.
*Error* is the largest of those outputs against the exact results, those above the range of f64 left out.
";

fn products() -> String {
    let cases = [
        [1e-300, 1e160, 1.0, 1.0],
        [1e300, 1e-160, 1.0, 1.0],
        [1e-300, 1e300, 1e-200, 1.0],
        [5e-324, 1e160, 1.0, 1.0],
        [1e-160, 1e-160, 1e20, 1e20],
        [1e200, 1e150, 1e-100, 1e-100],
        [1e-200, 1e-150, 1e100, 1e100],
        [1e308, 1e-308, 1e308, 1e308],
        [1e300, 1e-300, 5e-324, 5e-324],
    ];
    let rows = cases.map(|[conductance, jump, area, step]| {
        let deck = format!(
            "*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n{conductance:?}, 0.\n{conductance:?}, 1.\n"
        );
        let row = |time: f64| format!("1,{time:?},0.5,{jump:?},{area:?}\n");
        let nodes = format!("node,time,clearance,epot_jump,area\n{}{}", row(0.0), row(step));
        let results = Results::of(&deck, &nodes).expect("a node table without errors");
        let current = exact(conductance) * exact(jump);
        let heat = &current * exact(jump);
        let wanted = [current.clone(), heat.clone(), &current * exact(area), heat * exact(area), current * exact(step)];
        let outputs = ["ECD", "SJD", "ECDA", "SJDA", "ECDT"].map(|name| results.output(name).unwrap_or(f64::NAN));
        let largest = exact(f64::MAX);
        let error = |places: std::ops::Range<usize>| {
            let pairs = places.map(|place| (outputs[place], &wanted[place]));
            let in_range = pairs.filter(|(_, wanted)| **wanted <= largest);
            let errors = in_range.map(
                |(output, wanted)| {
                    if output.is_finite() { ulps_from(output, wanted) } else { f64::INFINITY }
                },
            );
            ulps(errors.fold(0.0, f64::max))
        };
        let mut row: Vec<String> = [conductance, jump, area, step].map(number).into();
        row.extend(outputs.map(number));
        row.extend([error(0..2), error(2..5)]);
        row
    });
    let header =
        ["σ", "Δφ", "area", "Δt", "ECD", "SJD", "ECDA", "SJDA", "ECDT", "error of ECD, SJD, ulp", "of the others, ulp"];
    format!("{PRODUCTS}\n{}", table(&header, rows))
}

const HISTORIES: &str = "\
## Long histories

One node, σ = 0.1, steps of 0.001 (times rounded to f64), Δφ random from 0 to 1 or from −0.5 to 0.5; the exact ECDT is that of the stored times and potentials.
Up to 100 000 steps are evaluated row by row; ten million go through the same law and the same history without a node table around them.
Where Δφ changes its sign, the sum cancels; what rounding took from ECD in each step is added up as well, as it would be large against what is left.
*A plain sum* adds the same terms σ Δφ Δt in f64 without compensation.
";

/// Steps of the histories.
const STEPS: [usize; 3] = [1_000, 100_000, 10_000_000];

fn histories() -> String {
    let mut rows = Vec::new();
    for (name, shift) in [("of one sign", 0.0), ("of either sign", 0.5)] {
        for steps in STEPS {
            let history = History::integrate(steps, shift);
            rows.push(vec![
                count(steps),
                name.to_owned(),
                number(history.computed),
                ulps(ulps_from(history.computed, &history.exact)),
                ulps(ulps_from(history.plain, &history.exact)),
            ]);
        }
    }
    let header = ["steps", "Δφ", "ECDT", "error, ulp", "error of a plain sum, ulp"];
    format!("{HISTORIES}\n{}", table(&header, rows))
}

/// The current through one node, integrated in three ways.
struct History {
    computed: f64,
    plain: f64,
    exact: BigRational,
}

impl History {
    /// Integrates this many steps with Δφ from −`shift` to 1 − `shift`.
    fn integrate(steps: usize, shift: f64) -> Self {
        let (mut plain, mut sum) = (0.0, BigInt::zero());
        let mut of_block = 0;
        let mut last_time = 0.0;
        let record = |row: usize, time: f64, jump: f64| {
            if row > 0 {
                plain += CONDUCTANCE * jump * (time - last_time);
                of_block += scaled(jump, 53) * (scaled(time, 62) - scaled(last_time, 62));
            }
            if row.is_multiple_of(ROWS_OF_A_BLOCK) || row == steps {
                sum += std::mem::take(&mut of_block);
            }
            last_time = time;
        };
        let rows = Rows { steps, shift, row: 0, random: Random::new(0x0e_cd70) };
        let computed = if steps <= MAX_ROWS_OF_A_TABLE { rows.evaluate(record) } else { rows.integrate(record) };
        let exact = exact(CONDUCTANCE) * BigRational::new(sum, BigInt::one() << (53 + 62));
        Self { computed, plain, exact }
    }
}

/// The conductance of the histories.
const CONDUCTANCE: f64 = 0.1;

/// Histories up to this number of steps are evaluated as rows of a node table.
const MAX_ROWS_OF_A_TABLE: usize = 100_000;

/// Rows of a batch; as many exact products of 105 bits have a sum below 2¹²⁷.
const ROWS_OF_A_BLOCK: usize = 4096;

/// The rows of a history: time and Δφ.
struct Rows {
    steps: usize,
    shift: f64,
    row: usize,
    random: Random,
}

impl Iterator for Rows {
    type Item = (usize, f64, f64);

    fn next(&mut self) -> Option<Self::Item> {
        let row = self.row;
        self.row += 1;
        (row <= self.steps).then(|| (row, row as f64 * 1e-3, self.random.unit() - self.shift))
    }
}

impl Rows {
    /// ECDT by the evaluation of a node table.
    fn evaluate(mut self, mut record: impl FnMut(usize, f64, f64)) -> f64 {
        let deck = "*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n0.1, 0.\n0.1, 1.\n";
        let scene = Scene::new(deck, "node,time,clearance,epot_jump\n1,0,0.5,1\n").expect("a scene without errors");
        let selection = scene.plan.selection.clone();
        let results = scene.evaluate_batches(|batch| {
            *batch = Batch::with_columns(selection.labels.len(), selection.numbers.len());
            for (row, time, jump) in self.by_ref().take(ROWS_OF_A_BLOCK) {
                for column in &mut batch.labels {
                    column.push(b"1");
                }
                for (column, values) in selection.numbers.iter().zip(&mut batch.numbers) {
                    values.push(match column {
                        Column::Time => Some(time),
                        Column::Potential(Part::Both) => Some(jump),
                        Column::Clearance => Some(0.5),
                        _ => None,
                    });
                }
                record(row, time, jump);
                batch.rows += 1;
            }
            batch.rows > 0
        });
        results.output("ECDT").unwrap_or(f64::NAN)
    }

    /// ECDT by law and history alone.
    fn integrate(self, mut record: impl FnMut(usize, f64, f64)) -> f64 {
        let law = ElectricalLaw {
            conductance: ConductanceTables::Clearance(PiecewiseTable::constant(CONDUCTANCE)),
            heat_generation: HeatGeneration { fraction: 1.0, slave_weight: 0.5 },
        };
        let mut history = ElectricalHistory::default();
        for (row, time, jump) in self {
            record(row, time, jump);
            let jump = PotentialJump(jump);
            let increment = history.begin(time, jump, CONDUCTANCE);
            let flow = law.flow(CONDUCTANCE, jump, Dissipation::Steady);
            let rest = CONDUCTANCE.mul_add(jump.0, -flow.current_density);
            history.finish(&increment, &flow, rest, None);
        }
        history.current()
    }
}

/// `value` as a multiple of 2^-`power`, which it is: jumps are random multiples of 2⁻⁵³, and times of 0.001 and more of 2⁻⁶².
#[expect(clippy::cast_possible_truncation, reason = "a whole number far below 2¹²⁷")]
fn scaled(value: f64, power: i32) -> i128 {
    (value * 2f64.powi(power)) as i128
}
