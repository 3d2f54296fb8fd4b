//! A deck, read with everything it includes.

use crate::curves::{self, Figure, Request};
use crate::error::Error;
use crate::failure::Failure;
use crate::input::ReadDeck;
use crate::json_deck;
use crate::render::{self, Format, Sources, Style};
use crate::settings::{ReadOptions, Settings};
use inpact_diagnostics::Diagnostic;
use inpact_evaluation::plan::Choices;
use inpact_parser::deck::Deck as Syntax;
use inpact_parser::grammar::Grammar;
use inpact_parser::json;
use inpact_parser::model::{self, Model};
use std::path::{Path, PathBuf};

/// A deck or a fragment of one, with everything it includes and its settings.
///
/// Reading never fails because of the content of a deck: faults are reported by [`check`](Self::check).
pub struct Deck {
    name: String,
    pub(crate) read: ReadDeck,
    pub(crate) settings: Settings,
    pub(crate) options: ReadOptions,
}

impl Deck {
    /// Reads the deck at `path`, or standard input for `-`, and the files it includes.
    ///
    /// ```no_run
    /// use inpact::{Deck, ReadOptions, Release};
    ///
    /// let options = ReadOptions::new().release(Release::R2022).include_dir("meshes");
    /// let deck = Deck::read("joint.inp", &options)?;
    /// for found in deck.check() {
    ///     println!("{}: {}", found.code, found.message);
    /// }
    /// # Ok::<(), inpact::Error>(())
    /// ```
    ///
    /// # Errors
    /// A file that cannot be read, or an invalid configuration.
    /// A missing included file is a finding, not an error.
    pub fn read(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, Error> {
        let path = path.as_ref();
        let settings = Settings::of(path, options)?;
        let read = ReadDeck::read(path, options.keep, &settings)?;
        Ok(Self { name: path.display().to_string(), read, settings, options: options.clone() })
    }

    /// Reads a deck from its text; `name` is its name in messages, and included files are searched relative to it.
    ///
    /// ```
    /// use inpact::{Deck, ReadOptions};
    ///
    /// // What an editor has open counts instead of what is on disk.
    /// let options = ReadOptions::new().isolated().file("gap.inp", "*GAP ELECTRICAL CONDUCTANCE\n1., 0.\n0., 2.\n");
    /// let deck = Deck::parse("joint.inp", "*SURFACE INTERACTION, NAME=JOINT\n*INCLUDE, INPUT=gap.inp\n", &options)?;
    /// assert!(deck.check().is_empty());
    /// assert!(deck.model().interactions[0].gap_electrical_conductance.is_some());
    /// # Ok::<(), inpact::Error>(())
    /// ```
    ///
    /// # Errors
    /// A configuration that cannot be read, or is invalid.
    pub fn parse(name: impl AsRef<Path>, text: impl Into<Vec<u8>>, options: &ReadOptions) -> Result<Self, Error> {
        let name = name.as_ref();
        Self::read(name, &options.clone().file(name, text))
    }

    /// Makes a deck from JSON written by [`to_json`](Self::to_json) or [`to_syntax_json`](Self::to_syntax_json).
    ///
    /// ```
    /// use inpact::{Deck, ReadOptions};
    ///
    /// let options = ReadOptions::new().isolated();
    /// let deck = Deck::parse("a.inp", "*SURFACE INTERACTION, NAME=A\n", &options)?;
    /// let again = Deck::from_json(&deck.to_json(), &options)?;
    /// assert_eq!(again.to_inp()?, "*SURFACE INTERACTION, NAME=A\n");
    /// # Ok::<(), inpact::Error>(())
    /// ```
    ///
    /// # Errors
    /// JSON that is not a deck, with the path of the fault.
    pub fn from_json(json: &str, options: &ReadOptions) -> Result<Self, Error> {
        let json_deck::Files { files, language } = json_deck::files(json).map_err(Error::data)?;
        let mut options = options.clone();
        if let Some((dialect, release)) = language {
            options = options.dialect(dialect).release(release);
        }
        let name = files.first().map_or_else(|| PathBuf::from("deck.inp"), |(name, _)| PathBuf::from(name));
        for (name, bytes) in files {
            options = options.file(name, bytes);
        }
        Self::read(&name, &options)
    }

    /// The name in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The paths of its files, the deck itself first.
    pub fn files(&self) -> &[PathBuf] {
        &self.read.places
    }

    /// The contact interfaces that it defines.
    pub fn model(&self) -> &Model {
        &self.read.model
    }

    /// Its lines and blocks, for `inpact-parser`.
    pub fn syntax(&self) -> &Syntax {
        &self.read.deck
    }

    /// The keyword language with which it was read.
    pub fn grammar(&self) -> &'static Grammar {
        self.settings.grammar
    }

    /// Its findings, in the order of the deck, with the severities of its configuration.
    pub fn check(&self) -> Vec<Diagnostic> {
        self.read.check(&self.settings)
    }

    /// The curves of its laws against clearance and contact pressure, as `inpact plot` draws them.
    ///
    /// ```
    /// use inpact::curves::Request;
    /// use inpact::{Deck, ReadOptions};
    ///
    /// let text = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n0., 1.\n";
    /// let deck = Deck::parse("a.inp", text, &ReadOptions::new().isolated())?;
    /// let figure = deck.figure(&Request::default());
    /// assert_eq!(figure.panels[0].title(), "A: electrical conductance");
    /// assert!(figure.svg().starts_with("<svg"));
    /// assert!(figure.letters().contains("clearance (L)"));
    /// # Ok::<(), inpact::Error>(())
    /// ```
    pub fn figure(&self, request: &Request) -> Figure {
        let grammar = self.settings.grammar;
        let choices = Choices { dialect: grammar.dialect(), ..Choices::default() };
        curves::figure((&self.name, &self.read.model), grammar, &choices, request)
    }

    /// Findings of this deck as text in a format of `inpact check`, without colours.
    ///
    /// ```
    /// use inpact::{Deck, Format, ReadOptions};
    ///
    /// let deck = Deck::parse("a.inp", "*SURFACE INTERACTION\n", &ReadOptions::new().isolated())?;
    /// let text = deck.render(&deck.check(), Format::Concise);
    /// assert_eq!(text, "a.inp:1:1: error[K006] `*SURFACE INTERACTION` lacks its parameter `NAME`\n");
    /// # Ok::<(), inpact::Error>(())
    /// ```
    pub fn render(&self, findings: &[Diagnostic], format: Format) -> String {
        let frame = render::document(format);
        frame.head + &render::diagnostics(findings, Sources::Deck(&self.read.deck), format, Style::Plain) + &frame.tail
    }

    /// Its model, as JSON of the schema `inpact/model/1`.
    pub fn to_json(&self) -> String {
        json::model::write(&self.read.model, &self.name)
    }

    /// Its lines, as JSON of the schema `inpact/syntax/1`.
    ///
    /// # Errors
    /// A deck that was read without [`ReadOptions::keep_everything`].
    pub fn to_syntax_json(&self) -> Result<String, Error> {
        if let Some(incomplete) = self.read.deck.sources().iter().find(|source| !source.is_complete()) {
            let message = format!("the rows of `{}` were not kept: read it with `keep_everything`", incomplete.name());
            return Err(Failure::Usage(message).into());
        }
        Ok(json::syntax::write(&self.read.deck, self.settings.grammar))
    }

    /// A deck with the same contact interfaces, in its dialect and release.
    ///
    /// # Errors
    /// A model that no deck can contain.
    pub fn to_inp(&self) -> Result<String, Error> {
        model::print(&self.read.model, self.settings.grammar).map_err(|error| Error::data(error.to_string()))
    }
}

impl std::fmt::Debug for Deck {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Deck").field("name", &self.name).finish_non_exhaustive()
    }
}
