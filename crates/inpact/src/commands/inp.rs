//! `inpact inp`: JSON in, a deck out, and the files it includes where the lossless form has them.

mod into;

use crate::failure::{Failure, Outcome, say};
use crate::files;
use clap::Args;
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::json::{self, View};
use inpact_parser::model::{self, Model};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct InpArguments {
    /// JSON of `inpact json`, either view; `-` reads standard input.
    #[arg(value_name = "JSON")]
    json: PathBuf,
    /// Where to write the deck, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write every file of the lossless form below this folder, under the name it has there.
    #[arg(long, value_name = "FOLDER", conflicts_with = "output")]
    into: Option<PathBuf>,
}

pub(crate) fn run(arguments: &InpArguments) -> Result<Outcome, Failure> {
    files::name_as_inputs(&[&arguments.json]);
    files::check_targets(&[arguments.output.as_deref()])?;
    let text = files::read_text(&arguments.json)?;
    let decks = decks(&text).map_err(|message| in_file(&arguments.json, &message))?;
    match (&arguments.into, decks.as_slice()) {
        (Some(folder), _) => into::write(folder, &decks)?,
        (None, [(_, bytes)]) => files::write_result(arguments.output.as_deref(), bytes)?,
        (None, _) => {
            let message = format!("the JSON holds {} files: say where to write them with `--into FOLDER`", decks.len());
            return Err(Failure::Usage(message));
        }
    }
    Ok(Outcome::Clean)
}

/// The files that the JSON says; the model view is one, without a name.
fn decks(text: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
    let grammar = Grammar::builtin();
    match json::view_of(text).map_err(|error| error.to_string())? {
        View::Model => {
            let model = json::model::read(text).map_err(|error| error.to_string())?;
            let deck = print(&model)?;
            Ok(vec![("deck.inp".to_owned(), deck.into_bytes())])
        }
        View::Syntax => json::syntax::read(text, grammar).map_err(|error| error.to_string()),
    }
}

/// The deck that says this in Abaqus' newest language; where none does, in the one that the JSON was read in.
///
/// Before release 2024 integers divide as integers (S-60), and CalculiX has other columns.
fn print(model: &Model) -> Result<String, String> {
    let newest = match model::print(model, Grammar::builtin()) {
        Ok(deck) => return Ok(deck),
        Err(error) => error.to_string(),
    };
    let others = [(Dialect::Abaqus, Release::R2022), (Dialect::Calculix, Release::NEWEST)];
    let deck = others.into_iter().find_map(|(dialect, release)| {
        let deck = model::print(model, &Grammar::new(dialect, release)).ok()?;
        let language = match dialect {
            Dialect::Abaqus => format!("Abaqus before release {}", Release::NEWEST),
            Dialect::Calculix => "CalculiX".to_owned(),
        };
        say(&format!("the deck says this in {language} alone"));
        Some(deck)
    });
    deck.ok_or(newest)
}

fn in_file(path: &Path, message: &str) -> Failure {
    Failure::Data(format!("`{}` is no deck as JSON: {message}", path.display()))
}
