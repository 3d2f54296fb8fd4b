//! Reads whole files, and stops as soon as they prove to be of another type: a device such as `/dev/zero` has no end.

use super::{PIECE, open};
use crate::failure::Failure;
use std::fs::Metadata;
use std::io::{self, Read};
use std::path::Path;

/// The maximum length of a line of a deck or a table, in bytes; Abaqus reads 256 characters of a line.
pub(super) const LONGEST_LINE: usize = 16 << 20;

/// The maximum number of bytes read from a device, including terminals, which may be endless.
const MAX_OF_DEVICE: u64 = 64 << 20;

/// An input with a limit for endless devices.
pub(super) struct Bounded<R> {
    input: R,
    left: u64,
    most: u64,
}

/// Limits an input by its file type.
pub(super) fn bounded<R: Read>(input: R, metadata: Option<&Metadata>) -> Bounded<R> {
    bounded_to(input, if metadata.is_some_and(is_device) { MAX_OF_DEVICE } else { u64::MAX })
}

/// Limits an input to a number of bytes.
fn bounded_to<R: Read>(input: R, most: u64) -> Bounded<R> {
    Bounded { input, left: most, most }
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.input.read(into)?;
        match self.left.checked_sub(count as u64) {
            Some(left) => self.left = left,
            None => {
                let most = self.most;
                return Err(invalid(format!(
                    "it is a device, and gives more than {most} bytes: write it to a file first"
                )));
            }
        }
        Ok(count)
    }
}

#[cfg(unix)]
fn is_device(metadata: &Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    metadata.file_type().is_char_device() || metadata.file_type().is_block_device()
}

/// Only Unix has devices that are named like files.
#[cfg(not(unix))]
fn is_device(_metadata: &Metadata) -> bool {
    false
}

/// Reads all bytes of a deck or a table, or of standard input for `-`, with a limit of line length.
pub(crate) fn read_lines(path: &Path) -> Result<Vec<u8>, Failure> {
    lines_of(&mut open(path)?).map_err(|error| Failure::read(path, error))
}

/// Reads all bytes of lines from a possibly endless stream, such as a pipe.
pub(super) fn lines_of_stream(input: &mut dyn Read, most: u64) -> io::Result<Vec<u8>> {
    let bytes = lines_of(&mut input.take(most.saturating_add(1)))?;
    if most < bytes.len() as u64 {
        return Err(invalid(format!("it is no file, and gives more than {most} bytes: write it to a file first")));
    }
    Ok(bytes)
}

/// Reads all of a text whose lines may be of any length (JSON, TOML), or of standard input for `-`.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    text_of(&mut open(path)?).map_err(|error| Failure::read(path, error))
}

pub(super) fn lines_of(input: &mut dyn Read) -> io::Result<Vec<u8>> {
    let mut line_start = 0;
    read_while(input, |bytes, new| {
        let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
        if let Some(end) = bytes[new..].iter().rposition(is_end) {
            line_start = new + end + 1;
        }
        if bytes.len() - line_start <= LONGEST_LINE {
            return Ok(());
        }
        let before = &bytes[..line_start];
        let ends = memchr::memchr_iter(b'\n', before).count();
        let lone = before.windows(2).filter(|pair| pair[0] == b'\r' && pair[1] != b'\n').count();
        let lone = lone + usize::from(before.ends_with(b"\r"));
        Err(endless_line(ends + lone + 1))
    })
}

/// The error of a line without an end.
pub(super) fn endless_line(line: impl std::fmt::Display) -> io::Error {
    invalid(format!("line {line} is longer than {LONGEST_LINE} bytes, the most that a line may have: it is no deck"))
}

/// The text of an input: UTF-8 without NUL, which is invalid in JSON and TOML.
fn text_of(input: &mut dyn Read) -> io::Result<String> {
    let mut sound = 0;
    let bytes = read_while(input, |bytes, new| {
        if let Some(at) = bytes[new..].iter().position(|byte| *byte == 0) {
            return Err(invalid(format!("it is no text: byte {} is zero", new + at + 1)));
        }
        match std::str::from_utf8(&bytes[sound..]) {
            Ok(_) => sound = bytes.len(),
            Err(error) => {
                sound += error.valid_up_to();
                // A character may continue in the next piece.
                if error.error_len().is_some() {
                    return Err(not_utf8(sound));
                }
            }
        }
        Ok(())
    })?;
    String::from_utf8(bytes).map_err(|error| not_utf8(error.utf8_error().valid_up_to()))
}

fn not_utf8(sound: usize) -> io::Error {
    invalid(format!("it is not UTF-8: byte {} belongs to no character", sound + 1))
}

fn invalid(message: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, message)
}

/// Reads to the end, as long as `judge` allows: it gets the bytes so far, and the start of the last piece.
fn read_while(input: &mut dyn Read, mut judge: impl FnMut(&[u8], usize) -> io::Result<()>) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    loop {
        let new = bytes.len();
        if input.take(PIECE as u64).read_to_end(&mut bytes)? == 0 {
            return Ok(bytes);
        }
        judge(&bytes, new)?;
    }
}

#[cfg(test)]
mod tests {
    use super::{LONGEST_LINE, MAX_OF_DEVICE, PIECE, bounded_to, lines_of, lines_of_stream, text_of};
    use std::io::{self, Read};

    fn message<T: std::fmt::Debug>(read: io::Result<T>) -> String {
        read.expect_err("refused").to_string()
    }

    #[test]
    fn a_line_without_an_end_is_given_up_with_its_number() {
        for head in ["a\nb\n", "a\r\nb\r\n", "a\rb\r", "a\r\n\r"] {
            let refusal = message(lines_of(&mut head.as_bytes().chain(io::repeat(b'x'))));
            assert!(refusal.starts_with("line 3 is longer than 16777216 bytes"), "{head:?}: {refusal}");
        }
        let longest = [vec![b'x'; LONGEST_LINE], b"\n".to_vec()].concat().repeat(2);
        assert_eq!(lines_of(&mut longest.as_slice()).expect("as long as a line may be"), longest);
    }

    #[test]
    fn a_device_and_a_stream_without_an_end_are_given_up() {
        let refusal = message(io::copy(&mut bounded_to(io::repeat(b'\n'), MAX_OF_DEVICE), &mut io::sink()));
        assert_eq!(refusal, "it is a device, and gives more than 67108864 bytes: write it to a file first");
        let refusal = message(lines_of(&mut bounded_to(io::repeat(b'\n'), MAX_OF_DEVICE)));
        assert!(refusal.starts_with("it is a device, and gives more than 67108864 bytes"), "{refusal}");
        let refusal = message(lines_of_stream(&mut io::repeat(b'\n'), 100_000));
        assert_eq!(refusal, "it is no file, and gives more than 100000 bytes: write it to a file first");
        for (length, most) in [(100_000, 100_000), (0, 0)] {
            let found = lines_of_stream(&mut io::repeat(b'\n').take(length), most).expect("no more than it may");
            assert_eq!(found.len() as u64, length);
            let found = lines_of(&mut bounded_to(io::repeat(b'\n').take(length), most)).expect("no more than it may");
            assert_eq!(found.len() as u64, length);
        }
    }

    #[test]
    fn a_text_is_utf8_wherever_its_pieces_end() {
        for shift in 0..4 {
            let text = format!("{}{}", "x".repeat(shift), "\u{1F600}\u{e9}".repeat(PIECE / 3));
            assert_eq!(text_of(&mut text.as_bytes()).expect("a text"), text);
            let bytes = text.as_bytes();
            let cut = &bytes[..bytes.len() - 1];
            let refusal = message(text_of(&mut &*cut));
            assert_eq!(refusal, format!("it is not UTF-8: byte {} belongs to no character", bytes.len() - 1));
        }
        let refusal = message(text_of(&mut b"{}\0".chain(io::repeat(0))));
        assert_eq!(refusal, "it is no text: byte 3 is zero");
        let refusal = message(text_of(&mut b"{}".chain(io::repeat(0xFF))));
        assert_eq!(refusal, "it is not UTF-8: byte 3 belongs to no character");
    }
}
