//! The measurements as text, comma-separated values and JSON.

use super::measure::{Entry, Group, Measured};
use crate::commands::tradeoff::cells::{by_reason, error, line, star};
use crate::text::{counted, csv_text};
use serde_json::{Value, json};

/// The names of the deck and the node table.
#[derive(Debug, Clone, Copy)]
pub(super) struct Names<'a> {
    pub(super) deck: &'a str,
    pub(super) nodes: &'a str,
}

/// A table for a person.
pub(super) fn text(measured: &Measured, names: Names<'_>) -> String {
    let mut text = format!("{} on {}: {}\n", names.deck, names.nodes, how(measured));
    text += "errors are differences from the value in 106 bits: of the largest value of the table, of the value itself, in ulp of it; \
             * marks the Pareto front\n";
    let whole = measured.whole;
    text += &format!(
        "a whole row of `eval` takes {:.0} ns, in which tables are one part of the laws: read {:.0}, laws {:.0}, write {:.0} (least of at most {}, with the accuracy that was asked for)\n",
        whole.total(),
        whole.read,
        whole.laws,
        whole.write,
        counted(measured.rounds, "round")
    );
    for group in &measured.groups {
        text += &format!("\n{} ({})\n", group.name, size(group));
        text += &line(&HEADER.map(str::to_owned), WIDTHS, TEXTS);
        for entry in &group.entries {
            let Entry { time, errors, bound, bytes, .. } = entry;
            let cells = [
                star(entry.on_front),
                entry.mode.to_owned(),
                entry.form.clone(),
                format!("{time:.2}"),
                format!("{:.3e}", 1e9 / time),
                error(errors.largest),
                error(bound.relative_to_largest),
                error(errors.rms),
                error(errors.pointwise),
                error(bound.pointwise),
                ulps(errors.largest_ulp),
                ulps(errors.rms_ulp),
                format!("{bytes:.0}"),
            ];
            text += &line(&cells, WIDTHS, TEXTS);
        }
        let mut cells = [const { String::new() }; 13];
        let copy = ["copy", "f64 columns"].map(str::to_owned);
        cells[1..3].clone_from_slice(&copy);
        cells[3..5].clone_from_slice(&[format!("{:.2}", group.copy), format!("{:.3e}", 1e9 / group.copy)]);
        text += &line(&cells, WIDTHS, TEXTS);
        for (modes, reason) in by_reason(&group.refused) {
            text += &format!("  refused: {}: {reason}\n", modes.join(", "));
        }
    }
    text
}

const HEADER: [&str; 13] = [
    "",
    "mode",
    "form",
    "ns/row",
    "rows/s",
    "of largest",
    "bound",
    "rms",
    "of value",
    "bound",
    "ulp",
    "rms ulp",
    "bytes/row",
];

/// The widths of the columns, of which the first are texts.
const WIDTHS: [usize; 13] = [1, 11, 13, 8, 9, 10, 8, 8, 8, 8, 8, 8, 9];
const TEXTS: usize = 3;

/// The conditions of the measurement.
pub(super) fn how(measured: &Measured) -> String {
    let rows = match measured.one_of {
        1 => counted(measured.rows, "row"),
        one_of => format!("one of {one_of} of {}", counted(measured.rows, "row")),
    };
    format!("{rows}, least of {} interleaved rounds, one thread", measured.rounds)
}

/// The size of a table, and the number of rows that reach it.
fn size(group: &Group) -> String {
    let rows = format!("{} points, reached by {}", group.table_rows, counted(group.rows, "row"));
    if group.rows_of_a_run == group.rows { rows } else { format!("{rows}, repeated to {}", group.rows_of_a_run) }
}

fn ulps(error: f64) -> String {
    match error {
        0.0 => "0".to_owned(),
        0.0..1e4 => format!("{error:.3}"),
        _ => format!("{error:.1e}"),
    }
}

/// A table for a spreadsheet; the copies have no errors, what is refused has nothing but its reason.
pub(super) fn csv(measured: &Measured) -> String {
    let mut text =
        "table,mode,form,ns_per_row,rows_per_second,largest_error,rms_error,pointwise_error,largest_ulp,rms_ulp,\
                    bound,pointwise_bound,bytes_per_row,pareto,refused\n"
            .to_owned();
    for group in &measured.groups {
        let table = csv_text(&group.name);
        for Entry { mode, form, time, errors, bound, bytes, on_front, .. } in &group.entries {
            let numbers = [
                *time,
                1e9 / time,
                errors.largest,
                errors.rms,
                errors.pointwise,
                errors.largest_ulp,
                errors.rms_ulp,
                bound.relative_to_largest,
                bound.pointwise,
                *bytes,
            ];
            let numbers = numbers.map(|number| format!("{number:?}")).join(",");
            text += &format!("{table},{mode},{form},{numbers},{},\n", u8::from(*on_front));
        }
        text += &format!("{table},copy,f64 columns,{:?},{:?},,,,,,,,,,\n", group.copy, 1e9 / group.copy);
        for (mode, reason) in &group.refused {
            text += &format!("{table},{mode},,,,,,,,,,,,,{}\n", csv_text(reason));
        }
    }
    text
}

/// For another program; a number that is not finite is null.
pub(super) fn json(measured: &Measured, names: Names<'_>) -> String {
    let groups = measured.groups.iter().map(|group| {
        let modes = group.entries.iter().map(|Entry { mode, form, time, errors, bound, bytes, on_front }| {
            json!({
                "mode": mode,
                "form": form,
                "ns_per_row": time,
                "rows_per_second": 1e9 / time,
                "largest_error": errors.largest,
                "rms_error": errors.rms,
                "pointwise_error": errors.pointwise,
                "largest_ulp": errors.largest_ulp,
                "rms_ulp": errors.rms_ulp,
                "bound": bound.relative_to_largest,
                "pointwise_bound": bound.pointwise,
                "bytes_per_row": bytes,
                "pareto": on_front,
            })
        });
        let refused = group.refused.iter().map(|(mode, reason)| json!({ "mode": mode, "reason": reason }));
        json!({
            "table": group.name,
            "points": group.table_rows,
            "rows": group.rows,
            "rows_of_a_run": group.rows_of_a_run,
            "copy_ns_per_row": group.copy,
            "modes": modes.collect::<Vec<Value>>(),
            "refused": refused.collect::<Vec<Value>>(),
        })
    });
    let document = json!({
        "schema": "inpact/tradeoff/1",
        "deck": names.deck,
        "nodes": names.nodes,
        "rows": measured.rows,
        "one_of": measured.one_of,
        "rounds": measured.rounds,
        "whole_row_ns": {
            "read": measured.whole.read,
            "laws": measured.whole.laws,
            "write": measured.whole.write,
        },
        "tables": groups.collect::<Vec<Value>>(),
    });
    format!("{document:#}\n")
}
