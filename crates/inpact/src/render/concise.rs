//! A line a finding: `file:line:col: severity[CODE] message`.

use super::include_chain;
use inpact_diagnostics::visible::visible_line;
use inpact_parser::deck::Deck;
use inpact_validation::Diagnostic;

pub(super) fn write(found: &Diagnostic, deck: &Deck) -> String {
    let file = deck.source(found.primary.span.source).name();
    let place = found.primary.position;
    let included: String = include_chain(found, deck).iter().map(|place| format!(" (included at {place})")).collect();
    let (severity, code, message) = (found.severity, found.code, &found.message);
    let line = format!("{file}:{}:{}: {severity}[{code}] {message}{included}", place.line, place.column);
    visible_line(&line).into_owned() + "\n"
}
