//! The bytes of one source file that the scan kept, looked up by their offset in the file.
//!
//! A deck is mostly mesh, whose text is not needed: the store holds ranges of a file, not the whole file.

use std::ops::Range;

use super::ends::{RowEnds, Thinned};
use super::lines::count_line_ends;
use crate::span::{Position, Span};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// One source file: its name, its size, and the ranges of it that were kept.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Source {
    name: String,
    pub(super) length: u64,
    /// The *INCLUDE that named it.
    pub(super) included_by: Option<Span>,
    pub(super) excerpts: Excerpts,
    stretches: Vec<Stretch>,
    /// The kept bytes, range by range.
    bytes: Vec<u8>,
    /// The tables of which only ends of groups were kept, in the order of the file.
    ends: Vec<RowEnds>,
    looks: Looks,
}

/// Records of accesses to the bytes.
#[derive(Debug, Default)]
struct Looks {
    /// Dropped rows were accessed.
    have_missed: AtomicBool,
    /// The range of the last access: the next one is mostly there or in the following range.
    last: AtomicUsize,
}

impl Clone for Looks {
    fn clone(&self) -> Self {
        let (have_missed, last) = (self.have_missed.load(Ordering::Relaxed), self.last.load(Ordering::Relaxed));
        Self { have_missed: have_missed.into(), last: last.into() }
    }
}

impl PartialEq for Looks {
    /// Access records do not affect equality.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Whether the lines of a source file may be quoted around findings in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Excerpts {
    /// They may.
    #[default]
    Shown,
    /// They may not: the deck names a file outside of its folder.
    Withheld,
}

/// A run of kept bytes without a gap.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Stretch {
    /// Offset in the file.
    start: u64,
    /// Offset in [`Source::bytes`].
    kept_at: usize,
    /// Number of the line that `start` lies in, from 1; `start` is the first byte of it.
    first_line: u64,
    /// The bytes at its beginning and at its end that are parts of dropped rows, kept for excerpts of neighbouring lines.
    lost_before: u32,
    lost_after: u32,
}

impl Source {
    /// An empty source of that name.
    pub(super) fn new(name: &str) -> Self {
        Self { name: name.to_owned(), ..Self::default() }
    }

    /// Its name: a path, or `-` for standard input.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The size of the whole file in bytes.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The keyword line of the *INCLUDE that named it; `None` for the deck itself.
    pub fn included_by(&self) -> Option<Span> {
        self.included_by
    }

    /// Whether diagnostics may quote its lines.
    pub fn excerpts(&self) -> Excerpts {
        self.excerpts
    }

    /// Whether every byte of the file was kept.
    pub fn is_complete(&self) -> bool {
        self.bytes.len() as u64 == self.length
    }

    /// Keeps `bytes`, which begin at `start` in the file, at the beginning of line `first_line`.
    ///
    /// Ranges come in ascending order; bytes already kept are not kept twice.
    pub(super) fn keep(&mut self, start: u64, first_line: u64, bytes: &[u8]) {
        let end_of_last = self.end_of_last_stretch();
        if bytes.is_empty() || end_of_last.is_some_and(|end| start < end) {
            return;
        }
        if end_of_last != Some(start) {
            self.stretches.push(Stretch {
                start,
                kept_at: self.bytes.len(),
                first_line,
                lost_before: 0,
                lost_after: 0,
            });
        }
        self.bytes.extend_from_slice(bytes);
    }

    /// The bytes from `start` on, if they are kept up to the end of the scanned part.
    pub(super) fn kept_from(&self, start: u64) -> Option<&[u8]> {
        let last = self.stretches.last()?;
        let at = last.kept_at + usize::try_from(start.checked_sub(last.start)?).ok()?;
        self.bytes.get(at..)
    }

    /// Drops rows of a table from the bytes of [`kept_from`](Self::kept_from); `next_line` is the number of the line after all.
    pub(super) fn thin(&mut self, Thinned { lost, dropped, ends }: Thinned, next_line: u64) {
        let as_u32 = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
        let (start, end) = (ends.block.start(), ends.block.end());
        let length = usize::try_from(end - start).unwrap_or(usize::MAX);
        let Some(rows_at) = self.bytes.len().checked_sub(length) else { return };
        let after = self.bytes[rows_at + dropped.end..].to_vec();
        self.bytes.truncate(rows_at + dropped.start);
        if let Some(before) = self.stretches.last_mut() {
            before.lost_after = as_u32(dropped.start - lost.start);
        }
        self.stretches.push(Stretch {
            start: start + dropped.end as u64,
            kept_at: self.bytes.len(),
            first_line: next_line - count_line_ends(&after),
            lost_before: as_u32(lost.end - dropped.end),
            lost_after: 0,
        });
        self.bytes.extend_from_slice(&after);
        self.ends.push(ends);
    }

    /// The ends of the groups of the table with those rows.
    pub(super) fn ends_of(&self, rows: Span) -> Option<&RowEnds> {
        let found = self.ends.binary_search_by_key(&rows.start(), |ends| ends.block.start()).ok()?;
        Some(&self.ends[found])
    }

    /// Records an access to dropped rows.
    pub(super) fn miss(&self) {
        self.looks.have_missed.store(true, Ordering::Relaxed);
    }

    /// Whether dropped rows were accessed.
    pub(super) fn have_missed(&self) -> bool {
        self.looks.have_missed.load(Ordering::Relaxed)
    }

    /// The kept bytes at the beginning of `range`; empty when the scan kept none of them.
    pub(super) fn text(&self, range: Range<u64>) -> &[u8] {
        self.look(&range);
        self.kept(range)
    }

    /// Records an access to dropped rows.
    fn look(&self, range: &Range<u64>) {
        let Some(index) = self.index_at(range.start) else { return };
        let stretch = &self.stretches[index];
        let length = (self.end_of(index) - stretch.kept_at) as u64;
        let is_before = range.start < stretch.start + u64::from(stretch.lost_before);
        let sound_end = stretch.start + length - u64::from(stretch.lost_after);
        if is_before || (0 < stretch.lost_after && sound_end < range.end.max(range.start + 1)) {
            self.miss();
        }
    }

    /// The same as [`text`](Self::text), without recording accesses.
    fn kept(&self, range: Range<u64>) -> &[u8] {
        let Some((stretch, kept)) = self.stretch_at(range.start) else { return &[] };
        let kept_range =
            range.start - stretch.start..(range.end.max(range.start) - stretch.start).min(kept.len() as u64);
        let as_index = |offset| usize::try_from(offset).unwrap_or(usize::MAX);
        kept.get(as_index(kept_range.start)..as_index(kept_range.end)).unwrap_or(&[])
    }

    /// The kept bytes around the start of `range` without a gap, and where they begin in the file.
    pub(super) fn surroundings(&self, range: Range<u64>) -> (u64, &[u8]) {
        self.look(&range);
        self.stretch_at(range.start).map_or((range.start, &[]), |(stretch, kept)| (stretch.start, kept))
    }

    /// Line and column of every offset in `offsets`, which must be ascending; one pass over the kept bytes.
    ///
    /// An offset in bytes that were not kept gets the line reached so far.
    pub(super) fn positions(&self, offsets: &[u64]) -> Vec<Position> {
        let mut sweep = Sweep { offset: 0, line: 1, line_start: 0 };
        let position = |offset: &u64| {
            self.look(&(*offset..*offset));
            self.advance(&mut sweep, *offset)
        };
        offsets.iter().map(position).collect()
    }

    fn advance(&self, sweep: &mut Sweep, offset: u64) -> Position {
        let Some((stretch, _)) = self.stretch_at(offset) else {
            return Position { line: sweep.line, column: 1 };
        };
        if sweep.offset < stretch.start || (sweep.offset == 0 && stretch.start == 0) {
            *sweep = Sweep { offset: stretch.start, line: stretch.first_line, line_start: stretch.start };
        }
        let passed = self.kept(sweep.offset..offset);
        sweep.line += count_line_ends(passed);
        if let Some(last) = passed.iter().rposition(|byte| matches!(byte, b'\n' | b'\r')) {
            sweep.line_start = sweep.offset + last as u64 + 1;
        }
        sweep.offset = sweep.offset.max(offset);
        let column = self.kept(sweep.line_start..offset).iter().filter(|byte| **byte & 0xC0 != 0x80).count();
        Position { line: sweep.line, column: column as u64 + 1 }
    }

    /// The range that contains `offset`, or ends there, and its bytes.
    fn stretch_at(&self, offset: u64) -> Option<(&Stretch, &[u8])> {
        let index = self.index_at(offset)?;
        let stretch = &self.stretches[index];
        let kept = &self.bytes[stretch.kept_at..self.end_of(index)];
        (offset - stretch.start <= kept.len() as u64).then_some((stretch, kept))
    }

    /// The last range that begins at `offset` or before.
    fn index_at(&self, offset: u64) -> Option<usize> {
        let begins = |index: usize| self.stretches.get(index).is_some_and(|stretch| stretch.start <= offset);
        let last = self.looks.last.load(Ordering::Relaxed);
        let near = (last..last + 2).find(|index| begins(*index) && !begins(index + 1));
        if near.is_some() {
            return near;
        }
        let index = self.stretches.partition_point(|stretch| stretch.start <= offset).checked_sub(1)?;
        self.looks.last.store(index, Ordering::Relaxed);
        Some(index)
    }

    /// The end of the bytes of a range.
    fn end_of(&self, index: usize) -> usize {
        self.stretches.get(index + 1).map_or(self.bytes.len(), |next| next.kept_at)
    }

    /// The number of bytes that are kept.
    #[cfg(test)]
    pub(super) fn kept_bytes(&self) -> usize {
        self.bytes.len()
    }

    fn end_of_last_stretch(&self) -> Option<u64> {
        let last = self.stretches.last()?;
        Some(last.start + (self.bytes.len() - last.kept_at) as u64)
    }
}

/// State of a pass over ascending offsets.
struct Sweep {
    offset: u64,
    line: u64,
    line_start: u64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_found_in_each_stretch() {
        let mut source = Source::new("x");
        source.keep(0, 1, b"*A\nb c\n");
        source.keep(100, 10, b"*D\r\n e\n");
        source.length = 200;
        let found = source.positions(&[0, 3, 5, 100, 105, 106]);
        let pairs: Vec<_> = found.iter().map(|position| (position.line, position.column)).collect();
        assert_eq!(pairs, [(1, 1), (2, 1), (2, 3), (10, 1), (11, 2), (11, 3)]);
        assert_eq!(source.text(100..102), b"*D");
        assert_eq!(source.text(50..52), b"");
        assert!(!source.is_complete());
    }
}
