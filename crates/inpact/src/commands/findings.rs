//! Findings in decks and in data, notes and summaries, on standard error.

use crate::failure::{Failure, Outcome, say, say_as_it_is, say_json};
use crate::render::{self, Format, SarifRun, Sources, Style};
use crate::settings::Settings;
use crate::text::counted;
use clap::ValueEnum;
use inpact_diagnostics::Extent;
use inpact_evaluation::plan::concerning;
use inpact_parser::deck::Deck;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{Model, Name, Regime};
use inpact_validation::{Diagnostic, Severity};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The messages of a run on standard error, in the format that its user chose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Messages<'a> {
    format: Format,
    /// Contents of a document as a whole, until the run has ended.
    gathered: &'a Gathered,
}

/// Forms of a result that has one for a person and one for a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum PrintedAs {
    /// For a person.
    Text,
    /// For another program.
    Json,
}

impl PrintedAs {
    /// The format of findings beside it, unless another is chosen.
    pub(crate) fn of_findings(self) -> Format {
        match self {
            Self::Text => Format::Concise,
            Self::Json => Format::Json,
        }
    }
}

/// Results of a run, and what else it had to say, for a document as a whole.
#[derive(Debug)]
pub(crate) struct Gathered(Mutex<(Vec<String>, SarifRun)>);

/// Nothing is collected for formats that are printed immediately.
static NOTHING: Gathered = Gathered(Mutex::new((Vec::new(), SarifRun { notes: Vec::new(), failure: None })));

/// Runs work with messages; a format that is a single document is printed at the end, whatever the outcome.
pub(crate) fn with_messages(
    format: Format,
    work: impl FnOnce(Messages<'_>) -> Result<Outcome, Failure>,
) -> Result<Outcome, Failure> {
    if format != Format::Sarif {
        return work(Messages::at_once(format));
    }
    let gathered = Gathered(Mutex::default());
    let ended = work(Messages { format, gathered: &gathered });
    let (results, mut run) = gathered.0.into_inner().unwrap_or_else(PoisonError::into_inner);
    let ended = match ended {
        // It is in the document: a line below it would make that invalid.
        Err(failure) if !failure.is_closed_pipe() => {
            let text = failure.to_string();
            run.failure.get_or_insert(text);
            if matches!(failure, Failure::Data(_)) { Ok(Outcome::HasErrors) } else { Err(Failure::AlreadySaid) }
        }
        ended => ended,
    };
    say_json(render::sarif_of_run(&results, &run).trim_end());
    ended
}

impl Messages<'static> {
    /// A line each.
    pub(crate) const LINES: Self = Self::at_once(Format::Concise);

    /// Runs work without printing messages.
    pub(crate) fn unheard<T>(work: impl FnOnce(Messages<'_>) -> T) -> T {
        // They are collected, and not printed.
        work(Messages { format: Format::Sarif, gathered: &Gathered(Mutex::default()) })
    }

    /// In a format that is printed immediately.
    pub(crate) const fn at_once(format: Format) -> Self {
        Self { format, gathered: &NOTHING }
    }
}

impl Messages<'_> {
    /// Prints a message that is not a finding: readable lines, or a JSON object.
    pub(crate) fn tell(self, lines: impl FnOnce() -> Vec<String>, json: impl FnOnce() -> String) {
        match self.format {
            Format::Json => say_json(&json()),
            Format::Sarif => self.gathered().1.notes.extend(lines()),
            Format::Full | Format::Concise | Format::Github => lines().iter().for_each(|line| say(line)),
        }
    }

    /// Prints a line that programs do not need, in every format.
    pub(crate) fn line(self, line: &str) {
        match self.format {
            Format::Sarif => self.gathered().1.notes.push(line.to_owned()),
            _ => say(line),
        }
    }

    /// Prints a line in readable formats, and nothing in JSON.
    pub(crate) fn remark(self, line: impl FnOnce() -> String) {
        if self.format != Format::Json {
            self.line(&line());
        }
    }

    /// Reports findings of a node table or a scene with the configured severities; true if there are errors.
    pub(crate) fn data(mut self, found: Vec<Diagnostic>, settings: &Settings) -> bool {
        Reporter::data(&mut self, found, settings)
    }

    /// Reports findings of a deck other than those of the check with the configured severities; true if there are errors.
    pub(crate) fn of_deck(self, found: Vec<Diagnostic>, deck: &Deck, settings: &Settings) -> bool {
        let found = settings.apply(found);
        // A finding about the whole deck has no lines to show.
        for found in &found {
            let is_placed = found.primary.extent != Extent::File;
            self.say(std::slice::from_ref(found), if is_placed { Sources::Deck(deck) } else { Sources::Data });
        }
        has_errors(&found)
    }

    /// Reports the findings of the check in some interactions, without notes; true if there are errors.
    pub(crate) fn deck(
        mut self,
        found: &[Diagnostic],
        of: (&Deck, &Grammar, &Model),
        governing: Governing<'_>,
    ) -> bool {
        Reporter::deck(&mut self, found, of, governing)
    }

    fn say(self, found: &[Diagnostic], sources: Sources<'_>) {
        let style = Style::of_standard_error();
        let text = render::diagnostics(found, sources, self.format, style);
        match self.format {
            Format::Sarif if text.is_empty() => {}
            Format::Sarif => self.gathered().0.push(text),
            Format::Json => text.lines().for_each(say_json),
            Format::Concise | Format::Github => text.lines().for_each(say),
            // It has escaped its input, and its colours are escape sequences.
            Format::Full => say_as_it_is(&text),
        }
    }

    fn gathered(&self) -> MutexGuard<'_, (Vec<String>, SarifRun)> {
        self.gathered.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The interactions of a run, and its regime where the run overrides the procedures of the deck.
pub(crate) type Governing<'a> = (&'a [&'a Name], Option<Regime>);

/// Receiver of findings: a command prints them, the library collects them.
pub(crate) trait Reporter {
    /// Restricts reading to the repository where requested.
    fn confine(&self, settings: &mut Settings, path: &Path);

    /// Whether findings are given with the lines around them.
    fn shows_lines(&self) -> bool;

    /// Takes the canonical paths of files that are read, or would be if they existed.
    fn files(&mut self, _: &[PathBuf]) {}

    /// Takes findings with the configured severities.
    fn take(&mut self, found: &[Diagnostic], sources: Sources<'_>);

    /// Takes the findings of the check in a deck, of which only a part was shown.
    fn beside(&mut self, _found: &[Diagnostic], _shown: &[Diagnostic], _: &Deck) {}

    /// Takes several files that cannot be read; returns the failure of the command or call.
    fn failures(&mut self, failures: Vec<Failure>) -> Failure {
        as_one(failures)
    }

    /// Takes the findings of a node table or a scene; true if there are errors with the configured severities.
    fn data(&mut self, found: Vec<Diagnostic>, settings: &Settings) -> bool {
        let found = settings.apply(found);
        self.take(&found, Sources::Data);
        has_errors(&found)
    }

    /// Takes the findings of the check in some interactions, without notes; true if there are errors.
    fn deck(
        &mut self,
        found: &[Diagnostic],
        (deck, grammar, model): (&Deck, &Grammar, &Model),
        (names, chosen): Governing<'_>,
    ) -> bool {
        let shown = concerning(found, deck, grammar, model, names, chosen).into_iter();
        let shown: Vec<Diagnostic> = shown.filter(|found| found.severity != Severity::Note).cloned().collect();
        self.take(&shown, Sources::Deck(deck));
        self.beside(found, &shown, deck);
        has_errors(&shown)
    }
}

impl Reporter for Messages<'_> {
    fn confine(&self, settings: &mut Settings, path: &Path) {
        self.format.confine(settings, path);
    }

    fn shows_lines(&self) -> bool {
        self.format.shows_lines()
    }

    fn take(&mut self, found: &[Diagnostic], sources: Sources<'_>) {
        self.say(found, sources);
    }

    fn beside(&mut self, found: &[Diagnostic], shown: &[Diagnostic], _: &Deck) {
        if let Some(line) = errors_elsewhere(found, shown, "inpact check")
            && matches!(self.format, Format::Concise | Format::Full | Format::Sarif)
        {
            self.line(&line);
        }
    }

    fn failures(&mut self, failures: Vec<Failure>) -> Failure {
        for failure in &failures {
            self.line(&format!("error: {failure}"));
        }
        Failure::AlreadySaid
    }
}

/// Findings that are kept.
#[derive(Debug, Default)]
pub(crate) struct Collected(pub(crate) Vec<Diagnostic>);

impl Reporter for Collected {
    fn confine(&self, _: &mut Settings, _: &Path) {}

    fn shows_lines(&self) -> bool {
        false
    }

    fn take(&mut self, found: &[Diagnostic], _: Sources<'_>) {
        self.0.extend_from_slice(found);
    }
}

fn as_one(failures: Vec<Failure>) -> Failure {
    match <[Failure; 1]>::try_from(failures) {
        Ok([failure]) => failure,
        Err(failures) => Failure::Usage(failures.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")),
    }
}

/// A line on the errors of a deck that are not shown, if there are any, with the command that shows them.
pub(crate) fn errors_elsewhere(found: &[Diagnostic], shown: &[Diagnostic], command: &str) -> Option<String> {
    let errors = |found: &[Diagnostic]| found.iter().filter(|found| found.severity == Severity::Error).count();
    match errors(found) - errors(shown) {
        0 => None,
        count => Some(format!("{} elsewhere in the deck: see `{command}`", counted(count, "error"))),
    }
}

pub(crate) fn has_errors(found: &[Diagnostic]) -> bool {
    found.iter().any(|found| found.severity == Severity::Error)
}

/// Rejects a result where the configuration turns findings in its data into errors.
pub(crate) fn refuse_configured_errors(found: &[Diagnostic], settings: &Settings) -> Result<(), Failure> {
    if has_errors(&settings.apply(found.to_vec())) {
        let message = "the configuration makes an error of what was found, and no result is written";
        return Err(Failure::Data(message.to_owned()));
    }
    Ok(())
}
