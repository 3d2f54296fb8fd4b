//! A deck with the mesh around its contact pairs, and notes on the parts that were not read.

use super::findings::Messages;
use crate::failure::Failure;
use crate::files;
use crate::input::{self, LocatedDeck, ReadDeck};
use crate::settings::Settings;
use inpact_body::Body;
use inpact_diagnostics::visible::visible_line;
use inpact_diagnostics::{Diagnostic, Extent, Label, Rule};
use inpact_parser::deck::{Deck, Keep};
use inpact_parser::mesh::{self, DeckConditions, KeptRows, Mesh, MeshNote, RowBytes, SeekableRows, Target};
use inpact_parser::model::{Model, Name};
use inpact_parser::span::{Position, SourceId, Span};
use serde::Serialize;
use std::cell::RefCell;
use std::fs::File;
use std::path::Path;

/// The maximum number of notes, each of which must be located in the file.
const MAX_NOTES: usize = 100;

pub(crate) struct MeshedDeck {
    pub(crate) name: String,
    pub(crate) read: ReadDeck,
    pub(crate) mesh: Mesh,
    /// The conditions of the requested step, if any.
    pub(crate) conditions: DeckConditions,
    /// The files of the deck, where their rows are read from them; otherwise the deck has kept its rows.
    files: RefCell<Option<SeekableRows<File>>>,
}

impl MeshedDeck {
    /// Reads a deck without its mesh.
    pub(crate) fn without_mesh(path: &Path, settings: &Settings) -> Result<Self, Failure> {
        let read = ReadDeck::read(path, Keep::Interpreted, settings)?;
        let (mesh, conditions) = (Mesh::default(), DeckConditions::default());
        Ok(Self { name: path.display().to_string(), read, mesh, conditions, files: RefCell::default() })
    }

    /// Reads a deck, and the rows of its mesh that contact pairs need.
    pub(crate) fn read(path: &Path, settings: &Settings) -> Result<Self, Failure> {
        let read = Self::read_parts(path, settings, |_| None)?;
        Ok(read.0)
    }

    /// The same with further parts of the mesh, and the conditions of a step, as requested for the model; returns the indices of the parts among the surfaces of the mesh.
    pub(crate) fn read_parts(
        path: &Path,
        settings: &Settings,
        wanted: impl FnOnce(&ReadDeck) -> Option<(Vec<Target>, usize)>,
    ) -> Result<(Self, Vec<Option<usize>>), Failure> {
        let (read, mut files) = Self::open(path, settings)?;
        let wanted = wanted(&read);
        let (deck, model, grammar) = (&read.deck, &read.model, settings.grammar);
        let mesh = with_rows(&mut files, deck, |rows| match &wanted {
            None => mesh::read(deck, grammar, model, rows).map(|mesh| (mesh, Vec::new(), DeckConditions::default())),
            Some((targets, step)) => mesh::read_with_conditions(deck, grammar, model, rows, (targets, *step)),
        });
        let (mesh, places, conditions) = mesh.map_err(|error| Failure::read(path, error))?;
        let name = path.display().to_string();
        Ok((Self { name, read, mesh, conditions, files: RefCell::new(files) }, places))
    }

    /// Reads a deck and its bodies with these terminals, without the surfaces of its contact pairs.
    pub(crate) fn read_body(
        path: &Path,
        settings: &Settings,
        terminals: &[Name],
    ) -> Result<(Self, Result<Body, inpact_body::Error>), Failure> {
        let (read, mut files) = Self::open(path, settings)?;
        let body = with_rows(&mut files, &read.deck, |rows| Body::read(&read.deck, settings.grammar, terminals, rows));
        let body = body.map_err(|error| Failure::read(path, error))?;
        let name = path.display().to_string();
        let (mesh, conditions) = (Mesh::default(), DeckConditions::default());
        Ok((Self { name, read, mesh, conditions, files: RefCell::new(files) }, body))
    }

    /// Reads a deck, whose rows are then read from its files, if they are on the disk.
    fn open(path: &Path, settings: &Settings) -> Result<(ReadDeck, Option<SeekableRows<File>>), Failure> {
        let is_on_disk = path.metadata().is_ok_and(|metadata| metadata.is_file());
        // A stream cannot be read twice, and content in memory is not on disk.
        let is_file = is_on_disk && !settings.has_known_content();
        let keep = if is_file { Keep::Interpreted } else { Keep::Everything };
        let located = input::read_located_deck(path, keep, settings, None)?;
        let files = if is_file { Some(open_all(&located)?) } else { None };
        Ok((ReadDeck::of(located, settings), files))
    }

    /// Line and column of a span, even in rows that were not kept.
    fn position(&self, span: Span) -> Result<Position, Failure> {
        let position = self.with_rows(|rows| mesh::position(&self.read.deck, rows, span));
        position.map_err(|error| Failure::read(Path::new(&self.name), error))
    }

    /// Passes the rows of the deck to a reader.
    pub(crate) fn with_rows<T>(&self, read: impl FnOnce(&mut dyn RowBytes) -> T) -> T {
        with_rows(&mut self.files.borrow_mut(), &self.read.deck, read)
    }

    /// The location of a span, as in compiler messages: `deck.inp:12`.
    pub(crate) fn place_of(&self, span: Span) -> Result<String, Failure> {
        let file = self.read.deck.source(span.source()).name();
        Ok(format!("{file}:{}", self.position(span)?.line))
    }

    /// The location of a span, for messages: `line 12 of `deck.inp``.
    pub(crate) fn line_of(&self, span: Span) -> Result<String, Failure> {
        let file = self.read.deck.source(span.source()).name();
        Ok(format!("line {} of `{file}`", self.position(span)?.line))
    }

    pub(crate) fn say_notes(&self, notes: &[MeshNote], messages: Messages<'_>) -> Result<(), Failure> {
        for note in notes.iter().take(MAX_NOTES) {
            self.say_note(note, messages)?;
        }
        self.say_more(notes.len(), messages);
        Ok(())
    }

    /// A finding at a place in the deck; without one it concerns the whole deck.
    pub(crate) fn finding(&self, rule: &Rule, span: Option<Span>, message: &str) -> Result<Diagnostic, Failure> {
        let mut label = Label::new(span.unwrap_or_default(), "");
        label.file = self.read.deck.source(label.span.source()).name().into();
        match span {
            Some(span) => label.position = self.position(span)?,
            None => label.extent = Extent::File,
        }
        Ok(Diagnostic::new(rule, message, label))
    }

    /// Prints findings of a minor rule, each at its place; true if the configuration turns them into errors.
    pub(crate) fn say_findings(
        &self,
        rule: &Rule,
        notes: &[MeshNote],
        (messages, settings): (Messages<'_>, &Settings),
    ) -> Result<bool, Failure> {
        let found = notes.iter().take(MAX_NOTES).map(|note| self.finding(rule, Some(note.span), &note.message));
        let has_errors = messages.of_deck(found.collect::<Result<_, _>>()?, &self.read.deck, settings);
        self.say_more(notes.len(), messages);
        Ok(has_errors)
    }

    fn say_more(&self, notes: usize, messages: Messages<'_>) {
        let more = notes.saturating_sub(MAX_NOTES);
        if 0 < more {
            messages.remark(|| format!("{}: note: {more} more notes", visible_line(&self.name)));
        }
    }

    /// Prints a note on a place in the deck.
    fn say_note(&self, note: &MeshNote, messages: Messages<'_>) -> Result<(), Failure> {
        let (place, severity) = (self.position(note.span)?, "note");
        let file = self.read.deck.source(note.span.source()).name();
        let line = || {
            let line = format!("{file}:{}:{}: {severity}: {}", place.line, place.column, note.message);
            vec![visible_line(&line).into_owned()]
        };
        let record = || {
            let record = Record {
                severity,
                file,
                line: place.line,
                column: place.column,
                span: [note.span.start(), note.span.end()],
                message: &note.message,
            };
            // A record of strings and numbers has no reason to fail.
            serde_json::to_string(&record).unwrap_or_default()
        };
        // A note has no code, which an annotation would need as its title.
        messages.tell(line, record);
        Ok(())
    }
}

/// The mesh of a deck already read: from its kept rows, or else from its files.
pub(crate) fn mesh_of(
    path: &Path,
    located: &LocatedDeck,
    keep: Keep,
    model: &Model,
    settings: &Settings,
) -> Result<Mesh, Failure> {
    let mut files = if keep == Keep::Everything { None } else { Some(open_all(located)?) };
    let deck = &located.deck;
    let mesh = with_rows(&mut files, deck, |rows| mesh::read(deck, settings.grammar, model, rows));
    mesh.map_err(|error| Failure::read(path, error))
}

/// Passes the rows of a deck to a reader: those of its files, or else its kept ones.
fn with_rows<T>(files: &mut Option<SeekableRows<File>>, deck: &Deck, read: impl FnOnce(&mut dyn RowBytes) -> T) -> T {
    match files {
        Some(files) => read(files),
        None => read(&mut KeptRows(deck)),
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

/// The files of a deck, to be read again.
fn open_all(located: &LocatedDeck) -> Result<SeekableRows<File>, Failure> {
    let mut opened = Vec::new();
    for (source, place) in (0..).zip(&located.places) {
        opened.push((SourceId(source), files::open_file(place)?));
    }
    Ok(SeekableRows::new(opened))
}
