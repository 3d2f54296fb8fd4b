//! The matrix of extremes: each extreme number as each quantity of the electrical law, the result and the reason for it.

use super::judge::{Ending, Rows, exact, table_value, ulps_from};
use super::markdown::{number, table, ulps};
use super::run::Results;
use num_rational::BigRational;
use num_traits::Zero;

const TEXT: &str = "\
## Every extreme as every quantity

The law is σ against clearance d (0 to 2) and against pressure p (0 to 2), each at temperatures θ of 300 and 400 and a field variable of 1 and 3.
Where nothing else is said, d = 1 (0 for the rows of pressure), p = 0, θ = 350, the field variable is 2, the potentials are 2 and 0, the area is 0.5, the time step is 1, and so σ = 60.
Temperature and field variable are given for both sides; their mean is taken without overflow.
As *conductance in the table* the number is in the deck at d = 0 beside a 0 at d = 2, so that half of it comes out at d = 1.
ECDT is that of the second of two rows.
*Error* is the largest of the five outputs against the exact result of the same inputs, where that is in the range of f64.
5e-324 is the least subnormal number; 1e-308 is subnormal as well.
";

/// The extreme numbers.
const VALUES: [f64; 9] = [5e-324, 1e-308, 1.0, 1e308, 0.0, -0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];

/// Quantities of an extreme number.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Quantity {
    Clearance,
    Pressure,
    Temperature,
    FieldVariable,
    Potential,
    BothPotentials,
    Conductance,
    Area,
    TimeStep,
}

const QUANTITIES: [(Quantity, &str); 9] = [
    (Quantity::Clearance, "clearance"),
    (Quantity::Pressure, "pressure"),
    (Quantity::Temperature, "temperature"),
    (Quantity::FieldVariable, "field variable"),
    (Quantity::Potential, "potential of the slave side"),
    (Quantity::BothPotentials, "potential of both sides"),
    (Quantity::Conductance, "conductance in the table"),
    (Quantity::Area, "area"),
    (Quantity::TimeStep, "time step"),
];

const OUTPUTS: [&str; 5] = ["conductance", "ECD", "SJD", "ECDA", "ECDT"];

/// The section of the page.
pub(super) fn section() -> String {
    let mut text = TEXT.to_owned();
    for (quantity, name) in QUANTITIES {
        let rows = VALUES.map(|value| Case::new(quantity, value).row());
        let header = ["value", "σ", "ECD", "SJD", "ECDA", "ECDT", "status", "error, ulp", "why"];
        text += &format!("\n### {}{}\n\n{}", name[..1].to_uppercase(), &name[1..], table(&header, rows));
    }
    text
}

/// One extreme number as one quantity.
struct Case {
    quantity: Quantity,
    value: f64,
    clearance: f64,
    pressure: f64,
    temperature: f64,
    field_variable: f64,
    potentials: [f64; 2],
    area: f64,
    time_step: f64,
    /// Rows of the table in force, σ first.
    rows: Rows,
}

impl Case {
    fn new(quantity: Quantity, value: f64) -> Self {
        let mut case = Self {
            quantity,
            value,
            clearance: 1.0,
            pressure: 0.0,
            temperature: 350.0,
            field_variable: 2.0,
            potentials: [2.0, 0.0],
            area: 0.5,
            time_step: 1.0,
            rows: rows(30.0, 10.0),
        };
        match quantity {
            Quantity::Clearance => {
                case.clearance = value;
                if value <= 0.0 {
                    case.rows = rows(50.0, 70.0);
                }
            }
            Quantity::Pressure => {
                (case.clearance, case.pressure) = (0.0, value);
                case.rows = rows(50.0, 70.0);
            }
            Quantity::Temperature => case.temperature = value,
            Quantity::FieldVariable => case.field_variable = value,
            Quantity::Potential => case.potentials[0] = value,
            Quantity::BothPotentials => case.potentials = [value; 2],
            Quantity::Conductance => {
                case.rows = vec![vec![value, 0.0, 0.0, 0.0], vec![0.0, 2.0, 0.0, 0.0]];
            }
            Quantity::Area => case.area = value,
            Quantity::TimeStep => case.time_step = value,
        }
        case
    }

    fn deck(&self) -> String {
        let lines = |rows: &Rows| -> String {
            rows.iter().map(|row| format!("{:?}, {:?}, {:?}, {:?}\n", row[0], row[1], row[2], row[3])).collect()
        };
        let option = "*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=1";
        let interaction = "*SURFACE INTERACTION, NAME=JOINT\n1.,\n";
        if self.quantity == Quantity::Conductance {
            return format!("{interaction}{option}\n{}", lines(&self.rows));
        }
        let [open, closed] = [lines(&rows(30.0, 10.0)), lines(&rows(50.0, 70.0))];
        format!("{interaction}{option}\n{open}{option}, PRESSURE\n{closed}")
    }

    fn nodes(&self) -> String {
        let Self { clearance, pressure, temperature, field_variable, potentials, area, time_step, .. } = self;
        let [slave, master] = potentials;
        let mut text = "node,time,clearance,pressure,temp_s,temp_m,fv1_s,fv1_m,epot_s,epot_m,area\n".to_owned();
        for time in [0.0, *time_step] {
            text += &format!(
                "1,{time:?},{clearance:?},{pressure:?},{temperature:?},{temperature:?},\
                 {field_variable:?},{field_variable:?},{slave:?},{master:?},{area:?}\n"
            );
        }
        text
    }

    fn row(&self) -> Vec<String> {
        let value =
            if self.value == 0.0 && self.value.is_sign_positive() { "+0".to_owned() } else { number(self.value) };
        let results = match Results::of(&self.deck(), &self.nodes()) {
            Ok(results) => results,
            Err(mut codes) => {
                codes.dedup();
                let mut row = vec![value];
                row.extend(std::iter::repeat_n("—".to_owned(), OUTPUTS.len() + 2));
                row.push(format!("refused: {}", codes.join(", ")));
                return row;
            }
        };
        let outputs = OUTPUTS.map(|name| results.output(name).unwrap_or(f64::NAN));
        let exact = self.exact_outputs();
        let mut row = vec![value];
        row.extend(outputs.map(number));
        row.push(results.status.map_or("none", inpact_evaluation::results::Status::word).to_owned());
        let errors = exact.as_ref().map(|exact| {
            let pairs = outputs.iter().zip(exact).filter(|(_, exact)| !is_above_range(exact));
            pairs.map(|(output, exact)| if output.is_finite() { ulps_from(*output, exact) } else { f64::INFINITY })
        });
        row.push(errors.map_or("—".to_owned(), |errors| ulps(errors.fold(0.0, f64::max))));
        row.push(self.why(&results, &outputs, exact.as_ref()));
        row
    }

    /// The exact outputs of these inputs; `None` where one of them is infinite or NaN.
    fn exact_outputs(&self) -> Option<[BigRational; 5]> {
        if !self.value.is_finite() {
            return None;
        }
        let first = match self.quantity {
            Quantity::Pressure => self.pressure,
            Quantity::Clearance if self.value <= 0.0 => self.pressure,
            _ => self.clearance,
        };
        let conductance = table_value(&self.rows, &[first, self.temperature, self.field_variable], Ending::Constant);
        let jump = exact(self.potentials[0]) - exact(self.potentials[1]);
        let current = &conductance * &jump;
        let heat = &current * &jump;
        let of_area = &current * exact(self.area);
        let of_time = &current * exact(self.time_step);
        Some([conductance, current, heat, of_area, of_time])
    }

    /// The reason for the results.
    fn why(&self, results: &Results, outputs: &[f64; 5], exact: Option<&[BigRational; 5]>) -> String {
        let mut reasons = Vec::new();
        if matches!(self.quantity, Quantity::Clearance | Quantity::Pressure) {
            let (closed, open) = (results.tally.closed > 0, results.tally.open > 0);
            reasons.push(match (closed, open) {
                (true, _) => "closed: the table against pressure holds (T-22)".to_owned(),
                (_, true) => "open: the table against clearance holds (T-22)".to_owned(),
                _ => "contact is undetermined".to_owned(),
            });
        }
        let axes = results.tally.axes.iter().flatten();
        let (below, above) = axes.fold((0, 0), |sum, axis| (sum.0 + axis.below, sum.1 + axis.above));
        if below + above == 0
            && !outputs[0].is_nan()
            && let Some(column) = self.axis()
        {
            let is_knot = self.rows.iter().any(|row| row[column] == self.value);
            let at = if is_knot { "at an abscissa: its value" } else { "between two abscissae: linear (T-04)" };
            if self.value.is_finite() && (self.quantity != Quantity::Clearance || self.value > 0.0) {
                reasons.push(at.to_owned());
            }
        }
        if below > 0 {
            reasons.push("below the table: the first value holds (T-04)".to_owned());
        }
        if above > 0 {
            reasons.push("beyond the table: the last value holds (T-04, Q-1)".to_owned());
        }
        let named = |is: &dyn Fn(usize) -> bool| {
            let names: Vec<&str> =
                (0..OUTPUTS.len()).filter(|output| is(*output)).map(|output| OUTPUTS[output]).collect();
            (!names.is_empty()).then(|| names.join(", "))
        };
        if let Some(names) = named(&|output| outputs[output].is_infinite()) {
            reasons.push(match exact {
                Some(_) => format!("{names}: above the range of f64, and so infinite"),
                None => format!("{names}: infinite, as the {} is", self.name()),
            });
        }
        if let Some(names) = named(&|output| outputs[output].is_nan()) {
            reasons.push(match self.quantity {
                Quantity::BothPotentials => format!("{names}: the difference of the two is undetermined"),
                _ => format!("{names}: NaN, as the {} is", self.name()),
            });
        }
        if let Some(exact) = exact {
            let half_of_least = super::judge::exact(f64::from_bits(1)) / super::judge::exact(2.0);
            let vanishes = |output: usize| outputs[output] == 0.0 && !exact[output].is_zero();
            if let Some(names) = named(&|output| vanishes(output) && exact[output] <= half_of_least) {
                reasons.push(format!("{names}: not above half of the least f64, and so zero"));
            }
            if let Some(names) = named(&|output| vanishes(output) && exact[output] > half_of_least) {
                reasons.push(format!("{names}: zero, as the conductance was rounded to zero"));
            }
            if let Some(names) = named(&|output| outputs[output].is_subnormal()) {
                reasons.push(format!("{names}: subnormal, a multiple of 5e-324"));
            }
            if exact[0].is_zero() {
                reasons.push("no conductance, and so no current".to_owned());
            } else if exact[1].is_zero() {
                reasons.push("no jump of potential, and so no current".to_owned());
            } else if exact[3].is_zero() {
                reasons.push("no area, and so no current over it".to_owned());
            }
        }
        if reasons.is_empty() {
            reasons.push("within the range of f64".to_owned());
        }
        let warning = results.warnings.iter().find(|code| code.starts_with("D003"));
        reasons.extend(warning.map(|code| format!("warned of: {code}")));
        reasons.join("; ")
    }

    /// Its column in the rows, where it is a variable of the table.
    fn axis(&self) -> Option<usize> {
        match self.quantity {
            Quantity::Clearance | Quantity::Pressure => Some(1),
            Quantity::Temperature => Some(2),
            Quantity::FieldVariable => Some(3),
            _ => None,
        }
    }

    fn name(&self) -> &'static str {
        QUANTITIES.iter().find(|(quantity, _)| *quantity == self.quantity).map_or("", |(_, name)| name)
    }
}

/// A table of σ that goes from `first` to `last` along its first axis, twice that at the second temperature, three times at the second field variable.
fn rows(first: f64, last: f64) -> Rows {
    let mut rows = Rows::new();
    for (variable, factor) in [(1.0, 1.0), (3.0, 3.0)] {
        for (temperature, double) in [(300.0, 1.0), (400.0, 2.0)] {
            rows.push(vec![first * factor * double, 0.0, temperature, variable]);
            rows.push(vec![last * factor * double, 2.0, temperature, variable]);
        }
    }
    rows
}

/// Whether the nearest f64 to an exact number is infinite.
fn is_above_range(number: &BigRational) -> bool {
    let beyond = exact(f64::MAX) + (exact(f64::MAX) - exact(f64::MAX.next_down())) / exact(2.0);
    *number >= beyond || -number >= beyond
}
