//! Which findings of a check concern the interactions of an evaluation: those about their inputs, including possible ones.
//!
//! The one place that decides which errors of a deck are errors of a run.
//!
//! | input of an interaction | findings that concern it |
//! |---|---|
//! | its block and those of its sub-options, including rows in other files | all |
//! | an *INCLUDE inside or directly after these, which may continue them (S-51) | all |
//! | a misplaced sub-option after it, which may be meant for it | K012, K013 |
//! | *PARAMETER, and every *INCLUDE, where a `<name>` occurs in these blocks (S-61, S-65) | all |
//! | *PHYSICAL CONSTANTS, where it radiates (2.6) | all |
//! | the procedure that decides between steady and transient, unless the run sets it | all |

use inpact_parser::deck::{Block, Deck};
use inpact_parser::expression::references;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{Model, Name, Procedure, Regime};
use inpact_parser::span::{SourceId, Span};
use inpact_validation::Diagnostic;
use std::collections::HashSet;

/// The findings about inputs, or possible inputs, of the interactions of these names.
///
/// An unknown keyword belongs to the interaction it follows: it may be a misspelt sub-option.
/// `chosen` is the regime that the run sets, overriding the procedures.
pub fn concerning<'a>(
    diagnostics: &'a [Diagnostic],
    deck: &Deck,
    grammar: &Grammar,
    model: &Model,
    names: &[&Name],
    chosen: Option<Regime>,
) -> Vec<&'a Diagnostic> {
    let mut regions = regions(deck, grammar, model, names);
    if chosen.is_none() {
        regions.extend(deciding(deck, model, names));
    }
    // Blocks do not overlap: only the last one that begins before a place can contain it.
    regions.sort_unstable_by_key(|region| (region.span.source(), region.span.start()));
    let concerns = |found: &&Diagnostic| {
        let span = found.primary.span;
        let starts_before =
            |region: &Region| (region.span.source(), region.span.start()) <= (span.source(), span.start());
        let region = regions.partition_point(starts_before).checked_sub(1).map(|before| regions[before]);
        region.is_some_and(|region| {
            let is_inside = region.span.source() == span.source() && span.start() < region.span.end();
            is_inside && (region.part == Part::Feeds || matches!(found.code, "K012" | "K013"))
        })
    };
    diagnostics.iter().filter(concerns).collect()
}

/// A block related to the interactions of an evaluation.
#[derive(Debug, Clone, Copy)]
struct Region {
    span: Span,
    part: Part,
}

/// Relation of a block to them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// It defines them, or their inputs.
    Feeds,
    /// It does so if it is misplaced.
    FeedsIfMisplaced,
}

/// The blocks that have to do with the interactions of these names.
fn regions(deck: &Deck, grammar: &Grammar, model: &Model, names: &[&Name]) -> Vec<Region> {
    let names: HashSet<&Name> = names.iter().copied().collect();
    let wanted = || model.all_interactions().filter(|interaction| names.contains(&interaction.name));
    let starts: HashSet<(SourceId, u64)> = wanted().map(|of| (of.span.source(), of.span.start())).collect();
    let begins = |span: Span| starts.contains(&(span.source(), span.start()));
    let radiates = wanted().any(|interaction| interaction.gap_radiation().is_some());
    let (mut is_within, mut was_last, mut has_symbols) = (false, false, false);
    let mut regions = Vec::new();
    let mut of_symbols = Vec::new();
    for block in deck.blocks() {
        let name = block.keyword_id().map(|id| grammar.keyword(id).name.as_str());
        match (name, block.keyword_id()) {
            // They may occur inside any block (S-51, S-66).
            (Some("INCLUDE" | "PARAMETER"), _) => {}
            (Some("SURFACE INTERACTION"), _) => {
                is_within = begins(block.span_of_keyword());
                was_last = is_within;
            }
            (_, Some(id)) => is_within = is_within && grammar.is_interaction_option(id),
            (_, None) => {}
        }
        let span = block.span();
        let is_option = block.keyword_id().is_some_and(|id| grammar.is_interaction_option(id));
        match name {
            Some("PARAMETER") => of_symbols.push(Region { span, part: Part::Feeds }),
            Some("INCLUDE") if !is_within => of_symbols.push(Region { span, part: Part::Feeds }),
            Some("PHYSICAL CONSTANTS") if radiates => regions.push(Region { span, part: Part::Feeds }),
            _ if is_within => {
                has_symbols |= names_parameters(deck, block);
                regions.push(Region { span, part: Part::Feeds });
            }
            _ if was_last && is_option => regions.push(Region { span, part: Part::FeedsIfMisplaced }),
            _ => {}
        }
    }
    if has_symbols {
        regions.append(&mut of_symbols);
    }
    regions
}

/// The procedures that decide whether the interactions of these names are steady or transient.
fn deciding(deck: &Deck, model: &Model, names: &[&Name]) -> Vec<Region> {
    let mut wanted = names.iter().filter_map(|name| model.interactions.get(name));
    let has_current = wanted.any(|interaction| interaction.gap_electrical_conductance.is_some());
    let last = |solves: fn(&Procedure) -> bool| {
        model.procedures.iter().rfind(|procedure| solves(procedure) && procedure.regime().is_some())
    };
    let current = last(Procedure::solves_electrical).filter(|_| has_current);
    // Pore fluid crosses an interface without an option for it (P-03).
    let fluid = last(Procedure::solves_pore_pressure);
    let starts = [current, fluid].into_iter().flatten().map(|procedure| procedure.option.span);
    let starts: HashSet<(SourceId, u64)> = starts.map(|span| (span.source(), span.start())).collect();
    let decides = |block: &&Block| {
        let keyword = block.span_of_keyword();
        starts.contains(&(keyword.source(), keyword.start()))
    };
    deck.blocks()
        .iter()
        .filter(decides)
        .map(|block| Region { span: block.span_of_keyword(), part: Part::Feeds })
        .collect()
}

/// Whether a block contains a `<name>`.
fn names_parameters(deck: &Deck, block: &Block) -> bool {
    references(deck.text(block.span())).next().is_some()
}
