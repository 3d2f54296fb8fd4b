//! Splits bytes into blocks: from a file to a [`Deck`].
//!
//! Bytes are pushed in pieces of any size, so a file is read once and need not fit into memory.
//! Knows the grammar only to find the keyword of a line, whether its rows are worth keeping,
//! and whether the line after a trailing comma continues it (S-19).

mod keyword;

use super::ends::{Trend, thin, trend_of};
use super::lines::{
    LineKind, count_line_ends, find_keyword_line, find_long_line, is_comment, line_kind, lines, next_line,
    without_line_end,
};
use super::parameter::LONGEST_KEYWORD_LINE;
use super::survey::Survey;
use super::{Block, Deck, KeywordLine, LineNote, LineNoteKind, RowsKept, Source, byte_order_mark, items, keyword_line};
use crate::grammar::{Definition, Dialect, Grammar, KeywordId, Lookup, RowShape};
use crate::span::{SourceId, Span};
use keyword::{AfterComma, after_comma, resolve};
use std::ops::Range;

/// The most characters of a keyword or data line (S-06).
const LINE_CHARACTERS: usize = 256;

/// The number of bytes kept of the rows before the first keyword when only interpreted blocks are: enough to distinguish a fragment from a file that is not a deck.
const LEADING_ROWS_KEPT: u64 = 64 * 1024;

/// The maximum number of notes per block for rows that begin with the name of a keyword.
const MAX_LIKE_KEYWORDS: usize = 100;

/// The rows that keep their text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Keep {
    /// All of them: the deck can be printed.
    Everything,
    /// Those of keywords whose rows are interpreted: the deck can be checked and evaluated, in memory that grows with the interpreted blocks and not with the file.
    #[default]
    Interpreted,
    /// Those, except the rows of large well-ordered tables: of these the model has only the first and the last row of each group, which suffice for all rules.
    ///
    /// The deck can only be checked, and only while [`Deck::lacks_rows`] is false.
    Ends,
}

/// Options of a scan.
#[derive(Debug, Clone, Copy)]
pub struct ScanOptions<'grammar> {
    /// The keyword language.
    pub grammar: &'grammar Grammar,
    /// The rows that keep their text.
    pub keep: Keep,
}

/// The part kept of the rows before the first keyword of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LeadingRows {
    /// All of them: they continue a block whose rows are kept.
    All,
    /// As much as distinguishes a fragment from a file that is not a deck.
    Some,
    /// None.
    None,
}

/// Scans the bytes of one file and keeps all of them.
pub fn scan(name: &str, bytes: &[u8], grammar: &Grammar) -> Deck {
    let mut scanner = Scanner::new(name, ScanOptions { grammar, keep: Keep::Everything });
    scanner.push(bytes);
    scanner.finish()
}

/// Splits the bytes of one file, pushed piece by piece, into blocks.
#[derive(Debug)]
pub struct Scanner<'grammar> {
    options: ScanOptions<'grammar>,
    id: SourceId,
    source: Source,
    blocks: Vec<Block>,
    notes: Vec<LineNote>,
    directives: Vec<Span>,
    /// Bytes after the last complete line that was processed.
    pending: Vec<u8>,
    /// Offset and line number of the next byte to be processed.
    offset: u64,
    line: u64,
    /// A keyword line that ends in a comma and may continue.
    open_keyword: Option<OpenKeyword>,
    block: OpenBlock,
    longest_keyword_line: u32,
}

/// A keyword line that may be continued (S-19).
#[derive(Debug)]
struct OpenKeyword {
    start: u64,
    /// The keyword; looked up once, however many lines continue it.
    id: Option<KeywordId>,
    /// The physical lines taken so far, comments between them included.
    text: Vec<u8>,
    /// The length of `text` that certainly belongs to the keyword line: comments at its end do not.
    accepted: usize,
    /// Lines after the comma at its end; the including file may continue with flags.
    after_comma: AfterComma,
}

/// Kinds of lines that are noted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mark {
    Note(LineNoteKind),
    /// A comment addressed to inpact.
    Directive,
}

/// The block whose rows are being read.
#[derive(Debug)]
struct OpenBlock {
    keyword: Option<KeywordLine>,
    rows_start: u64,
    keeps_rows: KeepsRows,
    /// The number of rows noted because they begin with the name of a keyword.
    likes_of_keywords: usize,
    /// The rows are free text, in which any byte may occur (S-70).
    free_text: bool,
    /// The rows may be a well-ordered table, which is not kept completely.
    may_be_thinned: Option<MayBeThinned>,
}

/// A table that is kept whole if there is any note on its lines.
#[derive(Debug)]
struct MayBeThinned {
    trend: Trend,
    /// The notes and directives before it.
    noted: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum KeepsRows {
    All,
    None,
    /// All rows up to this number of bytes of the file.
    UpTo(u64),
}

impl<'grammar> Scanner<'grammar> {
    /// A scanner for the deck of that name.
    pub fn new(name: &str, options: ScanOptions<'grammar>) -> Self {
        Self::for_source(SourceId::ROOT, name, options, LeadingRows::Some)
    }

    /// A scanner for one of the files of a deck.
    pub(super) fn for_source(
        id: SourceId,
        name: &str,
        options: ScanOptions<'grammar>,
        leading_rows: LeadingRows,
    ) -> Self {
        let keeps_rows = match leading_rows {
            _ if options.keep == Keep::Everything => KeepsRows::All,
            LeadingRows::All => KeepsRows::All,
            LeadingRows::Some => KeepsRows::UpTo(LEADING_ROWS_KEPT),
            LeadingRows::None => KeepsRows::None,
        };
        Self {
            options,
            id,
            source: Source::new(name),
            blocks: Vec::new(),
            notes: Vec::new(),
            directives: Vec::new(),
            pending: Vec::new(),
            offset: 0,
            line: 1,
            open_keyword: None,
            block: OpenBlock {
                keyword: None,
                rows_start: 0,
                keeps_rows,
                likes_of_keywords: 0,
                free_text: false,
                may_be_thinned: None,
            },
            longest_keyword_line: LONGEST_KEYWORD_LINE,
        }
    }

    /// Sets the limit of bytes of a keyword line with its continuation lines: the rest is read as rows and reported (S003). The default is 1 GiB.
    pub fn set_longest_keyword_line(&mut self, bytes: u32) {
        self.longest_keyword_line = bytes;
    }

    /// Takes the next bytes of the file.
    pub fn push(&mut self, bytes: &[u8]) {
        let mut bytes = bytes;
        if !self.pending.is_empty() {
            let Some(end) = end_of_pending_line(&self.pending, bytes) else {
                self.pending.extend_from_slice(bytes);
                return;
            };
            let mut line = std::mem::take(&mut self.pending);
            line.extend_from_slice(&bytes[..end]);
            self.process(&line);
            bytes = &bytes[end..];
        }
        let complete = end_of_last_line(bytes);
        self.process(&bytes[..complete]);
        self.pending.extend_from_slice(&bytes[complete..]);
    }

    /// Pushes whole lines with a known survey; rows that are not kept are skipped.
    pub(super) fn push_surveyed(&mut self, bytes: &[u8], survey: Survey) {
        let is_between_lines = self.pending.is_empty() && self.open_keyword.is_none();
        // A CR at the very end may be half of a CR LF, and a byte order mark is not part of a row.
        let is_rows = !survey.has_asterisk && bytes.ends_with(b"\n") && self.offset != 0;
        if is_between_lines && is_rows {
            self.rows(bytes, &[], survey);
        } else {
            self.push(bytes);
        }
    }

    /// The number of buffered bytes of an unfinished line.
    pub fn unfinished(&self) -> usize {
        self.pending.len()
    }

    /// The number of the next or unfinished line, from 1.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// The end of the file: gives the deck.
    pub fn finish(mut self) -> Deck {
        let last_line = std::mem::take(&mut self.pending);
        self.process(&last_line);
        self.close_keyword();
        self.close_block();
        self.source.length = self.offset;
        Deck {
            sources: vec![self.source],
            blocks: self.blocks,
            notes: self.notes,
            directives: self.directives,
            includes: Vec::new(),
        }
    }

    /// Processes complete lines.
    fn process(&mut self, bytes: &[u8]) {
        let mut at = 0;
        if self.offset == 0 {
            at = byte_order_mark(bytes);
            self.rows(&bytes[..at], &[], Survey::of(&bytes[..at]));
        }
        if at == 0 && self.open_keyword.is_none() {
            let survey = Survey::of(bytes);
            if !survey.has_asterisk {
                // Only rows, probably of a mesh: no closer inspection is needed.
                return self.rows(bytes, &[], survey);
            }
        }
        while at < bytes.len() {
            if self.open_keyword.is_some() {
                at = self.continue_keyword(bytes, at);
                continue;
            }
            let mut marked = Vec::new();
            let keyword = find_keyword_line(bytes, at, |start, star| {
                if start < star {
                    marked.push((start - at, Mark::Note(LineNoteKind::IndentedComment)));
                }
                if is_directive(&bytes[star..]) {
                    marked.push((start - at, Mark::Directive));
                }
            });
            let rows = &bytes[at..keyword.unwrap_or(bytes.len())];
            self.rows(rows, &marked, Survey::of(rows));
            let Some(keyword) = keyword else { return };
            at = next_line(bytes, keyword);
            self.open_keyword(&bytes[keyword..at]);
        }
    }

    /// Adds rows and comments of the open block; `marked` are the starts of the requested comments.
    fn rows(&mut self, bytes: &[u8], marked: &[(usize, Mark)], survey: Survey) {
        if bytes.is_empty() {
            return;
        }
        let mut lines = if self.block.free_text { Vec::new() } else { noteworthy_lines(bytes, self.offset, survey) };
        lines.extend(marked.iter().map(|(start, mark)| (*start..next_line(bytes, *start), *mark)));
        if survey.may_have_letters && self.block.keeps_rows == KeepsRows::None && !self.block.free_text {
            self.find_likes_of_keywords(bytes, &mut lines);
        }
        self.mark(lines, bytes);
        match self.block.keeps_rows {
            KeepsRows::All => self.source.keep(self.offset, self.line, bytes),
            KeepsRows::UpTo(limit) if self.offset < limit => self.source.keep(self.offset, self.line, bytes),
            KeepsRows::UpTo(_) => self.block.keeps_rows = KeepsRows::None,
            KeepsRows::None => {}
        }
        self.offset += bytes.len() as u64;
        self.line += if survey.has_carriage_return { count_line_ends(bytes) } else { survey.line_feeds };
    }

    /// Finds the rows that begin with the full name of a keyword, as their text is not kept.
    fn find_likes_of_keywords(&mut self, bytes: &[u8], found: &mut Vec<(Range<usize>, Mark)>) {
        for line in lines(bytes) {
            if MAX_LIKE_KEYWORDS <= self.block.likes_of_keywords {
                return;
            }
            if self.begins_with_keyword(bytes[line.clone()].trim_ascii_start()) {
                self.block.likes_of_keywords += 1;
                found.push((line, Mark::Note(LineNoteKind::LikeKeyword)));
            }
        }
    }

    /// Whether a row begins with the name of a keyword, or with a character that is not ASCII and a keyword.
    fn begins_with_keyword(&self, row: &[u8]) -> bool {
        let hidden = row.iter().take_while(|byte| !byte.is_ascii()).count();
        let row = if hidden == 0 { Some(row) } else { row[hidden..].strip_prefix(b"*") };
        let Some(row) = row.filter(|row| row.first().is_some_and(u8::is_ascii_alphabetic)) else { return false };
        let name = items(row).next().map_or(&[][..], |name| &row[name]);
        matches!(self.options.grammar.keyword_named(name), Lookup::Exact(_))
    }

    /// Records notes on lines of `bytes`, which begin at the current offset.
    fn mark(&mut self, mut lines: Vec<(Range<usize>, Mark)>, bytes: &[u8]) {
        lines.sort_by_key(|(line, _)| line.start);
        for (line, mark) in lines {
            let start = self.offset + line.start as u64;
            let content = without_line_end(&bytes[line.clone()]).len() as u64;
            let span = Span::new(self.id, start, start + content);
            let is_first = match mark {
                Mark::Note(kind) => self.note(kind, span),
                Mark::Directive => {
                    self.directives.push(span);
                    true
                }
            };
            if is_first && self.block.keeps_rows == KeepsRows::None {
                let line_number = self.line + count_line_ends(&bytes[..line.start]);
                self.source.keep(start, line_number, &bytes[line]);
            }
        }
    }

    /// Notes a line; a second one of most kinds in one block is only counted. Returns whether it has a separate note.
    fn note(&mut self, kind: LineNoteKind, span: Span) -> bool {
        let block_start = self.block.keyword.as_ref().map_or(self.block.rows_start, |keyword| keyword.span.start());
        let of_this_block = |note: &&mut LineNote| note.span.start() >= block_start;
        if kind != LineNoteKind::LikeKeyword
            && let Some(note) = self.notes.iter_mut().rev().take_while(of_this_block).find(|note| note.kind == kind)
        {
            note.lines += 1;
            return false;
        }
        self.notes.push(LineNote { kind, span, lines: 1 });
        true
    }

    fn open_keyword(&mut self, line: &[u8]) {
        self.close_block();
        let may_continue = self.options.grammar.dialect() == Dialect::Abaqus && keyword_line::ends_in_comma(line);
        let named = || self.options.grammar.keyword_named(&line[keyword_line::parse(line).name]);
        let id = if may_continue { named().found() } else { None };
        self.open_keyword = Some(OpenKeyword {
            start: self.offset,
            id,
            text: line.to_vec(),
            accepted: line.len(),
            // The line after the last one of an included file is in another file.
            after_comma: if may_continue && self.id != SourceId::ROOT {
                AfterComma::PerhapsFlags
            } else {
                AfterComma::NoParameters
            },
        });
        self.source.keep(self.offset, self.line, line);
        self.block.keeps_rows = KeepsRows::All;
        self.block.rows_start = self.offset;
        self.mark(noteworthy_lines(line, self.offset, Survey::of(line)), line);
        self.advance(line);
        if !may_continue {
            self.close_keyword();
        }
    }

    /// Handles the line at `at` after a keyword line that ends in a comma; returns where to continue.
    fn continue_keyword(&mut self, bytes: &[u8], at: usize) -> usize {
        let end = next_line(bytes, at);
        let line = &bytes[at..end];
        let Some(open) = &mut self.open_keyword else { return at };
        let is_comment = is_comment(line);
        let most = self.longest_keyword_line;
        if u32::try_from(open.text.len() + line.len()).map_or(true, |length| most < length) {
            open.after_comma = AfterComma::TooLong(most);
            self.close_keyword();
            return at;
        }
        let next = if is_comment { None } else { after_comma(open.id, line, self.options.grammar) };
        if let Some(next) = next {
            open.after_comma = next;
            self.close_keyword();
            return at;
        }
        open.text.extend_from_slice(line);
        self.source.keep(self.offset, self.line, line);
        if !is_comment {
            open.accepted = open.text.len();
            self.mark(noteworthy_lines(line, self.offset, Survey::of(line)), line);
        }
        self.advance(line);
        if !is_comment && !keyword_line::ends_in_comma(line) {
            self.close_keyword();
        }
        end
    }

    /// Ends the keyword line that is open, if any, and begins the rows of its block.
    fn close_keyword(&mut self) {
        let Some(open) = self.open_keyword.take() else { return };
        let text = &open.text[..open.accepted];
        let keyword = resolve(text, (self.id, open.start), open.after_comma, self.options.grammar);
        let definition = keyword.id().and_then(|id| self.options.grammar.keyword(id).definition());
        // CalculiX has a limit of rows (T016), and its own syntax of numbers.
        let thins = self.options.keep == Keep::Ends && self.options.grammar.dialect() == Dialect::Abaqus;
        let trend = definition.filter(|_| thins).and_then(|definition| trend_of(definition, &keyword));
        let noted = self.noted();
        self.block = OpenBlock {
            may_be_thinned: trend.map(|trend| MayBeThinned { trend, noted }),
            rows_start: keyword.span.end(),
            keeps_rows: keeps_rows(definition, self.options.keep),
            likes_of_keywords: 0,
            free_text: definition.is_some_and(|definition| definition.rows() == RowShape::Text),
            keyword: Some(keyword),
        };
    }

    fn close_block(&mut self) {
        let rows = Span::new(self.id, self.block.rows_start, self.offset);
        let keyword = self.block.keyword.take();
        if keyword.is_some() || !rows.is_empty() {
            let rows_kept = match self.block.keeps_rows {
                KeepsRows::None => RowsKept::None,
                KeepsRows::All | KeepsRows::UpTo(_) => self.thin(rows),
            };
            self.blocks.push(Block::new(keyword, rows, rows_kept));
        }
    }

    /// Drops the rows of a well-ordered table except those at its ends.
    fn thin(&mut self, rows: Span) -> RowsKept {
        let Some(MayBeThinned { trend, noted }) = self.block.may_be_thinned.take() else { return RowsKept::All };
        let text = self.source.kept_from(rows.start()).filter(|text| text.len() as u64 == rows.len());
        let thinned = text.filter(|_| noted == self.noted()).and_then(|text| thin(text, rows.start(), self.id, trend));
        let Some(thinned) = thinned else { return RowsKept::All };
        self.source.thin(thinned, self.line);
        RowsKept::Ends
    }

    fn noted(&self) -> usize {
        self.notes.len() + self.directives.len()
    }

    fn advance(&mut self, line: &[u8]) {
        self.offset += line.len() as u64;
        self.line += count_line_ends(line);
    }
}

/// The lines that are too long or not ASCII (S-01, S-06); comments may be both. `offset` is that of `bytes` in the file.
fn noteworthy_lines(bytes: &[u8], offset: u64, survey: Survey) -> Vec<(Range<usize>, Mark)> {
    let mut found = Vec::new();
    let is_row = |line: &Range<usize>| matches!(line_kind(&bytes[line.clone()]), LineKind::Data | LineKind::Keyword);
    let mut from = if survey.may_have_long_line { 0 } else { bytes.len() };
    while let Some(long) = find_long_line(bytes, from, LINE_CHARACTERS) {
        from = long.end;
        if is_row(&long) && bytes[long.clone()].trim_ascii_end().len() > LINE_CHARACTERS {
            found.push((long, Mark::Note(LineNoteKind::TooLong)));
        }
    }
    if survey.is_ascii {
        return found;
    }
    let skipped = if offset == 0 { byte_order_mark(bytes) } else { 0 };
    for line in lines(&bytes[skipped..]) {
        let line = line.start + skipped..line.end + skipped;
        if is_row(&line) && !is_ascii_outside_quotes(&bytes[line.clone()]) {
            found.push((line, Mark::Note(LineNoteKind::NonAscii)));
        }
    }
    found
}

/// Whether a comment is a directive: `** inpact: …`.
fn is_directive(comment: &[u8]) -> bool {
    comment.strip_prefix(b"**").is_some_and(|text| text.trim_ascii_start().starts_with(b"inpact:"))
}

/// The end in `bytes` of the line that `pending` begins, if it ends there.
fn end_of_pending_line(pending: &[u8], bytes: &[u8]) -> Option<usize> {
    if pending.last() == Some(&b'\r') {
        return bytes.first().map(|first| usize::from(*first == b'\n'));
    }
    let end = next_line(bytes, 0);
    // Without an end, or with a CR as the very last byte, it is not known yet whether an LF follows.
    let ended = without_line_end(&bytes[..end]).len() < end && !(end == bytes.len() && bytes[end - 1] == b'\r');
    ended.then_some(end)
}

/// The end of the last complete line of `bytes`; a CR at the very end may be half of a CR LF.
fn end_of_last_line(bytes: &[u8]) -> usize {
    let certain = bytes.strip_suffix(b"\r").unwrap_or(bytes);
    memchr::memrchr2(b'\n', b'\r', certain).map_or(0, |last| last + 1)
}

/// Rows are kept when they are interpreted: those of sub-options, and of keywords whose rows the grammar describes.
fn keeps_rows(definition: Option<&Definition>, keep: Keep) -> KeepsRows {
    let interpreted = definition
        .is_some_and(|definition| definition.rows() != RowShape::Uninterpreted || !definition.parents.is_empty());
    if interpreted || keep == Keep::Everything { KeepsRows::All } else { KeepsRows::None }
}

fn is_ascii_outside_quotes(line: &[u8]) -> bool {
    let mut quoted = false;
    line.iter().all(|byte| {
        quoted ^= *byte == b'"';
        quoted || byte.is_ascii()
    })
}
