//! The number in a cell of text: anything that Rust parses as f64, including `nan` and `inf`.
//!
//! Short decimals are read as in decks; everything else is left to the standard library, so that both give the same bits.

use inpact_parser::number::read_plain;

/// The number of a cell, ignoring blanks around it; `None` where it is empty or not a number.
#[inline]
pub(super) fn number(cell: &[u8]) -> Option<f64> {
    match read_plain(cell) {
        Some((value, end)) if end == cell.len() => Some(value),
        _ => std::str::from_utf8(cell.trim_ascii()).ok()?.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The number by the contract, parsed by the standard library.
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
