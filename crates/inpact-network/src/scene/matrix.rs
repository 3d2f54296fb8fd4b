//! Links as a Matrix Market file of conductances; the nodes of a link are the numbers of row and column, from 1.
//!
//! The file is `matrix coordinate real symmetric`. Its off-diagonal entries are conductances between the nodes of row and column, or all of them the negative of those,
//! as an assembled conductance matrix has them; the rows of such a matrix add up to zero.
//! Each pair of nodes has one entry, in either triangle: a file with both triangles would conduct twice what its matrix does.
//! Memory grows with the entries present, not with the size that the file declares.

use super::Field;
use super::rules::{MALFORMED_SCENE, UNUSABLE_NUMBER};
use super::usable::Refusal;
use inpact_evaluation::nodes::{Findings, MALFORMED_CELL, Place};
use std::collections::{HashMap, HashSet};

/// The fraction of its diagonal above which the sum of a row is not zero.
const ROW_SUM: f64 = 1e-9;

/// A rejection and its line.
type Wrong = (usize, Refusal);

/// Reads a Matrix Market file of conductances.
pub(super) fn matrix(
    bytes: &[u8],
    conducts: Option<Field>,
    findings: &mut Findings,
    take: &mut dyn FnMut([u32; 2], [f64; 3]),
) {
    let field = conducts.ok_or_else(|| {
        let help = "add conducts = \"electrical\", \"thermal\" or \"hydraulic\" to [[link_file]]";
        wrong(1, "a Matrix Market file does not say what it conducts", help)
    });
    match field.and_then(|field| Ok((field, read(bytes)?))) {
        Err((line, Refusal { rule, column, message, help })) => {
            findings.report(rule, Place { column, ..Place::of_line(line as u64) }, message, help);
        }
        Ok((field, Entries { sign, entries })) => {
            for (ends, value) in entries {
                let mut conductances = [0.0; 3];
                conductances[field.index()] = sign * value;
                take(ends, conductances);
            }
        }
    }
}

fn wrong(line: usize, message: impl Into<String>, help: impl Into<String>) -> Wrong {
    (line, Refusal::new(&MALFORMED_CELL, message.into(), help))
}

/// The off-diagonal entries, and their factor to conductances.
struct Entries {
    sign: f64,
    entries: Vec<([u32; 2], f64)>,
}

fn read(bytes: &[u8]) -> Result<Entries, Wrong> {
    let text = std::str::from_utf8(bytes).map_err(|_| wrong(1, "the file is not UTF-8", "save it as plain text"))?;
    let banner = text.lines().next().unwrap_or_default().trim().to_ascii_lowercase();
    let fields: Vec<&str> = banner.split_whitespace().collect();
    if !matches!(fields[..], ["%%matrixmarket", "matrix", "coordinate", "real" | "integer", "symmetric"]) {
        let help = "the first line must be `%%MatrixMarket matrix coordinate real symmetric`";
        return Err(wrong(1, "the file is no symmetric Matrix Market file of real numbers", help));
    }
    let mut lines = lines_of(text);
    let (size_line, size) =
        lines.next().ok_or_else(|| wrong(1, "the size of the matrix is missing", "write rows, columns and entries"))?;
    let (rows, count) = parse_size(size).map_err(|(message, help)| wrong(size_line, message, help))?;
    let (mut entries, mut diagonal) = (Vec::new(), Vec::new());
    let (mut first_positive, mut first_negative, mut first_diagonal) = (None, None, None);
    for (line, text) in lines {
        let (ends, value) = parse_entry(text, rows).map_err(|refusal| (line, refusal))?;
        if ends[0] == ends[1] {
            first_diagonal = first_diagonal.or((value != 0.0).then_some(line));
            diagonal.push((ends[0], value));
            continue;
        }
        let first = if value < 0.0 { &mut first_negative } else { &mut first_positive };
        *first = first.or((value != 0.0).then_some(line));
        entries.push((ends, value));
    }
    let found = entries.len() + diagonal.len();
    if found as u64 != count {
        let entries = if count == 1 { "1 entry".to_owned() } else { format!("{count} entries") };
        let help = "write the number of entries below, or see whether the file was cut off";
        return Err(wrong(size_line, format!("the size of the matrix says {entries}, and the file has {found}"), help));
    }
    check_pairs(text, &entries)?;
    match (first_positive, first_negative, first_diagonal) {
        (Some(positive), Some(negative), _) => {
            let message = format!("entries beside the diagonal have both signs, in lines {positive} and {negative}");
            let help = "give conductances, or an assembled matrix in which all of them are negative";
            Err(wrong(positive.max(negative), message, help))
        }
        (None, Some(_), _) => {
            check_sums(text, &entries, &diagonal)?;
            Ok(Entries { sign: -1.0, entries })
        }
        (_, None, Some(line)) => {
            let help = "leave the diagonal out, or give an assembled matrix, whose other entries are negative";
            Err(wrong(line, "a list of conductances has a diagonal", help))
        }
        _ => Ok(Entries { sign: 1.0, entries }),
    }
}

/// The non-comment lines, from the size on.
fn lines_of(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().zip(1..).skip(1).map(|(line, number)| (number, line.trim()));
    lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('%'))
}

/// Rows and entries.
fn parse_size(text: &str) -> Result<(u32, u64), (String, &'static str)> {
    let numbers: Option<Vec<u64>> = text.split_whitespace().map(|field| field.parse().ok()).collect();
    let help = "write rows, columns and entries, such as `4 4 5`";
    let Some(&[rows, columns, count]) = numbers.as_deref() else {
        return Err((format!("`{text}` is no size of a matrix, which is three whole numbers"), help));
    };
    if rows != columns {
        let message = format!("a matrix of {rows} rows and {columns} columns is not symmetric");
        return Err((message, "give as many columns as rows"));
    }
    let rows = u32::try_from(rows)
        .map_err(|_| (format!("a matrix of {rows} rows is too large"), "a scene has fewer than 4294967296 nodes"))?;
    Ok((rows, count))
}

/// Row and column, and the value.
fn parse_entry(text: &str, rows: u32) -> Result<([u32; 2], f64), Refusal> {
    let malformed = |message, help| Refusal::new(&MALFORMED_CELL, message, help);
    let no_entry = || malformed(format!("`{text}` is no entry of a matrix"), "write row, column and value".to_owned());
    let mut fields = text.split_whitespace();
    let mut next = || fields.next().ok_or_else(no_entry);
    let (row, column, value) = (next()?, next()?, next()?);
    if fields.next().is_some() {
        return Err(no_entry());
    }
    let mut ends = [0; 2];
    for ((end, written), what) in ends.iter_mut().zip([row, column]).zip(["row", "column"]) {
        let number: i64 = written.parse().map_err(|_| no_entry())?;
        *end = u32::try_from(number).ok().filter(|number| (1..=rows).contains(number)).ok_or_else(|| {
            let help = format!("rows and columns go from 1 to {rows}, as the size of the matrix says");
            malformed(format!("`{text}` is in {what} {number}, which the matrix has not"), help)
        })?;
    }
    let written = value;
    let value: f64 = written.parse().map_err(|_| no_entry())?;
    if !value.is_finite() {
        let help =
            "give finite numbers; what makes two nodes one is a [[link]] or a row of a table of links with `inf`";
        return Err(Refusal::new(&UNUSABLE_NUMBER, format!("the value of `{text}` is not finite"), help));
    }
    if let Some(lost) = super::usable::lost(value, written) {
        let message = format!("the value of `{text}` is {lost} the range of numbers");
        return Err(Refusal::new(&UNUSABLE_NUMBER, message, "give a finite number, in other units if need be"));
    }
    Ok((ends, value))
}

/// Rejects pairs of row and column with two entries, in one triangle or in both.
fn check_pairs(text: &str, entries: &[([u32; 2], f64)]) -> Result<(), Wrong> {
    let pair_of = |ends: [u32; 2]| [ends[0].max(ends[1]), ends[0].min(ends[1])];
    let mut pairs: Vec<[u32; 2]> = entries.iter().map(|(ends, _)| pair_of(*ends)).collect();
    pairs.sort_unstable();
    let twice: HashSet<[u32; 2]> = pairs.windows(2).filter(|of| of[0] == of[1]).map(|of| of[0]).collect();
    if twice.is_empty() {
        return Ok(());
    }
    // The second entry in the file of any of those pairs.
    let mut seen: HashMap<[u32; 2], usize> = HashMap::new();
    for (line, written) in lines_of(text).skip(1) {
        let mut ends = written.split_whitespace().map_while(|field| field.parse().ok());
        let (Some(row), Some(column)) = (ends.next(), ends.next()) else { continue };
        let pair = pair_of([row, column]);
        if !twice.contains(&pair) {
            continue;
        }
        if let Some(first) = seen.insert(pair, line) {
            let message = format!("`{written}` gives {} and {} a second entry, after line {first}", pair[0], pair[1]);
            let help = "a symmetric file has one triangle, and one entry for each pair: leave the other out, or add the two up";
            return Err((line, Refusal::new(&MALFORMED_SCENE, message, help)));
        }
    }
    Ok(())
}

/// Whether the rows of an assembled matrix add up to zero.
fn check_sums(text: &str, entries: &[([u32; 2], f64)], diagonal: &[(u32, f64)]) -> Result<(), Wrong> {
    // The sum of each row, and its diagonal entry.
    let mut rows: HashMap<u32, (f64, f64)> = HashMap::new();
    for &(row, value) in diagonal {
        let (sum, on_diagonal) = rows.entry(row).or_default();
        *sum += value;
        *on_diagonal += value;
    }
    for &(ends, value) in entries {
        for row in ends {
            rows.entry(row).or_default().0 += value;
        }
    }
    if diagonal.is_empty() {
        let help = "add the diagonal, whose rows then add up to zero, or give conductances without their sign";
        let line = lines_of(text).nth(1).map_or(1, |(line, _)| line);
        return Err(wrong(
            line,
            "entries below zero are those of an assembled matrix, and its diagonal is missing",
            help,
        ));
    }
    let is_off = |sum: f64, diagonal: f64| !sum.is_finite() || sum.abs() > ROW_SUM * diagonal.abs();
    let off = rows.iter().filter(|(_, (sum, diagonal))| is_off(*sum, *diagonal));
    let Some((&row, (sum, _))) = off.min_by_key(|(row, _)| **row) else { return Ok(()) };
    let names = |line: &str| line.split_whitespace().take(2).any(|field| field.parse() == Ok(row));
    let line = lines_of(text).skip(1).find(|(_, line)| names(line)).map_or(1, |(line, _)| line);
    let message = format!("row {row} adds up to {sum:?} and not to zero: it conducts to something outside the matrix");
    Err(wrong(line, message, "make what is outside a node, and give the conductances to it as links"))
}
