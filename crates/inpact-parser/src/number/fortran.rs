//! Numbers as CalculiX reads them: by the Fortran format F20.0 (CX-05).
//!
//! Blanks are removed; the first 20 remaining characters count, whatever follows.
//! The exponent may occur after E, D or Q, or after its sign alone.
//! A text without digits before the exponent is 0 for Fortran; it is not a number here, nor are `nan` and `inf`, which Fortran accepts.

use super::{FLOAT_CHARACTERS, NumberError};

/// Reading of an item by CalculiX.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FortranNumber {
    /// The number that is written.
    Whole(f64),
    /// The number of the first 20 characters.
    Cut {
        /// The number.
        value: f64,
        /// The value of all characters together; `None` when that is not a number.
        whole: Option<f64>,
    },
    /// The first 20 characters are no number, though all of them may be.
    CutToNothing,
}

/// Reads an item.
///
/// # Errors
/// A text that is not a number by the format, has no digits before its exponent, is not finite or too large.
pub fn read_fortran(text: &[u8]) -> Result<FortranNumber, NumberError> {
    let kept: Vec<u8> = text.iter().copied().filter(|byte| !matches!(byte, b' ' | b'\t')).collect();
    if kept.len() <= FLOAT_CHARACTERS {
        return read_f20(&kept).map(FortranNumber::Whole);
    }
    let whole = read_f20(&kept);
    match read_f20(&kept[..FLOAT_CHARACTERS]) {
        Ok(value) => Ok(FortranNumber::Cut { value, whole: whole.ok() }),
        // A text that is not a number at all is reported as such.
        Err(_) if whole.is_ok() => Ok(FortranNumber::CutToNothing),
        Err(error) => Err(error),
    }
}

/// Reads a field of the format F20.0 that has no blanks.
fn read_f20(field: &[u8]) -> Result<f64, NumberError> {
    let unsigned = field.strip_prefix(b"-").or(field.strip_prefix(b"+")).unwrap_or(field);
    let mantissa_end = unsigned.iter().position(|byte| !matches!(byte, b'0'..=b'9' | b'.')).unwrap_or(unsigned.len());
    let (mantissa, rest) = unsigned.split_at(mantissa_end);
    if !mantissa.iter().any(u8::is_ascii_digit) {
        return Err(NumberError::Malformed);
    }
    let exponent = match rest {
        [] => &b"0"[..],
        [b'e' | b'E' | b'd' | b'D' | b'q' | b'Q', exponent @ ..] => exponent,
        [b'+' | b'-', ..] => rest,
        _ => return Err(NumberError::Malformed),
    };
    let digits = exponent.strip_prefix(b"-").or(exponent.strip_prefix(b"+")).unwrap_or(exponent);
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Err(NumberError::Malformed);
    }
    let mut written = field[..field.len() - rest.len()].to_vec();
    written.push(b'e');
    written.extend_from_slice(exponent);
    match std::str::from_utf8(&written).ok().and_then(|text| text.parse::<f64>().ok()) {
        Some(value) if value.is_finite() => Ok(value),
        Some(_) => Err(NumberError::TooLarge),
        None => Err(NumberError::Malformed),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Measured with ccx 2.20: a conductance written so.
    #[test]
    fn cx_05_numbers_of_ccx() {
        let whole = |text: &str| read_fortran(text.as_bytes());
        for text in
            ["1 00.", "1.+2", "1d2", "1q2", "1e 2", "1.0E+0000002", "10 0", "1+2", "10000.-2", "+.1E+3", " 1\t00"]
        {
            assert_eq!(whole(text), Ok(FortranNumber::Whole(100.0)), "{text}");
        }
        assert_eq!(whole("1e-400"), Ok(FortranNumber::Whole(0.0)));
        for text in [
            "1.2.3", "abc", "1e", "0x10", "1_0", "1/2", "1+", "1e+", "1e5.", "\"100\"", "100;", "1E2E2", "1.e", "1f2",
            "", // Fortran takes these for 0 and for what is not finite.
            "--1", ".", "+", "e5", "nan", "inf",
        ] {
            assert_eq!(whole(text), Err(NumberError::Malformed), "{text}");
        }
        assert_eq!(whole("1e400"), Err(NumberError::TooLarge));
    }

    #[test]
    fn cx_05_twenty_characters_count() {
        let cut = |value, whole| Ok(FortranNumber::Cut { value, whole: Some(whole) });
        assert_eq!(read_fortran(b"5.0000000000000000e+01"), Ok(FortranNumber::CutToNothing));
        assert_eq!(read_fortran(b"0.00000000000000000000000001e+28"), cut(0.0, 100.0));
        assert_eq!(read_fortran(b"100.00000000000000000000"), cut(100.0, 100.0));
        assert_eq!(read_fortran(b"1.00000000000000000000x"), Ok(FortranNumber::Cut { value: 1.0, whole: None }));
        assert_eq!(read_fortran(b"abcdefghijklmnopqrstuvwxyz"), Err(NumberError::Malformed));
    }
}
