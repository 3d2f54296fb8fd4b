//! One style for the blocks of contact interfaces; every other byte of a deck stays as it is.
//!
//! [`format()`] goes from a [`Deck`] to the bytes of one of its files, independent of the file system and of the model.
//! Blocks that are formatted:
//!
//! | blocks | keyword line | rows |
//! |---|---|---|
//! | *SURFACE INTERACTION and its sub-options, in its block or stray (2.1) | yes | those the grammar describes |
//! | *CONTACT PAIR (C-02), *CONTACT PROPERTY ASSIGNMENT (C-05) | yes | yes |
//! | any other, sub-options of another keyword such as *MATERIAL or *CHANGE FRICTION among them | no | no |
//!
//! The style: keyword and parameters in full, in upper case, with single blanks; `, ` between items; the items of the rows of a
//! table aligned in columns, numbers by their decimal points.
//! Line breaks, line ends, comments, blank lines and the spelling of every number and value are preserved.
//! A malformed line is left unchanged, and so is one that would grow beyond 256 characters (S-06).
//! The model before and after is the same, and formatting is idempotent.

mod columns;
mod keyword_line;
mod rows;

use crate::deck::{Block, Deck};
use crate::grammar::{Definition, Grammar, KeywordId};
use crate::span::SourceId;
use inpact_diagnostics::{Edit, apply};

/// The maximum number of characters of a keyword or data line (S-06).
const LINE_CHARACTERS: usize = 256;

/// The blocks that are formatted besides *SURFACE INTERACTION and its sub-options.
const USES_OF_INTERACTIONS: [&str; 2] = ["CONTACT PAIR", "CONTACT PROPERTY ASSIGNMENT"];

/// The formatted bytes of a source file of the deck.
///
/// The deck must have been scanned with [`Keep::Everything`](crate::deck::Keep::Everything), in the language of
/// `grammar`; rows that were not kept would be missing.
pub fn format(deck: &Deck, source: SourceId, grammar: &Grammar) -> Vec<u8> {
    apply(&deck.print(source), &format_edits(deck, source, grammar))
}

/// The edits that format a source file of the deck: a keyword line or the rows of a block each, in order.
///
/// Only interpreted rows are formatted: a deck that keeps these gives all edits.
pub fn format_edits(deck: &Deck, source: SourceId, grammar: &Grammar) -> Vec<Edit> {
    let mut place = Place { grammar, in_interaction: false, parent: None };
    let mut edits = Vec::new();
    for block in deck.blocks() {
        // Blocks of other files count too: they may open or close the interaction.
        let definition = place.enter(block);
        let (Some(definition), Some(keyword)) = (definition, &block.keyword) else { continue };
        if block.rows().source() != source {
            continue;
        }
        let line = keyword_line::format(deck, keyword, definition, grammar.dialect()).map(|line| (keyword.span, line));
        let rows = rows::format(deck, block, definition).map(|rows| (block.rows(), rows));
        let changed = line.into_iter().chain(rows).filter(|(span, formatted)| deck.text(*span) != formatted);
        edits.extend(changed.map(|(span, formatted)| Edit::new(span, formatted)));
    }
    edits
}

/// The context in a deck that decides which blocks are formatted.
struct Place<'a> {
    grammar: &'a Grammar,
    /// Whether a *SURFACE INTERACTION is open.
    in_interaction: bool,
    /// The last keyword that is not a sub-option of an interaction.
    parent: Option<KeywordId>,
}

impl<'a> Place<'a> {
    /// Advances to a block; returns its definition when it is formatted.
    fn enter(&mut self, block: &Block) -> Option<&'a Definition> {
        let id = block.keyword_id()?;
        let keyword = self.grammar.keyword(id);
        if self.grammar.is_interaction_option(id) {
            return keyword.definition().filter(|definition| self.in_interaction || self.is_stray(definition));
        }
        match keyword.name.as_str() {
            // Legal inside every block (S-51, S-66).
            "INCLUDE" | "PARAMETER" => return None,
            name => self.in_interaction = name == "SURFACE INTERACTION",
        }
        self.parent = Some(id);
        let is_formatted = self.in_interaction || USES_OF_INTERACTIONS.contains(&keyword.name.as_str());
        keyword.definition().filter(|_| is_formatted)
    }

    /// Whether a sub-option outside of an interaction belongs to no other option either.
    fn is_stray(&self, definition: &Definition) -> bool {
        let has_other_parent =
            self.parent.is_some_and(|parent| definition.has_parent(&self.grammar.keyword(parent).name));
        !has_other_parent && !definition.has_parent("MATERIAL")
    }
}
