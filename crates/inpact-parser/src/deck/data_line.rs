//! One data line: items separated by commas (S-31 to S-37).
//!
//! nom parses the items one by one; the reader of the row interprets them.

use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_while1};
use nom::combinator::{opt, recognize};
use nom::multi::many0_count;
use nom::{IResult, Parser};
use std::ops::Range;

use super::keyword_line::trimmed;
use super::lines::without_line_end;

/// The items of a data line as byte ranges of `line`, without the blanks around them.
///
/// An item may be empty (S-32), and a trailing comma gives one more empty item (S-33).
pub fn items(line: &[u8]) -> impl Iterator<Item = Range<usize>> {
    let content = without_line_end(line);
    let mut rest = Some(content);
    std::iter::from_fn(move || {
        let input = rest?;
        let (after, found) = item(input).unwrap_or((&[], input));
        rest = after.strip_prefix(b",");
        let start = content.len() - input.len();
        Some(trimmed(content, start..start + found.len()))
    })
}

/// Everything up to the next comma outside quotes.
fn item(input: &[u8]) -> IResult<&[u8], &[u8]> {
    let (rest, plain) = take_till(|byte| matches!(byte, b',' | b'"')).parse(input)?;
    // Numbers have no quotes: the common case ends here.
    if rest.first() == Some(&b'"') { with_quotes(input) } else { Ok((rest, plain)) }
}

fn with_quotes(input: &[u8]) -> IResult<&[u8], &[u8]> {
    let plain = take_while1(|byte| !matches!(byte, b',' | b'"'));
    let quoted = recognize((tag("\""), take_till(|byte| byte == b'"'), opt(tag("\""))));
    recognize(many0_count(alt((plain, quoted)))).parse(input)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(line: &str) -> Vec<&str> {
        items(line.as_bytes()).map(|range| &line[range]).collect()
    }

    #[test]
    fn items_between_commas() {
        assert_eq!(shown("10.,,,1.\n"), ["10.", "", "", "1."]);
        assert_eq!(shown(" 1. ,\t2 \r\n"), ["1.", "2"]);
        assert_eq!(shown("1.,"), ["1.", ""]);
        assert_eq!(shown(", <x>"), ["", "<x>"]);
        assert_eq!(shown(""), [""]);
        assert_eq!(shown("\"a, b\", c"), ["\"a, b\"", "c"]);
        assert_eq!(shown("\"open, b"), ["\"open, b"]);
    }
}
