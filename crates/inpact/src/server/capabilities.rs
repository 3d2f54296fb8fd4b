//! Capabilities of the server, and those of the client as far as they matter.

use super::tokens;
use super::workspace::Traits;
use gen_lsp_types::{
    CodeActionKind, CodeActionOptions, CodeLensOptions, CompletionOptions, DocumentLinkOptions, InitializeParams,
    InitializeResult, PositionEncodingKind, RenameOptions, Save, SaveOptions, SemanticTokensOptions,
    ServerCapabilities, ServerInfo, TextDocumentSyncKind, TextDocumentSyncOptions,
};
use inpact_diagnostics::ColumnUnit;

/// Abilities of the client.
pub(super) fn of_client(params: &InitializeParams) -> Traits {
    let item =
        params.capabilities.text_document.as_ref().and_then(|text| text.completion.as_ref()?.completion_item.as_ref());
    let workspace = params.capabilities.workspace.clone().unwrap_or_default();
    Traits {
        knows_snippets: item.and_then(|item| item.snippet_support) == Some(true),
        knows_versions: workspace.workspace_edit.and_then(|edit| edit.document_changes) == Some(true),
        watches_files: workspace.did_change_watched_files.and_then(|files| files.dynamic_registration) == Some(true),
        refreshes_lenses: workspace.code_lens.and_then(|lens| lens.refresh_support) == Some(true),
        refreshes_hints: workspace.inlay_hint.and_then(|hint| hint.refresh_support) == Some(true),
        refreshes_tokens: workspace.semantic_tokens.and_then(|tokens| tokens.refresh_support) == Some(true),
    }
}

/// The unit of columns: the first one offered by the client that is supported here; UTF-16 is the default.
pub(super) fn column_unit(params: &InitializeParams) -> ColumnUnit {
    let offered = params.capabilities.general.as_ref().and_then(|general| general.position_encodings.as_ref());
    let known = |kind: &PositionEncodingKind| match kind {
        PositionEncodingKind::UTF8 => Some(ColumnUnit::Utf8),
        PositionEncodingKind::UTF16 => Some(ColumnUnit::Utf16),
        PositionEncodingKind::UTF32 => Some(ColumnUnit::Utf32),
        PositionEncodingKind::Custom(_) => None,
    };
    offered.into_iter().flatten().find_map(known).unwrap_or_default()
}

pub(super) fn of_server(unit: ColumnUnit) -> InitializeResult {
    let encoding = match unit {
        ColumnUnit::Utf8 => PositionEncodingKind::UTF8,
        ColumnUnit::Utf16 => PositionEncodingKind::UTF16,
        ColumnUnit::Utf32 => PositionEncodingKind::UTF32,
    };
    let sync = TextDocumentSyncOptions {
        open_close: Some(true),
        change: Some(TextDocumentSyncKind::Incremental),
        save: Some(Save::SaveOptions(SaveOptions { include_text: Some(false) })),
        ..TextDocumentSyncOptions::default()
    };
    let completion = CompletionOptions {
        trigger_characters: Some(["*", ",", "=", "<", " "].map(str::to_owned).to_vec()),
        ..CompletionOptions::default()
    };
    let actions = CodeActionOptions {
        code_action_kinds: Some(vec![CodeActionKind::QuickFix, CodeActionKind::SourceFixAll]),
        ..CodeActionOptions::default()
    };
    let capabilities = ServerCapabilities {
        position_encoding: Some(encoding),
        text_document_sync: Some(sync.into()),
        completion_provider: Some(completion),
        hover_provider: Some(true.into()),
        definition_provider: Some(true.into()),
        references_provider: Some(true.into()),
        document_highlight_provider: Some(true.into()),
        document_symbol_provider: Some(true.into()),
        code_action_provider: Some(actions.into()),
        code_lens_provider: Some(CodeLensOptions::default()),
        document_link_provider: Some(DocumentLinkOptions::default()),
        document_formatting_provider: Some(true.into()),
        document_range_formatting_provider: Some(true.into()),
        rename_provider: Some(RenameOptions { prepare_provider: Some(true), ..RenameOptions::default() }.into()),
        folding_range_provider: Some(true.into()),
        selection_range_provider: Some(true.into()),
        semantic_tokens_provider: Some(
            SemanticTokensOptions {
                legend: tokens::legend(),
                range: Some(true.into()),
                full: Some(true.into()),
                ..SemanticTokensOptions::default()
            }
            .into(),
        ),
        inlay_hint_provider: Some(true.into()),
        ..ServerCapabilities::default()
    };
    let name = "inpact".to_owned();
    InitializeResult {
        capabilities,
        server_info: Some(ServerInfo { name, version: Some(env!("CARGO_PKG_VERSION").to_owned()) }),
    }
}
