//! Tables and numbers in Markdown.

use inpact_evaluation::results::push_number;

/// A table: its header, then its rows.
pub(super) fn table(header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = line(header.iter().copied());
    text += &line(header.iter().map(|_| "---"));
    for row in rows {
        text += &line(row.iter().map(String::as_str));
    }
    text
}

fn line<'a>(cells: impl Iterator<Item = &'a str>) -> String {
    let cells: Vec<&str> = cells.collect();
    format!("| {} |\n", cells.join(" | "))
}

/// A number as in results: the shortest form that reads back to the same f64.
pub(super) fn number(value: f64) -> String {
    let mut text = Vec::new();
    push_number(&mut text, value);
    String::from_utf8_lossy(&text).into_owned()
}

/// An error in ulp, to three decimals; 0 where there is none.
pub(super) fn ulps(error: f64) -> String {
    if error == 0.0 {
        "0".to_owned()
    } else if error < 1e4 {
        format!("{error:.3}")
    } else {
        format!("{error:.1e}")
    }
}

/// A count with digit groups: `10 000 000`.
pub(super) fn count(number: usize) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    let groups: Vec<_> = groups.map(String::from_utf8_lossy).collect();
    groups.join(" ")
}
