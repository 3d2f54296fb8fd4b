//! A deck with the mesh around its contact pairs, and what is said of what was not read.

use super::findings::FindingFormat;
use crate::failure::{Failure, say, say_json};
use crate::files;
use crate::input::{self, LocatedDeck};
use crate::settings::Settings;
use inpact_diagnostics::visible::visible_line;
use inpact_parser::deck::{Deck, Keep};
use inpact_parser::mesh::{self, KeptRows, Mesh, MeshNote, SeekableRows};
use inpact_parser::model::{self, Model};
use inpact_parser::problem::Problem;
use inpact_parser::span::{Position, SourceId};
use serde::Serialize;
use std::cell::RefCell;
use std::fs::File;
use std::io;
use std::path::Path;

/// More notes than these nobody reads, and each has to be looked for in the file.
const MOST_NOTES: usize = 100;

/// A deck and its model.
pub(crate) struct ReadDeck {
    pub(crate) deck: Deck,
    pub(crate) model: Model,
    pub(crate) problems: Vec<Problem>,
}

/// A deck with its mesh.
pub(crate) struct MeshedDeck {
    pub(crate) name: String,
    pub(crate) read: ReadDeck,
    pub(crate) mesh: Mesh,
    /// The files of the deck, where their rows are read from them; otherwise the deck has kept its rows.
    files: RefCell<Option<SeekableRows<File>>>,
}

impl ReadDeck {
    /// Reads a deck without its mesh.
    pub(crate) fn read(path: &Path, settings: &Settings) -> Result<Self, Failure> {
        Ok(Self::of(input::read_deck(path, Keep::Interpreted, settings)?, settings))
    }

    fn of(deck: Deck, settings: &Settings) -> Self {
        let (model, problems) = model::read(&deck, settings.grammar);
        Self { deck, model, problems }
    }
}

impl MeshedDeck {
    /// Reads a deck, and the rows of its mesh that contact pairs need.
    pub(crate) fn read(path: &Path, settings: &Settings) -> Result<Self, Failure> {
        let is_on_disk = path.metadata().is_ok_and(|metadata| metadata.is_file());
        // A stream cannot be read twice, and content that is known without reading is on no disk.
        let is_file = is_on_disk && !settings.has_known_content();
        let keep = if is_file { Keep::Interpreted } else { Keep::Everything };
        let located = input::read_located_deck(path, keep, settings, None)?;
        let mut files = if is_file { Some(open_all(&located)?) } else { None };
        let LocatedDeck { deck, .. } = located;
        let read = ReadDeck::of(deck, settings);
        let mesh = read_mesh(&read.deck, &read.model, settings, files.as_mut());
        let mesh = mesh.map_err(|error| Failure::read(path, error))?;
        Ok(Self { name: path.display().to_string(), read, mesh, files: RefCell::new(files) })
    }

    /// Says notes with their places.
    pub(crate) fn say_notes(&self, notes: &[MeshNote], format: FindingFormat) -> Result<(), Failure> {
        for note in notes.iter().take(MOST_NOTES) {
            let unreadable = |error| Failure::read(Path::new(&self.name), error);
            let position = match &mut *self.files.borrow_mut() {
                Some(files) => mesh::position(&self.read.deck, files, note.span),
                None => mesh::position(&self.read.deck, &mut KeptRows(&self.read.deck), note.span),
            };
            self.say_note(note, position.map_err(unreadable)?, format);
        }
        let more = notes.len().saturating_sub(MOST_NOTES);
        if 0 < more && format != FindingFormat::Json {
            say(&format!("{}: note: {more} more notes", visible_line(&self.name)));
        }
        Ok(())
    }

    fn say_note(&self, note: &MeshNote, place: Position, format: FindingFormat) {
        let file = self.read.deck.source(note.span.source).name();
        match format {
            // A note has no code, which an annotation would need as its title.
            FindingFormat::Concise | FindingFormat::Github => {
                let line = format!("{file}:{}:{}: note: {}", place.line, place.column, note.message);
                say(&visible_line(&line));
            }
            FindingFormat::Json => {
                let record = Record {
                    severity: "note",
                    file,
                    line: place.line,
                    column: place.column,
                    span: [note.span.start, note.span.end],
                    message: &note.message,
                };
                // A record of strings and numbers has no reason to fail.
                say_json(&serde_json::to_string(&record).unwrap_or_default());
            }
        }
    }
}

/// The mesh of a deck that was read already: from the rows it has kept, or else from its files.
pub(crate) fn mesh_of(
    path: &Path,
    located: &LocatedDeck,
    keep: Keep,
    model: &Model,
    settings: &Settings,
) -> Result<Mesh, Failure> {
    let mut files = if keep == Keep::Everything { None } else { Some(open_all(located)?) };
    read_mesh(&located.deck, model, settings, files.as_mut()).map_err(|error| Failure::read(path, error))
}

fn read_mesh(
    deck: &Deck,
    model: &Model,
    settings: &Settings,
    files: Option<&mut SeekableRows<File>>,
) -> io::Result<Mesh> {
    match files {
        Some(files) => mesh::read(deck, settings.grammar, model, files),
        None => mesh::read(deck, settings.grammar, model, &mut KeptRows(deck)),
    }
}

#[derive(Serialize)]
struct Record<'a> {
    severity: &'static str,
    file: &'a str,
    line: u64,
    column: u64,
    span: [u64; 2],
    message: &'a str,
}

/// The files of a deck, to be read once more.
fn open_all(located: &LocatedDeck) -> Result<SeekableRows<File>, Failure> {
    let mut opened = Vec::new();
    for (source, place) in (0..).zip(located.places()) {
        opened.push((SourceId(source), files::open_file(place)?));
    }
    Ok(SeekableRows::new(opened))
}
