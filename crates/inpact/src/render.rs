//! Diagnostics as text: one plain function a format, over the one [`Diagnostic`].

mod concise;
mod excerpt;
mod full;
mod github;
mod json;
mod sarif;

pub(crate) use self::github::write as github;

use anstream::ColorChoice;
use clap::ValueEnum;
use inpact_diagnostics::visible::visible_json;
use inpact_parser::deck::Deck;
use inpact_validation::Diagnostic;

/// The output formats of diagnostics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[non_exhaustive]
pub enum Format {
    /// With an excerpt of the deck, labels and help.
    Full,
    /// A line each: `file:line:col: severity[CODE] message`.
    Concise,
    /// A JSON object a line.
    Json,
    /// SARIF 2.1.0, for code scanning.
    Sarif,
    /// Workflow commands of GitHub Actions.
    Github,
}

/// Styles of the full format.
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

/// The findings of one deck as text; [`document`] makes a whole of the texts of several.
pub(crate) fn diagnostics(diagnostics: &[Diagnostic], deck: &Deck, format: Format, style: Style) -> String {
    let lines = |write: fn(&Diagnostic, &Deck) -> String| -> String {
        diagnostics.iter().map(|found| write(found, deck)).collect()
    };
    match format {
        // It escapes what it is given: its colours are escape sequences too.
        Format::Full => diagnostics.iter().map(|found| full::write(found, deck, style)).collect(),
        Format::Sarif => visible_json(&sarif::results(diagnostics, deck)).into_owned(),
        Format::Json => visible_json(&lines(json::write)).into_owned(),
        Format::Concise => lines(concise::write),
        Format::Github => diagnostics.iter().map(github::write).collect(),
    }
}

/// The texts before, between and after those of the decks.
pub(crate) fn document(format: Format) -> Document {
    match format {
        Format::Sarif => sarif::document(),
        _ => Document::default(),
    }
}

/// The frame of an output format.
#[derive(Debug, Default)]
pub(crate) struct Document {
    pub(crate) head: String,
    /// Between the texts of two decks that are not empty.
    pub(crate) separator: &'static str,
    pub(crate) tail: String,
}

/// The chain of *INCLUDE of a finding, the nearest first: ` (included at deck.inp:3)`; empty for the deck itself.
fn include_chain(found: &Diagnostic, deck: &Deck) -> Vec<String> {
    let chain = deck.include_chain(found.primary.span.source);
    let places = deck.positions(&chain);
    let shown = chain.iter().zip(places);
    shown.map(|(span, place)| format!("{}:{}", deck.source(span.source).name(), place.line)).collect()
}
