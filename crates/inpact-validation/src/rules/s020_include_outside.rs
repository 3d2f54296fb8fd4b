//! S020: included files outside of what may be read.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::IncludeOutcome;

declare_rule! {
    /// An *INCLUDE names a file outside of the folder that `--include-root` names, and the file is not read.
    ///
    /// A name without a folder, one with `..` and an absolute one are judged alike, and by the file that a symbolic link leads to.
    /// Whether there is such a file is not said.
    ///
    /// ## Why
    /// A deck from elsewhere may name any file, and findings quote what they are about:
    /// where decks of strangers are checked, in a pull request for example, the secrets of the machine would be in the log.
    /// `--format github` and `--format sarif`, which are made for that, read nothing outside of the repository (the nearest folder
    /// above the deck that has `.git`), or of the deck's folder where there is none, unless `--include-root` says otherwise.
    ///
    /// ## What to do
    /// Put the file below that folder, or name a folder above both with `--include-root`.
    ///
    /// ```inp,expect
    /// *INCLUDE, INPUT=../outside.inp
    /// ```
    ///
    /// ```inp,expect
    /// *INCLUDE, INPUT=/etc/outside.inp
    /// ```
    ///
    /// ```inp
    /// *INCLUDE, INPUT=present.inp
    /// ```
    "S020", "include-outside", Error, fix: None, source: "S-22"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for include in context.deck.includes() {
        let (IncludeOutcome::Outside(folder), Some(name)) = (&include.outcome, include.name) else { continue };
        let shown = context.shown(name);
        report
            .at(name, format!("`{shown}` lies outside of `{folder}` and is not read"))
            .label("not read")
            .note("the rest of the deck is checked without it")
            .help("put the file below that folder, or name a folder above both with `--include-root`");
    }
}
