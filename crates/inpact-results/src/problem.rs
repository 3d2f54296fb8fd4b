//! Problems of a result file: fault, place and remedy.

use std::fmt;

/// A place in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Bytes before it.
    pub byte: u64,
    /// Its line, counted from 1.
    pub line: u64,
}

/// The reason why reading ended before the end of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The fault, with the values in it.
    pub message: String,
    /// Where.
    pub place: Place,
    /// The help.
    pub help: String,
}

impl Problem {
    pub(crate) fn new(place: Place, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), place, help: help.into() }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {} (byte {}): {}; {}", self.place.line, self.place.byte, self.message, self.help)
    }
}

/// A text of the file for a message: shortened, with control characters escaped.
pub(crate) fn shown(text: &[u8]) -> String {
    const MOST: usize = 40;
    let cut = text.len() > MOST;
    let mut shown: String = text.iter().take(MOST).flat_map(|byte| byte.escape_ascii()).map(char::from).collect();
    if cut {
        shown.push('…');
    }
    shown
}
