//! Completion: keywords that are valid here, parameters, their values, names that the deck defines, files.

use super::blocks::{self, Context, Entry};
use super::names::{self, Kind};
use super::refusal::{self, Refusal};
use super::snippets;
use super::workspace::{View, Workspace};
use crate::page;
use gen_lsp_types::{
    CompletionItem, CompletionItemKind, CompletionList, CompletionParams, CompletionResponse, Documentation,
    InsertTextFormat, MarkupContent, MarkupKind, TextEdit,
};
use inpact_parser::deck::lines::{LineKind, line_kind};
use inpact_parser::grammar::{Definition, ParameterDefinition, ParameterKind};
use inpact_parser::span::Span;
use std::path::Path;

const MAX_FILES: usize = 500;

pub(super) fn complete(
    workspace: &mut Workspace,
    params: &CompletionParams,
) -> Result<Option<CompletionResponse>, Refusal> {
    let at = &params.text_document_position_params;
    let view = refusal::view(workspace, &at.text_document)?;
    let offset = view.offset(at.position);
    let items = items_at(view, offset).unwrap_or_default();
    Ok(Some(CompletionList { items, ..CompletionList::default() }.into()))
}

struct Place<'a> {
    view: View<'a>,
    /// The cursor position.
    offset: u64,
    /// The line up to there, and where it begins.
    before: Vec<u8>,
    start: u64,
    /// The rest of the line.
    after: Vec<u8>,
}

fn items_at(view: View<'_>, offset: u64) -> Option<Vec<CompletionItem>> {
    let (span, line) = view.line_at(offset)?;
    let start = span.start();
    let at = usize::try_from(offset - start).ok()?.min(line.len());
    let place = Place { view, offset, before: line[..at].to_vec(), start, after: line[at..].to_vec() };
    match line_kind(line) {
        LineKind::Comment | LineKind::IndentedComment => Some(place.codes()),
        LineKind::Keyword => place.on_keyword_line(start, &place.before.clone()),
        LineKind::Blank | LineKind::Data => place.on_row(),
    }
}

impl<'a> Place<'a> {
    /// `** inpact: ignore T0`: codes of rules.
    fn codes(&self) -> Vec<CompletionItem> {
        let before = String::from_utf8_lossy(&self.before);
        if !before.contains("inpact:") {
            return Vec::new();
        }
        let word = before.len() - before.trim_end_matches(|character: char| character.is_ascii_alphanumeric()).len();
        let item = |rule: &inpact_diagnostics::Rule| CompletionItem {
            detail: Some(rule.name.to_owned()),
            documentation: Some(markdown(page::of_rule(rule))),
            ..self.item(rule.code, CompletionItemKind::EnumMember, word, rule.code.to_owned())
        };
        inpact_validation::RULES
            .iter()
            .map(|rule| item(rule))
            .chain(
                // The directive itself, if it is not typed yet.
                (!before.contains("ignore"))
                    .then(|| self.item("ignore", CompletionItemKind::Keyword, word, "ignore ".to_owned())),
            )
            .filter(|item| before.contains("ignore") || item.label == "ignore")
            .collect()
    }

    /// On a keyword line, whose text up to here is given.
    fn on_keyword_line(&self, keyword_start: u64, text: &[u8]) -> Option<Vec<CompletionItem>> {
        let after_comma = last_comma(text);
        let Some(comma) = after_comma else { return Some(self.keywords(text)) };
        let entry = self.entry(keyword_start)?;
        let item = &text[comma + 1..];
        match item.iter().position(|byte| *byte == b'=') {
            Some(equals) => Some(self.values(&entry, &item[..equals], &item[equals + 1..])),
            None => Some(self.parameters(&entry, item)),
        }
    }

    /// The keyword line that begins there, as far as it is known.
    fn entry(&self, keyword_start: u64) -> Option<Entry<'a>> {
        let begins = |entry: &Entry<'_>| {
            entry.keyword.span.source() == self.view.source
                && entry.keyword.span.start() <= keyword_start
                && keyword_start < entry.keyword.span.end().max(entry.keyword.span.start() + 1)
        };
        blocks::entries(self.view.analysis).find(begins)
    }

    fn keywords(&self, text: &[u8]) -> Vec<CompletionItem> {
        let grammar = self.view.analysis.settings.grammar;
        let context = blocks::context_at(self.view.analysis, self.view.source, self.start);
        let typed = text.trim_ascii_start().len();
        // Text after the cursor is kept: then a snippet would be too much.
        let is_alone = self.after.trim_ascii().is_empty();
        let listed = grammar.keywords().filter(|(id, _)| grammar.has(*id));
        let items = listed.filter_map(|(_, keyword)| {
            let label = format!("*{}", keyword.name);
            let Some(definition) = keyword.definition() else {
                let item = self.item(&label, CompletionItemKind::Keyword, typed, label.clone());
                return Some(CompletionItem { sort_text: Some(format!("3{label}")), ..item });
            };
            let order = order_of(definition, context)?;
            let snippet = if is_alone { snippets::of_keyword(definition, grammar) } else { label.clone() };
            let item = self.snippet(&label, CompletionItemKind::Keyword, typed, snippet);
            Some(CompletionItem {
                detail: Some(definition.summary.clone()),
                documentation: Some(markdown(page::of_keyword(definition))),
                sort_text: Some(format!("{order}{label}")),
                ..item
            })
        });
        items.collect()
    }

    fn parameters(&self, entry: &Entry<'_>, typed: &[u8]) -> Vec<CompletionItem> {
        let Some(definition) = entry.definition else { return Vec::new() };
        let release = self.view.analysis.settings.grammar.release();
        let typed = typed.trim_ascii_start();
        let here = Span::new(self.view.source, self.offset - typed.len() as u64, self.offset);
        let is_given = |parameter: &ParameterDefinition| {
            let others = entry.keyword.parameters().filter(|given| !given.name.touches(here));
            others.filter_map(|given| given.index()).any(|index| definition.parameters[index].name == parameter.name)
        };
        let has_value = self.after.trim_ascii_start().first() == Some(&b'=');
        let offered = definition.parameters.iter().filter(|parameter| {
            !is_given(parameter)
                && release.is_within(parameter.since, parameter.until)
                && parameter.stands_for.is_none()
        });
        let item = |parameter: &ParameterDefinition| {
            let snippet = if has_value { parameter.name.clone() } else { snippets::of_parameter(parameter) };
            let order = u8::from(!parameter.required);
            CompletionItem {
                detail: Some(detail(parameter)),
                documentation: Some(markdown(page::parameter_item(parameter))),
                sort_text: Some(format!("{order}{}", parameter.name)),
                ..self.snippet(&parameter.name, CompletionItemKind::Property, typed.len(), snippet)
            }
        };
        offered.map(item).collect()
    }

    fn values(&self, entry: &Entry<'_>, parameter: &[u8], typed: &[u8]) -> Vec<CompletionItem> {
        let typed = typed.trim_ascii_start().len();
        let meant = entry.definition.and_then(|definition| {
            let grammar = self.view.analysis.settings.grammar;
            let index = grammar.parameter_named(definition, parameter.trim_ascii()).found()?;
            Some(&definition.parameters[index])
        });
        match meant.map(|parameter| parameter.kind) {
            Some(ParameterKind::Choice) => {
                let choices = meant.iter().flat_map(|parameter| &parameter.choices);
                choices.map(|choice| self.item(choice, CompletionItemKind::EnumMember, typed, choice.clone())).collect()
            }
            Some(ParameterKind::File) => self.files(typed),
            _ => {
                names::kinds_of_value(entry.name, parameter).iter().flat_map(|kind| self.names(*kind, typed)).collect()
            }
        }
    }

    /// A row: parameters after `<`, and names where an item is one.
    fn on_row(&self) -> Option<Vec<CompletionItem>> {
        if let Some(open) = self.before.iter().rposition(|byte| *byte == b'<')
            && !self.before[open..].contains(&b'>')
        {
            let typed = self.before.len() - open - 1;
            let close = if self.after.first() == Some(&b'>') { "" } else { ">" };
            let parameters = self.view.analysis.model.parameters.final_definitions();
            let item = |definition: &inpact_parser::expression::Definition| CompletionItem {
                detail: definition.value.as_ref().map(|value| format!("= {value}")),
                ..self.item(
                    &definition.name,
                    CompletionItemKind::Variable,
                    typed,
                    format!("{}{close}", definition.name),
                )
            };
            return Some(parameters.map(item).collect());
        }
        let entry = blocks::owner_at(self.view.analysis, self.view.source, self.start)?;
        if entry.keyword.span.source() == self.view.source && self.start < entry.keyword.span.end() {
            // A line that continues the keyword line.
            let start = entry.keyword.span.start();
            let text = self.view.text(Span::new(self.view.source, start, self.offset));
            return self.on_keyword_line(start, &text);
        }
        // A keyword line that ends in a comma continues here.
        if entry.keyword.dangling_comma().is_some() && entry.block.rows().start() == self.start && self.after.is_empty()
        {
            return Some(self.parameters(&entry, &self.before));
        }
        let index = memchr::memchr_iter(b',', &self.before).count();
        let typed = self
            .before
            .iter()
            .rposition(|byte| *byte == b',')
            .map_or(&self.before[..], |comma| &self.before[comma + 1..]);
        let typed = typed.trim_ascii_start().len();
        let kinds = names::kinds_of_item(&entry, self.view, index);
        Some(kinds.iter().flat_map(|kind| self.names(*kind, typed)).collect())
    }

    fn names(&self, kind: Kind, typed: usize) -> Vec<CompletionItem> {
        let names = names::defined_names(self.view, kind);
        let item = |name: &inpact_parser::model::Name| CompletionItem {
            detail: Some(kind.word().to_owned()),
            ..self.item(name.written(), CompletionItemKind::Reference, typed, name.written().to_owned())
        };
        names.iter().map(item).collect()
    }

    /// Files that an *INCLUDE may name: those of the folder of the deck, and of the folders in it.
    fn files(&self, typed: usize) -> Vec<CompletionItem> {
        let place = self.view.analysis.place(inpact_parser::span::SourceId::ROOT);
        let Some(folder) = place.parent() else { return Vec::new() };
        let written = &self.before[self.before.len() - typed..];
        let inner = written.iter().rposition(|byte| *byte == b'/').map_or(&written[..0], |slash| &written[..=slash]);
        let below = String::from_utf8_lossy(inner).into_owned();
        let mut found: Vec<CompletionItem> = entries_of(&folder.join(&below))
            .into_iter()
            .filter(|(name, _)| place.file_name().is_none_or(|own| !below.is_empty() || own.to_string_lossy() != *name))
            .map(|(name, is_folder)| {
                let path = if is_folder { format!("{below}{name}/") } else { format!("{below}{name}") };
                let kind = if is_folder { CompletionItemKind::Folder } else { CompletionItemKind::File };
                self.item(&path, kind, typed, path.clone())
            })
            .collect();
        found.truncate(MAX_FILES);
        found
    }

    /// An item that replaces the typed text.
    fn item(&self, label: &str, kind: CompletionItemKind, typed: usize, new_text: String) -> CompletionItem {
        let span = Span::new(self.view.source, self.offset - typed as u64, self.offset);
        CompletionItem {
            label: label.to_owned(),
            kind: Some(kind),
            filter_text: Some(label.to_owned()),
            text_edit: Some(TextEdit { range: self.view.range(span), new_text }.into()),
            ..CompletionItem::default()
        }
    }

    fn snippet(&self, label: &str, kind: CompletionItemKind, typed: usize, snippet: String) -> CompletionItem {
        if !self.view.workspace.traits.knows_snippets {
            return self.item(label, kind, typed, snippets::plain(&snippet));
        }
        let format = Some(InsertTextFormat::Snippet);
        CompletionItem { insert_text_format: format, ..self.item(label, kind, typed, snippet) }
    }
}

/// The sort order of a keyword that is valid here; `None` for one that is not.
fn order_of(definition: &Definition, context: Context<'_>) -> Option<u8> {
    let is_in = |parent: &str| context.parent == Some(parent);
    let has_open_parent = definition.parents.iter().any(|parent| is_in(parent));
    if !definition.parents.is_empty() {
        return has_open_parent.then_some(0);
    }
    let is_at_level = definition.levels.is_empty() || definition.levels.contains(&context.level);
    is_at_level.then_some(1)
}

fn detail(parameter: &ParameterDefinition) -> String {
    let kind = match parameter.kind {
        ParameterKind::Flag => "flag",
        ParameterKind::Integer => "integer",
        ParameterKind::Float => "number",
        ParameterKind::Label => "name",
        ParameterKind::Text => "text",
        ParameterKind::Choice => "choice",
        ParameterKind::File => "file",
    };
    let required = if parameter.required { ", required" } else { "" };
    let default = parameter.default.as_ref().map_or_else(String::new, |default| format!(", default {default}"));
    format!("{kind}{required}{default}")
}

fn markdown(value: String) -> Documentation {
    MarkupContent { kind: MarkupKind::Markdown, value }.into()
}

/// The last comma outside of quotes.
fn last_comma(text: &[u8]) -> Option<usize> {
    let mut is_quoted = false;
    let mut last = None;
    for (at, byte) in text.iter().enumerate() {
        is_quoted ^= *byte == b'"';
        if *byte == b',' && !is_quoted {
            last = Some(at);
        }
    }
    last
}

/// The names in a folder, sorted, and whether each is a folder; hidden ones left out.
fn entries_of(folder: &Path) -> Vec<(String, bool)> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut found: Vec<(String, bool)> = entries
        .flatten()
        .filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let is_folder = entry.path().is_dir();
            (!name.starts_with('.')).then_some((name, is_folder))
        })
        .collect();
    found.sort();
    found
}
