//! Analysis of a deck in the editor: what was read, and its findings.

use crate::input::{self, LocatedDeck};
use crate::settings::{ReadOptions, Settings};
use inpact_diagnostics::Diagnostic;
use inpact_parser::Problem;
use inpact_parser::deck::{Deck, Keep};
use inpact_parser::model::{self, Model};
use inpact_parser::span::SourceId;
use inpact_validation::check_watched;
use std::cell::OnceCell;
use std::path::{Path, PathBuf};

/// A deck with its included files.
#[derive(Debug)]
pub(super) struct Analysis {
    pub(super) settings: Settings,
    pub(super) deck: Deck,
    pub(super) model: Model,
    pub(super) problems: Vec<Problem>,
    /// The findings of `inpact check`.
    pub(super) findings: Vec<Diagnostic>,
    /// The fault of the configuration, which is then ignored.
    pub(super) fault: Option<Fault>,
    /// The paths of its files, by source.
    places: Vec<PathBuf>,
    /// The same deck for the other solver, computed lazily.
    other: OnceCell<Box<Analysis>>,
}

/// A configuration that cannot be read, or is invalid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault {
    /// The configuration; the deck itself where it is unknown.
    pub(super) place: PathBuf,
    pub(super) message: String,
}

impl Analysis {
    /// Reads the deck at `root`, which need not be on disk, and checks it; unwinds where the options request it.
    pub(super) fn of(root: &Path, options: &ReadOptions) -> Self {
        let (settings, fault) = Self::settings_of(root, options);
        let (deck, places) = match input::read_located_deck(root, Keep::Interpreted, &settings, None) {
            Ok(LocatedDeck { deck, places }) => (deck, places),
            // It is open, so only a root can exclude it.
            Err(failure) => {
                let fault = Fault { place: root.to_owned(), message: failure.to_string() };
                return Self::nothing(root, settings, fault);
            }
        };
        let look = || settings.stop.look();
        let (model, problems) = model::read_watched(&deck, settings.grammar, &look);
        let findings = settings.apply(check_watched(&deck, settings.grammar, &model, &problems, &look));
        Self { settings, deck, model, problems, findings, fault, places, other: OnceCell::new() }
    }

    /// An empty deck.
    fn nothing(root: &Path, settings: Settings, fault: Fault) -> Self {
        let deck = inpact_parser::deck::scan(&root.display().to_string(), &[], settings.grammar);
        let (model, problems) = model::read(&deck, settings.grammar);
        let places = vec![root.to_owned()];
        Self {
            settings,
            deck,
            model,
            problems,
            findings: Vec::new(),
            fault: Some(fault),
            places,
            other: OnceCell::new(),
        }
    }

    /// The settings for a deck; those without a configuration where that is invalid.
    fn settings_of(root: &Path, options: &ReadOptions) -> (Settings, Option<Fault>) {
        match Settings::of(root, options) {
            Ok(settings) => (settings, None),
            Err(failure) => {
                let place = options.configuration_of(root).unwrap_or_else(|| root.to_owned());
                let fault = Fault { place, message: failure.to_string() };
                let settings = Settings::of(root, &options.clone().isolated())
                    .unwrap_or_else(|_| Settings::unconfigured(options.overlay.clone()));
                (settings, Some(fault))
            }
        }
    }

    /// The same deck for the other solver.
    pub(super) fn other(&self, make: impl FnOnce() -> Self) -> &Self {
        self.other.get_or_init(|| Box::new(make()))
    }

    /// The paths of its files, the deck first; a file that is included twice occurs twice.
    pub(super) fn places(&self) -> impl Iterator<Item = &PathBuf> {
        self.places.iter()
    }

    pub(super) fn place(&self, source: SourceId) -> &Path {
        self.places.get(source.0 as usize).map_or(Path::new(""), PathBuf::as_path)
    }

    /// The first source that is that file.
    pub(super) fn source_of(&self, place: &Path) -> Option<SourceId> {
        let index = self.places.iter().position(|part| part == place)?;
        Some(SourceId(u32::try_from(index).ok()?))
    }
}
