//! Inlay hints: names of columns, values of parameters, shapes of tables.

use super::blocks;
use super::cells::{self, ColumnOf};
use super::refusal::{self, Refusal};
use super::shape::shape;
use super::workspace::{View, Workspace};
use gen_lsp_types::{
    CodeLens, CodeLensParams, Command, InlayHint, InlayHintKind, InlayHintParams, Label, Position, Tooltip,
};
use inpact_parser::expression::references;
use inpact_parser::grammar::RowShape;
use inpact_parser::model::{TableKind, TableOf};
use inpact_parser::span::Span;
use serde_json::{Value, json};

/// The maximum number of bytes of rows searched for parameters at a time: an editor requests only the visible part.
const MAX_BYTES: u64 = 1 << 20;

pub(super) fn hints(workspace: &mut Workspace, params: &InlayHintParams) -> Result<Option<Vec<InlayHint>>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    let shown = view.bytes(params.range);
    let mut hints = Vec::new();
    for entry in blocks::entries(view.analysis) {
        if entry.block.span().touches(shown) {
            hints.extend(names_of_columns(view, &entry));
        }
    }
    hints.extend(values(view, shown));
    hints.sort_by_key(|hint| hint.position);
    Ok(Some(hints))
}

/// The name of each column before its item in the first row of a table.
fn names_of_columns(view: View<'_>, entry: &blocks::Entry<'_>) -> Vec<InlayHint> {
    let shape = entry.definition.map(inpact_parser::grammar::Definition::rows);
    let rows = match shape {
        Some(RowShape::Table | RowShape::Line) => 1,
        // The line before the rows, and the first row.
        Some(RowShape::HeadedTable) => 2,
        _ => return Vec::new(),
    };
    let first = cells::rows(view.analysis, entry).take(rows).flat_map(|row| row.cells);
    let hint = |cell: cells::Cell<'_>| InlayHint {
        label: Label::String(format!("{}:", cell.column.name())),
        kind: Some(InlayHintKind::Parameter),
        tooltip: Some(Tooltip::String(tooltip(cell.column))),
        padding_right: Some(true),
        ..hint_at(view.range(cell.span).start)
    };
    first.filter(|cell| cell.span.source() == view.source && !cell.span.is_empty()).map(hint).collect()
}

fn tooltip(column: ColumnOf<'_>) -> String {
    let dimension = column.dimension().map_or_else(String::new, |dimension| format!(" [{dimension}]"));
    format!("{}{dimension}", column.description())
}

/// The value of each `<name>` after it.
fn values(view: View<'_>, shown: Span) -> Vec<InlayHint> {
    let parameters = &view.analysis.model.parameters;
    if parameters.definitions().is_empty() {
        return Vec::new();
    }
    let Some(text) = view.text_of(view.source) else { return Vec::new() };
    let (_, start) = text.line_of(shown.start());
    let part = Span::new(view.source, start, shown.end().min(start + MAX_BYTES));
    let mut hints = Vec::new();
    for (line, bytes) in view.lines(part) {
        for reference in references(&bytes) {
            let Some(value) = parameters.value(reference.name) else { continue };
            let end = line.start() + reference.range.end as u64;
            let position = view.range(Span::new(view.source, end, end)).start;
            hints.push(InlayHint {
                label: Label::String(format!("= {value}")),
                kind: Some(InlayHintKind::Type),
                padding_left: Some(true),
                ..hint_at(position)
            });
        }
    }
    hints
}

fn hint_at(position: Position) -> InlayHint {
    InlayHint {
        position,
        label: Label::String(String::new()),
        kind: None,
        text_edits: None,
        tooltip: None,
        padding_left: None,
        padding_right: None,
        data: None,
    }
}

/// The shape of each table above it.
pub(super) fn lenses(workspace: &mut Workspace, params: &CodeLensParams) -> Result<Option<Vec<CodeLens>>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    let mut lenses = Vec::new();
    for of in view.analysis.model.tables() {
        let keyword = of.table.keyword;
        if keyword.source() != view.source {
            continue;
        }
        let range = view.range(Span::new(keyword.source(), keyword.start(), keyword.start()));
        // A command without a name is plain text, unless the editor has a command that draws the table of the argument.
        let arguments = drawing(view, &of).map(|drawing| vec![drawing]);
        let command = Command { title: shape(of.table), tooltip: None, command: String::new(), arguments };
        lenses.push(CodeLens { range, command: Some(command), data: None });
    }
    lenses.sort_by_key(|lens| lens.range.start);
    lenses.dedup_by_key(|lens| lens.range.start);
    Ok(Some(lenses))
}

/// The drawing that `inpact plot` makes for a table, and the lines of the table: `None` for one without effect or without a curve.
fn drawing(view: View<'_>, of: &TableOf<'_>) -> Option<Value> {
    let interaction = of.interaction?;
    let governing = view.analysis.model.interactions.get(&interaction.name)?;
    if !std::ptr::eq(governing, interaction) {
        return None;
    }
    let law = match of.kind {
        TableKind::ElectricalClearance | TableKind::ElectricalPressure => "electrical",
        TableKind::ThermalClearance | TableKind::ThermalPressure => "thermal",
        TableKind::Permeability => "permeability",
        TableKind::ViewFactor => "view-factor",
        _ => return None,
    };
    let block = blocks::block_at(view.analysis, view.source, of.table.keyword.start())?;
    // The end of a block is where the next one begins.
    let span = block.span();
    let lines = view.range(Span::new(view.source, span.start(), span.end().saturating_sub(1).max(span.start())));
    let lines = [lines.start.line, lines.end.line];
    Some(json!({"interaction": interaction.name.to_string(), "law": law, "lines": lines}))
}
