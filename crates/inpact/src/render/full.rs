//! The full format: an excerpt of the file with labels, the reason and the help, drawn by miette.

use super::excerpt::Excerpt;
use super::sources::{Shown, place_of};
use super::{Sources, Style};
use inpact_diagnostics::visible::visible;
use inpact_validation::{Diagnostic, Label, Severity};
use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use std::fmt;

/// The number of lines shown before and after a label.
const CONTEXT: usize = 1;

pub(super) fn write(found: &Diagnostic, sources: Sources<'_>, style: Style) -> String {
    let theme = match style {
        Style::Coloured => GraphicalTheme::unicode(),
        Style::Plain => GraphicalTheme::unicode_nocolor(),
    };
    let handler =
        GraphicalReportHandler::new_themed(theme).with_links(false).with_width(100).with_context_lines(CONTEXT);
    let excerpt = Excerpt::around(sources, labels(found), CONTEXT);
    let mut text = String::new();
    // Only the writer could fail, which is a string.
    let _ = handler.render_report(&mut text, &Rendered { found, excerpt, sources });
    text.push('\n');
    text
}

/// The labels in the file of the primary one: an excerpt is of one file.
fn labels(found: &Diagnostic) -> impl Iterator<Item = &Label> {
    let source = found.primary.span.source();
    std::iter::once(&found.primary).chain(found.secondary.iter().filter(move |label| label.span.source() == source))
}

/// A finding in the terms of the renderer.
#[derive(Debug)]
struct Rendered<'a> {
    found: &'a Diagnostic,
    excerpt: Excerpt,
    sources: Sources<'a>,
}

impl Rendered<'_> {
    fn shown(&self) -> Shown {
        self.sources.shown(&self.found.primary)
    }

    /// The place of the finding, if the lines there are not shown.
    fn place(&self) -> Option<String> {
        let Label { text, .. } = &self.found.primary;
        let label = if text.is_empty() { String::new() } else { format!("{text} ") };
        let file = self.sources.file(&self.found.primary);
        let number =
            |name: &str, number: Option<u64>| number.map_or_else(String::new, |number| format!("{name}{number}"));
        let line = number(":", self.found.primary.line());
        let column = number(":", self.found.primary.column());
        match self.shown() {
            Shown::Yes => None,
            Shown::Withheld => Some(format!(
                "{label}at {file}{line}{column} (lines of files outside of the deck's folder are not shown: see `--include-root`)"
            )),
            Shown::No => {
                let cell = self.found.cell.as_ref();
                let row = number(", row ", cell.and_then(|cell| cell.row));
                let field = cell.and_then(|cell| cell.field.as_ref());
                let field = field.map_or_else(String::new, |field| format!(", column `{field}`"));
                Some(format!("{label}at {file}{line}{column}{row}{field}"))
            }
        }
    }
}

impl fmt::Display for Rendered<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&visible(&self.found.message))
    }
}

impl std::error::Error for Rendered<'_> {}

impl miette::Diagnostic for Rendered<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(format!("{}[{}] {}", self.found.severity, self.found.code, self.found.name)))
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.found.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
            Severity::Note => miette::Severity::Advice,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let source = self.found.primary.span.source();
        let elsewhere = self.found.secondary.iter().filter(|label| label.span.source() != source);
        let elsewhere = elsewhere.map(|label| {
            let file = self.sources.file(label);
            format!("see {file}:{}:{}: {}", label.position.line, label.position.column, label.text)
        });
        let note = self.found.note.iter().map(|note| format!("note: {note}"));
        let included = self.sources.include_chain(self.found).into_iter().map(|place| format!("included at {place}"));
        let help = self.found.help.iter().cloned();
        let place = self.place().into_iter();
        let parts: Vec<String> = place.chain(help).chain(note).chain(elsewhere).chain(included).collect();
        if parts.is_empty() { None } else { Some(Box::new(visible(&parts.join("\n")).into_owned())) }
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        match self.shown() {
            Shown::Yes => Some(&self.excerpt),
            Shown::Withheld | Shown::No => None,
        }
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let labels = labels(self.found).enumerate().map(|(index, label)| {
            let text = (!label.text.is_empty()).then(|| visible(&label.text).into_owned());
            let (start, end) = place_of(label);
            let offset = usize::try_from(start).unwrap_or(usize::MAX);
            let length = usize::try_from(end - start).unwrap_or(0);
            if index == 0 {
                LabeledSpan::new_primary_with_span(text, (offset, length))
            } else {
                LabeledSpan::new_with_span(text, (offset, length))
            }
        });
        Some(Box::new(labels))
    }
}
