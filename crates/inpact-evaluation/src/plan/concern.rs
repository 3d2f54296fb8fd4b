//! Which findings of a check concern the interactions of an evaluation.

use inpact_parser::deck::Deck;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{Model, Name};
use inpact_parser::span::Span;
use inpact_validation::Diagnostic;

/// The findings that lie in the blocks of interactions of these names, their sub-options included.
///
/// An unknown keyword counts to the interaction it follows: it may be a misspelt sub-option.
pub fn concerning<'a>(
    diagnostics: &'a [Diagnostic],
    deck: &Deck,
    grammar: &Grammar,
    model: &Model,
    names: &[&Name],
) -> Vec<&'a Diagnostic> {
    let regions = regions(deck, grammar, model, names);
    let concerns = |found: &&Diagnostic| {
        let span = found.primary.span;
        regions
            .iter()
            .any(|region| region.source == span.source && region.start <= span.start && span.start < region.end)
    };
    diagnostics.iter().filter(concerns).collect()
}

/// The spans of the blocks that belong to the interactions of these names.
fn regions(deck: &Deck, grammar: &Grammar, model: &Model, names: &[&Name]) -> Vec<Span> {
    let wanted = model.all_interactions().filter(|interaction| names.contains(&&interaction.name));
    let starts: Vec<Span> = wanted.map(|interaction| interaction.span).collect();
    let begins = |span: Span| starts.iter().any(|start| start.source == span.source && start.start == span.start);
    let mut is_within = false;
    let mut regions = Vec::new();
    for block in deck.blocks() {
        let name = block.keyword_id().map(|id| grammar.keyword(id).name.as_str());
        is_within = match (name, block.keyword_id()) {
            (Some("SURFACE INTERACTION"), _) => begins(block.span_of_keyword()),
            (_, Some(id)) => is_within && grammar.is_interaction_option(id),
            (_, None) => is_within,
        };
        if is_within {
            regions.push(block.span());
        }
    }
    regions
}
