//! Metadata of a rule, available without running it.

use crate::severity::Severity;

/// A rule: its code and name are fixed and never used again.
#[derive(Debug, PartialEq, Eq)]
pub struct Rule {
    /// The code, such as `T001`.
    pub code: &'static str,
    /// The name, such as `not-ascending`.
    pub name: &'static str,
    /// The severity of its findings unless the rule or the configuration sets another.
    pub severity: Severity,
    /// The kind of fix of its findings, if any.
    pub fix: FixKind,
    /// The rule of the semantics, or the contract, that it enforces.
    pub source: &'static str,
    /// Its page in Markdown: its doc comment. The first line says what is wrong.
    pub documentation: &'static str,
}

/// Whether a rule offers fixes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FixKind {
    /// It offers none.
    None,
    /// A fix that changes no meaning: applied by `--fix`.
    Safe,
    /// A fix that changes the meaning: applied only by its code.
    ChangesMeaning,
}

/// Declares rules about data and the list of them, in the order of their codes; the doc comment of each is its page.
#[macro_export]
macro_rules! data_rules {
    (
        $(#[doc = $about:literal])+
        $list:ident;
        $($(#[doc = $line:literal])+ $identifier:ident = $code:literal, $name:literal, $severity:ident, source: $source:literal;)+
    ) => {
        $($(#[doc = $line])+
        pub static $identifier: $crate::Rule = $crate::Rule {
            code: $code,
            name: $name,
            severity: $crate::Severity::$severity,
            fix: $crate::FixKind::None,
            source: $source,
            documentation: concat!($($line, "\n"),+),
        };)+

        $(#[doc = $about])+
        pub static $list: &[&$crate::Rule] = &[$(&$identifier),+];
    };
}
