//! Speaks the language server protocol to the real process, as an editor does.
//!
//! What each request gives is held by snapshots; what is wrong in a text is what `check` says of it, after any edits; nonsense is answered and ends nothing.

mod capabilities;
mod client;
mod editing;
#[cfg(unix)]
mod emacs;
mod findings;
mod hostile;
mod neovim;
mod protocol;
mod random_edits;
