//! From the blocks of a deck to its [`Model`].
//!
//! Walks the blocks once, in reading order, and tracks the context of each: part, step, interaction.
//! Collects problems and never stops at one (T-44).

mod constants;
mod entry;
mod interaction;
mod parameters;
mod uses;

use super::{Interaction, Model, SharedText};
use crate::deck::{Block, Deck, KeywordLine};
use crate::expression::Parameters;
use crate::grammar::{Grammar, KeywordId, Level};
use crate::problem::{Problem, ProblemKind};
use crate::span::Span;
use entry::Entry;
use std::collections::HashSet;
use std::sync::Arc;

/// The most field variables a table may depend on here; a larger DEPENDENCIES is read as this.
///
/// The manual gives no limit. Without one a typing error could request gigabytes.
pub const MAX_FIELD_VARIABLES: usize = 1000;

/// Reads the model of a deck, and reports problems.
pub fn read(deck: &Deck, grammar: &Grammar) -> (Model, Vec<Problem>) {
    read_watched(deck, grammar, &|| ())
}

/// The same, with a call of `watch` before each block, which may unwind to cancel.
pub fn read_watched(deck: &Deck, grammar: &Grammar, watch: &dyn Fn()) -> (Model, Vec<Problem>) {
    let mut reader = Reader {
        deck,
        grammar,
        model: Model::default(),
        problems: Vec::new(),
        interaction: None,
        columns: Vec::new(),
        names: HashSet::new(),
        parent: None,
        closed_by: None,
        levels: Vec::new(),
        steps: 0,
        explicit: false,
        has_explicit_step: deck.blocks().iter().any(|block| is_explicit_procedure(block, grammar)),
    };
    reader.model.parameters = Parameters::of_release(grammar.release());
    // All definitions of the deck come first, anywhere (S-61).
    for block in deck.blocks() {
        reader.define_parameters(block);
    }
    for block in deck.blocks() {
        watch();
        reader.read_block(block);
    }
    reader.close_interaction(None);
    (reader.model, reader.problems)
}

struct Reader<'a> {
    deck: &'a Deck,
    grammar: &'a Grammar,
    model: Model,
    problems: Vec<Problem>,
    /// The *SURFACE INTERACTION whose block is open.
    interaction: Option<Interaction>,
    /// The interned lists of column names of tables.
    columns: Vec<Arc<[String]>>,
    /// The interned names of keywords and parameters.
    names: HashSet<SharedText>,
    /// The last keyword that is not a sub-option of an interaction.
    parent: Option<KeywordId>,
    /// The keyword line that closed the last interaction.
    closed_by: Option<Span>,
    /// The open levels below the model, with the lines that opened them.
    levels: Vec<(Level, Span)>,
    steps: usize,
    /// The open step is one of Abaqus/Explicit, where interactions may occur in a step (S-73).
    explicit: bool,
    /// Some step of the deck is one of Abaqus/Explicit: then user interactions are its (K-03).
    has_explicit_step: bool,
}

fn is_explicit_procedure(block: &Block, grammar: &Grammar) -> bool {
    let (Some(keyword), Some(id)) = (&block.keyword, block.keyword_id()) else { return false };
    let Some(definition) = grammar.keyword(id).definition().filter(|definition| definition.procedure) else {
        return false;
    };
    keyword.given("EXPLICIT", definition).is_some()
}

impl<'a> Reader<'a> {
    fn read_block(&mut self, block: &'a Block) {
        // An unknown keyword leaves an interaction open: it is more often a typo in a sub-option than the end of the block.
        let Some(keyword) = &block.keyword else { return };
        let Some(id) = keyword.id() else {
            if is_likely_interaction(self.deck.text(keyword.name())) {
                self.close_interaction(Some(keyword.visible_span(self.deck)));
            }
            return;
        };
        self.check_references(keyword);
        let entry = self.grammar.keyword(id);
        let Some(definition) = entry.definition() else {
            return self.leave_interaction(id, keyword);
        };
        let option = Entry { id, name: &entry.name, definition, keyword, block };
        if self.grammar.is_interaction_option(id) {
            return self.read_sub_option(option);
        }
        match option.name {
            // Legal at every level and inside every block (S-51, S-66).
            "INCLUDE" | "PARAMETER" => return,
            "SURFACE INTERACTION" => return self.open_interaction(option),
            _ => self.leave_interaction(id, keyword),
        }
        match option.name {
            "PART" => self.levels.push((Level::Part, keyword.span)),
            "INSTANCE" => self.levels.push((Level::Instance, keyword.span)),
            "ASSEMBLY" => self.levels.push((Level::Assembly, keyword.span)),
            "STEP" => self.begin_step(keyword),
            "END STEP" => self.end_level(Level::Step),
            "END PART" => self.end_level(Level::Part),
            "END INSTANCE" => self.end_level(Level::Instance),
            "END ASSEMBLY" => self.end_level(Level::Assembly),
            "SURFACE" => self.read_surface(option),
            "PHYSICAL CONSTANTS" => self.read_constants(option),
            "CONTACT PAIR" => self.read_contact_pair(option),
            "CONTACT PROPERTY ASSIGNMENT" => self.read_property_assignments(option),
            _ if definition.procedure => self.read_procedure(option),
            _ => {}
        }
    }

    // Levels and steps (S-71 to S-74).

    fn begin_step(&mut self, keyword: &KeywordLine) {
        // A step that was never ended (18 in the list of what decks do) ends here.
        self.end_level(Level::Step);
        self.steps += 1;
        self.explicit = false;
        self.levels.push((Level::Step, keyword.span));
    }

    fn end_level(&mut self, level: Level) {
        if let Some(open) = self.levels.iter().rposition(|(open, _)| *open == level) {
            self.levels.truncate(open);
        }
    }

    fn level(&self) -> (Level, Option<Span>) {
        self.levels.last().map_or((Level::Model, None), |(level, span)| (*level, Some(*span)))
    }

    /// Checks that the option may occur at this level; reports it when it may not.
    fn check_level(&mut self, option: Entry<'_>) -> bool {
        let (level, opened_by) = self.level();
        let in_explicit_step = level == Level::Step && self.explicit;
        if option.definition.levels.is_empty() || option.definition.levels.contains(&level) || in_explicit_step {
            return true;
        }
        self.report(ProblemKind::WrongLevel { keyword: option.id, level, opened_by }, option);
        false
    }

    fn report(&mut self, kind: ProblemKind, option: Entry<'_>) {
        let span = option.keyword.visible_span(self.deck);
        self.problems.push(Problem { kind, span, keyword: option.keyword.span });
    }
}

/// Whether an unknown keyword is probably a misspelt *SURFACE INTERACTION, whose sub-options do not belong to the previous one.
fn is_likely_interaction(text: &[u8]) -> bool {
    let letters = text.iter().filter(|byte| !byte.is_ascii_whitespace()).map(u8::to_ascii_uppercase);
    let letters: Vec<u8> = letters.take(40).collect();
    letters.starts_with(b"SURF") && letters.windows(3).any(|piece| piece == b"INT")
}
