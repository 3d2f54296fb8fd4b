//! Physical lines: line ends, and the classification as comment, keyword line or data (S-02 to S-05).
//!
//! Works on bytes alone; an LF, a CR LF and a lone CR each end a line.

use memchr::{memchr, memchr_iter, memchr2};

/// Kinds of lines (S-03).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineKind {
    /// `*` in columns 1 and 2 (S-04).
    Comment,
    /// `**` after blanks: formally a keyword line, intended as a comment (S-04); treated as a comment.
    IndentedComment,
    /// The first character that is not a blank is `*` (S-05).
    Keyword,
    /// Nothing but blanks (S-08).
    Blank,
    /// Anything else.
    Data,
}

/// The kind of `line`, with or without its line end.
pub fn line_kind(line: &[u8]) -> LineKind {
    let content = line.trim_ascii_start();
    match content {
        [] => LineKind::Blank,
        [b'*', b'*', ..] if content.len() == line.len() => LineKind::Comment,
        [b'*', b'*', ..] => LineKind::IndentedComment,
        [b'*', ..] => LineKind::Keyword,
        _ => LineKind::Data,
    }
}

/// Whether a line is a comment, indented or not.
pub fn is_comment(line: &[u8]) -> bool {
    matches!(line_kind(line), LineKind::Comment | LineKind::IndentedComment)
}

/// The offset after the line end of the line that begins at `from`, or the length of `bytes` for an unfinished line.
pub fn next_line(bytes: &[u8], from: usize) -> usize {
    match memchr2(b'\n', b'\r', &bytes[from..]) {
        None => bytes.len(),
        Some(found) => {
            let end = from + found;
            if bytes[end] == b'\r' && bytes.get(end + 1) == Some(&b'\n') { end + 2 } else { end + 1 }
        }
    }
}

/// The line without its line end.
pub fn without_line_end(line: &[u8]) -> &[u8] {
    match line {
        [content @ .., b'\r', b'\n'] | [content @ .., b'\n' | b'\r'] => content,
        _ => line,
    }
}

/// The physical lines of `bytes`, each with its line end, as ranges.
pub fn lines(bytes: &[u8]) -> impl Iterator<Item = std::ops::Range<usize>> {
    let mut from = 0;
    std::iter::from_fn(move || {
        if from == bytes.len() {
            return None;
        }
        let start = from;
        from = next_line(bytes, from);
        Some(start..from)
    })
}

/// The number of line ends in `bytes`; a CR at the very end counts, so callers must not split a CR LF.
pub fn count_line_ends(bytes: &[u8]) -> u64 {
    let line_feeds = memchr_iter(b'\n', bytes).count();
    (line_feeds + lone_carriage_returns(bytes)) as u64
}

/// The number of CRs without an LF after them; almost always zero, counted with `memchr`.
fn lone_carriage_returns(bytes: &[u8]) -> usize {
    let Some(first) = memchr(b'\r', bytes) else { return 0 };
    let rest = &bytes[first..];
    // Branchless so that it is vectorised: a file with CR LF ends has a CR in every line.
    let is_lone = |(first, second): (&u8, &u8)| usize::from(*first == b'\r') & usize::from(*second != b'\n');
    let inner: usize = rest.iter().zip(&rest[1..]).map(is_lone).sum();
    inner + usize::from(rest.last() == Some(&b'\r'))
}

/// The start of the next line of kind [`LineKind::Keyword`] at or after `from`, which must be the start of a line.
///
/// Searches for asterisks only, so that megabytes of mesh rows cost one `memchr`.
/// The comments on the way are passed to `comment`, as the start of their line and the position of their first asterisk.
pub fn find_keyword_line(bytes: &[u8], from: usize, mut comment: impl FnMut(usize, usize)) -> Option<usize> {
    let mut at = from;
    while let Some(found) = memchr(b'*', &bytes[at..]) {
        let star = at + found;
        if let Some(start) = line_start_before(bytes, from, star) {
            if bytes.get(star + 1) != Some(&b'*') {
                return Some(start);
            }
            // A comment: nothing in the rest of its line matters.
            comment(start, star);
            at = next_line(bytes, star);
        } else {
            at = star + 1;
        }
    }
    None
}

/// The start of the line of `at` if there are only blanks before `at`.
fn line_start_before(bytes: &[u8], from: usize, at: usize) -> Option<usize> {
    let mut start = at;
    while start > from {
        match bytes[start - 1] {
            b'\n' | b'\r' => return Some(start),
            byte if byte.is_ascii_whitespace() => start -= 1,
            _ => return None,
        }
    }
    Some(start)
}

/// The first line of `bytes` that is longer than `limit` bytes (line end not counted, trailing blanks counted).
///
/// Jumps from line end to line end in strides of `limit`, so that short lines cost almost nothing.
pub fn find_long_line(bytes: &[u8], from: usize, limit: usize) -> Option<std::ops::Range<usize>> {
    let mut start = from;
    while bytes.len() - start > limit {
        // A line of `limit` bytes has its line end within the next `limit + 1`.
        let window = &bytes[start..=start + limit];
        match memchr::memrchr2(b'\n', b'\r', window) {
            Some(last) => start += last + 1,
            None => return Some(start..next_line(bytes, start)),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_03_comments_and_keywords() {
        assert_eq!(line_kind(b"** *GAP CONDUCTANCE"), LineKind::Comment);
        assert_eq!(line_kind(b" *GAP CONDUCTANCE"), LineKind::Keyword);
        assert_eq!(line_kind(b"***X"), LineKind::Comment);
        assert_eq!(line_kind(b"  ** x"), LineKind::IndentedComment);
        assert_eq!(line_kind(b" \t\r\n"), LineKind::Blank);
        assert_eq!(line_kind(b"1, 2"), LineKind::Data);
    }

    #[test]
    fn all_three_line_ends() {
        let bytes = b"a\nb\r\nc\rd";
        let found: Vec<&[u8]> = lines(bytes).map(|range| &bytes[range]).collect();
        assert_eq!(found, [&b"a\n"[..], b"b\r\n", b"c\r", b"d"]);
        assert_eq!(count_line_ends(bytes), 3);
        assert_eq!(count_line_ends(b"a\r\r\n\r"), 3);
    }

    #[test]
    fn keyword_lines_are_found_after_rows_and_comments() {
        let bytes = b"1, 2*3\n** *NODE\n  ** x\n\t *STEP\n";
        assert_eq!(find_keyword_line(bytes, 0, |_, _| {}), Some(23));
        assert_eq!(find_keyword_line(b"1,2\n3,4\n", 0, |_, _| {}), None);
        assert_eq!(find_keyword_line(b"*A\n", 0, |_, _| {}), Some(0));
        assert_eq!(find_keyword_line(b"1\r*A\r", 0, |_, _| {}), Some(2));
    }

    #[test]
    fn long_lines_are_found_exactly() {
        let fits = [vec![b'x'; 256], b"\n".to_vec()].concat();
        let long = [vec![b'y'; 257], b"\n".to_vec()].concat();
        let text = [fits.clone(), fits.clone(), long, fits.clone()].concat();
        assert_eq!(find_long_line(&text, 0, 256), Some(514..772));
        assert_eq!(find_long_line(&fits, 0, 256), None);
        assert_eq!(find_long_line(&vec![b'z'; 257], 0, 256), Some(0..257));
        assert_eq!(find_long_line(&vec![b'z'; 256], 0, 256), None);
    }
}
