//! Hover: describes the element at a position.

use super::blocks::{self, Entry};
use super::cells::{self, Cell};
use super::names::{self, Kind, parameter_at};
use super::refusal::{self, Refusal};
use super::shape::shape;
use super::workspace::{View, Workspace};
use crate::{page, rules};
use gen_lsp_types::{Hover, HoverParams, MarkupContent, MarkupKind};
use inpact_parser::deck::Parameter;
use inpact_parser::model::{Table, TableKind};
use inpact_parser::number::float_text;
use inpact_parser::span::Span;

pub(super) fn hover(workspace: &mut Workspace, params: &HoverParams) -> Result<Option<Hover>, Refusal> {
    let at = &params.text_document_position_params;
    let view = refusal::view(workspace, &at.text_document)?;
    let offset = view.offset(at.position);
    let Some((span, text)) = page_at(view, offset) else { return Ok(None) };
    let contents = MarkupContent { kind: MarkupKind::Markdown, value: text };
    Ok(Some(Hover { contents: contents.into(), range: Some(view.range(span)) }))
}

/// Text about a place, and its bytes.
fn page_at(view: View<'_>, offset: u64) -> Option<(Span, String)> {
    if let Some(found) = directive(view, offset) {
        return Some(found);
    }
    if let Some(found) = parameter_reference(view, offset) {
        return Some(found);
    }
    let entry = blocks::owner_at(view.analysis, view.source, offset)?;
    if entry.keyword.span.touches(view.at(offset)) && offset < entry.keyword.span.end() {
        return on_keyword_line(view, &entry, offset);
    }
    if let Some(found) = interaction(view, offset) {
        return Some(found);
    }
    let row = cells::rows(view.analysis, &entry)
        .find(|row| row.cells.iter().any(|cell| cell.span.touches(view.at(offset))))?;
    let cell = row.cells.iter().find(|cell| cell.span.touches(view.at(offset)))?;
    Some((cell.span, cell_page(view, &entry, cell)))
}

/// `** inpact: ignore T005`: the page of the rule.
fn directive(view: View<'_>, offset: u64) -> Option<(Span, String)> {
    let span = *view.analysis.deck.directives().iter().find(|span| span.touches(view.at(offset)))?;
    let word = word_at(view, span, offset, u8::is_ascii_alphanumeric)?;
    let rule = rules::of_code(&view.shown(word))?;
    Some((word, page::of_rule(rule)))
}

/// The bytes around a position that satisfy a predicate.
fn word_at(view: View<'_>, within: Span, offset: u64, is_part: fn(&u8) -> bool) -> Option<Span> {
    let text = view.text(within);
    let at = usize::try_from(offset - within.start()).ok()?;
    let before = text.get(..at)?.iter().rev().take_while(|byte| is_part(byte)).count();
    let after = text.get(at..)?.iter().take_while(|byte| is_part(byte)).count();
    (before + after > 0).then(|| Span::new(within.source(), offset - before as u64, offset + after as u64))
}

/// `<name>`: its value, and its definition.
fn parameter_reference(view: View<'_>, offset: u64) -> Option<(Span, String)> {
    let (span, name) = parameter_at(view, offset)?;
    let Some(definition) = view.analysis.model.parameters.definition(&name) else {
        return Some((span, format!("`<{name}>`: no *PARAMETER defines it")));
    };
    let value = definition.value.as_ref().map_or_else(|| "no value".to_owned(), ToString::to_string);
    let place = place_of(view, definition.span);
    let text = format!("`<{name}>` is **{value}**\n\n`{name} = {}`, at {place}", definition.expression);
    Some((span, text))
}

/// A place as text: file and line.
fn place_of(view: View<'_>, span: Span) -> String {
    let line = view.range(span).start.line + 1;
    let place = view.analysis.place(span.source());
    let name =
        place.file_name().map_or_else(|| place.display().to_string(), |name| name.to_string_lossy().into_owned());
    format!("[{name}:{line}]({}#L{line})", view.uri(span.source()).0)
}

fn on_keyword_line(view: View<'_>, entry: &Entry<'_>, offset: u64) -> Option<(Span, String)> {
    let given = entry.keyword.parameters().find(|given| given.span().touches(view.at(offset)));
    if let Some(given) = given {
        return interaction(view, offset).or_else(|| on_parameter(entry, given));
    }
    let span = entry.keyword.name();
    if !span.touches(view.at(offset)) && offset + 1 != span.start() {
        return None;
    }
    let text = match entry.definition {
        Some(definition) => page::of_keyword(definition),
        None => format!("# *{}\n\nA keyword of Abaqus; inpact knows no more of it than its name.", entry.name),
    };
    Some((span, text))
}

fn on_parameter(entry: &Entry<'_>, given: Parameter) -> Option<(Span, String)> {
    let definition = entry.definition?;
    let parameter = &definition.parameters[given.index()?];
    let text = format!("*{}\n\n{}\nSource: {}", definition.name, page::parameter_item(parameter), parameter.source);
    Some((given.span(), text))
}

/// An interaction: its sub-options and uses.
fn interaction(view: View<'_>, offset: u64) -> Option<(Span, String)> {
    let found = names::at(view, offset)?;
    if found.kind != Kind::Interaction {
        return None;
    }
    let mut text = format!("interaction `{}`", found.name);
    match view.analysis.model.interactions.get(&found.name) {
        None => text += ": not defined in this deck",
        Some(interaction) => {
            text += &format!(", defined at {}\n\n", place_of(view, interaction.span));
            let mut options: Vec<String> = Vec::new();
            if let Some(option) = &interaction.gap_electrical_conductance {
                let tables = [&option.clearance, &option.pressure].into_iter().flatten();
                options.extend(option.user.map(|_| "*GAP ELECTRICAL CONDUCTANCE, USER".to_owned()));
                options.extend(tables.map(|table| format!("*GAP ELECTRICAL CONDUCTANCE: {}", shape(table))));
            }
            if let Some(option) = &interaction.contact_permeability {
                let shape = option.table.as_ref().map_or_else(|| "infinite".to_owned(), shape);
                options.push(format!("*CONTACT PERMEABILITY: {shape}"));
            }
            if let Some(option) = &interaction.gap_heat_generation {
                let (fraction, weight) = (float_text(option.fraction), float_text(option.slave_weight));
                options.push(format!("*GAP HEAT GENERATION: fraction {fraction}, weight of the slave {weight}"));
            }
            for option in &interaction.other {
                let shape = option.table.as_ref().map(|table| format!(": {}", shape(table)));
                options.push(format!("*{}{}", option.keyword, shape.unwrap_or_default()));
            }
            if options.is_empty() {
                options.push("no property".to_owned());
            }
            text += &options.iter().map(|option| format!("- {option}\n")).collect::<String>();
        }
    }
    let uses = names::occurrences(view, Kind::Interaction, &found.name);
    let uses: Vec<_> = uses.into_iter().filter(|occurrence| !occurrence.is_definition).collect();
    text += if uses.is_empty() { "\nUsed nowhere in this deck\n" } else { "\nUsed by:\n" };
    for used in &uses {
        let entry = blocks::owner_at(view.analysis, used.span.source(), used.span.start());
        let keyword = entry.map_or("", |entry| entry.name);
        text += &format!("- *{keyword} at {}\n", place_of(view, used.span));
    }
    Some((found.span, text))
}

/// Text about a cell: column, dimension, description, row and group; for a conductance the value beyond the table.
fn cell_page(view: View<'_>, entry: &Entry<'_>, cell: &Cell<'_>) -> String {
    let column = cell.column;
    let dimension = column.dimension().map_or_else(String::new, |dimension| format!(" [{dimension}]"));
    let mut text = format!("**{}**{dimension}: {}\n", column.name(), column.description());
    let written = view.shown(cell.span);
    if written.is_empty() {
        if let Some(default) = column.default() {
            text += &format!("\nEmpty: {}\n", float_text(default));
        }
    } else {
        let value = blocks::substituted(view.analysis, &written);
        if value != written {
            text += &format!("\n`{written}` is {value}\n");
        }
    }
    if let Some(table) = cells::table_of(view.analysis, entry) {
        text += &in_table(view, entry, table, cell);
    }
    text + &format!("\n*{}, item {}. Source: {}", entry.name, cell.index + 1, column.source())
}

/// Row, group and value of a cell of a table.
fn in_table(view: View<'_>, entry: &Entry<'_>, table: &Table, cell: &Cell<'_>) -> String {
    let holds =
        |row: Span| row.contains(cell.span) || (row.source() == cell.span.source() && row.start() == cell.span.start());
    let Some(row) = table.row_spans().position(holds) else { return String::new() };
    let mut text = String::new();
    let (value, written) = (table.row(row).get(cell.index).copied(), view.shown(cell.span));
    if let Some(value) = value.filter(|value| value.is_finite() && float_text(*value) != written && !written.is_empty())
    {
        text += &format!("\nValue: {}\n", float_text(value));
    }
    let groups: Vec<std::ops::Range<usize>> = table.groups().collect();
    let Some(group) = groups.iter().position(|group| group.contains(&row)) else { return text };
    let rows = groups[group].clone();
    text += &format!("\nRow {} of {}", row + 1, table.row_count());
    if table.width() > 2 {
        let outer: Vec<String> = table.columns[2..]
            .iter()
            .zip(&table.row(row)[2..])
            .map(|(column, value)| format!("{column} = {}", float_text(*value)))
            .collect();
        text += &format!(", in group {} of {} ({})", group + 1, groups.len(), outer.join(", "));
        text += &format!(", row {} of {} of the group", row - rows.start + 1, rows.len());
    }
    text += "\n";
    if cell.index == 1 && row + 1 == rows.end {
        // T-27, Q-1: thermal tables drop to zero at their end, those of current and fluid continue.
        let is_zero = matches!(TableKind::of(entry.name, table), TableKind::ThermalClearance | TableKind::ViewFactor);
        text += if is_zero { "\nBeyond it nothing is conducted\n" } else { "\nBeyond it the last value holds\n" };
    }
    text
}
