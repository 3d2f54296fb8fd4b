//! S011: files that are no decks at all.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::{Block, DataLine, items};
use inpact_parser::grammar::KeywordId;
use inpact_parser::number::{NumberError, read_float};
use inpact_parser::span::Span;

declare_rule! {
    /// The file has no keyword line, and its lines do not read as rows either.
    ///
    /// Rows are numbers and names between commas.
    /// A file of rows alone may be meant for *INCLUDE: that is S004.
    ///
    /// ## Why
    /// A deck consists of keyword lines, which begin with `*`, and of the rows after them.
    /// A file without either is something else: a git-lfs pointer, a table of columns, a picture, a compressed file.
    ///
    /// ## What to do
    /// Check that the path is right, and that the file was downloaded or unpacked.
    ///
    /// ```inp,expect
    /// version https://git-lfs.github.com/spec/v1
    /// oid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393
    /// size 12345
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// 1.,
    /// ```
    "S011", "not-a-deck", Error, fix: None, source: "S-03, S-31"
}

/// Readings of the lines before the first keyword line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reading {
    /// Rows, or a deck has keyword lines after them.
    Rows,
    /// There is no keyword line, and most of the lines are no rows.
    NoDeck,
}

/// The most bytes examined to recognise a file.
const LOOKED_AT: u64 = 64 * 1024;

/// The lines before the first keyword line, comments and blank lines left out.
///
/// An *INCLUDE before them changes nothing: it has no rows of its own.
pub(super) fn leading_lines<'a>(context: &Context<'a>) -> impl Iterator<Item = DataLine<'a>> {
    let (deck, grammar) = (context.deck, context.grammar);
    let is_include = |id: KeywordId| grammar.keyword(id).name == "INCLUDE";
    let is_leading = move |block: &&Block| block.keyword.is_none() || block.keyword_id().is_some_and(is_include);
    let blocks = deck.blocks().iter().take_while(is_leading).filter(|block| block.keyword.is_none());
    let looked_at =
        blocks.map(Block::rows).map(|rows| Span::new(rows.source(), rows.start(), rows.end().min(rows.start() + LOOKED_AT)));
    looked_at.flat_map(|rows| deck.data_lines_in(rows)).filter(|line| !line.is_blank())
}

/// The reading of the file.
pub(super) fn reading(context: &Context<'_>) -> Reading {
    if context.keyword_lines().next().is_some() || !context.lost_lines.is_empty() {
        return Reading::Rows;
    }
    let (mut rows, mut others) = (0_usize, 0_usize);
    for line in leading_lines(context) {
        *if is_row(line.text) { &mut rows } else { &mut others } += 1;
    }
    if others > rows { Reading::NoDeck } else { Reading::Rows }
}

/// Whether every item of a line is empty, a number, a name or a quoted text.
fn is_row(line: &[u8]) -> bool {
    items(line).all(|range| match &line[range] {
        [] | [b'"' | b'<', ..] => true,
        item => matches!(read_float(item), Ok(_) | Err(NumberError::ExponentWithoutLetter(_))) || is_name(item),
    })
}

/// Whether an item reads as a name: a letter or underscore, then bytes of names, and no blank.
fn is_name(item: &[u8]) -> bool {
    let is_first = |byte: &u8| byte.is_ascii_alphabetic() || *byte == b'_';
    let is_further = |byte: &u8| byte.is_ascii_alphanumeric() || b"_-.+\"".contains(byte);
    item.first().is_some_and(is_first) && item.iter().all(is_further)
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    if reading(context) != Reading::NoDeck {
        return;
    }
    let Some(first) = leading_lines(context).next() else { return };
    let beginning = Span::new(first.span.source(), first.span.start(), first.span.end().min(first.span.start() + 80));
    let found = report
        .at(beginning, "this is no deck: no line begins with `*`, and the lines are no rows of items between commas");
    found.label(label(first.text)).help(help(first.text));
}

fn label(first_line: &[u8]) -> &'static str {
    match first_line {
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => "the file is UTF-16 text",
        line if line.starts_with(b"version https://git-lfs") => "the file is a git-lfs pointer",
        line if is_binary(line) => "the file is binary",
        _ => "the file begins so",
    }
}

fn help(first_line: &[u8]) -> &'static str {
    match first_line {
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => "save it as ASCII or UTF-8",
        line if line.starts_with(b"version https://git-lfs") => "fetch the file itself with `git lfs pull`",
        line if is_binary(line) => "check that the path is right; a compressed deck must be unpacked first",
        line if is_blank_separated(line) => "put commas between the items, and the keyword line before the rows",
        _ => "check that the path is right",
    }
}

fn is_binary(line: &[u8]) -> bool {
    line.iter().any(|byte| byte.is_ascii_control() && !byte.is_ascii_whitespace())
}

/// Whether a line holds several numbers with blanks between them.
fn is_blank_separated(line: &[u8]) -> bool {
    let fields = || line.split(u8::is_ascii_whitespace).filter(|field| !field.is_empty());
    fields().count() > 1 && fields().all(|field| read_float(field).is_ok())
}
