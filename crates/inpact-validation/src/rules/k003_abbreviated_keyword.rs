//! K003: keywords that are cut short.

use inpact_diagnostics::{Edit, FixSafety};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::Resolved;
use inpact_parser::grammar::{Grammar, Lookup};

declare_rule! {
    /// A keyword is cut short.
    ///
    /// ## Why
    /// An abbreviation is legal as long as it begins one keyword only.
    /// Later releases have more keywords: `*GAPC` is *GAP CONDUCTANCE in release 2022, and begins two keywords in releases that have *GAP CONVECTION.
    ///
    /// ## What to do
    /// Write the keyword in full; the fix does so.
    ///
    /// ```inp,expect
    /// *surface int, name=A
    /// *Gap Elec, Pressure
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// *GAPH
    /// 1., 0.5
    /// ```
    ///
    /// ```inp,fixed
    /// *surface interaction, name=A
    /// *Gap Electrical Conductance, Pressure
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// ```
    "K003", "abbreviated-keyword", Note, fix: Safe, source: "S-13, Q-33"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for keyword in context.keyword_lines() {
        let Resolved::Abbreviated(id) = keyword.resolved else { continue };
        let full = in_case_of(&context.grammar.keyword(id).name, context.deck.text(keyword.name()));
        let name = context.shown(keyword.name());
        let found = report.at(keyword.name(), format!("`*{name}` is short for `*{full}`"));
        found.label("cut short").help(format!("write `*{full}`"));
        // Without certainty there is no fix.
        if context.grammar.is_calculix_keyword(context.deck.text(keyword.name())) {
            found.note(format!("CalculiX has a keyword `*{name}` of its own"));
        } else if let Some(singular) = singular(context.grammar, &name) {
            found.help(format!("write `*{full}`, or `*{singular}` if that is meant"));
        } else {
            found
                .note("what it begins depends on the release: a later one may have another keyword that begins so")
                .fix(FixSafety::Safe, format!("write `*{full}`"), vec![Edit::new(keyword.name(), full)]);
        }
    }
}

/// The name without its last `S` when that is a keyword in full: `*ELEMENTS` is more likely *ELEMENT than anything longer.
fn singular<'name>(grammar: &Grammar, name: &'name str) -> Option<&'name str> {
    let singular = name.strip_suffix(['S', 's'])?;
    matches!(grammar.keyword_named(singular.as_bytes()), Lookup::Exact(_)).then_some(singular)
}

/// A name, which is upper case, in the case of what is written: lower, capitalised or upper.
fn in_case_of(name: &str, written: &[u8]) -> String {
    let has_lower = written.iter().any(u8::is_ascii_lowercase);
    let has_upper = written.iter().any(u8::is_ascii_uppercase);
    let mut begins_word = true;
    let cased = name.chars().map(|letter| {
        let keeps = !has_lower || (has_upper && begins_word);
        begins_word = letter == ' ';
        if keeps { letter } else { letter.to_ascii_lowercase() }
    });
    cased.collect()
}
