//! Messages over standard input and output: a header with a length, then JSON.
//!
//! A separate thread reads, so that a request can be cancelled while another is answered, and so that neither side waits for the other.
//! Malformed messages are answered with an error, and the next one is read: invalid input does not end the server.

use super::long::{self, LongMessage};
use crate::stop::Stop;
use inpact_parser::deck::EditedText;
use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, Response, ResponseError};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::io::{self, BufRead, Read, Write};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The maximum number of bytes of a message: more than any editor opens.
const LONGEST_MESSAGE: u64 = 4 << 30;

const LONGEST_HEADER_LINE: u64 = 8 << 10;

/// Longer strings are decoded incrementally.
const LONG_STRING: usize = 1 << 20;

#[derive(Debug)]
pub(super) enum Incoming {
    Message(Message),
    /// An opened document with a long text, which is empty in the notification.
    Opening(Notification, EditedText),
    /// An invalid message: the response to it.
    Malformed {
        id: Option<RequestId>,
        code: ErrorCode,
        reason: String,
    },
}

/// The cancelled requests.
#[derive(Debug, Clone)]
pub(super) struct Cancelled {
    requests: Arc<Mutex<Requests>>,
    /// Requested while a request is answered that is cancelled.
    stop: Stop,
}

#[derive(Debug, Default)]
struct Requests {
    cancelled: BTreeSet<RequestId>,
    /// The current request.
    current: Option<RequestId>,
}

impl Cancelled {
    pub(super) fn new(stop: Stop) -> Self {
        Self { requests: Arc::default(), stop }
    }

    fn requests(&self) -> MutexGuard<'_, Requests> {
        self.requests.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Cancels a request; if it is the current one, its work is stopped.
    pub(super) fn add(&self, id: RequestId) {
        let mut requests = self.requests();
        if requests.current.as_ref() == Some(&id) {
            self.stop.request();
        }
        requests.cancelled.insert(id);
    }

    pub(super) fn has(&self, id: &RequestId) -> bool {
        self.requests().cancelled.contains(id)
    }

    /// Marks a request as the current one.
    pub(super) fn begin(&self, id: &RequestId) {
        self.requests().current = Some(id.clone());
    }

    /// Marks the current request as answered.
    pub(super) fn end(&self, id: &RequestId) {
        let mut requests = self.requests();
        requests.current = None;
        requests.cancelled.remove(id);
        self.stop.clear();
    }
}

/// Reads standard input in a thread; the messages end where it does.
pub(super) fn listen(cancelled: Cancelled) -> Receiver<Incoming> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || read_all(&mut io::stdin().lock(), &sender, &cancelled));
    receiver
}

fn read_all(input: &mut impl BufRead, sender: &Sender<Incoming>, cancelled: &Cancelled) {
    // A broken input counts as ended.
    while let Ok(Some(body)) = read_body(input) {
        let incoming = match body {
            Body::Whole(message) => decode(message),
            Body::Faulty(reason) => {
                let reason = format!("the message is no JSON: {reason}");
                Incoming::Malformed { id: None, code: ErrorCode::ParseError, reason }
            }
            Body::TooLong(length) => {
                let reason =
                    format!("a message of {length} bytes is longer than {LONGEST_MESSAGE}, the most that is read");
                Incoming::Malformed { id: None, code: ErrorCode::InvalidRequest, reason }
            }
        };
        if let Incoming::Message(Message::Notification(notification)) = &incoming
            && notification.method == "$/cancelRequest"
        {
            if let Some(id) = notification.params.get("id").and_then(request_id) {
                cancelled.add(id);
            }
            continue;
        }
        if sender.send(incoming).is_err() {
            return;
        }
    }
}

/// The content after a header.
enum Body {
    Whole(LongMessage),
    /// It is not JSON, and was skipped.
    Faulty(&'static str),
    /// It was skipped.
    TooLong(u64),
}

/// Reads up to the end of the next message; `None` at the end of the input.
///
/// A line that is not a header is skipped, to resynchronise.
fn read_body(input: &mut impl BufRead) -> io::Result<Option<Body>> {
    let mut length: Option<u64> = None;
    loop {
        let mut line = Vec::new();
        if input.by_ref().take(LONGEST_HEADER_LINE).read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim();
        if let (true, Some(length)) = (line.is_empty(), length) {
            if LONGEST_MESSAGE < length {
                io::copy(&mut input.by_ref().take(length), &mut io::sink())?;
                return Ok(Some(Body::TooLong(length)));
            }
            // Memory is allocated as bytes arrive, not as declared in the header.
            return match long::read(input, length, LONG_STRING) {
                Ok(message) => Ok(Some(Body::Whole(message))),
                Err(long::Fault::Text(reason)) => Ok(Some(Body::Faulty(reason))),
                Err(long::Fault::Input(error)) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(None),
                Err(long::Fault::Input(error)) => Err(error),
            };
        }
        if let Some((name, value)) = line.split_once(':')
            && name.trim().eq_ignore_ascii_case("Content-Length")
        {
            length = value.trim().parse().ok();
        }
    }
}

/// Makes a message of JSON.
fn decode(LongMessage { json, mut texts }: LongMessage) -> Incoming {
    let nonsense = |id, code, reason: &str| Incoming::Malformed { id, code, reason: reason.to_owned() };
    let value: Value = match serde_json::from_slice(&json) {
        Ok(value) => value,
        Err(error) => return nonsense(None, ErrorCode::ParseError, &format!("the message is no JSON: {error}")),
    };
    let Value::Object(mut fields) = value else {
        return nonsense(None, ErrorCode::InvalidRequest, "a message is an object; several in a list are not taken");
    };
    let id = match fields.remove("id") {
        None => None,
        Some(id) => match request_id(&id) {
            Some(id) => Some(id),
            None => {
                return nonsense(None, ErrorCode::InvalidRequest, "`id` is neither an integer of 32 bits nor a text");
            }
        },
    };
    let mut params = fields.remove("params").unwrap_or_default();
    if !texts.is_empty() {
        if let (Some("textDocument/didOpen"), None) = (fields.get("method").and_then(Value::as_str), &id)
            && let Some(text) = params.pointer_mut("/textDocument/text").and_then(|text| long::take(text, &mut texts))
        {
            return Incoming::Opening(Notification::new("textDocument/didOpen".to_owned(), params), text);
        }
        long::put_back(&mut params, &mut texts);
    }
    match (fields.remove("method"), id) {
        (Some(Value::String(method)), Some(id)) => Incoming::Message(Request { id, method, params }.into()),
        (Some(Value::String(method)), None) => Incoming::Message(Notification { method, params }.into()),
        (Some(_), id) => nonsense(id, ErrorCode::InvalidRequest, "`method` is no text"),
        (None, Some(id)) if fields.contains_key("result") || fields.contains_key("error") => {
            // Responses of the client are ignored.
            let response_result = Ok(fields.remove("result").unwrap_or_default());
            Incoming::Message(Response { id, response_result }.into())
        }
        (None, id) => nonsense(id, ErrorCode::InvalidRequest, "a message has a `method`, a `result` or an `error`"),
    }
}

fn request_id(value: &Value) -> Option<RequestId> {
    match value {
        Value::Number(number) => number.as_i64().and_then(|number| i32::try_from(number).ok()).map(RequestId::from),
        Value::String(text) => Some(RequestId::from(text.clone())),
        _ => None,
    }
}

#[derive(Debug)]
pub(super) struct Client<W: Write> {
    output: W,
    /// The number of the next request to the client.
    next_id: i32,
}

impl<W: Write> Client<W> {
    pub(super) fn new(output: W) -> Self {
        Self { output, next_id: 1 }
    }

    pub(super) fn send(&mut self, message: impl Into<Message>) -> io::Result<()> {
        message.into().write(&mut self.output)
    }

    /// Sends a notification.
    pub(super) fn notify(&mut self, method: &str, params: impl serde::Serialize) -> io::Result<()> {
        self.send(Notification::new(method.to_owned(), params))
    }

    /// Sends a request whose response is ignored.
    pub(super) fn request(&mut self, method: &str, params: impl serde::Serialize) -> io::Result<()> {
        let id = RequestId::from(format!("inpact-{}", self.next_id));
        self.next_id += 1;
        self.send(Request::new(id, method.to_owned(), params))
    }

    /// Responds to an invalid request.
    pub(super) fn refuse(&mut self, id: Option<RequestId>, code: ErrorCode, message: String) -> io::Result<()> {
        match id {
            Some(id) => self
                .send(Response { id, response_result: Err(ResponseError { code: code as i32, message, data: None }) }),
            // Such a response has the id null, which the response type cannot represent.
            None => {
                let text = json!({"jsonrpc": "2.0", "id": null, "error": {"code": code as i32, "message": message}});
                let text = text.to_string();
                write!(self.output, "Content-Length: {}\r\n\r\n{text}", text.len())?;
                self.output.flush()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The messages of an input, as few words.
    fn check(input: &[u8], expected: &[&str]) {
        let (sender, receiver) = channel();
        read_all(&mut &*input, &sender, &Cancelled::new(Stop::new()));
        drop(sender);
        let found: Vec<String> = receiver
            .iter()
            .map(|incoming| match incoming {
                Incoming::Opening(_, text) => format!("opening of {} bytes", text.length()),
                Incoming::Message(Message::Request(request)) => format!("request {}", request.method),
                Incoming::Message(Message::Notification(notification)) => {
                    format!("notification {}", notification.method)
                }
                Incoming::Message(Message::Response(response)) => format!("response {}", response.id),
                Incoming::Malformed { reason, .. } => format!("nonsense: {reason}"),
            })
            .collect();
        assert_eq!(found, expected, "{}", String::from_utf8_lossy(input));
    }

    fn framed(body: &str) -> Vec<u8> {
        format!("Content-Length: {}\r\n\r\n{body}", body.len()).into_bytes()
    }

    #[test]
    fn messages_of_each_kind() {
        let input = [
            framed(r#"{"jsonrpc":"2.0","id":1,"method":"a","params":{}}"#),
            framed(r#"{"jsonrpc":"2.0","method":"b"}"#),
            framed(r#"{"jsonrpc":"2.0","id":"x","result":null}"#),
        ];
        check(&input.concat(), &["request a", "notification b", "response \"x\""]);
    }

    #[test]
    fn what_follows_nonsense_is_read() {
        let good = framed(r#"{"id":1,"method":"a"}"#);
        for nonsense in
            ["hello\r\n", "\r\n\r\n", "Content-Length: many\r\n\r\n", "X: y\r\n", "\u{0}\n", "Content-Length: -5\n\n"]
        {
            check(&[nonsense.as_bytes(), &good].concat(), &["request a"]);
        }
        let reasons = [
            ("{", "nonsense: the message is no JSON: EOF while parsing an object at line 1 column 1"),
            ("[]", "nonsense: a message is an object; several in a list are not taken"),
            (r#"{"id":1.5,"method":"a"}"#, "nonsense: `id` is neither an integer of 32 bits nor a text"),
            (r#"{"id":1,"method":2}"#, "nonsense: `method` is no text"),
            ("{}", "nonsense: a message has a `method`, a `result` or an `error`"),
        ];
        for (body, reason) in reasons {
            check(&[framed(body), good.clone()].concat(), &[reason, "request a"]);
        }
    }

    #[test]
    fn a_long_text_is_opened_and_other_long_strings_are_put_back() {
        let long = "1, 2.\\n".repeat(LONG_STRING / 4);
        let opening = format!(r#"{{"method":"textDocument/didOpen","params":{{"textDocument":{{"text":"{long}"}}}}}}"#);
        let other = format!(r#"{{"method":"a{long}","params":{{"x":"{long}"}}}}"#);
        let name = format!("opening of {} bytes", 6 * (LONG_STRING / 4));
        let (sender, receiver) = channel();
        read_all(&mut &*[framed(&opening), framed(&other)].concat(), &sender, &Cancelled::new(Stop::new()));
        drop(sender);
        let found: Vec<Incoming> = receiver.iter().collect();
        let [Incoming::Opening(_, text), Incoming::Malformed { .. } | Incoming::Message(_)] = &found[..] else {
            panic!("{}", found.len());
        };
        assert_eq!(format!("opening of {} bytes", text.length()), name);
        let parameter = format!(r#"{{"method":"a","params":{{"x":["{long}"]}}}}"#);
        let (sender, receiver) = channel();
        read_all(&mut &*framed(&parameter), &sender, &Cancelled::new(Stop::new()));
        drop(sender);
        let Ok(Incoming::Message(Message::Notification(notification))) = receiver.recv() else { panic!("no message") };
        assert_eq!(notification.params["x"][0].as_str(), Some(&*long.replace("\\n", "\n")));
    }

    #[test]
    fn an_input_that_breaks_off_ends() {
        let too_long = "nonsense: a message of 99999999999 bytes is longer than 4294967296, the most that is read";
        check(b"Content-Length: 99999999999\r\n\r\n{}", &[too_long]);
        check(b"Content-Length: 9999\r\n\r\n{}", &[]);
        check(b"Content-Length: 10\r\n\r\n{}", &[]);
        check(b"", &[]);
    }
}
