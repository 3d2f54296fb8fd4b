//! Numbers as Abaqus writes them (S-34, S-35).
//!
//! Reading is exact: the result is the f64 nearest to the decimal that stands there.

/// Why a text is no number.
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

/// The most characters of a float, sign, point and exponent included (S-34).
pub const FLOAT_CHARACTERS: usize = 20;

/// The most digits of an integer (S-35).
pub const INTEGER_DIGITS: usize = 9;

/// Reads a float: optional sign, digits with at most one point, optional exponent behind `E` or `D`.
///
/// # Errors
/// `nan`, `inf`, hexadecimal digits, digit separators and an exponent without a letter are refused, and so is a
/// magnitude above the largest f64.
pub fn read_float(text: &[u8]) -> Result<f64, NumberError> {
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

/// A number whose exponent stands behind a D, as Fortran writes it.
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
/// Anything else is refused, a float such as `5.0` too (S-35), and so is a magnitude beyond 64 bits.
pub fn read_integer(text: &[u8]) -> Result<i64, NumberError> {
    std::str::from_utf8(text).ok().and_then(|text| text.parse().ok()).ok_or(NumberError::NotAnInteger)
}

/// The shortest text that reads back to the same f64, with a point or an exponent so that it is a float: `10.`, `1.5`, `2E-07`.
pub fn float_text(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1e-4..1e16).contains(&magnitude) {
        return format!("{value:E}");
    }
    let text = value.to_string();
    if text.contains('.') { text } else { text + "." }
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
    fn what_is_no_number() {
        for text in ["nan", "inf", "-inf", "0x10", "1_000", "", ".", "+", "e5", "1e", "1e5.", "--1", "1E5E2", "1d2d3"] {
            assert_eq!(read_float(text.as_bytes()), Err(NumberError::Malformed), "{text}");
        }
        assert_eq!(read_float(b"1e999"), Err(NumberError::TooLarge));
        assert_eq!(read_float(b"1e-999"), Ok(0.0));
    }
}
