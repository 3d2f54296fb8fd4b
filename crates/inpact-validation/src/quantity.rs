//! Numbers and columns of tables in messages.

use inpact_parser::model::{Table, TableKind};
use std::borrow::Cow;

/// A number for a message: the shortest digits that round-trip, with an exponent where they would be mostly zeros.
pub(crate) fn number(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude == 0.0 || (1e-4..1e6).contains(&magnitude) { value.to_string() } else { format!("{value:e}") }
}

/// The name of a column of a table in a sentence.
pub(crate) fn column_name(column: &str) -> Cow<'_, str> {
    match column {
        "temp" => "temperature".into(),
        "pressure" => "contact pressure".into(),
        "pore_pressure" => "pore pressure".into(),
        "mass_flow" => "mass flow rate".into(),
        "view_factor" => "view factor".into(),
        _ => match column.strip_prefix("fv") {
            Some(index) => format!("field variable {index}").into(),
            None => column.into(),
        },
    }
}

/// The group of a row in its table, as the end of a sentence: ` at temperature 300, field variable 1 = 2`.
///
/// Outer variables that are 0 are left out: their columns are mostly empty.
pub(crate) fn group_label(table: &Table, row: &[f64]) -> String {
    let outer = table.columns.iter().zip(row).skip(2).filter(|(_, value)| **value != 0.0);
    let values: Vec<String> = outer
        .map(|(column, value)| {
            let equals = if column.starts_with("fv") { " =" } else { "" };
            format!("{}{equals} {}", column_name(column), number(*value))
        })
        .collect();
    if values.is_empty() { String::new() } else { format!(" at {}", values.join(", ")) }
}

/// The values of a row from a column on: `temperature = 300, field variable 1 = 2`.
pub(crate) fn values_of_row(table: &Table, row: usize, from: usize) -> String {
    let values = table.columns.iter().zip(table.row(row)).skip(from);
    let values = values.map(|(column, value)| format!("{} = {}", column_name(column), number(*value)));
    values.collect::<Vec<_>>().join(", ")
}

/// The name of the dependent value of a table.
pub(crate) fn value_name(kind: TableKind) -> &'static str {
    match kind {
        TableKind::ElectricalClearance | TableKind::ElectricalPressure => "electrical conductance",
        TableKind::ThermalClearance | TableKind::ThermalPressure => "thermal conductance",
        TableKind::Permeability => "permeability",
        TableKind::ViewFactor => "view factor",
        _ => "value",
    }
}

/// `1 row`, `2 rows`.
pub(crate) fn count(number: usize, singular: &str) -> String {
    if number == 1 { format!("1 {singular}") } else { format!("{number} {singular}s") }
}

/// Says that more of the same follows: `; 3 more rows of this table fall`; nothing for 0.
pub(crate) fn and_more(number: usize, singular: &str, plural: &str) -> String {
    match number {
        0 => String::new(),
        1 => format!("; 1 more {singular}"),
        _ => format!("; {number} more {plural}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases =
            [(0.0, "0"), (0.05, "0.05"), (-3500.25, "-3500.25"), (2e7, "2e7"), (1e-5, "1e-5"), (1e300, "1e300")];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn groups_are_named_by_what_is_not_zero() {
        let columns = ["conductance", "clearance", "temp", "fv1", "fv2"].map(str::to_owned).to_vec();
        let table = Table { columns: columns.into(), ..Table::default() };
        assert_eq!(group_label(&table, &[1.0, 0.0, 300.0, 0.0, 2.0]), " at temperature 300, field variable 2 = 2");
        assert_eq!(group_label(&table, &[1.0, 0.5, 0.0, 0.0, 0.0]), "");
    }
}
