//! The error type of this crate.

use crate::failure::Failure;
use inpact_diagnostics::{Diagnostic, Severity};
use std::error;
use std::fmt;

/// A failure: a file that cannot be read or written, wrong usage, or data with errors.
///
/// Faults of a deck that could be read are findings, not an error.
///
/// ```
/// use inpact::{Deck, ReadOptions};
///
/// let error = Deck::read("no/such/deck.inp", &ReadOptions::new()).unwrap_err();
/// assert!(error.is_io());
/// assert!(error.to_string().starts_with("cannot read `no/such/deck.inp`"));
/// ```
pub struct Error {
    failure: Failure,
    findings: Vec<Diagnostic>,
}

impl Error {
    /// Data that cannot be used.
    pub(crate) fn data(message: impl Into<String>) -> Self {
        Failure::Data(message.into()).into()
    }

    /// Data that cannot be used, with what was found in it.
    #[cfg(feature = "columnar")]
    pub(crate) fn of_findings(message: String, findings: Vec<Diagnostic>) -> Self {
        Self { failure: Failure::Data(message), findings }
    }

    /// Data that cannot be used, for the first error of these findings.
    pub(crate) fn of_first(what: &str, findings: Vec<Diagnostic>) -> Self {
        let first = findings.iter().find(|found| found.severity == Severity::Error);
        let message = first.map_or_else(|| what.to_owned(), |first| format!("{what}: {}", first.message));
        Self { failure: Failure::Data(message), findings }
    }

    /// For commands built on the library.
    pub(crate) fn into_failure(self) -> Failure {
        self.failure
    }

    /// Whether a file cannot be read or written.
    pub fn is_io(&self) -> bool {
        matches!(self.failure, Failure::Read { .. } | Failure::Write { .. } | Failure::Output(_))
    }

    /// Whether the request is invalid, such as options that contradict one another.
    pub fn is_usage(&self) -> bool {
        matches!(self.failure, Failure::Usage(_))
    }

    /// Whether the data has errors that make it unusable.
    pub fn is_data(&self) -> bool {
        matches!(self.failure, Failure::Data(_) | Failure::AlreadySaid)
    }

    /// The findings in the data, where they are the reason.
    pub fn findings(&self) -> &[Diagnostic] {
        &self.findings
    }
}

impl From<Failure> for Error {
    fn from(failure: Failure) -> Self {
        Self { failure, findings: Vec::new() }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.failure.fmt(formatter)
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_tuple("Error").field(&self.to_string()).finish()
    }
}

impl error::Error for Error {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        self.failure.source()
    }
}
