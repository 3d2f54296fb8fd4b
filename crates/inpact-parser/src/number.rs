//! Numbers as Abaqus writes them (S-34, S-35).
//!
//! Reading is exact: the result is the f64 nearest to the decimal that is written.

mod fortran;
mod plain;

pub use fortran::{FortranNumber, read_fortran};
pub use plain::read_plain;

/// Reasons why a text is not a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NumberError {
    /// Not of the form sign, digits, point, exponent.
    Malformed,
    /// `1.5-3`: an exponent without its letter; the byte offset of the exponent's sign is given.
    ExponentWithoutLetter(usize),
    /// Well formed, but its magnitude lies above the largest f64, 1.797e308.
    TooLarge,
    /// A float, or no number, where an integer is due.
    NotAnInteger,
}

/// The maximum number of characters of a float, including sign, point and exponent (S-34).
pub const FLOAT_CHARACTERS: usize = 20;

/// The maximum number of digits of an integer (S-35).
pub const INTEGER_DIGITS: usize = 9;

/// Reads a float: optional sign, digits with at most one point, optional exponent after `E` or `D`.
///
/// # Errors
/// `nan`, `inf`, hexadecimal digits, digit separators and an exponent without a letter are rejected, and so is a
/// magnitude above the largest f64.
#[inline]
pub fn read_float(text: &[u8]) -> Result<f64, NumberError> {
    match read_plain(text) {
        Some((value, length)) if length == text.len() => Ok(value),
        _ => read_any_float(text),
    }
}

fn read_any_float(text: &[u8]) -> Result<f64, NumberError> {
    let unsigned = text.strip_prefix(b"-").or(text.strip_prefix(b"+")).unwrap_or(text);
    // Keeps out `nan` and `inf`, which the standard library would read.
    if !matches!(unsigned.first(), Some(b'0'..=b'9' | b'.')) {
        return Err(NumberError::Malformed);
    }
    match parse(text).or_else(|| parse_with_d(text)) {
        Some(value) if value.is_finite() => Ok(value),
        Some(_) => Err(NumberError::TooLarge),
        None => Err(exponent_without_letter(text)),
    }
}

/// A number whose exponent follows a D, as Fortran writes it.
fn parse_with_d(text: &[u8]) -> Option<f64> {
    let at = text.iter().position(|byte| matches!(byte, b'd' | b'D'))?;
    let mut with_e = text.to_vec();
    with_e[at] = b'E';
    parse(&with_e)
}

fn parse(text: &[u8]) -> Option<f64> {
    std::str::from_utf8(text).ok()?.parse().ok()
}

fn exponent_without_letter(text: &[u8]) -> NumberError {
    let Some(at) = text.iter().skip(1).position(|byte| matches!(byte, b'+' | b'-')).map(|at| at + 1) else {
        return NumberError::Malformed;
    };
    let is_number = !text[..at].iter().any(u8::is_ascii_alphabetic) && parse(&text[..at]).is_some();
    let digits = &text[at + 1..];
    if is_number && !digits.is_empty() && digits.iter().all(u8::is_ascii_digit) {
        NumberError::ExponentWithoutLetter(at)
    } else {
        NumberError::Malformed
    }
}

/// Reads an integer: optional sign and digits.
///
/// # Errors
/// Anything else is rejected, including a float such as `5.0` (S-35) and a magnitude beyond 64 bits.
pub fn read_integer(text: &[u8]) -> Result<i64, NumberError> {
    std::str::from_utf8(text).ok().and_then(|text| text.parse().ok()).ok_or(NumberError::NotAnInteger)
}

/// A text that reads back to the same f64, with a point or an exponent so that it is a float: `10.`, `1.5`, `2E-7`.
///
/// It has at most [`FLOAT_CHARACTERS`] wherever such a text exists: with 17 digits the point may have to be dropped
/// (`12345678901234569E7`), and a few numbers with an exponent below -9 have none (S-34).
pub fn float_text(value: f64) -> String {
    let magnitude = value.abs();
    let usual = if magnitude != 0.0 && !(1e-4..1e16).contains(&magnitude) {
        format!("{value:E}")
    } else {
        let text = value.to_string();
        if text.contains('.') { text } else { text + "." }
    };
    if usual.len() <= FLOAT_CHARACTERS || !value.is_finite() {
        return usual;
    }
    shortest(&format!("{value:e}")).filter(|text| text.len() <= FLOAT_CHARACTERS).unwrap_or(usual)
}

/// The nearest number that fits into [`FLOAT_CHARACTERS`], as text: [`float_text`] where that fits.
pub fn float_text_that_fits(value: f64) -> String {
    let mut digits = 17;
    loop {
        let rounded = format!("{value:.*e}", digits - 1);
        match rounded.parse().map(float_text) {
            Ok(text) if text.len() <= FLOAT_CHARACTERS || digits == 1 => return text,
            _ => digits -= 1,
        }
    }
}

/// The shortest way to write the digits of `1.2345e-6`: the point anywhere, or none, and an exponent unless it is zero.
fn shortest(scientific: &str) -> Option<String> {
    let (mantissa, exponent) = scientific.split_once('e')?;
    let exponent: i32 = exponent.parse().ok()?;
    let (sign, unsigned) = mantissa.strip_prefix('-').map_or(("", mantissa), |unsigned| ("-", unsigned));
    let digits = unsigned.replace('.', "");
    let count = i32::try_from(digits.len()).ok()?;
    let with_point = |before: i32| {
        let (whole, rest) = digits.split_at(usize::try_from(before).unwrap_or(0));
        match exponent - (before - 1) {
            0 => format!("{sign}{whole}.{rest}"),
            power if rest.is_empty() => format!("{sign}{whole}E{power}"),
            power => format!("{sign}{whole}.{rest}E{power}"),
        }
    };
    let zeros = usize::try_from(-exponent - 1).ok().filter(|zeros| *zeros < FLOAT_CHARACTERS);
    let without_exponent = zeros.map(|zeros| format!("{sign}.{}{digits}", "0".repeat(zeros)));
    (0..=count).map(with_point).chain(without_exponent).min_by_key(String::len)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_06_numbers() {
        for text in ["-12.345", "-1234.5E-2", "-1234.5D-2", "-1.2345E1", "-1.2345d+1"] {
            assert_eq!(read_float(text.as_bytes()), Ok(-12.345), "{text}");
        }
        for (text, value) in [("5.", 5.0), (".5", 0.5), ("+5", 5.0), ("5", 5.0), ("5.e3", 5000.0)] {
            assert_eq!(read_float(text.as_bytes()), Ok(value), "{text}");
        }
        assert_eq!(read_float(b"1.5-3"), Err(NumberError::ExponentWithoutLetter(3)));
        assert_eq!(read_integer(b"5.0"), Err(NumberError::NotAnInteger));
        assert_eq!(read_integer(b"1234567890"), Ok(1_234_567_890));
    }

    #[test]
    fn shortest_texts_read_back() {
        let cases =
            [(10.0, "10."), (1.5, "1.5"), (0.0, "0."), (-0.0, "-0."), (2e-7, "2E-7"), (1e16, "1E16"), (0.1, "0.1")];
        for (value, text) in cases {
            assert_eq!(float_text(value), text);
        }
        for value in [f64::MAX, f64::MIN_POSITIVE, 5e-324, -1.0 / 3.0, 123_456.789e-3] {
            assert_eq!(read_float(float_text(value).as_bytes()).map(f64::to_bits), Ok(value.to_bits()));
        }
    }

    #[test]
    fn s_34_no_more_than_twenty_characters_where_they_do() {
        let cases = [
            (1.234_567_890_123_456_9e23, "12345678901234569E7"),
            (-0.012_345_678_901_234_567, "-.012345678901234567"),
            (0.001_234_567_890_123_456_7, ".0012345678901234567"),
            (0.300_000_000_000_000_04, "0.30000000000000004"),
            (-1.234_567_890_123_456_8e15, "-1234567890123456.8"),
        ];
        for (value, text) in cases {
            assert_eq!(float_text(value), text);
            assert_eq!(read_float(text.as_bytes()).map(f64::to_bits), Ok(value.to_bits()), "{text}");
        }
        // Seventeen digits, a sign and an exponent of three digits: no text of twenty characters says it.
        let long = -1.234_567_890_123_456_8e-150;
        assert_eq!(float_text(long), "-1.2345678901234568E-150");
        assert_eq!(float_text_that_fits(long), "-12345678901235E-163");
        assert_eq!(float_text_that_fits(0.1), "0.1");
    }

    #[test]
    fn what_is_no_number() {
        for text in ["nan", "inf", "-inf", "0x10", "1_000", "", ".", "+", "e5", "1e", "1e5.", "--1", "1E5E2", "1d2d3"] {
            assert_eq!(read_float(text.as_bytes()), Err(NumberError::Malformed), "{text}");
        }
        assert_eq!(read_float(b"1e999"), Err(NumberError::TooLarge));
        assert_eq!(read_float(b"1e-999"), Ok(0.0));
    }
}
