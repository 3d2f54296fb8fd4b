//! A JSON object a line, for other programs.

use super::include_chain;
use inpact_parser::deck::Deck;
use inpact_validation::Diagnostic;
use serde::Serialize;

#[derive(Serialize)]
struct Record<'a> {
    code: &'a str,
    name: &'a str,
    severity: &'a str,
    file: &'a str,
    line: u64,
    column: u64,
    span: [u64; 2],
    message: &'a str,
    help: Option<&'a str>,
    /// Only for findings in included files.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    included_at: Vec<String>,
}

pub(super) fn write(found: &Diagnostic, deck: &Deck) -> String {
    let primary = &found.primary;
    let record = Record {
        code: found.code,
        name: found.name,
        severity: found.severity.name(),
        file: deck.source(primary.span.source).name(),
        line: primary.position.line,
        column: primary.position.column,
        span: [primary.span.start, primary.span.end],
        message: &found.message,
        help: found.help.as_deref(),
        included_at: include_chain(found, deck),
    };
    // A record of strings and numbers has no reason to fail.
    serde_json::to_string(&record).unwrap_or_default() + "\n"
}
