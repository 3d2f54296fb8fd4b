//! Semantic tokens: keywords, parameters, names, and each column of rows in a colour of its own.
//!
//! The types are standard ones that every editor has colours for; columns cycle through them.

use super::blocks::{self, Entry};
use super::cells;
use super::refusal::{self, Refusal};
use super::workspace::{View, Workspace};
use gen_lsp_types::{
    SemanticToken, SemanticTokens, SemanticTokensLegend, SemanticTokensParams, SemanticTokensRangeParams,
};
use inpact_parser::grammar::ParameterKind;
use inpact_parser::span::Span;

/// The types of tokens, in the order of their numbers.
const TYPES: [&str; 9] =
    ["keyword", "parameter", "string", "number", "comment", "variable", "type", "function", "enumMember"];

const KEYWORD: u32 = 0;
const PARAMETER: u32 = 1;
const STRING: u32 = 2;
const NUMBER: u32 = 3;
const DIRECTIVE: u32 = 4;
/// The columns of rows, in turn.
const COLUMNS: [u32; 5] = [NUMBER, 5, 6, 7, 8];

pub(super) fn legend() -> SemanticTokensLegend {
    SemanticTokensLegend { token_types: TYPES.map(str::to_owned).to_vec(), token_modifiers: Vec::new() }
}

pub(super) fn full(
    workspace: &mut Workspace,
    params: &SemanticTokensParams,
) -> Result<Option<SemanticTokens>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    Ok(Some(tokens(view, super::findings::whole(view, view.source))))
}

pub(super) fn range(
    workspace: &mut Workspace,
    params: &SemanticTokensRangeParams,
) -> Result<Option<SemanticTokens>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    let shown = view.bytes(params.range);
    Ok(Some(tokens(view, shown)))
}

fn tokens(view: View<'_>, shown: Span) -> SemanticTokens {
    let is_shown = |span: Span| span.touches(shown);
    let mut found: Vec<(Span, u32)> = Vec::new();
    for entry in blocks::entries(view.analysis) {
        if is_shown(entry.keyword.span) {
            on_keyword_line(&entry, &mut found);
        }
        if entry.rows().any(is_shown) {
            let cells = cells::rows(view.analysis, &entry).flat_map(|row| row.cells);
            found.extend(cells.map(|cell| (cell.span, COLUMNS[cell.index % COLUMNS.len()])));
        }
    }
    found.extend(view.analysis.deck.directives().iter().map(|span| (*span, DIRECTIVE)));
    found.retain(|(span, _)| is_shown(*span) && !span.is_empty());
    found.sort_by_key(|(span, _)| span.start());
    found.dedup_by_key(|(span, _)| span.start());
    encoded(view, &found)
}

fn on_keyword_line(entry: &Entry<'_>, found: &mut Vec<(Span, u32)>) {
    let name = entry.keyword.name();
    // With its asterisk, if directly before it.
    let start = name.start().saturating_sub(1).max(entry.keyword.span.start());
    found.push((Span::new(name.source(), start, name.end()), KEYWORD));
    for given in entry.keyword.parameters() {
        found.push((given.name, PARAMETER));
        let kind = given.index().and_then(|index| Some(entry.definition?.parameters[index].kind));
        let is_number = matches!(kind, Some(ParameterKind::Integer | ParameterKind::Float));
        found.extend(given.value.map(|value| (value, if is_number { NUMBER } else { STRING })));
    }
}

/// Tokens in the encoding of the protocol, each relative to the previous one.
fn encoded(view: View<'_>, found: &[(Span, u32)]) -> SemanticTokens {
    let mut data = Vec::with_capacity(found.len());
    let (mut line, mut character) = (0, 0);
    for (span, kind) in found {
        let range = view.range(*span);
        // A token lies on one line.
        if range.start.line != range.end.line || range.end.character <= range.start.character {
            continue;
        }
        let is_same_line = range.start.line == line;
        if is_same_line && range.start.character < character {
            continue;
        }
        data.push(SemanticToken {
            delta_line: range.start.line - line,
            delta_start: if is_same_line { range.start.character - character } else { range.start.character },
            length: range.end.character - range.start.character,
            token_type: *kind,
            token_modifiers_bitset: 0,
        });
        (line, character) = (range.start.line, range.start.character);
    }
    SemanticTokens { result_id: None, data }
}
