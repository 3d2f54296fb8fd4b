//! Dispatch of requests by method.

use super::refusal::Refusal;
use super::workspace::Workspace;
use super::{actions, completion, formatting, hints, hover, navigation, outline, tokens};
use crate::stop::Stopped;
use gen_lsp_types as lsp;
use lsp_server::{ErrorCode, Request, Response};
use std::panic::{AssertUnwindSafe, catch_unwind};

pub(super) fn answer(workspace: &mut Workspace, request: Request) -> Response {
    match request.method.as_str() {
        "textDocument/hover" => by::<lsp::HoverRequest>(workspace, request, hover::hover),
        "textDocument/completion" => by::<lsp::CompletionRequest>(workspace, request, completion::complete),
        "textDocument/definition" => by::<lsp::DefinitionRequest>(workspace, request, navigation::definition),
        "textDocument/references" => by::<lsp::ReferencesRequest>(workspace, request, navigation::references),
        "textDocument/documentHighlight" => {
            by::<lsp::DocumentHighlightRequest>(workspace, request, navigation::highlights)
        }
        "textDocument/prepareRename" => by::<lsp::PrepareRenameRequest>(workspace, request, navigation::prepare_rename),
        "textDocument/rename" => by::<lsp::RenameRequest>(workspace, request, navigation::rename),
        "textDocument/documentLink" => by::<lsp::DocumentLinkRequest>(workspace, request, navigation::links),
        "textDocument/documentSymbol" => by::<lsp::DocumentSymbolRequest>(workspace, request, outline::symbols),
        "textDocument/foldingRange" => by::<lsp::FoldingRangeRequest>(workspace, request, outline::folding),
        "textDocument/selectionRange" => by::<lsp::SelectionRangeRequest>(workspace, request, outline::selection),
        "textDocument/codeAction" => by::<lsp::CodeActionRequest>(workspace, request, actions::actions),
        "textDocument/codeLens" => by::<lsp::CodeLensRequest>(workspace, request, hints::lenses),
        "textDocument/inlayHint" => by::<lsp::InlayHintRequest>(workspace, request, hints::hints),
        "textDocument/formatting" => by::<lsp::DocumentFormattingRequest>(workspace, request, formatting::whole),
        "textDocument/rangeFormatting" => {
            by::<lsp::DocumentRangeFormattingRequest>(workspace, request, formatting::range)
        }
        "textDocument/semanticTokens/full" => by::<lsp::SemanticTokensRequest>(workspace, request, tokens::full),
        "textDocument/semanticTokens/range" => by::<lsp::SemanticTokensRangeRequest>(workspace, request, tokens::range),
        other => {
            let message = format!("there is no method `{other}`");
            Refusal::new(ErrorCode::MethodNotFound, message).answer(request.id)
        }
    }
}

/// Answers a request by a function; a panic or a cancellation in it becomes an error response.
fn by<R: lsp::Request>(
    workspace: &mut Workspace,
    Request { id, method, params }: Request,
    function: impl FnOnce(&mut Workspace, &R::Params) -> Result<R::Result, Refusal>,
) -> Response {
    let params: R::Params = match serde_json::from_value(params) {
        Ok(params) => params,
        Err(error) => {
            let message = format!("the parameters of `{method}` cannot be read: {error}");
            return Refusal::new(ErrorCode::InvalidParams, message).answer(id);
        }
    };
    // Open documents are changed by notifications only, on a copy, so the state is unwind-safe.
    match catch_unwind(AssertUnwindSafe(|| function(workspace, &params))) {
        Ok(Ok(result)) => Response::new_ok(id, result),
        Ok(Err(refusal)) => refusal.answer(id),
        Err(cause) if cause.is::<Stopped>() => Refusal::cancelled().answer(id),
        Err(_) => {
            let message = format!("`{method}` failed by a fault of inpact; what is open is not affected");
            Refusal::new(ErrorCode::InternalError, message).answer(id)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::server::workspace::Traits;
    use crate::stop::Stop;
    use inpact_diagnostics::ColumnUnit;
    use inpact_parser::deck::EditedText;
    use serde_json::json;

    #[test]
    fn a_panic_is_answered_and_loses_no_document() {
        let mut workspace = Workspace::default();
        let uri = lsp::Uri("untitled:deck".to_owned());
        workspace.open(uri.clone(), 1, EditedText::new(b"*HEADING\n"));
        let params = json!({"textDocument": {"uri": uri.0}, "position": {"line": 0, "character": 2}});
        let request = |id: i32| Request::new(id.into(), "textDocument/hover".to_owned(), params.clone());
        let failed = by::<lsp::HoverRequest>(&mut workspace, request(1), |_, _| panic!("a fault"));
        assert_eq!(failed.response_result.unwrap_err().code, ErrorCode::InternalError as i32);
        let answered = answer(&mut workspace, request(2));
        assert!(answered.response_result.unwrap()["contents"]["value"].as_str().unwrap().contains("# *HEADING"));
    }

    #[test]
    fn a_deck_that_nobody_waited_for_is_read_for_the_next() {
        let stop = Stop::new();
        let mut workspace = Workspace::new(ColumnUnit::Utf16, Traits::default(), stop.clone());
        let uri = lsp::Uri("untitled:deck".to_owned());
        workspace.open(uri.clone(), 1, EditedText::new(b"*SURFACE INTERACTION, NAME=A\n"));
        let symbols = |workspace: &mut Workspace, id: i32| {
            let params = json!({"textDocument": {"uri": uri.0}});
            let request = Request::new(id.into(), "textDocument/documentSymbol".to_owned(), params);
            answer(workspace, request).response_result
        };
        stop.request();
        assert_eq!(symbols(&mut workspace, 1).unwrap_err().code, ErrorCode::RequestCanceled as i32);
        stop.clear();
        assert_eq!(symbols(&mut workspace, 2).unwrap()[0]["name"], "*SURFACE INTERACTION A");
        // What is cancelled when the deck has been read changes nothing either.
        stop.request();
        assert_eq!(symbols(&mut workspace, 3).unwrap_err().code, ErrorCode::RequestCanceled as i32);
        stop.clear();
        assert_eq!(symbols(&mut workspace, 4).unwrap()[0]["name"], "*SURFACE INTERACTION A");
    }

    #[test]
    fn what_is_no_request_of_ours_is_refused() {
        let mut workspace = Workspace::default();
        let code = |workspace: &mut Workspace, method: &str, params| {
            let response = answer(workspace, Request::new(1.into(), method.to_owned(), params));
            response.response_result.unwrap_err().code
        };
        assert_eq!(code(&mut workspace, "textDocument/nothing", json!({})), ErrorCode::MethodNotFound as i32);
        assert_eq!(code(&mut workspace, "textDocument/hover", json!([1])), ErrorCode::InvalidParams as i32);
        let nowhere = json!({"textDocument": {"uri": "file:///nowhere"}, "position": {"line": 0, "character": 0}});
        assert_eq!(code(&mut workspace, "textDocument/hover", nowhere), ErrorCode::InvalidParams as i32);
    }
}
