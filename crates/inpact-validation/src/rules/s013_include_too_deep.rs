//! S013: files that include one another, or lie too deep.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::{IncludeOutcome, MAX_FILES, max_levels};

declare_rule! {
    /// Files include one another without end, lie more than five levels below the deck, or are more than 200,000.
    ///
    /// ## Why
    /// Abaqus reads five levels of files below one another and no more.
    /// A deck of more files than that is taken for one whose files include one another over and over.
    ///
    /// ## What to do
    /// Let a file be included by the deck rather than by another included file.
    ///
    /// ```inp,expect
    /// *INCLUDE, INPUT=itself.inp
    /// ```
    ///
    /// ```inp
    /// *INCLUDE, INPUT=present.inp
    /// ```
    "S013", "include-too-deep", Error, fix: None, source: "S-52, S-54"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for include in context.deck.includes() {
        let span = include.name.unwrap_or(include.keyword);
        let shown = context.shown(span);
        match include.outcome {
            IncludeOutcome::Cycle => report
                .at(span, format!("`{shown}` includes itself, directly or through others"))
                .label("being read already")
                .help("take this *INCLUDE out"),
            IncludeOutcome::TooDeep => report
                .at(span, format!("`{shown}` lies more than {} levels below the deck", max_levels(context.grammar.dialect())))
                .label("not read")
                .help("include it from the deck itself"),
            IncludeOutcome::TooMany => report
                .at(span, format!("`{shown}` is not read: {MAX_FILES} files are included before it, as many as are allowed"))
                .label("not read")
                .help("put small files together"),
            _ => continue,
        };
    }
}
