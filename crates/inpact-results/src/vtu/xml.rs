//! A streaming parser for the subset of XML that VTK writes: elements with attributes, and text.

use crate::problem::{Place, Problem, shown};

pub(super) const CUT: &str = "the file is cut short: copy it again, or let its program end; the part before is read";
pub(super) const DAMAGED: &str = "the file is damaged here, or is no .vtu; the part before is read";

/// A start or end tag.
#[derive(Debug)]
pub(super) struct Tag<'a> {
    /// Its name; an end has `/` before it.
    pub(super) name: &'a [u8],
    attributes: &'a [u8],
    pub(super) at: usize,
    /// The element is empty: `<A/>`.
    pub(super) empty: bool,
}

impl Tag<'_> {
    /// The value of an attribute.
    pub(super) fn attribute(&self, name: &str) -> Option<String> {
        let mut rest = self.attributes;
        loop {
            rest = rest.trim_ascii_start();
            let equals = memchr::memchr(b'=', rest)?;
            let found = rest[..equals].trim_ascii();
            rest = rest[equals + 1..].trim_ascii_start();
            let quote = *rest.first().filter(|quote| matches!(quote, b'"' | b'\''))?;
            let end = memchr::memchr(quote, &rest[1..])? + 1;
            if found == name.as_bytes() {
                return Some(unescaped(&rest[1..end]));
            }
            rest = &rest[end + 1..];
        }
    }
}

/// Iterates over the tags of a file.
pub(super) struct Tags<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Tags<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// The next tag; none at the end of the file. Text before it, comments and declarations are skipped.
    pub(super) fn next(&mut self) -> Result<Option<Tag<'a>>, Problem> {
        loop {
            let Some(begin) = memchr::memchr(b'<', &self.bytes[self.at..]).map(|found| self.at + found) else {
                self.at = self.bytes.len();
                return Ok(None);
            };
            let rest = &self.bytes[begin..];
            let (skipped, end): (_, &[u8]) = match rest {
                _ if rest.starts_with(b"<!--") => (true, b"-->"),
                _ if rest.starts_with(b"<?") => (true, b"?>"),
                _ if rest.starts_with(b"<!") => (true, b">"),
                _ => (false, b">"),
            };
            let length = if skipped { memchr::memmem::find(rest, end) } else { end_of_tag(rest) };
            let Some(length) = length else {
                return Err(Problem::new(self.place(begin), "a tag has no end", CUT));
            };
            self.at = begin + length + end.len();
            if skipped {
                continue;
            }
            let inside = &rest[1..length];
            let (inside, empty) = match inside.strip_suffix(b"/") {
                Some(inside) => (inside, true),
                None => (inside, false),
            };
            let name = inside.iter().position(u8::is_ascii_whitespace).unwrap_or(inside.len());
            return Ok(Some(Tag { name: &inside[..name], attributes: &inside[name..], at: begin, empty }));
        }
    }

    /// The text up to the end of the element that was begun last.
    pub(super) fn text(&mut self, tag: &Tag<'_>) -> Result<(&'a [u8], usize), Problem> {
        if tag.empty {
            return Ok((b"", self.at));
        }
        let begin = self.at;
        match memchr::memchr(b'<', &self.bytes[begin..]) {
            Some(length) => {
                self.at = begin + length;
                Ok((&self.bytes[begin..begin + length], begin))
            }
            None => {
                let message = format!("the element `{}` has no end", shown(tag.name));
                Err(Problem::new(self.place(tag.at), message, CUT))
            }
        }
    }

    /// The place of a byte.
    pub(super) fn place(&self, at: usize) -> Place {
        let before = &self.bytes[..at.min(self.bytes.len())];
        Place { byte: before.len() as u64, line: memchr::memchr_iter(b'\n', before).count() as u64 + 1 }
    }

    pub(super) fn here(&self) -> Place {
        self.place(self.at)
    }
}

/// The first `>` outside of values.
fn end_of_tag(text: &[u8]) -> Option<usize> {
    let mut quote = None;
    text.iter().position(|byte| {
        match (quote, *byte) {
            (Some(open), byte) if byte == open => quote = None,
            (None, byte @ (b'"' | b'\'')) => quote = Some(byte),
            (None, b'>') => return true,
            _ => (),
        }
        false
    })
}

fn unescaped(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    if !text.contains('&') {
        return text.into_owned();
    }
    // The ampersand last, otherwise `&amp;lt;` would become `<`.
    [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")]
        .iter()
        .fold(text.into_owned(), |text, (escape, letter)| text.replace(escape, letter))
}
