//! Diagnostics as text: one plain function a format, over the one [`Diagnostic`].

mod concise;
mod excerpt;
mod full;
mod json;

use anstream::ColorChoice;
use clap::ValueEnum;
use inpact_parser::deck::Deck;
use inpact_validation::Diagnostic;

/// The output formats of diagnostics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// With an excerpt of the deck, labels and help.
    Full,
    /// A line each: `file:line:col: severity[CODE] message`.
    Concise,
    /// A JSON object a line.
    Json,
}

/// How the full format looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// With colours.
    Coloured,
    /// Without.
    Plain,
}

impl Style {
    /// Colours only for a terminal that can show them, and not where `NO_COLOR` is set.
    pub(crate) fn of_standard_output() -> Self {
        match anstream::AutoStream::choice(&std::io::stdout()) {
            ColorChoice::Never => Self::Plain,
            _ => Self::Coloured,
        }
    }
}

/// The findings of one deck as text.
pub(crate) fn diagnostics(diagnostics: &[Diagnostic], deck: &Deck, format: Format, style: Style) -> String {
    let write = match format {
        Format::Full => return diagnostics.iter().map(|found| full::write(found, deck, style)).collect(),
        Format::Concise => concise::write,
        Format::Json => json::write,
    };
    diagnostics.iter().map(|found| write(found, deck)).collect()
}
