//! Files that are not node tables: their type by the first bytes, and what to do about it.

use std::io;

/// The number of bytes inspected.
pub(super) const LOOKED_AT: usize = 512;

/// A file type by its magic bytes, with its name and help.
type Kind = (&'static [u8], &'static str, &'static str);

const KINDS: &[Kind] = &[
    (b"\x1F\x8B", "compressed with gzip", "unpack it first: `gunzip -c FILE | inpact … --nodes -`"),
    (b"\x28\xB5\x2F\xFD", "compressed with Zstandard", "unpack it first: `zstd -dc FILE | inpact … --nodes -`"),
    (b"BZh", "compressed with bzip2", "unpack it first: `bunzip2 -c FILE | inpact … --nodes -`"),
    (b"\xFD7zXZ\0", "compressed with xz", "unpack it first: `xz -dc FILE | inpact … --nodes -`"),
    (b"\x04\x22\x4D\x18", "compressed with LZ4", "unpack it first: `lz4 -dc FILE | inpact … --nodes -`"),
    (
        b"PK\x03\x04",
        "a ZIP archive, as workbooks (.xlsx, .ods) are",
        "save the sheet as comma-separated values, or unpack the archive",
    ),
    (b"\xD0\xCF\x11\xE0", "a workbook of old Excel (.xls)", "save the sheet as comma-separated values"),
    (b"\x89PNG", "a picture (PNG)", "give a node table"),
    (b"\xFF\xD8\xFF", "a picture (JPEG)", "give a node table"),
    (b"GIF8", "a picture (GIF)", "give a node table"),
    (b"%PDF", "a PDF document", "give a node table"),
    (b"\x89HDF", "an HDF5 file", "export the table as comma-separated values or Parquet"),
    (b"SQLite format 3", "an SQLite database", "export the table as comma-separated values"),
    (b"\x93NUMPY", "a NumPy array", "write it as comma-separated values, with a header line"),
    (b"Obj\x01", "an Avro file", "convert it to Parquet or comma-separated values"),
    (b"ORC", "an ORC file", "convert it to Parquet or comma-separated values"),
    (b"FEA1", "a Feather file of version 1", "write it as version 2, which is an Arrow file"),
    (b"\x7FELF", "a program", "give a node table"),
];

/// An error of kind [`io::ErrorKind::InvalidData`] where a file does not begin like a node table.
pub(super) fn refuse(start: &[u8]) -> io::Result<()> {
    let Some((what, cure)) = kind_of(start) else { return Ok(()) };
    Err(io::Error::new(io::ErrorKind::InvalidData, format!("it is {what}, no node table; {cure}")))
}

fn kind_of(start: &[u8]) -> Option<(&'static str, &'static str)> {
    const JSON: (&str, &str) = ("JSON", "write its records as comma-separated values, with a header line");
    const AS_UTF_8: &str = "save it as UTF-8: `iconv -f UTF-16 -t UTF-8 FILE | inpact … --nodes -`";
    if let Some((_, what, cure)) = KINDS.iter().find(|(magic, ..)| start.starts_with(magic)) {
        return Some((what, cure));
    }
    let has_mark = start.starts_with(b"\xFF\xFE") || start.starts_with(b"\xFE\xFF");
    // ASCII in UTF-16 has a zero in every second byte.
    let pairs = start.chunks_exact(2).take(8);
    let is_wide = |zero: usize| 3 <= pairs.len() && pairs.clone().all(|pair| pair[zero] == 0 && pair[1 - zero] != 0);
    if has_mark || is_wide(0) || is_wide(1) {
        return Some(("text in UTF-16", AS_UTF_8));
    }
    if start.contains(&0) {
        return Some(("binary data", "a node table is comma-separated values, Parquet or Arrow"));
    }
    let text = start.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(start).trim_ascii_start();
    let lower: Vec<u8> = text.iter().take(16).map(u8::to_ascii_lowercase).collect();
    let next = || text[1..].trim_ascii_start().first().copied().unwrap_or(b'"');
    match text {
        [b'{', ..] if matches!(next(), b'"' | b'}') => Some(JSON),
        [b'[', ..] if matches!(next(), b'"' | b'{' | b'[' | b']' | b'-' | b'0'..=b'9') => Some(JSON),
        [b'<', ..] if lower.starts_with(b"<?xml") => Some(("XML", "write its rows as comma-separated values")),
        [b'<', ..] if lower.starts_with(b"<!doctype") || lower.starts_with(b"<html") => {
            Some(("a web page", "save the table itself as comma-separated values"))
        }
        [b'*', rest @ ..] if rest.first().is_some_and(|next| *next == b'*' || next.is_ascii_alphabetic()) => {
            Some(("a deck", "the deck comes first, and behind `--nodes` a table of its nodes"))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_table_is_called_by_its_name() {
        let said = |start: &[u8]| refuse(start).err().map(|error| error.to_string());
        for (start, what) in [
            (&b"\x1F\x8B\x08"[..], "gzip"),
            (b"PK\x03\x04....", "workbook"),
            (b"\xFF\xFEc\0l\0", "UTF-16"),
            (b"c\0l\0e\0a\0r\0", "UTF-16"),
            (b"\0c\0l\0e\0a", "UTF-16"),
            (b"  [{\"clearance\": 1}]", "JSON"),
            (b"{\"clearance\": [1]}", "JSON"),
            (b"\x89PNG\r\n\x1A\n", "PNG"),
            (b"<?xml version=\"1.0\"?>", "XML"),
            (b"<!DOCTYPE html>", "web page"),
            (b"*SURFACE INTERACTION, NAME=A", "a deck"),
            (b"** deck", "a deck"),
            (b"clearance\0pressure", "binary"),
        ] {
            assert!(said(start).is_some_and(|message| message.contains(what)), "{start:?}: {:?}", said(start));
        }
        for table in [&b""[..], b"clearance,pressure\n", b"\xEF\xBB\xBFnode;time", b"a", b"ab", b"* ,node", b"\"{\",a"]
        {
            assert_eq!(said(table), None, "{table:?}");
        }
    }
}
