//! Runs the rules and puts their findings in order.

use crate::diagnostic::Diagnostic;
use crate::rule::{Context, Report};
use crate::rules::RULES;
use inpact_parser::deck::Deck;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::Model;
use inpact_parser::problem::Problem;

/// Checks a deck and its model by every rule; findings come in the order of the deck.
pub fn check(deck: &Deck, grammar: &Grammar, model: &Model, problems: &[Problem]) -> Vec<Diagnostic> {
    let context = Context { deck, grammar, model, problems, tables: model.tables() };
    let mut diagnostics = Vec::new();
    for rule in RULES {
        let mut report = Report { rule, diagnostics: &mut diagnostics, reported: 0, overflow: None };
        (rule.check)(&context, &mut report);
        report.finish();
    }
    diagnostics.sort_by_key(|found| (found.primary.span.source, found.primary.span.start, found.severity, found.code));
    locate(deck, &mut diagnostics);
    diagnostics
}

/// Finds line and column of every label, in one sweep over the deck.
fn locate(deck: &Deck, diagnostics: &mut [Diagnostic]) {
    let labels = |found: &Diagnostic| {
        [found.primary.span].into_iter().chain(found.secondary.iter().map(|l| l.span)).collect::<Vec<_>>()
    };
    let spans: Vec<_> = diagnostics.iter().flat_map(labels).collect();
    let mut positions = deck.positions(&spans).into_iter();
    for found in diagnostics {
        for label in std::iter::once(&mut found.primary).chain(&mut found.secondary) {
            if let Some(position) = positions.next() {
                label.position = position;
            }
        }
    }
}
