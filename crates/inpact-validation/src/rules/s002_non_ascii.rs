//! S002: characters that are not ASCII.

use super::s011_not_a_deck::{Reading, reading};
use crate::parameter;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::ProblemKind;
use inpact_parser::deck::{KeywordLine, LineNote, LineNoteKind, Resolved};
use inpact_parser::grammar::ParameterKind;
use inpact_parser::span::Span;

declare_rule! {
    /// A keyword line or data line has a character that is not ASCII, such as `é`, `µ` or a blank that does not break.
    ///
    /// Comments, headings and quoted names may hold any character.
    /// One finding covers all such lines of a block.
    ///
    /// ## Why
    /// Abaqus supports 7-bit ASCII and nothing else.
    /// Two programs that read the deck with different encodings see different names.
    ///
    /// ## What to do
    /// Replace the character, or quote the name it is in.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=Dübel
    /// ```
    ///
    /// ```inp
    /// ** Dübel: a comment may say so
    /// *SURFACE INTERACTION, NAME=Duebel
    /// *SURFACE INTERACTION, NAME="Dübel"
    /// ```
    "S002", "non-ascii", Warning, fix: None, source: "S-01"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let notes = || context.deck.notes().iter().filter(|note| note.kind == LineNoteKind::NonAscii);
    if notes().next().is_none() || reading(context) == Reading::NoDeck {
        return;
    }
    let judged = judged_elsewhere(context);
    for note in notes() {
        let Some(found) = first_non_ascii(context, note) else { continue };
        let later = judged.partition_point(|span| (span.source(), span.start()) <= (found.span.source(), found.span.start()));
        let is_judged = later.checked_sub(1).is_some_and(|last| judged[last].contains(found.span));
        if is_judged && note.lines == 1 {
            continue;
        }
        let why = "Abaqus supports 7-bit ASCII only, outside comments, headings and quoted names";
        let diagnostic = report.at(found.span, format!("{} is not an ASCII character", found.name));
        diagnostic.label("not ASCII").help("replace the character, or quote the name it is in");
        match note.lines {
            1 => diagnostic.note(why),
            lines => {
                diagnostic.note(format!("{why}; {lines} lines of this block have such characters, this is the first"))
            }
        };
    }
}

/// A character that is not ASCII.
struct NonAscii {
    span: Span,
    name: String,
}

/// The first character of the line that is not ASCII and is outside quotes.
fn first_non_ascii(context: &Context<'_>, note: &LineNote) -> Option<NonAscii> {
    let line = context.deck.text(note.span);
    let mut quoted = false;
    let at = line.iter().position(|byte| {
        quoted ^= *byte == b'"';
        !quoted && !byte.is_ascii()
    })?;
    let character = line[at..].utf8_chunks().next().and_then(|chunk| chunk.valid().chars().next());
    let name = match character {
        Some(character) if character.is_alphanumeric() => format!("`{character}` (U+{:04X})", u32::from(character)),
        Some(character) => format!("U+{:04X}", u32::from(character)),
        None => format!("byte 0x{:02X}", line[at]),
    };
    let start = note.span.start() + at as u64;
    let length = character.map_or(1, char::len_utf8) as u64;
    Some(NonAscii { span: Span::new(note.span.source(), start, start + length), name })
}

/// The names with such characters that another rule finds wrong as a whole, in order.
fn judged_elsewhere(context: &Context<'_>) -> Vec<Span> {
    let unknown_names = context.keyword_lines().filter(|line| line.resolved == Resolved::Unknown).map(KeywordLine::name);
    let blocks = context.defined_blocks().filter(|block| block.definition.parameters_complete);
    let parameters = blocks.flat_map(|block| block.keyword.parameters());
    let unknown_parameters = parameters.filter(|parameter| parameter.index().is_none()).map(|parameter| parameter.name);
    let is_free = |kind| matches!(kind, ParameterKind::Label | ParameterKind::Text | ParameterKind::File);
    let values = parameter::all_given(context).filter(|given| !is_free(given.definition.kind));
    let values = values.filter_map(|given| given.value());
    let cells = context.problems.iter().filter(|problem| matches!(problem.kind, ProblemKind::MalformedNumber { .. }));
    let cells = cells.map(|problem| problem.span);
    let all = unknown_names.chain(unknown_parameters).chain(values).chain(cells);
    let mut judged: Vec<Span> = all.filter(|span| !context.deck.text(*span).is_ascii()).collect();
    judged.sort_unstable();
    judged
}
