//! Outcomes of a command: exit codes, and messages when it cannot continue.

use inpact_diagnostics::visible::{visible, visible_json};
use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use thiserror::Error;

/// The end of a command that could do its work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Done, no errors found: exit code 0.
    Clean,
    /// The deck or the data has errors: exit code 1.
    HasErrors,
}

/// A failure of a command to do its work: exit code 2, but for [`Failure::Data`].
#[derive(Debug, Error)]
pub(crate) enum Failure {
    /// A file that cannot be read.
    #[error("cannot read `{}`: {error}", path.display())]
    Read {
        path: PathBuf,
        #[source]
        error: io::Error,
    },
    /// A file that cannot be written.
    #[error("cannot write `{}`: {error}", path.display())]
    Write {
        path: PathBuf,
        #[source]
        error: io::Error,
    },
    /// Standard output that cannot be written.
    #[error("cannot write to standard output: {0}")]
    Output(#[source] io::Error),
    /// Arguments that do not go together.
    #[error("{0}")]
    Usage(String),
    /// Something that was said already while the work went on.
    #[error("")]
    AlreadySaid,
    /// The data has errors that leave nothing to go on with: exit code 1.
    #[error("{0}")]
    Data(String),
}

impl Failure {
    pub(crate) fn read(path: &Path, error: io::Error) -> Self {
        Self::Read { path: path.to_owned(), error }
    }

    /// Whether the reader of the output has closed the pipe, which is not a fault.
    pub(crate) fn is_closed_pipe(&self) -> bool {
        matches!(self, Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }

    /// The same for a file under its user-visible name.
    pub(crate) fn about(self, name: &Path) -> Self {
        match self {
            Self::Read { error, .. } => Self::read(name, error),
            other => other,
        }
    }

    pub(crate) fn write(path: &Path, error: io::Error) -> Self {
        Self::Write { path: path.to_owned(), error }
    }
}

/// A mesh whose rows cannot be made is a fault of the data, not of reading.
impl From<inpact_contact::Error> for Failure {
    fn from(error: inpact_contact::Error) -> Self {
        Self::Data(error.to_string())
    }
}

/// The exit code of a command, after printing the reason of a failure to standard error.
pub(crate) fn exit_code(result: Result<Outcome, Failure>) -> ExitCode {
    match result {
        Ok(Outcome::Clean) => ExitCode::SUCCESS,
        Ok(Outcome::HasErrors) => ExitCode::from(1),
        // The reader of the output has closed the pipe.
        Err(failure) if failure.is_closed_pipe() => ExitCode::SUCCESS,
        Err(Failure::AlreadySaid) => ExitCode::from(2),
        Err(failure) => {
            say(&format!("error: {failure}"));
            ExitCode::from(if matches!(failure, Failure::Data(_)) { 1 } else { 2 })
        }
    }
}

/// Prints the message of clap: help and version to standard output, a usage error to standard error.
pub(crate) fn report_usage(error: &clap::Error) -> ExitCode {
    let plain = error.render().to_string();
    match visible(&plain) {
        // A failure of this cannot be shown.
        Cow::Borrowed(_) => drop(error.print()),
        // Arguments and file names may contain characters that must not reach a terminal.
        Cow::Owned(shown) => say(shown.trim_end()),
    }
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
}

/// Writes a message to standard error, with invisible characters escaped; a closed standard error is ignored.
pub(crate) fn say(message: &str) {
    write_line(&visible(message));
}

/// Prints failures, one line each.
pub(crate) fn say_failures(failures: &[Failure]) {
    for failure in failures {
        say(&format!("error: {failure}"));
    }
}

/// Writes a line of JSON to standard error.
pub(crate) fn say_json(json: &str) {
    write_line(&visible_json(json));
}

/// Writes a text to standard error whose invisible characters were escaped before colouring.
pub(crate) fn say_as_it_is(text: &str) {
    use std::io::Write;
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

fn write_line(line: &str) {
    say_as_it_is(&format!("{line}\n"));
}
