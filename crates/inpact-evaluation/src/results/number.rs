//! Formatting of numbers in tables and plans.

use std::io::Write;

/// Adds a number in the shortest form that reads back to the same f64: `20`, `0.05`, `1e-7`, `-0`, `inf`, `NaN`.
///
/// Numbers below 1e-4 and from 1e16 on have an exponent.
#[inline]
pub fn push_number(text: &mut Vec<u8>, value: f64) {
    if !value.is_finite() {
        let word: &[u8] = if value.is_nan() { b"NaN" } else { b"inf" };
        if value == f64::NEG_INFINITY {
            text.push(b'-');
        }
        text.extend_from_slice(word);
        return;
    }
    let size = value.abs();
    let mut buffer = zmij::Buffer::new();
    let printed = buffer.format_finite(value).as_bytes();
    if size != 0.0 && size < 1e-4 {
        push_small(text, printed);
    } else if size < 1e16 {
        push_printed(text, printed.strip_suffix(b".0").unwrap_or(printed));
    } else {
        // An exponent needs no sign.
        text.extend(printed.iter().filter(|byte| **byte != b'+'));
    }
}

/// Adds a printed number; most have 8 to 24 letters, which are copied as blocks of 8 or 16 that overlap: no call for a few bytes.
#[inline]
fn push_printed(text: &mut Vec<u8>, printed: &[u8]) {
    const MOST: usize = 24;
    let (start, length) = (text.len(), printed.len());
    if let (8..=MOST, Some(first), Some(last)) = (length, printed.first_chunk::<8>(), printed.last_chunk::<8>()) {
        text.extend_from_slice(&[0; MOST]);
        let to = &mut text[start..start + MOST];
        to[..8].copy_from_slice(first);
        if let Some(first) = printed.first_chunk::<16>() {
            to[..16].copy_from_slice(first);
        }
        to[length - 8..length].copy_from_slice(last);
        text.truncate(start + length);
    } else {
        text.extend_from_slice(printed);
    }
}

/// Adds a number below 1e-4, which may have been printed without an exponent: `0.000012` is `1.2e-5`.
fn push_small(text: &mut Vec<u8>, printed: &[u8]) {
    let (sign, size) = printed.split_at(usize::from(printed[0] == b'-'));
    let Some(digits) = size.strip_prefix(b"0.").filter(|digits| !digits.contains(&b'e')) else {
        text.extend_from_slice(printed);
        return;
    };
    let zeros = digits.iter().take_while(|digit| **digit == b'0').count();
    let digits = &digits[zeros..];
    text.extend_from_slice(sign);
    text.push(digits[0]);
    if digits.len() > 1 {
        text.push(b'.');
        text.extend_from_slice(&digits[1..]);
    }
    // Writing into a vector cannot fail.
    let _ = write!(text, "e-{}", zeros + 1);
}

/// A bound in two digits, rounded up: `6.7e-16`.
pub fn rounded_up(bound: f64) -> String {
    let text = format!("{bound:.1e}");
    let is_below = text.parse().is_ok_and(|shown: f64| shown < bound);
    match text.split_once('e') {
        Some((digits, exponent)) if is_below => {
            let digits: f64 = digits.parse().unwrap_or_default();
            format!("{:.1}e{exponent}", digits + 0.1)
        }
        _ => text,
    }
}

/// A number in its shortest form, see [`push_number`].
pub(crate) fn number_text(value: f64) -> String {
    let mut text = Vec::new();
    push_number(&mut text, value);
    String::from_utf8_lossy(&text).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        let text = |value| {
            let mut line = Vec::new();
            push_number(&mut line, value);
            String::from_utf8(line).expect("ASCII")
        };
        assert_eq!(text(0.0), "0");
        assert_eq!(text(-0.0), "-0");
        assert_eq!(text(20.0), "20");
        assert_eq!(text(0.1), "0.1");
        assert_eq!(text(2.5e-7), "2.5e-7");
        assert_eq!(text(1e300), "1e300");
        assert_eq!(text(f64::INFINITY), "inf");
        assert_eq!(text(-f64::INFINITY), "-inf");
        assert_eq!(text(f64::NAN), "NaN");
        assert_eq!(text(-f64::NAN), "NaN");
        assert_eq!(text(-9.999_999e-5), "-9.999999e-5");
        for value in [f64::MIN_POSITIVE, 5e-324, 1.0 / 3.0, 1e15, 1e16, 123_456_789.0, f64::MAX, -2.0f64.powi(60)] {
            assert_eq!(text(value).parse(), Ok(value));
        }
    }

    /// The debug form of the standard library, except for the `.0` of integers.
    fn judge(value: f64) -> String {
        let text = format!("{value:?}");
        text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
    }

    proptest! {
        /// The same number with as many digits as in the standard library; the last one may differ in ties.
        #[test]
        fn numbers_are_as_short_as_those_of_the_standard_library(bits in any::<u64>(), digits in -99_999..99_999_i32, power in -25..25_i32) {
            let short = f64::from(digits) * 10.0f64.powi(power);
            let halfway = (2.0f64.powi(50) + f64::from(digits.unsigned_abs()) + 0.25) * f64::from(digits.signum());
            for value in [f64::from_bits(bits), halfway, 263_508_915_864_979.0 + 0.625, short, short.next_up(), short.next_down()] {
                let mut text = Vec::new();
                push_number(&mut text, value);
                let (text, judge) = (String::from_utf8_lossy(&text).into_owned(), judge(value));
                prop_assert_eq!(text.len(), judge.len(), "{} for {}", text, judge);
                let read: f64 = text.parse().expect("a number");
                prop_assert!(read == value || (read.is_nan() && value.is_nan()), "{} for {}", text, judge);
                let differing = text.bytes().zip(judge.bytes()).filter(|(a, b)| a != b).count();
                prop_assert!(differing <= 1, "{} for {}", text, judge);
            }
        }
    }

    #[test]
    fn bounds_are_never_shown_smaller() {
        assert_eq!(rounded_up(4.44e-16), "4.5e-16");
        assert_eq!(rounded_up(4.5e-16), "4.5e-16");
        assert_eq!(rounded_up(9.96e-3), "1.0e-2");
        assert_eq!(rounded_up(9.94e-3), "10.0e-3");
        assert_eq!(rounded_up(0.0), "0.0e0");
        assert_eq!(rounded_up(f64::INFINITY), "inf");
    }
}
