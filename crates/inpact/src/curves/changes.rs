//! Changes of the laws from one deck to another, row by row.

use super::rows::{LawRows, Rows};
use super::{LawKind, Side, number};
use inpact_parser::model::Model;

/// The maximum number of rows of one table that are listed.
const MAX_ROWS: usize = 4;

/// Changes, one line for each table that differs; empty where the laws are the same.
pub fn changes(old: &Model, new: &Model, kinds: &[LawKind]) -> Vec<String> {
    let mut lines = Vec::new();
    for interaction in new.interactions.values() {
        let Some(before) = old.interactions.get(&interaction.name) else {
            lines.push(format!("{} is new", interaction.name));
            continue;
        };
        for kind in LawKind::ALL.into_iter().filter(|kind| kinds.is_empty() || kinds.contains(kind)) {
            let (old_rows, new_rows) = (LawRows::of(old, before, kind), LawRows::of(new, interaction, kind));
            for side in Side::BOTH {
                let of = format!(
                    "{} of {} against {}",
                    kind.name(),
                    interaction.name,
                    match side {
                        Side::Open => "clearance",
                        Side::Closed => "pressure",
                    }
                );
                match (old_rows.side(side), new_rows.side(side)) {
                    (None, Some(_)) => lines.push(format!("{of} is new")),
                    (Some(_), None) => lines.push(format!("{of} is gone")),
                    (Some(old), Some(new)) => lines.extend(difference(old, new).map(|what| format!("{of}: {what}"))),
                    (None, None) => {}
                }
            }
        }
    }
    let gone = old.interactions.keys().filter(|name| !new.interactions.contains_key(name));
    lines.extend(gone.map(|name| format!("{name} is gone")));
    lines
}

/// The bitwise differences of two tables; `None` where there are none.
fn difference(old: &Rows<'_>, new: &Rows<'_>) -> Option<String> {
    if old.columns != new.columns {
        return Some(format!("columns {} instead of {}", new.columns.join(", "), old.columns.join(", ")));
    }
    if old.count() != new.count() {
        return Some(format!("{} rows instead of {}", new.count(), old.count()));
    }
    let same = |row: usize| old.row(row).iter().zip(new.row(row)).all(|(a, b)| a.to_bits() == b.to_bits());
    let changed: Vec<usize> = (0..new.count()).filter(|row| !same(*row)).collect();
    if changed.is_empty() {
        return None;
    }
    let named = changed.iter().take(MAX_ROWS).map(|row| {
        let cells = old.columns.iter().zip(old.row(*row).iter().zip(new.row(*row)));
        let cells = cells.filter(|(_, (a, b))| a.to_bits() != b.to_bits());
        let cells = cells.map(|(column, (a, b))| format!("{column} {} -> {}", number(*a), number(*b)));
        format!("row {}: {}", row + 1, cells.collect::<Vec<_>>().join(", "))
    });
    let named: Vec<String> = named.collect();
    let more =
        if MAX_ROWS < changed.len() { format!("; {} more rows", changed.len() - MAX_ROWS) } else { String::new() };
    Some(format!("{}{more}", named.join("; ")))
}
