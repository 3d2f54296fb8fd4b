//! A comparison for a person, for a spreadsheet and for a program.

use super::measure::{Comparison, Quantity};
use crate::text::{aligned, csv_text, number_text};
use serde_json::{Value, json};
use std::fmt::Write;

/// The comparison as text: one line per quantity, with its largest difference.
pub(super) fn text(comparison: &Comparison) -> String {
    let mut text = format!("{}, {} rows: ours beside the solver's\n\n", comparison.made_of, comparison.rows());
    let mut lines = vec![
        ["quantity", "unit", "rows", "largest difference", "of largest value", "ours", "solver's", "where"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for quantity in &comparison.quantities {
        let Some(largest) = quantity.largest() else { continue };
        let (name, time) = comparison.name(quantity, largest.row);
        let what = quantity.rows_of.word();
        let time = time.map_or_else(String::new, |time| format!(", time {}", number(Some(time))));
        let beyond = if comparison.is_quantity_beyond(quantity) { "  beyond the tolerance" } else { "" };
        lines.push(vec![
            quantity.name.clone(),
            quantity.dimension.to_owned(),
            quantity.compared().to_string(),
            short(largest.difference),
            short(largest.relative),
            number(quantity.ours[largest.row]),
            number(quantity.solvers[largest.row]),
            format!("{what} {name}{time}{beyond}"),
        ]);
    }
    text += &aligned(&lines, "", |column| matches!(column, 0 | 1 | 7));
    text.push_str("\nthe solver's values:\n");
    for quantity in comparison.quantities.iter().filter(|quantity| 0 < quantity.compared()) {
        let _ = writeln!(text, "  {}: {}", quantity.name, quantity.source);
    }
    let missing: Vec<String> = comparison
        .quantities
        .iter()
        .filter(|quantity| 0 < quantity.not_computed())
        .map(|quantity| format!("{} in {} rows", quantity.name, quantity.not_computed()))
        .collect();
    if !missing.is_empty() {
        let _ =
            writeln!(text, "\nsaid by the solver and not computed (`inpact plan` says why): {}", missing.join(", "));
    }
    text
}

/// One row per node or pair, state and quantity.
pub(super) fn table(comparison: &Comparison) -> String {
    let mut text = String::from("node,time,quantity,ours,solver,difference,relative_to_largest\n");
    for quantity in &comparison.quantities {
        let scale = quantity.solvers.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
        for row in 0..quantity.solvers.len() {
            let (ours, solvers) = (quantity.ours[row], quantity.solvers[row]);
            if solvers.is_none() {
                continue;
            }
            let (name, time) = comparison.name(quantity, row);
            let difference = ours.zip(solvers).map(|(ours, solvers)| ours - solvers);
            let relative = difference.map(|difference| if difference == 0.0 { 0.0 } else { difference.abs() / scale });
            let numbers = [ours, solvers, difference, relative].map(number).join(",");
            let _ = writeln!(text, "{},{},{},{numbers}", csv_text(name), number(time), quantity.name);
        }
    }
    text
}

/// The same as [`text`] as a document.
pub(super) fn json(comparison: &Comparison) -> String {
    let of = |quantity: &Quantity| -> Value {
        let what = quantity.rows_of.word();
        let largest = quantity.largest().map(|largest| {
            let (name, time) = comparison.name(quantity, largest.row);
            json!({
                "difference": largest.difference,
                "relative_to_largest": largest.relative,
                (what): name,
                "time": time,
                "ours": quantity.ours[largest.row],
                "solver": quantity.solvers[largest.row],
            })
        });
        json!({
            "name": quantity.name,
            "unit": quantity.dimension,
            "source": quantity.source,
            "rows": quantity.compared(),
            "not_computed": quantity.not_computed(),
            "largest": largest,
            "beyond_tolerance": comparison.is_quantity_beyond(quantity),
        })
    };
    let document = json!({
        "schema": "inpact/comparison/1",
        "rows_of": comparison.made_of,
        "rows": comparison.rows(),
        "tolerance": comparison.tolerance,
        "quantities": comparison.quantities.iter().map(of).collect::<Vec<_>>(),
    });
    format!("{document:#}\n")
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, number_text)
}

/// In two digits.
fn short(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") }
}
