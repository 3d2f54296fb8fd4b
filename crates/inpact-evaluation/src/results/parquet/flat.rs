//! A column of results on its way into a row group, encoded as it is stored: floats plain, statuses by their numbers in a dictionary.
//!
//! The library's encoders compare, hash and copy value by value; here a page is a header, the runs of what is missing, and the numbers as they are in memory.

use crate::kernel::scan::extremes;
use crate::nodes::NumberColumn;
use crate::results::Status;
use bytes::Bytes;
use parquet::basic::{Compression, Encoding, EncodingMask, PageType};
use parquet::column::page::{CompressedPage, Page, PageWriter};
use parquet::column::writer::ColumnCloseResult;
use parquet::errors::ParquetError;
use parquet::file::metadata::{ColumnChunkMetaData, LevelHistogram, OffsetIndexBuilder, PageEncodingStats};
use parquet::file::reader::{ChunkReader, Length};
use parquet::file::statistics::{Statistics, ValueStatistics};
use parquet::file::writer::{SerializedPageWriter, SerializedRowGroupWriter, TrackedWrite};
use parquet::schema::types::ColumnDescPtr;
use std::io::{self, Read, Write};
use std::ops::Range;

/// How many rows a page has at most: their floats are still in the cache when the next step takes them.
const ROWS_OF_A_PAGE: usize = 1 << 14;

/// Cells of some rows of a column.
#[derive(Clone, Copy)]
pub(in crate::results) enum Cells<'b> {
    Numbers(&'b NumberColumn),
    Statuses(&'b [Option<Status>]),
    /// Numbers that no row has.
    Nothing,
}

/// The pages of a column of the row group under way.
pub(super) struct FlatColumn {
    descriptor: ColumnDescPtr,
    /// Pages of data one after the other.
    pages: Vec<u8>,
    locations: OffsetIndexBuilder,
    page_count: i32,
    rows: u64,
    missing: u64,
    /// The smallest and the largest number that is no NaN.
    range: Option<(f64, f64)>,
    /// The statuses so far, by their numbers in the dictionary; `None` for a column of numbers.
    dictionary: Option<Vec<Status>>,
    /// The header of the page before, which the next one has too where it is as large.
    header: Option<((usize, usize), Vec<u8>)>,
}

impl FlatColumn {
    pub(super) fn numbers(descriptor: ColumnDescPtr) -> Self {
        Self {
            descriptor,
            pages: Vec::new(),
            locations: OffsetIndexBuilder::new(),
            page_count: 0,
            rows: 0,
            missing: 0,
            range: None,
            dictionary: None,
            header: None,
        }
    }

    pub(super) fn statuses(descriptor: ColumnDescPtr) -> Self {
        Self { dictionary: Some(Vec::new()), ..Self::numbers(descriptor) }
    }

    /// Adds some rows of the cells.
    pub(super) fn write(&mut self, cells: Cells<'_>, rows: Range<usize>) -> Result<(), ParquetError> {
        let mut first = rows.start;
        while first < rows.end {
            let page = first..rows.end.min(first + ROWS_OF_A_PAGE);
            first = page.end;
            match cells {
                Cells::Numbers(column) => {
                    let present = column.presence().map(|present| &present[page.clone()]);
                    self.write_numbers(&column.values()[page], present)?;
                }
                Cells::Statuses(statuses) => self.write_statuses(&statuses[page])?,
                Cells::Nothing => {
                    let (values, present) = (vec![f64::NAN; page.len()], vec![false; page.len()]);
                    self.write_numbers(&values, Some(&present))?;
                }
            }
        }
        Ok(())
    }

    fn write_numbers(&mut self, values: &[f64], present: Option<&[bool]>) -> Result<(), ParquetError> {
        let present = present.filter(|present| present.contains(&false));
        let missing = present.map_or(0, |present| present.iter().filter(|is_there| !**is_there).count());
        self.take_range(values, present, missing);
        let levels = levels(values.len(), present);
        let size = levels.len() + size_of::<f64>() * (values.len() - missing);
        self.begin_page(values.len(), missing, size, Encoding::PLAIN)?;
        self.pages.extend_from_slice(&levels);
        match present {
            None => push_numbers(&mut self.pages, values),
            Some(present) => {
                let there = values.iter().zip(present).filter(|(_, is_there)| **is_there);
                there.for_each(|(value, _)| self.pages.extend_from_slice(&value.to_le_bytes()));
            }
        }
        Ok(())
    }

    /// Widens the range of the numbers.
    fn take_range(&mut self, values: &[f64], present: Option<&[bool]>, missing: usize) {
        let found = extremes(values);
        let (least, greatest) = if found.non_finite == missing as u64 {
            (found.least, found.greatest)
        } else {
            // Infinities are numbers, NaN is none.
            let is_there = |row: usize| present.is_none_or(|present| present[row]);
            let numbers = values.iter().enumerate().filter(|(row, value)| is_there(*row) && !value.is_nan());
            numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, greatest), (_, value)| {
                (least.min(*value), greatest.max(*value))
            })
        };
        if least <= greatest {
            let (before, after) = self.range.unwrap_or((least, greatest));
            self.range = Some((before.min(least), after.max(greatest)));
        }
    }

    fn write_statuses(&mut self, statuses: &[Option<Status>]) -> Result<(), ParquetError> {
        let dictionary = self.dictionary.get_or_insert_default();
        let mut numbers = [u8::MAX; Status::ALL.len()];
        for (number, status) in (0..).zip(&*dictionary) {
            numbers[*status as usize] = number;
        }
        let mut found = Vec::with_capacity(statuses.len());
        for status in statuses.iter().flatten() {
            let number = &mut numbers[*status as usize];
            if *number == u8::MAX {
                *number = u8::try_from(dictionary.len()).unwrap_or_default();
                dictionary.push(*status);
            }
            found.push(*number);
        }
        let width = usize::BITS - dictionary.len().saturating_sub(1).leading_zeros();
        let missing = statuses.len() - found.len();
        let present: Option<Vec<bool>> = (missing > 0).then(|| statuses.iter().map(Option::is_some).collect());
        let mut body = levels(statuses.len(), present.as_deref());
        body.push(u8::try_from(width).unwrap_or_default());
        push_runs(&mut body, &found, width);
        self.begin_page(statuses.len(), missing, body.len(), Encoding::RLE_DICTIONARY)?;
        self.pages.extend_from_slice(&body);
        Ok(())
    }

    /// Adds the header of a page of so many rows and bytes, and notes where it is.
    fn begin_page(&mut self, rows: usize, missing: usize, size: usize, encoding: Encoding) -> Result<(), ParquetError> {
        if self.header.as_ref().is_none_or(|(of, _)| *of != (rows, size)) {
            let page = Page::DataPage {
                buf: Bytes::from(vec![0; size]),
                num_values: u32::try_from(rows).unwrap_or_default(),
                encoding,
                def_level_encoding: Encoding::RLE,
                rep_level_encoding: Encoding::RLE,
                statistics: None,
            };
            let mut header = whole_page(page, size)?;
            header.truncate(header.len() - size);
            self.header = Some(((rows, size), header));
        }
        let header = self.header.as_ref().map_or(&[][..], |(_, header)| header);
        let offset = i64::try_from(self.pages.len()).unwrap_or_default();
        self.pages.extend_from_slice(header);
        self.locations.append_offset_and_size(offset, i32::try_from(header.len() + size).unwrap_or_default());
        self.locations.append_row_count(i64::try_from(rows).unwrap_or_default());
        self.page_count += 1;
        self.rows += rows as u64;
        self.missing += missing as u64;
        Ok(())
    }

    /// Adds the column to the row group, and begins anew.
    pub(super) fn append<W: Write + Send>(
        &mut self,
        group: &mut SerializedRowGroupWriter<'_, W>,
    ) -> Result<(), ParquetError> {
        let dictionary = match self.dictionary.as_mut().map(std::mem::take) {
            Some(statuses) => dictionary_page(&statuses)?,
            None => Vec::new(),
        };
        let has_dictionary = self.dictionary.is_some();
        let before = i64::try_from(dictionary.len()).unwrap_or_default();
        let size = i64::try_from(dictionary.len() + self.pages.len()).unwrap_or_default();
        let rows = i64::try_from(self.rows).unwrap_or_default();
        let missing = i64::try_from(self.missing).unwrap_or_default();
        let encoding = if has_dictionary { Encoding::RLE_DICTIONARY } else { Encoding::PLAIN };
        let mut encodings = vec![Encoding::PLAIN, Encoding::RLE];
        encodings.extend(has_dictionary.then_some(encoding));
        let of_data = PageEncodingStats { page_type: PageType::DATA_PAGE, encoding, count: self.page_count };
        let of_dictionary =
            PageEncodingStats { page_type: PageType::DICTIONARY_PAGE, encoding: Encoding::PLAIN, count: 1 };
        let mut metadata = ColumnChunkMetaData::builder(self.descriptor.clone())
            .set_compression(Compression::UNCOMPRESSED)
            .set_encodings_mask(EncodingMask::new_from_encodings(encodings.iter()))
            .set_page_encoding_stats(has_dictionary.then_some(of_dictionary).into_iter().chain([of_data]).collect())
            .set_total_compressed_size(size)
            .set_total_uncompressed_size(size)
            .set_num_values(rows)
            .set_data_page_offset(before)
            .set_dictionary_page_offset(has_dictionary.then_some(0));
        if !has_dictionary {
            metadata = metadata
                .set_statistics(statistics(self.range, self.missing))
                .set_definition_level_histogram(Some(LevelHistogram::from(vec![missing, rows - missing])));
        }
        let mut offsets = std::mem::replace(&mut self.locations, OffsetIndexBuilder::new()).build();
        offsets.page_locations.iter_mut().for_each(|location| location.offset += before);
        let close = ColumnCloseResult {
            bytes_written: u64::try_from(size).unwrap_or_default(),
            rows_written: self.rows,
            metadata: metadata.build()?,
            bloom_filter: None,
            column_index: None,
            offset_index: Some(offsets),
        };
        group.append_column(&Encoded { dictionary: &dictionary, pages: &self.pages }, close)?;
        self.pages.clear();
        (self.page_count, self.rows, self.missing, self.range, self.header) = (0, 0, 0, None, None);
        Ok(())
    }
}

/// Smallest, largest and missing numbers; a zero has the sign that both zeros are within (Parquet format, `ColumnOrder`).
fn statistics(range: Option<(f64, f64)>, missing: u64) -> Statistics {
    let least = range.map(|(least, _)| if least == 0.0 { -0.0 } else { least });
    let greatest = range.map(|(_, greatest)| if greatest == 0.0 { 0.0 } else { greatest });
    ValueStatistics::new(least, greatest, None, Some(missing), false).with_backwards_compatible_min_max(true).into()
}

/// A page with its header.
fn whole_page(page: Page, size: usize) -> Result<Vec<u8>, ParquetError> {
    let mut sink = TrackedWrite::new(Vec::new());
    SerializedPageWriter::new(&mut sink).write_page(CompressedPage::new(page, size))?;
    sink.into_inner()
}

fn dictionary_page(statuses: &[Status]) -> Result<Vec<u8>, ParquetError> {
    let mut words = Vec::new();
    for status in statuses {
        let word = status.word().as_bytes();
        words.extend_from_slice(&u32::try_from(word.len()).unwrap_or_default().to_le_bytes());
        words.extend_from_slice(word);
    }
    let size = words.len();
    let page = Page::DictionaryPage {
        buf: Bytes::from(words),
        num_values: u32::try_from(statuses.len()).unwrap_or_default(),
        encoding: Encoding::PLAIN,
        is_sorted: false,
    };
    whole_page(page, size)
}

/// The definition levels of a page: their length, then runs of 1 where a value is there and of 0 where it is missing.
fn levels(rows: usize, present: Option<&[bool]>) -> Vec<u8> {
    let mut levels = vec![0; 4];
    match present {
        None => push_run(&mut levels, rows, 1),
        Some(present) => {
            let present: Vec<u8> = present.iter().copied().map(u8::from).collect();
            push_runs(&mut levels, &present, 1);
        }
    }
    let length = u32::try_from(levels.len() - 4).unwrap_or_default();
    levels[..4].copy_from_slice(&length.to_le_bytes());
    levels
}

/// Small numbers of so many bits each: one run where all are the same, their bits one after the other otherwise.
fn push_runs(bytes: &mut Vec<u8>, numbers: &[u8], width: u32) {
    const GROUP: usize = 8;
    let Some(first) = numbers.first() else { return };
    if width == 0 || numbers.iter().all(|number| number == first) {
        return push_run(bytes, numbers.len(), *first);
    }
    push_varint(bytes, numbers.len().div_ceil(GROUP) << 1 | 1);
    for group in numbers.chunks(GROUP) {
        let bits = (0..).zip(group).fold(0_u64, |bits, (place, number)| bits | u64::from(*number) << (place * width));
        bytes.extend_from_slice(&bits.to_le_bytes()[..width as usize]);
    }
}

/// One number so many times; it has at most eight bits.
fn push_run(bytes: &mut Vec<u8>, count: usize, number: u8) {
    push_varint(bytes, count << 1);
    bytes.push(number);
}

fn push_varint(bytes: &mut Vec<u8>, mut number: usize) {
    while number > 0x7f {
        bytes.push(number.to_le_bytes()[0] | 0x80);
        number >>= 7;
    }
    bytes.push(number.to_le_bytes()[0]);
}

/// Adds floats as they are stored, the lowest byte first.
fn push_numbers(bytes: &mut Vec<u8>, values: &[f64]) {
    if cfg!(target_endian = "little") {
        bytes.extend_from_slice(pulp::bytemuck::cast_slice(values));
    } else {
        bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }
}

/// The encoded column, read from its beginning.
struct Encoded<'a> {
    dictionary: &'a [u8],
    pages: &'a [u8],
}

impl Length for Encoded<'_> {
    fn len(&self) -> u64 {
        (self.dictionary.len() + self.pages.len()) as u64
    }
}

impl<'a> ChunkReader for Encoded<'a> {
    type T = io::Chain<&'a [u8], &'a [u8]>;

    fn get_read(&self, start: u64) -> Result<Self::T, ParquetError> {
        let start = usize::try_from(start).unwrap_or(usize::MAX);
        let skipped = |bytes: &'a [u8], skip: usize| bytes.get(skip..).unwrap_or_default();
        let dictionary = skipped(self.dictionary, start);
        let pages = skipped(self.pages, start.saturating_sub(self.dictionary.len()));
        Ok(dictionary.chain(pages))
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes, ParquetError> {
        let mut bytes = vec![0; length];
        self.get_read(start)?.read_exact(&mut bytes).map_err(ParquetError::from)?;
        Ok(bytes.into())
    }
}
