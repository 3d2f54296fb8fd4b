//! `inpact inp`: JSON in, a deck out, with the files it includes where the lossless form has them.

mod into;

use crate::failure::{Failure, Outcome, say};
use crate::files;
use crate::json_deck;
use clap::Args;
use inpact_parser::grammar::{Dialect, Release};
use std::path::PathBuf;

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
    let unreadable = |message| Failure::Data(format!("`{}` is no deck as JSON: {message}", arguments.json.display()));
    let decks = decks(&text).map_err(unreadable)?;
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

/// The files of the JSON, after reporting their language, where it is not the newest of Abaqus.
fn decks(text: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
    let json_deck::Files { files, language } = json_deck::files(text)?;
    if let Some((dialect, _)) = language.filter(|language| *language != json_deck::NEWEST) {
        let language = match dialect {
            Dialect::Abaqus => format!("Abaqus before release {}", Release::NEWEST),
            Dialect::Calculix => "CalculiX".to_owned(),
        };
        say(&format!("the deck says this in {language} alone"));
    }
    Ok(files)
}
