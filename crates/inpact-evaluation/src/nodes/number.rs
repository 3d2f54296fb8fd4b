//! The number a cell of text holds: what Rust reads as f64, `nan` and `inf` among it.
//!
//! Few digits and a small exponent are the common case: both are exact as f64, and one multiplication or division rounds once (Clinger 1990).
//! Everything else is the standard library's business, so that both give the same bits.

/// The powers of ten that are exact as f64.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// As many digits fit into 64 bits.
const MOST_DIGITS: usize = 19;

/// Whole numbers up to here are exact as f64.
const MOST_EXACT: u64 = 1 << 53;

/// The number of a cell, blanks around it taken off; `None` where it is empty or no number.
#[inline]
pub(super) fn number(cell: &[u8]) -> Option<f64> {
    match leading_number(cell) {
        Some((value, end)) if end == cell.len() => Some(value),
        _ => std::str::from_utf8(cell.trim_ascii()).ok()?.parse().ok(),
    }
}

/// The number that a text begins with and where it ends; `None` where the quick way does not lead to it.
///
/// Only what stands behind the end says whether the number is the whole cell.
#[inline]
pub(super) fn leading_number(text: &[u8]) -> Option<(f64, usize)> {
    let is_negative = text.first() == Some(&b'-');
    let mut at = usize::from(is_negative);
    let mut digits = 0_u64;
    let whole = push_digits(text, &mut at, &mut digits);
    let mut count = whole;
    let mut exponent = 0_i64;
    if text.get(at) == Some(&b'.') {
        at += 1;
        let fraction = push_digits(text, &mut at, &mut digits);
        count += fraction;
        exponent = -i64::try_from(fraction).ok()?;
    }
    if count == 0 || count > MOST_DIGITS || digits > MOST_EXACT {
        return None;
    }
    if matches!(text.get(at), Some(b'e' | b'E')) {
        at += 1;
        let is_small = text.get(at) == Some(&b'-');
        at += usize::from(is_small || text.get(at) == Some(&b'+'));
        let mut power = 0_u64;
        let count = push_digits(text, &mut at, &mut power);
        if count == 0 || count > 4 {
            return None;
        }
        let power = i64::try_from(power).ok()?;
        exponent += if is_small { -power } else { power };
    }
    let scale = *POWERS.get(usize::try_from(exponent.unsigned_abs()).ok()?)?;
    let value = digits as f64;
    let value = if exponent < 0 { value / scale } else { value * scale };
    Some((if is_negative { -value } else { value }, at))
}

/// Adds the digits that begin at `at` to `number`, which wraps when they are too many; gives how many there are.
#[inline]
fn push_digits(text: &[u8], at: &mut usize, number: &mut u64) -> usize {
    let start = *at;
    while let Some(digit) = text.get(*at).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10) {
        *number = number.wrapping_mul(10).wrapping_add(u64::from(digit));
        *at += 1;
    }
    *at - start
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The number by the contract, read by the standard library alone.
    fn judge(cell: &[u8]) -> Option<u64> {
        std::str::from_utf8(cell.trim_ascii()).ok()?.parse().ok().map(f64::to_bits)
    }

    #[test]
    fn corners_are_read_as_the_standard_library_reads_them() {
        for cell in [
            "",
            "-",
            ".",
            "-.",
            "+",
            "e5",
            "1e",
            "1e+",
            "1e-",
            ".5",
            "5.",
            "-0",
            "+1",
            "0x10",
            "1_000",
            "1,5",
            "1.5-3",
            "1d3",
            "inf",
            "-Infinity",
            "NaN",
            "-nan",
            "1e22",
            "1e23",
            "9007199254740993",
            "9007199254740992e1",
            "1e-22",
            "1e99999",
            "0e99999",
            "0.000000000000000000000000001",
            "18446744073709551616",
            "184467440737095516160",
            "1.7976931348623157e308",
            "5e-324",
            " 1.5",
            "1.5 ",
            "1 5",
            "1e5.0",
            "1.2.3",
            "--1",
            "\u{0661}",
            "1e00001",
        ] {
            assert_eq!(number(cell.as_bytes()).map(f64::to_bits), judge(cell.as_bytes()), "{cell:?}");
        }
    }

    proptest! {
        #[test]
        fn every_number_reads_back(bits in any::<u64>()) {
            let value = f64::from_bits(bits);
            for text in [format!("{value:?}"), format!("{value:e}"), format!("{value}")] {
                prop_assert_eq!(number(text.as_bytes()).map(f64::to_bits), judge(text.as_bytes()));
            }
        }

        #[test]
        fn short_numbers_are_read_as_the_standard_library_reads_them(text in "[-+]?[0-9]{0,21}(\\.[0-9]{0,21})?([eE][-+]?[0-9]{0,3})?") {
            prop_assert_eq!(number(text.as_bytes()).map(f64::to_bits), judge(text.as_bytes()));
        }

        #[test]
        fn any_bytes_are_read_as_the_standard_library_reads_them(cell in prop::collection::vec(any::<u8>(), 0..12)) {
            prop_assert_eq!(number(&cell).map(f64::to_bits), judge(&cell));
        }
    }
}
