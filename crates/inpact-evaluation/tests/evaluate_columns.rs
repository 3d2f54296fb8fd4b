//! Laws in columns give the bits that they give row by row: a row with a number that no plain arithmetic takes has its neighbours evaluated row by row.

mod evaluate_support;

use evaluate_support::evaluate_with;
use inpact_evaluation::plan::{Choices, Derivatives};
use inpact_parser::grammar::Dialect;
use inpact_parser::model::Regime;
use proptest::prelude::*;

const DECK: &str = "\
*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67E-8
*SURFACE INTERACTION, NAME=A
*GAP CONDUCTANCE
20., 0., 0.
10., 0.1, 0.
40., 0., 100.
0., 0.2, 100.
*GAP CONDUCTANCE, PRESSURE
50., 0.
66., 100.
*GAP RADIATION
0.7, 0.9
1., 0.
0.5, 0.3
*GAP ELECTRICAL CONDUCTANCE
20., 0.
10., 0.1
*GAP HEAT GENERATION
0.8, 0.3
*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.25
0.5, 0.
0.25, 50.
*SURFACE INTERACTION, NAME=B
*GAP CONDUCTANCE, PRESSURE
1., 0., 0.
5., 10., 0.
2., 0., 50.
7., 20., 50.
*CONTACT PERMEABILITY
0., 0.
0.25, 10.
";

/// Columns that a table may do without.
const OPTIONAL: [&str; 10] = [
    "temp_jump",
    "por_jump",
    "shear",
    "slip_rate",
    "epot_s",
    "clearance_rate",
    "perm_s",
    "perm_m",
    "area",
    "char_length",
];
const REQUIRED: [&str; 7] = ["interaction", "clearance", "pressure", "temp_s", "temp_m", "por_s", "por_m"];

/// A number as it occurs, now and then nothing or one that is extreme.
fn cell() -> impl Strategy<Value = String> {
    prop_oneof![
        30 => (-300..300_i32).prop_map(|number| (f64::from(number) / 100.0).to_string()),
        4 => prop_oneof![Just("0"), Just("-0"), Just("1e-20"), Just("273.15"), Just("1e30")].prop_map(str::to_owned),
        1 => prop_oneof![Just(""), Just("nan"), Just("inf"), Just("1e-310"), Just("1e300")].prop_map(str::to_owned),
    ]
}

fn row() -> impl Strategy<Value = Vec<String>> {
    let cells = prop::collection::vec(cell(), REQUIRED.len() + OPTIONAL.len() - 1);
    (prop::bool::weighted(0.7), cells).prop_map(|(is_first, cells)| {
        let interaction = if is_first { "A" } else { "B" };
        let mut row: Vec<String> = std::iter::once(interaction.to_owned()).chain(cells).collect();
        // Permeabilities, areas and lengths are not negative.
        let count = row.len();
        row[count - 4..].iter_mut().for_each(|cell| *cell = cell.trim_start_matches('-').to_owned());
        row
    })
}

/// A row beside which none is evaluated by plain arithmetic.
fn extreme_row(interaction: &str) -> Vec<String> {
    let mut row = vec!["1e-200".to_owned(); REQUIRED.len() + OPTIONAL.len()];
    interaction.clone_into(&mut row[0]);
    row
}

/// A table of the columns that there are, with `epot_m` where there is `epot_s`.
fn table(rows: &[Vec<String>], there: &[bool]) -> String {
    let is_there = |column: usize| column < REQUIRED.len() || there[column - REQUIRED.len()];
    let line = |cells: Vec<&str>| {
        let cells = cells.into_iter().enumerate().filter(|(column, _)| is_there(*column));
        cells.map(|(_, cell)| cell).collect::<Vec<_>>().join(",") + "\n"
    };
    let header = line(REQUIRED.into_iter().chain(OPTIONAL).collect()).replace("epot_s", "epot_jump");
    header + &rows.iter().map(|row| line(row.iter().map(String::as_str).collect())).collect::<String>()
}

proptest! {
    #[test]
    fn columns_have_the_bits_of_rows(
        rows in prop::collection::vec(row(), 1..60),
        there in prop::collection::vec(prop::bool::weighted(0.8), OPTIONAL.len()),
        calculix in prop::bool::weighted(0.2),
        slopes in prop::bool::weighted(0.4),
        transient in prop::bool::weighted(0.4),
    ) {
        let choices = Choices {
            dialect: if calculix { Dialect::Calculix } else { Dialect::Abaqus },
            derivatives: if slopes { Derivatives::Given } else { Derivatives::LeftOut },
            regime: transient.then_some(Regime::Transient),
            ..Choices::default()
        };
        let with_extremes: Vec<Vec<String>> = rows.iter().cloned().chain(["A", "B"].map(extreme_row)).collect();
        let nodes = table(&with_extremes, &there);
        let evaluated = |rows_of_a_batch| {
            let run = evaluate_with(DECK, &nodes, &choices, rows_of_a_batch);
            (run.csv, run.findings)
        };
        // The extreme rows come in a batch of their own, in that of the others, and all rows alone.
        let in_columns = evaluated(rows.len());
        prop_assert_eq!(&evaluated(1024), &in_columns);
        prop_assert_eq!(evaluated(1), in_columns);
    }
}
