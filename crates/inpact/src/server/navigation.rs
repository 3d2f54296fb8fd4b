//! Go to definition, find references, rename; and from *INCLUDE to the file.

use super::names::{self, Kind, Occurrence};
use super::refusal::{self, Refusal};
use super::workspace::{View, Workspace};
use gen_lsp_types::{
    Definition, DefinitionParams, DefinitionResponse, DocumentChange, DocumentHighlight, DocumentHighlightKind,
    DocumentHighlightParams, DocumentLink, DocumentLinkParams, Edit, Location, OptionalVersionedTextDocumentIdentifier,
    PrepareRenameParams, PrepareRenamePlaceholder, PrepareRenameResult, Range, ReferenceParams, RenameParams,
    TextDocumentEdit, TextDocumentIdentifier, TextDocumentPositionParams, TextEdit, WorkspaceEdit,
};
use inpact_parser::deck::IncludeOutcome;
use inpact_parser::expression::is_parameter_name;
use inpact_parser::model::Name;
use inpact_parser::span::SourceId;
use std::collections::{BTreeMap, BTreeSet};

pub(super) fn definition(
    workspace: &mut Workspace,
    params: &DefinitionParams,
) -> Result<Option<DefinitionResponse>, Refusal> {
    let at = &params.text_document_position_params;
    let view = refusal::view(workspace, &at.text_document)?;
    let offset = view.offset(at.position);
    if let Some(target) = included_at(view, offset) {
        return Ok(Some(Definition::Location(Location { uri: view.uri(target), range: Range::default() }).into()));
    }
    let Some(found) = names::at(view, offset) else { return Ok(None) };
    let defined = names::occurrences(view, found.kind, &found.name).into_iter().filter(|other| other.is_definition);
    let locations: Vec<Location> = defined.map(|other| view.location(other.span)).collect();
    Ok((!locations.is_empty()).then(|| Definition::LocationList(locations).into()))
}

/// The file of the *INCLUDE at a position.
fn included_at(view: View<'_>, offset: u64) -> Option<SourceId> {
    view.analysis.deck.includes().iter().find_map(|include| {
        let name = include.name.filter(|name| name.touches(view.at(offset)));
        match include.outcome {
            IncludeOutcome::Read(source) => name.map(|_| source),
            _ => None,
        }
    })
}

pub(super) fn references(
    workspace: &mut Workspace,
    params: &ReferenceParams,
) -> Result<Option<Vec<Location>>, Refusal> {
    let (view, found) = found_at(workspace, &params.text_document_position_params)?;
    let Some(found) = found else { return Ok(None) };
    let with_definitions = params.context.include_declaration;
    let uses = names::occurrences(view, found.kind, &found.name).into_iter();
    let uses = uses.filter(|other| with_definitions || !other.is_definition);
    Ok(Some(uses.map(|other| view.location(other.span)).collect()))
}

pub(super) fn highlights(
    workspace: &mut Workspace,
    params: &DocumentHighlightParams,
) -> Result<Option<Vec<DocumentHighlight>>, Refusal> {
    let (view, found) = found_at(workspace, &params.text_document_position_params)?;
    let Some(found) = found else { return Ok(None) };
    let here = names::occurrences(view, found.kind, &found.name).into_iter();
    let here = here.filter(|other| other.span.source() == view.source).map(|other| DocumentHighlight {
        range: view.range(other.span),
        kind: Some(if other.is_definition { DocumentHighlightKind::Write } else { DocumentHighlightKind::Read }),
    });
    Ok(Some(here.collect()))
}

fn found_at<'a>(
    workspace: &'a mut Workspace,
    at: &TextDocumentPositionParams,
) -> Result<(View<'a>, Option<Occurrence>), Refusal> {
    let view = refusal::view(workspace, &at.text_document)?;
    let found = names::at(view, view.offset(at.position));
    Ok((view, found))
}

pub(super) fn prepare_rename(
    workspace: &mut Workspace,
    params: &PrepareRenameParams,
) -> Result<Option<PrepareRenameResult>, Refusal> {
    let (view, found) = found_at(workspace, &params.text_document_position_params)?;
    let Some(found) = found else { return Ok(None) };
    refuse_unclear(view, &found)?;
    let placeholder = view.shown(found.span).trim().to_owned();
    Ok(Some(PrepareRenamePlaceholder { range: view.range(found.span), placeholder }.into()))
}

pub(super) fn rename(workspace: &mut Workspace, params: &RenameParams) -> Result<Option<WorkspaceEdit>, Refusal> {
    let (view, found) = found_at(workspace, &params.text_document_position_params)?;
    let Some(found) = found else {
        return Err(Refusal::failed("there is no name of an interaction, surface, set or parameter here"));
    };
    refuse_unclear(view, &found)?;
    let new_name = params.new_name.trim();
    refuse_name(view, &found, new_name)?;
    let mut edits: BTreeMap<SourceId, Vec<TextEdit>> = BTreeMap::new();
    for other in names::occurrences(view, found.kind, &found.name) {
        let edit = TextEdit { range: view.range(other.span), new_text: new_name.to_owned() };
        edits.entry(other.span.source()).or_default().push(edit);
    }
    Ok(Some(workspace_edit(view, edits)))
}

/// Rejects a rename that would affect more, or less, than intended.
fn refuse_unclear(view: View<'_>, found: &Occurrence) -> Result<(), Refusal> {
    let all = names::occurrences(view, found.kind, &found.name);
    let defined: Vec<&Occurrence> = all.iter().filter(|other| other.is_definition).collect();
    let word = found.kind.word();
    let name = &found.name;
    if defined.is_empty() {
        return Err(Refusal::failed(format!("no {word} `{name}` is defined in this deck")));
    }
    if all.iter().any(|other| other.is_guess) {
        let others = [Kind::Surface, Kind::NodeSet, Kind::ElementSet].into_iter().filter(|kind| *kind != found.kind);
        let is_defined = |kind: &Kind| names::occurrences(view, *kind, name).iter().any(|other| other.is_definition);
        if let Some(other) = others.into_iter().find(is_defined) {
            let message = format!(
                "`{name}` is the name of {} and of {}, and some keywords leave open which they mean: rename it by hand",
                found.kind.one(),
                other.one()
            );
            return Err(Refusal::failed(message));
        }
    }
    let scopes: BTreeSet<&str> = defined.iter().map(|other| other.scope.as_str()).collect();
    if scopes.len() > 1 {
        let scopes: Vec<String> = scopes
            .into_iter()
            .map(|scope| if scope.is_empty() { "the model".to_owned() } else { format!("`{scope}`") })
            .collect();
        let message = format!("the {word} `{name}` is defined in {}: rename it by hand", scopes.join(" and in "));
        return Err(Refusal::failed(message));
    }
    Ok(())
}

/// Rejects an invalid name, or one that is taken.
fn refuse_name(view: View<'_>, found: &Occurrence, new_name: &str) -> Result<(), Refusal> {
    let one = found.kind.one();
    let illegal = |why: &str| Err(Refusal::failed(format!("`{new_name}` is no name of {one}: {why}")));
    if found.kind == Kind::Parameter {
        if !is_parameter_name(new_name.as_bytes()) {
            return illegal("it is a letter or underscore, then letters, digits and underscores");
        }
        return match view.analysis.model.parameters.definition(new_name) {
            Some(_) if new_name != found.name.written() => illegal("there is such a parameter already"),
            _ => Ok(()),
        };
    }
    // S-39 to S-42.
    let inner = new_name.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).filter(|inner| !inner.is_empty());
    let is_plain = new_name.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_')
        && !new_name.contains([',', '=', '"', '.', '*', '<', '\n', '\r']);
    let is_quoted = inner.is_some_and(|inner| !inner.contains(['"', '\n', '\r']));
    if !is_plain && !is_quoted {
        return illegal("it begins with a letter and has no comma, `=`, period or quote, unless all of it is quoted");
    }
    if new_name.chars().count() > 80 {
        return illegal("it has more than 80 characters");
    }
    let name = Name::in_dialect(new_name, view.analysis.settings.grammar.dialect());
    let is_taken =
        name != found.name && names::occurrences(view, found.kind, &name).iter().any(|other| other.is_definition);
    if is_taken { illegal("there is one of that name already") } else { Ok(()) }
}

/// Edits of files of a deck; those of open documents are for the known version.
pub(super) fn workspace_edit(view: View<'_>, edits: BTreeMap<SourceId, Vec<TextEdit>>) -> WorkspaceEdit {
    if !view.workspace.traits.knows_versions {
        let changes = edits.into_iter().map(|(source, edits)| (view.uri(source), edits));
        return WorkspaceEdit { changes: Some(changes.collect()), ..WorkspaceEdit::default() };
    }
    let changes = edits.into_iter().map(|(source, edits)| {
        let version = view.workspace.version(view.analysis.place(source));
        let text_document = OptionalVersionedTextDocumentIdentifier {
            version,
            text_document_identifier: TextDocumentIdentifier { uri: view.uri(source) },
        };
        let edits = edits.into_iter().map(Edit::TextEdit).collect();
        DocumentChange::TextDocumentEdit(TextDocumentEdit { text_document, edits })
    });
    WorkspaceEdit { document_changes: Some(changes.collect()), ..WorkspaceEdit::default() }
}

pub(super) fn links(
    workspace: &mut Workspace,
    params: &DocumentLinkParams,
) -> Result<Option<Vec<DocumentLink>>, Refusal> {
    let view = refusal::view(workspace, &params.text_document)?;
    let links = view.analysis.deck.includes().iter().filter_map(|include| {
        let name = include.name.filter(|name| name.source() == view.source)?;
        let IncludeOutcome::Read(source) = include.outcome else { return None };
        let place = view.analysis.place(source).display().to_string();
        Some(DocumentLink { range: view.range(name), target: Some(view.uri(source)), tooltip: Some(place), data: None })
    });
    Ok(Some(links.collect()))
}
