//! Code actions: the fixes of findings, all safe fixes at once, suppression of a rule, and a switch of dialect.

use super::analysis::Analysis;
use super::blocks;
use super::findings;
use super::navigation::workspace_edit;
use super::refusal::{self, Refusal};
use super::workspace::{View, Workspace};
use gen_lsp_types::{
    CodeAction, CodeActionKind, CodeActionParams, CodeActionResponse, Diagnostic, TextEdit, WorkspaceEdit,
};
use inpact_diagnostics::{self as found, Edit, Fix, FixSafety};
use inpact_parser::deck::EditedText;
use inpact_parser::grammar::Dialect;
use inpact_parser::span::Span;
use inpact_validation::fixable;
use similar::{Algorithm, DiffOp, capture_diff_slices};
use std::collections::BTreeMap;

/// The kind of the action that applies all safe fixes, which an editor may run on save.
const FIX_ALL: &str = "source.fixAll.inpact";

/// The maximum number of rounds: a fix may reveal another finding, but not endlessly.
const MAX_ROUNDS: usize = 10;

pub(super) fn actions(
    workspace: &mut Workspace,
    params: &CodeActionParams,
) -> Result<Option<Vec<CodeActionResponse>>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    let only = params.context.only.as_ref();
    let is_wanted = |kind: &str| {
        only.is_none_or(|only| {
            only.iter().any(|wanted| {
                let wanted = wanted.to_string();
                wanted.is_empty() || kind == wanted || kind.starts_with(&format!("{wanted}."))
            })
        })
    };
    let selected = view.bytes(params.range);
    let mut actions = Vec::new();
    if is_wanted("quickfix") {
        let here: Vec<&found::Diagnostic> = findings::touching(view.analysis, selected).collect();
        actions.extend(here.iter().filter_map(|finding| mend(view, finding, "")));
        actions.extend(for_other_dialect(view, selected, &here));
        actions.extend(here.iter().filter_map(|finding| silence(view, finding)));
    }
    // Requested by name, or offered in a menu; never just for the cursor position.
    if is_wanted(FIX_ALL) && only.is_some() {
        actions.extend(fix_all(view));
    }
    Ok(Some(actions.into_iter().map(CodeActionResponse::CodeAction).collect()))
}

fn mend(view: View<'_>, finding: &found::Diagnostic, prefix: &str) -> Option<CodeAction> {
    let fix = finding.fix.as_ref()?;
    let diagnostics = prefix.is_empty().then(|| vec![findings::diagnostic(view, finding)]);
    let is_safe = fix.safety == FixSafety::Safe;
    let title = if is_safe { fix.title.clone() } else { format!("{} (changes what the deck means)", fix.title) };
    Some(quick_fix(format!("{prefix}{title}"), diagnostics, is_safe && prefix.is_empty(), edit_of(view, fix)))
}

fn quick_fix(
    title: String,
    diagnostics: Option<Vec<Diagnostic>>,
    is_preferred: bool,
    edit: WorkspaceEdit,
) -> CodeAction {
    CodeAction {
        title,
        kind: Some(CodeActionKind::QuickFix),
        diagnostics,
        is_preferred: is_preferred.then_some(true),
        edit: Some(edit),
        ..CodeAction::default()
    }
}

/// The edits of a fix, in whatever files they are.
fn edit_of(view: View<'_>, fix: &Fix) -> WorkspaceEdit {
    let mut edits: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for edit in &fix.edits {
        let new_text = String::from_utf8_lossy(&edit.replacement).into_owned();
        let text_edit = TextEdit { range: view.range(edit.span), new_text };
        edits.entry(edit.span.source()).or_default().push(text_edit);
    }
    workspace_edit(view, edits)
}

/// A comment above the block that suppresses the rule there.
fn silence(view: View<'_>, finding: &found::Diagnostic) -> Option<CodeAction> {
    // Faults of such a comment are fixed, not suppressed.
    if finding.code == "S018" {
        return None;
    }
    let span = finding.primary.span;
    let block = blocks::block_at(view.analysis, span.source(), span.start())?;
    let keyword = block.keyword.as_ref()?;
    let text = view.text_of(span.source())?;
    let (number, start) = text.line_of(keyword.span.start());
    let (_, line) = text.line(number);
    let line_end = view.text(Span::new(span.source(), start + line.len() as u64, start + line.len() as u64 + 2));
    let line_end = match &*line_end {
        [b'\r', b'\n', ..] => "\r\n",
        [b'\r', ..] => "\r",
        _ => "\n",
    };
    let comment = format!("** inpact: ignore {}{line_end}", finding.code);
    let fix = Fix {
        title: String::new(),
        safety: FixSafety::Safe,
        edits: vec![Edit::new(Span::new(span.source(), start, start), comment)],
    };
    let title = format!("Silence {} in this block (`** inpact: ignore {}`)", finding.code, finding.code);
    Some(quick_fix(title, Some(vec![findings::diagnostic(view, finding)]), false, edit_of(view, &fix)))
}

/// The fixes that `check` would make if the deck were for the other solver, and does not make for this one.
fn for_other_dialect(view: View<'_>, selected: Span, here: &[&found::Diagnostic]) -> Vec<CodeAction> {
    let (other, name) = match view.analysis.settings.grammar.dialect() {
        Dialect::Abaqus => (Dialect::Calculix, "CalculiX"),
        Dialect::Calculix => (Dialect::Abaqus, "Abaqus"),
    };
    let analysis = view.analysis.other(|| view.workspace.analyse_for(view.analysis, other));
    let other_view = View { analysis, ..view };
    let is_known =
        |fix: &Fix| here.iter().filter_map(|finding| finding.fix.as_ref()).any(|known| known.edits == fix.edits);
    let found = findings::touching(analysis, selected);
    let found = found.filter(|finding| finding.fix.as_ref().is_some_and(|fix| !is_known(fix)));
    found.filter_map(|finding| mend(other_view, finding, &format!("Mend for {name}: "))).collect()
}

/// All safe fixes of the document, repeated until there are none left.
fn fix_all(view: View<'_>) -> Option<CodeAction> {
    let before = view.text_of(view.source)?;
    let mut text = before.clone();
    for _ in 0..MAX_ROUNDS {
        let analysis = view.workspace.analyse_with(view.analysis, view.place(), &text);
        if mend_once(&analysis, view, &mut text) == 0 {
            break;
        }
    }
    let edits: Vec<TextEdit> = changes(view, before, &text);
    if edits.is_empty() {
        return None;
    }
    let edits = BTreeMap::from([(view.source, edits)]);
    Some(CodeAction {
        title: "Mend all that can be mended without changing what the deck means".to_owned(),
        kind: Some(CodeActionKind::Custom(FIX_ALL.into())),
        edit: Some(workspace_edit(view, edits)),
        ..CodeAction::default()
    })
}

/// Applies the safe fixes of a deck that are entirely in one of its files; returns their number.
fn mend_once(analysis: &Analysis, view: View<'_>, text: &mut EditedText) -> usize {
    let Some(source) = analysis.source_of(view.place()) else { return 0 };
    let all = fixable(&analysis.deck, analysis.settings.grammar, &analysis.model, &analysis.problems);
    let mut taken: Vec<&Edit> = Vec::new();
    let all = analysis.settings.apply(all);
    let mut mended = 0;
    for fix in all.iter().filter_map(|finding| finding.fix.as_ref()).filter(|fix| fix.safety == FixSafety::Safe) {
        let overlaps = |edit: &Edit| {
            taken.iter().any(|other| {
                (other.span.start() < edit.span.end() && edit.span.start() < other.span.end())
                    || other.span.start() == edit.span.start()
            })
        };
        // A fix is applied as a whole or not at all.
        if fix.edits.iter().all(|edit| edit.span.source() == source && !overlaps(edit)) {
            taken.extend(&fix.edits);
            mended += 1;
        }
    }
    taken.sort_by_key(|edit| std::cmp::Reverse(edit.span.start()));
    for edit in taken {
        text.replace(edit.span.start()..edit.span.end(), &edit.replacement);
    }
    mended
}

/// Edits that turn one text into another, line by line.
fn changes(view: View<'_>, before: &EditedText, after: &EditedText) -> Vec<TextEdit> {
    let (shared, shared_end) = after.shared_with(before);
    let old = before.bytes(shared..before.length() - shared_end);
    let new = after.bytes(shared..after.length() - shared_end);
    let lines = |bytes: &[u8]| -> Vec<std::ops::Range<usize>> { inpact_parser::deck::lines::lines(bytes).collect() };
    let (old_lines, new_lines) = (lines(&old), lines(&new));
    let texts = |bytes: &'_ [u8], lines: &[std::ops::Range<usize>]| -> Vec<Vec<u8>> {
        lines.iter().map(|range| bytes[range.clone()].to_vec()).collect()
    };
    let operations = capture_diff_slices(Algorithm::Myers, &texts(&old, &old_lines), &texts(&new, &new_lines));
    let start_of = |lines: &[std::ops::Range<usize>], index: usize, length: usize| {
        lines.get(index).map_or(length, |range| range.start)
    };
    let changed = operations.iter().filter(|operation| !matches!(operation, DiffOp::Equal { .. }));
    let edit = |operation: &DiffOp| {
        let (from, to) = (operation.old_range(), operation.new_range());
        let start = start_of(&old_lines, from.start, old.len());
        let end = start_of(&old_lines, from.end, old.len());
        let written = &new[start_of(&new_lines, to.start, new.len())..start_of(&new_lines, to.end, new.len())];
        TextEdit {
            range: view.workspace.range_in(before, shared + start as u64, shared + end as u64),
            new_text: String::from_utf8_lossy(written).into_owned(),
        }
    };
    changed.map(edit).collect()
}
