//! Reads JSON, either view, into the files of a deck.

use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::json::{self, View};
use inpact_parser::model::{self, Model};

/// The default language of written decks.
pub(crate) const NEWEST: (Dialect, Release) = (Dialect::Abaqus, Release::NEWEST);

/// The files of a JSON document.
pub(crate) struct Files {
    /// Their names and bytes; the deck itself first.
    pub(crate) files: Vec<(String, Vec<u8>)>,
    /// The language that the model view was written in; the lines of the syntax view are in whichever they are read in.
    pub(crate) language: Option<(Dialect, Release)>,
}

/// Reads JSON, either view; the model view is one file.
///
/// # Errors
/// The fault of the JSON, and its path.
pub(crate) fn files(text: &str) -> Result<Files, String> {
    match json::view_of(text).map_err(|error| error.to_string())? {
        View::Model => {
            let model = json::model::read(text).map_err(|error| error.to_string())?;
            let (deck, language) = print(&model)?;
            Ok(Files { files: vec![("deck.inp".to_owned(), deck.into_bytes())], language: Some(language) })
        }
        View::Syntax => {
            let files = json::syntax::read(text, Grammar::builtin()).map_err(|error| error.to_string())?;
            Ok(Files { files, language: None })
        }
    }
}

/// The deck in Abaqus' newest language; if that cannot express it, in the language with which the JSON was read.
///
/// Before release 2024 integers have integer division (S-60), and CalculiX has other columns.
fn print(model: &Model) -> Result<(String, (Dialect, Release)), String> {
    let newest = match model::print(model, Grammar::builtin()) {
        Ok(deck) => return Ok((deck, NEWEST)),
        Err(error) => error.to_string(),
    };
    let others = [(Dialect::Abaqus, Release::R2022), (Dialect::Calculix, Release::NEWEST)];
    let deck = others.into_iter().find_map(|(dialect, release)| {
        let deck = model::print(model, &Grammar::new(dialect, release)).ok()?;
        Some((deck, (dialect, release)))
    });
    deck.ok_or(newest)
}
