//! The judge of whole evaluations: random decks and node tables, and what the semantics say of them, transcribed in exact rationals and knowing nothing of the program's laws.

pub(crate) mod laws;
pub(crate) mod scene;
