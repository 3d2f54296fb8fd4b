//! Workflow commands of GitHub Actions: findings that show up beside the lines of a pull request.

use inpact_diagnostics::visible::visible;
use inpact_parser::deck::Deck;
use inpact_validation::{Diagnostic, Severity};

pub(super) fn write(found: &Diagnostic, deck: &Deck) -> String {
    let command = match found.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "notice",
    };
    let file = property(deck.source(found.primary.span.source).name());
    let place = found.primary.position;
    let title = property(&format!("{} {}", found.code, found.name));
    let help = found.help.iter().map(|help| format!("\n{help}"));
    let message = data(&std::iter::once(found.message.clone()).chain(help).collect::<String>());
    format!("::{command} file={file},line={},col={},title={title}::{message}\n", place.line, place.column)
}

/// The escapes of a message.
fn data(text: &str) -> String {
    visible(text).replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The escapes of a property, in which colons and commas mean something.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
