//! K014: names that Abaqus does not accept.

use super::s005_unterminated_quote::open_quote;
use crate::parameter::all_given;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::ParameterKind;

declare_rule! {
    /// The name that a keyword defines is no legal name.
    ///
    /// A name begins with a letter, has no period and no `=` in it, and is at most 80 characters long.
    /// Blanks do not count, and a name that begins with one underscore is accepted, because Abaqus/CAE writes such names.
    /// A name in quotes may hold any character but a quote.
    /// Names that begin and end with two underscores are reserved.
    ///
    /// ## Why
    /// Abaqus refuses such a name, or reads a period in it as the border between an instance and what is in it.
    ///
    /// ## What to do
    /// Choose another name, or quote it; then it must be quoted wherever it is used.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=2-SIDED
    /// *SURFACE INTERACTION, NAME=STEEL.COPPER
    /// *SURFACE INTERACTION, NAME=__RESERVED__
    /// *SURFACE INTERACTION, NAME=""
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=TWO-SIDED
    /// *SURFACE INTERACTION, NAME="STEEL.COPPER"
    /// *SURFACE INTERACTION, NAME=_IntProp-1
    /// ```
    "K014", "invalid-name", Error, fix: None, source: "S-39 to S-42, Q-21"
}

/// The most characters of a name.
const LONGEST: usize = 80;

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let defines = all_given(context)
        .filter(|given| given.definition.kind == ParameterKind::Label && given.definition.name == "NAME");
    for given in defines {
        let (Some(value), Some(text)) = (given.value(), given.text(context)) else { continue };
        // A quote that does not close has its own finding.
        if open_quote(&text).is_some() && !context.is_for_calculix() {
            continue;
        }
        // CalculiX takes any letters (CX-02), but not any number of them.
        let fault = if context.is_for_calculix() { fault_of_length(&text) } else { fault(&text) };
        let Some(fault) = fault else { continue };
        let shown = context.shown(value);
        report.at(value, format!("`{shown}` is no legal name: {}", fault.what)).label(fault.what).help(fault.help);
    }
}

/// The fault of a name.
struct Fault {
    what: &'static str,
    help: &'static str,
}

const TOO_LONG: Fault = Fault { what: "it has more than 80 characters", help: "shorten it" };

fn fault(text: &[u8]) -> Option<Fault> {
    match text {
        [b'"', inner @ .., b'"'] if !inner.contains(&b'"') => fault_of_quoted(inner),
        _ if text.contains(&b'"') => {
            Some(Fault { what: "it has a quote inside", help: "put the quotes around the whole name" })
        }
        _ => fault_of_unquoted(text),
    }
}

fn fault_of_quoted(inner: &[u8]) -> Option<Fault> {
    if inner.trim_ascii().is_empty() {
        return Some(Fault { what: "it is empty", help: "write a name between the quotes" });
    }
    fault_of_any(inner.len(), inner)
}

fn fault_of_unquoted(text: &[u8]) -> Option<Fault> {
    let first_is_legal =
        text.first().is_some_and(|byte| byte.is_ascii_alphabetic() || *byte == b'_' || !byte.is_ascii());
    let (what, help) = match text {
        _ if !first_is_legal => {
            ("it does not begin with a letter", "begin it with a letter, or quote it wherever it is used")
        }
        _ if text.contains(&b'.') => {
            ("it has a period in it", "leave the period out, or quote the name wherever it is used")
        }
        _ if text.contains(&b'=') => ("it has `=` in it", "put a comma before the next parameter, or quote the name"),
        _ => return fault_of_length(text).or_else(|| fault_of_any(0, text)),
    };
    Some(Fault { what, help })
}

/// Blanks do not count.
fn fault_of_length(text: &[u8]) -> Option<Fault> {
    let length = text.iter().filter(|byte| !byte.is_ascii_whitespace()).count();
    (length > LONGEST).then_some(TOO_LONG)
}

fn fault_of_any(length: usize, name: &[u8]) -> Option<Fault> {
    if length > LONGEST {
        return Some(TOO_LONG);
    }
    let is_reserved = name.starts_with(b"__") && name.ends_with(b"__");
    is_reserved.then_some(Fault {
        what: "names that begin and end with two underscores are reserved",
        help: "leave the underscores at one end out",
    })
}
