//! The shape of a table as text: `2 temperatures × 5 clearances`.

use crate::text::counted;
use inpact_parser::model::Table;
use std::collections::BTreeSet;

/// The number of values of each independent variable, the slowest first.
///
/// Constant variables are left out, except the first; a first variable with another number of values in
/// each group is given as a range.
pub(super) fn shape(table: &Table) -> String {
    let lengths: BTreeSet<usize> = table.groups().map(|group| group.len()).collect();
    let (Some(least), Some(most), Some(first)) = (lengths.first(), lengths.last(), table.columns.get(1)) else {
        return counted(table.row_count(), "row");
    };
    let number = if least == most { least.to_string() } else { format!("{least} to {most}") };
    let first = format!("{number} {}", if *most == 1 { words(first).0 } else { words(first).1 });
    let outer = (2..table.width()).rev().filter_map(|column| {
        let values: BTreeSet<u64> = table.row_values().map(|row| row[column].to_bits()).collect();
        let (one, many) = words(&table.columns[column]);
        (values.len() > 1).then(|| format!("{} {}", values.len(), if values.len() == 1 { one } else { many }))
    });
    outer.chain([first]).collect::<Vec<_>>().join(" × ")
}

/// The singular and plural of the values of a column.
fn words(column: &str) -> (String, String) {
    let one = match column {
        "temp" => "temperature".to_owned(),
        "mass_flow" => "mass flow".to_owned(),
        "por" => "pore pressure".to_owned(),
        other => match other.strip_prefix("fv").filter(|number| number.parse::<usize>().is_ok()) {
            Some(number) => return (format!("value of fv{number}"), format!("values of fv{number}")),
            None => other.replace('_', " "),
        },
    };
    let many = format!("{one}s");
    (one, many)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(columns: &[&str], values: &[f64], expected: &str) {
        let columns: Vec<String> = columns.iter().map(|column| (*column).to_owned()).collect();
        let table = Table { columns: columns.into(), values: values.into(), ..Table::default() };
        assert_eq!(shape(&table), expected);
    }

    #[test]
    fn shapes_in_words() {
        check(&["conductance", "clearance"], &[1., 0., 0., 1.], "2 clearances");
        check(&["conductance", "pressure"], &[1., 0.], "1 pressure");
        let columns = ["conductance", "clearance", "temp", "fv1"];
        let even = [1., 0., 20., 0., 2., 1., 20., 0., 1., 0., 90., 0., 2., 1., 90., 0.];
        check(&columns, &even, "2 temperatures × 2 clearances");
        let uneven = [1., 0., 20., 1., 2., 1., 20., 1., 1., 0., 90., 2.];
        check(&columns, &uneven, "2 values of fv1 × 2 temperatures × 1 to 2 clearances");
    }
}
