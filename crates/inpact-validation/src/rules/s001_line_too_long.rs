//! S001: lines that are too long.

use super::s011_not_a_deck::{Reading, reading};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::LineNoteKind;
use inpact_parser::span::Span;

declare_rule! {
    /// A keyword line or data line has more than 256 characters.
    ///
    /// Trailing blanks do not count, and comments may be as long as they like.
    /// One finding covers all long lines of a block.
    ///
    /// ## Why
    /// Abaqus reads 256 characters of a line; what it does with the rest is not documented.
    /// inpact reads the whole line, so a solver and inpact may see different decks.
    ///
    /// ## What to do
    /// End a keyword line in a comma and go on in the next line.
    /// Write a data line over as many lines as the option prescribes.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A, PAD THICKNESS=                                                                                                                                                                                                                      0.1
    /// ```
    ///
    /// ```inp
    /// ** A comment may be long.
    /// *SURFACE INTERACTION, NAME=A,
    ///  PAD THICKNESS=0.1
    /// ```
    "S001", "line-too-long", Warning, fix: None, source: "S-06"
}

/// The most characters of a keyword or data line.
const LIMIT: usize = 256;

/// As many as CalculiX has room for, the line end and an end mark included.
const CALCULIX_LIMIT: usize = 1319;

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let notes = || context.deck.notes().iter().filter(|note| note.kind == LineNoteKind::TooLong);
    if notes().next().is_none() || reading(context) == Reading::NoDeck {
        return;
    }
    for note in notes() {
        let line = context.deck.text(note.span).trim_ascii_end();
        // CalculiX reads 1320 characters of a line (CX-01).
        if context.is_for_calculix() && line.len() < CALCULIX_LIMIT {
            continue;
        }
        // A character of several bytes is not cut in two.
        let first_beyond =
            (0..=LIMIT.min(line.len())).rev().find(|at| line.get(*at).is_none_or(|byte| byte & 0xC0 != 0x80));
        let beyond = note.span.start() + first_beyond.unwrap_or(LIMIT) as u64;
        let span = Span::new(note.span.source(), beyond, note.span.start() + line.len() as u64);
        let is_keyword_line = line.trim_ascii_start().starts_with(b"*");
        let found = report.at(span, format!("line of {} characters: Abaqus reads {LIMIT}", line.len()));
        found.label(format!("beyond character {LIMIT}"));
        found.help(if is_keyword_line {
            "end the line in a comma and go on in the next one"
        } else {
            "write it over several lines, as the option prescribes"
        });
        if note.lines > 1 {
            found.note(format!("{} lines of this block are too long; this is the first", note.lines));
        }
    }
}
