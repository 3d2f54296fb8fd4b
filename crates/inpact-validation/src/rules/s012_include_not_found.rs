//! S012: included files that cannot be read.

use crate::parameter::given;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::{Include, IncludeOutcome};

declare_rule! {
    /// An *INCLUDE names a file that is not there or cannot be read, or names none.
    ///
    /// The rest of the deck is read all the same.
    ///
    /// ## Why
    /// Abaqus stops at a file that it cannot read.
    /// The content of the file is missing: a reference to it may be reported as undefined.
    ///
    /// ## What to do
    /// Correct the name: it is relative to the folder of the deck, not to that of the including file.
    /// `--include-dir` names further folders, `--relative-to including-file` changes what names are relative to.
    ///
    /// ```inp,expect
    /// *INCLUDE, INPUT=no-such-file.inp
    /// ```
    ///
    /// ```inp
    /// *INCLUDE, INPUT=present.inp
    /// ```
    "S012", "include-not-found", Error, fix: None, source: "S-50, S-54"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for include in context.deck.includes() {
        // CalculiX has INPUT or any other parameter with a value; where there is none it stops (CX-06).
        if context.is_for_calculix() && include.outcome == IncludeOutcome::Unnamed && !is_given(context, include) {
            report
                .at(context.trimmed(include.keyword), "`*INCLUDE` names no file")
                .label("a name is missing")
                .help("write `INPUT=` and the name of the file");
        }
        // A file without a name is a missing parameter (K006).
        let (IncludeOutcome::Unreadable(reason), Some(name)) = (&include.outcome, include.name) else { continue };
        let shown = context.shown(name);
        let has_blanks = !shown.starts_with('"') && shown.contains(|character: char| character.is_ascii_whitespace());
        if has_blanks {
            let sought: String = shown.split_ascii_whitespace().collect();
            report
                .at(name, format!("`{sought}` cannot be included: {reason}"))
                .label("blanks are dropped from a name without quotes")
                .note("the rest of the deck is checked without it")
                .help(format!("write `\"{shown}\"` if blanks are part of the name"));
            continue;
        }
        report
            .at(name, format!("`{shown}` cannot be included: {reason}"))
            .label("not read")
            .note("the rest of the deck is checked without it")
            .help("correct the name, or say where the file is with `--include-dir`");
    }
}

/// Whether the line has INPUT or FILE, though without a value (K007).
fn is_given(context: &Context<'_>, include: &Include) -> bool {
    let mut lines = context.defined_blocks().filter(|block| block.keyword.span == include.keyword);
    lines.any(|block| given(block).next().is_some())
}
