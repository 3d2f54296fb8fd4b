//! Reads Abaqus `.inp` decks without losing a byte, and builds the typed model of their contact interfaces.
//!
//! Data flows one way: bytes, [`deck::Deck`], [`model::Model`].
//! `deck::Scanner` cuts bytes into blocks, [`model::read`] turns the blocks of contact interfaces into typed values,
//! and [`json`] writes either as JSON and reads it back.
//! Nothing here opens a file, prints, or stops at bad input: what is wrong with a deck is a value ([`problem::Problem`]).
//!
//! The rule numbers in this crate (S-13, T-05, K-52, Q-1, …) are those of the project's semantics,
//! which restate the Abaqus Analysis User's Guide, Keywords Reference Guide and Theory Guide.

pub use inpact_diagnostics::span;

pub mod grammar;

pub mod deck;

pub mod problem;

pub mod number;

pub mod expression;

pub mod model;

pub mod mesh;

pub mod format;

pub mod json;
