//! Runs the rules and puts their findings in order.

use crate::diagnostic::Diagnostic;
use crate::directives::{self, Directive};
use crate::lost::{lost_lines, without_consequences};
use crate::rule::{Context, FixKind, Report, Rule};
use crate::rules::{RULES, s018_ignore_without_effect};
use crate::tables::{all_tables, radiation_tables};
use inpact_parser::deck::Deck;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::Model;
use inpact_parser::problem::Problem;
use std::time::{Duration, Instant};

/// Checks a deck and its model by every rule; findings come in the order of the deck.
pub fn check(deck: &Deck, grammar: &Grammar, model: &Model, problems: &[Problem]) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    with_context((deck, grammar, model, problems), |context| {
        for rule in RULES {
            let mut report = Report::new(rule, &mut diagnostics);
            (rule.check)(context, &mut report);
            report.finish();
        }
    });
    silence(deck, &mut diagnostics);
    diagnostics.sort_by_key(|found| (found.primary.span.source, found.primary.span.start, found.severity, found.code));
    locate(deck, &mut diagnostics);
    diagnostics
}

/// The findings that come with a fix, all of them: [`check`] keeps no more of one rule than anybody reads.
///
/// They come in the order of the deck; their lines and columns are not found out.
pub fn fixable(deck: &Deck, grammar: &Grammar, model: &Model, problems: &[Problem]) -> Vec<Diagnostic> {
    let mut directives = directives::read(deck);
    let mut diagnostics = Vec::new();
    with_context((deck, grammar, model, problems), |context| {
        for rule in RULES.iter().filter(|rule| rule.fix != FixKind::None) {
            let mut found = Vec::new();
            (rule.check)(context, &mut Report::without_limit(rule, &mut found));
            found.retain(|found| found.fix.is_some() && !is_silenced(&mut directives, found));
            diagnostics.append(&mut found);
        }
    });
    diagnostics.sort_by_key(|found| (found.primary.span.source, found.primary.span.start, found.severity, found.code));
    diagnostics
}

/// Runs every rule by itself and gives how long each took.
pub fn time_rules(
    deck: &Deck,
    grammar: &Grammar,
    model: &Model,
    problems: &[Problem],
) -> Vec<(&'static str, Duration)> {
    with_context((deck, grammar, model, problems), |context| {
        let time = |rule: &&'static Rule| {
            let start = Instant::now();
            let mut diagnostics = Vec::new();
            (rule.check)(context, &mut Report::new(rule, &mut diagnostics));
            (rule.code, start.elapsed())
        };
        RULES.iter().map(time).collect()
    })
}

/// Makes what the rules see of a deck.
fn with_context<T>(
    (deck, grammar, model, problems): (&Deck, &Grammar, &Model, &[Problem]),
    work: impl FnOnce(&Context<'_>) -> T,
) -> T {
    let radiation = radiation_tables(deck, grammar, model);
    let lost_lines = lost_lines(deck, grammar);
    let caused = if lost_lines.is_empty() { Vec::new() } else { without_consequences(problems, &lost_lines) };
    let problems = if lost_lines.is_empty() { problems } else { &caused };
    let context = Context { deck, grammar, model, problems, tables: all_tables(model, &radiation), lost_lines };
    work(&context)
}

/// Leaves out what comments in the deck silence, and reports comments that silence nothing.
fn silence(deck: &Deck, diagnostics: &mut Vec<Diagnostic>) {
    let mut directives = directives::read(deck);
    if directives.is_empty() {
        return;
    }
    diagnostics.retain(|found| !is_silenced(&mut directives, found));
    let mut report = Report::new(&s018_ignore_without_effect::RULE, diagnostics);
    s018_ignore_without_effect::report(&directives, &mut report);
    report.finish();
}

fn is_silenced(directives: &mut [Directive], found: &Diagnostic) -> bool {
    directives.iter_mut().any(|directive| match directive {
        Directive::Ignore(ignore) => ignore.silences(found),
        Directive::Unknown(_) => false,
    })
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
