//! Inserts included files in place (S-50 to S-54).
//!
//! Each file is scanned separately; its blocks then follow the *INCLUDE that named it.
//! Rows before the first keyword of an included file, and rows after the *INCLUDE itself, continue the block that is
//! open there (S-51). A file that could not be read is recorded in [`Include::outcome`], and the rest of the deck is still read.

use super::scan::LeadingRows;
use super::{Block, Deck, Excerpts, KeywordLine, RowsKept, ScanOptions, Scanner, Source};
use crate::grammar::Dialect;
use crate::span::{SourceId, Span};
use std::collections::HashMap;
use std::path::PathBuf;

/// The maximum nesting of files, not counting the deck itself: five in Abaqus (S-52), nine in CalculiX (CX-06).
pub fn max_levels(dialect: Dialect) -> usize {
    match dialect {
        Dialect::Abaqus => 5,
        Dialect::Calculix => 9,
    }
}

/// The maximum number of files that a deck may include in total: a bound against files that include one another repeatedly.
pub const MAX_FILES: usize = 200_000;

/// The maximum number of bytes of files that are read again, in addition to sixteen times the bytes read for the first time.
///
/// Files of a few kilobytes that include the next level a hundred times on each of five levels would amount to
/// terabytes; a deck in which a mesh is included for each of its parts stays below.
const MAX_BYTES_AGAIN: u64 = 16 << 20;

/// An *INCLUDE of the deck.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Include {
    /// Its keyword line.
    pub keyword: Span,
    /// The name of the file as written; `None` when INPUT is missing.
    pub name: Option<Span>,
    /// The outcome.
    pub outcome: IncludeOutcome,
}

/// Outcomes of an *INCLUDE.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum IncludeOutcome {
    /// It was read as this source.
    Read(SourceId),
    /// It was not found or could not be read, for this reason.
    Unreadable(String),
    /// It lies outside of this folder, beyond which nothing may be read.
    Outside(String),
    /// It lies too many levels deep ([`max_levels`]).
    TooDeep,
    /// The limit of included files is reached ([`MAX_FILES`]).
    TooMany,
    /// It is being read already: the files include one another.
    Cycle,
    /// PASSWORD is given: the file is encrypted (S-53).
    Encrypted,
    /// INPUT is missing.
    Unnamed,
}

/// Source of included files; the implementation does the input and output.
pub trait IncludedFiles {
    /// The identity of the deck among files; `None` when it is not a file.
    fn deck(&self) -> Option<PathBuf>;

    /// The root folder, if it does not contain the file; checked before the file is searched.
    fn outside(&mut self, _name: &str, _from: &str) -> Option<String> {
        None
    }

    /// Whether the lines of a file that was found may be quoted around findings.
    fn excerpts(&self, _file: &FoundFile) -> Excerpts {
        Excerpts::Shown
    }

    /// Finds the file written as `name` in the source called `from`.
    ///
    /// # Errors
    /// The reason why it was not found, for users.
    fn find(&mut self, name: &str, from: &str) -> Result<FoundFile, String>;

    /// Pushes the bytes of a file that was found.
    ///
    /// # Errors
    /// The reason why they cannot be read, for users.
    fn read(&mut self, file: &FoundFile, scanner: &mut Scanner<'_>) -> Result<(), String>;
}

/// A file that an *INCLUDE names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundFile {
    /// The name in diagnostics.
    pub name: String,
    /// The identity of the file.
    pub path: PathBuf,
}

impl Deck {
    /// Reads included files recursively and inserts them in place.
    #[must_use]
    pub fn with_includes(self, options: ScanOptions<'_>, files: &mut dyn IncludedFiles) -> Self {
        let has_includes = |block: &Block| is_include(block, options);
        if !self.blocks.iter().any(has_includes) {
            return self;
        }
        let path = files.deck().into_iter().collect();
        let first_bytes = self.sources.iter().map(Source::length).sum();
        let deck = Self { blocks: Vec::new(), ..self };
        let mut assembly = Assembly {
            options,
            files,
            deck,
            open: None,
            path,
            level: 0,
            lengths: HashMap::new(),
            first_bytes,
            bytes_again: 0,
        };
        assembly.place(self.blocks);
        assembly.deck
    }
}

fn is_include(block: &Block, options: ScanOptions<'_>) -> bool {
    block.keyword_id().is_some_and(|id| options.grammar.keyword(id).name == "INCLUDE")
}

/// A deck in which the included files are being placed.
struct Assembly<'a> {
    options: ScanOptions<'a>,
    files: &'a mut dyn IncludedFiles,
    deck: Deck,
    /// The last block that began with a keyword of its own: rows without one belong to it.
    open: Option<usize>,
    /// The files that are being read, outermost first.
    path: Vec<PathBuf>,
    /// The depth of inclusion.
    level: usize,
    /// The lengths of the files read so far, in bytes.
    lengths: HashMap<PathBuf, u64>,
    /// The bytes of the deck and of the files that have been read, each counted once.
    first_bytes: u64,
    /// The bytes of files that were read before.
    bytes_again: u64,
}

impl Assembly<'_> {
    fn place(&mut self, blocks: Vec<Block>) {
        for mut block in blocks {
            if !is_include(&block, self.options) {
                self.push(block);
                continue;
            }
            let rows = block.rows();
            block.set_rows_length(0);
            let keyword = block.keyword.clone();
            // Not `push`: the block that was open before stays open.
            self.deck.blocks.push(block);
            if let Some(keyword) = keyword {
                let include = self.include(&keyword);
                self.deck.includes.push(include);
            }
            if !rows.is_empty() {
                self.push(Block::new(None, rows, RowsKept::All));
            }
        }
    }

    fn push(&mut self, block: Block) {
        let index = self.deck.blocks.len();
        match (&block.keyword, self.open) {
            (Some(_), _) => self.open = Some(index),
            (None, Some(open)) => self.deck.blocks[open].continue_in(block.rows()),
            (None, None) => {}
        }
        self.deck.blocks.push(block);
    }

    fn include(&mut self, keyword: &KeywordLine) -> Include {
        let name = match self.options.grammar.dialect() {
            // FILE is accepted for INPUT: decks with it run.
            Dialect::Abaqus => self.value_of(keyword, "INPUT").or_else(|| self.value_of(keyword, "FILE")),
            // For CalculiX everything after the first `=` is the name, commas included, unless it is quoted (CX-06).
            Dialect::Calculix => {
                let end = keyword.visible_span(&self.deck).end();
                let value = keyword.parameters().find_map(|parameter| parameter.value);
                value.map(|value| Span::new(value.source(), value.start(), end))
            }
        };
        let name = name.filter(|name| !name.is_empty());
        let outcome = match name {
            _ if self.given(keyword, "PASSWORD").is_some() => IncludeOutcome::Encrypted,
            None => IncludeOutcome::Unnamed,
            Some(name) => self.read_file(name, keyword.span),
        };
        Include { keyword: keyword.span, name, outcome }
    }

    fn read_file(&mut self, name: Span, keyword: Span) -> IncludeOutcome {
        if self.level >= max_levels(self.options.grammar.dialect()) {
            return IncludeOutcome::TooDeep;
        }
        if self.deck.sources.len() > MAX_FILES {
            return IncludeOutcome::TooMany;
        }
        let written = self.deck.shown(name);
        let without_blanks = |text: &str| text.split_ascii_whitespace().collect::<String>();
        let quoted = written.strip_prefix('"');
        // Blanks are ignored outside quotes (S-22), for CalculiX also inside, and text after the closing quote is ignored (CX-06).
        let written = match (self.options.grammar.dialect(), quoted) {
            (Dialect::Calculix, Some(rest)) => without_blanks(rest.split('"').next().unwrap_or_default()),
            (Dialect::Abaqus, Some(rest)) if rest.ends_with('"') => rest[..rest.len() - 1].to_owned(),
            _ => without_blanks(&written),
        };
        let from = self.deck.source(name.source()).name();
        if let Some(folder) = self.files.outside(&written, from) {
            return IncludeOutcome::Outside(folder);
        }
        let found = match self.files.find(&written, from) {
            Ok(found) => found,
            Err(reason) => return IncludeOutcome::Unreadable(reason),
        };
        if self.path.contains(&found.path) {
            return IncludeOutcome::Cycle;
        }
        let length_before = self.lengths.get(&found.path).copied();
        let allowed = MAX_BYTES_AGAIN.saturating_add(self.first_bytes.saturating_mul(16));
        if length_before.is_some_and(|length| self.bytes_again.saturating_add(length) > allowed) {
            let again = self.bytes_again;
            return IncludeOutcome::Unreadable(format!(
                "files that are included more than once come to {again} bytes already, and {allowed} are the most that is read again: include it once"
            ));
        }
        let id = SourceId(u32::try_from(self.deck.sources.len()).unwrap_or(u32::MAX));
        let keeps_leading = match self.open {
            Some(open) if self.deck.blocks[open].rows_kept == RowsKept::None => LeadingRows::None,
            Some(_) => LeadingRows::All,
            None => LeadingRows::Some,
        };
        let mut scanner = Scanner::for_source(id, &found.name, self.options, keeps_leading);
        if let Err(reason) = self.files.read(&found, &mut scanner) {
            return IncludeOutcome::Unreadable(reason);
        }
        let mut included = scanner.finish();
        let length = included.sources.iter().map(Source::length).sum();
        match length_before {
            Some(_) => self.bytes_again += length,
            None => self.first_bytes += length,
        }
        self.lengths.insert(found.path.clone(), length);
        let excerpts = self.files.excerpts(&found);
        for source in &mut included.sources {
            (source.included_by, source.excerpts) = (Some(keyword), excerpts);
        }
        self.deck.sources.append(&mut included.sources);
        self.deck.notes.append(&mut included.notes);
        self.deck.directives.append(&mut included.directives);
        self.path.push(found.path);
        self.level += 1;
        self.place(included.blocks);
        self.level -= 1;
        self.path.pop();
        IncludeOutcome::Read(id)
    }

    fn value_of(&self, keyword: &KeywordLine, parameter: &str) -> Option<Span> {
        self.given(keyword, parameter)?.value.filter(|value| !value.is_empty())
    }

    fn given(&self, keyword: &KeywordLine, parameter: &str) -> Option<super::Parameter> {
        keyword.given(parameter, self.options.grammar.keyword(keyword.id()?).definition()?)
    }
}
