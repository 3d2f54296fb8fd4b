//! Fixes of a deck's findings, applied in memory, and written back on request.

use crate::deck::Deck;
use crate::difference;
use crate::error::Error;
use crate::failure::Failure;
use crate::files::transaction;
use crate::fixing::{self, FixReach, FixSelection, Mended, Need, Subject};
use crate::input::HeldFiles;
use crate::rules;
use crate::settings::ReadOptions;
use inpact_parser::deck::EditedText;
use std::path::{Path, PathBuf};

/// The fixes to apply, and the files.
#[derive(Debug, Clone, Default)]
pub struct Fixes(FixSelection);

impl Fixes {
    /// All fixes that keep the meaning of the deck, in the deck and in included files below its folder.
    pub fn safe() -> Self {
        Self::default()
    }

    /// Only the fixes of the rules with these codes, even if they change the meaning of the deck.
    pub fn of<S: Into<String>>(codes: impl IntoIterator<Item = S>) -> Self {
        let codes: Vec<String> = codes.into_iter().map(Into::into).collect();
        Self(FixSelection { also: codes.clone(), only: Some(codes), ..FixSelection::default() })
    }

    /// Additionally the fixes of the rules with these codes, even if they change the meaning of the deck.
    #[must_use]
    pub fn also<S: Into<String>>(mut self, codes: impl IntoIterator<Item = S>) -> Self {
        self.0.also.extend(codes.into_iter().map(Into::into));
        self
    }

    /// Also in included files outside of the folder of the deck.
    #[must_use]
    pub fn in_every_included_file(mut self) -> Self {
        self.0.reach = FixReach::EveryIncluded;
        self
    }

    fn selection(&self) -> Result<&FixSelection, Failure> {
        match self.0.also.iter().find(|code| rules::of_code(code).is_none()) {
            Some(unknown) => Err(Failure::Usage(format!("there is no rule `{unknown}`"))),
            None => Ok(&self.0),
        }
    }
}

/// Result of fixing a deck; nothing is written until [`write`](Self::write) is called.
#[derive(Debug)]
pub struct Fixed {
    name: PathBuf,
    options: ReadOptions,
    findings: usize,
    left: Vec<String>,
    files: Vec<FixedFile>,
    held: HeldFiles,
}

/// A file that fixing changes.
#[derive(Debug, Clone)]
pub struct FixedFile {
    name: PathBuf,
    path: PathBuf,
    before: std::sync::Arc<[u8]>,
    after: std::sync::Arc<[u8]>,
}

impl Deck {
    /// Applies the fixes of its findings, in memory.
    ///
    /// ```
    /// use inpact::{Deck, Fixes, ReadOptions};
    ///
    /// let deck = Deck::parse("a.inp", "*SURFACE INTERACTION, NAME=A\n  ** bare\n", &ReadOptions::new().isolated())?;
    /// let fixed = deck.fix(&Fixes::safe())?;
    /// assert_eq!(fixed.findings(), 1);
    /// assert_eq!(fixed.files()[0].after(), b"*SURFACE INTERACTION, NAME=A\n** bare\n");
    /// assert!(fixed.deck()?.check().is_empty());
    /// # Ok::<(), inpact::Error>(())
    /// ```
    ///
    /// # Errors
    /// Files that cannot be read again, or an unknown code.
    pub fn fix(&self, fixes: &Fixes) -> Result<Fixed, Error> {
        Fixed::of(self, fixes)
    }
}

impl Fixed {
    pub(crate) fn of(deck: &Deck, fixes: &Fixes) -> Result<Self, Error> {
        let selection = fixes.selection()?;
        let held = HeldFiles::default();
        for (place, content) in &deck.options.overlay {
            held.hold(place, content.to_bytes().into());
        }
        let name = Path::new(deck.name());
        let places = deck.files().to_vec();
        let mut subjects = [Subject { path: name, settings: &deck.settings, places, need: Need::Mending }];
        let Mended { findings, left, failures } = fixing::mend(&mut subjects, &held, selection);
        if let Some(failure) = failures.into_iter().next() {
            return Err(failure.into());
        }
        let changed = held.changed().into_iter();
        let files = changed.map(|file| FixedFile {
            name: file.read.name,
            path: file.read.path,
            before: file.read.bytes,
            after: file.now,
        });
        Ok(Self { name: name.to_owned(), options: deck.options.clone(), findings, left, files: files.collect(), held })
    }

    /// The number of findings that it fixes.
    pub fn findings(&self) -> usize {
        self.findings
    }

    /// The remaining findings that have a fix, with the reason, as sentences.
    pub fn left(&self) -> &[String] {
        &self.left
    }

    /// The files that change.
    pub fn files(&self) -> &[FixedFile] {
        &self.files
    }

    /// The fixed deck; nothing is written for it.
    ///
    /// # Errors
    /// As [`Deck::read`].
    pub fn deck(&self) -> Result<Deck, Error> {
        let mut options = self.options.clone();
        for file in &self.files {
            options.overlay.insert(file.path.clone(), EditedText::new(&file.after));
        }
        Deck::read(&self.name, &options)
    }

    /// Writes the files that change, all of them or none, if each is unchanged since it was read, byte for byte.
    ///
    /// # Errors
    /// A file that cannot be written, or that another program changed meanwhile, or a text without a file.
    pub fn write(&self) -> Result<(), Error> {
        if let Some(unread) = self.held.changed().into_iter().find(|file| !file.read.is_file()) {
            let message = format!("`{}` was not read from a file, and is not written", unread.read.name.display());
            return Err(Failure::Usage(message).into());
        }
        match transaction::commit(&self.held.changes()) {
            Ok(()) => Ok(()),
            Err(failures) => Err(failures.into_iter().next().unwrap_or(Failure::AlreadySaid).into()),
        }
    }
}

impl FixedFile {
    /// The name in messages.
    pub fn name(&self) -> &Path {
        &self.name
    }

    /// Its path, with links resolved.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its bytes as they were read.
    pub fn before(&self) -> &[u8] {
        &self.before
    }

    /// Its bytes once fixed.
    pub fn after(&self) -> &[u8] {
        &self.after
    }

    /// The changes, as a unified diff.
    pub fn difference(&self) -> String {
        difference::unified(&self.name.display().to_string(), &self.before, &self.after)
    }
}
