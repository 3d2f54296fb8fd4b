//! Long messages, whose texts are never in memory as a whole: a deck of 100 MB arrives as one JSON string.
//!
//! The text around the long strings of a message is kept, with a placeholder for each; their characters are decoded as they
//! arrive and split into the pieces of a document.

use inpact_parser::deck::{EditedText, TextInParts};
use serde_json::Value;
use std::io::{self, BufRead, Read, Take};

/// The prefix of the placeholder of a long string; its number follows. NUL does not occur in messages.
const MARK: &str = "\u{0}long string ";

#[derive(Debug, Default)]
pub(super) struct LongMessage {
    /// The JSON, with a placeholder for each long string.
    pub(super) json: Vec<u8>,
    /// The long strings, in order.
    pub(super) texts: Vec<EditedText>,
}

/// Removes the long string of a placeholder.
pub(super) fn take(value: &mut Value, texts: &mut [EditedText]) -> Option<EditedText> {
    let number: usize = value.as_str()?.strip_prefix(MARK)?.parse().ok()?;
    let text = std::mem::take(texts.get_mut(number)?);
    *value = Value::String(String::new());
    Some(text)
}

/// Puts every long string back into its place.
pub(super) fn put_back(value: &mut Value, texts: &mut [EditedText]) {
    if let Some(text) = take(value, texts) {
        // It was checked to be UTF-8 on arrival.
        *value = Value::String(String::from_utf8(text.to_bytes()).unwrap_or_default());
        return;
    }
    match value {
        Value::Array(items) => {
            for item in items {
                put_back(item, texts);
            }
        }
        Value::Object(fields) => {
            for item in fields.values_mut() {
                put_back(item, texts);
            }
        }
        _ => {}
    }
}

/// Reasons why a long message is invalid.
#[derive(Debug)]
pub(super) enum Fault {
    /// The input ended or failed.
    Input(io::Error),
    /// A string that JSON does not allow; the rest of the message was skipped.
    Text(&'static str),
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        Self::Input(error)
    }
}

/// Reads a message of that many bytes; strings longer than `longest` are extracted.
pub(super) fn read(input: &mut impl BufRead, length: u64, longest: usize) -> Result<LongMessage, Fault> {
    let mut input = input.take(length);
    let mut message = LongMessage::default();
    let found = message.read(&mut input, longest);
    if matches!(found, Err(Fault::Text(_))) {
        io::copy(&mut input, &mut io::sink())?;
        if 0 < input.limit() {
            return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
        }
    }
    found.map(|()| message)
}

/// The available bytes of one message; none at its end.
fn available<R: BufRead>(input: &mut Take<R>) -> io::Result<&[u8]> {
    let is_over = input.limit() == 0;
    match input.fill_buf()? {
        [] if !is_over => Err(io::ErrorKind::UnexpectedEof.into()),
        bytes => Ok(bytes),
    }
}

impl LongMessage {
    fn read<R: BufRead>(&mut self, input: &mut Take<R>, longest: usize) -> Result<(), Fault> {
        loop {
            let bytes = available(input)?;
            if bytes.is_empty() {
                return Ok(());
            }
            let end = memchr::memchr(b'"', bytes).unwrap_or(bytes.len());
            let has_string = end < bytes.len();
            self.json.extend_from_slice(&bytes[..end]);
            input.consume(end);
            if has_string {
                input.consume(1);
                self.string(input, longest)?;
            }
        }
    }

    /// Reads a string whose quote has been read; a long one goes to the texts.
    fn string<R: BufRead>(&mut self, input: &mut Take<R>, longest: usize) -> Result<(), Fault> {
        let start = self.json.len();
        self.json.push(b'"');
        loop {
            let bytes = available(input)?;
            let Some(end) = memchr::memchr2(b'"', b'\\', bytes) else {
                if bytes.is_empty() {
                    return Ok(());
                }
                self.json.extend_from_slice(bytes);
                let count = bytes.len();
                input.consume(count);
                if longest < self.json.len() - start {
                    return self.long(input, start);
                }
                continue;
            };
            let is_end = bytes[end] == b'"';
            self.json.extend_from_slice(&bytes[..=end]);
            input.consume(end + 1);
            if is_end {
                return Ok(());
            }
            // An escaped quote is not the end.
            if let Some(byte) = available(input)?.first().copied() {
                self.json.push(byte);
                input.consume(1);
            }
            if longest < self.json.len() - start {
                return self.long(input, start);
            }
        }
    }

    /// Continues a long string; its part already in the JSON comes first.
    fn long<R: BufRead>(&mut self, input: &mut Take<R>, start: usize) -> Result<(), Fault> {
        let begun = self.json.split_off(start);
        let mark = format!("{MARK}{}", self.texts.len());
        self.json.extend_from_slice(Value::String(mark).to_string().as_bytes());
        let mut decoder = Decoder::default();
        decoder.push(&begun[1..])?;
        drop(begun);
        loop {
            let bytes = available(input)?;
            if bytes.is_empty() {
                return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
            }
            let used = decoder.push(bytes)?;
            input.consume(used.bytes);
            if used.is_end {
                self.texts.push(decoder.finish()?);
                return Ok(());
            }
        }
    }
}

/// Decodes the content of a JSON string incrementally.
#[derive(Debug, Default)]
struct Decoder {
    parts: TextInParts,
    /// An incomplete escape, including the backslash.
    escape: Vec<u8>,
    /// A high surrogate.
    high: Option<u32>,
    /// The bytes of an incomplete character.
    cut: Vec<u8>,
}

/// The part of some bytes that belongs to a string.
struct Used {
    bytes: usize,
    is_end: bool,
}

impl Decoder {
    /// Consumes bytes up to the end of the string.
    fn push(&mut self, bytes: &[u8]) -> Result<Used, Fault> {
        let mut at = 0;
        while at < bytes.len() {
            if !self.escape.is_empty() {
                self.escape.push(bytes[at]);
                at += 1;
                self.try_escape()?;
                continue;
            }
            let end = memchr::memchr2(b'"', b'\\', &bytes[at..]).map_or(bytes.len(), |found| at + found);
            if at < end {
                self.no_half()?;
                self.plain(&bytes[at..end])?;
            }
            at = end;
            match bytes.get(at) {
                Some(b'"') => return Ok(Used { bytes: at + 1, is_end: true }),
                Some(_) => {
                    self.whole_characters()?;
                    self.escape.push(b'\\');
                    at += 1;
                }
                None => {}
            }
        }
        Ok(Used { bytes: at, is_end: false })
    }

    /// Bytes without an escape.
    fn plain(&mut self, bytes: &[u8]) -> Result<(), Fault> {
        if bytes.iter().any(|byte| *byte < b' ') {
            return Err(Fault::Text("a control character stands in a string as it is"));
        }
        let joined;
        let bytes = if self.cut.is_empty() {
            bytes
        } else {
            joined = [&self.cut, bytes].concat();
            &joined
        };
        let whole = match std::str::from_utf8(bytes) {
            Ok(_) => bytes.len(),
            // A character may continue in the next bytes.
            Err(error) if error.error_len().is_none() => error.valid_up_to(),
            Err(_) => return Err(NOT_UTF8),
        };
        self.parts.push(&bytes[..whole]);
        self.cut = bytes[whole..].to_vec();
        Ok(())
    }

    fn whole_characters(&self) -> Result<(), Fault> {
        if self.cut.is_empty() { Ok(()) } else { Err(NOT_UTF8) }
    }

    fn no_half(&self) -> Result<(), Fault> {
        if self.high.is_none() { Ok(()) } else { Err(HALF) }
    }

    /// Adds the character of a complete escape.
    fn try_escape(&mut self) -> Result<(), Fault> {
        let character = match self.escape[..] {
            [_, b'u', a, b, c, d] => {
                let digits = [a, b, c, d];
                let digits = std::str::from_utf8(&digits)
                    .ok()
                    .filter(|digits| digits.bytes().all(|digit| digit.is_ascii_hexdigit()));
                let unit = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()).ok_or(ESCAPE)?;
                match (self.high.take(), unit) {
                    (None, 0xD800..=0xDBFF) => {
                        self.high = Some(unit);
                        self.escape.clear();
                        return Ok(());
                    }
                    (Some(high), 0xDC00..=0xDFFF) => {
                        char::from_u32(0x1_0000 + ((high - 0xD800) << 10) + (unit - 0xDC00))
                    }
                    (None, _) => char::from_u32(unit),
                    (Some(_), _) => None,
                }
                .ok_or(HALF)?
            }
            [_, b'u', ..] => return Ok(()),
            [_, letter] => {
                self.no_half()?;
                match letter {
                    b'n' => '\n',
                    b'r' => '\r',
                    b't' => '\t',
                    b'b' => '\u{8}',
                    b'f' => '\u{c}',
                    b'"' | b'\\' | b'/' => char::from(letter),
                    _ => return Err(ESCAPE),
                }
            }
            _ => return Ok(()),
        };
        self.escape.clear();
        self.parts.push(character.encode_utf8(&mut [0; 4]).as_bytes());
        Ok(())
    }

    fn finish(self) -> Result<EditedText, Fault> {
        self.no_half()?;
        self.whole_characters()?;
        Ok(self.parts.finish())
    }
}

const NOT_UTF8: Fault = Fault::Text("a string is no UTF-8");
const HALF: Fault = Fault::Text("half of a character stands alone");
const ESCAPE: Fault = Fault::Text("a backslash has nothing after it that JSON knows");

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use std::io::BufReader;

    /// The message with its long strings put back, whatever the size of the pieces that the input comes in.
    fn whole(json: &str, longest: usize, capacity: usize) -> Result<Value, Fault> {
        let mut input = BufReader::with_capacity(capacity, json.as_bytes());
        let message = read(&mut input, json.len() as u64, longest)?;
        let mut value: Value = serde_json::from_slice(&message.json).expect("JSON");
        let mut texts = message.texts;
        put_back(&mut value, &mut texts);
        Ok(value)
    }

    #[test]
    fn a_message_is_what_it_is_in_one_piece() {
        let texts = [
            "",
            "1, 2.\n3, 4.\r\n",
            "\"quoted\" and \\",
            "é😀\u{1}\u{7f}𝄞",
            "a text of several words, with é at an end é",
        ];
        let message = json!({"a": 1, "b": {"c": texts[1], "f": texts[3]}, "d": texts, "e": [true, null]});
        for json in [message.to_string(), serde_json::to_string_pretty(&message).expect("text")] {
            // The threshold of long texts; the names here have two bytes with their quote.
            for longest in 3..50 {
                for capacity in 1..30 {
                    let found = whole(&json, longest, capacity).expect("a message");
                    assert_eq!(found, message, "{longest} {capacity}");
                }
            }
        }
    }

    #[test]
    fn escapes() {
        let message = r#"{"text": "\u00e9\ud83d\ude00\n\/\\\"\b\f\r\t"}"#;
        for capacity in 1..20 {
            let expected = json!({"text": "é😀\n/\\\"\u{8}\u{c}\r\t"});
            assert_eq!(whole(message, 6, capacity).unwrap(), expected);
        }
    }

    #[test]
    fn what_json_does_not_allow_is_passed_over() {
        for wrong in [r"\x", r"\ud83d", r"\ud83dx", r"\ude00", r"\u12g4"] {
            let message = format!(r#"{{"text": "{wrong}"}}"#);
            let all = message.clone() + "next";
            let mut input = all.as_bytes();
            let found = read(&mut input, message.len() as u64, 0);
            assert!(matches!(found, Err(Fault::Text(_))), "{wrong}: {found:?}");
            assert_eq!(input, b"next", "{wrong}");
        }
        let control = whole("[\"a long text with \u{1} in it\"]", 4, 4);
        assert!(matches!(control, Err(Fault::Text(_))), "{control:?}");
        assert!(matches!(read(&mut &b"{\"a\": \"b"[..], 99, 0), Err(Fault::Input(_))));
    }
}
