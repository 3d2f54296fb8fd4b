//! The commands, one file each: its arguments, and the way from them to a result.

pub(crate) mod check;
pub(crate) mod inp;
pub(crate) mod json;
