//! Untrusted text made safe to display: the one place that escapes control and invisible characters.
//!
//! Decks, tables, JSON, TOML and the names of files may hold any character. A message quotes them, and an escape sequence in a
//! name must not move the cursor, nor an invisible character make two names look the same. Results are not changed: they are bytes.

use std::borrow::Cow;
use std::fmt::Write;

/// The text of a message, in which line ends and tabs stay: other invisible characters are written as `\u{1b}`.
pub fn visible(text: &str) -> Cow<'_, str> {
    escaped(
        text,
        |character| is_hidden(character) && !matches!(character, '\n' | '\t'),
        |out, character| {
            let _ = write!(out, "{}", character.escape_unicode());
        },
    )
}

/// The text of a message that is one line: line ends and tabs are escaped too.
pub fn visible_line(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden, |out, character| {
        let _ = match character {
            '\n' | '\r' | '\t' => write!(out, "{}", character.escape_default()),
            _ => write!(out, "{}", character.escape_unicode()),
        };
    })
}

/// JSON without invisible characters: `\u009b` has the same meaning to a JSON reader. Line ends and tabs between values stay.
pub fn visible_json(json: &str) -> Cow<'_, str> {
    escaped(
        json,
        |character| is_hidden(character) && !matches!(character, '\n' | '\t' | '\r'),
        |out, character| {
            for unit in character.encode_utf16(&mut [0; 2]) {
                let _ = write!(out, "\\u{unit:04x}");
            }
        },
    )
}

/// Whether a character is interpreted rather than shown: control characters, bidirectional marks, zero-width characters.
pub fn is_hidden(character: char) -> bool {
    character.is_control()
        || matches!(character,
            '\u{AD}' | '\u{34F}' | '\u{61C}' | '\u{115F}'..='\u{1160}' | '\u{17B4}'..='\u{17B5}' | '\u{180B}'..='\u{180F}'
            // Zero widths, marks, embeddings and overrides; separators of lines; invisible operators and isolates.
            | '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2060}'..='\u{206F}'
            | '\u{3164}' | '\u{FE00}'..='\u{FE0F}' | '\u{FEFF}' | '\u{FFA0}' | '\u{FFF0}'..='\u{FFFB}'
            | '\u{1BCA0}'..='\u{1BCA3}' | '\u{1D173}'..='\u{1D17A}' | '\u{E0000}'..='\u{E0FFF}')
}

fn escaped(text: &str, is_escaped: impl Fn(char) -> bool, escape: impl Fn(&mut String, char)) -> Cow<'_, str> {
    let Some(first) = text.find(&is_escaped) else { return Cow::Borrowed(text) };
    let mut out = text[..first].to_owned();
    for character in text[first..].chars() {
        if is_escaped(character) {
            escape(&mut out, character);
        } else {
            out.push(character);
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_written_out() {
        assert_eq!(visible("a\u{1b}[2J\u{9b}1m\u{7f}\r\0"), "a\\u{1b}[2J\\u{9b}1m\\u{7f}\\u{d}\\u{0}");
        assert_eq!(visible("two\n\tlines"), "two\n\tlines");
        assert_eq!(visible_line("two\n\tlines"), "two\\n\\tlines");
        assert!(matches!(visible("plain σ/θ · 温度"), Cow::Borrowed(_)));
    }

    #[test]
    fn what_the_eye_misses_is_written_out() {
        for hidden in ['\u{202e}', '\u{2066}', '\u{200b}', '\u{feff}', '\u{ad}', '\u{2028}', '\u{e0041}', '\u{61c}'] {
            assert_eq!(visible(&format!("A{hidden}B")), format!("A\\u{{{:x}}}B", u32::from(hidden)));
        }
    }

    #[test]
    fn json_stays_the_same_document() {
        let text = "x\u{9b}y\u{202e}z\u{e0041}\u{7f}";
        let json = format!("{{\n\t\"a\": {}\n}}", serde_json::Value::from(text));
        let shown = visible_json(&json);
        assert!(shown.chars().all(|character| !is_hidden(character) || matches!(character, '\n' | '\t')));
        assert_eq!(serde_json::from_str::<serde_json::Value>(&shown).expect("JSON")["a"], text);
    }
}
