//! Places in the source files of a deck: spans of bytes, lines and columns.
//!
//! Independent of keywords and values.

use std::cmp::Ordering;
use std::fmt;
use std::num::NonZeroU32;
use std::ops::Range;

/// One of the deck's files; the deck itself is [`SourceId::ROOT`], included files follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct SourceId(pub u32);

impl SourceId {
    /// The deck itself; every other source was included by it.
    pub const ROOT: Self = Self(0);
}

/// A half-open range of bytes `start..end` in one source file.
///
/// Spans are numerous, so one takes sixteen bytes, as does an optional one:
/// offsets and lengths have 48 bits, which is 256 TiB, and there are 2³² − 2 sources.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Span {
    /// The number of the source, from 1.
    source: NonZeroU32,
    start_high: u16,
    length_high: u16,
    start_low: u32,
    length_low: u32,
}

impl Span {
    /// The bytes `start..end` of `source`; empty at `start` where `end` is less. Offsets saturate at 2⁴⁸.
    pub const fn new(source: SourceId, start: u64, end: u64) -> Self {
        const MOST: u64 = (1 << 48) - 1;
        let start = if start < MOST { start } else { MOST };
        let length = end.saturating_sub(start);
        let length = if length < MOST { length } else { MOST };
        let [s0, s1, s2, s3, s4, s5, ..] = start.to_le_bytes();
        let [l0, l1, l2, l3, l4, l5, ..] = length.to_le_bytes();
        Self {
            source: NonZeroU32::MIN.saturating_add(source.0),
            start_high: u16::from_le_bytes([s4, s5]),
            length_high: u16::from_le_bytes([l4, l5]),
            start_low: u32::from_le_bytes([s0, s1, s2, s3]),
            length_low: u32::from_le_bytes([l0, l1, l2, l3]),
        }
    }

    /// The file.
    pub const fn source(self) -> SourceId {
        SourceId(self.source.get() - 1)
    }

    /// Offset of the first byte.
    pub const fn start(self) -> u64 {
        joined(self.start_high, self.start_low)
    }

    /// Offset after the last byte.
    pub const fn end(self) -> u64 {
        self.start() + self.len()
    }

    /// The number of bytes.
    pub const fn len(self) -> u64 {
        joined(self.length_high, self.length_low)
    }

    /// Whether the span is empty; it still marks a place.
    pub const fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// The smallest span that covers both; both must lie in one file.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self::new(self.source(), self.start().min(other.start()), self.end().max(other.end()))
    }

    /// A part of the span, by the places of its bytes in it.
    #[must_use]
    pub fn part(self, range: Range<usize>) -> Self {
        Self::new(self.source(), self.start() + range.start as u64, self.start() + range.end as u64)
    }

    /// Whether the spans have a byte or an end in common.
    pub fn touches(self, other: Self) -> bool {
        self.source == other.source && self.start() <= other.end() && other.start() <= self.end()
    }

    /// Whether `other` lies entirely inside this span.
    pub fn contains(self, other: Self) -> bool {
        self.source == other.source && self.start() <= other.start() && other.end() <= self.end()
    }
}

/// 48 bits of their upper and lower parts.
const fn joined(high: u16, low: u32) -> u64 {
    let [h0, h1] = high.to_le_bytes();
    let [l0, l1, l2, l3] = low.to_le_bytes();
    u64::from_le_bytes([l0, l1, l2, l3, h0, h1, 0, 0])
}

impl Default for Span {
    fn default() -> Self {
        Self::new(SourceId::ROOT, 0, 0)
    }
}

impl fmt::Debug for Span {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}..{}", self.source().0, self.start(), self.end())
    }
}

impl PartialOrd for Span {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// By file, then by start, then by end.
impl Ord for Span {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |span: &Self| (span.source, span.start(), span.len());
        key(self).cmp(&key(other))
    }
}

/// A place for display: line and column, both counted from 1.
///
/// Columns count characters, so that the number agrees with an editor's for UTF-8 text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1.
    pub line: u64,
    /// Column, from 1.
    pub column: u64,
}

#[cfg(test)]
mod tests {
    use super::{SourceId, Span};

    #[test]
    fn a_span_takes_sixteen_bytes_and_an_optional_one_no_more() {
        assert_eq!((size_of::<Span>(), size_of::<Option<Span>>()), (16, 16));
    }

    #[test]
    fn offsets_beyond_four_gigabytes_come_back() {
        let far = (1_u64 << 48) - 1;
        for (source, start, end) in
            [(0, 0, 0), (3, 1, 1 << 32), (7, (1 << 40) + 5, (1 << 41) + 9), (u32::MAX - 1, far - 1, far), (1, 0, far)]
        {
            let span = Span::new(SourceId(source), start, end);
            assert_eq!((span.source().0, span.start(), span.end(), span.len()), (source, start, end, end - start));
        }
        assert_eq!(Span::new(SourceId(0), 5, 3), Span::new(SourceId(0), 5, 5));
    }

    #[test]
    fn spans_are_ordered_by_file_and_start_and_end() {
        let mut spans = [(1, 0, 1), (0, 1 << 33, (1 << 33) + 1), (0, 2, 9), (0, 2, 3), (0, 1 << 20, 1 << 34)]
            .map(|(source, start, end)| Span::new(SourceId(source), start, end));
        spans.sort_unstable();
        let sorted: Vec<_> = spans.iter().map(|span| (span.source().0, span.start(), span.end())).collect();
        assert_eq!(sorted, [(0, 2, 3), (0, 2, 9), (0, 1 << 20, 1 << 34), (0, 1 << 33, (1 << 33) + 1), (1, 0, 1)]);
    }
}
