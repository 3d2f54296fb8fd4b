//! Layout of JSON on lines: objects and lists of objects are spread over several lines, a list of numbers or texts stays on one.
//!
//! So a row of a table is a line, as in the deck.

use serde::Serialize;
use serde_json::ser::{CharEscape, Formatter};
use std::io;

/// Writes a document as readable JSON, with a final line end.
pub(super) fn to_string(document: &impl Serialize) -> String {
    let mut bytes = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, Lines::default());
    // Strings, numbers and lists of them cannot fail, and neither can a buffer in memory.
    let written = document.serialize(&mut serializer);
    debug_assert!(written.is_ok(), "{written:?}");
    bytes.push(b'\n');
    String::from_utf8(bytes).unwrap_or_default()
}

/// The state of the writer.
#[derive(Debug, Default)]
struct Lines {
    depth: usize,
    /// A list element has begun, and it is not known yet whether it is a list or an object.
    pending: Option<Pending>,
    /// For every open list or object: whether it spans several lines.
    broken: Vec<bool>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pending {
    First,
    Further,
}

impl Lines {
    /// Begins a list element that is a number or a text.
    fn begin_scalar<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        match self.pending.take() {
            Some(Pending::Further) => writer.write_all(b", "),
            Some(Pending::First) | None => Ok(()),
        }
    }

    /// Begins a list element that is a list or an object.
    fn begin_nested<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        let Some(pending) = self.pending.take() else { return Ok(()) };
        if pending == Pending::Further {
            writer.write_all(b",")?;
        }
        if let Some(broken) = self.broken.last_mut() {
            *broken = true;
        }
        self.new_line(writer)
    }

    fn new_line<W: ?Sized + io::Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.depth).try_for_each(|_| writer.write_all(b"  "))
    }

    fn open<W: ?Sized + io::Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        self.begin_nested(writer)?;
        self.depth += 1;
        self.broken.push(false);
        writer.write_all(bracket)
    }

    fn close<W: ?Sized + io::Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        self.depth -= 1;
        if self.broken.pop() == Some(true) {
            self.new_line(writer)?;
        }
        writer.write_all(bracket)
    }
}

/// Writes a scalar once its position is determined.
macro_rules! scalars {
    ($($method:ident: $type:ty),+) => {
        $(fn $method<W: ?Sized + io::Write>(&mut self, writer: &mut W, value: $type) -> io::Result<()> {
            self.begin_scalar(writer)?;
            serde_json::ser::CompactFormatter.$method(writer, value)
        })+
    };
}

impl Formatter for Lines {
    scalars!(write_bool: bool, write_u8: u8, write_u64: u64, write_i64: i64, write_f64: f64);

    fn write_null<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin_scalar(writer)?;
        writer.write_all(b"null")
    }

    fn begin_string<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin_scalar(writer)?;
        writer.write_all(b"\"")
    }

    fn write_char_escape<W: ?Sized + io::Write>(&mut self, writer: &mut W, escape: CharEscape) -> io::Result<()> {
        serde_json::ser::CompactFormatter.write_char_escape(writer, escape)
    }

    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"[")
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_array_value<W: ?Sized + io::Write>(&mut self, _: &mut W, first: bool) -> io::Result<()> {
        self.pending = Some(if first { Pending::First } else { Pending::Further });
        Ok(())
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"{")
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        if !first {
            writer.write_all(b",")?;
        }
        if let Some(broken) = self.broken.last_mut() {
            *broken = true;
        }
        self.new_line(writer)
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    #[test]
    fn rows_stay_on_a_line() {
        let document = json!({"a": [[1.5, 2, "x"], [null, true]], "b": [], "c": {}, "d": [{"e": -1}, {"f": "\n"}]});
        let text = super::to_string(&document);
        let expected = "{\n  \"a\": [\n    [1.5, 2, \"x\"],\n    [null, true]\n  ],\n  \"b\": [],\n  \"c\": {},\n  \"d\": [\n    {\n      \"e\": -1\n    },\n    {\n      \"f\": \"\\n\"\n    }\n  ]\n}\n";
        assert_eq!(text, expected);
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), document);
    }
}
