//! The error type of this crate: reasons why a body has no conductances.

use crate::rules::UNUSABLE_MESH;
use inpact_diagnostics::Rule;
use inpact_parser::mesh::MeshNote;
use inpact_parser::span::Span;
use std::fmt;

/// The reasons why a body cannot be lumped; at least one fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    faults: Vec<BodyFault>,
}

/// A fault, for users.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BodyFault {
    /// The rule that it breaks.
    pub rule: &'static Rule,
    /// Its place in the deck; `None` for requested names, and for equations that cannot be solved.
    pub span: Option<Span>,
    /// The fault.
    pub message: String,
    /// The bodies concerned, as positions in [`Body::parts`](crate::Body::parts); empty where it is all of them.
    pub bodies: Vec<u32>,
}

impl Error {
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

    /// A fault of the mesh without a place.
    pub(crate) fn without_place(message: String) -> Self {
        Self { faults: vec![BodyFault { rule: &UNUSABLE_MESH, span: None, message, bodies: Vec::new() }] }
    }
}

impl BodyFault {
    pub(crate) fn at(rule: &'static Rule, span: Span, message: String) -> Self {
        Self { rule, span: Some(span), message, bodies: Vec::new() }
    }

    /// The same of some bodies alone.
    pub(crate) fn of(self, mut bodies: Vec<u32>) -> Self {
        bodies.sort_unstable();
        bodies.dedup();
        Self { bodies, ..self }
    }
}

impl From<MeshNote> for BodyFault {
    fn from(note: MeshNote) -> Self {
        Self::at(&UNUSABLE_MESH, note.span, note.message)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let messages: Vec<&str> = self.faults.iter().map(|fault| fault.message.as_str()).collect();
        f.write_str(&messages.join("; "))
    }
}

impl std::error::Error for Error {}
