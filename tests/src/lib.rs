//! Whole-program tests of inpact: `whole_program/` runs the binary on the sample decks, `corpus.rs` reads public decks.
