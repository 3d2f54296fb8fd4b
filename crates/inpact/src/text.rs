//! Texts that several commands write alike: counts, numbers, names in quotes, tables.

use inpact_diagnostics::column_width;
use inpact_evaluation::results::push_number;
use std::fmt::Display;

/// `1 row`, `2 rows`.
pub(crate) fn counted(number: impl Display, what: &str) -> String {
    let number = number.to_string();
    let ending = if number == "1" { "" } else { "s" };
    format!("{number} {what}{ending}")
}

/// Names one after another: `` `a`, `b` ``.
pub(crate) fn in_backticks(names: impl IntoIterator<Item = impl Display>) -> String {
    names.into_iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The shortest text of a number that round-trips.
pub(crate) fn number_text(value: f64) -> String {
    let mut text = Vec::new();
    push_number(&mut text, value);
    String::from_utf8_lossy(&text).into_owned()
}

/// A number of arguments that must be above zero; `what` it is, with its article.
pub(crate) fn above_zero(text: &str, what: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if 0.0 < number && number.is_finite() => Ok(number),
        Ok(_) => Err(format!("{what} must be above zero and finite")),
        Err(_) => Err("not a number".to_owned()),
    }
}

/// A quoted text in TOML: as in JSON, which leaves one control character unescaped.
pub(crate) fn toml_text(text: &str) -> String {
    serde_json::Value::from(text).to_string().replace('\u{7f}', "\\u007F")
}

/// A text, quoted where it contains commas, quotes or line ends (RFC 4180).
pub(crate) fn csv_text(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// Rows of comma-separated values, the header first.
pub(crate) fn csv(rows: impl IntoIterator<Item = Vec<String>>) -> Vec<u8> {
    let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
    for row in rows {
        // Writing into memory cannot fail, nor can rows of any length.
        let _ = writer.write_record(row);
    }
    writer.into_inner().unwrap_or_default()
}

/// Columns as wide as their widest cell: texts left-aligned, numbers right-aligned.
pub(crate) fn aligned(rows: &[Vec<String>], indent: &str, is_text: impl Fn(usize) -> bool) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| column_width(rows.iter().map(|row| row[column].as_str()));
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).enumerate();
        let cells = cells.map(
            |(column, (cell, &width))| {
                if is_text(column) { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
            },
        );
        format!("{indent}{}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
    };
    rows.iter().map(line).collect()
}
