//! Locations of the cells of findings in a text table: column and bytes.
//!
//! The reader counts lines, not bytes; where there are findings, the table is read again up to the last of them.

use super::lines::{BYTE_ORDER_MARK, separator_of};
use inpact_diagnostics::span::{Position, Span};
use inpact_diagnostics::{Diagnostic, Extent};
use std::collections::BTreeMap;
use std::io::{self, BufRead};
use std::ops::Range;

/// Finds column and bytes of the cells that findings name by line and header.
///
/// A place that is not found is unchanged: a cell with a line end in it, a table whose lines end with a lone CR.
///
/// # Errors
/// When the table cannot be read.
pub fn locate(mut table: impl BufRead, found: &mut [Diagnostic]) -> io::Result<()> {
    let mut wanted: BTreeMap<u64, Vec<&mut Diagnostic>> = BTreeMap::new();
    for found in found.iter_mut().filter(|found| found.primary.extent == Extent::Line) {
        wanted.entry(found.primary.position.line).or_default().push(found);
    }
    let (mut line, mut text, mut offset, mut header) = (0, Vec::new(), 0, None);
    while !wanted.is_empty() {
        text.clear();
        let length = table.read_until(b'\n', &mut text)?;
        line += 1;
        let row = text.strip_suffix(b"\n").unwrap_or(&text);
        let row = row.strip_suffix(b"\r").unwrap_or(row);
        if length == 0 || row.contains(&b'\r') {
            return Ok(());
        }
        let mark = if line == 1 && row.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
        let row = &row[mark..];
        if header.is_none() && !row.trim_ascii().is_empty() {
            let separator = separator_of(row);
            let names = cells(row, separator).map(|cell| String::from_utf8_lossy(unquoted(&row[cell])).into_owned());
            header = Some((line, separator, names.collect::<Vec<_>>()));
        }
        for found in wanted.remove(&line).into_iter().flatten() {
            let (Some((header_line, separator, names)), Some(field)) =
                (&header, found.cell.as_ref().and_then(|cell| cell.field.as_ref()))
            else {
                continue;
            };
            // For a duplicate header the second one is meant.
            let index = if line == *header_line {
                names.iter().rposition(|name| name == field)
            } else {
                names.iter().position(|name| name == field)
            };
            let Some(cell) = index.and_then(|index| cells(row, *separator).nth(index)) else { continue };
            let before = row[..cell.start].iter().filter(|byte| **byte & 0xC0 != 0x80).count() as u64;
            let start = offset + (mark + cell.start) as u64;
            found.primary.position = Position { line, column: before + 1 };
            found.primary.span = Span::new(found.primary.span.source(), start, start + cell.len() as u64);
            found.primary.extent = Extent::Span;
        }
        offset += length as u64;
    }
    Ok(())
}

/// The cells of a row, without the blanks around them; none after a quote that is not closed on its line.
fn cells(row: &[u8], separator: u8) -> impl Iterator<Item = Range<usize>> {
    let mut next = Some(0);
    std::iter::from_fn(move || {
        let start = next?;
        let mut at = start;
        if row.get(at) == Some(&b'"') {
            at += 1;
            loop {
                match row[at..].iter().position(|byte| *byte == b'"') {
                    Some(length) => at += length + 1,
                    None => {
                        next = None;
                        return None;
                    }
                }
                if row.get(at) != Some(&b'"') {
                    break;
                }
                at += 1;
            }
        }
        let end = row[at..].iter().position(|byte| *byte == separator).map_or(row.len(), |length| at + length);
        next = (end < row.len()).then_some(end + 1);
        let blanks_before = row[start..end].len() - row[start..end].trim_ascii_start().len();
        let length = row[start..end].trim_ascii().len();
        Some(start + blanks_before..start + blanks_before + length)
    })
}

/// The text of a header cell, without quotes.
fn unquoted(cell: &[u8]) -> &[u8] {
    let inner = cell.strip_prefix(b"\"").and_then(|cell| cell.strip_suffix(b"\""));
    inner.unwrap_or(cell).trim_ascii()
}

#[cfg(test)]
mod tests {
    use super::super::NON_FINITE;
    use super::locate;
    use inpact_diagnostics::{Findings, Place};

    /// Line, column and text of the cell of a column in a line.
    fn cell(table: &str, line: u64, column: &str) -> Option<(u64, String)> {
        let mut findings = Findings::new("n.csv");
        let place = Place { column: Some(column.to_owned()), ..Place::of_line(line) };
        findings.report(&NON_FINITE, place, "", "");
        let mut found = findings.into_list();
        locate(table.as_bytes(), &mut found).expect("a slice can be read");
        let [start, end] = found[0].primary.bytes()?.map(|offset| usize::try_from(offset).expect("small"));
        Some((found[0].primary.column()?, table[start..end].to_owned()))
    }

    #[test]
    fn a_cell_is_found_by_its_line_and_its_header() {
        let some = |column: u64, text: &str| Some((column, text.to_owned()));
        assert_eq!(cell("node,area\n1,nan\n2, inf \n", 3, "area"), some(4, "inf"));
        assert_eq!(cell("\u{feff}node;area\r\n\"ü;x\";nan\r\n", 2, "area"), some(7, "nan"));
        assert_eq!(cell("\n\u{e4},area,AREA\n1,,2", 2, "AREA"), some(8, "AREA"));
        assert_eq!(cell("\u{feff}node,area\n", 1, "node"), some(1, "node"));
        assert_eq!(cell("node,area\n1,\n", 2, "area"), some(3, ""));
    }

    #[test]
    fn what_is_not_found_stays_as_it_is() {
        assert_eq!(cell("node,area\n1,nan\n", 2, "clearance"), None);
        assert_eq!(cell("node,area\n1,nan\n", 9, "area"), None);
        assert_eq!(cell("node,area\n\"a\nb\",nan\n", 2, "area"), None);
        assert_eq!(cell("node,area\r1,nan\r", 2, "area"), None);
    }
}
