//! `inpact json`: a deck in, JSON out.

use crate::failure::{Failure, Outcome, say};
use crate::files;
use crate::input::{self, ReadDeck};
use crate::render::{self, Format, Sources, Style};
use crate::settings::{DeckArguments, Settings};
use clap::{Args, ValueEnum};
use inpact_parser::deck::Keep;
use inpact_parser::json;
use inpact_validation::Severity;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct JsonArguments {
    /// The deck or fragment; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    #[command(flatten)]
    reading: DeckArguments,
    /// What to print: what the deck says, or every line of it.
    #[arg(long, value_enum, default_value_t = View::Model)]
    view: View,
    /// Where to write, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum View {
    /// The interactions, contact pairs and procedures as typed data.
    Model,
    /// The lossless form: every line, from which the deck comes back byte for byte.
    Syntax,
}

pub(crate) fn run(arguments: &JsonArguments) -> Result<Outcome, Failure> {
    files::name_as_inputs(&[&arguments.deck]);
    files::check_targets(&[arguments.output.as_deref()])?;
    let settings = arguments.reading.settings(&arguments.deck)?;
    let (text, outcome) = match arguments.view {
        View::Model => model_view(arguments, &settings)?,
        View::Syntax => {
            let deck = input::read_deck(&arguments.deck, Keep::Everything, &settings)?;
            (json::syntax::write(&deck, settings.grammar), Outcome::Clean)
        }
    };
    files::write_result(arguments.output.as_deref(), text.as_bytes())?;
    Ok(outcome)
}

/// The model view; its errors go to standard error, since the parts concerned may be missing from the model.
fn model_view(arguments: &JsonArguments, settings: &Settings) -> Result<(String, Outcome), Failure> {
    let read = ReadDeck::read(&arguments.deck, Keep::Interpreted, settings)?;
    let text = json::model::write(&read.model, &arguments.deck.display().to_string());
    let mut errors = read.check(settings);
    errors.retain(|found| found.severity == Severity::Error);
    let said = render::diagnostics(&errors, Sources::Deck(&read.deck), Format::Concise, Style::Plain);
    if !said.is_empty() {
        say(said.trim_end());
    }
    Ok((text, if errors.is_empty() { Outcome::Clean } else { Outcome::HasErrors }))
}
