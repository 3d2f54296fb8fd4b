//! S009: comments after blanks.

use inpact_diagnostics::{Edit, FixSafety};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::lines::{LineKind, line_kind, lines};
use inpact_parser::deck::{Block, LineNote, LineNoteKind, RowsKept};
use inpact_parser::grammar::RowShape;
use inpact_parser::span::{SourceId, Span};

declare_rule! {
    /// A comment begins after blanks: its `**` is not in the first two columns.
    ///
    /// One finding covers all such comments of a block.
    ///
    /// ## Why
    /// By the manual a comment has its asterisks in columns 1 and 2.
    /// After blanks the first asterisk begins a keyword line, and Abaqus may refuse it as an unknown keyword.
    /// inpact takes it for the comment that it is meant to be.
    ///
    /// ## What to do
    /// Take the blanks away.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    ///    ** the pressure reaches 10 MPa
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    ///  ** measured twice
    /// 3.E7, 1.E7
    ///  ** and not beyond
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=A
    /// ** the pressure reaches 10 MPa
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// ** measured twice
    /// 3.E7, 1.E7
    /// ** and not beyond
    /// ```
    ///
    /// In the title of an analysis or of a step such a line is text like any other:
    ///
    /// ```inp
    /// *HEADING
    /// Brake disc, run 12
    ///    ** second line of the title
    /// ```
    "S009", "indented-comment", Warning, fix: Safe, source: "S-04"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let notes = || context.deck.notes().iter().filter(|note| note.kind == LineNoteKind::IndentedComment);
    // For CalculiX blanks carry no meaning anywhere (CX-01).
    if context.is_for_calculix() || notes().next().is_none() {
        return;
    }
    let mut blocks: Vec<&Block> = context.deck.blocks().iter().filter(|block| !block.rows().is_empty()).collect();
    blocks.sort_by_key(|block| block.rows());
    for note in notes() {
        let later = blocks
            .partition_point(|block| (block.rows().source(), block.rows().start()) <= (note.span.source(), note.span.start()));
        let block = later.checked_sub(1).map(|last| blocks[last]).filter(|block| block.rows().contains(note.span));
        let place = Place::of(context, block);
        if matches!(place, Place::Title) {
            continue;
        }
        let blanks = indentation(context.deck.text(note.span));
        let start = note.span.start() + blanks as u64;
        let found = report.at(Span::new(note.span.source(), start, note.span.end()), "comment after blanks");
        found.label("begins in the first column only").help("take the blanks before `**` away");
        if matches!(place, Place::Rows) {
            found.fix(FixSafety::Safe, "take the blanks away", edits(context, note, block));
        }
        match note.lines {
            1 => found
                .note("by the manual this is a keyword line, which Abaqus may refuse; it is read as a comment here"),
            lines => found.note(format!("{lines} comments of this block begin after blanks; this is the first")),
        };
    }
}

/// Kinds of the lines around a comment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// Rows of items, among which it is a comment.
    Rows,
    /// The title of the analysis or of a step: free text, which only an asterisk in the first column ends (S-70, S-72).
    Title,
    /// Statements of *PARAMETER, where `**` after blanks may go on with an expression (S-60), or rows that go on from
    /// another file, of which nobody knows here what they are.
    Unclear,
}

impl Place {
    fn of(context: &Context<'_>, block: Option<&Block>) -> Self {
        let Some(block) = block else { return Self::Rows };
        let definition = block.keyword_id().and_then(|id| context.grammar.keyword(id).definition());
        match definition {
            Some(definition) if definition.name == "PARAMETER" => Self::Unclear,
            Some(definition) if definition.rows() == RowShape::Text => Self::Title,
            None if block.keyword.is_none() && block.rows().source() != SourceId::ROOT => Self::Unclear,
            _ => Self::Rows,
        }
    }
}

fn indentation(line: &[u8]) -> usize {
    line.len() - line.trim_ascii_start().len()
}

/// Takes the blanks away before every such comment of the block, or before the first where the rows are not kept.
fn edits(context: &Context<'_>, note: &LineNote, block: Option<&Block>) -> Vec<Edit> {
    let (source, first) = (note.span.source(), note.span.start());
    let end = block.filter(|block| block.rows_kept == RowsKept::All).map_or(note.span.end(), |block| block.rows().end());
    let text = context.deck.text(Span::new(source, first, end));
    let comments = lines(text).filter(|line| line_kind(&text[line.clone()]) == LineKind::IndentedComment);
    let blanks = comments.map(|line| {
        let start = first + line.start as u64;
        Span::new(source, start, start + indentation(&text[line]) as u64)
    });
    blanks.map(Edit::delete).collect()
}
