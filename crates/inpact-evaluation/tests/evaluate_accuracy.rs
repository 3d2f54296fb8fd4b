//! The accuracy of whole evaluations: outputs against exact rationals, and outputs by name against all of them.

mod evaluate_support;
mod table_judge;

use evaluate_support::{evaluate, evaluate_with};
use inpact_evaluation::plan::Choices;
use inpact_evaluation::results::Output;
use inpact_evaluation::{Accuracy, Wanted};
use inpact_parser::model::Regime;
use num_rational::BigRational;
use table_judge::random_tables::{Range, random_rows};
use table_judge::{Ending, Random, Rows, exact, table_value, ulps_from};

/// A deck with one table of conductance against pressure and temperature.
fn deck_of(rows: &Rows) -> String {
    let mut deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n".to_owned();
    for row in rows {
        deck += &format!("{:e}, {:e}, {:e}\n", row[0], row[1], row[2]);
    }
    deck + "*GAP HEAT GENERATION\n0.75, 0.25\n"
}

struct Nodes {
    csv: String,
    /// Pressure, temperature and jump of each row.
    rows: Vec<[f64; 3]>,
}

fn random_nodes(random: &mut Random, count: usize) -> Nodes {
    let mut nodes = Nodes { csv: "closed,pressure,temp,epot_jump\n".to_owned(), rows: Vec::new() };
    for _ in 0..count {
        let row = [random.positive(-12, 12), random.positive(-12, 12), random.positive(-40, 40)];
        nodes.csv += &format!("1,{:e},{:e},{:e}\n", row[0], row[1], row[2]);
        nodes.rows.push(row);
    }
    nodes
}

/// The largest error of conductance, current density and heat in ulp, over random tables and rows.
fn largest_errors(accuracy: Accuracy) -> [f64; 3] {
    let mut random = Random::new(0xacc);
    let mut worst = [0.0_f64; 3];
    for _ in 0..60 {
        let rows = random_rows(&mut random, 2, Range::Ordinary);
        let nodes = random_nodes(&mut random, 40);
        let choices = Choices { accuracy: Wanted::Mode(accuracy), ..Choices::default() };
        let run = evaluate_with(&deck_of(&rows), &nodes.csv, &choices, 16);
        let columns = ["conductance", "ECD", "SJD"].map(|name| run.numbers(name));
        let eta = BigRational::new(3.into(), 4.into());
        for (index, [pressure, temperature, jump]) in nodes.rows.iter().enumerate() {
            let conductance = table_value(&rows, &[*pressure, *temperature], Ending::Constant);
            let current = &conductance * exact(*jump);
            let heat = &eta * &current * exact(*jump);
            for (place, right) in [conductance, current, heat].iter().enumerate() {
                worst[place] = worst[place].max(ulps_from(columns[place][index], right));
            }
        }
    }
    worst
}

#[test]
fn reference_rounds_every_output_once() {
    for error in largest_errors(Accuracy::Reference) {
        assert!(0.25 < error && error <= 0.501, "{error} ulp");
    }
}

#[test]
fn full_accuracy_stays_within_the_bounds_of_its_roundings() {
    // Two axes give 3 ulp at most; each product half an ulp more, and twice that where it crosses a power of two.
    let [conductance, current, heat] = largest_errors(Accuracy::Full);
    assert!(conductance <= 3.0, "{conductance} ulp");
    assert!(current <= 4.0, "{current} ulp");
    assert!(heat <= 6.0, "{heat} ulp");
}

/// An output requested by name has the same cells as among all outputs, folded tables or not.
#[test]
fn outputs_by_name_are_those_of_the_whole() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., .1\n\
                *GAP ELECTRICAL CONDUCTANCE, PRESSURE\n50., 0.\n65., 100.\n70., 250.\n\
                *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n1e-3, 0.\n3e-3, 100.\n\
                *STEP\n*COUPLED THERMAL-ELECTRICAL\n*END STEP\n*STEP\n*SOILS, CONSOLIDATION\n*END STEP\n";
    let mut nodes = "node,time,clearance,pressure,epot_s,epot_m,por_s,por_m,area\n".to_owned();
    let mut random = Random::new(0x0a5);
    for time in 0..12 {
        for node in 0..3 {
            let (d, p) = if random.below(2) == 0 { (0.2 * random.unit(), 0.0) } else { (0.0, 300.0 * random.unit()) };
            let [a, b, c] = [random.unit(), random.unit(), random.unit()];
            nodes += &format!("{node},{time},{d},{p},{a},0,{b},{c},0.5\n");
        }
    }
    let whole = evaluate(deck, &nodes);
    let names: Vec<String> = whole.header().split(',').skip(2).map(str::to_owned).collect();
    assert!(names.len() > 20, "{names:?}");
    for name in &names {
        let output = Output::named(name).expect("the name of an output");
        for companion in [None, Some(Output::Status), Some(Output::Ptl)] {
            let outputs = Some(std::iter::once(output).chain(companion).collect());
            let requested = evaluate_with(deck, &nodes, &Choices { outputs, ..Choices::default() }, 7);
            assert_eq!(requested.column(name), whole.column(name), "{name} with {companion:?}");
        }
    }
}

/// A flow out of the range of f64 has a part of a small area, and of a short time, within it.
#[test]
fn products_are_finite_where_the_exact_result_is() {
    let run = |conductance: &str, jump: &str, other: &str| {
        let deck = format!("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n{conductance}, 0.\n");
        let nodes =
            format!("node,time,closed,pressure,epot_jump,area\n1,0,1,1,{jump},{other}\n1,{other},1,1,{jump},{other}\n");
        evaluate_with(&deck, &nodes, &Choices { regime: Some(Regime::SteadyState), ..Choices::default() }, 8)
    };
    for (conductance, jump, other) in
        [("1e200", "1e150", "1e-100"), ("1e-200", "1e-150", "1e100"), ("1e-160", "1e-160", "1e20")]
    {
        let run = run(conductance, jump, other);
        let [sigma, jump, other] = [conductance, jump, other].map(|text| exact(text.parse().expect("a number")));
        let current = &sigma * &jump;
        let heat = &current * &jump;
        let products = [
            ("ECDA", &current * &other),
            ("ECDT", &current * &other),
            ("ECDTA", &current * &other * &other),
            ("SJDTA", &heat * &other * &other),
        ];
        for (name, right) in products {
            let error = ulps_from(run.numbers(name)[1], &right);
            assert!(error <= 0.501, "{name}: {error} ulp");
        }
    }
    assert_eq!(run("1e200", "1e150", "1e-100").numbers("ECD")[1], f64::INFINITY);
}

/// Currents of either sign that all but cancel leave what the exact products leave.
#[test]
fn a_cancelling_history_keeps_its_digits() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n0.1, 0.\n";
    let mut nodes = "node,time,closed,pressure,epot_jump\n".to_owned();
    let mut random = Random::new(0xca9c);
    let (mut sum, zero) = (exact(0.0), exact(0.0));
    for time in 0..2_000 {
        let jump = random.positive(-10, 10) * if time % 2 == 0 { 1.0 } else { -1.0 };
        nodes += &format!("1,{time},1,1,{jump:e}\n");
        if time > 0 {
            sum += exact(0.1) * exact(jump);
        }
    }
    assert_ne!(sum, zero);
    let found = evaluate(deck, &nodes).numbers("ECDT")[1_999];
    let error = ulps_from(found, &sum);
    assert!(error <= 0.501, "{error} ulp");
}

/// A temperature that is the same in every row is folded away; what is left is as exact as the whole, and says the same of what lies beyond the table.
#[test]
fn folded_scenes_are_as_exact_as_whole_ones() {
    let mut random = Random::new(0xf01d);
    let (mut folded, mut worst) = (0, 0.0_f64);
    for _ in 0..80 {
        let rows = random_rows(&mut random, 2, Range::Ordinary);
        let deck = deck_of(&rows);
        let temperature = random.within(rows[0][2] - 1.0, rows[rows.len() - 1][2] + 1.0);
        let pressures: Vec<f64> = (0..20).map(|_| random.positive(-12, 12)).collect();
        let nodes = |last: f64| {
            let mut nodes = "closed,pressure,temp,epot_jump\n".to_owned();
            for pressure in &pressures {
                nodes += &format!("1,{pressure:e},{temperature:e},1\n");
            }
            nodes + &format!("1,1,{last:e},1\n")
        };
        let run = evaluate(&deck, &nodes(temperature));
        // One other temperature, and the table is evaluated as it is.
        let whole = evaluate(&deck, &nodes(temperature + 1.0));
        let is_folded = |run: &evaluate_support::Run| {
            let plan = run.plan.as_ref().expect("a plan");
            plan.interactions[0].tables().any(|(_, table)| table.axes.iter().any(|axis| axis.fold.is_some()))
        };
        assert!(!is_folded(&whole));
        folded += usize::from(is_folded(&run));
        let found = run.numbers("conductance");
        for (index, pressure) in pressures.iter().enumerate() {
            let right = table_value(&rows, &[*pressure, temperature], Ending::Constant);
            worst = worst.max(ulps_from(found[index], &right));
            assert_eq!(run.column("status")[index], whole.column("status")[index]);
        }
    }
    assert!(folded > 40, "only {folded} of 80 tables were folded");
    assert!(worst <= 3.0, "{worst} ulp");
}
