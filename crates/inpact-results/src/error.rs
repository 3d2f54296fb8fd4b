//! The error type of this crate.

use crate::problem::Problem;
use crate::results::Results;
use std::error;
use std::fmt;
use std::io;

/// A file that could not be read to its end, with the part before that.
///
/// ```
/// use inpact_results::ErrorKind;
///
/// let error = inpact_results::read(b"*NODE\n1, 0., 0., 0.\n").unwrap_err();
/// let ErrorKind::Foreign(problem) = error.kind() else { panic!("{error}") };
/// assert_eq!(problem.place.line, 1);
/// assert!(error.into_read().is_none());
/// ```
#[derive(Debug)]
pub struct Error(Box<Content>);

#[derive(Debug)]
struct Content {
    kind: ErrorKind,
    read: Option<Results>,
}

/// Reasons why a file is not read to its end.
#[derive(Debug)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The source failed.
    Source(io::Error),
    /// The file has no supported format.
    Foreign(Problem),
    /// The file is truncated or damaged; the last of the states passed may be incomplete.
    Unsound(Problem),
}

/// Results, or the part that could be read and the reason why it is incomplete.
pub type Read = Result<Results, Error>;

impl Error {
    /// The reason.
    pub fn kind(&self) -> &ErrorKind {
        &self.0.kind
    }

    /// The problem of the file; `None` where its source failed.
    pub fn problem(&self) -> Option<&Problem> {
        match self.kind() {
            ErrorKind::Source(_) => None,
            ErrorKind::Foreign(problem) | ErrorKind::Unsound(problem) => Some(problem),
        }
    }

    /// The reason by itself.
    pub fn into_kind(self) -> ErrorKind {
        self.0.kind
    }

    /// The part of a file that was read as a whole before the place where it breaks off; `None` where the file is of no kind that is read, and for one that is read state by state.
    pub fn into_read(self) -> Option<Results> {
        self.0.read
    }

    pub(crate) fn foreign(problem: Problem) -> Self {
        ErrorKind::Foreign(problem).into()
    }

    pub(crate) fn unsound(problem: Problem, read: Option<Results>) -> Self {
        Self(Box::new(Content { kind: ErrorKind::Unsound(problem), read }))
    }

    /// The reason and the part before.
    pub(crate) fn into_parts(self) -> (ErrorKind, Option<Results>) {
        (self.0.kind, self.0.read)
    }
}

/// Combines the results of a reader with its outcome.
pub(crate) fn ended(results: Results, outcome: Result<(), Problem>) -> Read {
    match outcome {
        Ok(()) => Ok(results),
        Err(problem) => Err(Error::unsound(problem, Some(results))),
    }
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(Box::new(Content { kind, read: None }))
    }
}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        ErrorKind::Source(error).into()
    }
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind() {
            ErrorKind::Source(error) => error.fmt(formatter),
            ErrorKind::Foreign(problem) | ErrorKind::Unsound(problem) => problem.fmt(formatter),
        }
    }
}

impl error::Error for Error {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self.kind() {
            ErrorKind::Source(error) => Some(error),
            ErrorKind::Foreign(_) | ErrorKind::Unsound(_) => None,
        }
    }
}
