//! The values of the numbers and texts of an expression, and the problems of malformed ones.

use super::arithmetic::{integer_too_large, real_too_large, text, text_too_long};
use super::value::Value;
use super::{Complaint, MAX_TEXT, quoted};

/// The value of digits.
pub(super) fn integer_literal(digits: &[u8]) -> Result<Value, Complaint> {
    if digits.len() > 1 && digits[0] == b'0' && digits.iter().any(|digit| *digit != b'0') {
        let what = format!("the integer {} begins with 0, which Python takes for octal", quoted(digits));
        return Err(Complaint::new(what).help("leave out the leading zeros"));
    }
    let value = str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
    value.map(Value::Integer).ok_or_else(|| integer_too_large(&quoted(digits)))
}

/// The value of digits with a point or an exponent: the nearest f64.
pub(super) fn real_literal(digits: &[u8]) -> Result<Value, Complaint> {
    let value = str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
    let finite = value.filter(|value: &f64| value.is_finite());
    finite.map(Value::Real).ok_or_else(|| real_too_large(&quoted(digits)))
}

/// A text without its quotes, with Python's escapes for backslash and quotes; a backslash before anything that is not an
/// escape is two characters.
pub(super) fn text_literal(word: &[u8]) -> Result<Value, Complaint> {
    let inner = &word[1..word.len() - 1];
    // An escape takes two bytes for one.
    if inner.len() > 2 * MAX_TEXT {
        return Err(text_too_long(inner.len()));
    }
    let mut content = Vec::with_capacity(inner.len());
    let mut bytes = inner.iter().copied().peekable();
    while let Some(byte) = bytes.next() {
        match (byte, bytes.peek().copied()) {
            (b'\\', Some(escaped @ (b'\\' | b'\'' | b'"'))) => {
                content.push(escaped);
                bytes.next();
            }
            (b'\\', Some(escaped @ (b'a' | b'b' | b'f' | b'n' | b'r' | b't' | b'v' | b'x' | b'0'..=b'7'))) => {
                return Err(control_character(char::from(escaped)));
            }
            _ => content.push(byte),
        }
    }
    text(String::from_utf8(content).map_err(|_| Complaint::new("the text holds bytes that are not UTF-8"))?)
}

fn control_character(escape: char) -> Complaint {
    Complaint::new(format!("the text holds the escape `\\{escape}`, a control character in Python"))
        .help(format!("write `\\\\{escape}` for a backslash before `{escape}`"))
}

/// The problem of a malformed number.
pub(super) fn malformed_number(word: &[u8]) -> Complaint {
    let (mantissa, exponent) = word.split_at(word.iter().position(u8::is_ascii_alphabetic).unwrap_or(word.len()));
    if let [b'd' | b'D', digits @ ..] = exponent
        && digits.last().is_some_and(u8::is_ascii_digit)
        && !digits.iter().any(u8::is_ascii_alphabetic)
    {
        let what = format!("the number {} has a D exponent, which *PARAMETER does not know", quoted(word));
        return Complaint::new(what).help(format!("write {}", quoted(&[mantissa, b"E", digits].concat())));
    }
    Complaint::new(format!("{} is neither a number nor a name", quoted(word)))
}
