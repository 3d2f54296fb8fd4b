//! The language of *PARAMETER: definitions that are executed, values that replace `<name>` (S-60 to S-66).
//!
//! The data lines of *PARAMETER are a part of Python: `name = expression`.
//! Up to release 2023 it is Python 2, whose integers divide as integers; from 2024 on Python 3, whose division is true ([`Division`]).
//! [`define`] executes the lines of one block; called for every block of the deck in order, it leaves the final values
//! in [`Parameters`], which [`substitute`] then puts in place of every `<name>`, even of one before the definition (S-61).
//!
//! Independent of keywords, blocks and files; it executes nothing but arithmetic.
//! For any input, time and memory are bounded by its length: nesting, the length of texts, the size of integers and the
//! number of arguments are limited, and exceeding a limit is an [`ExpressionProblem`].
//!
//! Cases that S-60 leaves open follow Python 2: `//` and `%` exist, `**` binds to the right and before a sign on
//! its left, `pow` is that of the `math` module and gives a real number, `str` gives twelve digits.
//! `min` and `max` are not listed in S-60 but decks call them.

mod arithmetic;
mod division;
mod evaluate;
mod functions;
mod lexer;
mod literal;
mod logical_line;
mod names;
mod parameters;
mod statement;
mod substitute;
mod value;

pub use division::{Division, IntegerDivision};
pub use lexer::is_parameter_name;
pub use logical_line::StatementLine;
pub use names::names;
pub use parameters::{Definition, Parameters};
pub use statement::define;
pub use substitute::{Reference, SubstitutionError, references, substitute};
pub use value::Value;

use crate::span::Span;

/// A statement of *PARAMETER that cannot be executed (S016), with its first problem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExpressionProblem {
    /// The part of the statement that is wrong.
    pub span: Span,
    /// The problem.
    pub message: String,
    /// The help.
    pub help: Option<String>,
    /// The name that is used without a definition above, if that is the problem: it may be defined further down, or
    /// in a file that could not be read.
    pub undefined: Option<String>,
}

/// The deepest nesting of parentheses, calls, signs and powers.
pub const MAX_NESTING: usize = 200;

/// The most bytes of a text value: four lines of the greatest length that a deck may have (S-06).
pub const MAX_TEXT: usize = 1024;

/// The most bytes of all text values of a deck together.
pub const MAX_TEXT_IN_ALL: usize = 16 << 20;

/// The maximum number of arguments of a call; Python 2 has the same limit.
pub(crate) const MAX_ARGUMENTS: usize = 255;

/// A problem without its place.
#[derive(Debug)]
struct Complaint {
    message: String,
    help: Option<String>,
    undefined: Option<String>,
}

impl Complaint {
    fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), help: None, undefined: None }
    }

    fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// A piece of source text in backticks, truncated when it is long.
fn quoted(text: &[u8]) -> String {
    const SHOWN: usize = 40;
    // A character has at most four bytes, so this suffices for the shown characters and one more.
    let beginning = String::from_utf8_lossy(&text[..text.len().min(4 * (SHOWN + 1))]);
    let mut shown: String = beginning.chars().take(SHOWN).collect();
    if shown.len() < text.len() && beginning.chars().nth(SHOWN).is_some() {
        shown.push('…');
    }
    format!("`{shown}`")
}
