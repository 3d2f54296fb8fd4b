//! An editor as far as a test needs one: it sends messages, and keeps what comes back.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// The longest that a server may take to answer, on a machine that does other work as well.
const PATIENCE: Duration = Duration::from_secs(60);

/// An editor and its server.
pub(crate) struct Client {
    server: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
    next_id: i32,
    /// What was said of each file last: the version and what is wrong.
    pub(crate) published: BTreeMap<String, (Option<i64>, Vec<Value>)>,
    /// Requests and other notifications of the server.
    pub(crate) others: Vec<Value>,
    /// A folder of its own.
    pub(crate) folder: tempfile::TempDir,
}

impl Client {
    /// Starts a server for an editor that can do everything.
    pub(crate) fn start() -> Self {
        Self::start_with(&json!({
            "workspace": {
                "didChangeWatchedFiles": {"dynamicRegistration": true},
                "workspaceEdit": {"documentChanges": true},
            },
            "textDocument": {"completion": {"completionItem": {"snippetSupport": true}}},
        }))
    }

    /// Starts a server for an editor with these capabilities.
    pub(crate) fn start_with(capabilities: &Value) -> Self {
        let mut client = Self::launch();
        let params = json!({"processId": null, "rootUri": null, "capabilities": capabilities});
        client.request("initialize", &params).expect("initialized");
        client.notify("initialized", &json!({}));
        client
    }

    /// Starts the process and says nothing.
    pub(crate) fn launch() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let mut server = Command::new(env!("CARGO_BIN_EXE_inpact-under-test"))
            .arg("server")
            .current_dir(folder.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("started");
        let input = server.stdin.take();
        let mut output = BufReader::new(server.stdout.take().expect("a pipe"));
        let (sender, messages) = channel();
        std::thread::spawn(move || {
            while let Some(message) = read(&mut output) {
                if sender.send(message).is_err() {
                    break;
                }
            }
        });
        Self { server, input, messages, next_id: 1, published: BTreeMap::new(), others: Vec::new(), folder }
    }

    /// Where a file of the folder is.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().canonicalize().expect("there").join(name)
    }

    pub(crate) fn uri(&self, name: &str) -> String {
        format!("file://{}", self.path(name).display())
    }

    /// Writes a file of the folder.
    pub(crate) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("written");
    }

    /// Sends bytes as they are.
    pub(crate) fn send_raw(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().expect("open");
        // A server that is gone is found out by whoever waits for its answer.
        let _ = input.write_all(bytes).and_then(|()| input.flush());
    }

    pub(crate) fn send(&mut self, message: &Value) {
        let text = message.to_string();
        self.send_raw(format!("Content-Length: {}\r\n\r\n{text}", text.len()).as_bytes());
    }

    pub(crate) fn notify(&mut self, method: &str, params: &Value) {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}));
    }

    /// Sends a request and gives its number.
    pub(crate) fn ask(&mut self, method: &str, params: &Value) -> i32 {
        let id = self.next_id;
        self.next_id += 1;
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}));
        id
    }

    /// Sends a request and waits for its answer.
    pub(crate) fn request(&mut self, method: &str, params: &Value) -> Result<Value, Value> {
        let id = self.ask(method, params);
        self.answer(&json!(id))
    }

    /// Waits for the answer to a request.
    pub(crate) fn answer(&mut self, id: &Value) -> Result<Value, Value> {
        loop {
            let message = self.next();
            if message.get("id") == Some(id) && message.get("method").is_none() {
                return match message.get("error") {
                    Some(error) => Err(error.clone()),
                    None => Ok(message["result"].clone()),
                };
            }
        }
    }

    /// The next message, taken down.
    pub(crate) fn next(&mut self) -> Value {
        let message = self.messages.recv_timeout(PATIENCE).expect("a message in time");
        if message["method"] == "textDocument/publishDiagnostics" {
            let params = &message["params"];
            let uri = params["uri"].as_str().expect("a URI").to_owned();
            let found = params["diagnostics"].as_array().expect("a list").clone();
            self.published.insert(uri, (params["version"].as_i64(), found));
        } else if message.get("method").is_some() {
            self.others.push(message.clone());
        }
        message
    }

    /// Opens a document of the folder, be it on disk or not.
    pub(crate) fn open(&mut self, name: &str, text: &str) {
        let document = json!({"uri": self.uri(name), "languageId": "abaqus-inp", "version": 1, "text": text});
        self.notify("textDocument/didOpen", &json!({"textDocument": document}));
    }

    /// Writes a file and opens it.
    pub(crate) fn write_and_open(&mut self, name: &str, text: &str) {
        self.write(name, text);
        self.open(name, text);
    }

    pub(crate) fn close(&mut self, name: &str) {
        self.notify("textDocument/didClose", &json!({"textDocument": {"uri": self.uri(name)}}));
    }

    /// Puts another text in the place of a document.
    pub(crate) fn replace(&mut self, name: &str, version: i64, text: &str) {
        self.change(name, version, &json!([{"text": text}]));
    }

    pub(crate) fn change(&mut self, name: &str, version: i64, changes: &Value) {
        let document = json!({"uri": self.uri(name), "version": version});
        self.notify("textDocument/didChange", &json!({"textDocument": document, "contentChanges": changes}));
    }

    /// Waits until something has been said of that version of a document, and gives what is wrong.
    pub(crate) fn findings(&mut self, name: &str, version: i64) -> Vec<Value> {
        let uri = self.uri(name);
        loop {
            if self.published.get(&uri).is_some_and(|(known, _)| *known == Some(version)) {
                // What was found in other files at the same time comes with it, before anything is answered.
                let error = self.request("inpact/nothing", &Value::Null).expect_err("there is no such request");
                assert_eq!(error["code"], -32601);
                return self.published[&uri].1.clone();
            }
            self.next();
        }
    }

    /// Waits until what is wrong in a file is as it should be.
    pub(crate) fn wait_for(&mut self, name: &str, is_as_it_should_be: impl Fn(&[Value]) -> bool) -> Vec<Value> {
        let uri = self.uri(name);
        loop {
            if let Some((_, found)) = self.published.get(&uri)
                && is_as_it_should_be(found)
            {
                return found.clone();
            }
            self.next();
        }
    }

    /// Asks for something at a place of a document.
    pub(crate) fn at(&mut self, method: &str, name: &str, (line, character): (u64, u64)) -> Result<Value, Value> {
        let params =
            json!({"textDocument": {"uri": self.uri(name)}, "position": {"line": line, "character": character}});
        self.request(method, &params)
    }

    /// Asks for something of a document as a whole.
    pub(crate) fn of(&mut self, method: &str, name: &str) -> Value {
        let params = json!({"textDocument": {"uri": self.uri(name)}});
        self.request(method, &params).expect("answered")
    }

    /// What the server says with the name of the folder taken out.
    pub(crate) fn without_folder(&self, text: &str) -> String {
        text.replace(&self.path("").display().to_string(), "FOLDER/")
    }

    /// Ends the session, and gives the exit code.
    pub(crate) fn finish(mut self) -> Option<i32> {
        self.request("shutdown", &Value::Null).expect("shut down");
        self.notify("exit", &Value::Null);
        self.wait()
    }

    /// Closes the input and waits for the end of the process.
    pub(crate) fn wait(&mut self) -> Option<i32> {
        self.input = None;
        self.server.wait().expect("ended").code()
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        // A test that fails must leave no process after.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// Reads a message; `None` at the end.
fn read(output: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if output.read_line(&mut line).ok()? == 0 {
            return None;
        }
        let line = line.trim();
        if line.is_empty() {
            break;
        }
        if let Some(value) = line.strip_prefix("Content-Length: ") {
            length = value.parse().expect("a length");
        }
    }
    let mut body = vec![0; length];
    output.read_exact(&mut body).ok()?;
    Some(serde_json::from_slice(&body).expect("JSON"))
}

/// A text with a place marked by `¦`: the text without the mark, and the place in lines and UTF-16.
pub(crate) fn marked(text: &str) -> (String, (u64, u64)) {
    let (before, after) = text.split_once('¦').expect("a mark");
    let line = before.matches('\n').count() as u64;
    let last = before.rsplit('\n').next().unwrap_or("");
    (format!("{before}{after}"), (line, last.encode_utf16().count() as u64))
}

/// A text after edits of the protocol, which do not overlap.
pub(crate) fn edited(text: &str, edits: &[Value]) -> String {
    let offset = |place: &Value| {
        let (line, character) = (place["line"].as_u64().unwrap(), place["character"].as_u64().unwrap());
        let mut starts = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1));
        let Some(start) = starts.nth(usize::try_from(line).unwrap()) else { return text.len() };
        let mut units = 0;
        for (at, symbol) in text[start..].char_indices() {
            if units >= character || symbol == '\n' {
                return start + at;
            }
            units += symbol.len_utf16() as u64;
        }
        text.len()
    };
    let mut places: Vec<(usize, usize, &str)> = edits
        .iter()
        .map(|edit| {
            let range = &edit["range"];
            (offset(&range["start"]), offset(&range["end"]), edit["newText"].as_str().unwrap())
        })
        .collect();
    places.sort_by_key(|(start, end, _)| (*start, *end));
    let mut result = String::new();
    let mut from = 0;
    for (start, end, new) in places {
        assert!(from <= start, "edits overlap");
        result += &text[from..start];
        result += new;
        from = end;
    }
    result + &text[from..]
}

/// The edits of a change of the workspace for one document.
pub(crate) fn edits_for(edit: &Value, uri: &str) -> Vec<Value> {
    let changes = edit["documentChanges"].as_array().cloned().unwrap_or_default();
    let of_document = changes.into_iter().filter(|change| change["textDocument"]["uri"] == uri);
    of_document.flat_map(|change| change["edits"].as_array().cloned().unwrap_or_default()).collect()
}

/// `1:2-3:4`, counted from 1.
pub(crate) fn shown(range: &Value) -> String {
    let place =
        |place: &Value| format!("{}:{}", place["line"].as_u64().unwrap() + 1, place["character"].as_u64().unwrap() + 1);
    format!("{}-{}", place(&range["start"]), place(&range["end"]))
}

/// The name of the file of a URI.
pub(crate) fn file_of(uri: &Value) -> String {
    let uri = uri.as_str().unwrap_or_default();
    Path::new(uri).file_name().unwrap_or_default().to_string_lossy().into_owned()
}
