//! Workflow commands of GitHub Actions: annotations on the lines of a pull request.

use inpact_diagnostics::visible::visible;
use inpact_validation::{Diagnostic, Severity};

pub(super) fn write(found: &Diagnostic) -> String {
    let command = match found.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "notice",
    };
    let file = property(&found.primary.file);
    let line = found.primary.line().map_or_else(String::new, |line| format!(",line={line}"));
    let column = found.primary.column().map_or_else(String::new, |column| format!(",col={column}"));
    let title = property(&format!("{} {}", found.code, found.name));
    let help = found.help.iter().map(|help| format!("\n{help}"));
    let message = data(&std::iter::once(found.message.clone()).chain(help).collect::<String>());
    format!("::{command} file={file}{line}{column},title={title}::{message}\n")
}

/// The escapes of a message.
fn data(text: &str) -> String {
    visible(text).replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The escapes of a property, in which colons and commas mean something.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
