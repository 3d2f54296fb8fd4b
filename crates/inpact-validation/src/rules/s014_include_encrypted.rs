//! S014: encrypted files.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::IncludeOutcome;

declare_rule! {
    /// An *INCLUDE has a PASSWORD: the file is encrypted, and inpact does not read it.
    ///
    /// ## Why
    /// The content of the file is missing: a reference to it may be reported as undefined.
    ///
    /// ## What to do
    /// Check the deck where the file is at hand in plain text.
    ///
    /// ```inp,expect
    /// *INCLUDE, INPUT=present.inp, PASSWORD=secret
    /// ```
    ///
    /// ```inp
    /// *INCLUDE, INPUT=present.inp
    /// ```
    "S014", "include-encrypted", Warning, fix: None, source: "S-53"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for include in context.deck.includes().iter().filter(|include| include.outcome == IncludeOutcome::Encrypted) {
        let span = include.name.unwrap_or(include.keyword);
        let shown = context.shown(span);
        report
            .at(span, format!("`{shown}` is encrypted and is not read"))
            .label("not read")
            .help("check the deck where the file is at hand in plain text");
    }
}
