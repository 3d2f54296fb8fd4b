//! The lines around findings, stored with them where the file is not kept: node tables, scenes and the tables of scenes.

use crate::diagnostic::{Diagnostic, Extent, Lines};
use std::collections::BTreeMap;
use std::io::{self, BufRead};
use std::sync::Arc;

/// Stores the lines around every finding in a text with it; findings with an unknown or missing line have none.
///
/// Lines end as in editors, with LF or CR LF: beyond a lone CR nothing is stored.
///
/// ```
/// use inpact_diagnostics::{Diagnostic, FixKind, Findings, Place, Rule, Severity, keep_lines};
///
/// static RULE: Rule = Rule {
///     code: "X001", name: "example", severity: Severity::Error, fix: FixKind::None, source: "", documentation: "",
/// };
/// let mut findings = Findings::new("n.csv");
/// findings.report(&RULE, Place::of_line(2), "expected a number, found `x`", "");
/// let mut found = findings.into_list();
/// keep_lines(&b"node,area\n1,x\n2,1\n3,1\n"[..], &mut found)?;
/// let lines = found[0].primary.lines.as_ref().expect("line 2 is there");
/// assert_eq!((lines.first, &lines.bytes[lines.line.clone()]), (1, &b"1,x"[..]));
/// assert_eq!(lines.bytes, b"node,area\n1,x\n2,1\n");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// When the text cannot be read.
pub fn keep_lines(mut text: impl BufRead, found: &mut [Diagnostic]) -> io::Result<()> {
    let mut wanted: BTreeMap<u64, Vec<&mut Diagnostic>> = BTreeMap::new();
    for found in found.iter_mut().filter(|found| found.primary.extent != Extent::File) {
        wanted.entry(found.primary.position.line).or_default().push(found);
    }
    let (mut number, mut start, mut before, mut line, mut after) = (0, 0_u64, Vec::new(), Vec::new(), Vec::new());
    text.read_until(b'\n', &mut after)?;
    while !wanted.is_empty() && !after.is_empty() {
        start += before.len() as u64;
        before = std::mem::take(&mut line);
        line = std::mem::take(&mut after);
        text.read_until(b'\n', &mut after)?;
        number += 1;
        let written = without_line_end(&line);
        if written.contains(&b'\r') {
            return Ok(());
        }
        let Some(wanted) = wanted.remove(&number) else { continue };
        let lines = Arc::new(Lines {
            start,
            first: if before.is_empty() { number } else { number - 1 },
            line: before.len()..before.len() + written.len(),
            bytes: [&before[..], &line, &after].concat(),
        });
        for found in wanted {
            found.primary.lines = Some(Arc::clone(&lines));
        }
    }
    Ok(())
}

fn without_line_end(line: &[u8]) -> &[u8] {
    let line = line.strip_suffix(b"\n").unwrap_or(line);
    line.strip_suffix(b"\r").unwrap_or(line)
}
