//! Formatting: the result of `inpact fmt` on the single document, as edits.

use super::refusal::{self, Refusal};
use super::workspace::{View, Workspace};
use gen_lsp_types::{DocumentFormattingParams, DocumentRangeFormattingParams, TextEdit};
use inpact_diagnostics::Edit;
use inpact_parser::deck::{Keep, ScanOptions, Scanner};
use inpact_parser::format_edits;
use inpact_parser::span::{SourceId, Span};

pub(super) fn whole(
    workspace: &mut Workspace,
    params: &DocumentFormattingParams,
) -> Result<Option<Vec<TextEdit>>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    Ok(Some(edits(view, super::findings::whole(view, view.source))))
}

/// The blocks that a selection touches are formatted, each as a whole: alignment depends on all rows.
pub(super) fn range(
    workspace: &mut Workspace,
    params: &DocumentRangeFormattingParams,
) -> Result<Option<Vec<TextEdit>>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    let selected = view.bytes(params.range);
    Ok(Some(edits(view, selected)))
}

fn edits(view: View<'_>, selected: Span) -> Vec<TextEdit> {
    let Some(text) = view.text_of(view.source) else { return Vec::new() };
    let grammar = view.analysis.settings.grammar;
    // On its own, as in `fmt`, independent of including and included files.
    let mut scanner = Scanner::new("", ScanOptions { grammar, keep: Keep::Interpreted });
    text.push_watched(&mut scanner, &|| view.workspace.stop.look());
    let deck = scanner.finish();
    let touches = |edit: &Edit| edit.span.start() <= selected.end() && selected.start() <= edit.span.end();
    let edits = format_edits(&deck, SourceId::ROOT, grammar).into_iter().filter(touches);
    edits.map(|edit| narrowed(view, edit)).collect()
}

/// An edit without unchanged lines at its beginning and its end.
fn narrowed(view: View<'_>, edit: Edit) -> TextEdit {
    let before = view.text(Span::new(view.source, edit.span.start(), edit.span.end())).into_owned();
    let after = edit.replacement;
    let start = same_lines(before.iter().zip(&after));
    // Counted from the end, a line begins after the line end before it.
    let end = same_lines(before[start..].iter().rev().zip(after[start..].iter().rev())).saturating_sub(1);
    let span = Span::new(view.source, edit.span.start() + start as u64, edit.span.end() - end as u64);
    let new_text = String::from_utf8_lossy(&after[start..after.len() - end]).into_owned();
    TextEdit { range: view.range(span), new_text }
}

/// How many bytes are the same up to the last line end among them.
fn same_lines<'a>(pairs: impl Iterator<Item = (&'a u8, &'a u8)>) -> usize {
    let same = (1..).zip(pairs.take_while(|(a, b)| a == b));
    same.filter(|(_, (byte, _))| **byte == b'\n').last().map_or(0, |(count, _)| count)
}
