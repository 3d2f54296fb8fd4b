//! One keyword line: the name after the asterisk, and the parameters (S-10 to S-20).
//!
//! nom parses the line; blanks carry no meaning outside quotes (S-11), so names and values are spans whose
//! canonical form is taken when they are compared.

use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_while};
use nom::combinator::{opt, recognize};
use nom::multi::many0_count;
use nom::sequence::{delimited, preceded};
use nom::{IResult, Parser};
use std::ops::Range;

use super::lines::{is_comment, lines, without_line_end};

/// The pieces of a keyword line as byte ranges of the text that was parsed.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct KeywordPieces {
    /// the name after the asterisk.
    pub(super) name: Range<usize>,
    /// The parameters in the order of the line; empty items (`*X,,Y=1`) leave none.
    pub(super) parameters: Vec<ParameterPieces>,
    /// The quote that does not close on its line.
    pub(super) unterminated_quote: Option<usize>,
    /// The comma that ends the line, when the line ends in one.
    pub(super) final_comma: Option<usize>,
}

/// `NAME` or `NAME=VALUE` as byte ranges.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ParameterPieces {
    /// The name, without blanks around it.
    pub(super) name: Range<usize>,
    /// The value, without blanks around it; `None` when there is no `=`.
    pub(super) value: Option<Range<usize>>,
}

/// Parses a logical keyword line: the physical line of the asterisk and the lines that continue it.
///
/// Never fails: malformed text stays inside a name or a value.
pub(super) fn parse(text: &[u8]) -> KeywordPieces {
    parse_items(text, word)
}

/// Parses a keyword line of CalculiX, in which every comma separates (CX-02).
pub(super) fn parse_unprotected(text: &[u8]) -> KeywordPieces {
    parse_items(text, |input| take_till(|byte| byte == b',').parse(input))
}

/// A parser of one item of a line.
type TakeItem = fn(&[u8]) -> IResult<&[u8], &[u8]>;

fn parse_items(text: &[u8], word: TakeItem) -> KeywordPieces {
    let joined = join_physical_lines(text);
    let mut pieces = KeywordPieces::default();
    let start = joined.iter().position(|byte| *byte == b'*').map_or(0, |star| star + 1);
    let (rest, name) = word(&joined[start..]).unwrap_or((&[], &joined[start..]));
    pieces.name = trimmed(&joined, range_of(&joined, name));
    let mut rest = rest;
    while let Ok((after, item)) = preceded(tag(","), word).parse(rest) as IResult<&[u8], &[u8]> {
        let range = range_of(&joined, item);
        pieces.final_comma = Some(range.start - 1);
        if !joined[range.clone()].trim_ascii().is_empty() {
            pieces.final_comma = None;
            note_unterminated_quote(&joined, &range, &mut pieces);
            pieces.parameters.push(split_at_equals(&joined, range));
        }
        rest = after;
    }
    pieces
}

/// Whether a line continues on the next: its last character is a comma (S-19).
pub(super) fn ends_in_comma(text: &[u8]) -> bool {
    text.trim_ascii_end().last() == Some(&b',')
}

/// Replaces line ends and comment lines between the physical lines by blanks, so that offsets are unchanged.
fn join_physical_lines(text: &[u8]) -> std::borrow::Cow<'_, [u8]> {
    let first_end = without_line_end(&text[..super::lines::next_line(text, 0)]).len();
    if text[first_end..].trim_ascii().is_empty() {
        return (&text[..first_end]).into();
    }
    let mut joined = text.to_vec();
    for line in lines(text) {
        let content = without_line_end(&text[line.clone()]).len();
        let blank_from = if is_comment(&text[line.clone()]) { line.start } else { line.start + content };
        joined[blank_from..line.end].fill(b' ');
    }
    joined.into()
}

/// Everything up to the next comma that is neither inside quotes nor inside parentheses (S-20, S-41).
fn word(input: &[u8]) -> IResult<&[u8], &[u8]> {
    recognize(many0_count(alt((plain, quoted, parenthesised, stray)))).parse(input)
}

fn plain(input: &[u8]) -> IResult<&[u8], &[u8]> {
    nom::bytes::complete::take_while1(|byte| !matches!(byte, b',' | b'"' | b'(')).parse(input)
}

fn quoted(input: &[u8]) -> IResult<&[u8], &[u8]> {
    recognize((tag("\""), take_till(|byte| byte == b'"'), opt(tag("\"")))).parse(input)
}

fn parenthesised(input: &[u8]) -> IResult<&[u8], &[u8]> {
    recognize(delimited(tag("("), take_while(|byte| byte != b')'), tag(")"))).parse(input)
}

/// A parenthesis that never closes is an ordinary character.
fn stray(input: &[u8]) -> IResult<&[u8], &[u8]> {
    tag("(").parse(input)
}

fn note_unterminated_quote(text: &[u8], range: &Range<usize>, pieces: &mut KeywordPieces) {
    let item = &text[range.clone()];
    if memchr::memchr_iter(b'"', item).count() % 2 == 1 {
        pieces.unterminated_quote = memchr::memrchr(b'"', item).map(|at| range.start + at);
    }
}

fn split_at_equals(text: &[u8], range: Range<usize>) -> ParameterPieces {
    match memchr::memchr(b'=', &text[range.clone()]) {
        None => ParameterPieces { name: trimmed(text, range), value: None },
        Some(at) => {
            let equals = range.start + at;
            ParameterPieces {
                name: trimmed(text, range.start..equals),
                value: Some(trimmed(text, equals + 1..range.end)),
            }
        }
    }
}

/// The range without blanks at its ends.
pub(super) fn trimmed(text: &[u8], range: Range<usize>) -> Range<usize> {
    let content = &text[range.clone()];
    let start = range.start + (content.len() - content.trim_ascii_start().len());
    start..start + content.trim_ascii().len()
}

fn range_of(whole: &[u8], part: &[u8]) -> Range<usize> {
    let start = part.as_ptr() as usize - whole.as_ptr() as usize;
    start..start + part.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> String {
        let pieces = parse(text.as_bytes());
        let mut out = text[pieces.name].to_owned();
        for parameter in pieces.parameters {
            out += &format!(" | {}", &text[parameter.name]);
            if let Some(value) = parameter.value {
                out += &format!(" = {}", &text[value]);
            }
        }
        out
    }

    #[test]
    fn names_parameters_and_values() {
        assert_eq!(shown("*Surface Interaction, name= A b \r\n"), "Surface Interaction | name = A b");
        assert_eq!(shown("*X,,Y=1,\n"), "X | Y = 1");
        assert_eq!(shown("  *STEP\n"), "STEP");
        assert_eq!(shown("*"), "");
        assert_eq!(shown("*A, PRESSURE, USER"), "A | PRESSURE | USER");
    }

    #[test]
    fn quotes_and_parentheses_protect_commas() {
        assert_eq!(shown("*A, NAME=\"x, y=z\", U"), "A | NAME = \"x, y=z\" | U");
        assert_eq!(shown("*PARAMETER, DEPENDENT=(a, b), T=1"), "PARAMETER | DEPENDENT = (a, b) | T = 1");
        assert_eq!(shown("*A, N=(x, y"), "A | N = (x | y");
    }

    #[test]
    fn cx_02_every_comma_separates_in_calculix() {
        let pieces = parse_unprotected(b"*A, NAME=\"x, y\", (b, c)");
        assert_eq!(pieces.parameters.len(), 4);
        assert_eq!(pieces.parameters[0].value, Some(9..11));
    }

    #[test]
    fn a_04_continued_over_a_comment() {
        let text = "*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1,\n** why\nCUTOFF GAP FILL=0.2\n";
        assert_eq!(shown(text), "CONTACT PERMEABILITY | CUTOFF FLOW ACROSS = 0.1 | CUTOFF GAP FILL = 0.2");
    }

    #[test]
    fn an_open_quote_is_noted() {
        assert_eq!(parse(b"*A, NAME=\"x").unterminated_quote, Some(9));
        assert_eq!(parse(b"*A, NAME=\"x\"").unterminated_quote, None);
        assert_eq!(parse(b"*A, B,").final_comma, Some(5));
        assert_eq!(parse(b"*A,").final_comma, Some(2));
        assert_eq!(parse(b"*A, B").final_comma, None);
    }
}
