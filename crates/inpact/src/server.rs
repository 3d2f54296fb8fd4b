//! `inpact server`: the language server, over standard input and output.
//!
//! It is built on the same crates as `check`, `fmt` and `explain`: there is no second parser and no rule here.
//! Messages are handled in order, one at a time. A change of a text is applied incrementally; decks are read when a request needs them, or
//! when the queue is empty. A request that fails, even by a panic, is answered with an error and changes nothing, and so is one that
//! is cancelled while it is answered: its work checks for that (`stop`) between pieces of a text, blocks, rules and lines.

mod actions;
mod analysis;
mod blocks;
mod capabilities;
mod cells;
mod completion;
mod findings;
mod formatting;
mod hints;
mod hover;
mod long;
mod names;
mod navigation;
mod outline;
mod refusal;
mod requests;
mod session;
mod shape;
mod snippets;
mod tokens;
mod transport;
mod uri;
mod workspace;

use self::refusal::Refusal;
use self::session::Session;
use self::transport::{Cancelled, Client, Incoming};
use crate::failure::{Failure, Outcome};
use crate::stop::Stop;
use lsp_server::{ErrorCode, Message, Request, Response};
use std::io::{self, Write};
use std::sync::mpsc::{Receiver, TryRecvError};

/// Serves until the client exits or disconnects.
pub(crate) fn run() -> Result<Outcome, Failure> {
    let stop = Stop::new();
    let cancelled = Cancelled::new(stop.clone());
    let incoming = transport::listen(cancelled.clone());
    let served = serve(&incoming, (&cancelled, &stop), &mut Client::new(io::stdout()));
    match served {
        Ok(outcome) => Ok(outcome),
        // A disconnected client needs no answer.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(Outcome::Clean),
        Err(error) => Err(Failure::Output(error)),
    }
}

/// The lifecycle state of the server.
enum State {
    /// Nothing but `initialize` is answered.
    Waiting,
    Running(Box<Session>),
    /// Nothing but `exit` is expected.
    ShutDown,
}

fn serve<W: Write>(
    incoming: &Receiver<Incoming>,
    (cancelled, stop): (&Cancelled, &Stop),
    client: &mut Client<W>,
) -> io::Result<Outcome> {
    let mut state = State::Waiting;
    loop {
        let next = match &mut state {
            // Findings are computed when the queue is empty.
            State::Running(session) if session.has_news() => match incoming.try_recv() {
                Ok(message) => message,
                Err(TryRecvError::Empty) => {
                    session.publish(client)?;
                    continue;
                }
                Err(TryRecvError::Disconnected) => return Ok(Outcome::Clean),
            },
            _ => match incoming.recv() {
                Ok(message) => message,
                Err(_) => return Ok(Outcome::Clean),
            },
        };
        match next {
            Incoming::Malformed { id, code, reason } => client.refuse(id, code, reason)?,
            Incoming::Opening(notification, text) => {
                if let State::Running(session) = &mut state {
                    session.open(notification, text, client)?;
                }
            }
            // What the client answers to our requests changes nothing.
            Incoming::Message(Message::Response(_)) => {}
            Incoming::Message(Message::Notification(notification)) => {
                if notification.method == "exit" {
                    let is_expected = matches!(state, State::ShutDown | State::Waiting);
                    return Ok(if is_expected { Outcome::Clean } else { Outcome::HasErrors });
                }
                if let State::Running(session) = &mut state {
                    session.take(notification, client)?;
                }
            }
            Incoming::Message(Message::Request(request)) => {
                let id = request.id.clone();
                cancelled.begin(&id);
                let answer = if cancelled.has(&id) {
                    Refusal::cancelled().answer(id.clone())
                } else {
                    answer(&mut state, request, stop)
                };
                // It may have been cancelled meanwhile.
                let answer = if cancelled.has(&id) { Refusal::cancelled().answer(id.clone()) } else { answer };
                cancelled.end(&id);
                client.send(answer)?;
            }
        }
    }
}

fn answer(state: &mut State, request: Request, stop: &Stop) -> Response {
    let refuse = |id, code: ErrorCode, message: &str| Refusal::new(code, message).answer(id);
    match (&mut *state, request.method.as_str()) {
        (State::Waiting, "initialize") => match Session::begin(request.params, stop.clone()) {
            Ok((session, result)) => {
                *state = State::Running(Box::new(session));
                Response::new_ok(request.id, result)
            }
            Err(refusal) => refusal.answer(request.id),
        },
        (State::Waiting, _) => refuse(request.id, ErrorCode::ServerNotInitialized, "`initialize` comes first"),
        (State::ShutDown, _) => refuse(request.id, ErrorCode::InvalidRequest, "the server has been shut down"),
        (State::Running(_), "initialize") => refuse(request.id, ErrorCode::InvalidRequest, "`initialize` comes once"),
        (State::Running(_), "shutdown") => {
            *state = State::ShutDown;
            Response::new_ok(request.id, ())
        }
        (State::Running(session), _) => session.answer(request),
    }
}
