//! `inpact json`: a deck in, JSON out.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::input;
use crate::settings::DeckArguments;
use clap::{Args, ValueEnum};
use inpact_parser::deck::Keep;
use inpact_parser::{json, model};
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
    files::refuse_overwriting(arguments.output.as_deref(), &[&arguments.deck])?;
    let settings = arguments.reading.settings(&arguments.deck)?;
    let grammar = settings.grammar;
    let text = match arguments.view {
        View::Model => {
            let deck = input::read_deck(&arguments.deck, Keep::Interpreted, &settings)?;
            let (model, _) = model::read(&deck, grammar);
            json::model::write(&model, &arguments.deck.display().to_string())
        }
        View::Syntax => json::syntax::write(&input::read_deck(&arguments.deck, Keep::Everything, &settings)?, grammar),
    };
    files::write_result(arguments.output.as_deref(), text.as_bytes())?;
    Ok(Outcome::Clean)
}
