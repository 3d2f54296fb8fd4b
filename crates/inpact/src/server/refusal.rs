//! Error responses to requests.

use super::workspace::{View, Workspace};
use gen_lsp_types as lsp;
use lsp_server::{ErrorCode, RequestId, Response, ResponseError};

/// Reasons why a request fails.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Refusal {
    code: i32,
    message: String,
}

impl Refusal {
    pub(super) fn new(code: ErrorCode, message: impl Into<String>) -> Self {
        Self { code: code as i32, message: message.into() }
    }

    pub(super) fn cancelled() -> Self {
        Self::new(ErrorCode::RequestCanceled, "the request was cancelled")
    }

    /// The request was understood and cannot be done.
    pub(super) fn failed(message: impl Into<String>) -> Self {
        Self::new(ErrorCode::RequestFailed, message)
    }

    pub(super) fn answer(self, id: RequestId) -> Response {
        let Self { code, message } = self;
        Response { id, response_result: Err(ResponseError { code, message, data: None }) }
    }
}

/// The document of a request, within its deck.
///
/// # Errors
/// For a document that is not open.
pub(super) fn view<'a>(
    workspace: &'a mut Workspace,
    document: &lsp::TextDocumentIdentifier,
) -> Result<View<'a>, Refusal> {
    let message = format!("`{}` is not open", document.uri.0);
    workspace.view(&document.uri).ok_or_else(|| Refusal::new(ErrorCode::InvalidParams, message))
}
