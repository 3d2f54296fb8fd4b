//! Runs the program as a user would: exit codes, standard streams, every format, every sample deck.

mod check;
mod decks;
mod json;
mod program;
