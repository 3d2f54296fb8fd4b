//! Fast path for numbers of few digits, as nearly all in a deck are.
//!
//! The digits are an integer below 2⁵³ and the power of ten is at most 10²²: both are exact as f64, and one product or
//! quotient of them is rounded once, to the number nearest to the decimal (Clinger, PLDI 1990). Everything else is left to the
//! standard library.

/// The powers of ten that are exact.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// The most digits that surely fit into 64 bits.
const MAX_DIGITS: usize = 19;

/// The integers up to here are exact.
const MAX_EXACT: u64 = 1 << 53;

/// Reads the number at the beginning of `text`, and returns its length; anything may follow.
///
/// `None` means undecided: a number with more digits, a larger exponent or one after a D, or no number.
/// The caller must check whether the number ends there.
///
/// ```
/// use inpact_parser::number::read_plain;
///
/// assert_eq!(read_plain(b"-1.5e3,4"), Some((-1500.0, 6)));
/// assert_eq!(read_plain(b"nan"), None);
/// ```
#[inline]
pub fn read_plain(text: &[u8]) -> Option<(f64, usize)> {
    let (sign, start) = match text.first()? {
        b'-' => (-1.0, 1),
        b'+' => (1.0, 1),
        _ => (1.0, 0),
    };
    // Mostly few digits stand before the point, and many behind it.
    let (whole, mut at) = few_digits(text, start, 0);
    let (mut mantissa, mut count, mut exponent) = (whole, at - start, 0);
    if text.get(at) == Some(&b'.') {
        let from = at + 1;
        (mantissa, at) = digits(text, from, mantissa);
        let decimals = at - from;
        count += decimals;
        // More digits than `MAX_DIGITS` are refused below.
        exponent = -i32::try_from(decimals).ok()?;
    }
    if count == 0 || MAX_DIGITS < count || MAX_EXACT < mantissa {
        return None;
    }
    if matches!(text.get(at), Some(b'e' | b'E')) {
        let (power, end) = power(text, at + 1)?;
        exponent += power;
        at = end;
    }
    let magnitude = mantissa as f64;
    let scale = *POWERS.get(usize::try_from(exponent.unsigned_abs()).ok()?)?;
    let magnitude = if exponent < 0 { magnitude / scale } else { magnitude * scale };
    Some((sign * magnitude, at))
}

/// The exponent whose sign or first digit is at `at`, and where it ends.
fn power(text: &[u8], at: usize) -> Option<(i32, usize)> {
    let (sign, start) = match text.get(at)? {
        b'-' => (-1, at + 1),
        b'+' => (1, at + 1),
        _ => (1, at),
    };
    let (power, end) = few_digits(text, start, 0);
    // Exponents with more digits are out of range, and this many cannot overflow.
    let is_short = (1..=4).contains(&(end - start));
    is_short.then_some((sign * i32::try_from(power).ok()?, end))
}

/// Appends the digits at `at` to `number`, and gives where they end; of more digits than 64 bits hold the number is wrong.
#[inline]
fn digits(text: &[u8], mut at: usize, mut number: u64) -> (u64, usize) {
    while let Some(eight) = text.get(at..).and_then(|rest| rest.first_chunk()).and_then(|chunk| eight_digits(*chunk)) {
        number = number.wrapping_mul(100_000_000).wrapping_add(eight);
        at += 8;
    }
    few_digits(text, at, number)
}

/// The same, digit by digit.
#[inline]
fn few_digits(text: &[u8], mut at: usize, mut number: u64) -> (u64, usize) {
    while let Some(digit) = text.get(at).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10) {
        number = number.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    (number, at)
}

/// The number of eight digits; `None` if one of the bytes is none.
#[inline]
fn eight_digits(bytes: [u8; 8]) -> Option<u64> {
    let word = u64::from_le_bytes(bytes);
    // Of a digit the upper half is 3, and remains so with 6 added.
    let upper =
        (word & 0xF0F0_F0F0_F0F0_F0F0) | ((word.wrapping_add(0x0606_0606_0606_0606) & 0xF0F0_F0F0_F0F0_F0F0) >> 4);
    if upper != 0x3333_3333_3333_3333 {
        return None;
    }
    // Neighbours are joined: digits to pairs, pairs to fours, fours to eight.
    let pairs = (word & 0x0F0F_0F0F_0F0F_0F0F).wrapping_mul(10 << 8 | 1) >> 8;
    let fours = (pairs & 0x00FF_00FF_00FF_00FF).wrapping_mul(100 << 16 | 1) >> 16;
    Some((fours & 0x0000_FFFF_0000_FFFF).wrapping_mul(10_000 << 32 | 1) >> 32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::parse;
    use proptest::prelude::*;

    fn bits(text: &str) -> Option<u64> {
        read_plain(text.as_bytes()).filter(|(_, length)| *length == text.len()).map(|(value, _)| value.to_bits())
    }

    #[test]
    fn numbers_of_decks_are_plain() {
        for text in [
            "0",
            "-0.",
            "+5",
            ".5",
            "5.",
            "1.E6",
            "5e-05",
            "6.632957449673e7",
            "4.750000000000e-7",
            "300.00",
            "12345678",
            "1234567890123456.",
            "-1.5E+10",
            "0.000000000000e0",
            "9007199254740992",
            "1e22",
            "1e-22",
        ] {
            assert_eq!(bits(text), text.parse().ok().map(f64::to_bits), "{text}");
        }
    }

    #[test]
    fn others_are_left_to_others() {
        for text in [
            "",
            ".",
            "-",
            "+",
            "e5",
            "1e",
            "1e+",
            "--1",
            "nan",
            "1.5-3",
            "1D5",
            "9007199254740993",
            "1e23",
            "1e-23",
            "1e00005",
            "12345678901234567890",
            "0.00000000000000000001",
            "１",
        ] {
            assert_eq!(bits(text), None, "{text}");
        }
        // Where the number ends is for others to judge.
        assert_eq!(read_plain(b"1.5-3"), Some((1.5, 3)));
        assert_eq!(read_plain(b"12 , 3"), Some((12.0, 2)));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]
        #[test]
        fn a_plain_number_is_the_nearest(text in "[+-]?[0-9]{0,12}\\.?[0-9]{0,13}([eE][+-]?[0-9]{0,3})?") {
            if let Some(found) = bits(&text) {
                prop_assert_eq!(Some(found), parse(text.as_bytes()).map(f64::to_bits), "{}", text);
            }
        }

        #[test]
        fn any_bytes_are_read_as_the_standard_library_does(text in prop::collection::vec(prop_oneof![
            10 => b'0'..=b'9', 1 => Just(b'.'), 1 => Just(b'e'), 1 => Just(b'-'), 1 => any::<u8>(),
        ], 0..24)) {
            if let Some((value, length)) = read_plain(&text) {
                prop_assert_eq!(Some(value.to_bits()), parse(&text[..length]).map(f64::to_bits));
            }
        }
    }
}
