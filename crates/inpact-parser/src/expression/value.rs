//! Values of parameters and their text.

use crate::number::float_text;
use std::fmt;

/// The value of a parameter: one of the three types of S-60.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// An integer; 64 bits, where Python has no limit.
    Integer(i64),
    /// A real number, always finite.
    Real(f64),
    /// A character string.
    Text(String),
}

impl Value {
    /// The value as a number; `None` for a text, even one that could be read as a number.
    pub fn as_number(&self) -> Option<f64> {
        match self {
            Self::Integer(value) => Some(*value as f64),
            Self::Real(value) => Some(*value),
            Self::Text(_) => None,
        }
    }

    /// The type with its article, for messages.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Integer(_) => "an integer",
            Self::Real(_) => "a real number",
            Self::Text(_) => "a text",
        }
    }
}

/// The text that replaces `<name>` (S-62): a real number in the shortest form that reads back to
/// the same f64, with a point or an exponent; a text without quotes.
impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integer(value) => write!(formatter, "{value}"),
            Self::Real(value) => formatter.write_str(&float_text(*value)),
            Self::Text(text) => formatter.write_str(text),
        }
    }
}

/// `str` of Python 2 for a real number: twelve significant digits, `.0` after a whole number, and an exponent from 1e11 on
/// (there C's `%.12g` still has none) and below 1e-4.
pub(super) fn python_text(value: f64) -> String {
    const DIGITS: i32 = 12;
    let scientific = format!("{:.*e}", DIGITS as usize - 1, value);
    let (mantissa, exponent) = scientific.split_once('e').expect("the scientific format has an exponent");
    let exponent: i32 = exponent.parse().expect("the exponent of the scientific format is an integer");
    if (-4..DIGITS - 1).contains(&exponent) {
        let fixed = format!("{:.*}", usize::try_from(DIGITS - 1 - exponent).unwrap_or(0), value);
        if !fixed.contains('.') {
            return fixed + ".0";
        }
        let short = fixed.trim_end_matches('0');
        return if short.ends_with('.') { format!("{short}0") } else { short.to_owned() };
    }
    let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{mantissa}e{sign}{:02}", exponent.abs())
}
