//! Invisible and confusable characters: blanks, marks and dashes that a text editor inserts (S-01).

use inpact_parser::span::Span;
use std::ops::Range;

/// An invisible or confusable character.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Hidden {
    /// Its bytes in the text.
    pub(crate) range: Range<usize>,
    /// Its name and number.
    pub(crate) name: String,
    /// Its plain replacement.
    pub(crate) plain: &'static str,
}

impl Hidden {
    /// Its place, in a text with that span.
    pub(crate) fn span(&self, text: Span) -> Span {
        Span::new(text.source(), text.start() + self.range.start as u64, text.start() + self.range.end as u64)
    }

    /// The help of findings.
    pub(crate) fn help(&self) -> &'static str {
        match self.plain {
            "" => "take the character away",
            " " => "write a blank in its place",
            _ => "write `-` in its place",
        }
    }
}

/// The first such character of a text.
pub(crate) fn first(text: &[u8]) -> Option<Hidden> {
    all(text).next()
}

/// All such characters of a text, in order.
pub(crate) fn all(text: &[u8]) -> impl Iterator<Item = Hidden> {
    let mut at = 0;
    let characters = text.utf8_chunks().flat_map(move |chunk| {
        let start = at;
        at += chunk.valid().len() + chunk.invalid().len();
        chunk.valid().char_indices().map(move |(offset, character)| (start + offset, character)).collect::<Vec<_>>()
    });
    characters.filter_map(|(start, character)| {
        let (name, plain) = known(character)?;
        let name = format!("{name} (U+{:04X})", u32::from(character));
        Some(Hidden { range: start..start + character.len_utf8(), name, plain })
    })
}

/// The text with all such characters replaced.
pub(crate) fn plain(text: &[u8]) -> Vec<u8> {
    let mut result = Vec::with_capacity(text.len());
    let mut copied = 0;
    for hidden in all(text) {
        result.extend_from_slice(&text[copied..hidden.range.start]);
        result.extend_from_slice(hidden.plain.as_bytes());
        copied = hidden.range.end;
    }
    result.extend_from_slice(&text[copied..]);
    result
}

fn known(character: char) -> Option<(&'static str, &'static str)> {
    Some(match character {
        '\u{A0}' => ("a no-break space", " "),
        '\u{202F}' => ("a narrow no-break space", " "),
        '\u{2000}'..='\u{200A}' | '\u{3000}' => ("a space that is none of ASCII", " "),
        '\u{FEFF}' => ("a byte order mark", ""),
        '\u{200B}'..='\u{200D}' | '\u{2060}' => ("a character without width", ""),
        '\u{AD}' => ("a soft hyphen", ""),
        '\u{2212}' => ("a minus sign that is not `-`", "-"),
        '\u{2010}'..='\u{2015}' => ("a dash that is not `-`", "-"),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invisible_characters_are_found_among_any_bytes() {
        let text = b"a\xFF\xC2\xA0b\xE2\x88\x923";
        let found: Vec<_> = all(text).map(|hidden| (hidden.range, hidden.plain)).collect();
        assert_eq!(found, [(2..4, " "), (5..8, "-")]);
        assert_eq!(plain(text), b"a\xFF b-3");
        assert_eq!(first(b"plain"), None);
        assert_eq!(
            first("\u{FEFF}*STEP".as_bytes()).map(|hidden| hidden.name).as_deref(),
            Some("a byte order mark (U+FEFF)")
        );
    }
}
