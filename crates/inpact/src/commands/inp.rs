//! `inpact inp`: JSON in, a deck out.

use crate::failure::{Failure, Outcome};
use crate::files;
use clap::Args;
use inpact_parser::grammar::Grammar;
use inpact_parser::json::{self, View};
use inpact_parser::model;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct InpArguments {
    /// JSON of `inpact json`, either view; `-` reads standard input.
    #[arg(value_name = "JSON")]
    json: PathBuf,
    /// Where to write the deck, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(crate) fn run(arguments: &InpArguments) -> Result<Outcome, Failure> {
    let text = files::read_text(&arguments.json)?;
    let bytes = deck_bytes(&text).map_err(|message| in_file(&arguments.json, &message))?;
    files::write_result(arguments.output.as_deref(), &bytes)?;
    Ok(Outcome::Clean)
}

/// The deck that the JSON says; the lossless form gives the first file, which is the deck itself.
fn deck_bytes(text: &str) -> Result<Vec<u8>, String> {
    let grammar = Grammar::builtin();
    match json::view_of(text).map_err(|error| error.to_string())? {
        View::Model => {
            let model = json::model::read(text).map_err(|error| error.to_string())?;
            model::print(&model, grammar).map(String::into_bytes).map_err(|error| error.to_string())
        }
        View::Syntax => {
            let files = json::syntax::read(text, grammar).map_err(|error| error.to_string())?;
            Ok(files.into_iter().next().map(|(_, bytes)| bytes).unwrap_or_default())
        }
    }
}

fn in_file(path: &Path, message: &str) -> Failure {
    Failure::Data(format!("`{}` is no deck as JSON: {message}", path.display()))
}
