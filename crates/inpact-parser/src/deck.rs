//! The deck as it is in its files: blocks of a keyword line and the rows after it.
//!
//! Lossless: the blocks printed in order are the file, byte for byte, whatever the bytes are.
//! Never fails: a line without a meaning is still a line of some block.
//! Rows are a range of bytes and parsed lazily, so a mesh costs no number parsing (S-03 to S-37).

mod data_line;
mod edited;
mod ends;
mod include;
mod keyword_line;
pub mod lines;
mod parameter;
mod plain_row;
mod scan;
mod survey;
mod text;

pub use data_line::items;
pub use edited::{EditedText, TextInParts};
pub(crate) use ends::RowEnds;
pub use include::{FoundFile, Include, IncludeOutcome, IncludedFiles, MAX_FILES, max_levels};
pub use parameter::{Parameter, Resolved};
pub(crate) use plain_row::{MAX_CELLS, plain_row};
pub use scan::{Keep, ScanOptions, Scanner, scan};
pub use text::{Excerpts, Source};

use crate::grammar::KeywordId;
use crate::span::{Position, SourceId, Span};
use lines::{is_comment, without_line_end};
use parameter::{AfterName, More, Place};
use std::num::NonZeroU32;

/// A deck: its source files, split into blocks in reading order.
#[derive(Debug, Clone, PartialEq)]
pub struct Deck {
    sources: Vec<Source>,
    blocks: Vec<Block>,
    notes: Vec<LineNote>,
    directives: Vec<Span>,
    includes: Vec<Include>,
}

/// A keyword line and everything up to the next one.
///
/// A deck may consist of keyword lines only, so a block is compact.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// The keyword line; `None` for rows before the first keyword of a file, and for rows after an *INCLUDE.
    pub keyword: Option<KeywordLine>,
    /// The number of bytes of its rows, which follow the keyword line.
    rows_length: [u8; 6],
    /// The rows whose text is in the deck.
    pub rows_kept: RowsKept,
    elsewhere: Option<Box<Elsewhere>>,
}

/// The rows of a block whose text is in the deck.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowsKept {
    /// All of them.
    All,
    /// The first and the last row of a well-ordered table; the model has the first and the last row of each group ([`Keep::Ends`]).
    Ends,
    /// None: they are those of a mesh.
    None,
}

/// Rows of a block that do not follow its keyword line.
#[derive(Debug, Clone, PartialEq, Default)]
struct Elsewhere {
    /// The start of its rows, where it has no keyword line.
    start: Option<Span>,
    /// Its rows in other files.
    continued_in: Vec<Span>,
}

/// `*KEYWORD, PARAMETER=VALUE, …`, with the lines that continue it.
#[derive(Debug, Clone, PartialEq)]
pub struct KeywordLine {
    /// All of it, line ends included.
    pub span: Span,
    /// The keyword that the name resolves to (S-13).
    pub resolved: Resolved<KeywordId>,
    name: Place,
    after_name: AfterName,
}

/// A note made while lines were scanned, in rows whose text may not be kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LineNote {
    /// The kind of note.
    pub kind: LineNoteKind,
    /// The first line of the block for which it holds.
    pub span: Span,
    /// The number of lines of the block it holds for.
    pub lines: u64,
}

/// Kinds of [`LineNote`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum LineNoteKind {
    /// More than 256 characters on a keyword or data line (S-06).
    TooLong,
    /// A byte above 0x7F on a keyword or data line, outside quotes (S-01).
    NonAscii,
    /// `**` after blanks (S-04).
    IndentedComment,
    /// A row whose text is not kept, and that begins with the full name of a keyword (S-05).
    ///
    /// Each has a separate note, up to a hundred per block.
    LikeKeyword,
}

/// One line of rows: data or blank; comments are skipped (S-04).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DataLine<'deck> {
    /// The line without its line end.
    pub span: Span,
    /// Its bytes.
    pub text: &'deck [u8],
}

impl DataLine<'_> {
    /// Whether the line consists of blanks (S-08).
    pub fn is_blank(&self) -> bool {
        self.text.trim_ascii().is_empty()
    }

    /// The items between the commas, as spans of the deck (S-31).
    pub fn items(&self) -> impl Iterator<Item = Span> {
        let line = self.span;
        items(self.text).map(move |range| part_of(line, range))
    }

    /// The span of some bytes of the line.
    pub fn part(&self, range: std::ops::Range<usize>) -> Span {
        part_of(self.span, range)
    }
}

impl Deck {
    /// The source files: the deck itself, then the files it includes.
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// The source file that a span points into.
    pub fn source(&self, id: SourceId) -> &Source {
        &self.sources[id.0 as usize]
    }

    /// The blocks in reading order.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The comments addressed to inpact: `** inpact: …`.
    pub fn directives(&self) -> &[Span] {
        &self.directives
    }

    /// The *INCLUDE options and their outcomes, innermost first; empty until [`Deck::with_includes`] has read them.
    pub fn includes(&self) -> &[Include] {
        &self.includes
    }

    /// The *INCLUDE lines that led to a source file, the nearest first; none for the deck itself.
    pub fn include_chain(&self, source: SourceId) -> Vec<Span> {
        std::iter::successors(self.source(source).included_by(), |span| self.source(span.source()).included_by())
            .collect()
    }

    /// Notes on lines, in reading order.
    pub fn notes(&self) -> &[LineNote] {
        &self.notes
    }

    /// Whether rows were accessed that were dropped because they are in order ([`Keep::Ends`]).
    ///
    /// The deck must then be read again, with [`Keep::Interpreted`].
    pub fn lacks_rows(&self) -> bool {
        self.sources.iter().any(Source::have_missed)
    }

    /// The ends of the groups of a table whose other rows were dropped.
    pub(crate) fn ends_of(&self, block: &Block) -> Option<&RowEnds> {
        self.source(block.rows().source()).ends_of(block.rows())
    }

    /// Records an access to the rows of a block that were dropped.
    pub(crate) fn miss_rows(&self, block: &Block) {
        self.source(block.rows().source()).miss();
    }

    /// The bytes of a span; empty where the scan did not keep them.
    pub fn text(&self, span: Span) -> &[u8] {
        self.source(span.source()).text(span.start()..span.end())
    }

    /// The kept bytes around the start of a span without a gap, and the offset in its file where they begin.
    ///
    /// They begin at the start of a line.
    pub fn surroundings(&self, span: Span) -> (u64, &[u8]) {
        self.source(span.source()).surroundings(span.start()..span.end())
    }

    /// The text of a span for display; bytes that are not UTF-8 are replaced.
    pub fn shown(&self, span: Span) -> String {
        String::from_utf8_lossy(self.text(span)).into_owned()
    }

    /// The data and blank lines of a block, without comments; nothing when its rows were not kept.
    pub fn data_lines<'a>(&'a self, block: &'a Block) -> impl Iterator<Item = DataLine<'a>> {
        block.all_rows().flat_map(|rows| self.data_lines_in(rows))
    }

    /// The data and blank lines of a span of rows.
    pub fn data_lines_in(&self, rows: Span) -> impl Iterator<Item = DataLine<'_>> {
        let text = self.text(rows);
        let skipped = if rows.start() == 0 { byte_order_mark(text) } else { 0 };
        lines::lines(&text[skipped..]).filter_map(move |range| {
            let range = range.start + skipped..range.end + skipped;
            let line = &text[range.clone()];
            let content = without_line_end(line);
            let start = rows.start() + range.start as u64;
            let span = Span::new(rows.source(), start, start + content.len() as u64);
            (!is_comment(line)).then_some(DataLine { span, text: content })
        })
    }

    /// Line and column of the start of every span, in the order given; one pass per file.
    pub fn positions(&self, spans: &[Span]) -> Vec<Position> {
        let mut order: Vec<usize> = (0..spans.len()).collect();
        order.sort_by_key(|index| (spans[*index].source(), spans[*index].start()));
        let mut positions = vec![Position { line: 1, column: 1 }; spans.len()];
        for group in order.chunk_by(|a, b| spans[*a].source() == spans[*b].source()) {
            let offsets: Vec<u64> = group.iter().map(|index| spans[*index].start()).collect();
            let found = self.source(spans[group[0]].source()).positions(&offsets);
            for (index, position) in group.iter().zip(found) {
                positions[*index] = position;
            }
        }
        positions
    }

    /// Writes a source file back: its blocks, in order.
    ///
    /// The bytes are those of the file when the deck was scanned with [`Keep::Everything`];
    /// otherwise rows that were not kept are missing (see [`Source::is_complete`]).
    pub fn print(&self, source: SourceId) -> Vec<u8> {
        let mut printed = Vec::new();
        for block in self.blocks.iter().filter(|block| block.rows().source() == source) {
            if let Some(keyword) = &block.keyword {
                printed.extend_from_slice(self.text(keyword.span));
            }
            printed.extend_from_slice(self.text(block.rows()));
        }
        printed
    }
}

impl Block {
    /// A block without a keyword, or with one directly before its rows.
    fn new(keyword: Option<KeywordLine>, rows: Span, rows_kept: RowsKept) -> Self {
        let start = keyword.is_none().then(|| Span::new(rows.source(), rows.start(), rows.start()));
        let elsewhere = start.map(|start| Box::new(Elsewhere { start: Some(start), continued_in: Vec::new() }));
        let mut block = Self { keyword, rows_length: [0; 6], rows_kept, elsewhere };
        block.set_rows_length(rows.len());
        block
    }

    /// No span is longer than 2⁴⁸ bytes.
    fn set_rows_length(&mut self, length: u64) {
        let [bytes @ .., _, _] = length.to_le_bytes();
        self.rows_length = bytes;
    }

    /// The lines after the keyword line: data, comments, blank lines.
    pub fn rows(&self) -> Span {
        let [b0, b1, b2, b3, b4, b5] = self.rows_length;
        let length = u64::from_le_bytes([b0, b1, b2, b3, b4, b5, 0, 0]);
        let start = self.span_of_keyword();
        Span::new(start.source(), start.end(), start.end() + length)
    }

    /// Rows of this block in another file: in a file that begins with rows, or after the *INCLUDE of one (S-51).
    ///
    /// They are blocks without a keyword as well.
    pub fn continued_in(&self) -> &[Span] {
        self.elsewhere.as_ref().map_or(&[], |elsewhere| &elsewhere.continued_in)
    }

    fn continue_in(&mut self, rows: Span) {
        self.elsewhere.get_or_insert_default().continued_in.push(rows);
    }

    /// All its rows, in all files.
    pub fn all_rows(&self) -> impl Iterator<Item = Span> + Clone {
        std::iter::once(self.rows()).chain(self.continued_in().iter().copied())
    }

    /// The keyword, when its name is unambiguous.
    pub fn keyword_id(&self) -> Option<KeywordId> {
        self.keyword.as_ref()?.id()
    }

    /// The keyword line; for rows before the first keyword an empty span at their start.
    pub fn span_of_keyword(&self) -> Span {
        let without_keyword = || self.elsewhere.as_ref().and_then(|elsewhere| elsewhere.start).unwrap_or_default();
        self.keyword.as_ref().map_or_else(without_keyword, |keyword| keyword.span)
    }

    /// Keyword line and rows.
    pub fn span(&self) -> Span {
        self.span_of_keyword().to(self.rows())
    }
}

impl KeywordLine {
    /// The keyword, when its name is unambiguous.
    pub fn id(&self) -> Option<KeywordId> {
        self.resolved.found()
    }

    /// The name after the asterisk.
    pub fn name(&self) -> Span {
        self.name.span(self.span)
    }

    /// The position of a quote that is not closed on its line (S-41).
    pub fn unterminated_quote(&self) -> Option<Span> {
        self.more()?.open_quote.map(|at| self.byte(at))
    }

    /// The comma at the end of the line, when the next line is not its continuation (S-19).
    pub fn dangling_comma(&self) -> Option<Span> {
        self.more()?.last_comma.map(|comma| self.byte(comma.at))
    }

    /// The limit of bytes of a keyword line, where the next line would have exceeded it: that is read as a row, whatever it contains.
    pub fn length_exhausted(&self) -> Option<u32> {
        self.more()?.last_comma?.most.map(NonZeroU32::get)
    }

    fn more(&self) -> Option<&More> {
        match &self.after_name {
            AfterName::More(more) => Some(more),
            AfterName::Nothing | AfterName::OneParameter(_) => None,
        }
    }

    fn byte(&self, at: NonZeroU32) -> Span {
        let at = self.span.start() + u64::from(at.get());
        Span::new(self.span.source(), at, at + 1)
    }

    /// The line without its line end, for labels.
    pub fn visible_span(&self, deck: &Deck) -> Span {
        let length = deck.text(self.span).trim_ascii_end().len() as u64;
        Span::new(self.span.source(), self.span.start(), self.span.start() + length)
    }
}

/// The span of some bytes of a line.
fn part_of(line: Span, range: std::ops::Range<usize>) -> Span {
    Span::new(line.source(), line.start() + range.start as u64, line.start() + range.end as u64)
}

/// The length of the UTF-8 byte order mark that `text` begins with, or 0.
fn byte_order_mark(text: &[u8]) -> usize {
    if text.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 }
}
