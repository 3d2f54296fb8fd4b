//! Texts of options that are not interpreted, in compact form: a deck may have more of them than numbers.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// A reference-counted text: the name of a keyword or of a parameter.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SharedText(Arc<str>);

impl Deref for SharedText {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

impl std::borrow::Borrow<str> for SharedText {
    fn borrow(&self) -> &str {
        &self.0
    }
}

impl From<&str> for SharedText {
    fn from(text: &str) -> Self {
        Self(text.into())
    }
}

impl From<String> for SharedText {
    fn from(text: String) -> Self {
        Self(text.into())
    }
}

impl PartialEq<str> for SharedText {
    fn eq(&self, other: &str) -> bool {
        **self == *other
    }
}

impl PartialEq<&str> for SharedText {
    fn eq(&self, other: &&str) -> bool {
        **self == **other
    }
}

impl fmt::Display for SharedText {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl fmt::Debug for SharedText {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, formatter)
    }
}

/// Rows of items as written, in one allocation.
///
/// ```
/// use inpact_parser::model::TextRows;
///
/// let rows = TextRows::from_iter([vec!["0.1", "<a>"], vec![]]);
/// assert_eq!(rows.iter().collect::<Vec<_>>(), [vec!["0.1", "<a>"], vec![]]);
/// ```
#[derive(Clone, PartialEq, Eq, Default)]
pub struct TextRows {
    /// Each row is the number of its items, then the items; each item its length, then its bytes.
    encoded: Box<[u8]>,
}

impl TextRows {
    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.encoded.is_empty()
    }

    /// The items of each row.
    pub fn iter(&self) -> impl Iterator<Item = Vec<&str>> {
        let mut rest = &self.encoded[..];
        std::iter::from_fn(move || {
            let items = take_number(&mut rest)?;
            Some((0..items).filter_map(|_| take_item(&mut rest)).collect())
        })
    }
}

impl<S: AsRef<str>> FromIterator<Vec<S>> for TextRows {
    fn from_iter<I: IntoIterator<Item = Vec<S>>>(rows: I) -> Self {
        let mut encoded = Vec::new();
        for row in rows {
            push_number(&mut encoded, row.len());
            for item in row {
                push_number(&mut encoded, item.as_ref().len());
                encoded.extend_from_slice(item.as_ref().as_bytes());
            }
        }
        Self { encoded: encoded.into() }
    }
}

impl fmt::Debug for TextRows {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_list().entries(self.iter()).finish()
    }
}

/// Seven bits a byte, the lowest first; the eighth says that more follow.
fn push_number(encoded: &mut Vec<u8>, mut number: usize) {
    loop {
        let [lowest, ..] = number.to_le_bytes();
        number >>= 7;
        if number == 0 {
            return encoded.push(lowest & 0x7F);
        }
        encoded.push(lowest | 0x80);
    }
}

fn take_number(rest: &mut &[u8]) -> Option<usize> {
    let mut number = 0;
    for shift in (0..usize::BITS).step_by(7) {
        let (byte, further) = rest.split_first()?;
        *rest = further;
        number |= usize::from(byte & 0x7F) << shift;
        if *byte < 0x80 {
            break;
        }
    }
    Some(number)
}

fn take_item<'a>(rest: &mut &'a [u8]) -> Option<&'a str> {
    let length = take_number(rest)?;
    let (item, further) = rest.split_at_checked(length)?;
    *rest = further;
    std::str::from_utf8(item).ok()
}

#[cfg(test)]
mod tests {
    use super::{SharedText, TextRows};

    #[test]
    fn rows_of_any_length_come_back() {
        let item = |length: usize| "é".repeat(length);
        let rows: Vec<Vec<String>> = vec![
            vec![],
            vec![String::new(), String::new()],
            vec![item(63), item(64), item(8191), item(8192)],
            (0..300).map(|number| number.to_string()).collect(),
            vec![],
        ];
        let kept: TextRows = rows.iter().cloned().collect();
        assert_eq!(kept.iter().collect::<Vec<_>>(), rows);
        assert!(!kept.is_empty() && TextRows::default().is_empty());
        assert_eq!(format!("{kept:?}"), format!("{rows:?}"));
    }

    #[test]
    fn a_shared_text_compares_as_a_text() {
        let text = SharedText::from("USER");
        assert!(text == "USER" && text != *"USE" && format!("{text} {text:?}") == "USER \"USER\"");
    }
}
