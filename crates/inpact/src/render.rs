//! Diagnostics as text: one plain function per format, over the same [`Diagnostic`] for decks and data.

mod concise;
mod excerpt;
mod full;
mod github;
mod json;
mod sarif;
mod sources;

pub(crate) use self::sarif::Run as SarifRun;
pub(crate) use self::sources::Sources;

use crate::settings::Settings;
use anstream::ColorChoice;
use clap::ValueEnum;
use inpact_diagnostics::visible::visible_json;
use inpact_validation::Diagnostic;
use std::path::Path;

/// The output formats of diagnostics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// With an excerpt of the file, labels and help.
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

impl Format {
    /// Restricts reading to the repository where untrusted decks are checked.
    pub(crate) fn confine(self, settings: &mut Settings, path: &Path) {
        if matches!(self, Self::Github | Self::Sarif) {
            settings.confine_to_repository(path);
        }
    }

    /// Whether findings come with the lines around them.
    pub(crate) fn shows_lines(self) -> bool {
        matches!(self, Self::Full | Self::Sarif)
    }
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
        Self::of(anstream::AutoStream::choice(&std::io::stdout()))
    }

    /// The same for standard error.
    pub(crate) fn of_standard_error() -> Self {
        Self::of(anstream::AutoStream::choice(&std::io::stderr()))
    }

    fn of(choice: ColorChoice) -> Self {
        if choice == ColorChoice::Never { Self::Plain } else { Self::Coloured }
    }
}

/// Findings in one deck, or in data, as text; [`document`] combines the texts of several.
pub(crate) fn diagnostics(diagnostics: &[Diagnostic], sources: Sources<'_>, format: Format, style: Style) -> String {
    let lines = |write: fn(&Diagnostic, Sources<'_>) -> String| -> String {
        diagnostics.iter().map(|found| write(found, sources)).collect()
    };
    match format {
        // It escapes its input itself: its colours are escape sequences too.
        Format::Full => diagnostics.iter().map(|found| full::write(found, sources, style)).collect(),
        Format::Sarif => visible_json(&sarif::results(diagnostics, sources)).into_owned(),
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

/// A complete SARIF document of a run with data besides findings.
pub(crate) fn sarif_of_run(results: &[String], run: &SarifRun) -> String {
    let Document { head, separator, tail } = sarif::frame(run);
    visible_json(&(head + &results.join(separator) + &tail)).into_owned()
}

/// The frame of an output format.
#[derive(Debug, Default)]
pub(crate) struct Document {
    pub(crate) head: String,
    /// Between the texts of two decks that are not empty.
    pub(crate) separator: &'static str,
    pub(crate) tail: String,
}
