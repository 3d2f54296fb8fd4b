//! A session with one editor: notifications in both directions.

use super::capabilities;
use super::findings;
use super::refusal::Refusal;
use super::requests;
use super::transport::Client;
use super::workspace::Workspace;
use crate::settings::{DeckArguments, ReadOptions};
use crate::stop::Stop;
use gen_lsp_types::{
    Diagnostic, DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams, FileSystemWatcher,
    GlobPattern, InitializeParams, InitializeResult, LogMessageParams, MessageType, PublishDiagnosticsParams,
    Registration, RegistrationParams, Uri,
};
use inpact_parser::deck::EditedText;
use lsp_server::{ErrorCode, Notification, Request, Response};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The state of a session with one editor.
#[derive(Debug)]
pub(super) struct Session {
    workspace: Workspace,
    /// Findings published for each file, by its URI.
    published: BTreeMap<String, (Option<i32>, Vec<Diagnostic>)>,
    /// Whether something may have changed since.
    has_news: bool,
}

impl Session {
    /// Begins with the parameters of `initialize`.
    ///
    /// `stop` is requested while a request is answered that is cancelled.
    pub(super) fn begin(params: Value, stop: Stop) -> Result<(Self, InitializeResult), Refusal> {
        let params: InitializeParams = serde_json::from_value(params)
            .map_err(|error| Refusal::new(ErrorCode::InvalidParams, format!("`initialize`: {error}")))?;
        let unit = capabilities::column_unit(&params);
        let mut workspace = Workspace::new(unit, capabilities::of_client(&params), stop);
        // Faults of the settings are reported when they are sent again; nothing may be sent before the answer.
        if let Some(Ok(options)) = params.initialization_options.as_ref().map(options_of) {
            workspace.set_options(options);
        }
        let session = Self { workspace, published: BTreeMap::new(), has_news: false };
        Ok((session, capabilities::of_server(unit)))
    }

    pub(super) fn answer(&mut self, request: Request) -> Response {
        requests::answer(&mut self.workspace, request)
    }

    /// Handles a notification; malformed ones are logged.
    pub(super) fn take<W: Write>(
        &mut self,
        Notification { method, params }: Notification,
        client: &mut Client<W>,
    ) -> io::Result<()> {
        let taken = match method.as_str() {
            "initialized" => return self.watch(client),
            "textDocument/didOpen" => with(params, |params: DidOpenTextDocumentParams| {
                let document = params.text_document;
                self.workspace.open(document.uri, document.version, EditedText::new(document.text.as_bytes()));
            }),
            "textDocument/didChange" => with(params, |params: DidChangeTextDocumentParams| {
                let document = params.text_document;
                let uri = document.text_document_identifier.uri;
                self.workspace.change(&uri, document.version, params.content_changes);
            }),
            "textDocument/didClose" => with(params, |params: DidCloseTextDocumentParams| {
                self.workspace.close(&params.text_document.uri);
            }),
            "textDocument/didSave" | "workspace/didChangeWatchedFiles" => {
                self.workspace.forget();
                Ok(())
            }
            "workspace/didChangeConfiguration" => {
                options_of(params.get("settings").unwrap_or(&Value::Null)).map(|options| {
                    self.workspace.set_options(options);
                })
            }
            _ => return Ok(()),
        };
        self.has_news = true;
        match taken {
            Ok(()) => Ok(()),
            Err(error) => log_error(client, format!("`{method}`: {error}")),
        }
    }

    /// Opens a document whose text was received separately.
    pub(super) fn open<W: Write>(
        &mut self,
        Notification { method, params }: Notification,
        text: EditedText,
        client: &mut Client<W>,
    ) -> io::Result<()> {
        let taken = with(params, |params: DidOpenTextDocumentParams| {
            self.workspace.open(params.text_document.uri, params.text_document.version, text);
        });
        self.has_news = true;
        taken.or_else(|error| log_error(client, format!("`{method}`: {error}")))
    }

    /// Registers for changes of files that decks may include, and of configurations.
    fn watch<W: Write>(&self, client: &mut Client<W>) -> io::Result<()> {
        if !self.workspace.traits.watches_files {
            return Ok(());
        }
        let watcher =
            |pattern: &str| FileSystemWatcher { glob_pattern: GlobPattern::Pattern(pattern.to_owned()), kind: None };
        // Included files may have any name, but mostly have one of these.
        let watchers = ["**/inpact.toml", "**/*.inp", "**/*.inc", "**/*.dat", "**/*.txt"].map(watcher).to_vec();
        let options = serde_json::json!({"watchers": watchers});
        let registration = Registration {
            id: "inpact-files".to_owned(),
            method: "workspace/didChangeWatchedFiles".to_owned(),
            register_options: Some(options),
        };
        client.request("client/registerCapability", RegistrationParams { registrations: vec![registration] })
    }

    /// Whether findings may have changed.
    pub(super) fn has_news(&self) -> bool {
        self.has_news
    }

    /// Publishes the current findings, where they have changed.
    pub(super) fn publish<W: Write>(&mut self, client: &mut Client<W>) -> io::Result<()> {
        self.has_news = false;
        let workspace = &mut self.workspace;
        // A panic on one deck must not end the session.
        let found = catch_unwind(AssertUnwindSafe(|| {
            workspace.refresh();
            findings::by_file(workspace)
        }));
        let Ok(mut found) = found else {
            let message = "a deck could not be checked, by a fault of inpact; what is open is not affected".to_owned();
            return log_error(client, message);
        };
        for uri in self.published.keys() {
            // Removed findings are published once.
            found.entry(uri.clone()).or_default();
        }
        for (uri, (version, diagnostics)) in found {
            let news = (version, diagnostics);
            let is_nothing = news == (None, Vec::new()) && !self.published.contains_key(&uri);
            if is_nothing || self.published.get(&uri) == Some(&news) {
                continue;
            }
            let (version, diagnostics) = news;
            let params = PublishDiagnosticsParams { uri: Uri(uri.clone()), version, diagnostics: diagnostics.clone() };
            client.notify("textDocument/publishDiagnostics", params)?;
            if diagnostics.is_empty() && version.is_none() {
                self.published.remove(&uri);
            } else {
                self.published.insert(uri, (version, diagnostics));
            }
        }
        let traits = self.workspace.traits;
        let requests = [
            (traits.refreshes_lenses, "workspace/codeLens/refresh"),
            (traits.refreshes_hints, "workspace/inlayHint/refresh"),
            (traits.refreshes_tokens, "workspace/semanticTokens/refresh"),
        ];
        for (_, method) in requests.iter().filter(|(is_wanted, _)| *is_wanted) {
            client.request(method, Value::Null)?;
        }
        Ok(())
    }
}

/// Writes to the log of the editor.
fn log_error<W: Write>(client: &mut Client<W>, message: String) -> io::Result<()> {
    client.notify("window/logMessage", LogMessageParams { kind: MessageType::Error, message })
}

/// Parses the parameters of a notification and handles it.
fn with<T: DeserializeOwned>(params: Value, take: impl FnOnce(T)) -> Result<(), String> {
    let params = serde_json::from_value(params).map_err(|error| error.to_string())?;
    catch_unwind(AssertUnwindSafe(|| take(params))).map_err(|_| "failed by a fault of inpact".to_owned())
}

/// The read options from the settings of an editor, which may be below `inpact` or at the top level.
fn options_of(settings: &Value) -> Result<ReadOptions, String> {
    let settings = settings.get("inpact").unwrap_or(settings);
    if settings.is_null() {
        return Ok(ReadOptions::new());
    }
    DeckArguments::deserialize(settings).map(|arguments| arguments.options()).map_err(|error| error.to_string())
}
