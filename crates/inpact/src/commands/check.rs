//! `inpact check`: decks in, diagnostics out.

use crate::failure::{Failure, Outcome, say};
use crate::files;
use crate::input::DeckArguments;
use crate::render::{self, Format};
use clap::Args;
use inpact_parser::deck::Keep;
use inpact_parser::model;
use inpact_validation::{Diagnostic, Severity, check};
use std::io::Write;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Decks or fragments; `-` reads standard input.
    #[arg(required = true, value_name = "DECK")]
    decks: Vec<PathBuf>,
    #[command(flatten)]
    deck: DeckArguments,
    /// How to print what was found.
    #[arg(long, value_enum, default_value_t = Format::Full)]
    format: Format,
    /// Where to write what was found, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// How many findings of each severity there were.
#[derive(Debug, Default, Clone, Copy)]
struct Tally {
    errors: usize,
    warnings: usize,
    notes: usize,
}

pub(crate) fn run(arguments: &CheckArguments) -> Result<Outcome, Failure> {
    let grammar = arguments.deck.grammar();
    let mut output = files::ResultFile::create(arguments.output.as_deref())?;
    let style = if arguments.output.is_some() { render::Style::Plain } else { render::Style::of_standard_output() };
    let mut tally = Tally::default();
    let mut unreadable = false;
    for path in &arguments.decks {
        let deck = match arguments.deck.read(path, Keep::Interpreted) {
            Ok(deck) => deck,
            // The other decks are still checked.
            Err(failure) => {
                say(&format!("error: {failure}"));
                unreadable = true;
                continue;
            }
        };
        let (model, problems) = model::read(&deck, grammar);
        let diagnostics = check(&deck, grammar, &model, &problems);
        tally.add(&diagnostics);
        let text = render::diagnostics(&diagnostics, &deck, arguments.format, style);
        output.write_all(text.as_bytes()).map_err(|error| output.failure(error))?;
    }
    output.finish()?;
    say(&tally.summary(arguments.decks.len()));
    match () {
        () if unreadable => Err(Failure::AlreadySaid),
        () if tally.errors > 0 => Ok(Outcome::HasErrors),
        () => Ok(Outcome::Clean),
    }
}

impl Tally {
    fn add(&mut self, diagnostics: &[Diagnostic]) {
        for diagnostic in diagnostics {
            match diagnostic.severity {
                Severity::Error => self.errors += 1,
                Severity::Warning => self.warnings += 1,
                Severity::Note => self.notes += 1,
            }
        }
    }

    fn summary(self, decks: usize) -> String {
        let count = |number: usize, word: &str| format!("{number} {word}{}", if number == 1 { "" } else { "s" });
        if self.errors + self.warnings + self.notes == 0 {
            return format!("{}: nothing to report", count(decks, "deck"));
        }
        format!(
            "{}: {}, {}, {}",
            count(decks, "deck"),
            count(self.errors, "error"),
            count(self.warnings, "warning"),
            count(self.notes, "note"),
        )
    }
}
