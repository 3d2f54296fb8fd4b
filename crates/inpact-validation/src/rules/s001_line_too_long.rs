//! S001: lines that are too long.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::LineNoteKind;

declare_rule! {
    /// A keyword line or data line has more than 256 characters.
    ///
    /// Trailing blanks of a data line do not count, and comments may be as long as they like.
    ///
    /// ## Why
    /// Abaqus reads 256 characters of a line; what it does with the rest is not documented.
    /// inpact reads the whole line, so a solver and inpact may see different decks.
    ///
    /// ## What to do
    /// End a keyword line in a comma and go on in the next line; write each row of a table on lines of its own.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A, PAD THICKNESS=000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000.1
    /// ```
    ///
    /// ```inp
    /// ** A comment may be long.
    /// *SURFACE INTERACTION, NAME=A,
    ///  PAD THICKNESS=0.1
    /// ```
    "S001", "line-too-long", Warning, fix: None, source: "S-06"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for note in context.deck.notes().iter().filter(|note| note.kind == LineNoteKind::TooLong) {
        let length = note.span.len();
        let found = report.at(note.span, format!("line of {length} characters: Abaqus reads 256"));
        found.label("this line").help("split it: a keyword line may go on behind a comma at its end");
        if note.lines > 1 {
            found.note(format!("{} lines of this block are too long; this is the first", note.lines));
        }
    }
}
