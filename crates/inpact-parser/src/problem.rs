//! What is wrong with rows and places, as the reader finds it: values, not errors.
//!
//! The reader says what it met and where; the rules of validation say what that means, how grave it is and what to do.
//! What a rule can see from the deck, the grammar and the model alone is no problem here.

use crate::grammar::{KeywordId, Level};
use crate::number::NumberError;
use crate::span::Span;

/// Something the reader met that does not fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// What it is.
    pub kind: ProblemKind,
    /// Where it is: the cell, the line, or the keyword line.
    pub span: Span,
    /// The keyword line of the block it is in.
    pub keyword: Span,
}

/// What is read of a float of more than 20 characters.
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

/// What a [`Problem`] is about.
#[derive(Debug, Clone, PartialEq)]
pub enum ProblemKind {
    /// An item that should be a number is none (S-34).
    MalformedNumber {
        /// In what way.
        error: NumberError,
        /// The column it stands in.
        column: String,
    },
    /// A float of more than 20 characters (S-34, CX-05).
    NumberTooLong {
        /// How many characters it has.
        characters: usize,
        /// What the dialect reads of it.
        read: LongNumber,
    },
    /// An empty line inside a table; skipped (S-08).
    BlankRow,
    /// A row has more items than the option has columns; the rest was dropped (S-33).
    TooManyItems {
        /// How many items the line may have.
        allowed: usize,
        /// How many it has.
        given: usize,
        /// Whether every line the row could go over is counted in `allowed`.
        lines: usize,
    },
    /// The block ends inside a row that goes over several lines (K-55).
    IncompleteRow {
        /// How many lines a row has.
        lines: usize,
        /// How many the last row has.
        given: usize,
    },
    /// PROPERTIES=n of a *SURFACE INTERACTION, USER and the number of values below it differ (K-02, K-03).
    PropertyCount {
        /// What PROPERTIES says; 0 where it is not given.
        stated: usize,
        /// How many values there are.
        given: usize,
    },
    /// A row behind the first, of an option that has only one (S-38).
    SurplusRow,
    /// A row that should go over several lines stands on one; read all the same (K-53).
    RowOnOneLine {
        /// How many lines it should have.
        lines: usize,
        /// How many items belong on the first line.
        first: usize,
        /// How many belong on every further line.
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
    /// A statement of *PARAMETER that cannot be executed (S-60).
    InvalidExpression {
        /// What is wrong.
        message: String,
        /// What to do.
        help: Option<String>,
        /// The parameter that is used without a definition above, when that is what is wrong.
        undefined: Option<String>,
    },
    /// *PARAMETER with TABLE: the parameters it gives are not interpreted (S-63).
    UninterpretedParameters,
    /// A sub-option stands where no block of its parent is open (S-21, K012).
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
        /// Where it stands.
        level: Level,
        /// The keyword line that opened the level.
        opened_by: Option<Span>,
    },
}
