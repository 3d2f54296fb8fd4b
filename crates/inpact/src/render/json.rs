//! One JSON object per line, for other programs.

use super::Sources;
use inpact_validation::Diagnostic;
use serde::Serialize;

#[derive(Serialize)]
struct Record<'a> {
    code: &'a str,
    name: &'a str,
    severity: &'a str,
    file: &'a str,
    line: Option<u64>,
    column: Option<u64>,
    span: Option<[u64; 2]>,
    /// Row and column by its name, of findings in data.
    #[serde(flatten)]
    cell: Option<Cell<'a>>,
    message: &'a str,
    help: Option<&'a str>,
    /// Only for findings in included files.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    included_at: Vec<String>,
}

#[derive(Serialize)]
struct Cell<'a> {
    row: Option<u64>,
    field: Option<&'a str>,
}

pub(super) fn write(found: &Diagnostic, sources: Sources<'_>) -> String {
    let primary = &found.primary;
    let cell = match sources {
        Sources::Deck(_) => None,
        Sources::Data => Some(Cell {
            row: found.cell.as_ref().and_then(|cell| cell.row),
            field: found.cell.as_ref().and_then(|cell| cell.field.as_deref()),
        }),
    };
    let record = Record {
        code: found.code,
        name: found.name,
        severity: found.severity.name(),
        file: sources.file(primary),
        line: primary.line(),
        column: primary.column(),
        span: primary.bytes(),
        cell,
        message: &found.message,
        help: found.help.as_deref(),
        included_at: sources.include_chain(found),
    };
    // A record of strings and numbers has no reason to fail.
    serde_json::to_string(&record).unwrap_or_default() + "\n"
}
