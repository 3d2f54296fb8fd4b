//! Changes that know what they change: values, keys and ends of JSON, TOML and CSV.
//!
//! Every value is replaced by others that a reader may trip over, every key is written twice, and the file ends after each of its bytes.

use std::ops::Range;

/// Formats of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// JSON.
    Json,
    /// TOML.
    Toml,
    /// Rows of cells.
    Csv,
}

/// Kinds of changes, in the order of the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Nested,
    HugeNumber,
    WrongType,
    LongText,
    ControlCharacter,
    NotUtf8,
    Nul,
    KeyTwice,
    CutShort,
}

impl Kind {
    pub(super) const ALL: [Self; 9] = [
        Self::Nested,
        Self::HugeNumber,
        Self::WrongType,
        Self::LongText,
        Self::ControlCharacter,
        Self::NotUtf8,
        Self::Nul,
        Self::KeyTwice,
        Self::CutShort,
    ];

    /// Its name on the page.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Nested => "a value nested 100,000 deep",
            Self::HugeNumber => "a number beyond any range, or of 100,000 digits",
            Self::WrongType => "a value of another type",
            Self::LongText => "a text of 4 MiB",
            Self::ControlCharacter => "control characters in a text",
            Self::NotUtf8 => "bytes that are not UTF-8",
            Self::Nul => "the character NUL",
            Self::KeyTwice => "a key, a heading or a column twice",
            Self::CutShort => "cut short after any of its bytes",
        }
    }

    /// Whether a file with such a change must not be accepted.
    pub(super) fn is_always_wrong(self, form: Form) -> bool {
        match (self, form) {
            (Self::Nested | Self::NotUtf8 | Self::Nul | Self::KeyTwice, Form::Json | Form::Toml)
            | (Self::CutShort, Form::Json) => true,
            // A table of nodes may hold a name of any bytes, and end after any row.
            _ => false,
        }
    }
}

/// A file with one change.
#[derive(Debug)]
pub(super) struct Changed {
    pub(super) kind: Kind,
    pub(super) bytes: Vec<u8>,
}

/// The number of changes of a sample.
pub(super) fn count(form: Form, sample: &[u8]) -> usize {
    let (values, entries) = (values(form, sample).len(), entries(form, sample).len());
    values * replacements(form) + entries + sample.trim_ascii_end().len()
}

/// Change number `index` of a sample, below [`count`].
pub(super) fn changed(form: Form, sample: &[u8], index: usize) -> Changed {
    let places = values(form, sample);
    let of_values = places.len() * replacements(form);
    if index < of_values {
        let (kind, text) = replacement(form, index % replacements(form));
        let place = places[index / replacements(form)].clone();
        return Changed { kind, bytes: [&sample[..place.start], &text, &sample[place.end..]].concat() };
    }
    let entries = entries(form, sample);
    if let Some(entry) = entries.get(index - of_values) {
        let bytes = [&sample[..entry.end], &sample[entry.clone()], &sample[entry.end..]].concat();
        return Changed { kind: Kind::KeyTwice, bytes };
    }
    let end = index - of_values - entries.len();
    Changed { kind: Kind::CutShort, bytes: sample[..end].to_vec() }
}

fn replacements(form: Form) -> usize {
    texts(form).len() + LARGE.len()
}

/// What is made when it is needed.
const LARGE: [Kind; 3] = [Kind::Nested, Kind::LongText, Kind::HugeNumber];

/// What takes the place of a value.
fn replacement(form: Form, index: usize) -> (Kind, Vec<u8>) {
    let texts = texts(form);
    if let Some((kind, text)) = texts.get(index) {
        return (*kind, text.to_vec());
    }
    let kind = LARGE[index - texts.len()];
    let text = match (kind, form) {
        (Kind::Nested, Form::Json) => [b"[".repeat(50_000), b"{\"a\":".repeat(50_000)].concat(),
        (Kind::Nested, Form::Toml) => [b"[".repeat(50_000), b"{a=".repeat(50_000)].concat(),
        (Kind::Nested, Form::Csv) => b"\"\"".repeat(50_000),
        (Kind::LongText, Form::Json | Form::Toml) => [b"\"".to_vec(), b"x".repeat(4 << 20), b"\"".to_vec()].concat(),
        (Kind::LongText, Form::Csv) => b"x".repeat(4 << 20),
        _ => b"9".repeat(100_000),
    };
    (kind, text)
}

fn texts(form: Form) -> &'static [(Kind, &'static [u8])] {
    match form {
        Form::Json => &[
            (Kind::HugeNumber, b"1e400"),
            (Kind::HugeNumber, b"-1e-400"),
            (Kind::HugeNumber, b"18446744073709551616"),
            (Kind::WrongType, b"true"),
            (Kind::WrongType, b"null"),
            (Kind::WrongType, b"{}"),
            (Kind::WrongType, b"[[]]"),
            (Kind::WrongType, b"-7.5"),
            (Kind::WrongType, b"\"\""),
            (Kind::ControlCharacter, b"\"a\\u001b[2J\\u202e\\u0000\\r\\n*STEP\""),
            (Kind::NotUtf8, b"\"\xFF\xFE\""),
            (Kind::Nul, b"\"\0\""),
        ],
        Form::Toml => &[
            (Kind::HugeNumber, b"1e400"),
            (Kind::HugeNumber, b"-inf"),
            (Kind::HugeNumber, b"nan"),
            (Kind::HugeNumber, b"9223372036854775808"),
            (Kind::WrongType, b"true"),
            (Kind::WrongType, b"1979-05-27T07:32:00Z"),
            (Kind::WrongType, b"{}"),
            (Kind::WrongType, b"[[]]"),
            (Kind::WrongType, b"-7.5"),
            (Kind::WrongType, b"\"\""),
            (Kind::ControlCharacter, b"\"a\\u001b[2J\\u202e\\u0000\\r\\n\""),
            (Kind::NotUtf8, b"\"\xFF\xFE\""),
            (Kind::Nul, b"\"\0\""),
        ],
        Form::Csv => &[
            (Kind::HugeNumber, b"1e400"),
            (Kind::HugeNumber, b"-inf"),
            (Kind::HugeNumber, b"nan"),
            (Kind::HugeNumber, b"1e99999999999999999999"),
            (Kind::WrongType, b"x"),
            (Kind::WrongType, b""),
            (Kind::WrongType, b"\""),
            (Kind::WrongType, b"1,1"),
            (Kind::ControlCharacter, b"\x1B[2J\r"),
            (Kind::NotUtf8, b"\xFF\xFE"),
            (Kind::Nul, b"\0"),
        ],
    }
}

/// The places of values.
fn values(form: Form, sample: &[u8]) -> Vec<Range<usize>> {
    match form {
        Form::Json => tokens(sample).into_iter().filter(|token| !is_key(sample, token)).collect(),
        Form::Toml => lines(sample)
            .filter_map(|line| {
                let equals = sample[line.clone()].windows(3).position(|part| part == b" = ")?;
                Some(line.start + equals + 3..line.end)
            })
            .collect(),
        Form::Csv => lines(sample).flat_map(|line| cells(sample, line)).collect(),
    }
}

/// The places of what may be there once only: a key with its value, a heading, the name of a column.
fn entries(form: Form, sample: &[u8]) -> Vec<Range<usize>> {
    match form {
        Form::Json => {
            let keys = tokens(sample).into_iter().filter(|token| is_key(sample, token));
            // The value of the copy is that of the key after it: `"a": "a": 1` is no JSON, so that the copy gets one of its own.
            keys.filter_map(|key| {
                let rest = &sample[key.end..];
                let value = tokens(rest).into_iter().next()?;
                let between = &rest[..value.start];
                // Only where the value is a single token, and something follows it.
                let is_single = between.iter().all(|byte| matches!(byte, b':' | b' '));
                let comma = rest[value.end..].starts_with(b",");
                (is_single && comma).then(|| key.start..key.end + value.end + 1)
            })
            .collect()
        }
        Form::Toml => lines(sample)
            .filter(|line| {
                let text = &sample[line.clone()];
                // `[[node]]` may be there as often as one likes.
                !text.starts_with(b"[[") && !text.is_empty()
            })
            .map(|line| line.start..(line.end + 1).min(sample.len()))
            .collect(),
        Form::Csv => {
            let header = lines(sample).next().unwrap_or(0..0);
            let cells = cells(sample, header);
            // With the comma after it.
            cells.iter().take(cells.len().saturating_sub(1)).map(|cell| cell.start..cell.end + 1).collect()
        }
    }
}

/// The lines without their ends.
fn lines(sample: &[u8]) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    sample.split(|byte| *byte == b'\n').map(move |line| {
        let range = start..start + line.len();
        start = range.end + 1;
        range
    })
}

fn cells(sample: &[u8], line: Range<usize>) -> Vec<Range<usize>> {
    let mut start = line.start;
    let cells = sample[line].split(|byte| *byte == b',').map(|cell| {
        let range = start..start + cell.len();
        start = range.end + 1;
        range
    });
    cells.collect()
}

/// Texts, numbers and words of JSON.
fn tokens(json: &[u8]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < json.len() {
        let start = at;
        match json[at] {
            b'"' => {
                at += 1;
                while at < json.len() && json[at] != b'"' {
                    at += if json[at] == b'\\' { 2 } else { 1 };
                }
                at += 1;
            }
            byte if byte.is_ascii_alphanumeric() || byte == b'-' => {
                while at < json.len() && (json[at].is_ascii_alphanumeric() || b"+-.".contains(&json[at])) {
                    at += 1;
                }
            }
            _ => {
                at += 1;
                continue;
            }
        }
        found.push(start..at.min(json.len()));
    }
    found
}

/// Whether a colon follows.
fn is_key(json: &[u8], token: &Range<usize>) -> bool {
    json[token.end..].trim_ascii_start().starts_with(b":")
}

#[cfg(test)]
mod tests {
    use super::{Form, Kind, changed, count};

    fn shown(form: Form, sample: &str, kind: Kind) -> Vec<String> {
        let all = (0..count(form, sample.as_bytes())).map(|index| changed(form, sample.as_bytes(), index));
        all.filter(|found| found.kind == kind).map(|found| String::from_utf8_lossy(&found.bytes).into_owned()).collect()
    }

    #[test]
    fn keys_are_written_twice_and_values_replaced() {
        let json = r#"{"a": 1, "b": [2, "x"]}"#;
        assert_eq!(shown(Form::Json, json, Kind::KeyTwice), [r#"{"a": 1,"a": 1, "b": [2, "x"]}"#]);
        assert!(shown(Form::Json, json, Kind::WrongType).contains(&r#"{"a": 1, "b": [true, "x"]}"#.to_owned()));
        assert!(shown(Form::Json, json, Kind::CutShort).contains(&r#"{"a": 1,"#.to_owned()));
        let toml = "a = 1\n[[b]]\nc = \"x\"\n";
        assert_eq!(
            shown(Form::Toml, toml, Kind::KeyTwice),
            ["a = 1\na = 1\n[[b]]\nc = \"x\"\n", "a = 1\n[[b]]\nc = \"x\"\nc = \"x\"\n"]
        );
        assert!(shown(Form::Toml, toml, Kind::WrongType).contains(&"a = 1\n[[b]]\nc = {}\n".to_owned()));
        let csv = "n,p\n1,2\n";
        assert_eq!(shown(Form::Csv, csv, Kind::KeyTwice), ["n,n,p\n1,2\n"]);
        assert!(shown(Form::Csv, csv, Kind::HugeNumber).contains(&"n,p\n1,1e400\n".to_owned()));
    }
}
