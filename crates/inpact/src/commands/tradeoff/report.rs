//! What was measured, as text, comma-separated values and JSON.

use super::measure::{Entry, Group, Measured};
use serde_json::{Value, json};

/// What the deck and the node table are called.
#[derive(Debug, Clone, Copy)]
pub(super) struct Names<'a> {
    pub(super) deck: &'a str,
    pub(super) nodes: &'a str,
}

/// A table for a person.
pub(super) fn text(measured: &Measured, names: Names<'_>) -> String {
    let mut text = format!("{} on {}: {}\n", names.deck, names.nodes, how(measured));
    text += "errors are differences from the value in 106 bits, as a part of the largest value of the table and in ulp; \
             * marks the Pareto front\n";
    for group in &measured.groups {
        text += &format!("\n{} ({})\n", group.name, size(group));
        text += &line(
            &["", "mode", "ns/row", "rows/s", "largest error", "rms", "largest ulp", "rms ulp", "bound", "bytes/row"]
                .map(str::to_owned),
        );
        for entry in &group.entries {
            text += &line(&[
                if entry.on_front { "*" } else { "" }.to_owned(),
                entry.mode.to_owned(),
                format!("{:.2}", entry.time),
                format!("{:.3e}", 1e9 / entry.time),
                error(entry.errors.largest),
                error(entry.errors.rms),
                ulps(entry.errors.largest_ulp),
                ulps(entry.errors.rms_ulp),
                error(entry.bound),
                format!("{:.0}", entry.bytes),
            ]);
        }
        let rate = format!("{:.3e}", 1e9 / group.copy);
        let empty = String::new;
        text += &line(&[
            empty(),
            "copy".to_owned(),
            format!("{:.2}", group.copy),
            rate,
            empty(),
            empty(),
            empty(),
            empty(),
            empty(),
            empty(),
        ]);
    }
    text
}

/// How it was measured.
pub(super) fn how(measured: &Measured) -> String {
    let rows = match measured.one_of {
        1 => count(measured.rows),
        one_of => format!("one of {one_of} of {}", count(measured.rows)),
    };
    format!("{rows}, least of {} interleaved rounds, one thread", measured.rounds)
}

fn count(rows: u64) -> String {
    format!("{rows} row{}", if rows == 1 { "" } else { "s" })
}

/// How large a table is, and how many rows reach it.
fn size(group: &Group) -> String {
    let rows = format!("{} points, reached by {}", group.table_rows, count(group.rows as u64));
    if group.rows_of_a_run == group.rows { rows } else { format!("{rows}, repeated to {}", group.rows_of_a_run) }
}

fn line(cells: &[String; 10]) -> String {
    const WIDTHS: [usize; 10] = [1, 12, 9, 11, 14, 9, 12, 9, 9, 10];
    let mut line = String::new();
    for (number, (cell, width)) in cells.iter().zip(WIDTHS).enumerate() {
        line += &if number < 2 { format!("{cell:<width$} ") } else { format!("{cell:>width$} ") };
    }
    format!("{}\n", line.trim_end())
}

/// An error as a part of a value, in two digits.
fn error(error: f64) -> String {
    if error == 0.0 { "0".to_owned() } else { format!("{error:.1e}") }
}

/// An error in ulp.
fn ulps(error: f64) -> String {
    match error {
        0.0 => "0".to_owned(),
        0.0..1e4 => format!("{error:.3}"),
        _ => format!("{error:.1e}"),
    }
}

/// A table for a spreadsheet; the copy has no errors.
pub(super) fn csv(measured: &Measured) -> String {
    let mut text = "table,mode,ns_per_row,rows_per_second,largest_error,rms_error,largest_ulp,rms_ulp,bound,\
                    bytes_per_row,pareto\n"
        .to_owned();
    for group in &measured.groups {
        let table = quoted(&group.name);
        for Entry { mode, time, errors, bound, bytes, on_front } in &group.entries {
            let numbers =
                [*time, 1e9 / time, errors.largest, errors.rms, errors.largest_ulp, errors.rms_ulp, *bound, *bytes];
            let numbers = numbers.map(|number| format!("{number:?}")).join(",");
            text += &format!("{table},{mode},{numbers},{}\n", u8::from(*on_front));
        }
        text += &format!("{table},copy,{:?},{:?},,,,,,,\n", group.copy, 1e9 / group.copy);
    }
    text
}

/// A text in quotes, where commas or quotes in it would be taken for the table's.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// For another program; a number that is not finite is null.
pub(super) fn json(measured: &Measured, names: Names<'_>) -> String {
    let groups = measured.groups.iter().map(|group| {
        let modes = group.entries.iter().map(|Entry { mode, time, errors, bound, bytes, on_front }| {
            json!({
                "mode": mode,
                "ns_per_row": time,
                "rows_per_second": 1e9 / time,
                "largest_error": errors.largest,
                "rms_error": errors.rms,
                "largest_ulp": errors.largest_ulp,
                "rms_ulp": errors.rms_ulp,
                "bound": bound,
                "bytes_per_row": bytes,
                "pareto": on_front,
            })
        });
        json!({
            "table": group.name,
            "points": group.table_rows,
            "rows": group.rows,
            "rows_of_a_run": group.rows_of_a_run,
            "copy_ns_per_row": group.copy,
            "modes": modes.collect::<Vec<Value>>(),
        })
    });
    let document = json!({
        "schema": "inpact/tradeoff/1",
        "deck": names.deck,
        "nodes": names.nodes,
        "rows": measured.rows,
        "one_of": measured.one_of,
        "rounds": measured.rounds,
        "tables": groups.collect::<Vec<Value>>(),
    });
    format!("{document:#}\n")
}
