//! Keyword lines that have lost their asterisk, and the findings that follow from it in their block.
//!
//! They are read as rows of the option above, and so are the rows after them: all faults of these have one cause (S021).

use crate::invisible;
use inpact_parser::Problem;
use inpact_parser::deck::{DataLine, Deck, LineNoteKind, RowsKept, items};
use inpact_parser::grammar::{Grammar, Lookup, RowShape};
use inpact_parser::span::Span;

/// A row that matches a keyword line exactly.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LostLine<'a> {
    /// The row.
    pub(crate) span: Span,
    /// The keyword line of its block; an empty span before the first.
    pub(crate) keyword: Span,
    /// The keyword that is meant.
    pub(crate) meant: &'a str,
}

/// The rows that match keyword lines; for a block whose rows are not kept those noted by the scan.
pub(crate) fn lost_lines<'a>(deck: &Deck, grammar: &'a Grammar) -> Vec<LostLine<'a>> {
    let notes = deck.notes().iter().filter(|note| note.kind == LineNoteKind::LikeKeyword);
    let mut noted: Vec<Span> = notes.map(|note| note.span).collect();
    noted.sort_unstable();
    let mut lost = Vec::new();
    for block in deck.blocks() {
        let definition = block.keyword_id().and_then(|id| grammar.keyword(id).definition());
        // The rows of a well-ordered table are numbers.
        if block.rows_kept == RowsKept::Ends || definition.is_some_and(|definition| definition.rows() == RowShape::Text)
        {
            continue;
        }
        let keyword = block.span_of_keyword();
        let first = noted.partition_point(|span| *span < block.rows());
        let of_block = noted[first..].iter().take_while(|span| block.rows().contains(**span));
        let lines = deck.data_lines_in(block.rows()).chain(of_block.flat_map(|span| deck.data_lines_in(*span)));
        let found = lost.len();
        lost.extend(
            lines.filter_map(|line| Some(LostLine { span: line.span, keyword, meant: meant_by(grammar, line)? })),
        );
        // The first rows of a block may be kept and noted.
        lost[found..].sort_unstable_by_key(|line| line.span);
        lost.dedup_by_key(|line| line.span);
    }
    lost
}

/// The problems except those of such rows and of rows after one.
pub(crate) fn without_consequences(problems: &[Problem], lost: &[LostLine<'_>]) -> Vec<Problem> {
    let follows = |problem: &Problem| {
        let of_block = lost.iter().filter(|line| line.keyword == problem.keyword);
        of_block
            .map(|line| line.span)
            .any(|line| line.source() == problem.span.source() && line.start() <= problem.span.start())
    };
    problems.iter().filter(|problem| !follows(problem)).cloned().collect()
}

/// The keyword that a row would mean with an asterisk in front: its name in full, and parameters of it alone after them.
fn meant_by<'a>(grammar: &'a Grammar, line: DataLine<'_>) -> Option<&'a str> {
    let text = line.text.trim_ascii_start();
    let is_hidden = !text.first()?.is_ascii();
    let visible = if is_hidden {
        let hidden = invisible::first(text).filter(|hidden| hidden.range.start == 0)?;
        text[hidden.range.end..].strip_prefix(b"*")?
    } else {
        text
    };
    if !visible.first()?.is_ascii_alphabetic() {
        return None;
    }
    let mut items = items(visible).map(|item| &visible[item]);
    let Lookup::Exact(id) = grammar.keyword_named(items.next()?) else { return None };
    let keyword = grammar.keyword(id);
    let definition = keyword.definition()?;
    let mut has_parameter = false;
    for item in items.filter(|item| !item.is_empty()) {
        let name = item.split(|byte| *byte == b'=').next().unwrap_or(item);
        grammar.parameter_named(definition, name).found()?;
        has_parameter = true;
    }
    // A single word may be the name of a set or a surface.
    let is_name = !has_parameter && !keyword.name.contains(' ');
    (is_hidden || !is_name).then_some(keyword.name.as_str())
}
