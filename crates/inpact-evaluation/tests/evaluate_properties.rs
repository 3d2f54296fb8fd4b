//! Rows in are rows out, and results depend on the rows alone.

mod evaluate_support;

use evaluate_support::evaluate_with;
use inpact_evaluation::plan::{Choices, Derivatives};
use inpact_parser::model::Regime;
use proptest::prelude::*;
use std::collections::HashMap;

const DECK: &str = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECTRICAL CONDUCTANCE
20., 0., 20.
10., 0.1, 20.
40., 0., 100.
20., 0.1, 100.
*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.2
0.5, 0.
0.25, 10.
*SURFACE INTERACTION, NAME=B
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
50., 0.
66., 100.
";
const HEADER: &str = "node,interaction,time,clearance,pressure,temp_s,temp_m,epot_s,epot_m,epot_jump,por_s,por_m,area,\
                      char_length\n";

/// A cell: a number, now and then nothing or something that is not finite.
fn cell() -> impl Strategy<Value = String> {
    prop_oneof![
        8 => (-300..300_i32).prop_map(|number| (f64::from(number) / 100.0).to_string()),
        2 => Just("0".to_owned()),
        1 => Just(String::new()),
        1 => prop_oneof![Just("nan"), Just("inf"), Just("-inf"), Just("1e-310"), Just("1e300")].prop_map(str::to_owned),
    ]
}

/// Rows of three nodes and two interactions, whose times rise; areas and lengths are not negative.
fn rows() -> impl Strategy<Value = Vec<(String, String, Vec<String>)>> {
    let row = (0..3_u8, 0..2_u8, prop::collection::vec(cell(), 11));
    prop::collection::vec(row, 0..40).prop_map(|rows| {
        let mut times: HashMap<(u8, u8), u32> = HashMap::new();
        let row = |(node, interaction, mut cells): (u8, u8, Vec<String>)| {
            let time = times.entry((node, interaction)).or_default();
            *time += 1;
            for cell in &mut cells[9..] {
                *cell = cell.trim_start_matches('-').to_owned();
            }
            let key = format!("{node},{}", if interaction == 0 { "A" } else { "B" });
            (key, time.to_string(), cells)
        };
        rows.into_iter().map(row).collect()
    })
}

fn table(rows: &[(String, String, Vec<String>)]) -> String {
    let lines = rows.iter().map(|(key, time, cells)| format!("{key},{time},{}\n", cells.join(",")));
    HEADER.to_owned() + &lines.collect::<String>()
}

fn choices() -> Choices {
    Choices { regime: Some(Regime::Transient), derivatives: Derivatives::Given, ..Choices::default() }
}

proptest! {
    #[test]
    fn rows_in_are_rows_out_with_their_keys(rows in rows()) {
        let run = evaluate_with(DECK, &table(&rows), &choices(), 7);
        let lines: Vec<&str> = run.csv.lines().skip(1).collect();
        prop_assert_eq!(lines.len(), rows.len());
        for (line, (key, time, _)) in lines.iter().zip(&rows) {
            // Where nothing can be evaluated the keys are all there is.
            prop_assert!(format!("{line},").starts_with(&format!("{key},{time},")), "{} of {}", line, key);
        }
        prop_assert_eq!(run.tally.map(|tally| tally.rows), Some(rows.len() as u64));
    }

    #[test]
    fn the_size_of_a_batch_changes_no_bit(rows in rows(), size in 1..50_usize) {
        let nodes = table(&rows);
        let whole = evaluate_with(DECK, &nodes, &choices(), usize::MAX);
        let pieces = evaluate_with(DECK, &nodes, &choices(), size);
        prop_assert_eq!(whole.csv, pieces.csv);
        prop_assert_eq!(whole.findings, pieces.findings);
    }

    #[test]
    fn only_the_order_within_a_node_counts(rows in rows()) {
        let mut by_node = rows.clone();
        by_node.sort_by_key(|(key, ..)| key.clone());
        let lines_of = |rows: &[(String, String, Vec<String>)]| {
            let run = evaluate_with(DECK, &table(rows), &choices(), 5);
            let mut lines: Vec<String> = run.csv.lines().map(str::to_owned).collect();
            lines.sort();
            lines
        };
        prop_assert_eq!(lines_of(&rows), lines_of(&by_node));
    }

    #[test]
    fn any_text_is_read_without_panic(text in "[ -~\n\",]{0,200}") {
        let nodes = format!("node,clearance,temp\n{text}");
        let run = evaluate_with(DECK, &nodes, &choices(), 3);
        prop_assert!(run.plan.is_some() || !run.findings.is_empty());
    }
}
