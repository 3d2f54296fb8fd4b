//! A line a finding: `file:line:col: severity[CODE] message`.

use inpact_parser::deck::Deck;
use inpact_validation::Diagnostic;

pub(super) fn write(found: &Diagnostic, deck: &Deck) -> String {
    let file = deck.source(found.primary.span.source).name();
    let place = found.primary.position;
    format!("{file}:{}:{}: {}[{}] {}\n", place.line, place.column, found.severity, found.code, found.message)
}
