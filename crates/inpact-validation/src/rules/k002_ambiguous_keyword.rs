//! K002: abbreviated keywords that may mean several.

use crate::rule::{Context, Report, declare_rule};
use crate::suggestion::alternatives;
use inpact_parser::deck::{KeywordLine, Resolved};
use inpact_parser::grammar::{KeywordId, Lookup};
use inpact_parser::number::read_float;

declare_rule! {
    /// The name after an asterisk is the beginning of several keywords.
    ///
    /// ## Why
    /// A keyword may be cut short as long as what is left begins no other keyword.
    /// The keyword cannot be determined, so the line and its rows are kept and not read.
    ///
    /// ## What to do
    /// Write the keyword in full.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *CONTACT P
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1, CUTOFF GAP FILL=0.2
    /// ```
    "K002", "ambiguous-keyword", Error, fix: None, source: "S-13"
}

/// The keywords that an ambiguous name may mean; none for any other.
pub(crate) fn candidates(context: &Context<'_>, keyword: &KeywordLine) -> Vec<KeywordId> {
    if keyword.resolved != Resolved::Ambiguous {
        return Vec::new();
    }
    match context.grammar.keyword_named(context.deck.text(keyword.name())) {
        Lookup::Ambiguous(candidates) => candidates,
        _ => Vec::new(),
    }
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for keyword in context.keyword_lines() {
        let candidates = candidates(context, keyword);
        if candidates.is_empty() {
            continue;
        }
        let name = context.shown(keyword.name());
        let full: Vec<String> = candidates.iter().map(|id| format!("*{}", context.grammar.keyword(*id).name)).collect();
        let names = alternatives(full.iter().map(String::as_str));
        let count = candidates.len();
        // `*load,1,1000`: a row that was put aside with one asterisk.
        let first = keyword.parameters().next().map(|parameter| context.deck.text(parameter.name));
        let is_row = first.is_some_and(|text| read_float(text).is_ok());
        let found = report.at(keyword.name(), format!("`*{name}` may mean {count} keywords"));
        found.label("the beginning of several");
        found.help(if is_row {
            "if it is a comment, begin it with two asterisks: `**`".to_owned()
        } else {
            format!("write out which is meant: {names}")
        });
    }
}
