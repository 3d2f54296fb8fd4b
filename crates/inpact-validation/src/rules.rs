//! The rules, one file each, in the order of their codes.
//!
//! A new rule is a file in `rules/` and its line in the list below; a test compares the list with the folder.

use crate::rule::Rule;

/// Declares the modules of the rules and lists them.
macro_rules! list_rules {
    ($($module:ident),+ $(,)?) => {
        $(pub mod $module;)+

        /// Every rule, in the order of the codes.
        pub static RULES: &[&Rule] = &[$(&$module::RULE),+];
    };
}

list_rules! {
    s001_line_too_long,
}
