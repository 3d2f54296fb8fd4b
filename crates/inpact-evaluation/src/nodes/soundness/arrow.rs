//! Soundness of Arrow files and streams: declared sizes of messages compared with the bytes present.

use super::{most_unpacked, unsound};
use crate::arrow::ipc::{FieldNode, Message, MessageHeader, RecordBatch, root_as_footer, root_as_message};
use crate::nodes::stored::ReadSeek;
use std::io::{self, SeekFrom};

const KIND: &str = "Arrow";

/// The beginning of a file, including padding, and its end: the length of its footer and the magic bytes.
const HEAD: u64 = 8;
const TAIL: u64 = 10;

/// The continuation marker before a length, in all but the oldest files.
const CONTINUATION: u32 = u32::MAX;

/// The maximum number of rows per byte of a compressed file: zstd compresses a full block of equal bits to a few bytes.
const ROWS_OF_A_BYTE: u64 = 8 << 15;

/// A message: offset and length of its body.
struct Place {
    body: u64,
    length: u64,
}

/// Checks a file.
///
/// # Errors
/// Those of reading, and of kind [`io::ErrorKind::InvalidData`] for a file that is not sound.
pub(in crate::nodes) fn check_file(input: &mut dyn ReadSeek) -> io::Result<()> {
    let length = input.seek(SeekFrom::End(0))?;
    let Some(before_tail) = length.checked_sub(TAIL).filter(|at| *at >= HEAD) else {
        return Err(unsound(KIND, "it is shorter than an empty one"));
    };
    let tail = read(input, before_tail, TAIL)?;
    let footer_length = u64::from(number(&tail));
    let Some(footer_at) = before_tail.checked_sub(footer_length).filter(|at| *at >= HEAD) else {
        return Err(unsound(KIND, format!("its footer would have {footer_length} bytes")));
    };
    let footer = read(input, footer_at, footer_length)?;
    let footer = root_as_footer(&footer).map_err(|error| unsound(KIND, error))?;
    let mut total = 0_u64;
    for block in footer.dictionaries().iter().flatten().chain(footer.recordBatches().iter().flatten()) {
        let sizes =
            (u64::try_from(block.offset()), u64::try_from(block.metaDataLength()), u64::try_from(block.bodyLength()));
        let (Ok(offset), Ok(header), Ok(body)) = sizes else {
            return Err(unsound(KIND, "a block has a length below zero"));
        };
        total = total.saturating_add(header).saturating_add(body);
        if offset < HEAD || total > footer_at || offset.saturating_add(header).saturating_add(body) > footer_at {
            return Err(unsound(KIND, "a block is longer than the file"));
        }
        let bytes = read(input, offset, header)?;
        let skipped = if bytes.len() >= 4 && number(&bytes) == CONTINUATION { 8 } else { 4 };
        let Some(bytes) = bytes.get(skipped..) else { return Err(unsound(KIND, "a block has no message")) };
        check_message(input, bytes, &Place { body: offset + header, length: body }, length)?;
    }
    input.seek(SeekFrom::Start(0)).map(drop)
}

/// Checks a stream, message by message.
///
/// # Errors
/// Those of reading, and of kind [`io::ErrorKind::InvalidData`] for a stream that is not sound.
pub(in crate::nodes) fn check_stream(input: &mut dyn ReadSeek) -> io::Result<()> {
    let length = input.seek(SeekFrom::End(0))?;
    let mut at = 0;
    // Fewer bytes than a length count as the end.
    while at + 4 <= length {
        let mut header = u64::from(number(&read(input, at, 4)?));
        at += 4;
        if header == u64::from(CONTINUATION) {
            if at + 4 > length {
                return Err(unsound(KIND, "it ends in a message"));
            }
            header = u64::from(number(&read(input, at, 4)?));
            at += 4;
        }
        if header == 0 {
            break;
        }
        if header > length - at {
            return Err(unsound(KIND, format!("a message would have {header} bytes, and {} are left", length - at)));
        }
        let bytes = read(input, at, header)?;
        at += header;
        let body = message(&bytes)?.bodyLength();
        let Some(body) = u64::try_from(body).ok().filter(|body| *body <= length - at) else {
            return Err(unsound(KIND, format!("a message would have {body} bytes, and {} are left", length - at)));
        };
        check_message(input, &bytes, &Place { body: at, length: body }, length)?;
        at += body;
    }
    input.seek(SeekFrom::Start(0)).map(drop)
}

fn message(bytes: &[u8]) -> io::Result<Message<'_>> {
    root_as_message(bytes).map_err(|error| unsound(KIND, error))
}

fn check_message(input: &mut dyn ReadSeek, bytes: &[u8], place: &Place, file: u64) -> io::Result<()> {
    let message = message(bytes)?;
    let batch = match message.header_type() {
        MessageHeader::RecordBatch => message.header_as_record_batch(),
        MessageHeader::DictionaryBatch => message.header_as_dictionary_batch().and_then(|dictionary| dictionary.data()),
        _ => None,
    };
    batch.map_or(Ok(()), |batch| check_batch(input, batch, place, file))
}

/// No buffer is longer than the body, and their total decompressed size is within the limit.
fn check_batch(input: &mut dyn ReadSeek, batch: RecordBatch<'_>, place: &Place, file: u64) -> io::Result<()> {
    let lengths = batch.nodes().into_iter().flatten().map(FieldNode::length).chain([batch.length()]);
    let most_rows = file.saturating_mul(ROWS_OF_A_BYTE);
    for rows in lengths {
        if !u64::try_from(rows).is_ok_and(|rows| rows <= most_rows) {
            return Err(unsound(KIND, format!("a part of {} bytes would have {rows} rows", place.length)));
        }
    }
    let mut unpacked = 0_u64;
    for buffer in batch.buffers().into_iter().flatten() {
        let sizes = (u64::try_from(buffer.offset()), u64::try_from(buffer.length()));
        let (Ok(offset), Ok(length)) = sizes else {
            return Err(unsound(KIND, "a buffer has a length below zero"));
        };
        if offset.saturating_add(length) > place.length {
            return Err(unsound(KIND, format!("a buffer goes on beyond the {} bytes of its message", place.length)));
        }
        if batch.compression().is_none() || length == 0 {
            continue;
        }
        if length < 8 {
            return Err(unsound(KIND, "a compressed buffer is too short to say how long it is"));
        }
        let stated = read(input, place.body + offset, 8)?;
        let stated = i64::from_le_bytes(stated.try_into().unwrap_or_default());
        // −1 marks an uncompressed buffer.
        unpacked = unpacked.saturating_add(match u64::try_from(stated) {
            Ok(stated) => stated,
            Err(_) if stated == -1 => length,
            Err(_) => return Err(unsound(KIND, "a buffer has a length below zero")),
        });
    }
    let most = most_unpacked(place.length);
    if unpacked > most {
        return Err(unsound(
            KIND,
            format!(
                "{} bytes of it come to {unpacked} when they are unpacked, more than the {most} that are read at once: \
                 write it in batches of fewer rows",
                place.length
            ),
        ));
    }
    Ok(())
}

fn read(input: &mut dyn ReadSeek, at: u64, length: u64) -> io::Result<Vec<u8>> {
    input.seek(SeekFrom::Start(at))?;
    // The caller has checked the length against the file.
    let mut bytes = vec![0; usize::try_from(length).map_err(|_| unsound(KIND, "it is larger than memory"))?];
    input.read_exact(&mut bytes)?;
    Ok(bytes)
}

/// The number in the first four bytes.
fn number(bytes: &[u8]) -> u32 {
    bytes.first_chunk().copied().map_or(0, u32::from_le_bytes)
}
