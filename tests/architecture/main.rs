//! Sentences of ARCHITECTURE.md that a line of source could break, held by reading the source.

#[path = "../support/libraries.rs"]
mod libraries;

mod circles;
mod source;
mod uses;
