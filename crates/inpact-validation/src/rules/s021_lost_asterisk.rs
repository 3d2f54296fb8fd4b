//! S021: keyword lines that have lost their asterisk.

use inpact_diagnostics::{Edit, FixSafety};
use crate::invisible;
use crate::lost::LostLine;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::span::Span;

declare_rule! {
    /// A row reads exactly as a keyword line, and has no asterisk, or an invisible character in front of it.
    ///
    /// The line begins with a keyword in full, and all that follows are parameters of it.
    ///
    /// ## Why
    /// Without an asterisk in front the line is a row of the option above, and so are the rows after it.
    /// Nothing is left of the option that was meant.
    ///
    /// ## What to do
    /// Write the asterisk in the first column.
    ///
    /// ```inp,expect
    /// SURFACE INTERACTION, NAME=JOINT
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=JOINT
    /// ```
    ///
    /// ```inp
    /// *HEADING
    /// Surface interaction
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// ```
    "S021", "lost-asterisk", Error, fix: ChangesMeaning, source: "S-05, S-10"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for &LostLine { span, meant, .. } in &context.lost_lines {
        let shown = context.shown(span);
        let text = context.deck.text(span);
        let Some(hidden) = invisible::first(text).filter(|hidden| hidden.range.start == 0) else {
            report
                .at(span, format!("`{shown}` reads as the keyword line `*{meant}`, and is a row"))
                .label("an asterisk is missing")
                .note("the rows after it are taken for rows of the option above")
                .help("write `*` in front of it")
                .fix(FixSafety::ChangesMeaning, "write the asterisk", vec![Edit::new(Span::new(span.source(), span.start(), span.start()), "*")]);
            continue;
        };
        let place = hidden.span(span);
        report
            .at(place, format!("{} in front of `*{meant}` makes it a row", hidden.name))
            .label("an invisible character")
            .note("a keyword line begins with its asterisk, or with blanks")
            .help("take the character away")
            .fix(FixSafety::ChangesMeaning, "take the invisible character away", vec![Edit::delete(place)]);
    }
}
