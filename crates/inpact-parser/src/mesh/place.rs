//! Line numbers of notes: rows of meshes are not kept, so their lines are counted in the bytes of the file.

use super::RowBytes;
use crate::deck::{Block, Deck};
use crate::span::{Position, Span};
use std::io;

/// Line and column of the beginning of a span, even in rows that the deck has not kept.
///
/// # Errors
///
/// Bytes that cannot be read.
pub fn position(deck: &Deck, rows: &mut dyn RowBytes, span: Span) -> io::Result<Position> {
    let known = |span| deck.positions(&[span]).first().copied().unwrap_or(Position { line: 1, column: 1 });
    let is_in =
        |range: &Span| range.source() == span.source() && range.start() <= span.start() && span.start() < range.end();
    let ranges = deck.blocks().iter().flat_map(Block::all_rows);
    let Some(range) = ranges.filter(|_| deck.text(span).is_empty()).find(is_in) else { return Ok(known(span)) };
    // The range begins where something that was kept ends, or at the beginning of a file.
    let mut at = known(Span::new(range.source(), range.start(), range.start()));
    let mut after_return = false;
    rows.read(Span::new(range.source(), range.start(), span.start()), &mut |piece| {
        for byte in piece {
            let ends_line = *byte == b'\r' || (*byte == b'\n' && !after_return);
            after_return = *byte == b'\r';
            match byte {
                b'\r' | b'\n' => {
                    at.line += u64::from(ends_line);
                    at.column = 1;
                }
                // The bytes after the first of a character.
                0x80..=0xBF => {}
                _ => at.column += 1,
            }
        }
    })?;
    Ok(at)
}
