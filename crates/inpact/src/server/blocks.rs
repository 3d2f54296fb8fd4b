//! The blocks of a document: lookup by position, with keyword and level in the deck.

use super::analysis::Analysis;
use super::workspace::View;
use inpact_parser::deck::{Block, KeywordLine, Parameter};
use inpact_parser::expression::substitute;
use inpact_parser::grammar::{Definition, Level};
use inpact_parser::span::{SourceId, Span};

/// A block with a known keyword, at least by name.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry<'a> {
    pub(super) block: &'a Block,
    pub(super) keyword: &'a KeywordLine,
    /// The keyword in full.
    pub(super) name: &'a str,
    pub(super) definition: Option<&'a Definition>,
}

impl<'a> Entry<'a> {
    /// `None` for rows without a keyword, and for an unknown keyword.
    pub(super) fn of(analysis: &'a Analysis, block: &'a Block) -> Option<Self> {
        let keyword = block.keyword.as_ref()?;
        let entry = analysis.settings.grammar.keyword(keyword.id()?);
        Some(Self { block, keyword, name: &entry.name, definition: entry.definition() })
    }

    /// The parameter of that name in force, the last one.
    pub(super) fn parameter(&self, name: &str) -> Option<Parameter> {
        let definition = self.definition?;
        let is_meant = |given: &Parameter| given.index().is_some_and(|index| definition.parameters[index].name == name);
        self.keyword.parameters().rev().find(is_meant)
    }

    pub(super) fn is_given(&self, name: &str) -> bool {
        self.parameter(name).is_some()
    }

    /// The value of a parameter of that name as written, whether or not the grammar has the parameter.
    pub(super) fn value_written(&self, view: View<'_>, name: &str) -> Option<Span> {
        let is_meant = |given: &Parameter| is_same(&view.text(given.name), name);
        self.keyword.parameters().rev().find(is_meant)?.value
    }

    /// The spans of all its rows, in all files.
    pub(super) fn rows(&self) -> impl Iterator<Item = Span> + use<'a> {
        self.block.all_rows()
    }
}

/// Whether a word is that name, ignoring blanks and case (S-11).
pub(super) fn is_same(written: &[u8], name: &str) -> bool {
    let fold = |byte: &u8| (!byte.is_ascii_whitespace()).then(|| byte.to_ascii_uppercase());
    written.iter().filter_map(fold).eq(name.as_bytes().iter().filter_map(fold))
}

/// All blocks of the deck whose keyword is known, in reading order.
pub(super) fn entries(analysis: &Analysis) -> impl Iterator<Item = Entry<'_>> {
    analysis.deck.blocks().iter().filter_map(|block| {
        analysis.settings.stop.look();
        Entry::of(analysis, block)
    })
}

/// The block of a byte of a document; at a boundary the one that begins there.
pub(super) fn block_at(analysis: &Analysis, source: SourceId, offset: u64) -> Option<&Block> {
    let blocks = analysis.deck.blocks().iter().filter(|block| block.rows().source() == source);
    blocks.take_while(|block| block.span().start() <= offset).last()
}

/// The block with a keyword to whose rows a byte belongs, possibly in another file.
pub(super) fn owner_at(analysis: &Analysis, source: SourceId, offset: u64) -> Option<Entry<'_>> {
    let block = block_at(analysis, source, offset)?;
    if block.keyword.is_some() {
        return Entry::of(analysis, block);
    }
    let owner = analysis.deck.blocks().iter().find(|owner| owner.continued_in().contains(&block.rows()))?;
    Entry::of(analysis, owner)
}

/// A text with every `<parameter>` in it replaced; one without a value is unchanged.
pub(super) fn substituted(analysis: &Analysis, text: &str) -> String {
    substitute(text, &analysis.model.parameters).map_or_else(|_| text.to_owned(), |text| text.trim().to_owned())
}

/// The keywords that open a level and close it again (S-71 to S-74).
pub(super) const LEVELS: [(&str, &str, Level); 4] = [
    ("PART", "END PART", Level::Part),
    ("ASSEMBLY", "END ASSEMBLY", Level::Assembly),
    ("INSTANCE", "END INSTANCE", Level::Instance),
    ("STEP", "END STEP", Level::Step),
];

/// Opens the level that a keyword opens, of which something is kept, or closes the one that it closes.
pub(super) fn pass_level<T>(open: &mut Vec<(Level, T)>, keyword: &str, kept: impl Fn() -> T) {
    for (opens, closes, level) in LEVELS {
        if keyword == opens {
            open.push((level, kept()));
        } else if keyword == closes
            && let Some(at) = open.iter().rposition(|(other, _)| *other == level)
        {
            open.truncate(at);
        }
    }
}

/// Blocks that are open at a place of a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Context<'a> {
    pub(super) level: Level,
    /// The last keyword above that is not a sub-option of an interaction.
    pub(super) parent: Option<&'a str>,
}

/// Blocks that are open where a line begins.
pub(super) fn context_at(analysis: &Analysis, source: SourceId, offset: u64) -> Context<'_> {
    let mut open: Vec<(Level, ())> = Vec::new();
    let mut parent = None;
    for entry in entries(analysis) {
        let span = entry.keyword.span;
        if span.source() == source && offset <= span.start() {
            break;
        }
        pass_level(&mut open, entry.name, || ());
        let grammar = analysis.settings.grammar;
        let is_option = entry.keyword.id().is_some_and(|id| grammar.is_interaction_option(id));
        if !is_option && !matches!(entry.name, "INCLUDE" | "PARAMETER") {
            parent = Some(entry.name);
        }
    }
    Context { level: open.last().map_or(Level::Model, |(level, ())| *level), parent }
}
