//! One line per finding: `file:line:col: severity[CODE] message`.

use super::Sources;
use inpact_diagnostics::visible::visible_line;
use inpact_validation::Diagnostic;

pub(super) fn write(found: &Diagnostic, sources: Sources<'_>) -> String {
    let line = match sources {
        Sources::Deck(_) => of_deck(found, sources),
        Sources::Data => of_data(found),
    };
    visible_line(&line).into_owned() + "\n"
}

fn of_deck(found: &Diagnostic, sources: Sources<'_>) -> String {
    let file = sources.file(&found.primary);
    let place = found.primary.position;
    let included: String = sources.include_chain(found).iter().map(|place| format!(" (included at {place})")).collect();
    let (severity, code, message) = (found.severity, found.code, &found.message);
    format!("{file}:{}:{}: {severity}[{code}] {message}{included}", place.line, place.column)
}

/// Cells are named in messages, so there is no column; the help is included, since there is no excerpt.
fn of_data(found: &Diagnostic) -> String {
    let Diagnostic { code, severity, message, primary, .. } = found;
    let file = &primary.file;
    let line = primary.line().map_or_else(String::new, |line| format!(":{line}"));
    let help = found.help.as_ref().map_or_else(String::new, |help| format!(" ({help})"));
    format!("{file}{line}: {severity}[{code}] {message}{help}")
}
