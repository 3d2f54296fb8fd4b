//! Substitution of `<name>` in keyword values and data lines (S-62).

use super::lexer::{is_blank, is_name_byte, is_parameter_name};
use super::parameters::Parameters;
use std::borrow::Cow;
use std::fmt::Write;
use std::ops::Range;

/// A reference to a parameter.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reference<'text> {
    /// `<name>`, with the brackets.
    pub range: Range<usize>,
    /// The name between them.
    pub name: &'text str,
}

/// Reasons why a text cannot be substituted.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SubstitutionError {
    /// No *PARAMETER defines the name (S015).
    #[error("the parameter `{0}` is not defined")]
    Undefined(String),
    /// The name is defined by a statement that has a problem, which is reported there (S016).
    #[error("the definition of the parameter `{0}` has no value")]
    WithoutValue(String),
    /// The result would be longer than sixteen times the text and 64 KiB, which only a hostile deck has.
    #[error("{bytes} bytes become more than {most} when their parameters are substituted")]
    TooLong {
        /// The length of the text.
        bytes: usize,
        /// The limit.
        most: usize,
    },
}

/// The references in a text, from left to right: a name between `<` and `>`, with or without blanks around it.
///
/// Anything else between these characters is not a reference.
pub fn references(text: &[u8]) -> impl Iterator<Item = Reference<'_>> {
    let mut from = 0;
    std::iter::from_fn(move || {
        loop {
            let open = from + memchr::memchr(b'<', &text[from..])?;
            let inner = &text[open + 1..];
            let length = inner.iter().take_while(|byte| is_name_byte(**byte) || is_blank(**byte)).count();
            from = open + 1 + length;
            if text.get(from) != Some(&b'>') {
                continue;
            }
            let name = inner[..length].trim_ascii();
            if let (true, Ok(name)) = (is_parameter_name(name), str::from_utf8(name)) {
                from += 1;
                return Some(Reference { range: open..from, name });
            }
        }
    })
}

/// The text with every `<name>` replaced by the value of the parameter; borrowed when it has none.
///
/// A value may contain commas, so this comes before the text is split into items.
///
/// # Errors
/// The leftmost reference without a value; or a result that exceeds the limits.
pub fn substitute<'text>(text: &'text str, parameters: &Parameters) -> Result<Cow<'text, str>, SubstitutionError> {
    let mut replaced = String::new();
    let mut copied = 0;
    let most = 16 * text.len() + (64 << 10);
    for reference in references(text.as_bytes()) {
        let Some(definition) = parameters.definition(reference.name) else {
            return Err(SubstitutionError::Undefined(reference.name.to_owned()));
        };
        let Some(value) = &definition.value else {
            return Err(SubstitutionError::WithoutValue(reference.name.to_owned()));
        };
        replaced.push_str(&text[copied..reference.range.start]);
        copied = reference.range.end;
        write!(replaced, "{value}").expect("writing to a string does not fail");
        if most < replaced.len() {
            return Err(SubstitutionError::TooLong { bytes: text.len(), most });
        }
    }
    if copied == 0 {
        return Ok(Cow::Borrowed(text));
    }
    replaced.push_str(&text[copied..]);
    Ok(Cow::Owned(replaced))
}
