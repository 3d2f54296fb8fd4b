//! Documents that the editor has open, with their analysis.
//!
//! A document is text; a deck is a document with what it includes, open or not, saved or not.
//! An open document that another one includes is not a deck of its own: it is checked as part of that deck.
//! Decks are read again lazily, not at every keystroke.

use super::analysis::{Analysis, Fault};
use super::uri;
use crate::files::{self, Stamp};
use crate::settings::ReadOptions;
use crate::stop::Stop;
use gen_lsp_types::{Location, Position, Range, TextDocumentContentChangeEvent, Uri};
use indexmap::IndexMap;
use inpact_diagnostics::ColumnUnit;
use inpact_parser::deck::EditedText;
use inpact_parser::deck::lines::{LineKind, line_kind, lines, without_line_end};
use inpact_parser::grammar::Dialect;
use inpact_parser::span::{SourceId, Span};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The documents of an editor, and their decks.
#[derive(Debug, Default)]
pub(super) struct Workspace {
    /// The unit of columns of the editor.
    pub(super) unit: ColumnUnit,
    pub(super) traits: Traits,
    /// Whether the current request is cancelled.
    pub(super) stop: Stop,
    /// The read options, from the settings of the editor.
    options: ReadOptions,
    /// By path, in the order in which they were opened.
    documents: IndexMap<PathBuf, Document>,
    /// Included files that are not open.
    files: BTreeMap<PathBuf, FileOnDisk>,
    analyses: BTreeMap<PathBuf, Analysis>,
    /// The decks that must be read again.
    stale: BTreeSet<PathBuf>,
}

/// Abilities of the editor.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Traits {
    /// Whether completions may have placeholders.
    pub(super) knows_snippets: bool,
    /// Whether edits may have document versions.
    pub(super) knows_versions: bool,
    /// Whether it can watch files.
    pub(super) watches_files: bool,
    /// Whether it supports refresh of lenses, hints and tokens.
    pub(super) refreshes_lenses: bool,
    pub(super) refreshes_hints: bool,
    pub(super) refreshes_tokens: bool,
}

#[derive(Debug)]
struct Document {
    uri: Uri,
    version: i32,
    text: EditedText,
}

/// A file that is not open, as it was read.
#[derive(Debug)]
struct FileOnDisk {
    stamp: Stamp,
    text: EditedText,
}

/// A document within a deck.
#[derive(Debug, Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) workspace: &'a Workspace,
    pub(super) analysis: &'a Analysis,
    /// Its source in the deck.
    pub(super) source: SourceId,
}

impl Workspace {
    /// Nothing is open yet.
    pub(super) fn new(unit: ColumnUnit, traits: Traits, stop: Stop) -> Self {
        Self { unit, traits, stop, ..Self::default() }
    }

    /// Sets the read options of decks.
    pub(super) fn set_options(&mut self, options: ReadOptions) {
        self.options = options;
        self.forget();
    }

    /// Reads everything again when it is requested: files may have changed, come or gone.
    pub(super) fn forget(&mut self) {
        self.stale = self.documents.keys().cloned().collect();
    }

    pub(super) fn open(&mut self, uri: Uri, version: i32, text: EditedText) {
        let place = place_of(&uri);
        self.files.remove(&place);
        self.documents.insert(place, Document { uri, version, text });
        self.forget();
    }

    pub(super) fn close(&mut self, uri: &Uri) {
        let place = place_of(uri);
        self.documents.shift_remove(&place);
        self.analyses.remove(&place);
        self.forget();
    }

    /// Changes a document; all changes or, if one panics, none.
    pub(super) fn change(&mut self, uri: &Uri, version: i32, changes: Vec<TextDocumentContentChangeEvent>) {
        let place = place_of(uri);
        let Some(document) = self.documents.get_mut(&place) else { return };
        let mut text = document.text.clone();
        for change in changes {
            match change {
                TextDocumentContentChangeEvent::TextDocumentContentChangePartial(change) => {
                    let start = offset_of(&text, change.range.start, self.unit);
                    let end = offset_of(&text, change.range.end, self.unit);
                    text.replace(start.min(end)..start.max(end), change.text.as_bytes());
                }
                TextDocumentContentChangeEvent::TextDocumentContentChangeWholeDocument(change) => {
                    text = EditedText::new(change.text.as_bytes());
                }
            }
        }
        document.text = text;
        document.version = version;
        self.files_changed(&[place]);
    }

    /// Marks the decks of these files to be read again.
    fn files_changed(&mut self, places: &[PathBuf]) {
        let is_concerned = |(root, analysis): (&PathBuf, &Analysis)| {
            let is_part = places.iter().any(|place| analysis.places().any(|part| part == place));
            (is_part || places.contains(root)).then(|| root.clone())
        };
        self.stale.extend(self.analyses.iter().filter_map(is_concerned));
        self.stale.extend(places.iter().filter(|place| self.documents.contains_key(*place)).cloned());
    }

    /// Reads changed decks again, and determines which documents are decks.
    ///
    /// A deck whose reading is cancelled stays marked.
    pub(super) fn refresh(&mut self) {
        if self.stale.is_empty() {
            return;
        }
        self.refresh_files();
        let roots: Vec<PathBuf> = self.documents.keys().cloned().collect();
        // Former decks first: the files they include need not be read separately.
        let (known, new): (Vec<_>, Vec<_>) = roots.into_iter().partition(|root| self.analyses.contains_key(root));
        for root in known.into_iter().chain(new) {
            if !self.stale.contains(&root) {
                continue;
            }
            if self.includer_of(&root).is_some() {
                self.analyses.remove(&root);
            } else {
                self.read_deck(&root);
            }
            self.stale.remove(&root);
        }
        let covered: Vec<PathBuf> =
            self.analyses.keys().filter(|root| self.includer_of(root).is_some()).cloned().collect();
        for root in covered {
            // Of two that include one another one remains a deck.
            if self.includer_of(&root).is_some() {
                self.analyses.remove(&root);
            }
        }
        // A document that is no longer included has become a deck.
        let uncovered = self.documents.keys().filter(|root| !self.analyses.contains_key(*root));
        let uncovered: Vec<PathBuf> = uncovered.filter(|root| self.includer_of(root).is_none()).cloned().collect();
        self.stale.extend(uncovered.iter().cloned());
        for root in uncovered {
            self.read_deck(&root);
        }
        self.stale.clear();
    }

    fn read_deck(&mut self, root: &Path) {
        let analysis = Analysis::of(root, &self.options_with_texts());
        self.load_files(&analysis);
        self.analyses.insert(root.to_owned(), analysis);
    }

    /// The deck that includes a document.
    fn includer_of(&self, place: &Path) -> Option<&Path> {
        let is_current = |root: &PathBuf| !self.stale.contains(root) && root != place;
        let mut others = self.analyses.iter().filter(|(root, _)| is_current(root));
        others.find(|(_, analysis)| analysis.places().any(|part| part == place)).map(|(root, _)| root.as_path())
    }

    /// The read options, with open documents and cached files.
    fn options_with_texts(&self) -> ReadOptions {
        let open = self.documents.iter().map(|(place, document)| (place, &document.text));
        let on_disk = self.files.iter().map(|(place, file)| (place, &file.text));
        let mut options = self.options.clone();
        for (place, text) in on_disk.chain(open) {
            options.overlay.insert(place.clone(), text.clone());
        }
        options.stop = self.stop.clone();
        options
    }

    /// A deck as it would be with another text in one of its files.
    pub(super) fn analyse_with(&self, analysis: &Analysis, place: &Path, text: &EditedText) -> Analysis {
        let mut options = self.options_with_texts();
        options.overlay.insert(place.to_owned(), text.clone());
        Analysis::of(analysis.place(SourceId::ROOT), &options)
    }

    /// A deck as it would be for another solver.
    pub(super) fn analyse_for(&self, analysis: &Analysis, dialect: Dialect) -> Analysis {
        Analysis::of(analysis.place(SourceId::ROOT), &self.options_with_texts().dialect(dialect))
    }

    /// Drops changed files from the cache, and marks the decks that include them.
    fn refresh_files(&mut self) {
        let is_other = |(place, file): &(&PathBuf, &FileOnDisk)| Stamp::of(place) != Some(file.stamp);
        let changed: Vec<PathBuf> = self.files.iter().filter(is_other).map(|(place, _)| place.clone()).collect();
        self.files.retain(|place, _| !changed.contains(place));
        self.files_changed(&changed);
    }

    /// Caches the files that a deck includes, so that they are not read at every keystroke.
    fn load_files(&mut self, analysis: &Analysis) {
        for place in analysis.places() {
            if self.documents.contains_key(place) || self.files.contains_key(place) {
                continue;
            }
            if let (Some(stamp), Ok(bytes)) = (Stamp::of(place), std::fs::read(place)) {
                self.files.insert(place.clone(), FileOnDisk { stamp, text: EditedText::new(&bytes) });
            }
        }
    }

    /// The decks with their findings.
    pub(super) fn analyses(&self) -> impl Iterator<Item = &Analysis> {
        self.analyses.values()
    }

    /// Faults of files of configuration.
    pub(super) fn faults(&self) -> impl Iterator<Item = &Fault> {
        self.analyses.values().filter_map(|analysis| analysis.fault.as_ref())
    }

    /// A document in the deck that it is or that includes it; the decks are read again where they changed.
    pub(super) fn view(&mut self, uri: &Uri) -> Option<View<'_>> {
        self.refresh();
        let place = place_of(uri);
        let own = self.analyses.get(&place);
        let analysis = own.or_else(|| self.analyses.get(self.includer_of(&place)?))?;
        let source = analysis.source_of(&place)?;
        Some(View { workspace: self, analysis, source })
    }

    /// The text of a file, open or not.
    pub(super) fn text(&self, place: &Path) -> Option<&EditedText> {
        let open = self.documents.get(place).map(|document| &document.text);
        open.or_else(|| self.files.get(place).map(|file| &file.text))
    }

    /// The name of a file in the editor.
    pub(super) fn uri(&self, place: &Path) -> Uri {
        self.documents.get(place).map_or_else(|| Uri(uri::uri_of(place)), |document| document.uri.clone())
    }

    /// The version of a document; `None` for a file that is not open.
    pub(super) fn version(&self, place: &Path) -> Option<i32> {
        self.documents.get(place).map(|document| document.version)
    }

    /// The place of bytes of a text as the editor counts it.
    pub(super) fn range_in(&self, text: &EditedText, start: u64, end: u64) -> Range {
        let position = |offset| position_of(text, offset, self.unit);
        Range { start: position(start), end: position(end.max(start)) }
    }
}

impl<'a> View<'a> {
    pub(super) fn place(&self) -> &'a Path {
        self.analysis.place(self.source)
    }

    /// The text of one of the files of the deck.
    pub(super) fn text_of(&self, source: SourceId) -> Option<&'a EditedText> {
        self.workspace.text(self.analysis.place(source))
    }

    /// The byte of a position of the document.
    pub(super) fn offset(&self, position: Position) -> u64 {
        self.text_of(self.source).map_or(0, |text| offset_of(text, position, self.workspace.unit))
    }

    pub(super) fn bytes(&self, range: Range) -> Span {
        let (start, end) = (self.offset(range.start), self.offset(range.end));
        Span::new(self.source, start.min(end), start.max(end))
    }

    /// The place before a byte of the document.
    pub(super) fn at(&self, offset: u64) -> Span {
        Span::new(self.source, offset, offset)
    }

    /// The line of a byte of the document.
    pub(super) fn line_at(&self, offset: u64) -> Option<(Span, &'a [u8])> {
        let text = self.text_of(self.source)?;
        let (number, start) = text.line_of(offset);
        let (_, line) = text.line(number);
        Some((Span::new(self.source, start, start + line.len() as u64), line))
    }

    /// A span in the units of the editor.
    pub(super) fn range(&self, span: Span) -> Range {
        self.workspace.stop.look();
        let text = self.text_of(span.source());
        text.map(|text| self.workspace.range_in(text, span.start(), span.end())).unwrap_or_default()
    }

    /// The bytes of a span, kept by the deck or not.
    pub(super) fn text(&self, span: Span) -> Cow<'a, [u8]> {
        self.workspace.stop.look();
        self.text_of(span.source()).map_or(Cow::Borrowed(&[]), |text| text.bytes(span.start()..span.end()))
    }

    /// The text of a span for display.
    pub(super) fn shown(&self, span: Span) -> String {
        String::from_utf8_lossy(&self.text(span)).into_owned()
    }

    /// The lines of a span of rows except comments, each with its bytes, including those not kept.
    pub(super) fn lines(&self, rows: Span) -> Vec<(Span, Vec<u8>)> {
        let bytes = self.text(rows);
        let found = lines(&bytes)
            .filter(|range| !matches!(line_kind(&bytes[range.clone()]), LineKind::Comment | LineKind::IndentedComment));
        let of = |range: std::ops::Range<usize>| {
            self.workspace.stop.look();
            let line = without_line_end(&bytes[range.clone()]);
            (rows.part(range.start..range.start + line.len()), line.to_vec())
        };
        found.map(of).collect()
    }

    /// A place as the editor names it.
    pub(super) fn location(&self, span: Span) -> Location {
        Location { uri: self.uri(span.source()), range: self.range(span) }
    }

    /// The name in the editor of one of the files of the deck.
    pub(super) fn uri(&self, source: SourceId) -> Uri {
        self.workspace.uri(self.analysis.place(source))
    }
}

pub(super) fn place_of(uri: &Uri) -> PathBuf {
    files::whole_path(&uri::path_of(&uri.0))
}

fn offset_of(text: &EditedText, position: Position, unit: ColumnUnit) -> u64 {
    let (start, line) = text.line(u64::from(position.line));
    start + unit.offset(line, u64::from(position.character)) as u64
}

fn position_of(text: &EditedText, offset: u64, unit: ColumnUnit) -> Position {
    let (line, start) = text.line_of(offset);
    let character = unit.count(&text.bytes(start..offset.max(start)));
    let narrow = |number: u64| u32::try_from(number).unwrap_or(u32::MAX);
    Position { line: narrow(line), character: narrow(character) }
}
