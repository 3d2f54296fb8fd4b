//! Soundness of Parquet files: declared sizes and offsets compared with the bytes present.

use super::thrift::{Stop, Visitor, walk};
use super::{most_unpacked, unsound};
use flate2::read::MultiGzDecoder;
use parquet::basic::{Compression, Encoding};
use parquet::column::page::{Page, PageReader};
use parquet::errors::ParquetError;
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData};
use parquet::file::reader::ChunkReader;
use parquet::file::serialized_reader::SerializedPageReader;
use std::io::{self, Read};
use std::sync::Arc;

const KIND: &str = "Parquet";

/// The length of the footer and the magic bytes after it.
const TAIL: u64 = 8;

/// The maximum nesting of groups of columns.
const DEEPEST_GROUP: usize = 64;

/// The maximum length of a page header, which may contain statistics of long texts.
const LONGEST_HEADER: u64 = 1 << 20;

/// The maximum decompression ratio of Snappy: a copy of 64 bytes takes three.
const SNAPPY_TIMES: u64 = 32;

/// Checks the footer, before memory is allocated for its lists.
///
/// # Errors
/// Those of reading, and of kind [`io::ErrorKind::InvalidData`] for a footer that is not sound.
pub(in crate::nodes) fn check_footer<R: ChunkReader>(file: &R) -> io::Result<()> {
    let length = file.len();
    let Some(before_tail) = length.checked_sub(TAIL) else {
        return Err(unsound(KIND, "it is shorter than an empty one"));
    };
    let tail = file.get_bytes(before_tail, 8).map_err(invalid)?;
    let footer = u64::from(tail.first_chunk().copied().map_or(0, u32::from_le_bytes));
    let Some(at) = before_tail.checked_sub(footer) else {
        return Err(unsound(KIND, format!("its footer would have {footer} bytes")));
    };
    let bytes = file.get_bytes(at, usize::try_from(footer).unwrap_or(usize::MAX)).map_err(invalid)?;
    let mut depths = Depths::default();
    if let Err(stop) = walk(&bytes, &mut depths) {
        return Err(unsound(KIND, stop.reason("its footer has a list or a text longer than itself")));
    }
    if depths.finish() > DEEPEST_GROUP {
        let message = format!(
            "its columns lie in more than {DEEPEST_GROUP} groups in one another: write the columns by themselves"
        );
        return Err(unsound(KIND, message));
    }
    Ok(())
}

/// The nesting of the groups of a schema, from the number of children of each element in order.
#[derive(Default)]
struct Depths {
    /// The number of remaining elements in each open group.
    open: Vec<i64>,
    deepest: usize,
    children: i64,
}

impl Depths {
    fn close(&mut self) {
        let children = std::mem::take(&mut self.children);
        if let Some(left) = self.open.last_mut() {
            *left -= 1;
        }
        if children > 0 {
            self.open.push(children);
            self.deepest = self.deepest.max(self.open.len());
        }
        while self.open.last().is_some_and(|left| *left <= 0) {
            self.open.pop();
        }
    }

    fn finish(mut self) -> usize {
        self.close();
        self.deepest
    }
}

impl Visitor for Depths {
    fn integer(&mut self, path: &[i16], value: i64) {
        // FileMetaData.schema, SchemaElement.num_children.
        if path == [2, 5] {
            self.children = value;
        }
    }

    fn structure(&mut self, path: &[i16]) {
        if path == [2] {
            self.close();
        }
    }
}

/// Checks the pages of some columns, given by their indices in the schema.
///
/// # Errors
/// Those of reading, and of kind [`io::ErrorKind::InvalidData`] for a file that is not sound.
pub(in crate::nodes) fn check_pages<R: ChunkReader + Clone + 'static>(
    file: &R,
    metadata: &ParquetMetaData,
    is_read: impl Fn(usize) -> bool,
) -> io::Result<()> {
    let schema = metadata.file_metadata().schema_descr();
    let mut total = 0_u64;
    for group in metadata.row_groups() {
        let rows = group.num_rows();
        if rows < 0 {
            return Err(unsound(KIND, "a group has fewer rows than none"));
        }
        for leaf in (0..group.num_columns()).filter(|leaf| is_read(schema.get_column_root_idx(*leaf))) {
            let chunk = group.column(leaf);
            check_codec(chunk)?;
            // A column that is not a list has a value, possibly null, in every row.
            if chunk.column_descr().max_rep_level() == 0 && chunk.num_values() != rows {
                let name = chunk.column_descr().name();
                let values = chunk.num_values();
                return Err(unsound(KIND, format!("column `{name}` has {values} values in a group of {rows} rows")));
            }
            total = total.saturating_add(check_chunk(file, chunk)?);
            if total > file.len() {
                return Err(unsound(KIND, "its columns are longer than the file"));
            }
            if chunk.encodings().any(is_of_lengths) {
                check_lengths(file, chunk, rows)?;
            }
        }
    }
    Ok(())
}

/// Rejects a column with a compression that this build does not support.
fn check_codec(chunk: &ColumnChunkMetaData) -> io::Result<()> {
    let codec = match chunk.compression() {
        // The decompression ratio of Brotli is unbounded, and LZO has no reader.
        Compression::BROTLI(_) => "Brotli",
        Compression::LZO => "LZO",
        _ => return Ok(()),
    };
    let name = chunk.column_descr().name();
    let cure = "write the table with Zstandard, Snappy, gzip or LZ4, or without compression";
    let message = format!("column `{name}` is compressed with {codec}, which is not read; {cure}");
    Err(io::Error::new(io::ErrorKind::InvalidData, message))
}

/// Checks that a page compressed by gzip, except its levels, does not exceed its declared size: the library decompresses it to its end.
fn check_gzip(page: &[u8], levels: u64, unpacked: u64) -> io::Result<()> {
    let packed = usize::try_from(levels).ok().and_then(|levels| page.get(levels..));
    let (Some(packed), Some(most)) = (packed, unpacked.checked_sub(levels)) else {
        return Err(unsound(KIND, "the levels of a page are longer than the page"));
    };
    let mut bytes = MultiGzDecoder::new(packed).take(most.saturating_add(1));
    let found = io::copy(&mut bytes, &mut io::sink()).map_err(|error| unsound(KIND, error))?;
    if most < found {
        return Err(unsound(KIND, format!("a page comes to more than the {unpacked} bytes that it says")));
    }
    Ok(())
}

/// Checks the pages of a column in a row group; returns their total length.
fn check_chunk<R: ChunkReader>(file: &R, chunk: &ColumnChunkMetaData) -> io::Result<u64> {
    let begin = chunk.dictionary_page_offset().unwrap_or_else(|| chunk.data_page_offset());
    let sizes = (u64::try_from(begin), u64::try_from(chunk.compressed_size()));
    let (Ok(begin), Ok(length)) = sizes else { return Err(unsound(KIND, "a column has a place below zero")) };
    let end = begin.saturating_add(length);
    if end > file.len() {
        return Err(unsound(KIND, "a column goes on beyond the end of the file"));
    }
    let mut at = begin;
    let mut values = 0_i64;
    while at < end && values < chunk.num_values() {
        let head = usize::try_from((end - at).min(LONGEST_HEADER)).unwrap_or(usize::MAX);
        let mut page = PageSizes::default();
        // Most headers are short, and a page is long.
        let short = file.get_bytes(at, head.min(256)).map_err(invalid)?;
        let walked = match walk(&short, &mut page) {
            Err(Stop::Broken) if head > 256 => {
                page = PageSizes::default();
                walk(&file.get_bytes(at, head).map_err(invalid)?, &mut page)
            }
            walked => walked,
        };
        at += match walked {
            Ok(walked) => walked as u64,
            Err(Stop::Broken) if LONGEST_HEADER < end - at => {
                let message = format!(
                    "the header of a page is no header, or longer than {LONGEST_HEADER} bytes: write the table without statistics of its pages"
                );
                return Err(unsound(KIND, message));
            }
            Err(stop) => return Err(unsound(KIND, stop.reason("the header of a page is no header"))),
        };
        let sizes = (u64::try_from(page.packed), u64::try_from(page.unpacked), u64::try_from(page.values));
        let (Ok(packed), Ok(unpacked), Ok(_)) = sizes else {
            return Err(unsound(KIND, "a page has a length below zero"));
        };
        if packed > end - at {
            return Err(unsound(KIND, format!("a page would have {packed} bytes, and {} are left", end - at)));
        }
        let most = match chunk.compression() {
            Compression::UNCOMPRESSED => packed,
            Compression::SNAPPY => 4096 + packed.saturating_mul(SNAPPY_TIMES),
            _ => most_unpacked(packed),
        };
        if unpacked > most {
            let message = format!(
                "{packed} bytes of it would come to {unpacked} when they are unpacked, and no more than {most} are read at once"
            );
            return Err(unsound(KIND, message));
        }
        if page.is_packed && matches!(chunk.compression(), Compression::GZIP(_)) {
            let bytes = file.get_bytes(at, usize::try_from(packed).unwrap_or(usize::MAX)).map_err(invalid)?;
            check_gzip(&bytes, u64::try_from(page.levels).unwrap_or(u64::MAX), unpacked)?;
        }
        // The values of a dictionary are stored plainly, in at least one bit each.
        if page.is_dictionary && page.values.unsigned_abs() > unpacked.saturating_mul(8) {
            return Err(unsound(KIND, format!("a dictionary of {unpacked} bytes would have {} values", page.values)));
        }
        if !page.is_dictionary {
            values = values.saturating_add(page.values);
        }
        at += packed;
    }
    Ok(length)
}

/// The header of a page.
struct PageSizes {
    packed: i64,
    unpacked: i64,
    values: i64,
    /// The number of bytes of levels, which come first and are never compressed: in data pages of version 2.
    levels: i64,
    is_dictionary: bool,
    is_packed: bool,
}

impl Default for PageSizes {
    fn default() -> Self {
        Self { packed: 0, unpacked: 0, values: 0, levels: 0, is_dictionary: false, is_packed: true }
    }
}

impl Visitor for PageSizes {
    fn integer(&mut self, path: &[i16], value: i64) {
        match path {
            [1] => self.is_dictionary = value == 2,
            [2] => self.unpacked = value,
            [3] => self.packed = value,
            // The numbers of values in the headers of a data page, a dictionary, and a data page of version 2.
            [5 | 7 | 8, 1] => self.values = value,
            [8, 5 | 6] => self.levels = self.levels.saturating_add(value),
            [8, 7] => self.is_packed = value == 1,
            _ => {}
        }
    }
}

/// Whether an encoding begins with the number of text lengths.
fn is_of_lengths(encoding: Encoding) -> bool {
    matches!(encoding, Encoding::DELTA_LENGTH_BYTE_ARRAY | Encoding::DELTA_BYTE_ARRAY)
}

/// Checks that pages of texts declare no more lengths than values, since memory is allocated for as many.
fn check_lengths<R: ChunkReader + Clone + 'static>(file: &R, chunk: &ColumnChunkMetaData, rows: i64) -> io::Result<()> {
    let rows = usize::try_from(rows).unwrap_or(usize::MAX);
    let mut pages = SerializedPageReader::new(Arc::new(file.clone()), chunk, rows, None).map_err(invalid)?;
    while let Some(page) = pages.get_next_page().map_err(invalid)? {
        if !is_of_lengths(page.encoding()) {
            continue;
        }
        let values = match &page {
            Page::DataPage { buf, .. } => {
                let has_levels = chunk.column_descr().max_def_level() > 0;
                let levels = buf.first_chunk().copied().map_or(0, u32::from_le_bytes) as usize;
                if has_levels { buf.get(levels.saturating_add(4)..) } else { Some(&buf[..]) }
            }
            Page::DataPageV2 { buf, def_levels_byte_len, rep_levels_byte_len, .. } => {
                buf.get((*def_levels_byte_len as usize).saturating_add(*rep_levels_byte_len as usize)..)
            }
            Page::DictionaryPage { .. } => continue,
        };
        // The block size, the number of its parts, and the number of values.
        let mut numbers = Numbers(values.unwrap_or(&[]));
        let stated = (numbers.next(), numbers.next(), numbers.next());
        let most = u64::from(page.num_values());
        if !matches!(stated, (Some(_), Some(_), Some(count)) if count <= most) {
            return Err(unsound(KIND, format!("a page of {most} texts has another number of lengths")));
        }
    }
    Ok(())
}

/// Variable-length integers (7 bits per byte).
struct Numbers<'a>(&'a [u8]);

impl Iterator for Numbers<'_> {
    type Item = u64;

    fn next(&mut self) -> Option<u64> {
        let mut value = 0_u64;
        for shift in (0..64).step_by(7) {
            let (byte, rest) = self.0.split_first()?;
            self.0 = rest;
            value |= u64::from(byte & 0x7F) << shift;
            if byte & 0x80 == 0 {
                return Some(value);
            }
        }
        None
    }
}

fn invalid(error: ParquetError) -> io::Error {
    unsound(KIND, error)
}
