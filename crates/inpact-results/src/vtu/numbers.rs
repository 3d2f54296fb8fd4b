//! Numbers as VTK stores them: ASCII, or length-prefixed blocks of bytes, compressed or not.

use super::Values;
use super::xml::Tag;
use crate::number;
use crate::problem::shown;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// A type of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NumberType {
    Float(usize),
    Signed(usize),
    Unsigned(usize),
}

impl NumberType {
    /// The type with VTK's name: `Float64`, `UInt8`, …
    pub(super) fn named(name: &str) -> Option<Self> {
        let digits = name.trim_start_matches(|letter: char| letter.is_ascii_alphabetic());
        let width = match digits {
            "8" => 1,
            "16" => 2,
            "32" => 4,
            "64" => 8,
            _ => return None,
        };
        match &name[..name.len() - digits.len()] {
            "Float" if 4 <= width => Some(Self::Float(width)),
            "Int" => Some(Self::Signed(width)),
            "UInt" => Some(Self::Unsigned(width)),
            _ => None,
        }
    }

    fn width(self) -> usize {
        match self {
            Self::Float(width) | Self::Signed(width) | Self::Unsigned(width) => width,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Order {
    #[default]
    Little,
    Big,
}

/// Storage of bytes in a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encoding {
    order: Order,
    /// The bytes of a length.
    length: usize,
    zlib: bool,
}

impl Default for Encoding {
    fn default() -> Self {
        Self { order: Order::Little, length: 4, zlib: false }
    }
}

impl Encoding {
    /// The encoding that the attributes of `VTKFile` give.
    pub(super) fn of(tag: &Tag<'_>) -> Result<Self, String> {
        let order = match tag.attribute("byte_order").as_deref() {
            Some("BigEndian") => Order::Big,
            _ => Order::Little,
        };
        let length = if tag.attribute("header_type").as_deref() == Some("UInt64") { 8 } else { 4 };
        let zlib = match tag.attribute("compressor").as_deref() {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => return Err(format!("the compressor `{}` is not read", shown(other.as_bytes()))),
        };
        Ok(Self { order, length, zlib })
    }

    /// The numbers of an array, whose bytes begin here.
    pub(super) fn numbers(&self, source: &[u8], of_type: NumberType) -> Result<Values, String> {
        if self.zlib {
            return self.typed(&self.inflated(source)?, of_type);
        }
        let length = self.length_at(source, 0)?;
        match source[self.length..].get(..length) {
            Some(bytes) => self.typed(bytes, of_type),
            None => Err(format!("expected {length} bytes, found {}", source.len() - self.length)),
        }
    }

    /// Blocks that are compressed one by one: how many, the size of each, that of the last, their compressed sizes.
    fn inflated(&self, source: &[u8]) -> Result<Vec<u8>, String> {
        let blocks = self.length_at(source, 0)?;
        let (size, last) = (self.length_at(source, 1)?, self.length_at(source, 2)?);
        let mut begin = blocks.checked_add(3).and_then(|count| count.checked_mul(self.length)).unwrap_or(usize::MAX);
        if source.len() < begin {
            return Err(format!("expected the sizes of {blocks} blocks"));
        }
        let mut all = Vec::new();
        for block in 0..blocks {
            let compressed = self.length_at(source, 3 + block)?;
            let end = begin.checked_add(compressed).filter(|end| *end <= source.len());
            let end = end.ok_or_else(|| format!("block {block} of {blocks} ends before its {compressed} bytes"))?;
            let expected = if block + 1 == blocks && 0 < last { last } else { size };
            let bytes = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(&source[begin..end], expected)
                .map_err(|_| format!("block {block} of {blocks} does not unpack to {expected} bytes"))?;
            if bytes.len() != expected {
                return Err(format!("block {block} of {blocks} has {} bytes, expected {expected}", bytes.len()));
            }
            all.extend(bytes);
            begin = end;
        }
        Ok(all)
    }

    /// The length at this place among lengths.
    fn length_at(&self, source: &[u8], at: usize) -> Result<usize, String> {
        let begin = at.checked_mul(self.length);
        let bytes = begin.and_then(|begin| source.get(begin..)).and_then(|rest| rest.get(..self.length));
        let bytes = bytes.ok_or("expected the length of the array")?;
        let length = self.unsigned(bytes);
        usize::try_from(length).map_err(|_| format!("the length {length} is none"))
    }

    fn typed(&self, bytes: &[u8], of_type: NumberType) -> Result<Values, String> {
        let width = of_type.width();
        if !bytes.len().is_multiple_of(width) {
            return Err(format!("{} bytes are no numbers of {width} bytes", bytes.len()));
        }
        let patterns = bytes.chunks_exact(width).map(|pattern| self.unsigned(pattern));
        Ok(match of_type {
            NumberType::Float(4) => {
                #[expect(clippy::cast_possible_truncation, reason = "the pattern has 4 bytes")]
                let narrow = patterns.map(|pattern| f64::from(f32::from_bits(pattern as u32)));
                Values::Reals(narrow.collect())
            }
            NumberType::Float(_) => Values::Reals(patterns.map(f64::from_bits).collect()),
            NumberType::Signed(_) | NumberType::Unsigned(8) => {
                // Sign extension of a narrow integer.
                let unused = 64 - 8 * width;
                Values::Integers(patterns.map(|pattern| (pattern << unused).cast_signed() >> unused).collect())
            }
            NumberType::Unsigned(_) => Values::Integers(patterns.map(u64::cast_signed).collect()),
        })
    }

    /// Up to 8 bytes as a number.
    fn unsigned(&self, bytes: &[u8]) -> u64 {
        let add = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
        match self.order {
            Order::Little => bytes.iter().rev().fold(0, add),
            Order::Big => bytes.iter().fold(0, add),
        }
    }
}

/// Decodes base64, which may be several concatenated texts, each with its own padding.
pub(super) fn decoded(text: &[u8]) -> Result<Vec<u8>, String> {
    let mut plain: Vec<u8> = text.to_vec();
    plain.retain(|byte| !byte.is_ascii_whitespace());
    let mut bytes = Vec::with_capacity(plain.len() / 4 * 3);
    let mut rest = plain.as_slice();
    while !rest.is_empty() {
        let end = match memchr::memchr(b'=', rest) {
            Some(pad) => rest[pad..].iter().position(|byte| *byte != b'=').map_or(rest.len(), |length| pad + length),
            None => rest.len(),
        };
        STANDARD.decode_vec(&rest[..end], &mut bytes).map_err(|error| format!("no base64: {error}"))?;
        rest = &rest[end..];
    }
    Ok(bytes)
}

/// Numbers between blanks.
pub(super) fn numbers_of(text: &[u8], of_type: NumberType) -> Result<Values, String> {
    fn all<T>(text: &[u8], number: impl Fn(&[u8]) -> Option<T>) -> Result<Vec<T>, String> {
        let cells = text.split(u8::is_ascii_whitespace).filter(|cell| !cell.is_empty());
        cells.map(|cell| number(cell).ok_or_else(|| format!("expected a number, found `{}`", shown(cell)))).collect()
    }
    match of_type {
        NumberType::Float(_) => all(text, number::real).map(Values::Reals),
        _ => all(text, number::integer).map(Values::Integers),
    }
}
