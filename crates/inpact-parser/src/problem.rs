//! Problems found by the reader: values, not errors.
//!
//! The reader records the problem and its place; the rules of validation give meaning, severity and help.
//! Problems that a rule can find from the deck, the grammar and the model alone are not among them.

use crate::grammar::{KeywordId, Level};
use crate::number::NumberError;
use crate::span::Span;

/// A problem found by the reader.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// The kind of problem.
    pub kind: ProblemKind,
    /// Its place: the cell, the line, or the keyword line.
    pub span: Span,
    /// The keyword line of the block it is in.
    pub keyword: Span,
}

/// Reading of a float of more than 20 characters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LongNumber {
    /// All of it, as Abaqus may.
    Whole,
    /// Its first 20 characters, which are the same number up to rounding (CX-05).
    SameValue,
    /// Its first 20 characters, which are this number.
    OtherValue(f64),
    /// Its first 20 characters, which are none.
    Nothing,
}

/// Kinds of [`Problem`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ProblemKind {
    /// An item that should be a number is none (S-34).
    MalformedNumber {
        /// In what way.
        error: NumberError,
        /// Its column.
        column: String,
    },
    /// A float of more than 20 characters (S-34, CX-05).
    NumberTooLong {
        /// The number of characters.
        characters: usize,
        /// The reading in the dialect.
        read: LongNumber,
    },
    /// An empty line inside a table; skipped (S-08).
    BlankRow,
    /// A row has more items than the option has columns; the rest was dropped (S-33).
    TooManyItems {
        /// The number of items that the line may have.
        allowed: usize,
        /// The number of items given.
        given: usize,
        /// Whether every line the row could go over is counted in `allowed`.
        lines: usize,
    },
    /// The block ends inside a row that goes over several lines (K-55).
    IncompleteRow {
        /// The number of lines of a row.
        lines: usize,
        /// The number of lines of the last row.
        given: usize,
    },
    /// PROPERTIES=n of a *SURFACE INTERACTION, USER and the number of values below it differ (K-02, K-03).
    PropertyCount {
        /// The value of PROPERTIES; 0 where it is not given.
        stated: usize,
        /// The number of values.
        given: usize,
    },
    /// A row after the first, of an option that has only one (S-38).
    SurplusRow,
    /// A row that should go over several lines is on one; read all the same (K-53).
    RowOnOneLine {
        /// The number of lines it should have.
        lines: usize,
        /// The number of items of the first line.
        first: usize,
        /// The number of items of every further line.
        following: usize,
    },
    /// The dependent value is left empty and reads as 0 (S-32).
    EmptyValue {
        /// The column's name.
        column: String,
    },
    /// `<name>` where no *PARAMETER defines the name (S-62).
    UndefinedParameter {
        /// The name.
        name: String,
        /// A name that is defined and differs in upper and lower case only (S-60).
        similar: Option<String>,
    },
    /// A text that becomes out of all proportion when the parameters in it are substituted.
    SubstitutionTooLong {
        /// The number of its bytes.
        bytes: usize,
        /// The most that it may become.
        most: usize,
    },
    /// A statement of *PARAMETER that cannot be executed (S-60).
    InvalidExpression {
        /// The problem.
        message: String,
        /// The help.
        help: Option<String>,
        /// The parameter that is used without a definition above, when that is what is wrong.
        undefined: Option<String>,
    },
    /// *PARAMETER with TABLE: the parameters it gives are not interpreted (S-63).
    UninterpretedParameters,
    /// A sub-option where no block of its parent is open (S-21, K012).
    Misplaced {
        /// The sub-option.
        keyword: KeywordId,
        /// The keyword that closed the last *SURFACE INTERACTION block, when there was one.
        closed_by: Option<Span>,
    },
    /// The keyword is not allowed at this level (S-73, K013).
    WrongLevel {
        /// The keyword.
        keyword: KeywordId,
        /// Its level.
        level: Level,
        /// The keyword line that opened the level.
        opened_by: Option<Span>,
    },
}
