//! Findings in decks and in data, on standard error.

use crate::failure::{Failure, say, say_json};
use crate::render::{self, Format, Style};
use crate::settings::Settings;
use clap::ValueEnum;
use inpact_diagnostics::visible::visible_line;
use inpact_evaluation::plan::concerning;
use inpact_parser::deck::Deck;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{Model, Name, Regime};
use inpact_validation::{Diagnostic, Severity};
use serde::Serialize;
use std::path::Path;

/// Formats of findings on standard error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FindingFormat {
    /// A line each.
    Concise,
    /// A JSON object a line.
    Json,
    /// Workflow commands of GitHub Actions.
    Github,
}

impl FindingFormat {
    /// Reads nothing outside of the repository where decks of strangers are judged, as `check` does.
    pub(crate) fn confine(self, settings: &mut Settings, path: &Path) {
        if self == Self::Github {
            settings.confine_to_repository(path);
        }
    }
}

/// The interactions of a run, and its regime where the run says which and no procedure of the deck does.
pub(crate) type Governing<'a> = (&'a [&'a Name], Option<Regime>);

/// Receiver of findings: a command prints them, the library collects them.
pub(crate) trait Reporter {
    /// Reads nothing outside of the repository where that is wanted.
    fn confine(&self, settings: &mut Settings, path: &Path);

    /// Takes what is wrong with a node table or a scene; true if there are errors, as the configuration has it.
    fn data(&mut self, found: Vec<Diagnostic>, settings: &Settings) -> bool;

    /// Takes what the check found in some interactions; true if there are errors.
    fn deck(&mut self, found: &[Diagnostic], of: (&Deck, &Grammar, &Model), governing: Governing<'_>) -> bool;

    /// Takes several files that cannot be read; gives what the command or the call fails with.
    fn failures(&mut self, failures: Vec<Failure>) -> Failure;
}

impl Reporter for FindingFormat {
    fn confine(&self, settings: &mut Settings, path: &Path) {
        FindingFormat::confine(*self, settings, path);
    }

    fn data(&mut self, found: Vec<Diagnostic>, settings: &Settings) -> bool {
        say_data_findings(found, settings, *self)
    }

    fn deck(&mut self, found: &[Diagnostic], of: (&Deck, &Grammar, &Model), governing: Governing<'_>) -> bool {
        say_deck_findings(found, of, governing, *self)
    }

    fn failures(&mut self, failures: Vec<Failure>) -> Failure {
        for failure in &failures {
            say(&format!("error: {failure}"));
        }
        Failure::AlreadySaid
    }
}

/// Findings that are kept.
#[derive(Debug, Default)]
pub(crate) struct Collected(pub(crate) Vec<Diagnostic>);

impl Reporter for Collected {
    fn confine(&self, _: &mut Settings, _: &Path) {}

    fn data(&mut self, found: Vec<Diagnostic>, settings: &Settings) -> bool {
        let found = settings.apply(found);
        let has_errors = has_errors(&found);
        self.0.extend(found);
        has_errors
    }

    fn deck(&mut self, found: &[Diagnostic], of: (&Deck, &Grammar, &Model), governing: Governing<'_>) -> bool {
        let (deck, grammar, model) = of;
        let (names, chosen) = governing;
        let concerning = concerning(found, deck, grammar, model, names, chosen);
        let shown = concerning.into_iter().filter(|found| found.severity != Severity::Note);
        let before = self.0.len();
        self.0.extend(shown.cloned());
        has_errors(&self.0[before..])
    }

    fn failures(&mut self, failures: Vec<Failure>) -> Failure {
        match <[Failure; 1]>::try_from(failures) {
            Ok([failure]) => failure,
            Err(failures) => Failure::Usage(failures.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")),
        }
    }
}

/// Says what the check found in some interactions, notes left out; true if there are errors.
pub(crate) fn say_deck_findings(
    found: &[Diagnostic],
    (deck, grammar, model): (&Deck, &Grammar, &Model),
    (names, chosen): Governing<'_>,
    format: FindingFormat,
) -> bool {
    let concerning = concerning(found, deck, grammar, model, names, chosen);
    let shown = concerning.iter().filter(|found| found.severity != Severity::Note);
    let shown: Vec<Diagnostic> = shown.map(|found| (*found).clone()).collect();
    let format = match format {
        FindingFormat::Concise => Format::Concise,
        FindingFormat::Json => Format::Json,
        FindingFormat::Github => Format::Github,
    };
    let text = render::diagnostics(&shown, deck, format, Style::Plain);
    match format {
        Format::Json => text.lines().for_each(say_json),
        _ => text.lines().for_each(say),
    }
    let errors = |found: &[Diagnostic]| found.iter().filter(|found| found.severity == Severity::Error).count();
    let elsewhere = errors(found) - errors(&shown);
    if elsewhere > 0 && format == Format::Concise {
        let errors = if elsewhere == 1 { "1 error".to_owned() } else { format!("{elsewhere} errors") };
        say(&format!("{errors} elsewhere in the deck: see `inpact check`"));
    }
    errors(&shown) > 0
}

/// Says what is wrong with a node table or a scene, as the configuration has it; true if there are errors.
pub(crate) fn say_data_findings(found: Vec<Diagnostic>, settings: &Settings, format: FindingFormat) -> bool {
    let found = settings.apply(found);
    for found in &found {
        match format {
            FindingFormat::Concise => say(&visible_line(&concise(found))),
            FindingFormat::Json => say_json(&json(found)),
            FindingFormat::Github => say(render::github(found).trim_end()),
        }
    }
    has_errors(&found)
}

/// Whether one of the findings is an error.
fn has_errors(found: &[Diagnostic]) -> bool {
    found.iter().any(|found| found.severity == Severity::Error)
}

/// Refuses to keep a result where the configuration makes an error of what was found in its data.
pub(crate) fn refuse_configured_errors(found: &[Diagnostic], settings: &Settings) -> Result<(), Failure> {
    if has_errors(&settings.apply(found.to_vec())) {
        let message = "the configuration makes an error of what was found, and no result is written";
        return Err(Failure::Data(message.to_owned()));
    }
    Ok(())
}

/// `file:line: severity[CODE] message`, and what to do.
fn concise(found: &Diagnostic) -> String {
    let Diagnostic { code, severity, message, primary, .. } = found;
    let file = &primary.file;
    let line = primary.line().map_or_else(String::new, |line| format!(":{line}"));
    let help = found.help.as_ref().map_or_else(String::new, |help| format!(" ({help})"));
    format!("{file}{line}: {severity}[{code}] {message}{help}")
}

/// The fields of a finding in a deck; instead of a column and a span a row and the name of its cell's column.
fn json(found: &Diagnostic) -> String {
    #[derive(Serialize)]
    struct Record<'a> {
        code: &'a str,
        name: &'a str,
        severity: &'a str,
        file: &'a str,
        line: Option<u64>,
        column: Option<u64>,
        span: Option<[u64; 2]>,
        row: Option<u64>,
        field: Option<&'a str>,
        message: &'a str,
        help: Option<&'a str>,
    }
    let cell = found.cell.as_ref();
    let record = Record {
        code: found.code,
        name: found.name,
        severity: found.severity.name(),
        file: &found.primary.file,
        line: found.primary.line(),
        column: found.primary.column(),
        span: found.primary.bytes(),
        row: cell.and_then(|cell| cell.row),
        field: cell.and_then(|cell| cell.field.as_deref()),
        message: &found.message,
        help: found.help.as_deref(),
    };
    // A record of strings and numbers has no reason to fail.
    serde_json::to_string(&record).unwrap_or_default()
}
