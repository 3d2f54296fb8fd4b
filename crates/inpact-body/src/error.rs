//! Reasons why a body has no conductances.

use inpact_parser::mesh::MeshNote;
use inpact_parser::span::Span;
use std::fmt;

/// Everything that keeps a body from being lumped; at least one fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BodyError {
    faults: Vec<BodyFault>,
}

/// A fault, for users.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BodyFault {
    /// Its place in the deck; `None` for names that were asked for, and for what cannot be solved.
    pub span: Option<Span>,
    /// What is wrong.
    pub message: String,
}

impl BodyError {
    /// The faults, in the order of their places.
    pub fn faults(&self) -> &[BodyFault] {
        &self.faults
    }

    /// Nothing, or all of these faults.
    pub(crate) fn unless_none(mut faults: Vec<BodyFault>) -> Result<(), Self> {
        if faults.is_empty() {
            return Ok(());
        }
        faults.sort_by_key(|fault| fault.span);
        Err(Self { faults })
    }

    /// A fault without a place.
    pub(crate) fn without_place(message: String) -> Self {
        Self { faults: vec![BodyFault { span: None, message }] }
    }
}

impl BodyFault {
    pub(crate) fn at(span: Span, message: String) -> Self {
        Self { span: Some(span), message }
    }
}

impl From<MeshNote> for BodyFault {
    fn from(note: MeshNote) -> Self {
        Self::at(note.span, note.message)
    }
}

impl fmt::Display for BodyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let messages: Vec<&str> = self.faults.iter().map(|fault| fault.message.as_str()).collect();
        f.write_str(&messages.join("; "))
    }
}

impl std::error::Error for BodyError {}
