//! The source of the bytes of rows, and the lines in them.

use crate::deck::lines::{LineKind, line_kind, lines, next_line, without_line_end};
use crate::deck::{Block, Deck, items};
use crate::number::read_float;
use crate::span::{SourceId, Span};
use std::collections::HashMap;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;

/// The number of bytes read at a time.
const PIECE: usize = 1 << 20;

/// A source of the bytes of spans of a deck.
pub trait RowBytes {
    /// Passes the bytes of a span to `take`, in order, in pieces of any size.
    ///
    /// # Errors
    ///
    /// Bytes that cannot be read.
    fn read(&mut self, span: Span, take: &mut dyn FnMut(&[u8])) -> io::Result<()>;
}

/// The bytes kept by a deck itself; it must have been scanned with [`Keep::Everything`](crate::deck::Keep::Everything).
#[derive(Debug, Clone, Copy)]
pub struct KeptRows<'deck>(pub &'deck Deck);

impl RowBytes for KeptRows<'_> {
    fn read(&mut self, span: Span, take: &mut dyn FnMut(&[u8])) -> io::Result<()> {
        let text = self.0.text(span);
        if text.len() as u64 != span.len() {
            return Err(io::Error::other("the rows of this deck were not kept"));
        }
        take(text);
        Ok(())
    }
}

/// The files of a deck, open for random access; the caller opens them, in the order of [`Deck::sources`].
#[derive(Debug)]
pub struct SeekableRows<R> {
    files: HashMap<SourceId, R>,
    buffer: Vec<u8>,
}

impl<R: Read + Seek> SeekableRows<R> {
    /// Rows from these files.
    pub fn new(files: impl IntoIterator<Item = (SourceId, R)>) -> Self {
        Self { files: files.into_iter().collect(), buffer: Vec::new() }
    }
}

impl<R: Read + Seek> RowBytes for SeekableRows<R> {
    fn read(&mut self, span: Span, take: &mut dyn FnMut(&[u8])) -> io::Result<()> {
        let file =
            self.files.get_mut(&span.source()).ok_or_else(|| io::Error::other("a file of the deck is not open"))?;
        file.seek(SeekFrom::Start(span.start()))?;
        self.buffer.resize(PIECE, 0);
        let mut left = span.len();
        while 0 < left {
            let wanted = usize::try_from(left).map_or(PIECE, |left| left.min(PIECE));
            file.read_exact(&mut self.buffer[..wanted])?;
            take(&self.buffer[..wanted]);
            left -= wanted as u64;
        }
        Ok(())
    }
}

/// The rows of a block as numbers, with their places: 0 for an empty item, `None` for a row with something else.
pub(super) fn number_rows(bytes: &mut dyn RowBytes, block: &Block) -> io::Result<Vec<(Option<Vec<f64>>, Span)>> {
    let mut rows = Vec::new();
    data_lines(bytes, block, &mut |line, span| {
        let number = |item: Range<usize>| if item.is_empty() { Some(0.0) } else { read_float(&line[item]).ok() };
        rows.push((items(line).map(number).collect(), span));
    })?;
    Ok(rows)
}

/// Passes every data line of a block to `take`, without its line end and with its place.
pub(super) fn data_lines(bytes: &mut dyn RowBytes, block: &Block, take: &mut dyn FnMut(&[u8], Span)) -> io::Result<()> {
    for rows in block.all_rows() {
        let mut offset = rows.start();
        let mut unfinished: Vec<u8> = Vec::new();
        let mut whole = |text: &[u8]| {
            for line in lines(text) {
                let line = &text[line];
                let content = without_line_end(line);
                if line_kind(content) == LineKind::Data {
                    take(content, Span::new(rows.source(), offset, offset + content.len() as u64));
                }
                offset += line.len() as u64;
            }
        };
        bytes.read(rows, &mut |mut piece| {
            if !unfinished.is_empty() {
                let end = next_line(piece, 0);
                unfinished.extend_from_slice(&piece[..end]);
                piece = &piece[end..];
                if !unfinished.ends_with(b"\n") && piece.is_empty() {
                    return;
                }
                whole(&unfinished);
                unfinished.clear();
            }
            // A CR at the end of a piece may be half of a line end.
            let end = memchr::memrchr(b'\n', piece).map_or(0, |last| last + 1);
            whole(&piece[..end]);
            unfinished.extend_from_slice(&piece[end..]);
        })?;
        whole(&unfinished);
    }
    Ok(())
}
