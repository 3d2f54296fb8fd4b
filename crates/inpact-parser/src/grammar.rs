//! The keyword language as data: the keywords, their parameters and rows, and how names are matched.
//!
//! Everything here comes from the files of `grammar/` in the repository: two lists of names, one TOML a keyword,
//! and one for every keyword with another meaning in CalculiX.
//! They are compiled in; a definition is parsed when it is first looked up.
//! Independent of decks, files and spans: it looks up names (S-11 to S-16) and the layout of rows (K-50 to K-56).

mod data;
mod definition;
mod dimension;
mod lookup;
mod nearest;
mod release;

pub use data::{Column, ColumnKind, Counted, Data, Layout, RowShape};
pub use definition::{Definition, Level, ParameterDefinition, ParameterKind, Product, ValueUse};
pub use dimension::{Base, Dimension};
pub use lookup::{Lookup, lookup_name};
pub use nearest::nearest as nearest_names;
pub use release::Release;

use lookup::Folded;
use std::collections::HashMap;
use std::sync::{LazyLock, OnceLock};

/// The keyword files: the name in full and the text of the TOML.
const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/keyword_files.rs"));

/// The keyword files that replace one of those for CalculiX.
const CALCULIX_FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/calculix_files.rs"));

/// Every keyword of Abaqus, one per line.
const ABAQUS_NAMES: &str = include_str!("../grammar/names/abaqus.txt");

/// Every keyword of CalculiX, one per line, without blanks.
const CALCULIX_NAMES: &str = include_str!("../grammar/names/calculix.txt");

/// The one keyword that CalculiX compares with the blank after it: `*GAP X` is not *GAP.
const ONLY_WHOLE: &[u8] = b"GAP";

/// Whose keyword language it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Dialect {
    /// Abaqus/Standard and Abaqus/Explicit.
    #[default]
    Abaqus,
    /// CalculiX ccx: fewer keywords, none abbreviated, no continuation of keyword lines, other columns in some tables.
    Calculix,
}

/// The keyword language of a dialect and a release: every keyword by name, with its definition if any.
#[derive(Debug)]
pub struct Grammar {
    dialect: Dialect,
    release: Release,
    /// Sorted by folded name, so that all names with one prefix are adjacent.
    keywords: Vec<Keyword>,
    /// The index of each folded name in `keywords`: nearly every keyword line has its name in full.
    exact: HashMap<Vec<u8>, KeywordId>,
    /// Folded and sorted.
    calculix_names: Vec<&'static str>,
}

/// A keyword, by its index in its [`Grammar`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct KeywordId(u16);

/// A keyword of the language.
#[derive(Debug)]
pub struct Keyword {
    /// The name in full: upper case, single blanks between its words.
    pub name: String,
    folded: String,
    source: Option<&'static str>,
    /// The dialect has it; an Abaqus keyword that CalculiX lacks is kept for messages.
    is_listed: bool,
    /// The definition is from another dialect, whose parameters may differ.
    is_borrowed: bool,
    /// Whose language it is.
    dialect: Dialect,
    definition: OnceLock<Option<Box<Definition>>>,
}

impl Grammar {
    /// The language of the newest release of Abaqus.
    pub fn builtin() -> &'static Self {
        static BUILTIN: LazyLock<Grammar> = LazyLock::new(|| Grammar::new(Dialect::Abaqus, Release::NEWEST));
        &BUILTIN
    }

    /// The language of a dialect; the release matters for Abaqus only.
    pub fn new(dialect: Dialect, release: Release) -> Self {
        let mut calculix_names: Vec<&str> = CALCULIX_NAMES.lines().collect();
        calculix_names.sort_unstable();
        let replaced = if dialect == Dialect::Calculix { CALCULIX_FILES } else { &[] };
        let defined = replaced.iter().chain(FILES).map(|(name, text)| Keyword::new(name, Some(*text)));
        let listed = ABAQUS_NAMES.lines().map(|name| Keyword::new(name, None));
        let further = if dialect == Dialect::Calculix { calculix_names.as_slice() } else { &[] };
        let further = further.iter().map(|name| Keyword::new(name, None));
        let mut keywords: Vec<Keyword> = defined.chain(listed).chain(further).collect();
        // Of two with the same name the first is kept: the sort is stable, and replacements come first.
        keywords.sort_by(|a, b| a.folded.cmp(&b.folded));
        keywords.dedup_by(|a, b| a.folded == b.folded);
        if dialect == Dialect::Calculix {
            for keyword in &mut keywords {
                keyword.is_listed = calculix_names.binary_search(&keyword.folded.as_str()).is_ok();
                keyword.dialect = dialect;
                keyword.is_borrowed = !replaced.iter().any(|(name, _)| *name == keyword.name);
            }
        }
        let place = |(index, keyword): (usize, &Keyword)| (keyword.folded.clone().into_bytes(), KeywordId::new(index));
        let exact = keywords.iter().enumerate().map(place).collect();
        Self { dialect, release, keywords, exact, calculix_names }
    }

    /// Whose language it is.
    pub fn dialect(&self) -> Dialect {
        self.dialect
    }

    /// The release of its language.
    pub fn release(&self) -> Release {
        self.release
    }

    /// Looks up a keyword as written (S-11 to S-13).
    ///
    /// Blanks, tabs and case are ignored; an exact name wins; otherwise the text must be a prefix of exactly one name of the
    /// release (S-15). CalculiX knows no abbreviations.
    /// A blank text, or one longer than every name (S-14), is unknown.
    pub fn keyword_named(&self, written: &[u8]) -> Lookup<KeywordId> {
        let Some(folded) = Folded::new(written) else {
            return Lookup::Unknown;
        };
        if let Some(id) = self.exact.get(folded.as_bytes()).copied().filter(|id| self.has(*id)) {
            return Lookup::Exact(id);
        }
        if self.dialect == Dialect::Calculix {
            return self.name_before(folded.as_bytes());
        }
        let from = self.keywords.partition_point(|keyword| keyword.folded.as_bytes() < folded.as_bytes());
        let candidates = (from..self.keywords.len())
            .take_while(|index| self.keywords[*index].folded.as_bytes().starts_with(folded.as_bytes()))
            .filter(|index| self.has(KeywordId::new(*index)));
        let candidates = candidates.map(|index| (KeywordId::new(index), &*self.keywords[index].folded));
        lookup::decide(folded.as_bytes(), candidates)
    }

    /// CalculiX compares only the letters of its own name: `*GAP CONDUCTANCES` is *GAP CONDUCTANCE (CX-03).
    fn name_before(&self, folded: &[u8]) -> Lookup<KeywordId> {
        let shorter = (1..folded.len()).rev().map(|length| &folded[..length]).filter(|name| *name != ONLY_WHOLE);
        let mut found = shorter.filter_map(|name| self.exact.get(name).copied().filter(|id| self.has(*id)));
        found.next().map_or(Lookup::Unknown, Lookup::Exact)
    }

    /// Whether the dialect and the release have the keyword.
    pub fn has(&self, id: KeywordId) -> bool {
        let keyword = self.keyword(id);
        keyword.is_listed && keyword.is_in(self.release)
    }

    /// Looks up a parameter of a keyword as written; returns its index in the definition's list (S-13, S-16).
    pub fn parameter_named(&self, definition: &Definition, written: &[u8]) -> Lookup<usize> {
        definition.parameter_named_in(written, self.release)
    }

    /// the keyword of an id of this grammar.
    pub fn keyword(&self, id: KeywordId) -> &Keyword {
        &self.keywords[usize::from(id.0)]
    }

    /// All keywords, by name.
    pub fn keywords(&self) -> impl Iterator<Item = (KeywordId, &Keyword)> {
        self.keywords.iter().enumerate().map(|(index, keyword)| (KeywordId::new(index), keyword))
    }

    /// The keyword of that full name, in whatever release and dialect; no abbreviation.
    pub fn id_of(&self, name: &str) -> Option<KeywordId> {
        let folded = Folded::new(name.as_bytes())?;
        self.exact.get(folded.as_bytes()).copied()
    }

    /// Whether the keyword may be a sub-option of *SURFACE INTERACTION (2.1).
    pub fn is_interaction_option(&self, id: KeywordId) -> bool {
        self.keyword(id).definition().is_some_and(|definition| definition.has_parent("SURFACE INTERACTION"))
    }

    /// Whether CalculiX has a keyword of that name, written in full.
    pub fn is_calculix_keyword(&self, written: &[u8]) -> bool {
        Folded::new(written).is_some_and(|folded| {
            self.calculix_names.binary_search_by(|name| name.as_bytes().cmp(folded.as_bytes())).is_ok()
        })
    }

    /// Suggestions for a misspelt keyword, the nearest first.
    ///
    /// It compares with every name: use it for messages, not for every line of a deck.
    pub fn nearest_keywords(&self, written: &str, at_most: usize) -> Vec<&str> {
        nearest::nearest(written.as_bytes(), self.keywords.iter().map(|keyword| keyword.name.as_str()), at_most)
    }
}

impl KeywordId {
    fn new(index: usize) -> Self {
        Self(u16::try_from(index).expect("there are fewer than 65536 keywords"))
    }
}

impl Keyword {
    fn new(name: &str, source: Option<&'static str>) -> Self {
        let folded = name.chars().filter(|character| !character.is_ascii_whitespace()).collect();
        Self {
            name: name.to_owned(),
            folded,
            source,
            is_listed: true,
            is_borrowed: false,
            dialect: Dialect::Abaqus,
            definition: OnceLock::new(),
        }
    }

    /// The definition; `None` when only the name is known.
    pub fn definition(&self) -> Option<&Definition> {
        // A test loads every compiled-in definition, so errors cannot occur here.
        let parse = || {
            let mut definition = Definition::parse(self.source?).ok()?;
            if self.is_borrowed {
                definition.loosen();
            }
            if self.dialect == Dialect::Calculix {
                definition.match_in_full();
            }
            Some(Box::new(definition))
        };
        self.definition.get_or_init(parse).as_deref()
    }

    /// Whether the release has the keyword; true where that is unknown.
    pub fn is_in(&self, release: Release) -> bool {
        self.definition().is_none_or(|definition| release.is_within(definition.since, definition.until))
    }
}
