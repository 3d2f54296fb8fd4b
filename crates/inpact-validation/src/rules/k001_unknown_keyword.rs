//! K001: unknown keywords.

use super::k015_not_in_release::keyword_of_other_release;
use inpact_diagnostics::{Diagnostic, Edit, FixSafety, Severity};
use crate::invisible;
use crate::rule::{Context, Report, declare_rule};
use crate::suggestion::did_you_mean;
use inpact_parser::deck::{KeywordLine, Resolved};
use inpact_parser::grammar::{Dialect, Grammar, Lookup};

declare_rule! {
    /// The name after an asterisk is no keyword of Abaqus, nor the beginning of one.
    ///
    /// Case and blanks do not count.
    ///
    /// ## Why
    /// Abaqus refuses a keyword it does not know.
    /// inpact keeps the line and its rows, and reads nothing from them.
    ///
    /// ## What to do
    /// Correct the spelling; put a comma between the keyword and its parameters.
    /// A comment begins with two asterisks.
    /// In a deck for CalculiX an unknown keyword is a warning, because CalculiX passes over it.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRIC CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *5e8 is too much
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// ** 5e8 is too much
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// ```
    ///
    /// A no-break space, which looks like a blank, is none:
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=A
    /// ```
    "K001", "unknown-keyword", Error, fix: ChangesMeaning, source: "S-13, S-15"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let dialect = context.grammar.dialect();
    for keyword in context.keyword_lines().filter(|keyword| keyword.resolved == Resolved::Unknown) {
        if keyword_of_other_release(context, keyword).is_some() {
            continue;
        }
        let name = context.shown(keyword.name());
        let found = if let Some(found) = say_hidden(context, report, keyword) {
            found
        } else if name.is_empty() {
            let found = report.at(keyword.visible_span(context.deck), "an asterisk without a keyword");
            found.label("nothing follows it").help(COMMENT)
        } else {
            let stranger = stranger(context, keyword);
            // A suggestion costs a comparison with every name, and a finding that is only counted shows none.
            let help = match &stranger {
                Some(stranger) => stranger.help.to_owned(),
                None if report.is_full() => String::new(),
                None => help(context, keyword, &name),
            };
            let what = stranger.map_or_else(|| "no keyword".to_owned(), |stranger| stranger.what);
            report.at(keyword.name(), format!("`*{name}` is {what}")).label("unknown keyword").help(help)
        };
        if dialect == Dialect::Calculix {
            found.severity(Severity::Warning);
        }
    }
}

/// A keyword that is one but for characters which are not what they look like.
fn say_hidden<'r>(
    context: &Context<'_>,
    report: &'r mut Report<'_>,
    keyword: &KeywordLine,
) -> Option<&'r mut Diagnostic> {
    let written = context.deck.text(keyword.name());
    let first = invisible::first(written)?;
    let plain = invisible::plain(written);
    context.grammar.keyword_named(&plain).found()?;
    let name = keyword.name();
    let edits = invisible::all(written).map(|hidden| Edit::new(hidden.span(name), hidden.plain)).collect();
    let plain = String::from_utf8_lossy(&plain).into_owned();
    let found = report.at(first.span(name), format!("{} in `*{plain}` makes it an unknown keyword", first.name));
    found.label("not what it looks like").help(first.help());
    Some(found.fix(FixSafety::ChangesMeaning, format!("write `*{plain}`"), edits))
}

/// The help for a line that has one asterisk by mistake.
const COMMENT: &str = "if it is a comment, begin it with two asterisks: `**`";

/// A keyword of another dialect.
struct Stranger {
    what: String,
    help: &'static str,
}

fn stranger(context: &Context<'_>, keyword: &KeywordLine) -> Option<Stranger> {
    let grammar = context.grammar;
    let written = context.deck.text(keyword.name());
    let of_abaqus = grammar.id_of(&context.deck.shown(keyword.name()));
    match (grammar.dialect(), of_abaqus) {
        (Dialect::Abaqus, None) if grammar.is_calculix_keyword(written) => Some(Stranger {
            what: "a keyword of CalculiX that Abaqus does not have".to_owned(),
            help: "leave it out of a deck for Abaqus",
        }),
        (Dialect::Calculix, Some(_)) => Some(Stranger {
            what: "a keyword of Abaqus that CalculiX does not have".to_owned(),
            help: "leave it out of a deck for CalculiX",
        }),
        _ => None,
    }
}

fn help(context: &Context<'_>, keyword: &KeywordLine, name: &str) -> String {
    let grammar = context.grammar;
    if !name.starts_with(|first: char| first.is_ascii_alphabetic()) {
        return COMMENT.to_owned();
    }
    if let Some((known, rest)) = split_after_keyword(grammar, name) {
        return format!("put a comma after the keyword: `*{known}, {rest}`");
    }
    let near = grammar.nearest_keywords(&context.deck.shown(keyword.name()), 8);
    let there = near.into_iter().filter(|name| grammar.id_of(name).is_some_and(|id| grammar.has(id)));
    let there: Vec<String> = there.take(3).map(|name| format!("*{name}")).collect();
    did_you_mean(there.iter().map(String::as_str)).unwrap_or_else(|| format!("check the spelling; {COMMENT}"))
}

/// Cuts `STEP NLGEOM=YES` after a keyword in full, where parameters seem to follow.
fn split_after_keyword<'name>(grammar: &Grammar, name: &'name str) -> Option<(&'name str, &'name str)> {
    let parameters = name.find('=')?;
    let blanks = name[..parameters].match_indices(' ').map(|(at, _)| at);
    let mut cuts = blanks.map(|at| (name[..at].trim_end(), name[at..].trim_start())).collect::<Vec<_>>();
    cuts.reverse();
    cuts.into_iter().find(|(name, _)| matches!(grammar.keyword_named(name.as_bytes()), Lookup::Exact(_)))
}
