//! Runs the rules and puts their findings in order.

use crate::directives::{self, Directive};
use crate::lost::{lost_lines, without_consequences};
use crate::rule::{Check, Context, Report};
use crate::rules::{CHECKS, s018_ignore_without_effect};
use crate::tables::radiation_tables;
use inpact_diagnostics::{Diagnostic, FixKind, Rule};
use inpact_parser::Problem;
use inpact_parser::deck::Deck;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::Model;
use inpact_parser::span::SourceId;
use std::cell::OnceCell;
use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

/// Checks a deck and its model by every rule; findings are in the order of the deck.
pub fn check(deck: &Deck, grammar: &Grammar, model: &Model, problems: &[Problem]) -> Vec<Diagnostic> {
    check_with(deck, grammar, model, problems, Vec::new())
}

/// The same with findings of other rules about the deck, such as those on its geometry: they are suppressed, ordered and located with the others.
pub fn check_with(
    deck: &Deck,
    grammar: &Grammar,
    model: &Model,
    problems: &[Problem],
    others: Vec<Diagnostic>,
) -> Vec<Diagnostic> {
    check_all((deck, grammar, model, problems), others, &|| ())
}

/// [`check`] with a call of `watch` before each rule, which may unwind to cancel.
pub fn check_watched(
    deck: &Deck,
    grammar: &Grammar,
    model: &Model,
    problems: &[Problem],
    watch: &dyn Fn(),
) -> Vec<Diagnostic> {
    check_all((deck, grammar, model, problems), Vec::new(), watch)
}

fn check_all(
    (deck, grammar, model, problems): (&Deck, &Grammar, &Model, &[Problem]),
    others: Vec<Diagnostic>,
    watch: &dyn Fn(),
) -> Vec<Diagnostic> {
    let mut diagnostics = others;
    with_context((deck, grammar, model, problems), |context| {
        for (rule, check) in CHECKS {
            watch();
            let mut report = Report::new(rule, &mut diagnostics);
            check(context, &mut report);
            report.finish();
        }
    });
    silence(deck, &mut diagnostics);
    sort(&mut diagnostics);
    locate(deck, &mut diagnostics);
    diagnostics
}

/// All findings with a fix: [`check`] limits the findings of one rule.
///
/// They are in the order of the deck; their lines and columns are not computed.
pub fn fixable(deck: &Deck, grammar: &Grammar, model: &Model, problems: &[Problem]) -> Vec<Diagnostic> {
    let mut directives = directives::read(deck);
    let mut diagnostics = Vec::new();
    with_context((deck, grammar, model, problems), |context| {
        for (rule, check) in CHECKS.iter().filter(|(rule, _)| rule.fix != FixKind::None) {
            let mut found = Vec::new();
            check(context, &mut Report::without_limit(rule, &mut found));
            found.retain(|found| found.fix.is_some() && !is_silenced(&mut directives, found));
            diagnostics.append(&mut found);
        }
    });
    sort(&mut diagnostics);
    name_files(deck, &mut diagnostics);
    diagnostics
}

/// Runs every rule separately and measures its time by the caller's clock, which gives the time since some instant.
pub fn time_rules(
    deck: &Deck,
    grammar: &Grammar,
    model: &Model,
    problems: &[Problem],
    clock: impl Fn() -> Duration,
) -> Vec<(&'static str, Duration)> {
    with_context((deck, grammar, model, problems), |context| {
        let time = |(rule, check): &(&'static Rule, Check)| {
            let start = clock();
            let mut diagnostics = Vec::new();
            check(context, &mut Report::new(rule, &mut diagnostics));
            (rule.code, clock().saturating_sub(start))
        };
        CHECKS.iter().map(time).collect()
    })
}

/// Builds the input of the rules from a deck.
fn with_context<T>(
    (deck, grammar, model, problems): (&Deck, &Grammar, &Model, &[Problem]),
    work: impl FnOnce(&Context<'_>) -> T,
) -> T {
    let radiation = radiation_tables(deck, grammar, model);
    let lost_lines = lost_lines(deck, grammar);
    let caused = if lost_lines.is_empty() { Vec::new() } else { without_consequences(problems, &lost_lines) };
    let problems = if lost_lines.is_empty() { problems } else { &caused };
    let context = Context { deck, grammar, model, problems, radiation, lost_lines, misread: OnceCell::new() };
    work(&context)
}

/// Drops findings suppressed by comments in the deck, and reports comments without effect.
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

/// Puts findings in the order of the deck.
fn sort(diagnostics: &mut [Diagnostic]) {
    diagnostics
        .sort_by_key(|found| (found.primary.span.source(), found.primary.span.start(), found.severity, found.code));
}

/// Finds file, line and column of every label, in one pass over the deck.
fn locate(deck: &Deck, diagnostics: &mut [Diagnostic]) {
    name_files(deck, diagnostics);
    let spans: Vec<_> = diagnostics.iter().flat_map(Diagnostic::labels).map(|label| label.span).collect();
    let mut positions = deck.positions(&spans).into_iter();
    for label in diagnostics.iter_mut().flat_map(Diagnostic::labels_mut) {
        if let Some(position) = positions.next() {
            label.position = position;
        }
    }
}

/// Gives every label the name of its file.
fn name_files(deck: &Deck, diagnostics: &mut [Diagnostic]) {
    let mut names: HashMap<SourceId, Arc<str>> = HashMap::new();
    for label in diagnostics.iter_mut().flat_map(Diagnostic::labels_mut) {
        let source = label.span.source();
        label.file = Arc::clone(names.entry(source).or_insert_with(|| Arc::from(deck.source(source).name())));
    }
}
