//! Properties of a stretch of bytes, found in one vectorised pass.
//!
//! Mesh rows are plain: short ASCII lines that end in LF, without an asterisk. One pass finds out, and the scan can then
//! skip them. The loop is written so that the compiler vectorises it for any instruction set.

/// The lanes that are looked at side by side.
const LANES: usize = 64;

/// The bytes that must hold a line end for the lines around them to be of ordinary length.
const BLOCK: usize = 2 * LANES;

/// The number of blocks in which a lane can count line ends before its eight bits are full.
const BLOCKS_A_COUNT: usize = 255 / 2;

/// Properties of a range of bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Survey {
    /// The number of LFs.
    pub(super) line_feeds: u64,
    /// Whether every byte is below 0x80.
    pub(super) is_ascii: bool,
    pub(super) has_carriage_return: bool,
    pub(super) has_asterisk: bool,
    /// `false` is certain; `true` means that there may be letters, those of exponents among them.
    pub(super) may_have_letters: bool,
    /// `false` is certain; `true` means that a line may be longer than 256 bytes.
    pub(super) may_have_long_line: bool,
}

impl Survey {
    /// Surveys `bytes`.
    pub(super) fn of(bytes: &[u8]) -> Self {
        if bytes.len() < BLOCK { survey(bytes) } else { pulp::Arch::new().dispatch(|| survey(bytes)) }
    }
}

// Inlined into the closure that is compiled for each instruction set; a call would be compiled for the baseline only.
#[expect(clippy::inline_always, reason = "the instruction set is chosen around the call")]
#[inline(always)]
fn survey(bytes: &[u8]) -> Survey {
    let mut any = [0_u8; LANES];
    let mut carriage_returns = [0_u8; LANES];
    let mut asterisks = [0_u8; LANES];
    let mut line_feeds = 0_u64;
    let mut may_have_long_line = false;
    let (blocks, rest) = bytes.as_chunks::<BLOCK>();
    for group in blocks.chunks(BLOCKS_A_COUNT) {
        let mut counts = [0_u8; LANES];
        for block in group {
            let mut ends = [0_u8; LANES];
            for half in block.as_chunks::<LANES>().0 {
                for lane in 0..LANES {
                    let byte = half[lane];
                    any[lane] |= byte;
                    carriage_returns[lane] |= u8::from(byte == b'\r');
                    asterisks[lane] |= u8::from(byte == b'*');
                    ends[lane] += u8::from(byte == b'\n');
                }
            }
            let mut has_end = 0;
            for lane in 0..LANES {
                counts[lane] += ends[lane];
                has_end |= ends[lane];
            }
            // Two consecutive blocks with a line end each may have 254 bytes between them.
            may_have_long_line |= has_end == 0;
        }
        line_feeds += counts.iter().map(|count| u64::from(*count)).sum::<u64>();
    }
    let holds = |lanes: &[u8; LANES]| lanes.iter().any(|lane| *lane != 0);
    let count = |wanted: u8| memchr::memchr_iter(wanted, rest).count() as u64;
    Survey {
        line_feeds: line_feeds + count(b'\n'),
        is_ascii: any.iter().all(u8::is_ascii) && rest.is_ascii(),
        has_carriage_return: holds(&carriage_returns) || rest.contains(&b'\r'),
        has_asterisk: holds(&asterisks) || rest.contains(&b'*'),
        may_have_letters: any.iter().chain(rest).any(|byte| byte & 0x40 != 0),
        may_have_long_line,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn says_what_a_plain_search_says(bytes in prop::collection::vec(prop_oneof![
            20 => Just(b'1'), 2 => Just(b'\n'), 1 => Just(b'\r'), 1 => Just(b'*'), 1 => Just(b'-'), 1 => any::<u8>(),
        ], 0..2000)) {
            let found = Survey::of(&bytes);
            prop_assert_eq!(found.line_feeds, bytes.split(|byte| *byte == b'\n').count() as u64 - 1);
            prop_assert_eq!(found.is_ascii, bytes.is_ascii());
            prop_assert_eq!(found.has_carriage_return, bytes.contains(&b'\r'));
            prop_assert_eq!(found.has_asterisk, bytes.contains(&b'*'));
            let longest = bytes.split(|byte| *byte == b'\n').map(<[u8]>::len).max().unwrap_or(0);
            prop_assert!(found.may_have_letters || !bytes.iter().any(u8::is_ascii_alphabetic));
            prop_assert!(found.may_have_long_line || longest <= 254);
        }
    }

    #[test]
    fn a_long_line_is_never_missed() {
        for before in 0..300 {
            let mut bytes = b"1\n".repeat(before);
            bytes.extend(std::iter::repeat_n(b'7', 257));
            bytes.extend(b"\n1\n".repeat(100));
            assert!(Survey::of(&bytes).may_have_long_line, "{before}");
        }
    }
}
