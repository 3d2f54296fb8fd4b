//! The outline of a document: nested symbols, folding ranges and selection ranges.

use super::blocks::{self, Entry, LEVELS};
use super::cells;
use super::names;
use super::refusal::{self, Refusal};
use super::shape::shape;
use super::workspace::{View, Workspace};
use gen_lsp_types::{
    DocumentSymbol, DocumentSymbolParams, DocumentSymbolResponse, FoldingRange, FoldingRangeKind, FoldingRangeParams,
    Position, Range, SelectionRange, SelectionRangeParams, SymbolKind,
};
use inpact_parser::deck::items;
use inpact_parser::deck::lines::{LineKind, line_kind};
use inpact_parser::span::Span;

/// A node of the outline with its children.
#[derive(Debug)]
struct Node<'a> {
    entry: Entry<'a>,
    /// From the keyword line to the end of the last row in it.
    span: Span,
    children: Vec<Node<'a>>,
    /// Which keywords close it.
    opens: Opens,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Opens {
    /// *STEP and similar keywords, up to the keyword of that name.
    Until(&'static str),
    /// *SURFACE INTERACTION, up to the first keyword that is not a sub-option.
    Interaction,
    Nothing,
}

/// The blocks of a document as a tree: step, interaction, option.
fn tree(view: View<'_>) -> Vec<Node<'_>> {
    let grammar = view.analysis.settings.grammar;
    let mut roots: Vec<Node<'_>> = Vec::new();
    let mut open: Vec<Node<'_>> = Vec::new();
    for entry in blocks::entries(view.analysis).filter(|entry| entry.keyword.span.source() == view.source) {
        let is_option = entry.keyword.id().is_some_and(|id| grammar.is_interaction_option(id));
        let is_in_interaction = open.last().is_some_and(|node| node.opens == Opens::Interaction);
        if is_in_interaction && !is_option && !matches!(entry.name, "INCLUDE" | "PARAMETER") {
            close_last(&mut open, &mut roots);
        }
        let closes = open.iter().rposition(|node| matches!(node.opens, Opens::Until(closing) if closing == entry.name));
        let level = LEVELS.into_iter().find(|(opens, _, _)| entry.name == *opens);
        let opens = match level {
            Some((_, closing, _)) => Opens::Until(closing),
            None if entry.name == "SURFACE INTERACTION" => Opens::Interaction,
            None => Opens::Nothing,
        };
        open.push(Node { entry, span: entry.block.span(), children: Vec::new(), opens });
        if opens == Opens::Nothing {
            close_last(&mut open, &mut roots);
        }
        if let Some(at) = closes {
            while open.len() > at {
                close_last(&mut open, &mut roots);
            }
        }
    }
    while !open.is_empty() {
        close_last(&mut open, &mut roots);
    }
    roots
}

/// Closes the innermost open node, and adds it to its parent.
fn close_last<'a>(open: &mut Vec<Node<'a>>, roots: &mut Vec<Node<'a>>) {
    let Some(mut node) = open.pop() else { return };
    if let Some(last) = node.children.last() {
        node.span = node.span.to(last.span);
    }
    match open.last_mut() {
        Some(parent) => parent.children.push(node),
        None => roots.push(node),
    }
}

pub(super) fn symbols(
    workspace: &mut Workspace,
    params: &DocumentSymbolParams,
) -> Result<Option<DocumentSymbolResponse>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    let symbols: Vec<DocumentSymbol> = tree(view).iter().map(|node| symbol(view, node)).collect();
    Ok(Some(symbols.into()))
}

#[expect(deprecated, reason = "the field must be given and is not used")]
fn symbol(view: View<'_>, node: &Node<'_>) -> DocumentSymbol {
    let entry = &node.entry;
    let named =
        ["NAME", "INTERACTION", "NSET", "ELSET", "INPUT"].into_iter().find_map(|name| entry.value_written(view, name));
    let name = match named {
        Some(value) => format!("*{} {}", entry.name, view.shown(value).trim()),
        None => format!("*{}", entry.name),
    };
    let detail = cells::table_of(view.analysis, entry).map(shape);
    let kind = match (node.opens, entry.name) {
        (Opens::Until("END STEP"), _) => SymbolKind::Event,
        (Opens::Until(_), _) => SymbolKind::Namespace,
        (Opens::Interaction, _) => SymbolKind::Interface,
        (_, "CONTACT PAIR" | "CONTACT PROPERTY ASSIGNMENT") => SymbolKind::Operator,
        (_, "PARAMETER") => SymbolKind::Variable,
        (_, "INCLUDE") => SymbolKind::File,
        (_, "SURFACE" | "NSET" | "ELSET") => SymbolKind::Array,
        _ if detail.is_some() => SymbolKind::Function,
        _ => SymbolKind::Property,
    };
    let children: Vec<DocumentSymbol> = node.children.iter().map(|child| symbol(view, child)).collect();
    DocumentSymbol {
        name,
        detail,
        kind,
        tags: None,
        deprecated: None,
        range: view.range(node.span),
        selection_range: view.range(entry.keyword.visible_span(&view.analysis.deck)),
        children: Some(children).filter(|children| !children.is_empty()),
    }
}

pub(super) fn folding(
    workspace: &mut Workspace,
    params: &FoldingRangeParams,
) -> Result<Option<Vec<FoldingRange>>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    let mut ranges = Vec::new();
    for node in &tree(view) {
        fold(view, node, &mut ranges);
    }
    Ok(Some(ranges))
}

fn fold(view: View<'_>, node: &Node<'_>, ranges: &mut Vec<FoldingRange>) {
    let own = view.range(trimmed(view, node.entry.block.span()));
    let whole = view.range(trimmed(view, node.span));
    for range in [whole, own].into_iter().take(if whole == own { 1 } else { 2 }) {
        if range.start.line < range.end.line {
            ranges.push(FoldingRange {
                start_line: range.start.line,
                end_line: range.end.line,
                kind: Some(FoldingRangeKind::Region),
                ..FoldingRange::default()
            });
        }
    }
    for child in &node.children {
        fold(view, child, ranges);
    }
}

/// A span without blanks, line ends and whole lines of comments at its end: comments before the next block belong to that.
fn trimmed(view: View<'_>, span: Span) -> Span {
    let Some(text) = view.text_of(span.source()) else { return span };
    let mut end = span.end();
    while end > span.start() {
        let (number, start) = text.line_of(end - 1);
        let (_, line) = text.line(number);
        let is_over = start > span.start() && matches!(line_kind(line), LineKind::Comment | LineKind::Blank);
        if !is_over {
            let content = start + line.trim_ascii_end().len() as u64;
            return Span::new(span.source(), span.start(), content.min(end).max(span.start()));
        }
        end = start;
    }
    Span::new(span.source(), span.start(), end)
}

pub(super) fn selection(
    workspace: &mut Workspace,
    params: &SelectionRangeParams,
) -> Result<Option<Vec<SelectionRange>>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    let tree = tree(view);
    let of = |position: &Position| selection_at(view, &tree, view.offset(*position));
    Ok(Some(params.positions.iter().map(of).collect()))
}

/// Item, line, group of a table, rows, block, interaction, step, document.
fn selection_at(view: View<'_>, tree: &[Node<'_>], offset: u64) -> SelectionRange {
    let mut spans = vec![super::findings::whole(view, view.source)];
    let mut nodes = tree;
    while let Some(node) = nodes.iter().find(|node| node.span.touches(view.at(offset))) {
        spans.push(trimmed(view, node.span));
        let block = node.entry.block;
        if node.children.iter().all(|child| offset < child.span.start() || child.span.end() < offset) {
            spans.push(trimmed(view, block.span()));
            if block.rows().start() <= offset {
                spans.push(trimmed(view, block.rows()));
                spans.extend(group_at(view, &node.entry, offset));
            }
            break;
        }
        nodes = &node.children;
    }
    if let Some((span, line)) = view.line_at(offset) {
        spans.push(span);
        spans.extend(items(line).map(|range| span.part(range)).find(|item| item.touches(view.at(offset))));
        // On *CONTACT PAIR, INTERACTION=X the name alone as well.
        spans.extend(names::at(view, offset).map(|found| found.span));
    }
    let holding = spans.into_iter().filter(|span| span.touches(view.at(offset)));
    let ranges = holding.map(|span| view.range(span));
    let mut selection: Option<SelectionRange> = None;
    for range in ranges {
        match &selection {
            Some(outer) if !is_within(range, outer.range) || range == outer.range => {}
            _ => selection = Some(SelectionRange { range, parent: selection.take().map(Box::new) }),
        }
    }
    selection.unwrap_or_default()
}

fn is_within(inner: Range, outer: Range) -> bool {
    outer.start <= inner.start && inner.end <= outer.end
}

/// The group of a table that a place lies in.
fn group_at(view: View<'_>, entry: &Entry<'_>, offset: u64) -> Option<Span> {
    let table = cells::table_of(view.analysis, entry)?;
    let row = table.row_spans().position(|row| row.touches(view.at(offset)))?;
    let group = table.groups().find(|group| group.contains(&row))?;
    let (first, last) = (table.row_span(group.start), table.row_span(group.end - 1));
    (first.source() == view.source && last.source() == view.source).then(|| first.to(last))
}
